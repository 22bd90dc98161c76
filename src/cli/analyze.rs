//! `dichroscope analyze`: photographs to result folders.

use super::inputs::{self, Job, parent_name};
use super::one::{self, Area, Finished, Plan, Reference, Shot};
use super::reading::Reading;
use super::settings::Settings;
use super::{Outcome, note};
use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use dichroscope::export::check_target;
use dichroscope::params::Params;
use dichroscope::photo::ReadOptions;
use dichroscope::truth::find_truth;
use globset::GlobMatcher;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::io::IsTerminal;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Analyze photographs: regions, illuminant, body, surface and noise images, and a report of each
#[derive(Debug, Args)]
pub struct Arguments {
    /// Photographs, or folders that are searched for them
    #[arg(required = true, value_name = "IMAGE|DIR")]
    inputs: Vec<PathBuf>,
    /// Folder for the results, one folder per photograph
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Of searched folders, only files whose name or relative path matches
    #[arg(long = "match", value_name = "GLOB", value_parser = inputs::parse_pattern)]
    pattern: Option<GlobMatcher>,
    /// Compare with a ground truth folder, or with those found under it by the results' names
    #[arg(long, value_name = "DIR")]
    truth: Option<PathBuf>,
    /// Analyze only the pixels of the photographs that this picture of the same size shows as not black
    #[arg(long, value_name = "MASK")]
    area: Option<PathBuf>,
    /// Share of the surface reflection that the matte picture keeps: 0 none of it, 1 all
    #[arg(long, value_name = "SHARE", value_parser = share, default_value_t = 0.0)]
    keep_surface: f64,
    /// Replace existing folders even if they are no earlier results
    #[arg(long)]
    force: bool,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    reading: Reading,
}

/// What all photographs of one call have in common.
struct Work<'a> {
    arguments: &'a Arguments,
    params: Params,
    area: Option<Area>,
    reading: ReadOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    let reading = arguments.reading.options();
    let params = arguments.settings.params()?;
    let area = arguments.area.as_deref().map(|path| Area::read(path, &reading)).transpose()?;
    let work = Work { arguments, params, area, reading };
    let jobs = inputs::plan(&arguments.inputs, arguments.pattern.as_ref(), &arguments.out)?;
    for job in &jobs {
        check_target(&work.target(job), arguments.force)?;
    }
    if let Some(root) = arguments.truth.as_deref().filter(|root| !root.is_dir()) {
        bail!("--truth {}: no such folder", root.display());
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads.map_or(0, NonZeroUsize::get));
    let pool = threads.build().context("cannot start the threads")?;
    Ok(pool.install(|| work.run(&jobs)))
}

impl Work<'_> {
    fn run(&self, jobs: &[Job]) -> Outcome {
        let bar = self.progress_bar(jobs.len());
        // Photographs are handed out one at a time: with larger portions one thread would end with several in a row.
        let done = jobs.par_iter().with_max_len(1).map(|job| {
            let result = self.analyze(job);
            match &result {
                Ok(finished) if !self.arguments.quiet => bar.suspend(|| note(&self.summary(job, finished))),
                Ok(_) => {}
                Err(error) => bar.suspend(|| note(&format!("{error:#}"))),
            }
            bar.inc(1);
            result.is_ok()
        });
        let all_done = done.reduce(|| true, |a, b| a && b);
        bar.finish_and_clear();
        if all_done { Outcome::Done } else { Outcome::SomeFailed }
    }

    fn progress_bar(&self, jobs: usize) -> ProgressBar {
        if self.arguments.quiet || jobs < 2 || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len}  {eta} left");
        ProgressBar::new(jobs as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }

    fn target(&self, job: &Job) -> PathBuf {
        self.arguments.out.join(&job.name)
    }

    /// Errors begin with the name of the photograph.
    fn analyze(&self, job: &Job) -> Result<Finished> {
        // The error of `read` names the file already.
        let shot = Shot::read(&job.input, &self.reading)?;
        self.compare_and_write(job, &shot).with_context(|| job.input.display().to_string())
    }

    fn compare_and_write(&self, job: &Job, shot: &Shot) -> Result<Finished> {
        let reference = self.arguments.truth.as_deref().map(|root| self.reference(root, job)).transpose()?;
        let plan = Plan {
            params: &self.params,
            area: self.area.as_ref(),
            reference: reference.as_ref(),
            keep_surface: self.arguments.keep_surface,
            force: self.arguments.force,
        };
        one::analyze(shot, &plan, &self.target(job))
    }

    fn reference(&self, root: &Path, job: &Job) -> Result<Reference> {
        let parent = parent_name(&job.input);
        let names = [Some(job.name.as_path()), job.name.file_name().map(Path::new), parent.as_deref()];
        let folder = find_truth(root, names.into_iter().flatten())
            .ok_or_else(|| anyhow!("no ground truth for {} in {}", job.name.display(), root.display()))?;
        let file = job.input.file_name().unwrap_or_default().to_string_lossy();
        Reference::read(&folder, &file, &self.reading)
    }

    /// `plastic8_white: 8 regions, 99.8 % of the lit pixels, light (0.58, 0.57, 0.58), 11 ms → out/plastic8_white`
    fn summary(&self, job: &Job, finished: &Finished) -> String {
        let target = self.target(job);
        format!("{}: {} \u{2192} {}", job.name.display(), in_short(finished), target.display())
    }
}

/// The numbers of regions, share of lit pixels and light for the line of a finished photograph.
pub(super) fn in_short(finished: &Finished) -> String {
    let Finished { report, lit_share } = finished;
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let share = lit_share
        .map_or("no lit pixels".to_owned(), |share| format!("{:.1} % of the lit pixels", 100.0 * share));
    let light = report
        .illuminant
        .direction
        .map_or("light unknown".to_owned(), |[r, g, b]| format!("light ({r:.2}, {g:.2}, {b:.2})"));
    let ambient = report
        .ambient
        .subtracted
        .map_or_else(String::new, |[r, g, b]| format!(", less ambient ({r:.1}, {g:.1}, {b:.1}) counts"));
    let regions = count(report.regions.len(), "region");
    let poor = |region: &&dichroscope::describe::RegionFacts| region.fit_rms_counts > region.fit_limit_counts;
    let poor = report.regions.iter().filter(poor).count();
    let poor = if poor == 0 { String::new() } else { format!(" ({poor} of poor fit)") };
    let warnings = match report.warnings.len() {
        0 => String::new(),
        n => format!(", {}", count(n, "warning")),
    };
    format!("{regions}{poor}, {share}, {light}{ambient}{warnings}, {:.0} ms", report.timings_ms.analysis_ms())
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("expected a number from 0 to 1".to_owned()),
    }
}
