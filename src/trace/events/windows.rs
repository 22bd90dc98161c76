//! Windows and the areas that they merge into (section 5.2).

use super::EventData;
use crate::trace::{Class, Measured};

/// A grid of windows was laid over the picture; the windows that follow belong to this grid.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WindowsLaid {
    /// Side of a window, pixels.
    pub size_px: u32,
    /// Windows in a row.
    pub columns: u32,
    /// Rows of windows.
    pub rows: u32,
    /// Fewest valid pixels of a window that gets a class.
    pub least_pixels: u32,
    /// Camera noise σ0 of the χ² tests, counts.
    pub camera_noise: f64,
    /// Whether windows are classified by the tail test (refinement `tail_test`).
    pub tail_test: bool,
}

impl WindowsLaid {
    /// Index of the window that holds a pixel of a picture `width` pixels wide.
    pub fn window_of(&self, pixel: usize, width: usize) -> usize {
        let size = (self.size_px as usize).max(1);
        let width = width.max(1);
        pixel / width / size * self.columns as usize + pixel % width / size
    }
}

/// A window was classified (section 5.2.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WindowClassified {
    /// Index of the window, row-major.
    pub window: u32,
    /// Valid pixels in the window.
    pub pixels: u32,
    /// Variances along the principal axes, counts², largest first.
    pub eigenvalues: [f32; 3],
    /// Statistic of the test that decided the class, and its χ² quantile: the test after which no direction was left but
    /// noise, or the last test.
    pub chi_square: Measured<f32>,
    /// Class of the window; `None` when it holds too few valid pixels.
    pub class: Option<Class>,
}

/// Two neighboring areas were tested for union (section 5.2.2).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MergeTried {
    /// First window of the area that would remain.
    pub into: u32,
    /// First window of the area that would vanish.
    pub from: u32,
    /// Valid pixels of the area that would remain, and of the area that would vanish.
    pub pixels: [u32; 2],
    /// Variances of the union along its principal axes, counts², largest first.
    pub eigenvalues: [f32; 3],
    /// Statistic of the test that decided the union's class, and its χ² quantile: the test after which no direction was
    /// left but noise, or the last test.
    pub chi_square: Measured<f32>,
    /// Class of both areas.
    pub class: Class,
    /// Class of the union: the areas merge when it equals `class`.
    pub union: Class,
}

impl EventData for WindowsLaid {}

impl EventData for WindowClassified {}

impl EventData for MergeTried {}
