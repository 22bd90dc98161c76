//! Many photographs: some at a time, each whole or not at all, and a line for each.

use super::inputs::{Job, parent_name};
use super::interrupt::Interrupt;
use super::lines::{Line, Lines, Status};
use super::one::{self, Area, Finished, Plan, RawFile, Reference};
use super::{Outcome, note, place};
use anyhow::{Context, Result, anyhow};
use dichroscope::export::{FileChoice, read_report};
use dichroscope::params::Params;
use dichroscope::photo::ReadOptions;
use dichroscope::truth::find_truth;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::ThreadPool;
use std::io::IsTerminal;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Where the results of a call go, and how the call treats what is there.
pub(super) struct Options {
    pub(super) out: PathBuf,
    /// Folder of ground truth.
    pub(super) truth: Option<PathBuf>,
    /// Share of the surface reflection that the matte picture keeps, 0…1.
    pub(super) keep_surface: f64,
    /// Whether folders that are no earlier results may be replaced.
    pub(super) force: bool,
    /// Whether photographs are analyzed again whose results are there.
    pub(super) again: bool,
    /// Whether nothing but errors is said.
    pub(super) quiet: bool,
}

/// What all photographs of one call have in common.
pub(super) struct Work {
    pub(super) options: Options,
    pub(super) params: Params,
    pub(super) area: Option<Area>,
    pub(super) reading: ReadOptions,
    pub(super) files: FileChoice,
    /// SHA-256 of all that a result depends on besides its photograph.
    pub(super) settings: String,
    /// The file of lines; `None` for a single photograph.
    pub(super) lines: Option<Lines>,
    pub(super) interrupt: Interrupt,
}

/// What became of a photograph.
enum PhotoOutcome {
    Done(Box<Finished>),
    /// The result of an earlier call is there.
    Unchanged,
    Interrupted,
    /// The error, which names the photograph.
    Failed(String),
}

/// Numbers of photographs, and the names of those that failed.
#[derive(Default)]
struct Tally {
    done: usize,
    failed: Vec<String>,
}

