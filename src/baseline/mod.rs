//! The systems that the paper is held against: they find regions, and no reflection.
//!
//! [`Baseline::Phoenix`] splits regions by valleys in the histograms of color features (section 7.2, color figure 15).
//! [`Baseline::TopDown`] clusters the histogram of the whole picture, the way that section 5.1 rejects. Both give their regions the form of
//! linear hypotheses without planes, so that the later stages, the trace and the window show them like the regions of the paper's
//! method. Gershon's test (section 5.4.1) is a test of the paper's own candidates and stands in `segment/candidates`.

mod histogram;
mod patches;
mod phoenix;
mod region_list;
mod regions;
mod top_down;

pub use regions::{baseline_regions, regions_without_planes};

#[cfg(doc)]
use crate::params::Baseline;
