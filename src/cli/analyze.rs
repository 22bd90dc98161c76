//! `dichroscope analyze`: photographs to result folders.

use super::batch::{Options, Work};
use super::inputs::{self, Job};
use super::interrupt::Interrupt;
use super::lines::Lines;
use super::one::Area;
use super::reading::Reading;
use super::settings::Settings;
use super::{Outcome, note, place};
use anyhow::{Context, Result, bail};
use clap::Args;
use dichroscope::export::{FileChoice, check_target};
use dichroscope::params::Params;
use dichroscope::photo::sha256_hex;
use globset::GlobMatcher;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Analyze photographs: regions, illuminant, body, surface and noise images, and a report of each
#[allow(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
#[derive(Debug, Args)]
pub struct Arguments {
    /// Photographs, or folders that are searched for them; - for standard input
    #[arg(required = true, value_name = "IMAGE|DIR", value_parser = place::parser())]
    inputs: Vec<PathBuf>,
    /// Folder for the results, one folder per photograph
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Of searched folders, only files whose name or relative path matches
    #[arg(long = "match", value_name = "GLOB", value_parser = inputs::parse_pattern)]
    pattern: Option<GlobMatcher>,
    /// Compare with a ground truth folder, or with those found under it by the results' names
    #[arg(long, value_name = "DIR")]
    truth: Option<PathBuf>,
    /// Analyze only the pixels of the photographs that this picture of the same size shows as not black; - for standard input
    #[arg(long, value_name = "MASK", value_parser = place::parser())]
    area: Option<PathBuf>,
    /// Share of the surface reflection that the matte picture keeps: 0 none of it, 1 all
    #[arg(long, value_name = "SHARE", value_parser = share, default_value_t = 0.0)]
    keep_surface: f64,
    /// Write only these files of each result, separated by commas, as in body,matte,report.json
    #[arg(long, value_name = "NAMES", value_parser = files)]
    files: Option<FileChoice>,
    /// Also write body, surface, noise and residual as arrays of NumPy
    #[arg(long)]
    npy: bool,
    /// Replace existing folders even if they are no earlier results
    #[arg(long)]
    force: bool,
    /// Analyze photographs again whose results are there already
    #[arg(long)]
    again: bool,
    /// Number of photographs that are analyzed at the same time: more need more memory [default: 4, or one per thread]
    #[arg(long, value_name = "N", value_parser = super::parse_threads)]
    jobs: Option<NonZeroUsize>,
    /// Only part I of N equal parts of the photographs, for N machines
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<[usize; 2]>,
    /// Number of threads, up to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = super::parse_threads)]
    threads: Option<NonZeroUsize>,
    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    reading: Reading,
}

/// Number of photographs that are analyzed at the same time, unless the call says otherwise.
const JOBS: usize = 4;

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    let reading = arguments.reading.options();
    let params = arguments.settings.params()?;
    Settings::expect_area(&params, arguments.area.is_some())?;
    place::expect_one_standard_input(arguments.area.as_deref(), &arguments.inputs)?;
    let area = arguments.area.as_deref().map(|path| Area::read(path, &reading)).transpose()?;
    let mut found = inputs::plan(&arguments.inputs, arguments.pattern.as_ref(), &arguments.out)?;
    let is_batch = found.has_folders || found.list.len() > 1 || arguments.shard.is_some();
    if let Some([number, count]) = arguments.shard {
        found.list = part(found.list, number, count);
    }
    if arguments.out.exists() && !arguments.out.is_dir() {
        bail!(
            "--out {}: this is a file, and results need a folder: choose another name",
            arguments.out.display()
        );
    }
    if let Some(root) = arguments.truth.as_deref().filter(|root| !root.is_dir()) {
        bail!("--truth {}: no such folder", root.display());
    }
    let threads = arguments.threads.map_or(0, NonZeroUsize::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.context("cannot start the threads")?;
    let files = arguments.files();
    let settings = settings_of(arguments, &params, area.as_ref(), &files)?;
    let lines = is_batch.then(|| Lines::in_folder(&arguments.out, arguments.shard));
    let (options, interrupt) = (arguments.options(), Interrupt::listen()?);
    let work = Work { options, params, area, reading, files, settings, lines, interrupt };
    for job in &found.list {
        check_target(&work.target(job), work.may_replace(job))?;
    }
    for trouble in &found.troubles {
        note(trouble);
    }
    let jobs = arguments.jobs.map_or_else(|| JOBS.min(pool.current_num_threads()), NonZeroUsize::get);
    let outcome = work.run(&found.list, jobs, &pool);
    Ok(if outcome == Outcome::Done && !found.troubles.is_empty() { Outcome::SomeFailed } else { outcome })
}

impl Arguments {
    fn options(&self) -> Options {
        Options {
            out: self.out.clone(),
            truth: self.truth.clone(),
            keep_surface: self.keep_surface,
            force: self.force,
            again: self.again,
            quiet: self.quiet,
        }
    }

    fn files(&self) -> FileChoice {
        let chosen = self.files.clone().unwrap_or_default();
        if self.npy { chosen.with_arrays() } else { chosen }
    }
}

/// Every `count`-th photograph in the order of the names, beginning with the one at `number`, from 1.
fn part(mut jobs: Vec<Job>, number: usize, count: usize) -> Vec<Job> {
    jobs.sort_by(|a, b| a.name.cmp(&b.name));
    jobs.into_iter().skip(number - 1).step_by(count).collect()
}

/// SHA-256 of all that a result depends on besides its photograph.
fn settings_of(
    arguments: &Arguments,
    params: &Params,
    area: Option<&Area>,
    files: &FileChoice,
) -> Result<String> {
    let reading = arguments.reading.options();
    let everything = serde_json::json!({
        "program": env!("CARGO_PKG_VERSION"),
        "params": params,
        "area": area.map(Area::sha256),
        "truth": arguments.truth,
        "keep_surface": arguments.keep_surface,
        "encoding": reading.encoding.to_string(),
        "full_scale": reading.full_scale,
        "files": files.iter().collect::<Vec<_>>(),
    });
    Ok(sha256_hex(&serde_json::to_vec(&everything)?))
}

/// Part and number of parts, as in `3/8`.
fn shard(text: &str) -> Result<[usize; 2], String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some([i.parse().ok()?, n.parse().ok()?]));
    numbers
        .filter(|&[number, count]: &[usize; 2]| number >= 1 && number <= count)
        .ok_or_else(|| "expected the number of a part, from 1, and the number of parts, as in 3/8".to_owned())
}

fn files(text: &str) -> Result<FileChoice, String> {
    FileChoice::of_names(text.split(',').filter(|name| !name.trim().is_empty()))
        .map_err(|error| error.to_string())
        .and_then(|choice| if choice.is_empty() { Err("expected a name".to_owned()) } else { Ok(choice) })
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("expected a number from 0 to 1".to_owned()),
    }
}
