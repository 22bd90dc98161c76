//! The input of every stage of the segmentation.

use crate::color::Vec3;
use crate::params::{Readings, Refine, UsedParams};
use crate::photo::{CodingError, LinearImage, Masks, ShotNoise};
use crate::raster::Raster;

/// Standard deviation of the error of an interpolated band, as a share of the second difference of the band.
const INTERPOLATION_SHARE: f32 = 0.25;

/// Pixels that a person has marked as one region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct MarkedArea {
    /// Whether at least half of the usable pixels have marked pixels all around: then only these are fitted.
    has_inner: bool,
}

impl MarkedArea {
    /// The marked area of these masks.
    fn of(masks: &Masks) -> Self {
        let (width, height) = masks.shape();
        let usable = (0..width * height).filter(|&pixel| masks.usable(pixel));
        let (inner, all) = usable.fold((0usize, 0usize), |(inner, all), pixel| {
            (inner + usize::from(!masks.is_at_area_edge(pixel)), all + 1)
        });
        Self { has_inner: 2 * inner >= all }
    }
}

/// The image, its masks and the parameters.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct AnalysisInput<'a> {
    /// Colors, linear counts.
    pub pixels: &'a Raster<[f32; 3]>,
    /// The masks: which pixels are dark, clipped, bloomed, invalid or outside the area.
    pub masks: &'a Masks,
    /// The control parameters (table 6), none of them `auto`.
    pub used: &'a UsedParams,
    /// The refinements in force.
    pub refine: Refine,
    /// How the text of the paper is read.
    pub readings: Readings,
    /// Error of the file's values beyond the noise; `None`: the noise contains it.
    coding: Option<&'a CodingError>,
    /// The noise as a function of the intensity; `None`: the noise is the same at every intensity.
    shot: Option<ShotNoise>,
    /// Whether the errors of neighboring pixels are alike: after lossy compression or demosaicing.
    pub(crate) extended: bool,
    /// The pixels inside of the area, where a person has marked them as one region; `None` for regions that a method finds.
    marked: Option<MarkedArea>,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> AnalysisInput<'a> {
    /// The input of a run that is never stopped, with the readings of the refined method.
    pub fn new(image: &'a LinearImage, masks: &'a Masks, used: &'a UsedParams, refine: Refine) -> Self {
        Self {
            pixels: &image.pixels,
            masks,
            used,
            refine,
            readings: Readings::REFINED,
            coding: None,
            shot: None,
            extended: false,
            marked: None,
            stop: &|| false,
        }
    }

    /// The same input, with the text of the paper read in another way.
    #[must_use]
    pub fn with_readings(self, readings: Readings) -> Self {
        Self { readings, ..self }
    }

    /// The same input, whose pixels inside of the area a person has marked as one region if `is_marked`.
    #[must_use]
    pub fn with_marked_pixels(self, is_marked: bool) -> Self {
        Self { marked: is_marked.then(|| MarkedArea::of(self.masks)), ..self }
    }

    /// Whether a person has marked the pixels as one region: then no pixel is taken out of the region for its surroundings.
    pub fn is_marked(&self) -> bool {
        self.marked.is_some()
    }

    /// Whether lines and planes are fitted to the pixel: the color is used and, in a marked area, the pixel is not at the edge of the area,
    /// where colors are mixtures of two objects.
    #[inline]
    pub fn is_fitted(&self, pixel: usize) -> bool {
        let is_inner_only = self.marked.is_some_and(|marked| marked.has_inner);
        self.masks.usable(pixel) && !(is_inner_only && self.masks.is_at_area_edge(pixel))
    }

    /// Largest number of pixels that a fit uses: `most`, or every pixel under the reading `every_pixel`.
    pub fn fit_samples(&self, most: usize) -> usize {
        if self.readings.every_pixel { usize::MAX } else { most }
    }

    /// The same input, of a file whose way of storing values makes an error of its own. `extended`: the errors of neighboring
    /// pixels are alike.
    #[must_use]
    pub fn with_coding(self, coding: Option<&'a CodingError>, extended: bool) -> Self {
        Self { coding, extended, ..self }
    }

    /// The same input, of a picture whose noise grows with the intensity.
    #[must_use]
    pub fn with_shot_noise(self, shot: Option<ShotNoise>) -> Self {
        Self { shot, ..self }
    }

    /// The same input with a condition that stops the stages: they return an incomplete result soon after `stop` returns true.
    #[must_use]
    pub fn stopped_by(self, stop: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { stop, ..self }
    }

    /// The same input for another part of the photograph.
    #[must_use]
    pub fn with_picture<'b>(&self, pixels: &'b Raster<[f32; 3]>, masks: &'b Masks) -> AnalysisInput<'b>
    where
        'a: 'b,
    {
        AnalysisInput { pixels, masks, ..*self }
    }

    /// The same input with other colors, for example those without the ambient light. The shape must be the same.
    #[must_use]
    pub fn with_pixels<'b>(&self, pixels: &'b Raster<[f32; 3]>) -> AnalysisInput<'b>
    where
        'a: 'b,
    {
        AnalysisInput { pixels, ..*self }
    }

    /// The condition that stops the stages.
    pub fn stopping(&self) -> &'a (dyn Fn() -> bool + Sync) {
        self.stop
    }

    /// Whether the stage is to stop. Stages ask once per hypothesis, per row, or per 64k pixels that a region grows from.
    pub fn stopped(&self) -> bool {
        (self.stop)()
    }

    /// Value from which on each band is clipped, counts above the ambient light `origin`.
    pub fn clip_thresholds(&self, origin: &[f64; 3]) -> [f32; 3] {
        origin.map(|band| (self.used.clip_threshold - band) as f32)
    }

    /// Standard deviation of a band's noise, counts: half of σ0.
    pub fn sigma(&self) -> f64 {
        self.used.camera_noise / 2.0
    }

    /// Standard deviation of a band's distance from the model around a mean color, counts: the noise at that intensity, and
    /// the error of the file's values where the tone curve has the slope of that intensity.
    pub fn fit_sigma(&self, mean: &Vec3) -> f64 {
        let intensity = mean.norm() / 3f64.sqrt();
        let noise = self.shot.map_or(self.sigma(), |shot| shot.sigma_at(mean.mean()));
        noise.hypot(self.coding.map_or(0.0, |coding| coding.at_intensity(intensity)))
    }

    /// Whether the values have an error of lossy compression, which is alike in neighboring pixels.
    pub fn has_extended_coding(&self) -> bool {
        self.coding.is_some_and(CodingError::is_extended)
    }

    /// Whether the missing bands of each pixel were interpolated, and the values not compressed after that.
    pub fn is_only_interpolated(&self) -> bool {
        self.extended && !self.has_extended_coding()
    }

    /// Standard deviation of the error that demosaicing, or the smaller resolution of chroma in a compressed file, makes in a band of a pixel,
    /// counts; 0 in other pictures. Where a band is linear from pixel to pixel its interpolation has no error: the error is a share of
    /// the second difference.
    pub fn interpolation_sigma(&self, pixel: usize) -> f32 {
        if self.extended || self.has_extended_coding() {
            // The largest of the squares of six second differences of noise is about twice their mean, 6 σ².
            let of_noise = 12.0 * self.sigma().powi(2) as f32;
            INTERPOLATION_SHARE * (self.largest_second_difference2(pixel) - of_noise).max(0.0).sqrt()
        } else {
            0.0
        }
    }

    /// The square of the largest second difference of a band along row and column, counts²; 0 across the border of the picture.
    fn largest_second_difference2(&self, pixel: usize) -> f32 {
        let (width, height) = (self.pixels.width(), self.pixels.height());
        let (x, y) = (pixel % width, pixel / width);
        let along = |step: usize, is_inside: bool| {
            if !is_inside {
                return 0.0;
            }
            let [before, here, after] = [pixel - step, pixel, pixel + step].map(|pixel| self.pixels[pixel]);
            (0..3).map(|band| (before[band] + after[band] - 2.0 * here[band]).powi(2)).fold(0.0, f32::max)
        };
        along(1, x > 0 && x + 1 < width).max(along(width, y > 0 && y + 1 < height))
    }

    /// Factor of the light's interval: pixels whose errors are alike say less than as many independent ones. Measured on 72
    /// compressed scenes each: twice the interval contains the light 96 times of 100 (once 80), 1.5 times without chroma
    /// subsampling.
    pub fn interval_widening(&self) -> f64 {
        match self.coding {
            Some(coding) if coding.is_extended() && coding.chroma_subsampled => 2.0,
            Some(coding) if coding.is_extended() => 1.5,
            _ => 1.0,
        }
    }

    /// How far the colors on both sides of a border are mixed, pixels.
    pub fn mixing_reach_px(&self) -> usize {
        match self.coding {
            Some(coding) if coding.is_extended() && coding.chroma_subsampled => 3,
            _ if self.extended => 2,
            _ => 1,
        }
    }

    /// Whether a hypothesis may claim the pixel by its color. The paper excludes only dark pixels; with `tail_test`, clipped
    /// and bloomed pixels wait for the clipping stage.
    #[inline]
    pub fn claimable(&self, pixel: usize) -> bool {
        self.masks.claimable_by_color(pixel, self.refine.tail_test)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::testing::Drawing;

    #[test]
    fn an_interpolated_band_has_an_error_where_it_is_not_linear_and_only_in_such_pictures() {
        // A slope of 4 counts a pixel, and from column 5 on one of 44 counts a pixel: a second difference of 40 counts.
        let drawing = Drawing::by_place(9, |x, _| Vec3::repeat(20.0 + 4.0 * x + 40.0 * (x - 5.0).max(0.0)));
        let plain = drawing.input();
        let interpolated = plain.with_coding(None, true);
        let of = |input: &AnalysisInput, x: usize| input.interpolation_sigma(4 * 9 + x);
        assert!(interpolated.is_only_interpolated() && !plain.is_only_interpolated());
        for x in 0..9 {
            assert!(of(&plain, x).abs() < f32::EPSILON, "column {x}");
            let noise = 12.0 * interpolated.sigma().powi(2) as f32;
            let expected = if x == 5 { 0.25 * (1600.0 - noise).sqrt() } else { 0.0 };
            assert!((of(&interpolated, x) - expected).abs() < 1e-3, "column {x}: {}", of(&interpolated, x));
        }
    }
}
