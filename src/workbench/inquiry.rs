//! What if: a question to the analysis, asked again and again with other parameters.

use crate::analysis::WhatIf;
use std::sync::Arc;

/// How far parameters would have to move for a pixel to end otherwise.
#[derive(Clone, Debug)]
pub struct Inquiry {
    /// What was asked.
    pub asked: Asked,
    /// Analyses made, and in all.
    pub done: usize,
    /// Analyses that are to be made.
    pub total: usize,
    /// The answers; none until all are there.
    pub found: Option<Arc<Vec<WhatIf>>>,
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The pixel, row-major.
    pub pixel: u32,
    /// The result that it was asked of.
    pub generation: u64,
}

impl Inquiry {
    /// A question that nothing has been done for.
    pub(super) fn new(asked: Asked) -> Self {
        Self { asked, done: 0, total: 0, found: None }
    }
}

/// News of an inquiry.
#[derive(Clone, Debug)]
pub enum InquiryNews {
    /// It goes on: analyses made, of how many.
    Progress(usize, usize),
    /// It has ended.
    Found(Vec<WhatIf>),
    /// It was stopped.
    Stopped,
}
