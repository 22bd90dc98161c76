//! The table of the image layers, from which [`Layer`] and all properties of a layer are made.

use super::LayerPixels;
use super::legends;
use super::painters::{self, PaintInput};
use crate::raster::Raster;
use crate::view::LegendEntry;
use serde::{Deserialize, Serialize};

/// What a layer's picture depends on, and how the layer relates to the photograph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LayerKind {
    /// The photograph itself; it needs no result.
    Photograph,
    /// Drawn in the photograph's place from a result.
    Result,
    /// Drawn in the photograph's place from a result and the pinned one.
    Comparison,
    /// Drawn in the photograph's place, from a result and a diffuse picture that was made elsewhere.
    Diffuse,
    /// Drawn over the photograph.
    Overlay,
    /// Drawn over the photograph, from a result with two lamps.
    LampOverlay,
    /// Drawn over the photograph; regions that are not selected are dimmed.
    RegionOverlay,
    /// Drawn over the photograph, from a result and a label map that was made elsewhere.
    LabelOverlay,
}

/// A row of the table: one layer.
pub(super) struct LayerRow {
    /// The name on buttons.
    pub name: &'static str,
    /// What the layer shows, with the paper's section.
    pub tip: &'static str,
    /// What the picture depends on.
    pub kind: LayerKind,
    /// The legend of the colors.
    pub legend: &'static [LegendEntry],
    /// The numbers at a pixel, where the layer has numbers of its own.
    pub numbers: Option<fn(LayerPixels, usize) -> Vec<f32>>,
    /// Paints the layer, opaque sRGB.
    pub paint: fn(&PaintInput) -> Raster<[u8; 4]>,
}

