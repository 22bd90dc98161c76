//! The regions at full resolution: each pixel of the photograph takes a region of the working picture (no counterpart in the
//! paper).
//!
//! Inside of a region, where the 3 × 3 working pixels around a pixel have one label, the pixel takes that label. At a border the
//! pixel takes the region, of those of the 3 × 3 working pixels, whose skewed T the pixel's color fits best, and no region where
//! the color fits none: the means of a block at a border are mixtures of two colors, the pixels of the block are mostly not.
//! Dark pixels are in no region. The color of a clipped or bloomed pixel tells nothing; such a pixel takes the region
//! of its working pixel.
//!
//! The fit is the distance from the matte line, or from the dichromatic plane plus [`OFF_MATTE_SIGMAS`]: planes are large, and
//! the matte pixels of one region lie in the planes of others by chance. The working pixel's own region is preferred by
//! [`OWN_SIGMAS`], so that noise does not scatter the border between two similar regions.

use super::input::AnalysisInput;
use super::planar_hypothesis::PlanarHypothesis;
use super::regions::FinalRegions;
use crate::color::Cylinder;
use crate::photo::Masks;
use crate::raster::{Blocks, LabelMap, RegionId, UNASSIGNED};
use crate::reflection::Slice;
use rayon::prelude::*;

/// Radius of the cylinder around a matte line, standard deviations of the noise of a single pixel.
const RADIUS_SIGMAS: f64 = 4.0;
/// What a color in a slice but not in the cylinder of the matte line counts as farther, standard deviations of the noise.
const OFF_MATTE_SIGMAS: f64 = 2.0;
/// What the working pixel's own region counts as nearer, standard deviations of the noise.
const OWN_SIGMAS: f64 = 1.0;

/// The region of each pixel of the photograph `input`, whose blocks of pixels are the working pixels that `working` labels. The noise
/// of `input` is that of a single pixel.
pub fn full_resolution_labels(input: &AnalysisInput, working: &FinalRegions, blocks: &Blocks) -> LabelMap {
    let choice = BorderChoice::new(input, working);
    let [width, height] = blocks.picture();
    let mut labels = LabelMap::filled(width, height, UNASSIGNED);
    let rows = labels.as_mut_slice().par_chunks_mut((width * blocks.side()).max(1)).enumerate();
    rows.for_each(|(row, labels)| {
        if input.stopped() {
            return;
        }
        let top = row * blocks.side();
        for column in 0..blocks.columns() {
            let places = Places::around(&working.labels, row * blocks.columns() + column);
            for y in blocks.pixel_rows(row) {
                for x in blocks.pixel_columns(column) {
                    labels[(y - top) * width + x] = choice.label(input, y * width + x, &places);
                }
            }
        }
    });
    labels
}

/// What the pass at full resolution made of a pixel of the photograph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelPlace {
    /// Side of the working pixel that contains the pixel, pixels.
    pub side: usize,
    /// Region of the working pixel; none: in no region.
    pub working_region: Option<RegionId>,
    /// Region that the pixel took; none: in no region.
    pub region: Option<RegionId>,
    /// What decided.
    pub rule: PlaceRule,
}

/// By what a pixel of the photograph took its region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceRule {
    /// The pixel is dark, invalid or outside of the area, and in no region.
    Dark,
    /// The pixel is clipped or bloomed, and takes the region of the working pixel.
    Distorted,
    /// The working pixels around have one label, and the pixel takes that label.
    Inside,
    /// The working pixels around have several labels; the pixel takes the region that its color fits best, or none.
    Border,
    /// The pixel takes a region of the second look, whose picture has blocks of `side` pixels.
    SecondLook {
        /// Side of a block, pixels.
        side: usize,
    },
}

impl PlaceRule {
    /// The rule that decides pixel `pixel` of a photograph with `masks`, whose working pixel lies at `places`. Regions of the second look
    /// are found later.
    #[inline]
    fn of(pixel: usize, masks: &Masks, places: &Places) -> Self {
        if masks.dark(pixel) {
            Self::Dark
        } else if masks.distorted(pixel) {
            Self::Distorted
        } else if places.others().is_empty() {
            Self::Inside
        } else {
            Self::Border
        }
    }
}

