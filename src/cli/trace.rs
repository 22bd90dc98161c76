//! `dichroscope trace`: every decision of an analysis, one JSON object per line.

use super::subject::{AnalyzeError, Subject, Traced, parse_pixel, pixel_inside};
use super::{Outcome, note};
use anyhow::{Context, Result, bail};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use dichroscope::describe::{Names, schema_line, trace_line};
use dichroscope::export::PartFile;
use dichroscope::raster::{HypothesisId, PixelIndex, RegionId};
use dichroscope::segment::FinalRegions;
use dichroscope::trace::{Stage, Step, lineage};
use std::collections::BTreeSet;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Write every decision of an analysis as JSON lines: windows, merges, hypotheses, pixels that change their region, skewed-T tests, kinds of pixels
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
    /// Only steps about region N of the result, about the hypotheses that merged into that region, and the kinds of its pixels
    #[arg(long, value_name = "N")]
    region: Option<u16>,
    // This field is the last, because clap extends a heading to all flags that follow it.
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
    // The pixel is checked before the analysis, which takes long.
    let traced = match arguments.subject.analyze(|image| pixel_of(image).map(drop)) {
        Ok(traced) => traced,
        Err(AnalyzeError::Usage(error)) => return Err(error),
        Err(AnalyzeError::File(error)) => {
            note(&format!("{error:#}"));
            return Ok(Outcome::SomeFailed);
        }
    };
    let wanted = StepFilter::new(arguments, &traced, pixel_of(&traced.image)?)?;
    match write(&traced, &wanted, &arguments.out) {
        Ok(()) => Ok(Outcome::Done),
        // A closed pipe (`| head`) is no failure.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(Outcome::Done),
        Err(error) => {
            let name = if is_standard_output(&arguments.out) {
                "standard output".to_owned()
            } else {
                arguments.out.display().to_string()
            };
            note(&format!("{name}: cannot be written: {error}"));
            Ok(Outcome::SomeFailed)
        }
    }
}

/// Writes the lines to standard output, or to a file that appears as a whole.
fn write(traced: &Traced, wanted: &StepFilter, path: &Path) -> io::Result<()> {
    if is_standard_output(path) {
        return write_lines(traced, wanted, io::stdout().lock());
    }
    let mut file = PartFile::begin(path)?;
    write_lines(traced, wanted, &mut file)?;
    file.publish()
}

fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

fn write_lines(traced: &Traced, wanted: &StepFilter, target: impl Write) -> io::Result<()> {
    let mut target = BufWriter::with_capacity(1 << 16, target);
    let trace = &traced.trace;
    let names = Names::of(trace);
    writeln!(target, "{}", schema_line(trace, env!("CARGO_PKG_VERSION")))?;
    let mut line = String::new();
    let mut stages = trace.stages().peekable();
    for (step_number, step) in trace.steps() {
        while stages.next_if(|(_, steps)| steps.end <= step_number).is_some() {}
        let Some((stage, _)) = stages.peek() else { break };
        if wanted.includes(step_number, *stage, &step) {
            line.clear();
            trace_line(&names, step_number, *stage, &step, &mut line);
            line.push('\n');
            target.write_all(line.as_bytes())?;
        }
    }
    target.flush()
}

/// Which steps to write.
struct StepFilter {
    stage: Option<Stage>,
    pixel: Option<PixelFilter>,
    region: Option<RegionFilter>,
}

/// The steps about one pixel.
struct PixelFilter {
    /// The working pixel that contains the pixel of the photograph.
    pixel: PixelIndex,
    /// The steps of its history.
    steps: BTreeSet<usize>,
}

/// The steps about one region.
struct RegionFilter {
    region: RegionId,
    /// The hypotheses that merged into the region.
    hypotheses: BTreeSet<HypothesisId>,
    /// The regions of the working pixels.
    labels: Arc<FinalRegions>,
}

impl StepFilter {
    fn new(arguments: &Arguments, traced: &Traced, pixel: Option<usize>) -> Result<Self> {
        let Traced { analysis, trace, .. } = traced;
        let pixel = pixel.map(|pixel| {
            let pixel = PixelIndex::from_index(pixel);
            let history = analysis.pixel_history(trace, pixel);
            let steps = history.into_iter().map(|entry| entry.step).collect();
            PixelFilter { pixel: analysis.working_pixel(pixel), steps }
        });
        let region = arguments
            .region
            .map(|number| {
                let count = analysis.intrinsic.regions.len();
                let region = RegionId::from_label(number).filter(|region| region.index() < count);
                let Some(region) = region else {
                    bail!("--region {number}: the result has {count} regions, numbered from 1");
                };
                let ancestors = lineage(trace, region).into_iter();
                let hypotheses = ancestors.map(|ancestor| ancestor.hypothesis).collect();
                Ok(RegionFilter { region, hypotheses, labels: Arc::clone(&analysis.working_finals) })
            })
            .transpose()
            .with_context(|| arguments.subject.image.display().to_string())?;
        Ok(Self { stage: arguments.stage, pixel, region })
    }

    fn includes(&self, step_number: usize, stage: Stage, step: &Step) -> bool {
        if self.stage.is_some_and(|wanted| wanted != stage) {
            return false;
        }
        let about_pixel = self
            .pixel
            .as_ref()
            .is_none_or(|wanted| step.pixel() == Some(wanted.pixel) || wanted.steps.contains(&step_number));
        about_pixel && self.region.as_ref().is_none_or(|wanted| wanted.includes(step))
    }
}

impl RegionFilter {
    fn includes(&self, step: &Step) -> bool {
        if let Step::Label { pixel, .. } = step {
            let label = self.labels.labels.as_slice().get(pixel.index()).copied();
            return label.and_then(RegionId::from_label) == Some(self.region);
        }
        self.hypotheses.iter().any(|&hypothesis| step.concerns(hypothesis, Some(self.region)))
    }
}
