//! The surface reflection at the borders between regions (refinement `border_mixtures`, beyond section 5.6).

use super::EventData;
use crate::raster::PixelIndex;

/// The surface reflection of pixels near other regions was limited (refinement `border_mixtures`).
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct BordersLimited {
    /// How far a border mixes the colors of both sides, pixels along each axis.
    pub reach_px: u32,
    /// The limited pixels, ascending.
    pub pixels: Vec<LimitedPixel>,
}

/// A pixel whose surface reflection was limited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitedPixel {
    /// The pixel.
    pub pixel: PixelIndex,
    /// Share of its surface reflection that stays, 0…1; the rest is body reflection.
    pub kept: f32,
}

impl BordersLimited {
    /// Share of the surface reflection of a pixel that stays; none where the pixel was not limited.
    pub fn kept(&self, pixel: PixelIndex) -> Option<f32> {
        let place = self.pixels.binary_search_by_key(&pixel, |limited| limited.pixel).ok()?;
        Some(self.pixels[place].kept)
    }
}

impl EventData for BordersLimited {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.pixels.as_slice())
    }
}
