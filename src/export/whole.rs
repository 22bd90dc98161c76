//! Writing a whole result folder, for the command line and the window.

use super::choice::{FileChoice, MATTE};
use super::pictures::write_pictures_watched;
use super::{ExportError, Staging, write_matte};
use crate::analysis::Analysis;
use crate::describe::{self, Report};
use crate::photo::Photo;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The content of a result folder, without the report.
#[derive(Clone, Copy, Debug)]
pub struct WholeResult<'a> {
    /// The photograph.
    pub photo: &'a Photo,
    /// The analysis of the photograph.
    pub analysis: &'a Analysis,
    /// Share of the surface reflection that the matte picture keeps, 0…1.
    pub keep_surface: f64,
}

/// An observer of the writing: receives the number of written files and the number of all files. The writing stops when the
/// observer returns false.
pub type Watch<'a> = &'a (dyn Fn(usize, usize) -> bool + Sync);

impl WholeResult<'_> {
    /// Writes all files to a hidden folder and renames that folder to `target`. Returns the report with the duration of the
    /// writing.
    ///
    /// # Errors
    /// When `target` must not be replaced (see [`super::check_target`]), a file cannot be written, or `watch` returns false
    /// ([`ExportError::Stopped`]); `target` is then unchanged.
    pub fn write(
        &self,
        report: Report,
        target: &Path,
        force: bool,
        watch: Watch,
    ) -> Result<Report, ExportError> {
        self.write_files(&FileChoice::default(), report, target, force, watch)
    }

    /// As [`WholeResult::write`], only the files of `choice`. Without a report, files of an earlier result without a report stay.
    ///
    /// # Errors
    /// The errors of [`WholeResult::write`].
    pub fn write_files(
        &self,
        choice: &FileChoice,
        mut report: Report,
        target: &Path,
        force: bool,
        watch: Watch,
    ) -> Result<Report, ExportError> {
        let begin = Instant::now();
        let staging = Staging::begin(target, force)?;
        // The report, which is written last, does not count.
        let total = choice.len() - usize::from(choice.has(describe::FILE_NAME));
        let written = AtomicUsize::new(0);
        let file_done = || {
            let done = written.fetch_add(1, Ordering::Relaxed) + 1;
            if watch(done, total) { Ok(()) } else { Err(ExportError::Stopped) }
        };
        let is_wanted = |name: &str| choice.has(name);
        let (image, folder) = (&self.photo.image, staging.folder());
        let (pictures, matte) = rayon::join(
            || write_pictures_watched(folder, image, self.analysis, &is_wanted, &file_done),
            || {
                if choice.has(MATTE) {
                    write_matte(self.photo, &self.analysis.intrinsic, self.keep_surface, folder)?;
                    file_done()?;
                }
                Ok::<(), ExportError>(())
            },
        );
        pictures.and(matte).map_err(|error| error.named_in(folder, target))?;
        // The duration is in milliseconds with a resolution of one microsecond.
        report.timings_ms.write = Some(begin.elapsed().as_micros() as f64 / 1e3);
        staging.publish(choice.has(describe::FILE_NAME).then_some(&report))?;
        Ok(report)
    }
}
