//! Pictures of the photograph and of a result, as the image view shows them.
//!
//! Values are sRGB with straight alpha. An overlay ([`Layer::is_overlay`]) is drawn over the photograph, as fills or as
//! outlines one pixel wide inside each area; every other layer replaces the photograph. The table of the layers is in
//! `layers/table.rs`: a new layer is a row there and a function in `layers/painters.rs`.

mod curve;
mod instant;
mod legends;
mod look;
mod marks;
mod painters;
mod pyramid;
mod table;
mod values;

pub use instant::{instant_legend, paint_instant};
pub use legends::{class_entries, reason_entry};
pub use look::{DIFFERENCE_COUNTS, Fill, Look};
pub use marks::marks;
pub use pyramid::pyramid;
pub use table::Layer;
pub(crate) use values::layer_floats;

use super::{Elsewhere, ElsewhereKind, ElsewherePixel, LegendEntry, Picture, ResultSnapshot};
use crate::intrinsic::Intrinsic;
use crate::raster::Raster;
pub(crate) use curve::Curve;
use painters::{Base, PaintInput};
use table::LayerKind;

/// The legend of `layer`; empty where the layer shows light, or regions, whose colors are in the table of the regions.
pub fn legend(layer: Layer) -> Vec<LegendEntry> {
    layer.row().legend.to_vec()
}

impl Layer {
    /// The name on buttons.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// What the layer shows, with the section of the paper: a tooltip.
    pub const fn tip(self) -> &'static str {
        self.row().tip
    }

    /// Whether the layer is drawn over the photograph, as fills or outlines, and not in place of the photograph.
    pub const fn is_overlay(self) -> bool {
        matches!(
            self.row().kind,
            LayerKind::Overlay | LayerKind::LampOverlay | LayerKind::RegionOverlay | LayerKind::LabelOverlay
        )
    }

    /// Whether the picture depends on a result.
    pub const fn needs_result(self) -> bool {
        !matches!(self.row().kind, LayerKind::Photograph)
    }

    /// What the layer compares the result with; none where the layer compares nothing.
    pub const fn need(self) -> Option<LayerNeed> {
        match self.row().kind {
            LayerKind::Comparison => Some(LayerNeed::Pinned),
            LayerKind::LabelOverlay => Some(LayerNeed::Elsewhere(ElsewhereKind::Labels)),
            LayerKind::Diffuse => Some(LayerNeed::Elsewhere(ElsewhereKind::Diffuse)),
            LayerKind::Photograph
            | LayerKind::Result
            | LayerKind::Overlay
            | LayerKind::LampOverlay
            | LayerKind::RegionOverlay => None,
        }
    }

    /// Whether the layer is empty where one lamp lights the scene.
    pub const fn needs_second_lamp(self) -> bool {
        matches!(self.row().kind, LayerKind::LampOverlay)
    }

    /// Whether the layer dims the regions that are not selected.
    pub const fn dims_regions(self) -> bool {
        matches!(self.row().kind, LayerKind::RegionOverlay)
    }

    /// The numbers of the layer at a pixel, counts or a share; none where the layer has no numbers of its own.
    pub fn numbers(self, of: LayerPixels, pixel: usize) -> Option<Vec<f32>> {
        self.row().numbers.map(|numbers| numbers(of, pixel)).filter(|numbers| !numbers.is_empty())
    }
}

/// What a layer compares the result with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerNeed {
    /// The pinned result.
    Pinned,
    /// A picture of another program.
    Elsewhere(ElsewhereKind),
}

/// The pictures that the numbers of a layer are read from.
#[derive(Clone, Copy, Debug)]
pub struct LayerPixels<'a> {
    /// Body and surface reflection, noise and confidence.
    pub intrinsic: &'a Intrinsic,
    /// What was made elsewhere.
    pub elsewhere: Option<&'a Elsewhere>,
}

impl LayerPixels<'_> {
    /// The values of another program at a pixel.
    fn elsewhere_at(&self, pixel: usize) -> ElsewherePixel {
        self.elsewhere.map_or_else(ElsewherePixel::default, |elsewhere| elsewhere.at(pixel))
    }
}

/// What a layer may compare the result with.
#[derive(Clone, Copy, Debug, Default)]
pub struct Against<'a> {
    /// The pinned result.
    pub pinned: Option<&'a ResultSnapshot>,
    /// What was made elsewhere.
    pub elsewhere: Option<&'a Elsewhere>,
}

/// As [`paint_against`], with nothing made elsewhere.
pub fn paint(
    layer: Layer,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    pinned: Option<&ResultSnapshot>,
    look: &Look,
) -> Raster<[u8; 4]> {
    paint_against(layer, picture, shown, Against { pinned, elsewhere: None }, look)
}

/// Draws `layer` at the size of the photograph, opaque; of the result for a working picture, at the size of the working picture.
///
/// A layer that needs a result is the photograph itself while `shown` has none of the photograph's size.
/// [`Layer::Difference`] is gray where there is no pinned result to compare with, and a layer of another program's picture is the
/// photograph where there is no such picture.
pub fn paint_against(
    layer: Layer,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    against: Against,
    look: &Look,
) -> Raster<[u8; 4]> {
    let fits = |shown: &&ResultSnapshot| shown.picture.size() == picture.size();
    let photo = match shown.filter(fits) {
        Some(shown) if shown.is_of_working_picture() => &shown.analysis.working.image.pixels,
        _ => &picture.photo.image.pixels,
    };
    let base = Base { photo, curve: Curve::new(look.exposure_ev, picture.photo.image.contrast, look.gamma) };
    match shown.filter(fits) {
        None => base.light(base.photo),
        Some(shown) => {
            let Against { pinned, elsewhere } = against;
            let pinned = pinned.filter(fits);
            (layer.row().paint)(&PaintInput { base, shown, pinned, elsewhere, look })
        }
    }
}

#[cfg(test)]
mod tests;
