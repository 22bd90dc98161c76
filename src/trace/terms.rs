//! Names of cluster classes and of pixel kinds.

/// Class of a color cluster, by the number of its significant eigenvalues (section 5.2.1, table 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// No significant eigenvalue: no variation beyond the noise.
    Point,
    /// One significant eigenvalue: a matte or highlight line.
    Line,
    /// Two significant eigenvalues: a dichromatic plane, or two objects.
    Plane,
    /// Three significant eigenvalues: clipping, or several objects.
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

/// Kind of a pixel: the part of the skewed T to which its color belongs (section 6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelKind {
    /// The pixel is in no region.
    #[default]
    Unassigned,
    /// The color is nearer to the matte line.
    Matte,
    /// The color is nearer to the highlight line.
    Highlight,
    /// The pixel is clipped or bloomed, and its color was restored from the undistorted bands.
    Restored,
    /// The pixel is clipped in every band, so that its color can be restored from its surroundings only, or clipped or bloomed in a region that is not split.
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
