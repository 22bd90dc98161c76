//! What the report says of each region.

use super::words::sentences;
use crate::intrinsic::{HighlightBranch, RegionReflection};
use serde::{Deserialize, Serialize};

/// One region, as [`RegionReflection`] describes it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "RegionReflection describes each")]
#[non_exhaustive]
pub struct RegionFacts {
    pub id: u16,
    pub pixels: usize,
    pub matte_pixels: usize,
    pub highlight_pixels: usize,
    pub clipped_pixels: usize,
    pub body: [f64; 3],
    pub surface: Option<[f64; 3]>,
    pub matte_mean: [f64; 3],
    pub highlight_start: Option<[f64; 3]>,
    /// Empty in reports of versions that did not search for branches.
    #[serde(default)]
    pub highlight_branches: Vec<HighlightBranchFacts>,
    pub plane_normal: Option<[f64; 3]>,
    pub angle_deg: Option<f64>,
    pub fit_rms_counts: f64,
    #[serde(default)]
    pub fit_sigma_counts: f64,
    #[serde(default)]
    pub fit_limit_counts: f64,
    /// True in reports of versions that did not test the fit.
    #[serde(rename = "holds", default = "yes")]
    pub model_fits: bool,
    #[serde(default)]
    pub confidence: f64,
    #[serde(default)]
    pub texture: f64,
    pub separable: bool,
    #[serde(alias = "neighbours")]
    pub neighbors: Vec<u16>,
    pub warnings: Vec<String>,
}

/// One highlight line of a region, as [`HighlightBranch`] describes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "HighlightBranch describes each")]
#[non_exhaustive]
pub struct HighlightBranchFacts {
    pub start_counts: [f64; 3],
    pub body_counts: f64,
    pub pixels: usize,
    pub share: f64,
}

impl From<&HighlightBranch> for HighlightBranchFacts {
    fn from(branch: &HighlightBranch) -> Self {
        Self {
            start_counts: branch.start,
            body_counts: branch.body,
            pixels: branch.pixels,
            share: branch.share,
        }
    }
}

const fn yes() -> bool {
    true
}

impl From<&RegionReflection> for RegionFacts {
    fn from(region: &RegionReflection) -> Self {
        Self {
            id: region.id.get(),
            pixels: region.pixels,
            matte_pixels: region.matte_pixels,
            highlight_pixels: region.highlight_pixels,
            clipped_pixels: region.clipped_pixels,
            body: region.body,
            surface: region.surface,
            matte_mean: region.matte_mean,
            highlight_start: region.highlight_start,
            highlight_branches: region.highlight_branches.iter().map(HighlightBranchFacts::from).collect(),
            plane_normal: region.plane_normal,
            angle_deg: region.angle_deg,
            fit_rms_counts: region.fit_rms_counts,
            fit_sigma_counts: region.fit_sigma_counts,
            fit_limit_counts: region.fit_limit_counts,
            model_fits: region.model_fits(),
            confidence: region.confidence,
            texture: region.texture,
            separable: region.separable,
            neighbors: region.neighbors.iter().map(|id| id.get()).collect(),
            warnings: sentences(&region.warnings),
        }
    }
}
