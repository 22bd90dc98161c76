//! Pictures of the photograph and of what was found in it, as the image view shows them.
//!
//! Values are sRGB with straight alpha. An overlay ([`Layer::is_overlay`]) is drawn over the photograph, as fills or as
//! outlines one pixel wide inside each area; every other layer replaces the photograph. The table of the layers is in
//! `layers/table.rs`: a new layer is a row there and a function in `layers/painters.rs`.

mod curve;
mod instant;
mod legends;
mod marks;
mod painters;
mod pyramid;
mod table;

pub use instant::{beside_color, instant_legend, paint_instant};
pub use legends::{LegendEntry, class_entries};
pub use marks::{ACCENT, marks};
pub use pyramid::pyramid;
pub use table::Layer;

use super::{Fill, ImageSettings, Picture, ResultSnapshot};
use crate::intrinsic::Intrinsic;
use crate::raster::Raster;
pub(crate) use curve::Curve;
use painters::{Base, PaintInput};
use table::LayerKind;

/// Body reflection that differs by this many counts is black or white in [`Layer::Difference`].
pub const DIFFERENCE_COUNTS: f32 = 64.0;

/// Share of their opacity that regions keep while another region is selected.
const DIMMED: f32 = 0.35;

/// The colors of `layer` that need explaining; none where it shows light, or regions, whose colors are in their table.
pub fn legend(layer: Layer) -> Vec<LegendEntry> {
    layer.row().legend.to_vec()
}

impl Layer {
    /// Its name on buttons.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// What it shows, with the paper's section: a tooltip.
    pub const fn tip(self) -> &'static str {
        self.row().tip
    }

    /// Whether it is drawn over the photograph, as fills or outlines, rather than in its place.
    pub const fn is_overlay(self) -> bool {
        matches!(self.row().kind, LayerKind::Overlay | LayerKind::RegionOverlay)
    }

    /// Whether its picture depends on a result.
    pub const fn needs_result(self) -> bool {
        !matches!(self.row().kind, LayerKind::Photograph)
    }

    /// Whether it compares the result with the pinned one.
    pub const fn needs_pinned(self) -> bool {
        matches!(self.row().kind, LayerKind::Comparison)
    }

    /// Whether it dims the regions that are not selected.
    pub const fn dims_regions(self) -> bool {
        matches!(self.row().kind, LayerKind::RegionOverlay)
    }

    /// Its numbers at a pixel, counts or a share; none where it has no numbers of its own.
    pub fn numbers(self, intrinsic: &Intrinsic, pixel: usize) -> Option<Vec<f32>> {
        self.row().numbers.map(|numbers| numbers(intrinsic, pixel))
    }
}

/// How layers are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Stops; light is brighter by this power of two. It is the gain of [`Layer::Noise`] and [`Layer::Difference`] as well.
    pub exposure_ev: f32,
    /// sRGB values in 0…1 are raised to its inverse: above 1 the middle tones are brighter.
    pub gamma: f32,
    /// Fills or outlines.
    pub fill: Fill,
    /// Opacity of fills, 0…1; outlines are opaque.
    pub opacity: f32,
    /// The region of the result shown that has its full color while all others are dimmed; none: all have theirs.
    pub selected: Option<u16>,
}

impl Look {
    /// The look of the image view's settings.
    pub fn of(settings: &ImageSettings, selected: Option<u16>) -> Self {
        let &ImageSettings { exposure_ev, gamma, fill, opacity, .. } = settings;
        Self { exposure_ev, gamma, fill, opacity, selected }
    }

    /// A color with its weight over the photograph.
    fn style(&self, color: [u8; 3], selected: bool) -> [u8; 4] {
        let full = if self.fill == Fill::Fill { self.opacity.clamp(0.0, 1.0) } else { 1.0 };
        let weight = if selected { full } else { full * DIMMED };
        [color[0], color[1], color[2], (weight * 255.0).round() as u8]
    }
}

impl Default for Look {
    fn default() -> Self {
        Self::of(&ImageSettings::default(), None)
    }
}

/// Draws `layer`, a pixel a pixel, opaque.
///
/// A layer that needs a result is the photograph itself while `shown` has none of the photograph's size.
/// [`Layer::Difference`] is gray where there is no `pinned` result to compare with.
pub fn paint(
    layer: Layer,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    pinned: Option<&ResultSnapshot>,
    look: &Look,
) -> Raster<[u8; 4]> {
    let fits = |shown: &&ResultSnapshot| shown.picture.size() == picture.size();
    let base = Base { photo: &picture.photo.image.pixels, curve: Curve::new(look.exposure_ev, look.gamma) };
    match shown.filter(fits) {
        None => base.light(base.photo),
        Some(shown) => (layer.row().paint)(&PaintInput { base, shown, pinned: pinned.filter(fits), look }),
    }
}

#[cfg(test)]
mod tests;
