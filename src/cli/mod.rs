//! The command line, one file per command.
//!
//! A command returns an error where it was called wrongly, before any work (exit 2); what fails during the work
//! is reported on one line of stderr each, and the [`Outcome`] says so (exit 1).

mod analyze;
mod batch;
mod compare;
mod evaluate;
mod figures;
mod inputs;
mod interrupt;
mod lines;
mod names;
mod one;
mod place;
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
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tracing_subscriber::EnvFilter;

/// Explain every pixel of a photograph with the Dichromatic Reflection Model, and split it into body and surface
/// reflection.
///
/// `DICHROSCOPE_LOG=debug` in the environment tells of each stage on stderr.
#[derive(Debug, Parser)]
#[command(name = "dichroscope", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// Photographs, folders of photographs, or a workspace to open in the window, the first photograph shown; none: a sample scene
    #[arg(value_name = "IMAGE", value_parser = place::parser())]
    pub images: Vec<PathBuf>,
    /// Label map of another program, to hold against the result in the window
    #[arg(long, value_name = "FILE")]
    pub labels: Option<PathBuf>,
    /// Diffuse picture of another program, to hold against the result in the window
    #[arg(long, value_name = "FILE")]
    pub diffuse: Option<PathBuf>,
    /// What to do instead
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What can be done without the window.
#[derive(Debug, Subcommand)]
pub enum Command {
    Analyze(Box<analyze::Arguments>),
    Evaluate(evaluate::Arguments),
    Figures(Box<figures::Arguments>),
    Compare(compare::Arguments),
    Trace(Box<trace::Arguments>),
    Why(Box<why::Arguments>),
    Screenshot(ScreenshotArguments),
}

/// Draw the window and single views of it as pictures, without a window
#[derive(Debug, clap::Args)]
pub struct ScreenshotArguments {
    /// Photograph to show; none: a sample scene
    #[arg(value_parser = place::parser())]
    pub image: Option<PathBuf>,
    /// Folder to write the pictures to
    #[arg(long, short, value_name = "DIR")]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Outcome {
    Done,
    SomeFailed,
    Interrupted,
}

/// Starts logging to stderr at the level that the environment variable `DICHROSCOPE_LOG` names.
pub fn start_log() {
    let filter = EnvFilter::try_from_env("DICHROSCOPE_LOG").unwrap_or_else(|_| EnvFilter::new("off"));
    tracing_subscriber::fmt().with_env_filter(filter).with_writer(io::stderr).init();
}

/// Parses the arguments and runs the command that they name.
pub fn run(arguments: Arguments) -> ExitCode {
    let result = match arguments.command {
        Some(Command::Analyze(arguments)) => analyze::run(&arguments),
        Some(Command::Evaluate(arguments)) => evaluate::run(&arguments),
        Some(Command::Figures(arguments)) => figures::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Trace(arguments)) => trace::run(&arguments),
        Some(Command::Why(arguments)) => why::run(&arguments),
        Some(Command::Screenshot(_)) => no_screenshot(),
        None if arguments.labels.is_some() || arguments.diffuse.is_some() => no_window_for_elsewhere(),
        None if arguments.images.is_empty() => sample::run(),
        None => no_window(&arguments.images),
    };
    match result {
        Ok(outcome) => end_of(outcome),
        Err(error) => {
            note(&format!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}

/// Fails where the window, or pictures of it, cannot show what the call names: standard input, as they read a file again when its
/// encoding is changed; a word that is neither a file nor a command; pictures of another program beside several photographs.
///
/// # Errors
/// What to do instead.
pub fn expect_files_to_show(arguments: &Arguments) -> Result<()> {
    let images: Vec<&Path> = match &arguments.command {
        None => arguments.images.iter().map(PathBuf::as_path).collect(),
        Some(Command::Screenshot(arguments)) => arguments.image.iter().map(PathBuf::as_path).collect(),
        Some(_) => Vec::new(),
    };
    if images.iter().any(|image| place::is_standard_input(image)) {
        bail!(
            "the window cannot show standard input: save the photograph to a file; `analyze`, `trace` and `why` read it"
        );
    }
    let is_unknown = |image: &&&Path| arguments.command.is_none() && is_bare_word(image) && !image.exists();
    if let Some(word) = images.iter().find(is_unknown) {
        bail!("{}: there is no such file and no such command; --help lists the commands", word.display());
    }
    let are_several = images.len() > 1 || images.iter().any(|image| image.is_dir());
    if are_several && (arguments.labels.is_some() || arguments.diffuse.is_some()) {
        bail!(
            "--labels and --diffuse belong to one photograph: name that one alone, and open the others in the window"
        );
    }
    Ok(())
}

/// Whether a path is one name without an extension, as that of a command is.
fn is_bare_word(path: &Path) -> bool {
    path.extension().is_none() && path.components().count() == 1
}

fn no_window(images: &[PathBuf]) -> Result<Outcome> {
    let images: Vec<String> = images.iter().map(|image| image.display().to_string()).collect();
    let (images, what) =
        (images.join(" "), if images.len() == 1 { "the photograph" } else { "the photographs" });
    bail!("this program has no window built in: `dichroscope analyze {images} --out DIR` analyses {what}")
}

fn no_window_for_elsewhere() -> Result<Outcome> {
    bail!(
        "--labels and --diffuse are for the window, and this program has no window built in: \
         `dichroscope compare RESULT_DIR --labels FILE --diffuse FILE` holds the files against a result"
    )
}

fn no_screenshot() -> Result<Outcome> {
    bail!("this program has no window built in: build it with its default features to draw one")
}

/// Writes a line to stderr. A closed stderr is ignored, because results are still to be written.
pub fn note(line: &str) {
    // A name may hold line ends, and characters that a terminal would obey.
    let line = line.replace(char::is_control, "\u{fffd}");
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Writes text to stdout. A stdout that nobody reads any more (`| head`) is no failure; one that cannot be written, as a full
/// disk, is reported and fails.
fn print(text: &str) -> Outcome {
    let mut stdout = io::stdout().lock();
    written(stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()))
}

/// Reports an error of writing to stdout.
fn written(result: io::Result<()>) -> Outcome {
    match result {
        Ok(()) => Outcome::Done,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Outcome::Done,
        Err(error) => {
            note(&format!("standard output: cannot be written: {error}"));
            Outcome::SomeFailed
        }
    }
}

/// Writes text to stdout; the exit code of a program that does nothing else.
#[cfg(feature = "gui")]
pub fn print_and_end(text: &str) -> ExitCode {
    end_of(print(text))
}

fn end_of(outcome: Outcome) -> ExitCode {
    match outcome {
        Outcome::Done => ExitCode::SUCCESS,
        Outcome::SomeFailed => ExitCode::from(1),
        Outcome::Interrupted => ExitCode::from(interrupt::EXIT_CODE),
    }
}

/// Parses the arguments. Help and version go to stdout, a wrong call to stderr; both end the program with the code returned.
///
/// # Errors
/// The exit code where there is nothing to run.
pub fn parse() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| {
        if error.use_stderr() {
            let _ = error.print();
            return ExitCode::from(2);
        }
        end_of(written(error.print().and_then(|()| io::stdout().flush())))
    })
}

/// A number of threads.
fn parse_threads(text: &str) -> Result<NonZeroUsize, String> {
    const MOST: usize = 1024;
    match text.parse::<NonZeroUsize>() {
        Ok(number) if number.get() <= MOST => Ok(number),
        _ => Err(format!("expected a whole number from 1 to {MOST}")),
    }
}
