//! `dichroscope` alone: the embedded sample scene, analyzed and compared with its ground truth.

use super::batch::in_short;
use super::interrupt::Interrupt;
use super::one::{self, LoadedPhoto, Plan, Reference};
use super::{Outcome, note, print, table};
use anyhow::{Context, Result};
use dichroscope::export::{FileChoice, check_target};
use dichroscope::params::Params;
use dichroscope::photo::ReadOptions;
use dichroscope::truth::sample::{CAMERA_FILE, NAME, SAMPLES};
use std::path::Path;

const TARGET: &str = "dichroscope-sample";

pub(super) fn run() -> Result<Outcome> {
    let target = Path::new(TARGET);
    // This command has no `--force`.
    check_target(target, false).context("the sample's result needs a place: run this in another folder")?;
    match analyze(target) {
        Ok(text) => Ok(print(&text)),
        Err(error) => {
            note(&format!("{NAME}: {error:#}"));
            Ok(Outcome::SomeFailed)
        }
    }
}

fn analyze(target: &Path) -> Result<String> {
    let shot = LoadedPhoto::decode(SAMPLES[0].camera, CAMERA_FILE, &ReadOptions::default())?;
    let truth = SAMPLES[0].truth()?;
    let reference = Reference { truth, camera: shot.photo.image.pixels.clone() };
    let plan = Plan {
        params: &Params::default(),
        area: None,
        reference: Some(&reference),
        keep_surface: 0.0,
        force: false,
        files: &FileChoice::default(),
        interrupt: &Interrupt::default(),
    };
    let finished = one::analyze(&shot, &plan, target)?;
    let place = std::path::absolute(target)?;
    let scores = finished.report.scores.map(|scores| table::aligned(&[(NAME.to_owned(), scores)]));
    Ok(format!(
        "The sample scene {NAME}: {}\n\n{}\nResult: {}\nYour own: dichroscope analyze PHOTO --out DIR\n",
        in_short(&finished),
        scores.unwrap_or_default(),
        place.display()
    ))
}
