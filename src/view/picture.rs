//! A photograph that is open, its source, and its ground truth.

use super::Histogram;
use crate::photo::{Photo, ReadOptions};
use crate::truth::GroundTruth;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The source of a photograph.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Origin {
    /// A file of the computer.
    File(PathBuf),
    /// A sample scene that the program carries, by name.
    Sample(String),
    /// The clipboard, or a file dropped without a path; the name is for people.
    Bytes {
        /// A name for people.
        name: String,
        /// The bytes of an encoded picture.
        #[serde(skip)]
        bytes: Arc<[u8]>,
    },
}

impl Origin {
    /// A name for titles and messages.
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Self::Sample(name) | Self::Bytes { name, .. } => name.clone(),
        }
    }

    /// The path of the file; none for a photograph that is no file.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }
}

/// An open photograph. Shared, never changed.
#[derive(Debug)]
pub struct Picture {
    /// The source of the photograph.
    pub origin: Origin,
    /// The options with which the file was read.
    pub reading: ReadOptions,
    /// The photograph; its linear image is in `image`.
    pub photo: Photo,
    /// SHA-256 of the file, hexadecimal.
    pub sha256: String,
    /// Time that reading took, milliseconds.
    pub read_ms: f64,
    /// The histogram of the colors.
    pub histogram: Histogram,
    /// The ground truth, where the scene has one.
    pub truth: Option<GroundTruth>,
}

impl Picture {
    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        (self.photo.image.width(), self.photo.image.height())
    }
}
