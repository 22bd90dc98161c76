//! Which pixels are believed (section 4).

use super::{EventData, Subject};
use crate::photo::MaskLimits;

/// The masks of dark, clipped and bloomed pixels were made (section 4).
#[derive(Clone, Debug, PartialEq)]
pub struct MasksMade {
    /// The limits that pixels were held against.
    pub limits: MaskLimits,
    /// Pixels too dark to be analyzed, invalid ones and those outside the area included.
    pub dark: u32,
    /// Other pixels that are clipped or bloomed.
    pub distorted: u32,
    /// Standard deviation of a band's noise that the image told, counts; none where it was not asked or could not be told.
    pub sigma: Option<f64>,
}

impl EventData for MasksMade {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}
