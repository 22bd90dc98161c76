//! Why a file could not be read: one line that names it, says what was found and what to do.

use super::format::Format;

/// A file that could not be read as a photograph.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The operating system would not give us its bytes.
    #[error("{file}: cannot be read: {cause}")]
    Io {
        /// Its name as it was given.
        file: String,
        /// What the system said.
        cause: std::io::Error,
    },
    /// No bytes at all.
    #[error("{file}: the file is empty; expected a picture ({})", Format::NAMES)]
    Empty {
        /// Its name as it was given.
        file: String,
    },
    /// Its first bytes belong to no format that we read.
    #[error("{file}: {found} cannot be read; expected {}: convert it to one of these", Format::NAMES)]
    UnknownFormat {
        /// Its name as it was given.
        file: String,
        /// The format that it seems to be, or its first bytes.
        found: String,
    },
    /// A known format, used in a way that we do not read.
    #[error("{file}: this {format} file holds {found}; {hint}")]
    Unsupported {
        /// Its name as it was given.
        file: String,
        /// The format that its first bytes tell.
        format: Format,
        /// What cannot be read.
        found: String,
        /// What to do about it.
        hint: &'static str,
    },
    /// A known format whose content contradicts itself or ends too early.
    #[error("{file}: the {format} file is damaged or cut short: {found}; get an intact copy of it")]
    Damaged {
        /// Its name as it was given.
        file: String,
        /// The format that its first bytes tell.
        format: Format,
        /// What the decoder stumbled over.
        found: String,
    },
    /// A width or a height of zero.
    #[error(
        "{file}: the {format} file declares {width} \u{d7} {height} pixels; expected at least one of each"
    )]
    NoPixels {
        /// Its name as it was given.
        file: String,
        /// The format that its first bytes tell.
        format: Format,
        /// Declared columns.
        width: u64,
        /// Declared rows.
        height: u64,
    },
    /// More pixels than [`ReadOptions::max_megapixels`](super::ReadOptions::max_megapixels).
    #[error(
        "{file}: the {format} file declares {width} \u{d7} {height} = {:.1} megapixels, more than the limit of \
         {limit_megapixels}; if that is right, raise it with --max-megapixels",
        *width as f64 * *height as f64 / 1e6
    )]
    TooLarge {
        /// Its name as it was given.
        file: String,
        /// The format that its first bytes tell.
        format: Format,
        /// Declared columns.
        width: u64,
        /// Declared rows.
        height: u64,
        /// The limit in force.
        limit_megapixels: f64,
    },
    /// A number in [`ReadOptions`](super::ReadOptions) that makes no sense.
    #[error("{name} = {value}: expected a positive number{unit}")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// The number given.
        value: f64,
        /// Its unit, with a leading space.
        unit: &'static str,
    },
}

/// What a decoder finds wrong; [`Fault::of`] adds the file and its format.
#[derive(Debug)]
pub(super) enum Fault {
    Damaged(String),
    Unsupported { found: String, hint: &'static str },
    NoPixels { width: u64, height: u64 },
    TooLarge { width: u64, height: u64, limit_megapixels: f64 },
}

impl Fault {
    /// The content is broken; `cause` is cut to its first line.
    pub(super) fn damaged(cause: impl std::fmt::Display) -> Self {
        Self::Damaged(one_line(&cause.to_string()))
    }

    /// The content may be fine, but we do not read it.
    pub(super) fn unsupported(found: impl std::fmt::Display, hint: &'static str) -> Self {
        Self::Unsupported { found: one_line(&found.to_string()), hint }
    }

    pub(super) fn of(self, file: &str, format: Format) -> ReadError {
        let file = file.to_owned();
        match self {
            Self::Damaged(found) => ReadError::Damaged { file, format, found },
            Self::Unsupported { found, hint } => ReadError::Unsupported { file, format, found, hint },
            Self::NoPixels { width, height } => ReadError::NoPixels { file, format, width, height },
            Self::TooLarge { width, height, limit_megapixels } => {
                ReadError::TooLarge { file, format, width, height, limit_megapixels }
            }
        }
    }
}

impl From<image::ImageError> for Fault {
    fn from(error: image::ImageError) -> Self {
        match error {
            image::ImageError::Unsupported(what) => Self::unsupported(what, CONVERT),
            other => Self::damaged(other),
        }
    }
}

impl From<tiff::TiffError> for Fault {
    fn from(error: tiff::TiffError) -> Self {
        match error {
            tiff::TiffError::UnsupportedError(what) => Self::unsupported(what, CONVERT),
            other => Self::damaged(other),
        }
    }
}

impl From<exr::error::Error> for Fault {
    fn from(error: exr::error::Error) -> Self {
        match error {
            exr::error::Error::NotSupported(what) => Self::unsupported(what, CONVERT),
            other => Self::damaged(other),
        }
    }
}

impl From<png::DecodingError> for Fault {
    fn from(error: png::DecodingError) -> Self {
        Self::damaged(error)
    }
}

/// What to do about a file that only we cannot read.
pub(super) const CONVERT: &str = "convert it to plain gray or RGB with 8 or 16 bits or 32-bit float";

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}
