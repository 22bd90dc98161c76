//! The command line, one file per command.
//!
//! A command returns an error where it was called wrongly, before any work (exit 2); what fails during the work
//! is reported on one line of stderr each, and the [`Outcome`] says so (exit 1).

mod analyze;
mod evaluate;
mod inputs;
mod one;
mod reading;
mod sample;
mod settings;
mod subject;
mod table;
mod trace;
mod why;

use anyhow::{Result, bail};
use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand};
use dichroscope::truth::sample::SAMPLES;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use tracing_subscriber::EnvFilter;

/// Explain every pixel of a photograph with the Dichromatic Reflection Model, and split it into body and surface
/// reflection.
///
/// `DICHROSCOPE_LOG=debug` in the environment tells of each stage on stderr.
#[derive(Debug, Parser)]
#[command(name = "dichroscope", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// Photograph to open in the window; none: a sample scene
    pub image: Option<PathBuf>,
    /// What to do instead
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What can be done without the window.
#[derive(Debug, Subcommand)]
pub enum Command {
    Analyze(Box<analyze::Arguments>),
    Evaluate(evaluate::Arguments),
    Trace(Box<trace::Arguments>),
    Why(Box<why::Arguments>),
    Screenshot(ScreenshotArguments),
}

/// Draw the window and single views of it as pictures, without a window
#[derive(Debug, clap::Args)]
pub struct ScreenshotArguments {
    /// Photograph to show; none: a sample scene
    pub image: Option<PathBuf>,
    /// Folder to write the pictures to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Size of the whole window in pixels; single views get three fifths of it
    #[arg(long, value_name = "WxH", default_value = "1440x900", value_parser = parse_size)]
    pub size: [u32; 2],
    /// Sample scene to show
    #[arg(long, value_name = "NAME", default_value = dichroscope::truth::sample::NAME, conflicts_with = "image",
        value_parser = PossibleValuesParser::new(SAMPLES.iter().map(|sample| sample.name)))]
    pub scene: String,
}

/// `1440x900` as columns and rows.
fn parse_size(text: &str) -> Result<[u32; 2], String> {
    const SIDES: std::ops::RangeInclusive<u32> = 64..=8192;
    let sides = text.split_once(['x', '\u{d7}']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.filter(|sides: &[u32; 2]| sides.iter().all(|side| SIDES.contains(side))).ok_or_else(|| {
        format!(
            "expected WIDTHxHEIGHT, each from {} to {} pixels, as in 1440x900",
            SIDES.start(),
            SIDES.end()
        )
    })
}

/// Whether every part of the work succeeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Done,
    SomeFailed,
}

/// Starts logging to stderr at the level that the environment variable `DICHROSCOPE_LOG` names.
pub fn start_log() {
    let filter = EnvFilter::try_from_env("DICHROSCOPE_LOG").unwrap_or_else(|_| EnvFilter::new("off"));
    tracing_subscriber::fmt().with_env_filter(filter).with_writer(io::stderr).init();
}

/// Parses the arguments and runs the command that they name.
pub fn run(arguments: Arguments) -> ExitCode {
    let result = match (arguments.command, arguments.image) {
        (Some(Command::Analyze(arguments)), _) => analyze::run(&arguments),
        (Some(Command::Evaluate(arguments)), _) => evaluate::run(&arguments),
        (Some(Command::Trace(arguments)), _) => trace::run(&arguments),
        (Some(Command::Why(arguments)), _) => why::run(&arguments),
        (Some(Command::Screenshot(_)), _) => no_screenshot(),
        (None, None) => sample::run(),
        (None, Some(image)) => no_window(&image),
    };
    match result {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::SomeFailed) => ExitCode::from(1),
        Err(error) => {
            note(&format!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}

fn no_window(image: &std::path::Path) -> Result<Outcome> {
    let image = image.display();
    bail!(
        "this program has no window built in: `dichroscope analyze {image} --out DIR` analyses the photograph"
    )
}

fn no_screenshot() -> Result<Outcome> {
    bail!("this program has no window built in: build it with its default features to draw one")
}

/// Writes a line to stderr. A closed stderr is ignored, because results are still to be written.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Writes text to stdout; a closed stdout is ignored.
pub fn print(text: &str) {
    let _ = io::stdout().lock().write_all(text.as_bytes());
}
