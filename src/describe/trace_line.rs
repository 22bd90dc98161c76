//! Trace lines: a run's decisions for scripts, one JSON object a line.
//!
//! `{"seq", "stage", "kind", "ids", "values", "thresholds"}`: number of the step, stage, kind of the decision, its subjects
//! (hypotheses by number under the key `region`, pixels as `[column, row]`, windows and areas by index), the measured values, and
//! their limits. Colors and distances are in counts, variances in counts², angles in degrees; a number
//! that is not finite is `null`. The first line names the schema.
//!
//! The steps of the second look follow, one finer picture after the other. Each picture begins with a line of its own
//! ([`second_look_line`]). Its steps are counted from 0 again and begin with the key `second_look`, the number of the picture; numbers of
//! hypotheses, areas and regions are those of the picture, pixels are those of the photograph.

use super::Names;
use super::events::line_objects;
use super::names::short;
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::trace::{Contest, Measure, SecondLookRecord, Stage, Step, Trace};
use serde_json::{Value, json};
use std::fmt::Write;

/// Version of the trace lines; the version rises when a name or its meaning changes.
pub const TRACE_SCHEMA: u32 = 1;

/// The first line: schema, program, size of the picture, number of steps, steps of each stage, and the region of each
/// hypothesis, in the order of the hypotheses (0: in no region of the result). `scale`, where present, is the side of a working
/// pixel, pixels: all steps are about working pixels, counts of pixels count these, and the `[column, row]` of a working pixel is that
/// of the pixel in its middle.
pub fn schema_line(trace: &Trace, program: &str) -> String {
    let regions = crate::trace::regions_of(trace).unwrap_or_default();
    let regions: Vec<u16> = regions.iter().map(|&region| RegionId::label(region)).collect();
    let [width, height] = trace.pixel_blocks().picture();
    let mut line = json!({
        "schema": TRACE_SCHEMA,
        "program": program,
        "fields": ["seq", "stage", "kind", "ids", "values", "thresholds"],
        "width": width,
        "height": height,
        "steps": trace.len(),
        "stages": stages(trace),
        "regions": regions,
    });
    if trace.pixel_blocks().side() > 1 {
        line["scale"] = json!(trace.pixel_blocks().side());
    }
    line.to_string()
}

/// The line before the steps of the second look in one finer picture, the `number`-th: the rectangle of the photograph, the side of a
/// finer pixel in pixels, and the numbers in the result of the picture's regions (0: not kept), first by the hypothesis that each
/// became, then by their own numbers.
pub fn second_look_line(record: &SecondLookRecord, number: usize) -> String {
    let trace = &record.trace;
    let label = |region: Option<RegionId>| RegionId::label(region);
    let hypotheses = HypothesisId::all(crate::trace::regions_of(trace).unwrap_or_default().len());
    let ([left, top], [width, height]) = (record.corner(), trace.pixel_blocks().picture());
    let line = json!({
        "second_look": number,
        "left": left,
        "top": top,
        "width": width,
        "height": height,
        "scale": trace.pixel_blocks().side(),
        "steps": trace.len(),
        "stages": stages(trace),
        "regions": hypotheses.map(|id| label(record.region_of(id))).collect::<Vec<u16>>(),
        "finals": record.regions.iter().map(|&region| label(region)).collect::<Vec<u16>>(),
    });
    line.to_string()
}

/// First and end step of each stage.
fn stages(trace: &Trace) -> serde_json::Map<String, Value> {
    let of_stage = |(stage, steps): (Stage, std::ops::Range<usize>)| {
        (stage.name().to_owned(), json!([steps.start, steps.end]))
    };
    trace.stages().map(of_stage).collect()
}

/// Appends one step of the second look in its `number`-th finer picture as a line to `out`, without a line break. `names` are those of the
/// picture's record.
pub fn second_look_trace_line(
    names: &Names,
    number: usize,
    seq: usize,
    stage: Stage,
    step: &Step,
    out: &mut String,
) {
    let start = out.len();
    trace_line(names, seq, stage, step, out);
    out.insert_str(start + 1, &format!("\"second_look\":{number},"));
}

