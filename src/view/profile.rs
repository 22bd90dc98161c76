//! Body reflection, surface reflection and noise along a line through the picture, as in color figure 11 of the paper.

use super::{Picture, ProfileLine, ResultSnapshot};
use crate::raster::{PixelIndex, RegionId};
use crate::trace::PixelKind;
use std::fmt::Write;

/// One pixel on the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileSample {
    /// Distance from the beginning of the line, pixels.
    pub position_px: f32,
    /// The pixel of the sample.
    pub pixel: PixelIndex,
    /// Color of the pixel, linear counts.
    pub input: [f32; 3],
    /// m_b: body reflection along C_b, counts; none for a pixel in no region.
    pub body: Option<f32>,
    /// m_s: surface reflection along C_s, counts; none where the region has no surface vector.
    pub surface: Option<f32>,
    /// ε: distance from the dichromatic plane, counts; none for a pixel in no region.
    pub noise: Option<f32>,
    /// The region of the pixel; none: no region.
    pub region: Option<RegionId>,
    /// Kind of the pixel.
    pub kind: PixelKind,
}

/// The ends of a line: the middles of its first and last pixel, in pixels of the picture (pixel (0, 0) covers 0…1).
///
/// Rows and columns go through pixel `at`, or through the middle of the picture.
pub fn profile_ends(line: ProfileLine, picture: &Picture, at: Option<PixelIndex>) -> [[f32; 2]; 2] {
    let (width, height) = picture.size();
    let at = at.map(PixelIndex::index).filter(|&pixel| pixel < width * height);
    let (x, y) = at.map_or((width / 2, height / 2), |pixel| (pixel % width, pixel / width));
    let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
    match line {
        ProfileLine::Row => [[0.5, y], [(width as f32 - 0.5).max(0.5), y]],
        ProfileLine::Column => [[x, 0.5], [x, (height as f32 - 0.5).max(0.5)]],
        ProfileLine::Between(from, to) => [from, to],
    }
}

/// The pixels from one point to another, in pixels of the picture: one sample for each step along the longer side, without
/// interpolation. Pixels outside the picture are left out. Without a result of this picture the samples hold the input only.
pub fn profile(
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    [from, to]: [[f32; 2]; 2],
) -> Vec<ProfileSample> {
    let (width, height) = picture.size();
    let shown = shown.filter(|shown| shown.picture.size() == (width, height));
    let along = [to[0] - from[0], to[1] - from[1]];
    let length_px = along[0].hypot(along[1]);
    // A line cannot have more pixels inside than this, however far away its ends are.
    let steps = along[0].abs().max(along[1].abs()).round().min(1e6);
    let sample = |step: u32| {
        let share = if steps > 0.0 { step as f32 / steps } else { 0.0 };
        let (x, y) = ((from[0] + share * along[0]).floor(), (from[1] + share * along[1]).floor());
        let inside = (0.0..width as f32).contains(&x) && (0.0..height as f32).contains(&y);
        inside.then(|| at(picture, shown, y as usize * width + x as usize, share * length_px))
    };
    (0..=steps as u32).filter_map(sample).collect()
}

fn at(picture: &Picture, shown: Option<&ResultSnapshot>, pixel: usize, position_px: f32) -> ProfileSample {
    let bare = ProfileSample {
        position_px,
        pixel: PixelIndex::from_index(pixel),
        input: picture.photo.image.pixels[pixel],
        body: None,
        surface: None,
        noise: None,
        region: None,
        kind: PixelKind::Unassigned,
    };
    let Some(shown) = shown else { return bare };
    let intrinsic = &shown.analysis.intrinsic;
    let region = RegionId::from_label(shown.labels()[pixel]);
    let Some(vectors) = region.and_then(|region| intrinsic.regions.get(region.index())) else { return bare };
    ProfileSample {
        body: Some(along(intrinsic.body[pixel], vectors.body)),
        surface: vectors.surface.map(|surface| along(intrinsic.surface[pixel], surface)),
        noise: Some(intrinsic.noise[pixel]),
        region,
        kind: intrinsic.kinds[pixel],
        ..bare
    }
}

/// Length of a color along a unit vector.
fn along(color: [f32; 3], unit: [f64; 3]) -> f32 {
    (0..3).map(|band| f64::from(color[band]) * unit[band]).sum::<f64>() as f32
}

