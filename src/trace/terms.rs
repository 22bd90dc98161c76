//! Names of cluster classes and of pixel kinds.

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