impl PixelPlace {
    /// The place of pixel `pixel` of a photograph with `masks` and regions `labels`, whose working picture has the regions `working`.
    pub fn of(pixel: usize, masks: &Masks, labels: &LabelMap, working: &LabelMap, blocks: &Blocks) -> Self {
        let places = Places::around(working, blocks.block_of(pixel));
        Self {
            side: blocks.side(),
            working_region: RegionId::from_label(places.own),
            region: RegionId::from_label(labels[pixel]),
            rule: PlaceRule::of(pixel, masks, &places),
        }
    }
}

/// The labels of a working pixel and of its eight neighbors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Places {
    /// The label of the working pixel itself.
    pub own: u16,
    /// The labels around the working pixel that differ from `own`, without repetition; the first `others_count` count.
    others: [u16; 8],
    others_count: usize,
}

impl Places {
    /// Of the working pixel `index` of a label map.
    pub fn around(labels: &LabelMap, index: usize) -> Self {
        let own = labels[index];
        let mut places = Self { own, others: [UNASSIGNED; 8], others_count: 0 };
        for near in labels.around(index) {
            let label = labels[near];
            if label != own && !places.others().contains(&label) {
                places.others[places.others_count] = label;
                places.others_count += 1;
            }
        }
        places
    }

    /// The labels around that differ from the working pixel's own.
    pub fn others(&self) -> &[u16] {
        &self.others[..self.others_count]
    }
}

/// Which region a pixel at a border takes.
pub struct BorderChoice {
    /// The regions, by [`RegionId::index`].
    regions: Vec<Reach>,
    /// Standard deviation of the noise of a single pixel, counts.
    sigma: f64,
}

/// The colors that one region reaches.
struct Reach {
    matte: Cylinder,
    /// None for a region without a dichromatic plane.
    slice: Option<Slice>,
}

impl Reach {
    fn new(input: &AnalysisInput, hypothesis: &PlanarHypothesis) -> Self {
        let radius = RADIUS_SIGMAS * input.sigma();
        let half_width = input.used.slice_half_width_counts();
        let slice =
            hypothesis.plane.map(|plane| Slice::bounded(&plane, half_width, radius, hypothesis.matte_length));
        Self { matte: Cylinder::new(&hypothesis.matte, radius), slice }
    }

    /// How far a color is from the skewed T of the region, standard deviations of the noise; none for a color that it does not reach.
    fn distance(&self, color: [f32; 3], sigma: f64) -> Option<f64> {
        let in_sigmas = |counts: f32| f64::from(counts) / sigma.max(1e-9);
        if self.matte.contains(color) {
            return Some(in_sigmas(self.matte.distance2(color).sqrt()));
        }
        let slice = self.slice.as_ref().filter(|slice| slice.contains(color))?;
        Some(in_sigmas(slice.distance(color)) + OFF_MATTE_SIGMAS)
    }
}

impl BorderChoice {
    /// The choice between the regions of `working`, for the pixels of the photograph `input`.
    pub fn new(input: &AnalysisInput, working: &FinalRegions) -> Self {
        let regions = working.hypotheses.iter().map(|hypothesis| Reach::new(input, hypothesis)).collect();
        Self { regions, sigma: input.sigma() }
    }

    /// The label of pixel `pixel` of the photograph `input`, whose working pixel lies at `places`.
    #[inline]
    pub fn label(&self, input: &AnalysisInput, pixel: usize, places: &Places) -> u16 {
        match PlaceRule::of(pixel, input.masks, places) {
            PlaceRule::Dark => UNASSIGNED,
            PlaceRule::Border => self.nearest(input.pixels[pixel], places),
            PlaceRule::Distorted | PlaceRule::Inside | PlaceRule::SecondLook { .. } => places.own,
        }
    }