impl Work {
    /// Analyzes the photographs, `at_once` at a time, in the threads of `pool`.
    pub(super) fn run(self, jobs: &[Job], at_once: usize, pool: &ThreadPool) -> Outcome {
        let bar = self.progress_bar(jobs.len());
        let (next, tally) = (AtomicUsize::new(0), Mutex::new(Tally::default()));
        std::thread::scope(|scope| {
            for _ in 0..at_once.min(jobs.len()) {
                scope.spawn(|| {
                    while !self.interrupt.came()
                        && let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed))
                    {
                        let ended = pool.install(|| self.analyze(job));
                        self.record_outcome(job, ended, &bar, &tally);
                    }
                });
            }
        });
        bar.finish_and_clear();
        let tally = tally.into_inner().unwrap_or_else(PoisonError::into_inner);
        let interrupted = self.interrupt.came() && tally.done + tally.failed.len() < jobs.len();
        if !tally.failed.is_empty() && jobs.len() > 1 {
            let (failed, all) = (tally.failed.len(), jobs.len());
            note(&format!("{failed} of {all} photographs failed: {}", tally.failed.join(", ")));
        }
        let finished = self.lines.map_or(Ok(()), Lines::finish);
        if let Err(error) = &finished {
            note(&format!("error: {error:#}"));
        }
        if interrupted {
            let (done, all) = (tally.done, jobs.len());
            let call = if self.options.again { "the same call without --again" } else { "the same call" };
            note(&format!(
                "interrupted: {done} of {all} photographs are done; {call} continues with the others"
            ));
            return Outcome::Interrupted;
        }
        let is_done = tally.failed.is_empty() && finished.is_ok();
        if is_done { Outcome::Done } else { Outcome::SomeFailed }
    }

    /// Appends the line of a photograph, prints the outcome and counts the photograph.
    fn record_outcome(&self, job: &Job, ended: PhotoOutcome, bar: &ProgressBar, tally: &Mutex<Tally>) {
        let (name, file) = (&job.name, place::name_of(&job.input));
        let line = match &ended {
            PhotoOutcome::Done(finished) => Some(Line::done(job, &self.settings, finished)),
            PhotoOutcome::Failed(error) => Some(Line::failed(job, error)),
            PhotoOutcome::Unchanged | PhotoOutcome::Interrupted => None,
        };
        let mut ended = ended;
        if let (Some(lines), Some(line)) = (&self.lines, line)
            && let Err(error) = lines.append(&line)
        {
            ended = PhotoOutcome::Failed(format!("{file}: {error:#}"));
        }
        let quiet = self.options.quiet;
        let text = match &ended {
            PhotoOutcome::Done(finished) if !quiet => Some(self.summary(job, finished)),
            PhotoOutcome::Unchanged if !quiet => {
                Some(format!("{}: unchanged \u{2192} {}", name.display(), self.target(job).display()))
            }
            PhotoOutcome::Failed(error) => Some(error.clone()),
            _ => None,
        };
        if let Some(text) = text {
            bar.suspend(|| note(&text));
        }
        let mut tally = tally.lock().unwrap_or_else(PoisonError::into_inner);
        match ended {
            PhotoOutcome::Done(_) | PhotoOutcome::Unchanged => tally.done += 1,
            PhotoOutcome::Failed(_) => tally.failed.push(file),
            PhotoOutcome::Interrupted => return,
        }
        bar.inc(1);
    }

    fn progress_bar(&self, jobs: usize) -> ProgressBar {
        if self.options.quiet || jobs < 2 || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len}  {eta} left");
        ProgressBar::new(jobs as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }

    pub(super) fn target(&self, job: &Job) -> PathBuf {
        self.options.out.join(&job.name)
    }

    /// Whether whatever is in the place of a result may be replaced: as asked for, or because an earlier call wrote it.
    pub(super) fn may_replace(&self, job: &Job) -> bool {
        let earlier = self.lines.as_ref().and_then(|lines| lines.earlier(&job.name));
        self.options.force || earlier.is_some_and(|line| line.status == Status::Done)
    }

    fn analyze(&self, job: &Job) -> PhotoOutcome {
        let file = place::name_of(&job.input);
        // A photograph on which the program fails does not end the others. Its half-changed values are dropped.
        let result = catch_unwind(AssertUnwindSafe(|| self.read_and_write(job)));
        match result {
            Ok(Ok(ended)) => ended,
            Ok(Err(_)) if self.interrupt.came() => PhotoOutcome::Interrupted,
            Ok(Err(error)) => PhotoOutcome::Failed(format!("{error:#}")),
            Err(_) => PhotoOutcome::Failed(format!(
                "{file}: internal error (panic); please report it with the photograph"
            )),
        }
    }

    /// Errors begin with the name of the photograph.
    fn read_and_write(&self, job: &Job) -> Result<PhotoOutcome> {
        // The errors of reading name the file already.
        let file = RawFile::read(&job.input, &self.interrupt)?;
        if !self.options.again && self.is_done(job, file.sha256()) {
            return Ok(PhotoOutcome::Unchanged);
        }
        let shot = file.decode(&self.reading)?;
        let analyzed = || -> Result<Finished> {
            let reference =
                self.options.truth.as_deref().map(|root| reference(root, job, &self.reading)).transpose()?;
            let plan = Plan {
                params: &self.params,
                area: self.area.as_ref(),
                reference: reference.as_ref(),
                keep_surface: self.options.keep_surface,
                force: self.may_replace(job),
                files: &self.files,
                interrupt: &self.interrupt,
            };
            one::analyze(&shot, &plan, &self.target(job))
        };
        Ok(PhotoOutcome::Done(Box::new(analyzed().with_context(|| place::name_of(&job.input))?)))
    }

    /// Whether an earlier call wrote the result of the same photograph with the same settings, and the result is still there.
    fn is_done(&self, job: &Job, sha256: &str) -> bool {
        let Some(line) = self.lines.as_ref().and_then(|lines| lines.earlier(&job.name)) else { return false };
        let target = self.target(job);
        let is_its_report = || read_report(&target).is_ok_and(|report| report.image.sha256 == sha256);
        let is_there = self.files.is_in(&target) && (!self.files.has("report.json") || is_its_report());
        line.status == Status::Done
            && line.sha256.as_deref() == Some(sha256)
            && line.settings.as_deref() == Some(&self.settings)
            && is_there
    }

    /// `plastic8_white: 8 regions, 99.8 % of the lit pixels, light (0.58, 0.57, 0.58), 11 ms → out/plastic8_white`
    fn summary(&self, job: &Job, finished: &Finished) -> String {
        let target = self.target(job);
        format!("{}: {} \u{2192} {}", job.name.display(), in_short(finished), target.display())
    }
}

/// The ground truth of a photograph: the truth folder `root`, or the one that is found under it by the photograph's names.
pub(super) fn reference(root: &Path, job: &Job, reading: &ReadOptions) -> Result<Reference> {
    let parent = parent_name(&job.input);
    let names = [Some(job.name.as_path()), job.name.file_name().map(Path::new), parent.as_deref()];
    let folder = find_truth(root, names.into_iter().flatten())
        .ok_or_else(|| anyhow!("no ground truth for {} in {}", job.name.display(), root.display()))?;
    let file = job.input.file_name().unwrap_or_default().to_string_lossy();
    Reference::read(&folder, &file, reading)
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
    let second = report.illuminant.second.as_ref().map_or_else(String::new, |second| {
        let [r, g, b] = second.direction;
        format!(" and second lamp ({r:.2}, {g:.2}, {b:.2})")
    });
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
    format!(
        "{regions}{poor}, {share}, {light}{second}{ambient}{warnings}, {:.0} ms",
        report.timings_ms.analysis_ms()
    )
}
