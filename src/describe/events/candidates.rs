//! Highlight candidates (section 5.4.1).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, nothing, vector};
use crate::describe::names::direction;
use crate::describe::{Names, grouped};
use crate::trace::{CandidateChosen, CandidateSource, CandidateTested};
use serde_json::{Value, json};

impl Describe for CandidateTested {
    fn sentence(&self, names: &Names) -> String {
        let failed = failed_tests(self);
        let is_low = self.verdict.is_marked && !self.verdict.upper_half;
        let verdict = match (failed.is_empty(), is_low) {
            (true, true) => "passed, though not in the upper half".to_owned(),
            (true, false) => "passed".to_owned(),
            (false, _) => failed.join("; "),
        };
        format!(
            "{} ({} px) as highlight of {}: the lines pass {:.1} counts from one another, at {:.0} % of the matte line: {verdict}; {}",
            names.candidate(self.candidate),
            grouped(self.pixels),
            names.hypothesis(self.hypothesis),
            self.gap.value,
            self.position_percent,
            gershon(self)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let verdict = self.verdict;
        LineObjects::new(
            json!({"region": self.hypothesis, "candidate": candidate(self.candidate)}),
            json!({
                "pixels": self.pixels,
                "gap": self.gap.value,
                "position_percent": self.position_percent,
                "angle_deg": self.angle_deg.value,
                "direction": vector(&self.line.direction),
                "passed": {
                    "lines_meet": verdict.lines_meet,
                    "upper_half": verdict.upper_half,
                    "positive": verdict.positive,
                    "beyond": verdict.beyond,
                    "not_parallel": verdict.not_parallel,
                },
                "by_gershon": verdict.by_gershon,
                "weight": self.weight,
            }),
            json!({
                "gap": self.gap.limit,
                "position_percent": self.position_limits,
                "angle_deg": self.angle_deg.limit,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let line = super::linear::example_line();
        Self {
            hypothesis: hypothesis(1),
            candidate: CandidateSource::Leftover(6),
            pixels: 120,
            matte: line,
            matte_length: 100.0,
            line,
            meeting: [line.mean, line.mean],
            gap: crate::trace::Measured::new(3.5, 10.0),
            position_percent: 83.0,
            position_limits: [50.0, 110.0],
            angle_deg: crate::trace::Measured::new(43.0, 10.0),
            verdict: crate::trace::CandidateVerdict {
                lines_meet: true,
                upper_half: true,
                not_parallel: true,
                by_gershon: false,
                is_marked: false,
                positive: false,
                beyond: true,
            },
            weight: 0.0,
            with_distorted: false,
        }
    }
}

impl Describe for CandidateChosen {
    fn sentence(&self, names: &Names) -> String {
        format!(
            "{} is the highlight of {}: direction {}",
            names.candidate(self.candidate),
            names.hypothesis(self.hypothesis),
            direction(self.direction.into())
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "candidate": candidate(self.candidate)}),
            json!({"meeting_point": vector(&self.meeting_point), "direction": vector(&self.direction)}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let line = super::linear::example_line();
        Self {
            hypothesis: hypothesis(1),
            candidate: CandidateSource::Hypothesis(hypothesis(2)),
            meeting_point: line.mean,
            direction: line.direction,
        }
    }
}

impl Names {
    /// Where a highlight candidate came from.
    pub fn candidate(&self, source: CandidateSource) -> String {
        match source {
            CandidateSource::Leftover(area) => format!("what is left of area {area}"),
            CandidateSource::Hypothesis(hypothesis) => self.hypothesis(hypothesis),
            CandidateSource::Absorbed(hypothesis) => format!("absorbed {}", self.hypothesis(hypothesis)),
            CandidateSource::Marked => "the highlight cluster of the marked pixels".to_owned(),
        }
    }
}

/// What Gershon's test says of a candidate.
fn gershon(test: &CandidateTested) -> String {
    let verdict = test.verdict;
    let what = match (verdict.not_parallel, verdict.lines_meet) {
        (false, _) => "nearly parallel",
        (true, true) => "they intersect",
        (true, false) => "they do not intersect",
    };
    format!("by Gershon's test {what}, {:.0}\u{b0}", test.angle_deg.value)
}

/// The tests that a candidate failed, each with its numbers.
fn failed_tests(test: &CandidateTested) -> Vec<String> {
    let [low, high] = test.position_limits;
    let at = test.position_percent;
    let verdict = test.verdict;
    let mut failed = Vec::new();
    if !verdict.lines_meet {
        failed
            .push(format!("no skewed T: {:.1} counts apart, at most {:.1}", test.gap.value, test.gap.limit));
    }
    if verdict.by_gershon && !verdict.not_parallel {
        let (angle, least) = (test.angle_deg.value, test.angle_deg.limit);
        failed.push(format!("nearly parallel: {angle:.1}\u{b0}, at least {least:.0}\u{b0} needed"));
    }
    if !verdict.by_gershon && !verdict.upper_half && !verdict.is_marked {
        failed.push(format!("not in the upper half: at {at:.0} %, {low:.0} to {high:.0} % are allowed"));
    }
    if !verdict.positive {
        failed.push(format!("its direction {} is negative in a band", direction(test.line.direction.into())));
    }
    if !verdict.beyond {
        failed.push("it lies on the wrong side of the meeting point".to_owned());
    }
    failed
}

fn candidate(source: CandidateSource) -> Value {
    match source {
        CandidateSource::Leftover(area) => json!({"leftover_of_area": area}),
        CandidateSource::Hypothesis(hypothesis) => json!({"region": hypothesis}),
        CandidateSource::Absorbed(hypothesis) => json!({"absorbed": hypothesis}),
        CandidateSource::Marked => json!("marked"),
    }
}
