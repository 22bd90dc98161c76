//! The appearance of layers: exposure, fills and outlines, opacity.

use crate::raster::RegionId;
use serde::{Deserialize, Serialize};

/// Difference of body reflection that is black or white in [`super::Layer::Difference`], counts.
pub const DIFFERENCE_COUNTS: f32 = 64.0;

/// Share of their opacity that regions keep while another region is selected.
const DIMMED: f32 = 0.35;

/// The two ways of drawing areas over the photograph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fill {
    /// Areas filled with their color.
    #[default]
    Fill,
    /// Outlines of the areas.
    Outline,
}

/// The appearance of a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Exposure, stops: light is multiplied by two to this power. Also the gain of [`super::Layer::Noise`] and
    /// [`super::Layer::Difference`].
    pub exposure_ev: f32,
    /// Gamma of the display: sRGB values in 0…1 are raised to its inverse, so that middle tones are brighter above 1.
    pub gamma: f32,
    /// Fills or outlines.
    pub fill: Fill,
    /// Opacity of fills, 0…1; outlines are opaque.
    pub opacity: f32,
    /// The region of the result shown that has its full color while all others are dimmed; none: no region is dimmed.
    pub selected: Option<RegionId>,
}

impl Look {
    /// A color, and the weight with which the color is drawn over the photograph.
    pub(super) fn style(&self, color: [u8; 3], selected: bool) -> [u8; 4] {
        let full = if self.fill == Fill::Fill { self.opacity.clamp(0.0, 1.0) } else { 1.0 };
        let weight = if selected { full } else { full * DIMMED };
        [color[0], color[1], color[2], (weight * 255.0).round() as u8]
    }
}

impl Default for Look {
    fn default() -> Self {
        Self { exposure_ev: 0.0, gamma: 1.0, fill: Fill::Fill, opacity: 0.75, selected: None }
    }
}
