//! Errors of reading a file. Each message is one line that names the file, what was found, and what the user can do.

use super::format::Format;

/// A file that could not be read as a photograph.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The operating system could not open or read the file.
    #[error("{file}: cannot be read: {cause}")]
    Io {
        /// Name of the file as given by the caller.
        file: String,
        /// Error of the operating system.
        cause: std::io::Error,
    },
    /// The file has no bytes.
    #[error("{file}: the file is empty; expected a picture ({})", Format::NAMES)]
    Empty {
        /// Name of the file as given by the caller.
        file: String,
    },
    /// The first bytes match no supported format.
    #[error("{file}: {found} cannot be read; expected {}: convert it to one of these", Format::NAMES)]
    UnknownFormat {
        /// Name of the file as given by the caller.
        file: String,
        /// Name of the recognized but unsupported format, or the first bytes.
        found: String,
    },
    /// The format is supported, but not the way in which the file uses it.
    #[error("{file}: not supported: this {format} file holds {found}; {hint}")]
    Unsupported {
        /// Name of the file as given by the caller.
        file: String,
        /// Format according to the first bytes.
        format: Format,
        /// The unsupported property of the file.
        found: String,
        /// Advice to the user.
        hint: &'static str,
    },
    /// The content of the file contradicts itself or ends too early.
    #[error("{file}: the {format} file is damaged or cut short: {found}; get an intact copy of it")]
    Damaged {
        /// Name of the file as given by the caller.
        file: String,
        /// Format according to the first bytes.
        format: Format,
        /// Message of the decoder.
        found: String,
    },
    /// A decoding library failed with a panic.
    #[error(
        "{file}: the decoder of {format} files failed on it: {found}; report the file, and convert it to another format"
    )]
    Crashed {
        /// Name of the file as given by the caller.
        file: String,
        /// Format according to the first bytes.
        format: Format,
        /// Message of the panic.
        found: String,
    },
    /// The file declares a width or a height of zero.
    #[error(
        "{file}: the {format} file declares {width} \u{d7} {height} pixels; expected at least one of each"
    )]
    NoPixels {
        /// Name of the file as given by the caller.
        file: String,
        /// Format according to the first bytes.
        format: Format,
        /// Number of columns that the file declares.
        width: u64,
        /// Number of rows that the file declares.
        height: u64,
    },
    /// The file declares more pixels than [`ReadOptions::max_megapixels`](super::ReadOptions::max_megapixels).
    #[error(
        "{file}: the {format} file declares {width} \u{d7} {height} = {} megapixels, more than the limit of \
         {limit_megapixels}; if that is right, raise it with --max-megapixels",
        (*width as f64 * *height as f64 / 1e3).round() / 1e3
    )]
    TooLarge {
        /// Name of the file as given by the caller.
        file: String,
        /// Format according to the first bytes.
        format: Format,
        /// Number of columns that the file declares.
        width: u64,
        /// Number of rows that the file declares.
        height: u64,
        /// The limit from the options, megapixels.
        limit_megapixels: f64,
    },
    /// A number in [`ReadOptions`](super::ReadOptions) is not positive or not finite.
    #[error("{name} = {value}: expected a positive number{unit}")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// Value of the option.
        value: f64,
        /// Unit of the option, with a leading space.
        unit: &'static str,
    },
}

/// Error of a decoder, without the file's name; [`Fault::of`] adds the name and the format.
#[derive(Debug)]
pub(super) enum Fault {
    Damaged(String),
    Crashed(String),
    Unsupported { found: String, hint: &'static str },
    NoPixels { width: u64, height: u64 },
    TooLarge { width: u64, height: u64, limit_megapixels: f64 },
}

impl Fault {
    /// Error: the content is damaged. `cause` is joined to one line.
    pub(super) fn damaged(cause: impl std::fmt::Display) -> Self {
        Self::Damaged(one_line(&cause.to_string()))
    }

    /// Error: the content may be intact, but this program does not support it.
    pub(super) fn unsupported(found: impl std::fmt::Display, hint: &'static str) -> Self {
        Self::Unsupported { found: one_line(&found.to_string()), hint }
    }

    pub(super) fn of(self, file: &str, format: Format) -> ReadError {
        let file = file.to_owned();
        match self {
            Self::Damaged(found) => ReadError::Damaged { file, format, found },
            Self::Crashed(found) => ReadError::Crashed { file, format, found: one_line(&found) },
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

/// Advice to the user about a file that other programs may be able to read.
pub(super) const CONVERT: &str = "convert it to plain gray or RGB with 8 or 16 bits or 32-bit float";

/// Number of characters of a file's own text that a message quotes.
const LONGEST_QUOTE: usize = 200;

/// A text that may quote a file: one line, without control characters, which a terminal would obey, and of limited length.
fn one_line(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let shown =
        |character: char| if character.is_control() { char::REPLACEMENT_CHARACTER } else { character };
    let mut line: String = words.trim_end_matches('.').chars().take(LONGEST_QUOTE).map(shown).collect();
    if words.chars().nth(LONGEST_QUOTE).is_some() {
        line.push('\u{2026}');
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says_cannot_command_a_terminal_or_fill_it() {
        assert_eq!(one_line("a \x1b[2Jb\n\u{9b}c."), "a \u{fffd}[2Jb \u{fffd}c");
        assert_eq!(one_line(&"x".repeat(9000)).chars().count(), LONGEST_QUOTE + 1);
    }
}
