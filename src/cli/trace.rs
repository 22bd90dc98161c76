//! `dichroscope trace`: every decision of an analysis, one JSON object per line.

use super::subject::{AnalyzeError, Subject, Traced, parse_pixel, pixel_inside};
use super::{Outcome, note};
use anyhow::{Context, Result, bail};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use dichroscope::analysis::Analysis;
use dichroscope::describe::{Names, schema_line, second_look_line, second_look_trace_line, trace_line};
use dichroscope::export::PartFile;
use dichroscope::raster::{HypothesisId, Mask, PixelIndex, RegionId};
use dichroscope::trace::{HistoryEntry, SecondLookRecord, Stage, Step, Trace, lineage};
use std::collections::BTreeSet;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Write every decision of an analysis as JSON lines: windows, merges, hypotheses, pixels that change their region, skewed-T tests, kinds of pixels
#[derive(Debug, Args)]
pub struct Arguments {
    /// File to write; - for standard output
    #[arg(long, short, value_name = "FILE.jsonl")]
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
    PossibleValuesParser::new(Stage::ALL.map(Stage::name))
        .try_map(|name| Stage::from_name(&name).ok_or("no such stage"))
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    arguments.subject.with_threads(|| trace(arguments))?
}

fn trace(arguments: &Arguments) -> Result<Outcome> {
    let is_same_file =
        |a: &Path, b: &Path| a.canonicalize().ok().zip(b.canonicalize().ok()).is_some_and(|(a, b)| a == b);
    if is_same_file(&arguments.out, &arguments.subject.image) {
        bail!("--out {}: this is the photograph itself: choose another file", arguments.out.display());
    }
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
    let wanted = Wanted::new(arguments, &traced, pixel_of(&traced.image)?)?;
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
fn write(traced: &Traced, wanted: &Wanted, path: &Path) -> io::Result<()> {
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

fn write_lines(traced: &Traced, wanted: &Wanted, target: impl Write) -> io::Result<()> {
    let mut target = BufWriter::with_capacity(1 << 16, target);
    let trace = &traced.trace;
    let names = Names::of(trace);
    writeln!(target, "{}", schema_line(trace, env!("CARGO_PKG_VERSION")))?;
    let mut line = String::new();
    for (seq, stage, step) in staged_steps(trace) {
        if wanted.steps.includes(seq, stage, &step) {
            line.clear();
            trace_line(&names, seq, stage, &step, &mut line);
            line.push('\n');
            target.write_all(line.as_bytes())?;
        }
    }
    for (index, record) in traced.trace.second_look().iter().enumerate() {
        let Some(steps) = wanted.steps_of_second_look(&traced.analysis, record) else { continue };
        let names = Names::of_second_look(record);
        writeln!(target, "{}", second_look_line(record, index + 1))?;
        for (seq, stage, step) in staged_steps(&record.trace) {
            if steps.includes(seq, stage, &step) {
                line.clear();
                second_look_trace_line(&names, index + 1, seq, stage, &step, &mut line);
                line.push('\n');
                target.write_all(line.as_bytes())?;
            }
        }
    }
    target.flush()
}

/// The steps with their numbers and stages.
fn staged_steps(trace: &Trace) -> impl Iterator<Item = (usize, Stage, Step<'_>)> {
    let mut stages = trace.stages().peekable();
    trace.steps().map_while(move |(seq, step)| {
        while stages.next_if(|(_, steps)| steps.end <= seq).is_some() {}
        stages.peek().map(|(stage, _)| (seq, *stage, step))
    })
}

/// What was asked for.
struct Wanted {
    /// Which steps of the working picture to write.
    steps: StepFilter,
    /// The pixel of the photograph that the steps are about.
    pixel: Option<PixelIndex>,
    /// The region of the result that the steps are about.
    region: Option<RegionId>,
}

impl Wanted {
    fn new(arguments: &Arguments, traced: &Traced, pixel: Option<usize>) -> Result<Self> {
        let Traced { analysis, trace, .. } = traced;
        let pixel = pixel.map(PixelIndex::from_index);
        let region = arguments
            .region
            .map(|number| {
                let count = analysis.intrinsic.regions.len();
                let region = RegionId::from_label(number).filter(|region| region.index() < count);
                region.with_context(|| {
                    format!("--region {number}: the result has {count} regions, numbered from 1")
                })
            })
            .transpose()
            .with_context(|| arguments.subject.image.display().to_string())?;
        let steps = StepFilter {
            stage: arguments.stage,
            pixel: pixel.map(|pixel| {
                PixelFilter::new(analysis.working_pixel(pixel), analysis.pixel_history(trace, pixel))
            }),
            region: region.map(|region| {
                let labels = &analysis.working_finals.labels;
                RegionFilter::new(trace, region, labels.map(|&label| label == region.get()))
            }),
        };
        Ok(Self { steps, pixel, region })
    }

    /// Which steps of one finer picture of the second look to write; none where nothing of the picture was asked for.
    fn steps_of_second_look(&self, analysis: &Analysis, record: &SecondLookRecord) -> Option<StepFilter> {
        let pixel = match self.pixel {
            None => None,
            Some(pixel) => {
                let finer = record.finer_pixel(pixel).filter(|_| record.has_looked_at(pixel))?;
                Some(PixelFilter::new(finer, record.pixel_history(pixel)))
            }
        };
        let region = match self.region {
            None => None,
            Some(region) => {
                let finer = record.region_with_number(region)?;
                let members =
                    record.finer_pixels_where(|pixel| analysis.finals.labels[pixel.index()] == region.get());
                Some(RegionFilter::new(&record.trace, finer, members))
            }
        };
        Some(StepFilter { stage: self.steps.stage, pixel, region })
    }
}

/// Which steps of a trace to write.
struct StepFilter {
    stage: Option<Stage>,
    pixel: Option<PixelFilter>,
    region: Option<RegionFilter>,
}

/// The steps about one pixel of a trace.
struct PixelFilter {
    /// The pixel of the trace.
    pixel: PixelIndex,
    /// The steps of its history.
    steps: BTreeSet<usize>,
}

impl PixelFilter {
    fn new(pixel: PixelIndex, history: Vec<HistoryEntry>) -> Self {
        Self { pixel, steps: history.into_iter().map(|entry| entry.step).collect() }
    }
}

/// The steps about one region of a trace.
struct RegionFilter {
    region: RegionId,
    /// The hypotheses that merged into the region.
    hypotheses: BTreeSet<HypothesisId>,
    /// The pixels of the trace that are in the region.
    members: Mask,
}

impl RegionFilter {
    fn new(trace: &Trace, region: RegionId, members: Mask) -> Self {
        let ancestors = lineage(trace, region).into_iter();
        Self { region, hypotheses: ancestors.map(|ancestor| ancestor.hypothesis).collect(), members }
    }
}

impl StepFilter {
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
            return self.members.as_slice().get(pixel.index()) == Some(&true);
        }
        self.hypotheses.iter().any(|&hypothesis| step.concerns(hypothesis, Some(self.region)))
    }
}
