//! `dichroscope figures`: the figures and tables of the paper for photographs, as HTML pages.

use super::batch::reference;
use super::inputs::{self, Job, Jobs};
use super::interrupt::Interrupt;
use super::one::{Area, LoadedPhoto, RawFile, Reference};
use super::reading::Reading;
use super::settings::Settings;
use super::{Outcome, note, place, print};
use anyhow::{Context, Result, bail};
use clap::Args;
use dichroscope::analysis::{Observer, Session};
use dichroscope::describe::Timings;
use dichroscope::export::write_file;
use dichroscope::figures::{AnalyzedPhotograph, ComparedScene, Scene, page, side_by_side};
use dichroscope::params::Params;
use dichroscope::photo::ReadOptions;
use dichroscope::truth::sample::{Sample, THREE_LAMPS};
use dichroscope::truth::{self, ReportInput};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Make the figures and tables of the paper for photographs: an HTML page of each, and one that shows several side by side
#[derive(Debug, Args)]
pub struct Arguments {
    /// Photographs, or folders that are searched for them; - for standard input; none: the sample scenes of three cups under three lamps
    #[arg(value_name = "IMAGE|DIR", value_parser = place::parser())]
    inputs: Vec<PathBuf>,
    /// Folder for the pages: NAME-figures.html of each photograph, and figures.html of several
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Compare with a ground truth folder, or with those found under it by the photographs' names
    #[arg(long, value_name = "DIR")]
    truth: Option<PathBuf>,
    /// Analyze only the pixels of the photographs that this picture of the same size shows as not black; - for standard input
    #[arg(long, value_name = "MASK", value_parser = place::parser())]
    area: Option<PathBuf>,
    /// Row of the profiles, counted from 0 [default: the row with most highlight pixels]
    #[arg(long, value_name = "Y")]
    row: Option<usize>,
    /// A white or gray patch to measure the light on: column and row of its first pixel, columns and rows
    #[arg(long, value_name = "X,Y,W,H", value_parser = patch, allow_hyphen_values = true)]
    white: Option<[usize; 4]>,
    /// Text that is printed at the end of the pages, as a date
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    /// Number of threads, up to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = super::parse_threads)]
    threads: Option<NonZeroUsize>,
    // Last, because clap extends a heading to all flags that follow it.
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    reading: Reading,
}

/// What all photographs of one call have in common.
struct Work<'a> {
    arguments: &'a Arguments,
    params: Params,
    reading: ReadOptions,
    area: Option<Area>,
    /// Whether the photographs are sample scenes.
    has_samples: bool,
    /// Whether the photographs' files have the same name, in different folders.
    one_file_name: bool,
    interrupt: Interrupt,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    let (params, reading) = (arguments.settings.params()?, arguments.reading.options());
    Settings::expect_area(&params, arguments.area.is_some())?;
    place::expect_one_standard_input(arguments.area.as_deref(), &arguments.inputs)?;
    let area = arguments.area.as_deref().map(|path| Area::read(path, &reading)).transpose()?;
    let has_samples = arguments.inputs.is_empty();
    if has_samples && arguments.truth.is_some() {
        bail!("--truth is for photographs: the sample scenes have their own ground truth");
    }
    let found = if has_samples { samples() } else { inputs::plan(&arguments.inputs, None, &arguments.out)? };
    if let Some(root) = arguments.truth.as_deref().filter(|root| !root.is_dir()) {
        bail!("--truth {}: no such folder", root.display());
    }
    if arguments.out.is_file() {
        bail!("{} is a file: the pages need a folder", arguments.out.display());
    }
    for trouble in &found.troubles {
        note(trouble);
    }
    let threads = arguments.threads.map_or(0, NonZeroUsize::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.context("cannot start the threads")?;
    let one_file_name = !has_samples
        && found.list.windows(2).all(|pair| pair[0].name.file_name() == pair[1].name.file_name());
    let interrupt = Interrupt::listen()?;
    let work = Work { arguments, params, reading, area, has_samples, one_file_name, interrupt };
    let outcome = pool.install(|| work.run(&found.list));
    Ok(if outcome == Outcome::Done && !found.troubles.is_empty() { Outcome::SomeFailed } else { outcome })
}

/// The jobs of the sample scenes of the three lamps. They are not read from files.
fn samples() -> Jobs {
    let job = |&name: &&str| Job { input: name.into(), name: name.into() };
    let mut jobs = Jobs::default();
    jobs.list.extend(THREE_LAMPS.scenes.iter().map(job));
    jobs
}