/// Appends one step as a line to `out`, without a line break.
pub fn trace_line(names: &Names, seq: usize, stage: Stage, step: &Step, out: &mut String) {
    // A trace has millions of claims and labels: they are written without an object in between. Writing to a string cannot fail.
    let begin = |out: &mut String, kind: &str| {
        let _ = write!(out, "{{\"seq\":{seq},\"stage\":\"{}\",\"kind\":\"{kind}\",", stage.name());
    };
    begin(out, step.kind().name());
    let pixel = |pixel: PixelIndex| {
        let [x, y] = names.position(pixel);
        format!("\"pixel\":[{x},{y}]")
    };
    let _ = match *step {
        Step::Event(event) => {
            let super::events::LineObjects { ids, values, thresholds } = line_objects(names, event);
            write!(out, "\"ids\":{ids},\"values\":{values},\"thresholds\":{thresholds}}}")
        }
        Step::Claim { pixel: at, before, after, contest } => {
            let (values, thresholds) = contest.map_or_else(nothing, |contest| contest_parts(&contest));
            let (at, before, after) = (pixel(at), HypothesisId::label(before), HypothesisId::label(after));
            write!(
                out,
                "\"ids\":{{{at},\"region\":{after},\"from\":{before}}},\"values\":{values},\"thresholds\":{thresholds}}}"
            )
        }
        Step::Refusal { pixel: at, holder, challenger, contest } => {
            let (values, thresholds) = contest_parts(&contest);
            let at = pixel(at);
            write!(
                out,
                "\"ids\":{{{at},\"region\":{holder},\"challenger\":{challenger}}},\"values\":{values},\
                 \"thresholds\":{thresholds}}}"
            )
        }
        Step::Label { pixel: at, kind } => {
            let at = pixel(at);
            let kind = kind.name();
            write!(out, "\"ids\":{{{at}}},\"values\":{{\"role\":\"{kind}\"}},\"thresholds\":{{}}}}")
        }
    };
}

fn nothing() -> (String, String) {
    ("{}".to_owned(), "{}".to_owned())
}

fn contest_parts(contest: &Contest) -> (String, String) {
    let Contest { measure, challenger, holder } = *contest;
    let (name, against) = match measure {
        Measure::Axis => ("axis", "holder"),
        Measure::Plane => ("plane", "holder"),
        Measure::ForeignMatte => ("foreign_matte", "radius"),
        Measure::Vote => ("vote", "all"),
    };
    let (challenger, holder) = (short(challenger), short(holder));
    (format!("{{\"measure\":\"{name}\",\"challenger\":{challenger}}}"), format!("{{\"{against}\":{holder}}}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Event, Pass, PassBegan, PixelKind};

    fn line(step: &Step) -> Value {
        let mut text = String::new();
        trace_line(&Names::default(), 7, Stage::Linear, step, &mut text);
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
    }

    #[test]
    fn a_contested_claim_says_what_was_measured_against_what() {
        let contest = Contest { measure: Measure::Axis, challenger: 2.1, holder: 6.25 };
        let step = Step::Claim {
            pixel: PixelIndex::new(3),
            before: HypothesisId::from_label(1),
            after: HypothesisId::from_label(2),
            contest: Some(contest),
        };
        let expected = json!({
            "seq": 7, "stage": "linear", "kind": "claim",
            "ids": {"pixel": [0, 3], "region": 2, "from": 1},
            "values": {"measure": "axis", "challenger": 2.1},
            "thresholds": {"holder": 6.25},
        });
        assert_eq!(line(&step), expected);
    }

    #[test]
    fn numbers_that_are_none_are_null_and_names_are_text() {
        let contest = Contest { measure: Measure::Vote, challenger: f32::NAN, holder: f32::INFINITY };
        let refusal = line(&Step::Refusal {
            pixel: PixelIndex::new(0),
            holder: HypothesisId::from_index(0),
            challenger: HypothesisId::from_index(1),
            contest,
        });
        assert_eq!(
            (&refusal["values"]["challenger"], &refusal["thresholds"]["all"]),
            (&Value::Null, &Value::Null)
        );
        let pass = line(&Step::Event(&Event::PassBegan(PassBegan { pass: Pass::SmallerWindows(6) })));
        assert_eq!(pass["values"], json!({"pass": "second look", "window_size": 6}));
        let label = line(&Step::Label { pixel: PixelIndex::new(1), kind: PixelKind::Lost });
        assert_eq!(label["values"]["role"], "lost");
    }
}
