//! Highlight candidates and their skewed-T tests (section 5.4.1).

use super::{EventData, Subject};
use crate::color::{Line, Vec3};
use crate::raster::HypothesisId;
use crate::trace::Measured;

/// A neighbor was tested as the highlight of a hypothesis (section 5.4.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CandidateTested {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The neighbor.
    pub candidate: CandidateSource,
    /// Number of pixels of the neighbor.
    pub pixels: u32,
    /// The matte line of the hypothesis.
    pub matte: Line,
    /// Length of the matte line from black, counts.
    pub matte_length: f64,
    /// The line of the neighbor.
    pub line: Line,
    /// The points of both lines that are nearest to one another: on the matte line, on the line of the neighbor.
    pub meeting: [Vec3; 2],
    /// Distance between the two lines, and the largest allowed, counts.
    pub gap: Measured<f64>,
    /// Place of the meeting point on the matte line, in % of the length of the line.
    pub position_percent: f64,
    /// Lowest and highest place allowed, in %.
    pub position_limits: [f64; 2],
    /// Gershon's test: the angle between both lines, and the least angle of clusters that are not nearly parallel, degrees.
    pub angle_deg: Measured<f64>,
    /// Which tests the neighbor passed.
    pub verdict: CandidateVerdict,
    /// Weight of the candidate among those that passed, pixels; 0 if the candidate failed.
    pub weight: f64,
    /// Whether a candidate of leftover pixels contains clipped and bloomed pixels (reading `distorted_candidates`).
    pub with_distorted: bool,
}

/// The highlight line of a hypothesis was chosen from the candidates that passed (section 5.4.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CandidateChosen {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The candidate whose meeting point lies nearest to the mean of all meeting points.
    pub candidate: CandidateSource,
    /// Weighted mean of the meeting points, counts.
    pub meeting_point: Vec3,
    /// Unit direction of the highlight line.
    pub direction: Vec3,
}

/// The source of a highlight candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CandidateSource {
    /// The pixels of a merged area (by its first window) that no hypothesis claimed.
    Leftover(u32),
    /// A neighboring hypothesis.
    Hypothesis(HypothesisId),
    /// A hypothesis that was absorbed as a broad highlight.
    Absorbed(HypothesisId),
    /// The marked pixels that are nearer to the highlight line (the method by hand).
    Marked,
}

/// The tests of a highlight candidate, each true when passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(clippy::struct_excessive_bools, reason = "five independent verdicts, and which of them decide")]
#[non_exhaustive]
pub struct CandidateVerdict {
    /// The lines pass near enough to one another to form a skewed T.
    pub lines_meet: bool,
    /// The lines meet in the upper 50 % of the matte line.
    pub upper_half: bool,
    /// Gershon's test: the lines are not nearly parallel. Where they also meet, the clusters intersect.
    pub not_parallel: bool,
    /// Whether Gershon's test decides in the place of the 50 % heuristic (reading `gershon_test`).
    pub by_gershon: bool,
    /// Whether a person has marked the pixels of both clusters as one object: then the place at which the lines meet does not decide.
    pub is_marked: bool,
    /// The candidate's direction is positive in every band.
    pub positive: bool,
    /// The mean of the candidate lies beyond the meeting point.
    pub beyond: bool,
}

impl CandidateVerdict {
    /// Whether every test was passed.
    pub fn accepted(self) -> bool {
        if self.by_gershon { self.accepted_by_gershon() } else { self.accepted_by_position() }
    }

    /// Whether the 50 % heuristic decides and is not passed.
    pub fn fails_upper_half(self) -> bool {
        !self.by_gershon && !self.is_marked && !self.upper_half
    }

    /// Whether Gershon's test decides and is not passed.
    pub fn fails_not_parallel(self) -> bool {
        self.by_gershon && !self.not_parallel
    }

    /// Whether every test was passed, with the 50 % heuristic, which does not decide for marked pixels.
    pub fn accepted_by_position(self) -> bool {
        self.lines_meet && (self.upper_half || self.is_marked) && self.positive && self.beyond
    }

    /// Whether every test was passed, with Gershon's test in the place of the 50 % heuristic.
    pub fn accepted_by_gershon(self) -> bool {
        self.lines_meet && self.not_parallel && self.positive && self.beyond
    }
}

impl EventData for CandidateTested {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for CandidateChosen {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_fails_a_candidate_only_where_the_test_decides() {
        let passed = CandidateVerdict {
            lines_meet: true,
            upper_half: true,
            not_parallel: true,
            by_gershon: false,
            is_marked: false,
            positive: true,
            beyond: true,
        };
        assert!(passed.accepted() && !passed.fails_upper_half() && !passed.fails_not_parallel());
        let low = CandidateVerdict { upper_half: false, ..passed };
        let parallel = CandidateVerdict { not_parallel: false, ..passed };
        for by_gershon in [false, true] {
            let [low, parallel] = [low, parallel].map(|verdict| CandidateVerdict { by_gershon, ..verdict });
            assert_eq!((low.fails_upper_half(), parallel.fails_not_parallel()), (!by_gershon, by_gershon));
            assert_eq!((low.accepted(), parallel.accepted()), (by_gershon, !by_gershon));
        }
        assert!(!CandidateVerdict { is_marked: true, ..low }.fails_upper_half());
    }
}
