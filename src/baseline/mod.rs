//! The systems that the paper is held against.
//!
//! [`Baseline::Phoenix`] splits regions by valleys in the histograms of color features (section 7.2, color figure 15).
//! [`Baseline::TopDown`] clusters the histogram of the whole picture, the way that section 5.1 rejects. Both find regions and no reflection, and give their regions the form of
//! linear hypotheses without planes, so that the later stages, the trace and the window show them like the regions of the paper's
//! method. [`Baseline::ByHand`] fits a skewed T to pixels that a person has marked (section 6). Gershon's test (section 5.4.1) is a test of the paper's own candidates and stands in `segment/candidates`.

mod by_hand;
mod histogram;
mod patches;
mod phoenix;
mod region_list;
mod regions;
mod skewed_t_fit;
mod top_down;

pub use by_hand::{
    LEAST_MARKED_PX, MarkedSkewedT, NoSkewedT, marked_labels, marked_matte_region, marked_planar_region,
    marked_region_with_distorted, no_skewed_t,
};
pub use regions::{baseline_regions, regions_without_planes};

#[cfg(doc)]
use crate::params::Baseline;
