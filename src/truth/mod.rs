//! Ground truth, the scores of a result against it, and the report with these scores.
//!
//! A truth folder holds `body.exr` and `surface.exr` (linear RGB, 1.0 = 255 counts), `labels.png` (object at each
//! pixel, 0 = background) and `truth.json` (true vectors). [`score()`] computes the scores. The scores were compared with an
//! independent implementation and agree in every printed digit.

mod candidates;
mod folder;
mod foreign;
mod label_map;
mod measures;
mod pictures;
mod report;
mod resemblance;
pub mod sample;
mod score;

pub use candidates::CandidateCounts;
pub(crate) use folder::TruthFiles;
pub use folder::{GroundTruth, TruthObject, find_truth};
pub use foreign::{Agreement, ForeignResult};
pub use label_map::read_label_map;
pub use measures::{adjusted_rand_index, angle_deg, psnr_db};
pub use pictures::ResultPictures;
pub use report::{Reference, ReportInput, report};
pub use resemblance::doubt_about_truth;
pub use score::{Outcome, ScoreError, score};

use std::path::PathBuf;

/// Why a ground truth or a result could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// A file could not be opened or read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A picture could not be decoded.
    #[error("cannot decode {}", path.display())]
    Exr {
        /// The file.
        path: PathBuf,
        /// The decoder's error.
        source: exr::error::Error,
    },
    /// A label picture could not be decoded.
    #[error("cannot decode {}", path.display())]
    Labels {
        /// The file.
        path: PathBuf,
        /// The decoder's error.
        source: image::ImageError,
    },
    /// The samples of a label picture are not 8- or 16-bit integers.
    #[error("{} holds {found}: expected labels as 8- or 16-bit integers, as in a PNG: gray, or one color for each label", path.display())]
    LabelType {
        /// The file.
        path: PathBuf,
        /// The sample type found.
        found: String,
    },
    /// A label map has more labels than 16 bits can number.
    #[error("{} holds more than 65535 colors: a label map has one color for each label, and neither shading nor noise", path.display())]
    ManyLabels {
        /// The file.
        path: PathBuf,
    },
    /// The numbers of a label map were changed after the map was made.
    #[error("{} {why}: save the label map as PNG, without smoothing and without scaling", path.display())]
    InexactLabels {
        /// The file.
        path: PathBuf,
        /// What the file is or has, a verb first.
        why: &'static str,
    },
    /// `truth.json` is not JSON or lacks a required value.
    #[error("{} does not describe a ground truth", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The parser's error.
        source: serde_json::Error,
    },
    /// The pictures of one folder differ in size.
    #[error("{} is {}\u{d7}{}, the labels are {}\u{d7}{}", path.display(), found.0, found.1, labels.0, labels.1)]
    Size {
        /// The file.
        path: PathBuf,
        /// Columns and rows of the file.
        found: (usize, usize),
        /// Columns and rows of the labels.
        labels: (usize, usize),
    },
}
