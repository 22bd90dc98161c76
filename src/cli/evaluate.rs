//! `dichroscope evaluate`: results against ground truth.

use super::one::Reference;
use super::{Outcome, note, print, table};
use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use dichroscope::analysis::Session;
use dichroscope::describe::{Report, Scores};
use dichroscope::export::{is_result_folder, read_report};
use dichroscope::photo::{self, ReadOptions};
use dichroscope::truth::sample::CAMERA_FILE;
use dichroscope::truth::{self, CandidateCounts, ResultPictures, doubt_about_truth, find_truth, score};
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Score results against ground truth, with what doing nothing scores beside each figure in decibels
#[derive(Debug, Args)]
pub struct Arguments {
    /// A result folder, or a folder that holds some
    result_dir: PathBuf,
    /// A ground truth folder, or a folder that holds one by each result's name
    #[arg(long, value_name = "DIR")]
    truth: PathBuf,
    /// Print JSON: `{"results": {NAME: scores}, "mean": scores}`
    #[arg(long)]
    json: bool,
    /// Also analyze the photographs again, and count which test of highlight candidates was right: the 50 % heuristic or Gershon's (5.4.1)
    #[arg(long)]
    candidates: bool,
    /// The photograph inside the truth folder [default: the one that the report names, else camera8.png]
    #[arg(long, value_name = "FILE")]
    image: Option<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    let results = find_results(&arguments.result_dir)?;
    let mut scored = Vec::new();
    let mut counted = Vec::new();
    let count = results.len();
    for Found { name, folder } in results {
        match evaluate(arguments, &name, &folder) {
            Ok((scores, counts)) => {
                counted.extend(counts.map(|counts| (name.display().to_string(), counts)));
                scored.push((name.display().to_string(), scores));
            }
            Err(error) => note(&format!("{}: {error:#}", folder.display())),
        }
    }
    let mut text = String::new();
    if arguments.json {
        text = table::json(&scored, &counted)?;
    } else if !scored.is_empty() {
        text = table::aligned(&scored);
        if !counted.is_empty() {
            text = format!("{text}\n{}", table::candidates(&counted));
        }
    }
    let printed = print(&text);
    Ok(if scored.len() == count { printed } else { Outcome::SomeFailed })
}

struct Found {
    name: PathBuf,
    folder: PathBuf,
}

/// The folder itself when it is a result, else all results below it in the order of their names.
fn find_results(root: &Path) -> Result<Vec<Found>> {
    if is_result_folder(root) {
        let name = root.canonicalize().ok().and_then(|path| path.file_name().map(PathBuf::from));
        return Ok(vec![Found { name: name.unwrap_or_else(|| root.to_owned()), folder: root.to_owned() }]);
    }
    if !root.is_dir() {
        bail!("cannot walk {}: there is no such folder", root.display());
    }
    let mut found = Vec::new();
    let visible = |entry: &walkdir::DirEntry| {
        entry.depth() == 0 || !entry.file_name().as_encoded_bytes().starts_with(b".")
    };
    for entry in WalkDir::new(root).sort_by_file_name().into_iter().filter_entry(visible) {
        let entry = entry.with_context(|| format!("cannot walk {}", root.display()))?;
        if entry.file_type().is_dir() && is_result_folder(entry.path()) {
            let name = entry.path().strip_prefix(root).unwrap_or(entry.path()).to_owned();
            found.push(Found { name, folder: entry.into_path() });
        }
    }
    if found.is_empty() {
        bail!("{} holds no result (report.json): `dichroscope analyze` writes one", root.display());
    }
    Ok(found)
}

fn evaluate(arguments: &Arguments, name: &Path, folder: &Path) -> Result<(Scores, Option<CandidateCounts>)> {
    // Candidates are the name itself and each of its folders: `scenes/cup/camera8` belongs to the truth `cup`.
    let components: Vec<&Path> = name.iter().rev().map(Path::new).collect();
    let names = std::iter::once(name).chain(components);
    let truth_folder = find_truth(&arguments.truth, names)
        .ok_or_else(|| anyhow!("no ground truth for {} in {}", name.display(), arguments.truth.display()))?;
    let report = read_report(folder)?;
    let image = match &arguments.image {
        Some(image) if !truth_folder.join(image).is_file() => {
            bail!("--image {image}: not in {}", truth_folder.display())
        }
        Some(image) => image,
        None if report.image.file.is_empty() => CAMERA_FILE,
        None => &report.image.file,
    };
    let Reference { truth, camera } = Reference::read(&truth_folder, image, &ReadOptions::default())?;
    let pictures = ResultPictures::read(folder)?;
    if let Some(doubt) = doubt_about_truth(&truth, &pictures.sum()) {
        note(&format!("{}: warning: {doubt}", folder.display()));
    }
    let ResultPictures { regions, body, surface } = pictures;
    let outcome = truth::Outcome { regions: &regions, body: &body, surface: &surface, report: &report };
    let scores = score(&truth, &camera, &outcome)?;
    if !arguments.candidates {
        return Ok((scores, None));
    }
    let counts = count_candidates(&truth, &truth_folder.join(image), &report)?;
    Ok((scores, Some(counts)))
}

/// Analyzes a photograph as its report says, and counts the tests of highlight candidates.
fn count_candidates(
    truth: &truth::GroundTruth,
    photograph: &Path,
    report: &Report,
) -> Result<CandidateCounts> {
    if let Some(area) = &report.area {
        anyhow::bail!(
            "--candidates analyzes the photograph again, and the area {} of this result is not at hand; \
             analyze the whole photograph, then evaluate that result",
            area.file
        );
    }
    let image = photo::read(photograph, &ReadOptions::default())?.image;
    let (analysis, trace) = Session::new(image).run_traced(&report.params.asked(), &mut ())?;
    CandidateCounts::of(truth, &analysis, &trace)
        .context("the photograph and the ground truth differ in size")
}
