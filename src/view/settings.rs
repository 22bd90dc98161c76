//! Settings of the views. They are part of a workspace, not of the undo history.

use super::{Fill, Layer, Look};
use crate::raster::RegionId;
use serde::{Deserialize, Serialize};

/// The theme of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Theme {
    /// Light text on a dark background.
    #[default]
    Dark,
    /// Dark text on a light background.
    Light,
}

/// How one or two layers share the image view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Arrangement {
    /// One layer in the whole view.
    #[default]
    Single,
    /// `layer` left of a line at this share of the picture's width, `other` right of it.
    Wipe(f32),
    /// Both, side by side, panned and zoomed as one.
    SideBySide,
}

impl Arrangement {
    /// Which of the arrangements it is, wherever the line of a wipe stands.
    pub const fn kind(self) -> ArrangementKind {
        match self {
            Self::Single => ArrangementKind::Single,
            Self::Wipe(_) => ArrangementKind::Wipe,
            Self::SideBySide => ArrangementKind::SideBySide,
        }
    }
}

/// An [`Arrangement`] without the place of a wipe's line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArrangementKind {
    /// [`Arrangement::Single`].
    Single,
    /// [`Arrangement::Wipe`].
    Wipe,
    /// [`Arrangement::SideBySide`].
    SideBySide,
}

impl ArrangementKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Single, Self::Wipe, Self::SideBySide];

    /// The name on buttons and in menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "One layer",
            Self::Wipe => "Wipe between two layers",
            Self::SideBySide => "Side by side, two layers",
        }
    }

    /// What one sees and does.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Single => "One layer in the whole view",
            Self::Wipe => "A wipe between two layers: drag the line",
            Self::SideBySide => "Two layers side by side, panned and zoomed as one",
        }
    }
}

/// What a drag in a picture does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Tool {
    /// Pan (image) or orbit (cube); a click selects.
    #[default]
    Pointer,
    /// Mark a rectangle.
    Rectangle,
    /// Mark a free outline.
    Lasso,
    /// Mark a polygon, corner by corner.
    Polygon,
    /// Mark with a round brush (image only).
    Brush,
    /// Draw the line of the profile (image only).
    Profile,
    /// Measure the color of the light on a white patch (image only).
    WhitePatch,
}

/// The image view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ImageSettings {
    /// The layer shown.
    pub layer: Layer,
    /// The second layer of a wipe or a pair.
    pub other: Layer,
    /// One layer or two.
    pub arrangement: Arrangement,
    /// Fills or outlines.
    pub fill: Fill,
    /// Opacity of areas over the photograph, 0…1.
    pub opacity: f32,
    /// Exposure of the display, stops.
    pub exposure_ev: f32,
    /// Gamma of the display, applied after sRGB's own curve: above 1 the middle tones are brighter, 1 = none.
    pub gamma: f32,
    /// The point of the picture in the center of the view, pixels; none: the picture's center.
    #[serde(alias = "centre_px")]
    pub center_px: Option<[f32; 2]>,
    /// Screen points per pixel; none: the whole picture fits.
    pub zoom: Option<f32>,
    /// The tool of the pointer.
    pub tool: Tool,
    /// Radius of the brush, pixels of the picture.
    pub brush_px: f32,
    /// Whether readout and inspector stay with what is selected when the pointer moves over the picture.
    pub readout_locked: bool,
}

impl Default for ImageSettings {
    fn default() -> Self {
        Self {
            layer: Layer::Input,
            other: Layer::Body,
            arrangement: Arrangement::Single,
            fill: Fill::Fill,
            opacity: 0.75,
            exposure_ev: 0.0,
            gamma: 1.0,
            center_px: None,
            zoom: None,
            tool: Tool::Pointer,
            brush_px: 8.0,
            readout_locked: false,
        }
    }
}

impl ImageSettings {
    /// Whether one of the layers on the screen is this one.
    pub fn shows(&self, layer: Layer) -> bool {
        self.layer == layer || (self.arrangement != Arrangement::Single && self.other == layer)
    }

    /// Shows one layer or two. A wipe that is shown already keeps its line. Two views of one layer show nothing that one view does not
    /// show: the second layer becomes another one.
    pub fn arrange(&mut self, kind: ArrangementKind) {
        self.arrangement = match (kind, self.arrangement) {
            (ArrangementKind::Single, _) => Arrangement::Single,
            (ArrangementKind::Wipe, wipe @ Arrangement::Wipe(_)) => wipe,
            (ArrangementKind::Wipe, _) => Arrangement::Wipe(0.5),
            (ArrangementKind::SideBySide, _) => Arrangement::SideBySide,
        };
        if kind != ArrangementKind::Single && self.other == self.layer {
            self.other = if self.layer == Layer::Input { Layer::Body } else { Layer::Input };
        }
    }

