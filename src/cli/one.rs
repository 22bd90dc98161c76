//! One photograph, from its file to its result.

use super::interrupt::Interrupt;
use super::place;
use anyhow::{Context, Result, bail};
use dichroscope::analysis::{Analysis, Observer, Session, Stage};
use dichroscope::describe::{AreaFacts, Report, Timings};
use dichroscope::export::{FileChoice, WholeResult};
use dichroscope::params::Params;
use dichroscope::photo::{self, Photo, ReadOptions};
use dichroscope::raster::{Mask, Raster, UNASSIGNED};
use dichroscope::truth::sample::CAMERA_FILE;
use dichroscope::truth::{self, GroundTruth, ReportInput};
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// A photograph that has been read.
pub(super) struct LoadedPhoto {
    pub(super) photo: Photo,
    /// SHA-256 of the file.
    pub(super) sha256: String,
    /// Time of reading and decoding, milliseconds.
    read_ms: f64,
}

impl LoadedPhoto {
    /// Decodes a file that is already in memory.
    pub(super) fn decode(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Self> {
        let sha256 = photo::sha256_hex(bytes);
        RawFile { bytes: bytes.to_vec(), name: name.to_owned(), sha256, read_ms: 0.0 }.decode(options)
    }
}

/// The bytes of a photograph's file. Pixels and hash come from the same bytes: a pipe cannot be read a second time.
pub(super) struct RawFile {
    bytes: Vec<u8>,
    name: String,
    /// SHA-256 of the bytes.
    sha256: String,
    /// Time of reading, milliseconds.
    read_ms: f64,
}

impl RawFile {
    /// Reads a file. Errors name the file; the wait for a pipe is one of them where `interrupt` came.
    pub(super) fn read(path: &Path, interrupt: &Interrupt) -> Result<Self> {
        let begin = Instant::now();
        let bytes = place::read_bytes_until(path, interrupt)?;
        let read_ms = ms_since(begin);
        Ok(Self { sha256: photo::sha256_hex(&bytes), name: place::name_of(path), bytes, read_ms })
    }

    /// SHA-256 of the bytes.
    pub(super) fn sha256(&self) -> &str {
        &self.sha256
    }

    /// Decodes the photograph. Errors name the file.
    pub(super) fn decode(self, options: &ReadOptions) -> Result<LoadedPhoto> {
        let begin = Instant::now();
        let photo = photo::decode(&self.bytes, &self.name, options)?;
        Ok(LoadedPhoto { photo, sha256: self.sha256, read_ms: self.read_ms + ms_since(begin) })
    }
}

/// A ground truth to compare a result with.
pub(super) struct Reference {
    pub(super) truth: GroundTruth,
    /// The photograph that the truth belongs to, linear counts.
    pub(super) camera: Raster<[f32; 3]>,
}

impl Reference {
    /// Reads a truth folder and, in it, the photograph called `image` or else the usual one.
    pub(super) fn read(folder: &Path, image: &str, options: &ReadOptions) -> Result<Self> {
        let named = folder.join(image);
        let path = if named.is_file() { named } else { folder.join(CAMERA_FILE) };
        let truth = GroundTruth::read(folder)?;
        Ok(Self { truth, camera: Arc::unwrap_or_clone(photo::read(&path, options)?.image).pixels })
    }
}

/// The pixels to analyze, from the file of `--area`.
pub(super) struct Area {
    name: String,
    mask: Arc<Mask>,
}

impl Area {
    /// Reads a mask: what is not black is inside. Errors name the file.
    pub(super) fn read(path: &Path, options: &ReadOptions) -> Result<Self> {
        let whole_name = place::name_of(path);
        let mask = photo::decode_mask(&place::read_bytes(path)?, &whole_name, options)?;
        if mask.count() == 0 {
            bail!(
                "--area {whole_name}: every pixel is black, so that the area is empty: what is inside must not be black"
            );
        }
        let name = Path::new(&whole_name).file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { name, mask: Arc::new(mask) })
    }

