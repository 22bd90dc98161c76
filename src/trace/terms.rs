//! What stages, classes and pixels are called.

/// The stages in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Dark, clipped and bloomed pixels; the parameters left to the image.
    Masks,
    /// Section 5.2.1.
    Classify,
    /// Section 5.2.2.
    Merge,
    /// Section 5.3.
    Linear,
    /// Section 5.4.
    Planar,
    /// Section 5.5.
    Clipping,
    /// Section 6.
    Split,
}

impl Stage {
    /// All of them, first to last.
    pub const ALL: [Self; 7] =
        [Self::Masks, Self::Classify, Self::Merge, Self::Linear, Self::Planar, Self::Clipping, Self::Split];

    /// Its name in reports and traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Masks => "masks",
            Self::Classify => "classify",
            Self::Merge => "merge",
            Self::Linear => "linear",
            Self::Planar => "planar",
            Self::Clipping => "clipping",
            Self::Split => "split",
        }
    }
}

/// Class of a color cluster by its number of significant eigenvalues (section 5.2.1, table 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// None: no variation beyond the noise.
    Point,
    /// One: matte or highlight line.
    Line,
    /// Two: a dichromatic plane, or two objects.
    Plane,
    /// Three: clipping, or several objects.
    Volume,
}

impl Class {
    /// Its name in tables and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line => "line",
            Self::Plane => "plane",
            Self::Volume => "volume",
        }
    }
}

/// What a pixel is to its region (section 6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelKind {
    /// In no region.
    #[default]
    Unassigned,
    /// Nearer to the matte line.
    Matte,
    /// Nearer to the highlight line.
    Highlight,
    /// Clipped or bloomed, its color restored from the bands that can be believed.
    Restored,
    /// Clipped in every band: nothing to restore it from but its surroundings.
    Lost,
}

impl PixelKind {
    /// Its name in tables and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unassigned => "unassigned",
            Self::Matte => "matte",
            Self::Highlight => "highlight",
            Self::Restored => "restored",
            Self::Lost => "lost",
        }
    }
}
