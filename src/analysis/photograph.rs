//! The photograph whose working picture the stages have seen.

use super::prepared::Prepared;
use crate::params::{Params, Rules, UsedParams};
use crate::photo::LinearImage;
use crate::segment::AnalysisInput;
use std::sync::Arc;

/// The photograph, as the stages read it.
#[derive(Clone, Copy)]
pub(super) struct Photograph<'a> {
    /// Masks, working picture and noise.
    pub(super) prepared: &'a Prepared,
    /// The photograph; its noise is that of a single pixel.
    pub(super) input: AnalysisInput<'a>,
    /// The colors.
    pub(super) image: &'a Arc<LinearImage>,
    /// What was asked for.
    pub(super) params: &'a Params,
    /// The parameters of the working picture.
    pub(super) used: &'a UsedParams,
    /// The switches of the method.
    pub(super) rules: Rules,
}
