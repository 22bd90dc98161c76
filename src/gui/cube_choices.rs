//! The choices of the color space view, which its bar, the menus and the command palette offer.

use crate::gpu::Preset;
use crate::view::{ColorBy, CubeSettings};
use egui::Key;

/// The colorings of the points with name and tooltip.
pub const COLORINGS: [(ColorBy, &str, &str); 4] = [
    (ColorBy::Own, "Own color", "Each point in the color that it stands for."),
    (ColorBy::Region, "Region", "In the color of the region that most of its pixels are in."),
    (
        ColorBy::Class,
        "Class",
        "By the class of most of its pixels' windows: point, line, plane or volume (section 5.2.1).",
    ),
    (ColorBy::Density, "Density", "By how many pixels have it, on a logarithmic scale."),
];

/// A shape or a look of the points that can be switched on and off.
pub struct CubeBox {
    /// The name of the box.
    pub name: &'static str,
    /// What is shown, and the paper's section.
    pub tip: &'static str,
    /// The setting.
    pub slot: fn(&mut CubeSettings) -> &mut bool,
}

/// All such boxes, in the order of the menu.
pub const CUBE_BOXES: [CubeBox; 8] = [
    CubeBox {
        name: "Cylinder and dark sphere",
        tip: "The colors that the linear hypothesis claims, from where it is bright enough (section 5.3.2).",
        slot: |settings| &mut settings.show_cylinder,
    },
    CubeBox {
        name: "Slice",
        tip: "The colors that the planar hypothesis claims (section 5.4.2).",
        slot: |settings| &mut settings.show_slice,
    },
    CubeBox {
        name: "Matte and highlight line",
        tip: "The skewed T: both lines, where they meet, and the brightest matte point (section 3.1).",
        slot: |settings| &mut settings.show_lines,
    },
    CubeBox {
        name: "Illuminant",
        tip: "The light's color as a line through black (section 5.4).",
        slot: |settings| &mut settings.show_illuminant,
    },
    CubeBox {
        name: "Ellipsoid of a window",
        tip: "Two standard deviations around the mean of the window selected or hovered (section 5.2.1).",
        slot: |settings| &mut settings.show_ellipsoid,
    },
    CubeBox {
        name: "Ghost the rest",
        tip: "What is not selected or marked fades, but stays.",
        slot: |settings| &mut settings.ghost_rest,
    },
    CubeBox {
        name: "Size by count",
        tip: "Points grow with the logarithm of their number of pixels.",
        slot: |settings| &mut settings.size_by_count,
    },
    CubeBox {
        name: "Every color at rest",
        tip: "Each color that occurs instead of 64 \u{d7} 64 \u{d7} 64 bins, when the camera rests.",
        slot: |settings| &mut settings.full_detail,
    },
];

/// The views that a menu offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedView {
    /// Along a named direction.
    Along(Preset),
    /// Onto the selected region's dichromatic plane.
    FaceOn,
    /// Along the selected region's dichromatic plane.
    EdgeOn,
}

/// What a view of the dichromatic plane needs.
pub const NEEDS_PLANE: &str = "Select a region that has a dichromatic plane, in the RGB space.";

impl NamedView {
    /// Whether the view is of the selected region's dichromatic plane.
    pub const fn is_of_plane(self) -> bool {
        matches!(self, Self::FaceOn | Self::EdgeOn)
    }

    /// All views with key, name and tooltip.
    pub const ALL: [(Self, Key, &'static str, &'static str); 7] = [
        (Self::Along(Preset::Home), Key::Home, "Home", "The whole cube from the front, blue up."),
        (
            Self::Along(Preset::Red),
            Key::X,
            "Along red",
            "Along the red axis towards black: green against blue.",
        ),
        (Self::Along(Preset::Green), Key::Y, "Along green", "Along the green axis: red against blue."),
        (
            Self::Along(Preset::Blue),
            Key::U,
            "Along blue",
            "Along the blue axis towards black: red against green.",
        ),
        (
            Self::Along(Preset::Gray),
            Key::D,
            "Along the gray diagonal",
            "From white to black: hue and saturation without brightness.",
        ),
        (
            Self::FaceOn,
            Key::S,
            "Face-on to the plane",
            "The selected region's dichromatic plane from the front: the skewed T of figure 2.",
        ),
        (
            Self::EdgeOn,
            Key::E,
            "Edge-on to the plane",
            "Along the selected region's dichromatic plane: how thin its slice is, as in figure 10.",
        ),
    ];
}
