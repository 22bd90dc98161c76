//! Pictures and label maps drawn as text, for the tests of single stages.

use super::input::AnalysisInput;
use crate::color::{Vec3, rgb};
use crate::params::{Params, Refine, UsedParams};
use crate::photo::{LinearImage, MaskLimits, Masks};
use crate::raster::{LabelMap, Raster};

/// A picture of which each character is a pixel.
pub struct Drawing {
    image: LinearImage,
    masks: Masks,
    pub used: UsedParams,
    pub refine: Refine,
}

impl Drawing {
    /// Colors the characters by `palette`; `.` is black. Table 6's numbers but for blooming, which is ignored, and the
    /// minimal area: every refinement is on.
    pub fn new(rows: &[&str], palette: impl Fn(char) -> Vec3) -> Self {
        let colors = rows.iter().flat_map(|row| row.chars());
        let colors = colors.map(|c| if c == '.' { [0.0; 3] } else { rgb(&palette(c)) }).collect();
        Self::of(Raster::from_vec(rows[0].len(), rows.len(), colors).unwrap())
    }

    /// A square picture, colored by column and row; the numbers are those of [`Drawing::new`].
    pub fn by_place(side_px: usize, color: impl Fn(f64, f64) -> Vec3) -> Self {
        let place = |i: usize| rgb(&color((i % side_px) as f64, (i / side_px) as f64));
        let colors = (0..side_px * side_px).map(place).collect();
        Self::of(Raster::from_vec(side_px, side_px, colors).unwrap())
    }

    fn of(pixels: Raster<[f32; 3]>) -> Self {
        let image = LinearImage::new(pixels, Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let used = UsedParams { bloom_density: 9.0, min_area: 4.0, ..UsedParams::paper() };
        Self { masks: Masks::new(&image, &limits), image, used, refine: Params::default().refine }
    }

    /// What the stages look at.
    pub fn input(&self) -> AnalysisInput<'_> {
        AnalysisInput::new(&self.image, &self.masks, &self.used, self.refine)
    }
}

/// A label map: digits are regions, all else is unassigned.
pub fn labels(rows: &[&str]) -> LabelMap {
    let label = |c: char| c.to_digit(10).unwrap_or(0) as u16;
    let data = rows.iter().flat_map(|row| row.chars()).map(label).collect();
    LabelMap::from_vec(rows[0].len(), rows.len(), data).unwrap()
}

/// Fails with both drawings unless `found` looks like `rows`, `.` for unassigned.
#[track_caller]
pub fn check(found: &LabelMap, rows: &[&str]) {
    let digit =
        |&label: &u16| char::from_digit(u32::from(label), 36).map_or('?', |d| if d == '0' { '.' } else { d });
    let drawn: Vec<String> = (0..found.height()).map(|y| found.row(y).iter().map(digit).collect()).collect();
    assert_eq!(drawn, rows);
}
