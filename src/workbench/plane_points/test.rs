//! The plane of a skewed-T test at the debugger's cursor: the tested region's pixels and its candidate's (5.4.1).

use super::{PlanePixel, RegionPlane};
use crate::color::{Vec3, rgb};
use crate::photo::Masks;
use crate::reflection::{Components, ReflectionTransform};
use crate::trace::{CandidateTest, PixelKind, Replay};
use crate::workbench::debugger::{candidate_pixels, measured_and_ignored, pixels_of_region, sampled};
use crate::workbench::{MOST_PLANE_POINTS, Picture};

/// A test in the plane that both lines span: m_b along the matte line, m_s along the candidate's. Pixels by which the matte
/// line is measured are matte, those ignored for it are lost, the candidate's are highlight. None where both lines have one
/// direction.
pub fn test_plane(
    replay: &Replay,
    test: &CandidateTest,
    region: u16,
    picture: &Picture,
    masks: &Masks,
) -> Option<RegionPlane> {
    let transform = ReflectionTransform::new(&test.matte.direction, &test.line.direction)?;
    let colors = &picture.photo.image.pixels;
    let own = pixels_of_region(replay, test.region);
    let (measured, ignored) = measured_and_ignored(test, &own, colors);
    let candidate = candidate_pixels(replay, test.candidate, masks);
    let place = |pixel: u32, kind: PixelKind| {
        let colour = colors.as_slice()[pixel as usize];
        let Components { body, surface, .. } = transform.split(colour);
        PlanePixel { body, surface, colour, kind, pixel, count: 1 }
    };
    let groups =
        [(&measured, PixelKind::Matte), (&ignored, PixelKind::Lost), (&candidate, PixelKind::Highlight)];
    let points: Vec<PlanePixel> = groups
        .into_iter()
        .flat_map(|(pixels, kind)| sampled(pixels, MOST_PLANE_POINTS / 3).map(move |pixel| (pixel, kind)))
        .map(|(pixel, kind)| place(pixel, kind))
        .collect();
    let amount = |colour: Vec3| transform.split(rgb(&colour)).body;
    let brightest = test.matte.foot() + test.matte.direction * test.matte_length;
    let highlights = points.iter().filter(|point| point.kind == PixelKind::Highlight);
    let radius = test.gap[1] as f32;
    Some(RegionPlane {
        region,
        body: transform.body(),
        surface: transform.surface(),
        has_plane: true,
        angle_deg: super::angle_deg(&transform),
        matte_length: amount(brightest),
        meeting_point: Some(amount(test.meeting[0])),
        highlight_length: highlights.fold(0.0, |most, point| most.max(point.surface)),
        slice_half_width: radius,
        radius,
        extent: super::extent(&points),
        points,
        transform,
    })
}
