//! `dichroscope why`: a pixel's history as text, newest first.

use super::subject::{Subject, Traced, Trouble, parse_pixel, pixel_inside};
use super::{Outcome, note, print};
use anyhow::Result;
use clap::Args;
use dichroscope::intrinsic::PixelKind;
use dichroscope::raster::UNASSIGNED;
use dichroscope::report::{Condensed, Names, condense};
use dichroscope::trace::{lineage, pixel_history};
use std::fmt::Write;

/// Say why a pixel is what it is: its history, newest first, each decision with its numbers
#[derive(Debug, Args)]
pub struct Arguments {
    /// The pixel: column and row, counted from 0
    #[arg(index = 2, value_name = "X,Y", value_parser = parse_pixel)]
    pixel: [usize; 2],
    // Last, as the headings of its flags would hold for what follows them.
    #[command(flatten)]
    subject: Subject,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    arguments.subject.with_threads(|| why(arguments))?
}

fn why(arguments: &Arguments) -> Result<Outcome> {
    let traced = match arguments.subject.analyze(|image| pixel_inside(image, arguments.pixel).map(drop)) {
        Ok(traced) => traced,
        Err(Trouble::Usage(error)) => return Err(error),
        Err(Trouble::File(error)) => {
            note(&format!("{error:#}"));
            return Ok(Outcome::SomeFailed);
        }
    };
    let pixel = pixel_inside(&traced.image, arguments.pixel)?;
    print(&history(&traced, pixel));
    Ok(Outcome::Done)
}

/// What the pixel is, and how it came to that.
fn history(traced: &Traced, pixel: usize) -> String {
    let names = Names::of(&traced.trace);
    let happened = pixel_history(&traced.trace, &traced.image, &traced.analysis.masks, pixel);
    let mut text = headline(traced, &names, pixel);
    text.push('\n');
    let condensed = condense(&happened);
    let digits = traced.trace.len().to_string().len();
    for Condensed { last, times } in condensed.iter().rev() {
        let again = if *times > 1 { format!(" ({times} times, the last one)") } else { String::new() };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:>digits$}  {:<8}  {}{again}",
            last.step,
            last.stage.name(),
            names.happening(last)
        );
    }
    text.push_str(&origin(traced, &names, pixel));
    text
}

/// `pixel (12, 7), colour (120.3, 40.1, 38.8) counts: matte, in region 3`
fn headline(traced: &Traced, names: &Names, pixel: usize) -> String {
    let [r, g, b] = traced.image.pixels[pixel];
    let what = match traced.analysis.finals.labels[pixel] {
        UNASSIGNED => "in no region".to_owned(),
        region => {
            let kind: PixelKind = traced.analysis.intrinsic.kinds[pixel];
            format!("{}, in region {region}", kind.name())
        }
    };
    format!("pixel {}, colour ({r:.1}, {g:.1}, {b:.1}) counts: {what}\n", names.pixel(pixel as u32))
}

/// The hypotheses that the pixel's region is made of, where they are more than one.
fn origin(traced: &Traced, names: &Names, pixel: usize) -> String {
    let ancestors = lineage(&traced.trace, traced.analysis.finals.labels[pixel]);
    if ancestors.len() < 2 {
        return String::new();
    }
    let mut text = format!("\nregion {} is made of\n", traced.analysis.finals.labels[pixel]);
    for ancestor in &ancestors {
        let _ = writeln!(text, "  {:1$}{2}", "", 2 * ancestor.depth, names.ancestor(ancestor));
    }
    text
}