    /// Shows a layer as the second one, beside the first where one layer alone was shown.
    pub fn show_beside(&mut self, layer: Layer) {
        self.other = layer;
        if self.arrangement == Arrangement::Single {
            self.arrangement = Arrangement::SideBySide;
        }
    }

    /// How layers are drawn with these settings; `selected` is the region that has its full color while all others are dimmed.
    pub fn look(&self, selected: Option<RegionId>) -> Look {
        let &Self { exposure_ev, gamma, fill, opacity, .. } = self;
        Look { exposure_ev, gamma, fill, opacity, selected }
    }
}

/// The space in which the color space view places its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ColorSpace {
    /// The RGB cube, counts: the only space in which the model's lines are straight.
    #[default]
    Rgb,
    /// CIE L*a*b*, D65, the linear counts taken as linear sRGB.
    Lab,
    /// Hue, saturation and value as a cone.
    Hsv,
    /// r = R/(R+G+B), g = G/(R+G+B), with the sum as height.
    Chromaticity,
    /// Logarithm of each band.
    LogRgb,
}

/// The source of the points' colors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ColorBy {
    /// The color that the point stands for.
    #[default]
    Own,
    /// The region of most of the point's pixels.
    Region,
    /// The class of the windows of most of the point's pixels.
    Class,
    /// The number of the point's pixels.
    Density,
}

/// The color space view without its camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[allow(clippy::struct_excessive_bools, reason = "each shows or hides one thing")]
pub struct CubeSettings {
    /// The color space shown.
    pub space: ColorSpace,
    /// The source of the points' colors.
    #[serde(alias = "colour_by")]
    pub color_by: ColorBy,
    /// Whether points grow with the number of their pixels.
    pub size_by_count: bool,
    /// Factor of the points' diameters.
    pub point_scale: f32,
    /// Opacity of the points that are no ghosts, 0…1.
    pub point_opacity: f32,
    /// Place of the depth plane, as a share of the cube's depth from its nearest point on: what is nearer to the viewer is hidden; 0: nothing is.
    pub depth_plane: f32,
    /// Show every unique color instead of 64³ bins while the camera is at rest.
    pub full_detail: bool,
    /// Dim the points that are not selected.
    pub ghost_rest: bool,
    /// The selected region's cylinder and the dark sphere.
    pub show_cylinder: bool,
    /// The selected region's slice.
    pub show_slice: bool,
    /// Matte and highlight line, meeting point, brightest matte point.
    pub show_lines: bool,
    /// The light's direction through black.
    pub show_illuminant: bool,
    /// The covariance ellipsoid of the hovered or selected window.
    pub show_ellipsoid: bool,
    /// The tool of the pointer.
    pub tool: Tool,
    /// Keep the camera when the selection changes.
    pub locked: bool,
}

impl Default for CubeSettings {
    fn default() -> Self {
        Self {
            space: ColorSpace::Rgb,
            color_by: ColorBy::Own,
            size_by_count: true,
            point_scale: 1.0,
            point_opacity: 1.0,
            depth_plane: 0.0,
            full_detail: false,
            ghost_rest: true,
            show_cylinder: true,
            show_slice: true,
            show_lines: true,
            show_illuminant: true,
            show_ellipsoid: true,
            tool: Tool::Pointer,
            locked: false,
        }
    }
}

/// The plane view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlaneSettings {
    /// Color points by their label (matte, highlight, restored) instead of their own color.
    #[serde(alias = "colour_by_label")]
    pub color_by_label: bool,
    /// The tool of the pointer: pointer, rectangle, lasso or polygon.
    pub tool: Tool,
}

impl Default for PlaneSettings {
    fn default() -> Self {
        Self { color_by_label: true, tool: Tool::Pointer }
    }
}

/// The line along which the profile is taken, in pixels of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum ProfileLine {
    /// The row of the hovered or selected pixel, else the middle row of the picture.
    #[default]
    Row,
    /// The column of the hovered or selected pixel, else the middle column.
    Column,
    /// From one point to another.
    Between([f32; 2], [f32; 2]),
}
