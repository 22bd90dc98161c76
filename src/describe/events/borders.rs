//! The surface reflection at the borders between regions (beyond section 5.6).

use super::{Describe, LineObjects, nothing};
use crate::describe::names::short;
use crate::describe::{Names, counted};
#[cfg(test)]
use crate::raster::PixelIndex;
use crate::trace::BordersLimited;
#[cfg(test)]
use crate::trace::LimitedPixel;
use serde_json::json;

impl Describe for BordersLimited {
    fn sentence(&self, _names: &Names) -> String {
        format!(
            "{} within {} px of another region keep {:.0} % of their surface reflection, as much as the pixels further inside have: \
             their colors are mixed",
            counted(self.pixels.len(), "pixel"),
            self.reach_px,
            100.0 * mean_kept(self)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"pixels": self.pixels.len(), "kept": short(mean_kept(self))}),
            json!({"reach": self.reach_px}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { reach_px: 2, pixels: vec![LimitedPixel { pixel: PixelIndex::from_index(7), kept: 0.25 }] }
    }
}

/// Mean share of the surface reflection that stays, 0…1; 1 where no pixel was limited.
fn mean_kept(limited: &BordersLimited) -> f32 {
    if limited.pixels.is_empty() {
        return 1.0;
    }
    limited.pixels.iter().map(|pixel| pixel.kept).sum::<f32>() / limited.pixels.len() as f32
}