impl Work<'_> {
    /// Writes the page of each photograph, and the page that shows all of them; prints the paths.
    fn run(&self, jobs: &[Job]) -> Outcome {
        let (mut outcome, mut compared, mut links) = (Outcome::Done, Vec::new(), Vec::new());
        for job in jobs {
            let address = page_name(job);
            let path = self.arguments.out.join(&address);
            match self.photograph(job, &path, jobs.len() > 1) {
                Ok(scene) => {
                    compared.extend(scene);
                    links.push(link(&address));
                    outcome = outcome.max(print(&format!("{}\n", path.display())));
                }
                Err(_) if self.interrupt.came() => return Outcome::Interrupted,
                Err(error) => {
                    note(&format!("{error:#}"));
                    outcome = Outcome::SomeFailed;
                }
            }
        }
        if compared.len() > 1 {
            let path = self.arguments.out.join("figures.html");
            let html = side_by_side(&compared, &links, self.arguments.date.as_deref());
            outcome = outcome.max(match write_file(&path, html.as_bytes()) {
                Ok(()) => print(&format!("{}\n", path.display())),
                Err(error) => {
                    note(&format!("{:#}", anyhow::Error::from(error)));
                    Outcome::SomeFailed
                }
            });
        }
        outcome
    }

    /// Analyzes a photograph and writes its page. Returned is what is compared with other photographs, where there are
    /// several. Errors name the photograph.
    fn photograph(&self, job: &Job, path: &Path, several: bool) -> Result<Option<ComparedScene>> {
        let (shot, reference) = self.read(job)?;
        let scene = self.scene(shot, reference).with_context(|| place::name_of(&job.input))?;
        let scene = if several { scene.named(&self.shown_name(job)) } else { scene };
        write_file(path, page(&scene, self.arguments.date.as_deref()).as_bytes())?;
        Ok(several.then(|| ComparedScene::of(&scene)))
    }

    /// The name of one of several photographs: its folder where all files have the same name.
    fn shown_name(&self, job: &Job) -> String {
        let folder =
            job.name.parent().filter(|folder| self.one_file_name && folder.components().next().is_some());
        folder.unwrap_or(&job.name).to_string_lossy().into_owned()
    }

    /// Reads a photograph, and its ground truth where there is one. Errors name the photograph.
    fn read(&self, job: &Job) -> Result<(LoadedPhoto, Option<Reference>)> {
        if let Some(sample) = job.name.to_str().filter(|_| self.has_samples).and_then(Sample::find) {
            let shot = LoadedPhoto::decode(sample.camera, sample.name, &ReadOptions::default())?;
            let reference = Reference { truth: sample.truth()?, camera: shot.photo.image.pixels.clone() };
            return Ok((shot, Some(reference)));
        }
        // The errors of reading name the file already.
        let shot = RawFile::read(&job.input, &self.interrupt)?.decode(&self.reading)?;
        let root = self.arguments.truth.as_deref();
        let reference = root.map(|root| reference(root, job, &self.reading)).transpose();
        Ok((shot, reference.with_context(|| place::name_of(&job.input))?))
    }

    fn scene(&self, shot: LoadedPhoto, reference: Option<Reference>) -> Result<Scene> {
        let mut session = Session::new(Arc::clone(&shot.photo.image));
        let area = self.area.as_ref();
        session.restrict(area.map(Area::mask)).context("--area")?;
        let analysis = session.run(&self.params, &mut Watch(self.interrupt.clone()))?;
        let report = truth::report(ReportInput {
            photo: &shot.photo,
            sha256: &shot.sha256,
            params: &self.params,
            analysis: &analysis,
            area: area.map(Area::facts),
            // A page is the same whenever it is made.
            timings_ms: Timings::default(),
            reference: reference
                .as_ref()
                .map(|Reference { truth, camera }| truth::Reference { truth, camera }),
        })?;
        let input = AnalyzedPhotograph {
            photo: shot.photo,
            sha256: shot.sha256,
            params: self.params,
            analysis,
            area: area.map(Area::mask),
            truth: reference.map(|reference| reference.truth),
        };
        let mut scene = Scene::of_photograph(input, report);
        if let Some(row) = self.arguments.row {
            scene = scene.with_row(row).context("--row")?;
        }
        if let Some([x, y, width, height]) = self.arguments.white {
            scene = scene.with_white_patch([x, y], [width, height]).context("--white")?;
        }
        Ok(scene)
    }
}

/// Ends an interrupted run.
struct Watch(Interrupt);

impl Observer for Watch {
    fn cancelled(&self) -> bool {
        self.0.came()
    }
}

/// Path of a photograph's page below the output folder.
fn page_name(job: &Job) -> PathBuf {
    let mut name = job.name.file_name().unwrap_or_default().to_owned();
    name.push("-figures.html");
    job.name.with_file_name(name)
}

/// A relative path as the address of a link (RFC 3986): what is no letter, digit or one of `-._~/` is encoded.
fn link(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let encoded = |byte: u8| match byte {
        b'-' | b'.' | b'_' | b'~' | b'/' => char::from(byte).to_string(),
        byte if byte.is_ascii_alphanumeric() => char::from(byte).to_string(),
        byte => format!("%{byte:02X}"),
    };
    text.bytes().map(encoded).collect()
}

/// `120,40,30,30` as column, row, columns and rows.
fn patch(text: &str) -> Result<[usize; 4], String> {
    let numbers: Option<Vec<usize>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let patch: Option<[usize; 4]> = numbers.and_then(|numbers| numbers.try_into().ok());
    patch.filter(|&[_, _, width, height]| width > 0 && height > 0).ok_or_else(|| {
        "expected column, row, columns and rows of a patch in pixels, as in 120,40,30,30".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_addresses() {
        let job = Job { input: "x".into(), name: "a b/c#1.2".into() };
        assert_eq!(page_name(&job), Path::new("a b/c#1.2-figures.html"));
        assert_eq!(link(&page_name(&job)), "a%20b/c%231.2-figures.html");
    }

    #[test]
    fn a_patch_is_four_numbers_and_not_empty() {
        assert_eq!(patch("1, 2,30,40"), Ok([1, 2, 30, 40]));
        for text in ["", "1,2,3", "1,2,0,4", "1,2,3,4,5", "a,2,3,4"] {
            assert!(patch(text).is_err(), "{text}");
        }
    }
}
