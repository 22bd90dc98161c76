//! A skewed-T test as it is drawn: two lines, and the gap between them (5.4.1).

use crate::color::{Vec3, rgb};
use crate::trace::{CandidateSource, CandidateTested};
use crate::view::Point;

/// A test in the color cube, counts.
#[derive(Clone, Debug, PartialEq)]
pub struct SkewedTView {
    /// The matte line, from its point nearest to black to the brightest matte point.
    pub matte: [Point; 2],
    /// The part of the matte line on which a highlight may begin.
    pub upper: [Point; 2],
    /// The line of the candidate, from the meeting point through the cluster.
    pub line: [Point; 2],
    /// The points of both lines that are nearest to one another.
    pub gap: [Point; 2],
}

/// The test as it is drawn. `reach`: the least and the largest place of the pixels of the candidate on its line, counts from the
/// meeting point; none where they are unknown.
pub fn skewed_t_view(test: &CandidateTested, reach: Option<[f64; 2]>) -> SkewedTView {
    let foot = test.matte.foot();
    let on_matte = |percent: f64| rgb(&(foot + test.matte.direction * (test.matte_length * percent / 100.0)));
    let [meeting, start] = test.meeting;
    let mean = (test.line.mean - start).dot(&test.line.direction);
    let [low, high] = reach.unwrap_or([0.0, 2.0 * mean]);
    let on_line = |at: f64| rgb(&(start + test.line.direction * at));
    SkewedTView {
        matte: [on_matte(0.0), on_matte(100.0)],
        upper: test.position_limits.map(on_matte),
        line: [on_line(low.min(0.0)), on_line(high.max(0.0))],
        gap: [rgb(&meeting), rgb(&start)],
    }
}

/// The name of a candidate.
pub fn candidate_name(source: CandidateSource) -> String {
    match source {
        CandidateSource::Leftover(area) => format!("what is left of area {area}"),
        CandidateSource::Hypothesis(id) => format!("hypothesis {id}"),
        CandidateSource::Absorbed(id) => format!("absorbed hypothesis {id}"),
        CandidateSource::Marked => "the highlight cluster of the marked pixels".to_owned(),
    }
}

/// The least and the largest place of these colors on the candidate's line, counts from the meeting point.
pub fn candidate_reach(test: &CandidateTested, colors: impl Iterator<Item = [f32; 3]>) -> Option<[f64; 2]> {
    let along =
        |color: [f32; 3]| (Vec3::from(color.map(f64::from)) - test.meeting[1]).dot(&test.line.direction);
    colors.map(along).fold(None, |span: Option<[f64; 2]>, at| {
        Some(span.map_or([at, at], |[low, high]| [low.min(at), high.max(at)]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::candidate;

    #[test]
    fn both_lines_lie_where_they_were_fitted_and_the_gap_joins_them() {
        let skewed_t_view = skewed_t_view(&candidate(), None);
        assert_eq!(skewed_t_view.matte, [[0.0, 3.0, 0.0], [200.0, 3.0, 0.0]]);
        assert_eq!(skewed_t_view.upper, [[100.0, 3.0, 0.0], [240.0, 3.0, 0.0]]);
        assert_eq!(skewed_t_view.gap, [[150.0, 3.0, 0.0], [150.0, 7.0, 0.0]]);
        assert_eq!(skewed_t_view.line, [[150.0, 7.0, 0.0], [150.0, 7.0, 60.0]]);
    }

    #[test]
    fn the_candidates_line_spans_its_cluster() {
        let test = candidate();
        let found = candidate_reach(&test, [[140.0, 9.0, -5.0], [150.0, 7.0, 82.0]].into_iter());
        assert_eq!(found, Some([-5.0, 82.0]));
        assert_eq!(skewed_t_view(&test, found).line, [[150.0, 7.0, -5.0], [150.0, 7.0, 82.0]]);
        assert_eq!(candidate_reach(&test, std::iter::empty()), None);
    }
}
