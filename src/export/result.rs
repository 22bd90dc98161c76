//! Finding result folders and reading their reports.

use crate::describe::{FILE_NAME, Report, ReportError, is_report};
use std::path::{Path, PathBuf};

/// Why the report of a result folder could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultError {
    /// The file could not be opened or read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The file is not a report that this program reads.
    #[error("cannot read {}", path.display())]
    Report {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ReportError,
    },
}

/// Reads the report of a result folder.
///
/// # Errors
/// When the file is missing, is not a report or has another schema.
pub fn read_report(folder: &Path) -> Result<Report, ResultError> {
    let path = folder.join(FILE_NAME);
    match std::fs::read(&path) {
        Ok(text) => Report::from_json(&text).map_err(|source| ResultError::Report { path, source }),
        Err(source) => Err(ResultError::Io { path, source }),
    }
}

/// Whether `folder` holds a `report.json` of this program, of any schema. Such a folder is replaced as a whole.
pub fn is_result_folder(folder: &Path) -> bool {
    std::fs::read(folder.join(FILE_NAME)).is_ok_and(|text| is_report(&text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_folder_has_a_report_and_errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let says = |expected: &str| {
            let message = read_report(folder.path()).unwrap_err().to_string();
            assert!(message.starts_with("cannot read") && message.ends_with(expected), "{message}");
        };
        says(FILE_NAME);
        assert!(!is_result_folder(folder.path()));
        let path = folder.path().join(FILE_NAME);
        std::fs::write(&path, r#"{"schema": 1, "coverage": {}}"#).unwrap();
        says(FILE_NAME);
        assert!(!is_result_folder(folder.path()), "another program's report is not ours");
        std::fs::write(&path, r#"{"schema": 7, "program": "9.0", "image": {}}"#).unwrap();
        assert!(matches!(
            read_report(folder.path()),
            Err(ResultError::Report { source: ReportError::Schema(7), .. })
        ));
        assert!(is_result_folder(folder.path()));
    }
}
