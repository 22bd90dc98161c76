//! The four tests of a skewed T, and Gershon's test beside them (section 5.4.1).

use super::{Limits, ThresholdTest};
use crate::trace::CandidateTested;

/// The tests of a highlight candidate, in the order in which the tests are made; the last is Gershon's, which decides in the place of the
/// second under the reading `gershon_test` only.
pub fn candidate_tests(test: &CandidateTested) -> [ThresholdTest; 5] {
    let direction = &test.line.direction;
    let least = direction.iter().fold(f64::INFINITY, |least, band| least.min(*band));
    let beyond = (test.line.mean - test.meeting[1]).dot(direction);
    let verdict = test.verdict;
    let gap = ThresholdTest::at_most(
        "gap",
        test.gap,
        "counts",
        "The lines form a skewed T where they pass near enough to one another: within the cylinder's radius, or within \u{3c3}0 under the reading gap_within_noise (section 5.4.1).",
    );
    [
        ThresholdTest { passed: verdict.lines_meet, ..gap },
        ThresholdTest {
            name: "meets at",
            value: test.position_percent,
            limits: Limits::Within(test.position_limits),
            unit: "%",
            passed: verdict.upper_half,
            tip: "Highlights begin in the upper half of the matte line: the 50 % heuristic (section 5.4.1).",
        },
        ThresholdTest {
            name: "least band of its direction",
            value: least,
            limits: Limits::AtLeast(0.0),
            unit: "",
            passed: verdict.positive,
            tip: "Light added at the surface makes no band darker (section 5.4.1).",
        },
        ThresholdTest {
            name: "cluster beyond the line",
            value: beyond,
            limits: Limits::AtLeast(0.0),
            unit: "counts",
            passed: verdict.beyond,
            tip: "The cluster lies where light was added, not where it was taken away (section 5.4.1).",
        },
        ThresholdTest {
            passed: verdict.not_parallel,
            ..ThresholdTest::at_least(
                "Gershon: angle of the lines",
                test.angle_deg,
                "\u{b0}",
                "Gershon's test, which the 50 % heuristic replaces: nearly parallel clusters are two matte areas, clusters that intersect are a matte area and its highlight (section 5.4.1). It decides only under the reading gershon_test.",
            )
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{CandidateVerdict, Measured};
    use crate::view::testing::candidate;

    #[test]
    fn tests_name_the_value_and_its_limit() {
        let texts = |test: &CandidateTested| candidate_tests(test).map(|test| (test.passed, test.text()));
        let passed = texts(&candidate());
        assert_eq!(passed[0], (true, "gap 4.0 \u{2264} 10.0 counts".to_owned()));
        assert_eq!(passed[1], (true, "meets at 75 within 50\u{2013}120 %".to_owned()));
        assert_eq!(passed[3], (true, "cluster beyond the line 30.00 \u{2265} 0.00 counts".to_owned()));
        let verdict = CandidateVerdict {
            lines_meet: false,
            upper_half: false,
            not_parallel: true,
            by_gershon: false,
            is_marked: false,
            positive: true,
            beyond: true,
        };
        let failed = texts(&CandidateTested {
            gap: Measured::new(12.3, 10.0),
            position_percent: 31.0,
            verdict,
            ..candidate()
        });
        assert_eq!(failed[0], (false, "gap 12.3 > 10.0 counts".to_owned()));
        assert_eq!(failed[1], (false, "meets at 31 outside 50\u{2013}120 %".to_owned()));
    }
}
