//! `dichroscope why`: a pixel's history as text, newest first.

use super::subject::{AnalyzeError, Subject, Traced, parse_pixel, pixel_inside};
use super::{Outcome, note, print};
use anyhow::Result;
use clap::Args;
use dichroscope::analysis::{Stage, WhatIfObserver, what_if};
use dichroscope::describe::{Condensed, Names, condense, reason_label, what_if_sentence};
use dichroscope::intrinsic::{PixelKind, Reason};
use dichroscope::raster::{PixelIndex, RegionId};
use dichroscope::trace::lineage;
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Write;
use std::io::IsTerminal;

/// Say why a pixel is what it is: its history, newest first, each decision with its numbers
#[derive(Debug, Args)]
pub struct Arguments {
    /// The pixel: column and row, counted from 0
    #[arg(index = 2, value_name = "X,Y", value_parser = parse_pixel)]
    pixel: [usize; 2],
    /// Also search how far each parameter would have to move for the pixel to change its fate: dozens of analyses
    #[arg(long)]
    what_if: bool,
    // Last, because clap extends a heading to all flags that follow it.
    #[command(flatten)]
    subject: Subject,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    arguments.subject.with_threads(|| why(arguments))?
}

fn why(arguments: &Arguments) -> Result<Outcome> {
    let mut traced = match arguments.subject.analyze(|image| pixel_inside(image, arguments.pixel).map(drop)) {
        Ok(traced) => traced,
        Err(AnalyzeError::Usage(error)) => return Err(error),
        Err(AnalyzeError::File(error)) => {
            note(&format!("{error:#}"));
            return Ok(Outcome::SomeFailed);
        }
    };
    let pixel = pixel_inside(&traced.image, arguments.pixel)?;
    let mut outcome = print(&history(&traced, pixel));
    if arguments.what_if && outcome == Outcome::Done {
        outcome = print(&changes(&mut traced, pixel)?);
    }
    Ok(outcome)
}

/// The text for the parameter values at which the pixel's fate changes.
fn changes(traced: &mut Traced, pixel: usize) -> Result<String> {
    let mut bar = Bar::new();
    let found = what_if(&mut traced.session, &traced.params, PixelIndex::from_index(pixel), &mut bar)?;
    bar.0.finish_and_clear();
    let mut text = "\nwhat if\n".to_owned();
    if found.is_empty() {
        text.push_str("  no value of any parameter that was tried changes it\n");
    }
    for what_if in &found {
        let _ = writeln!(text, "  {}", what_if_sentence(what_if));
    }
    Ok(text)
}

/// Shows the progress of a search on a terminal.
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        if !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template("what if {bar:40} {pos}/{len}");
        Self(ProgressBar::new(0).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }
}

impl WhatIfObserver for Bar {
    fn progress(&mut self, done: usize, of: usize) {
        self.0.set_length(of as u64);
        self.0.set_position(done as u64);
    }
}

/// How often a decision was repeated; nothing for one time.
fn again(condensed: &Condensed) -> String {
    match condensed.times {
        0 | 1 => String::new(),
        times => format!(" ({times} times, this is the last)"),
    }
}

/// The text for a pixel: its kind and region, and its history, newest decision first.
fn history(traced: &Traced, pixel: usize) -> String {
    let names = Names::of(&traced.trace);
    let happened = traced.analysis.pixel_history(&traced.trace, PixelIndex::from_index(pixel));
    let mut text = headline(traced, pixel);
    text.push('\n');
    let condensed = condense(&happened);
    let digits = traced.trace.len().to_string().len();
    let second_look = traced.trace.second_look_at(PixelIndex::from_index(pixel));
    // Writing to a string cannot fail.
    if let Some(place) = traced.analysis.pixel_place(PixelIndex::from_index(pixel)) {
        let stage = Stage::Split.name();
        let sentence = names.pixel_place(&place, second_look.is_some());
        let _ = writeln!(text, "{:>digits$}  {stage:<8}  {sentence}", "");
    }
    if let Some(record) = second_look {
        let names = Names::of_second_look(record);
        let happened = record.pixel_history(PixelIndex::from_index(pixel));
        for condensed in condense(&happened).iter().rev() {
            let Condensed { last, .. } = condensed;
            let (stage, sentence) = (last.stage.name(), names.second_look_entry(last));
            let _ = writeln!(text, "{:>digits$}  {stage:<8}  {sentence}{}", "", again(condensed));
        }
    }
    for condensed in condensed.iter().rev() {
        let Condensed { last, .. } = condensed;
        let (step, stage, sentence) = (last.step, last.stage.name(), names.history_entry(last));
        let _ = writeln!(text, "{step:>digits$}  {stage:<8}  {sentence}{}", again(condensed));
    }
    text.push_str(&origin(traced, &names, pixel));
    text
}

/// `pixel (12, 7), color (120.3, 40.1, 38.8) counts: matte, in region 3`, and the reason where the pixel is not explained.
fn headline(traced: &Traced, pixel: usize) -> String {
    let [r, g, b] = traced.image.pixels[pixel];
    let what = match region_of(traced, pixel) {
        None => "in no region".to_owned(),
        Some(region) => {
            let kind: PixelKind = traced.analysis.intrinsic.kinds[pixel];
            format!("{}, in region {region}", kind.name())
        }
    };
    let why = match traced.analysis.intrinsic.reasons[pixel] {
        Reason::Explained => String::new(),
        reason => format!(", not explained: {}", reason_label(reason)),
    };
    let [x, y] = PixelIndex::from_index(pixel).position(traced.image.width());
    format!("pixel ({x}, {y}), color ({r:.1}, {g:.1}, {b:.1}) counts: {what}{why}\n")
}

fn region_of(traced: &Traced, pixel: usize) -> Option<RegionId> {
    RegionId::from_label(traced.analysis.finals.labels[pixel])
}

/// The hypotheses that the pixel's region is made of, where they are more than one.
fn origin(traced: &Traced, names: &Names, pixel: usize) -> String {
    let Some(region) = region_of(traced, pixel) else { return String::new() };
    let of_second_look = traced.trace.second_look_region(region);
    let names_of_second_look = of_second_look.map(|(record, _)| Names::of_second_look(record));
    let names = names_of_second_look.as_ref().unwrap_or(names);
    let ancestors = match of_second_look {
        Some((record, finer)) => lineage(&record.trace, finer),
        None => lineage(&traced.trace, region),
    };
    if ancestors.len() < 2 {
        return String::new();
    }
    let mut text = format!("\nregion {region} is made of\n");
    for ancestor in &ancestors {
        let said = match of_second_look {
            Some(_) => names.second_look_ancestor(ancestor),
            None => names.ancestor(ancestor),
        };
        let _ = writeln!(text, "  {:1$}{said}", "", 2 * ancestor.depth);
    }
    text
}
