//! `dichroscope trace`: every decision of an analysis, a JSON object a line.

use super::subject::{Subject, Traced, Trouble, parse_pixel, pixel_inside};
use super::{Outcome, note};
use anyhow::{Context, Result, bail};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use dichroscope::describe::{Names, schema_line, trace_line};
use dichroscope::raster::{HypothesisId, PixelIndex, RegionId};
use dichroscope::trace::{Stage, Step, lineage};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Write every decision of an analysis as JSON lines: windows, merges, hypotheses, claims, skewed-T tests, labels
#[derive(Debug, Args)]
pub struct Arguments {
    /// File to write; - for standard output
    #[arg(long, value_name = "FILE.jsonl")]
    out: PathBuf,
    /// Only the steps of one stage
    #[arg(long, value_name = "STAGE", value_parser = stage_parser())]
    stage: Option<Stage>,
    /// Only steps about one pixel: column and row, counted from 0
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    pixel: Option<[usize; 2]>,
    /// Only steps about one region of the result, and the hypotheses that it was made of
    #[arg(long, value_name = "N")]
    region: Option<u16>,
    // Last, because clap extends a heading to all flags that follow it.
    #[command(flatten)]
    subject: Subject,
}

fn stage_parser() -> impl TypedValueParser<Value = Stage> {
    PossibleValuesParser::new(Stage::ALL.map(Stage::name)).map(|name| {
        let named = Stage::ALL.into_iter().find(|stage| stage.name() == name);
        named.expect("invariant: only the stages' names are possible values")
    })
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    arguments.subject.with_threads(|| trace(arguments))?
}

fn trace(arguments: &Arguments) -> Result<Outcome> {
    let pixel_of = |image: &_| arguments.pixel.map(|pixel| pixel_inside(image, pixel)).transpose();
    let traced = match arguments.subject.analyze(|image| pixel_of(image).map(drop)) {
        Ok(traced) => traced,
        Err(Trouble::Usage(error)) => return Err(error),
        Err(Trouble::File(error)) => {
            note(&format!("{error:#}"));
            return Ok(Outcome::SomeFailed);
        }
    };
    let wanted = Wanted::new(arguments, &traced, pixel_of(&traced.image)?)?;
    match write(&traced, &wanted, &arguments.out) {
        Ok(()) => Ok(Outcome::Done),
        // A closed pipe (`| head`) is no failure.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(Outcome::Done),
        Err(error) => {
            note(&format!("{}: {error}", arguments.out.display()));
            Ok(Outcome::SomeFailed)
        }
    }
}

fn write(traced: &Traced, wanted: &Wanted, path: &Path) -> io::Result<()> {
    let target: Box<dyn Write> =
        if path == Path::new("-") { Box::new(io::stdout().lock()) } else { Box::new(File::create(path)?) };
    let mut target = BufWriter::with_capacity(1 << 16, target);
    let trace = &traced.trace;
    let names = Names::of(trace);
    writeln!(target, "{}", schema_line(trace, env!("CARGO_PKG_VERSION")))?;
    let mut line = String::new();
    let mut stages = trace.stages().peekable();
    for (seq, step) in trace.steps() {
        while stages.next_if(|(_, steps)| steps.end <= seq).is_some() {}
        let Some((stage, _)) = stages.peek() else { break };
        if wanted.holds(seq, *stage, &step) {
            line.clear();
            trace_line(&names, seq, *stage, &step, &mut line);
            line.push('\n');
            target.write_all(line.as_bytes())?;
        }
    }
    target.flush()
}

/// Which steps to write.
struct Wanted {
    stage: Option<Stage>,
    /// A working pixel, and the steps of its history.
    pixel: Option<(PixelIndex, BTreeSet<usize>)>,
    /// The hypotheses that made a region, and the region.
    regions: Option<(BTreeSet<HypothesisId>, RegionId)>,
}

impl Wanted {
    fn new(arguments: &Arguments, traced: &Traced, pixel: Option<usize>) -> Result<Self> {
        let Traced { analysis, trace, .. } = traced;
        let pixel = pixel.map(|pixel| {
            let pixel = PixelIndex::from_index(pixel);
            let history = analysis.pixel_history(trace, pixel);
            (analysis.working_pixel(pixel), history.into_iter().map(|happening| happening.step).collect())
        });
        let regions = arguments
            .region
            .map(|number| {
                let count = analysis.intrinsic.regions.len();
                let region = RegionId::from_label(number).filter(|region| region.index() < count);
                let Some(region) = region else {
                    bail!("--region {number}: the result has {count} regions, numbered from 1");
                };
                let ancestors = lineage(trace, region).into_iter();
                Ok((ancestors.map(|ancestor| ancestor.hypothesis).collect(), region))
            })
            .transpose()
            .with_context(|| arguments.subject.image.display().to_string())?;
        Ok(Self { stage: arguments.stage, pixel, regions })
    }

    fn holds(&self, seq: usize, stage: Stage, step: &Step) -> bool {
        if self.stage.is_some_and(|wanted| wanted != stage) {
            return false;
        }
        let about_pixel = self
            .pixel
            .as_ref()
            .is_none_or(|(wanted, history)| step.pixel() == Some(*wanted) || history.contains(&seq));
        about_pixel
            && self.regions.as_ref().is_none_or(|(hypotheses, region)| {
                hypotheses.iter().any(|&hypothesis| step.concerns(hypothesis, Some(*region)))
            })
    }
}
