//! Results as files.
//!
//! A result is a folder, and it appears whole or not at all: [`Staging`] collects its files in a hidden sibling
//! and renames that into place. Floats are linear, 1.0 = 255 counts; `noise.exr` has the one channel `Y`.

mod floats;
mod matte;
mod palette;
mod pictures;
mod png;
mod result;
mod stages;
mod staging;

pub use matte::{MatteError, write_matte};
pub use palette::Palette;
pub use pictures::write_pictures;
pub use png::png_of_rgba;
pub use result::{ResultError, is_result_folder, read_report};
pub use staging::{Staging, check_target};

use std::path::PathBuf;

/// Why a result could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A file or folder could not be made, written or renamed.
    #[error("cannot write {}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A PNG could not be encoded or written.
    #[error("cannot write {}", path.display())]
    Png {
        /// The file.
        path: PathBuf,
        /// What the encoder said.
        source: ::png::EncodingError,
    },
    /// An EXR could not be encoded or written.
    #[error("cannot write {}", path.display())]
    Exr {
        /// The file.
        path: PathBuf,
        /// What the encoder said.
        source: exr::error::Error,
    },
    /// The report could not be turned into JSON.
    #[error("cannot write {}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What could not be said in JSON.
        source: serde_json::Error,
    },
    /// Something that is not a result of ours stands where the result shall be.
    #[error("{} exists and is not an earlier result: --force replaces it", .0.display())]
    Occupied(PathBuf),
    /// A file stands where the folder of the result shall be.
    #[error("{} is a file: a result needs a folder", .0.display())]
    NotAFolder(PathBuf),
}
