//! The formats of the photograph without highlights.

/// A format that the photograph without highlights can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MatteFormat {
    Png,
    Jpeg,
    Tiff,
}

impl MatteFormat {
    pub const ALL: [Self; 3] = [Self::Png, Self::Jpeg, Self::Tiff];

    /// The extension of the file.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::Tiff => "tif",
        }
    }
}
