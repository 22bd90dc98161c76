//! The plane at the debugger's cursor: of a skewed-T test (5.4.1), or of a hypothesis that grows (5.3.2, 5.4.2).

use super::{PlaneBranch, PlanePixel, RegionPlane};
use crate::color::{Vec3, rgb};
use crate::photo::WorkingPicture;
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::reflection::{Components, ReflectionTransform};
use crate::trace::{CandidateTested, PixelKind, Replay};
use crate::view::{
    MOST_PLANE_POINTS, Meaning, candidate_pixels, growth_pixels, measured_and_ignored, pixels_of_region,
    sampled,
};

/// The working picture, and the transform into the coordinates of a plane.
struct PlaneProjection<'a> {
    working: &'a WorkingPicture,
    transform: ReflectionTransform,
}

impl PlaneProjection<'_> {
    /// The points of some groups of pixels, each group of one meaning.
    fn points(&self, groups: &[(Vec<u32>, Meaning)]) -> Vec<PlanePixel> {
        let most = MOST_PLANE_POINTS / groups.len().max(1);
        let all =
            groups.iter().flat_map(|(pixels, meaning)| sampled(pixels, most).map(move |p| (p, *meaning)));
        let place = |(pixel, meaning): (u32, Meaning)| {
            let color = self.working.image.pixels[pixel as usize];
            let middle = self.working.blocks.middle(pixel as usize);
            let Components { body, surface, .. } = self.transform.split(color);
            let pixel = PixelIndex::from_index(middle);
            let (kind, meaning) = (kind_of(meaning), Some(meaning));
            PlanePixel { body, surface, color, kind, meaning, pixel, count: 1 }
        };
        all.map(place).collect()
    }

    /// The amount of body reflection of a color, counts.
    fn amount(&self, color: Vec3) -> f32 {
        self.transform.split(rgb(&color)).body
    }

    fn plane(self, region: Option<RegionId>, half_widths: [f64; 2], points: Vec<PlanePixel>) -> RegionPlane {
        let [slice_half_width, radius] = half_widths.map(|v| v as f32);
        RegionPlane {
            region,
            body: self.transform.body(),
            surface: self.transform.surface(),
            has_plane: true,
            angle_deg: super::angle_deg(&self.transform),
            matte_length: 0.0,
            branches: Vec::new(),
            slice_half_width,
            radius,
            extent: super::extent(&points),
            points,
            transform: self.transform,
            // Ambient light is estimated after all growth.
            origin: [0.0; 3],
        }
    }
}

/// The kind that stands for a meaning: the points of the matte line are matte, the points off the line are highlight or lost.
const fn kind_of(meaning: Meaning) -> PixelKind {
    match meaning {
        Meaning::Taken => PixelKind::Matte,
        Meaning::JustTaken | Meaning::Candidate => PixelKind::Highlight,
        Meaning::Refused | Meaning::Ignored => PixelKind::Lost,
    }
}

/// A test in the plane of both lines: m_b along the matte line, m_s along the candidate's. `region` is the region that the
/// tested hypothesis became part of. None where both lines have one direction.
pub fn test_plane(
    replay: &Replay,
    test: &CandidateTested,
    region: Option<RegionId>,
    working: &WorkingPicture,
) -> Option<RegionPlane> {
    let transform = ReflectionTransform::new(&test.matte.direction, &test.line.direction)?;
    let (colors, masks) = (&working.image.pixels, &working.masks);
    let projection = PlaneProjection { working, transform };
    let own = pixels_of_region(replay, test.hypothesis);
    let (measured, ignored) = measured_and_ignored(test, &own, colors);
    let points = projection.points(&[
        (measured, Meaning::Taken),
        (ignored, Meaning::Ignored),
        (candidate_pixels(replay, test, masks), Meaning::Candidate),
    ]);
    let brightest = test.matte.foot() + test.matte.direction * test.matte_length;
    let (matte_length, meeting) = (projection.amount(brightest), projection.amount(test.meeting[0]));
    let plane = projection.plane(region, [test.gap.limit; 2], points);
    let branches = super::branches(&[meeting], &plane.points);
    Some(RegionPlane { matte_length, branches, ..plane })
}