    /// SHA-256 of the mask's pixels, a byte each.
    pub(super) fn sha256(&self) -> String {
        let pixels: Vec<u8> = self.mask.as_slice().iter().map(|&inside| u8::from(inside)).collect();
        photo::sha256_hex(&pixels)
    }

    /// The area in a report.
    pub(super) fn facts(&self) -> AreaFacts {
        AreaFacts::new(&self.name, &self.mask)
    }

    /// The mask, true inside.
    pub(super) fn mask(&self) -> Arc<Mask> {
        Arc::clone(&self.mask)
    }
}

/// How a photograph is analyzed and written.
pub(super) struct Plan<'a> {
    pub(super) params: &'a Params,
    pub(super) area: Option<&'a Area>,
    pub(super) reference: Option<&'a Reference>,
    /// Share of the surface reflection that the matte picture keeps, 0…1.
    pub(super) keep_surface: f64,
    /// Whether a folder that is no earlier result may be replaced.
    pub(super) force: bool,
    /// The files to write.
    pub(super) files: &'a FileChoice,
    /// What ends the analysis and the writing early.
    pub(super) interrupt: &'a Interrupt,
}

/// The outcome of one photograph.
pub(super) struct Finished {
    pub(super) report: Report,
    /// Share of the lit (not dark) pixels that are in a region; none where all pixels are dark.
    pub(super) lit_share: Option<f64>,
}

/// Analyzes a photograph and writes its result to `target`.
pub(super) fn analyze(shot: &LoadedPhoto, plan: &Plan, target: &Path) -> Result<Finished> {
    let mut clock =
        StageClock { begin: None, timings: Timings::default(), interrupt: plan.interrupt.clone() };
    let image = Arc::clone(&shot.photo.image);
    let mut session = Session::new(image);
    if let Some(area) = plan.area {
        session.restrict(Some(Arc::clone(&area.mask))).with_context(|| format!("--area {}", area.name))?;
    }
    let analysis = session.run(plan.params, &mut clock)?;
    let report = truth::report(ReportInput {
        photo: &shot.photo,
        sha256: &shot.sha256,
        params: plan.params,
        analysis: &analysis,
        area: plan.area.map(Area::facts),
        timings_ms: Timings { read: Some(shot.read_ms), ..clock.timings },
        reference: plan
            .reference
            .map(|reference| truth::Reference { truth: &reference.truth, camera: &reference.camera }),
    })?;
    let whole = WholeResult { photo: &shot.photo, analysis: &analysis, keep_surface: plan.keep_surface };
    let goes_on = |_, _| !plan.interrupt.came();
    let report = whole.write_files(plan.files, report, target, plan.force, &goes_on)?;
    Ok(Finished { lit_share: lit_share(&analysis), report })
}

fn lit_share(analysis: &Analysis) -> Option<f64> {
    let labels = analysis.finals.labels.as_slice();
    let of_lit = || labels.par_iter().enumerate().filter(|(pixel, _)| !analysis.masks.dark(*pixel));
    let (lit, assigned) = (of_lit().count(), of_lit().filter(|(_, region)| **region != UNASSIGNED).count());
    (lit > 0).then(|| assigned as f64 / lit as f64)
}

/// Measures the duration of each stage, and ends an interrupted run. The library itself reads no clock.
struct StageClock {
    begin: Option<Instant>,
    timings: Timings,
    interrupt: Interrupt,
}

impl Observer for StageClock {
    fn started(&mut self, _stage: Stage) {
        self.begin = Some(Instant::now());
    }

    fn finished(&mut self, stage: Stage, _reused: bool) {
        let took_ms = self.begin.take().map(ms_since);
        tracing::debug!(stage = stage.name(), took_ms, "finished");
        *self.timings.slot(stage) = took_ms;
    }

    fn cancelled(&self) -> bool {
        self.interrupt.came()
    }
}

/// Milliseconds since `begin`, to the microsecond.
fn ms_since(begin: Instant) -> f64 {
    begin.elapsed().as_micros() as f64 / 1e3
}
