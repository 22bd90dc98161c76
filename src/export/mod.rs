//! Results as files.
//!
//! A result is a folder. `FileChoice` says which files the folder holds. `Staging` collects the files in a hidden folder beside the target and renames the hidden folder, so
//! that a target folder is always complete. Floats are linear, 1.0 = 255 counts; `noise.exr` has the one channel `Y`.

mod arrays;
mod choice;
mod exchange;
mod float_picture;
mod floats;
mod foreign;
mod leftovers;
mod matte;
mod matte_format;
mod palette;
mod pictures;
mod png;
mod result;
mod single;
mod stages;
mod staging;
mod whole;

pub use choice::{FileChoice, UnknownFile};
pub(crate) use float_picture::FloatPicture;
pub use foreign::{write_difference, write_foreign_diffuse, write_foreign_labels};
pub use leftovers::remove_leftovers;
pub use matte::{MatteError, matte_bytes, write_matte};
pub(crate) use palette::Palette;
pub use pictures::write_pictures;
pub(crate) use png::{png_of_gray, png_of_rgb, png_of_rgba};
pub use result::{ResultError, is_result_folder, read_report};
pub use single::{PartFile, write_file};
pub(crate) use stages::colored;
use staging::Staging;
pub use staging::check_target;
pub use whole::{Watch, WholeResult};

use std::path::{Path, PathBuf};

/// Why a result could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A file or folder could not be made, written or renamed.
    #[error("cannot write {}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A PNG could not be encoded or written.
    #[error("cannot write {}", path.display())]
    Png {
        /// The file.
        path: PathBuf,
        /// The encoder's error.
        source: ::png::EncodingError,
    },
    /// The report could not be turned into JSON.
    #[error("cannot write {}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The serializer's error.
        source: serde_json::Error,
    },
    /// The photograph without its highlights could not be written.
    #[error(transparent)]
    Matte(#[from] MatteError),
    /// The observer stopped the writing.
    #[error("stopped before all was written")]
    Stopped,
    /// The target folder exists and is not an earlier result.
    #[error("{} exists and is not an earlier result: --force replaces it", .0.display())]
    Occupied(PathBuf),
    /// The target exists and is a file.
    #[error("{} is a file: a result needs a folder", .0.display())]
    NotAFolder(PathBuf),
}

impl ExportError {
    /// The error with the files of the folder `hidden` named as files of `target`, which they would have become.
    fn named_in(mut self, hidden: &Path, target: &Path) -> Self {
        match &mut self {
            Self::Io { path, .. }
            | Self::Png { path, .. }
            | Self::Json { path, .. }
            | Self::Matte(MatteError::Encode { path, .. } | MatteError::Write { path, .. }) => {
                if let Ok(rest) = path.strip_prefix(hidden) {
                    *path = target.join(rest);
                }
            }
            _ => {}
        }
        self
    }
}
