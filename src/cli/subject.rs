//! One photograph, analyzed with a record of every decision, for `trace` and `why`.

use super::one::Area;
use super::place;
use super::reading::Reading;
use super::settings::Settings;
use anyhow::{Context, Result, bail};
use clap::Args;
use dichroscope::analysis::{Analysis, Session};
use dichroscope::params::Params;
use dichroscope::photo::{self, LinearImage};
use dichroscope::trace::Trace;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;

/// A photograph and how to analyze it.
#[derive(Debug, Args)]
pub(super) struct Subject {
    /// Photograph to analyze; - for standard input
    #[arg(index = 1, value_parser = place::parser())]
    pub(super) image: PathBuf,
    /// Analyze only the pixels of the photograph that this picture of the same size shows as not black; - for standard input
    #[arg(long, value_name = "MASK", value_parser = place::parser())]
    area: Option<PathBuf>,
    /// Number of threads, up to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = super::parse_threads)]
    threads: Option<NonZeroUsize>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    reading: Reading,
}

/// A photograph that has been read and analyzed, and the record of it.
pub(super) struct Traced {
    pub(super) image: Arc<LinearImage>,
    pub(super) params: Params,
    pub(super) session: Session,
    pub(super) analysis: Analysis,
    pub(super) trace: Trace,
}

/// Why a photograph is not analyzed: the call is wrong, or the file is.
pub(super) enum AnalyzeError {
    Usage(anyhow::Error),
    File(anyhow::Error),
}

impl Subject {
    /// Reads the photograph, passes it to `check`, and analyzes it with a record. Errors name the file.
    pub(super) fn analyze(
        &self,
        check: impl FnOnce(&LinearImage) -> Result<()>,
    ) -> Result<Traced, AnalyzeError> {
        let params = self.settings.params().map_err(AnalyzeError::Usage)?;
        Settings::expect_area(&params, self.area.is_some()).map_err(AnalyzeError::Usage)?;
        let reading = self.reading.options();
        let photographs = std::slice::from_ref(&self.image);
        place::expect_one_standard_input(self.area.as_deref(), photographs).map_err(AnalyzeError::Usage)?;
        let area = self.area.as_deref().map(|path| Area::read(path, &reading)).transpose();
        let area = area.map_err(AnalyzeError::Usage)?;
        // The errors of reading name the file already.
        let bytes = place::read_bytes(&self.image).map_err(|error| AnalyzeError::File(error.into()))?;
        let photo = photo::decode(&bytes, &place::name_of(&self.image), &reading);
        let photo = photo.map_err(|error| AnalyzeError::File(error.into()))?;
        let image = photo.image;
        check(&image).with_context(|| self.image.display().to_string()).map_err(AnalyzeError::Usage)?;
        let mut session = Session::new(Arc::clone(&image));
        if let Some(area) = area {
            session.restrict(Some(area.mask())).context("--area").map_err(AnalyzeError::Usage)?;
        }
        let (analysis, trace) =
            session.run_traced(&params, &mut ()).map_err(|error| AnalyzeError::File(error.into()))?;
        Ok(Traced { image, params, session, analysis, trace })
    }

    /// Runs `work` with the number of threads of `--threads`.
    pub(super) fn with_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Result<T> {
        let threads = self.threads.map_or(0, NonZeroUsize::get);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(pool.context("cannot start the threads")?.install(work))
    }
}

/// `12,7` as column and row.
pub(super) fn parse_pixel(text: &str) -> Result<[usize; 2], String> {
    let sides =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    sides
        .ok_or_else(|| format!("{text:?} is no pixel: expected column and row, counted from 0, as in 120,85"))
}

/// The index of a pixel inside the photograph.
pub(super) fn pixel_inside(image: &LinearImage, [x, y]: [usize; 2]) -> Result<usize> {
    let (width, height) = (image.width(), image.height());
    if x >= width || y >= height {
        bail!("there is no pixel ({x}, {y}): the picture has {width} \u{d7} {height} pixels, counted from 0");
    }
    Ok(y * width + x)
}