    /// The label of the region that fits a color best; of none where the color fits none. Of equally near regions the working pixel's
    /// own is taken, then the first.
    fn nearest(&self, color: [f32; 3], places: &Places) -> u16 {
        let mut best = (f64::INFINITY, UNASSIGNED);
        let own = std::iter::once((places.own, OWN_SIGMAS));
        for (label, bonus) in own.chain(places.others().iter().map(|&label| (label, 0.0))) {
            let reach = RegionId::from_label(label).and_then(|region| self.regions.get(region.index()));
            let distance = reach.and_then(|reach| reach.distance(color, self.sigma));
            if let Some(distance) = distance.map(|distance| distance - bonus).filter(|&near| near < best.0) {
                best = (distance, label);
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Line, Vec3};
    use crate::raster::HypothesisId;
    use crate::reflection::DichromaticPlane;
    use crate::segment::LightFindings;
    use crate::segment::testing::Drawing;

    fn red() -> Vec3 {
        Vec3::new(0.9, 0.3, 0.2).normalize()
    }

    fn green() -> Vec3 {
        Vec3::new(0.2, 0.9, 0.3).normalize()
    }

    fn regions(labels: LabelMap) -> FinalRegions {
        let hypothesis = |(index, body): (usize, Vec3)| {
            let matte = Line::new(body * 100.0, body);
            PlanarHypothesis {
                origin: HypothesisId::from_index(index),
                matte,
                matte_length: 200.0,
                plane: DichromaticPlane::new(&matte, &Vec3::repeat(1.0)),
                start: body * 120.0,
                highlight: None,
                alive: true,
            }
        };
        let hypotheses = [red(), green()].into_iter().enumerate().map(hypothesis).collect();
        FinalRegions { labels, hypotheses, light: LightFindings::default(), second_lamp_mask: None }
    }

    /// The labels of a photograph in which `r` and `g` are matte, `h` is red with a highlight, `b` blue, `w` clipped and `.` dark. Blocks
    /// have two pixels a side and the labels `working`.
    fn labels(rows: &[&str], working: &[u16], columns: usize) -> Vec<u16> {
        let drawing = Drawing::new(rows, |c| match c {
            'r' => red() * 120.0,
            'g' => green() * 120.0,
            'h' => red() * 120.0 + Vec3::repeat(50.0),
            'b' => Vec3::new(10.0, 20.0, 150.0),
            'w' => Vec3::repeat(255.0),
            _ => Vec3::zeros(),
        });
        let blocks = Blocks::new(2, rows[0].len(), rows.len());
        let map = LabelMap::from_vec(columns, working.len() / columns, working.to_vec()).unwrap();
        full_resolution_labels(&drawing.input(), &regions(map), &blocks).into_vec()
    }

    #[test]
    fn a_pixel_at_a_border_takes_the_region_of_its_color() {
        let found = labels(&["rrrggg", "rrhggg"], &[1, 1, 2], 3);
        assert_eq!(found, [1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2]);
    }

    #[test]
    fn a_pixel_that_fits_no_region_around_is_in_none() {
        assert_eq!(labels(&["rrbggg"], &[1, 1, 2], 3), [1, 1, 0, 2, 2, 2]);
        assert_eq!(labels(&["rr.ggg"], &[1, 1, 2], 3), [1, 1, 0, 2, 2, 2]);
        assert_eq!(labels(&["bbbrrr"], &[0, 0, 1], 3), [0, 0, 0, 1, 1, 1]);
    }

    #[test]
    fn inside_of_a_region_only_dark_pixels_are_in_none() {
        assert_eq!(labels(&["rb.r"], &[1, 1], 2), [1, 1, 0, 1]);
    }

    #[test]
    fn a_clipped_pixel_takes_the_region_of_its_working_pixel() {
        assert_eq!(labels(&["rrrwgg"], &[1, 1, 2], 3)[3], 1);
        assert_eq!(labels(&["rrrwgg"], &[1, 2, 2], 3)[3], 2);
    }

    #[test]
    fn a_region_that_is_not_around_is_not_taken() {
        assert_eq!(labels(&["ggrrrrrr"], &[1, 1, 1, 2], 4)[..2], [1, 1], "green is two blocks away");
    }
}
