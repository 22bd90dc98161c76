//! Pictures and label maps drawn as text, for the tests of single stages.

use super::input::AnalysisInput;
use crate::color::{Vec3, rgb};
use crate::params::{Params, Refine, UsedParams};
use crate::photo::{LinearImage, MaskLimits, Masks};
use crate::raster::{LabelMap, Raster};

/// A picture with its masks and parameters.
pub struct Drawing {
    image: LinearImage,
    masks: Masks,
    pub used: UsedParams,
    pub refine: Refine,
}

impl Drawing {
    /// A picture of one pixel per character, colored by `palette`; `.` is black. The parameters are those of table 6, except
    /// that no pixel is bloomed and the minimal area is 4 pixels. Every refinement is on.
    pub fn new(rows: &[&str], palette: impl Fn(char) -> Vec3) -> Self {
        let colors = rows.iter().flat_map(|row| row.chars());
        let colors = colors.map(|c| if c == '.' { [0.0; 3] } else { rgb(&palette(c)) }).collect();
        Self::of(Raster::from_vec(rows[0].len(), rows.len(), colors).unwrap())
    }

    /// A square picture, colored by column and row, with the parameters of [`Drawing::new`].
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

    /// The input of the stages.
    pub fn input(&self) -> AnalysisInput<'_> {
        AnalysisInput::new(&self.image, &self.masks, &self.used, self.refine)
    }
}

/// A label map of one pixel per character: digits are regions, all other characters are unassigned pixels.
pub fn labels(rows: &[&str]) -> LabelMap {
    let label = |c: char| c.to_digit(10).unwrap_or(0) as u16;
    let data = rows.iter().flat_map(|row| row.chars()).map(label).collect();
    LabelMap::from_vec(rows[0].len(), rows.len(), data).unwrap()
}

/// Fails unless `found` equals the label map drawn as `rows`, with `.` for unassigned pixels; the message shows both.
#[track_caller]
pub fn check(found: &LabelMap, rows: &[&str]) {
    let digit =
        |&label: &u16| char::from_digit(u32::from(label), 36).map_or('?', |d| if d == '0' { '.' } else { d });
    let drawn: Vec<String> = (0..found.height()).map(|y| found.row(y).iter().map(digit).collect()).collect();
    assert_eq!(drawn, rows);
}