/// Makes [`Layer`], [`Layer::ALL`] and the rows from the table.
macro_rules! layers {
    ($($(#[$attribute:meta])* $layer:ident: $row:expr;)+) => {
        /// A picture of the photograph or of a result.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum Layer {
            $($(#[$attribute])* $layer,)+
        }

        impl Layer {
            /// All layers in the order of the pipeline.
            pub const ALL: [Self; [$(stringify!($layer)),+].len()] = [$(Self::$layer),+];

            /// The layer's row in the table.
            pub(super) const fn row(self) -> &'static LayerRow {
                match self {
                    $(Self::$layer => const { &$row },)+
                }
            }
        }
    };
}

layers! {
    /// The photograph.
    #[default]
    Input: LayerRow {
        name: "Input",
        tip: "The photograph.",
        kind: LayerKind::Photograph,
        legend: &[],
        numbers: None,
        paint: painters::photograph,
    };
    /// Dark, clipped, bloomed and invalid pixels (4).
    Masks: LayerRow {
        name: "Masks",
        tip: "Pixels not to believe: dark, clipped, bloomed (section 4).",
        kind: LayerKind::Overlay,
        legend: &legends::MASKS,
        numbers: None,
        paint: painters::masks,
    };
    /// Windows by class (5.2.1).
    Classes: LayerRow {
        name: "Classification",
        tip: "Windows by the shape of their color cluster: point, line, plane, volume (section 5.2.1).",
        kind: LayerKind::Overlay,
        legend: &legends::CLASSES,
        numbers: None,
        paint: painters::classes,
    };
    /// Merged areas (5.2.2).
    Areas: LayerRow {
        name: "Merged areas",
        tip: "Neighboring windows of one class merged (section 5.2.2).",
        kind: LayerKind::Overlay,
        legend: &[],
        numbers: None,
        paint: painters::areas,
    };
    /// Regions after the linear stage (5.3).
    Linear: LayerRow {
        name: "Linear",
        tip: "Regions grown from linear hypotheses: matte pixels in a cylinder (section 5.3).",
        kind: LayerKind::RegionOverlay,
        legend: &[],
        numbers: None,
        paint: painters::linear,
    };
    /// Regions after the planar stage (5.4).
    Planar: LayerRow {
        name: "Planar",
        tip: "Regions grown from planar hypotheses: matte and highlight in a slice (section 5.4).",
        kind: LayerKind::RegionOverlay,
        legend: &[],
        numbers: None,
        paint: painters::planar,
    };
    /// The final regions (5.5).
    Regions: LayerRow {
        name: "Regions",
        tip: "The final regions, clipped pixels included (section 5.5).",
        kind: LayerKind::RegionOverlay,
        legend: &[],
        numbers: None,
        paint: painters::regions,
    };
    /// Body reflection (6).
    Body: LayerRow {
        name: "Body",
        tip: "Body reflection: the photograph without highlights (section 6).",
        kind: LayerKind::Result,
        legend: &[],
        numbers: Some(|of, pixel| of.intrinsic.body[pixel].to_vec()),
        paint: painters::body,
    };
    /// Surface reflection (6).
    Surface: LayerRow {
        name: "Surface",
        tip: "Surface reflection: the highlights alone (section 6).",
        kind: LayerKind::Result,
        legend: &[],
        numbers: Some(|of, pixel| of.intrinsic.surface[pixel].to_vec()),
        paint: painters::surface,
    };
    /// Distance ε from the dichromatic plane, gray = 0 (6).
    Noise: LayerRow {
        name: "Noise",
        tip: "Distance \u{3b5} from the dichromatic plane; gray is 0 (section 6).",
        kind: LayerKind::Result,
        legend: &legends::NOISE,
        numbers: Some(|of, pixel| vec![of.intrinsic.noise[pixel]]),
        paint: painters::noise,
    };
    /// How reliable the split of each pixel is, black = not at all.
    Confidence: LayerRow {
        name: "Confidence",
        tip: "How far the split of each pixel is to be believed: black not at all, white fully.",
        kind: LayerKind::Result,
        legend: &legends::CONFIDENCE,
        numbers: Some(|of, pixel| vec![of.intrinsic.confidence[pixel]]),
        paint: painters::confidence,
    };
    /// Why pixels are not explained (5.6, 7.5).
    Reasons: LayerRow {
        name: "Reasons",
        tip: "Why pixels are not explained by one region's skewed T (sections 5.6 and 7.5).",
        kind: LayerKind::Overlay,
        legend: &legends::REASONS,
        numbers: None,
        paint: painters::reasons,
    };
    /// Which of two lamps each pixel is split with (7.5).
    Lamps: LayerRow {
        name: "Lamps",
        tip: "The lamp that each pixel is split with, where a second lamp lights a part of the scene (section 7.5).",
        kind: LayerKind::LampOverlay,
        legend: &legends::LAMPS,
        numbers: None,
        paint: painters::lamps,
    };
    /// The newest result's body reflection minus the pinned one's, gray = 0.
    Difference: LayerRow {
        name: "Difference",
        tip: "Body reflection minus that of the pinned result; gray is 0.",
        kind: LayerKind::Comparison,
        legend: &legends::DIFFERENCE,
        numbers: None,
        paint: painters::difference,
    };
    /// The regions of Phoenix, to compare with (7.2).
    Phoenix: LayerRow {
        name: "Phoenix",
        tip: "What Phoenix finds instead: regions split by the histograms of color features (section 7.2, color figure 15).",
        kind: LayerKind::Overlay,
        legend: &[],
        numbers: None,
        paint: painters::phoenix,
    };
    /// The label map that was made elsewhere, to compare with.
    OtherRegions: LayerRow {
        name: "Other regions",
        tip: "The label map of another program: each label has the color of the region that covers most of it, or a shade of that color.",
        kind: LayerKind::LabelOverlay,
        legend: &[],
        numbers: Some(|of, pixel| of.elsewhere_at(pixel).label.map_or_else(Vec::new, |label| vec![f32::from(label)])),
        paint: painters::other_regions,
    };
    /// The borders of regions and of labels that were made elsewhere.
    OtherBorders: LayerRow {
        name: "Other borders",
        tip: "Borders of the regions and of another program's label map; borders up to two pixels apart are one.",
        kind: LayerKind::LabelOverlay,
        legend: &legends::BORDERS,
        numbers: None,
        paint: painters::other_borders,
    };
    /// The diffuse picture that was made elsewhere.
    OtherBody: LayerRow {
        name: "Other body",
        tip: "The diffuse picture of another program, shown as body reflection is (section 6).",
        kind: LayerKind::Diffuse,
        legend: &[],
        numbers: Some(|of, pixel| of.elsewhere_at(pixel).diffuse.map_or_else(Vec::new, |counts| counts.to_vec())),
        paint: painters::other_body,
    };
    /// The diffuse picture that was made elsewhere minus body reflection, gray = 0.
    OtherDifference: LayerRow {
        name: "Other difference",
        tip: "The diffuse picture of another program minus body reflection; gray is 0.",
        kind: LayerKind::Diffuse,
        legend: &legends::OTHER_DIFFERENCE,
        numbers: Some(|of, pixel| of.elsewhere_at(pixel).diffuse.map_or_else(Vec::new, |counts| {
            counts.iter().zip(of.intrinsic.body[pixel]).map(|(counts, body)| counts - body).collect()
        })),
        paint: painters::other_difference,
    };
}
