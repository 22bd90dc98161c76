//! The report of the skewed T of marked pixels (section 6, the method by hand).

use crate::analysis::Analysis;
use crate::baseline::MarkedSkewedT;
use crate::params::{Method, Params};
use serde::{Deserialize, Serialize};

/// How the matte and the highlight line of marked pixels meet, whether or not they passed the tests of a skewed T.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SkewedTFacts {
    /// Number of pixels that the highlight line was fitted to, in working pixels.
    pub highlight_pixels: usize,
    /// Root mean square distance of these pixels from the highlight line, counts.
    pub highlight_rms_counts: f64,
    /// Point of the matte line that is nearest to the highlight line, counts.
    pub meeting_point: [f64; 3],
    /// Distance between both lines, counts.
    pub gap_counts: f64,
    /// Place of the meeting point on the matte line, percent of its length from black: above 50 by the heuristic of section 3.2.
    pub position_percent: f64,
    /// Angle between both lines, degrees.
    pub angle_deg: f64,
    /// Whether the lines passed the tests of section 5.4.1, of which the 50 % heuristic does not decide.
    pub accepted: bool,
}

impl SkewedTFacts {
    /// The facts of an analysis; `None` under another method, and without a highlight line.
    pub(super) fn new(params: &Params, analysis: &Analysis) -> Option<Self> {
        let found = MarkedSkewedT::of(&analysis.matte, &analysis.planar)?;
        let accepted = analysis.planar.hypotheses.first().is_some_and(|planar| planar.highlight.is_some());
        (params.method == Method::ByHand).then_some(Self {
            highlight_pixels: found.highlight_pixels,
            highlight_rms_counts: found.highlight_rms_counts,
            meeting_point: found.meeting_point,
            gap_counts: found.gap_counts,
            position_percent: found.position_percent,
            angle_deg: found.angle_deg,
            accepted,
        })
    }
}