/// The samples as comma separated values with a line of headings; `width` is the picture's. A field without a value is empty.
pub fn profile_csv(samples: &[ProfileSample], width: usize) -> String {
    let mut text = String::from(
        "position_px,x,y,r_counts,g_counts,b_counts,body_counts,surface_counts,noise_counts,region,kind\n",
    );
    let number = |value: Option<f32>| value.map_or_else(String::new, |value| format!("{value:.3}"));
    for sample in samples {
        let ProfileSample { position_px, pixel, input: [r, g, b], region, .. } = *sample;
        let ([x, y], region) = (pixel.position(width), RegionId::label(region));
        let [body, surface, noise] = [sample.body, sample.surface, sample.noise].map(number);
        let kind = sample.kind.name();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{position_px:.3},{x},{y},{r:.3},{g:.3},{b:.3},{body},{surface},{noise},{region},{kind}"
        );
    }
    text
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::intrinsic::Intrinsic;
    use crate::raster::Raster;
    use crate::view::testing::{divided, gray};
    use std::sync::Arc;

    const ROWS: [&str; 3] = [".....", "11122", "11122"];

    fn pixels(ends: [[f32; 2]; 2]) -> Vec<u32> {
        profile(&gray(&ROWS, 80), None, ends).iter().map(|sample| sample.pixel.get()).collect()
    }

    #[test]
    fn rows_and_columns_go_through_a_pixel_or_the_middle() {
        let picture = gray(&ROWS, 80);
        let through = |line, at: Option<u32>| pixels(profile_ends(line, &picture, at.map(PixelIndex::new)));
        assert_eq!(through(ProfileLine::Row, None), [5, 6, 7, 8, 9]);
        assert_eq!(through(ProfileLine::Row, Some(11)), [10, 11, 12, 13, 14]);
        assert_eq!(through(ProfileLine::Column, Some(11)), [1, 6, 11]);
        assert_eq!(through(ProfileLine::Column, Some(999)), [2, 7, 12]);
    }

    #[test]
    fn any_line_has_a_pixel_a_step_and_ends_at_the_border() {
        assert_eq!(pixels([[0.5, 0.5], [2.5, 2.5]]), [0, 6, 12]);
        assert_eq!(pixels([[4.2, 1.7], [0.1, 1.7]]), [9, 8, 7, 6, 5]);
        assert_eq!(pixels([[-2.5, 0.5], [1.5, 0.5]]), [0, 1]);
        assert_eq!(pixels([[1.5, 1.5], [1.5, 1.5]]), [6]);
        assert!(pixels([[-9.0, -9.0], [f32::INFINITY, 2.0]]).is_empty());
        let diagonal = profile(&gray(&ROWS, 80), None, [[0.5, 0.5], [2.5, 2.5]]);
        assert!((diagonal[2].position_px - 8f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn amounts_are_along_the_vectors_of_the_region() {
        let picture = gray(&ROWS, 80);
        let mut shown = divided(&picture, &ROWS);
        let (mut body, mut surface) = (Raster::filled(5, 3, [80.0; 3]), Raster::filled(5, 3, [0.0; 3]));
        let mut noise = Raster::filled(5, 3, 0.0);
        let mut regions = shown.analysis.intrinsic.regions.clone();
        regions[1].surface = None;
        (body[6], surface[6], noise[6]) = ([30.0; 3], [-4.0, 0.0, 0.0], 1.5);
        shown.analysis.intrinsic = Arc::new(Intrinsic {
            body,
            surface,
            noise,
            regions,
            ..Intrinsic::clone(&shown.analysis.intrinsic)
        });
        let row = profile(
            &picture,
            Some(&shown),
            profile_ends(ProfileLine::Row, &picture, Some(PixelIndex::new(6))),
        );
        let close = |found: Option<f32>, expected: f32| assert!((found.unwrap() - expected).abs() < 1e-4);
        close(row[1].body, 30.0 * 3f32.sqrt());
        close(row[1].surface, -4.0);
        assert_eq!((row[1].noise, row[1].region), (Some(1.5), RegionId::from_label(1)));
        assert_eq!((row[3].surface, row[3].region), (None, RegionId::from_label(2)));
        let above = profile(
            &picture,
            Some(&shown),
            profile_ends(ProfileLine::Row, &picture, Some(PixelIndex::new(0))),
        );
        assert_eq!((above[0].body, above[0].noise, above[0].region), (None, None, None));
        let csv = profile_csv(&row[1..2], 5);
        assert_eq!(
            csv.lines().nth(1),
            Some("1.000,1,1,80.000,80.000,80.000,51.962,-4.000,1.500,1,unassigned")
        );
        assert!(profile_csv(&above[..1], 5).ends_with("\n0.000,0,0,80.000,80.000,80.000,,,,0,unassigned\n"));
    }
}
