//! Section 5.4: the planar hypothesis of a region (its skewed T), and the output of the planar stage.

use super::light::{Illuminant, LightFindings};
use crate::color::{Line, Vec3};
use crate::raster::{HypothesisId, LabelMap, Mask};
use crate::reflection::{DichromaticPlane, HighlightTest};
use std::sync::Arc;

/// The skewed T of a region: a matte line, and a highlight line that leaves the matte line towards the illuminant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlanarHypothesis {
    /// The linear hypothesis that the region comes from: its label in [`MatteRegions`](super::MatteRegions), of a region of the
    /// second look in the matte regions of that look, which are not kept.
    pub origin: HypothesisId,
    /// Matte line: the axis of the linear hypothesis's cylinder.
    pub matte: Line,
    /// Length of the matte line from black, counts.
    pub matte_length: f64,
    /// Plane of matte line and illuminant; `None` where no illuminant is known or the region is not extended to a plane.
    pub plane: Option<DichromaticPlane>,
    /// Point of the matte line at which the highlight line begins, counts.
    pub start: Vec3,
    /// Unit direction of the region's own highlight cluster; `None` where no highlight candidate was accepted.
    pub highlight: Option<Vec3>,
    /// Whether the region still exists: false after it was absorbed, merged into another region or dropped.
    pub alive: bool,
}

/// Place on the matte line, as a share of its length, where the highlight line of a region without a highlight candidate begins.
const DEFAULT_START: f64 = 0.75;

impl PlanarHypothesis {
    /// The point where the highlight line of a region without a highlight candidate begins, counts. `matte_length`: length of the matte
    /// line from black, counts.
    pub(crate) fn default_start(matte: &Line, matte_length: f64) -> Vec3 {
        matte.foot() + matte.direction * (DEFAULT_START * matte_length)
    }

    /// The same hypothesis with colors measured from `origin` (counts) instead of black.
    #[must_use]
    pub fn from_origin(&self, origin: &Vec3) -> Self {
        let moved = |line: Line| Line { mean: line.mean - origin, ..line };
        let matte_length = self.matte_length - self.matte.direction.dot(origin);
        let plane = self.plane.map(|plane| DichromaticPlane { matte: moved(plane.matte), ..plane });
        Self { matte: moved(self.matte), matte_length, plane, start: self.start - origin, ..*self }
    }

    /// The test whether a pixel of the region is highlight or matte (section 6); `None` without a plane.
    pub fn highlight_test(&self) -> Option<HighlightTest> {
        let plane = self.plane.as_ref()?;
        Some(HighlightTest::of_lines(&self.matte, &[self.start], &plane.surface))
    }
}

/// Output of the planar stage.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlanarRegions {
    /// Region of each pixel.
    pub labels: LabelMap,
    /// One hypothesis per linear hypothesis, in the same order.
    pub hypotheses: Vec<PlanarHypothesis>,
    /// The illuminant; `None` where no highlight gave evidence of its color.
    pub illuminant: Option<Illuminant>,
    /// Both estimates of the illuminant, and the evidence for each.
    pub light: LightFindings,
    /// The pixels that the second lamp lights; `None` with one lamp.
    pub second_lamp_mask: Option<Arc<Mask>>,
}