/// A hypothesis at the cursor: its pixels, the pixels that it took last and the pixels that it did not take. The plane is the dichromatic plane once there is a slice, before that a plane across
/// the line. `focus` is the hypothesis,
/// `region` the region that the hypothesis became part of. None where the hypothesis has no line.
pub fn growing_plane(
    replay: &Replay,
    focus: HypothesisId,
    region: Option<RegionId>,
    working: &WorkingPicture,
) -> Option<RegionPlane> {
    let hypothesis = replay.hypothesis(focus)?;
    let made = replay.slice(focus);
    let line = made.map_or(hypothesis.line()?, |made| &made.plane.matte);
    let across = || {
        let aside = line.inward().try_normalize(1e-6);
        let square = aside.unwrap_or_else(|| line.direction.cross(&Vec3::x()).normalize());
        ReflectionTransform::new(&line.direction, &square)
    };
    let in_plane = made.and_then(|made| ReflectionTransform::new(&line.direction, &made.plane.surface));
    let has_plane = in_plane.is_some();
    let (colors, masks) = (&working.image.pixels, &working.masks);
    let projection = PlaneProjection { working, transform: in_plane.or_else(across)? };
    let grown = growth_pixels(replay, colors, masks).filter(|grown| grown.hypothesis == focus);
    let (outside, newest) = grown.map_or_else(Default::default, |grown| (grown.outside, grown.newest));
    let points = projection.points(&[
        (pixels_of_region(replay, focus), Meaning::Taken),
        (outside, Meaning::Refused),
        (newest, Meaning::JustTaken),
    ]);
    let brightest = made.map(|made| line.foot() + line.direction * made.matte_length);
    let held = points.iter().filter(|point| point.kind == PixelKind::Matte);
    let longest = held.fold(0.0f32, |most, point| most.max(point.body));
    let matte_length = brightest.map_or(longest, |brightest| projection.amount(brightest));
    let meeting_point = made.map(|made| projection.amount(made.start)).filter(|_| has_plane);
    let radius = hypothesis.radius;
    let plane = projection.plane(region, [made.map_or(radius, |made| made.half_width), radius], points);
    let length = plane.extent[1][1].max(0.0);
    let branches = meeting_point.map(|meeting_point| PlaneBranch { meeting_point, length });
    Some(RegionPlane { has_plane, matte_length, branches: branches.into_iter().collect(), ..plane })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Event, Topic};
    use crate::view::test_at_cursor;
    use crate::view::testing::tiny;
    use std::sync::Arc;

    fn cursor_after(steps: usize) -> Replay {
        let mut replay = Replay::new(Arc::clone(tiny().trace().unwrap()));
        replay.seek(steps);
        replay
    }

    #[test]
    fn a_test_meets_where_it_says_and_its_clusters_lie_along_both_lines() {
        let shown = tiny();
        let trace = shown.trace().unwrap();
        let passed = trace
            .events()
            .find(|(_, event)| matches!(event, Event::CandidateTested(test) if test.verdict.accepted()));
        let replay = cursor_after(passed.unwrap().0 + 1);
        let test = test_at_cursor(&replay).unwrap();
        let plane = test_plane(&replay, test, RegionId::from_label(3), &shown.analysis.working).unwrap();
        assert_eq!((plane.region, plane.has_plane), (RegionId::from_label(3), true));
        let percent = 100.0 * f64::from(plane.branches[0].meeting_point / plane.matte_length);
        assert!((percent - test.position_percent).abs() < 8.0, "{percent} {}", test.position_percent);
        let near = |kind: PixelKind, of: fn(&PlanePixel) -> f32| {
            let all: Vec<f32> = plane.points.iter().filter(|p| p.kind == kind).map(of).collect();
            all.iter().sum::<f32>() / all.len() as f32
        };
        assert!(near(PixelKind::Matte, |p| p.surface).abs() < plane.radius);
        assert!(near(PixelKind::Highlight, |p| p.surface) > 0.0, "light was added");
        assert!(near(PixelKind::Lost, |p| p.surface) > near(PixelKind::Matte, |p| p.surface));
    }

    #[test]
    fn a_growing_region_is_shown_across_its_line_until_it_has_a_slice() {
        let shown = tiny();
        let trace = shown.trace().unwrap();
        let block = trace.blocks().find(|block| matches!(block.topic, Topic::Slice(_))).unwrap();
        let (hypothesis, region) = (block.topic.hypothesis(), RegionId::from_label(1));
        for (steps, has_plane) in [(block.steps.start, false), (block.steps.start + 1, true)] {
            let plane =
                growing_plane(&cursor_after(steps), hypothesis, region, &shown.analysis.working).unwrap();
            assert_eq!((plane.has_plane, !plane.branches.is_empty()), (has_plane, has_plane));
            assert!(plane.matte_length > 20.0 && plane.points.len() > 100);
        }
        let first = HypothesisId::from_index(0);
        assert!(
            growing_plane(&cursor_after(1), first, RegionId::from_label(1), &shown.analysis.working)
                .is_none()
        );
    }
}
