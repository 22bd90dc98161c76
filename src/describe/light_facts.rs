//! What the report says of noise, ambient light and illuminant.

use super::light_words::{ambient_reason, light_reason};
use crate::analysis::Analysis;
use crate::intrinsic::Ambient;
use crate::segment::{LightBasis, LightFindings};
use serde::{Deserialize, Serialize};

/// The ambient light (section 7.5).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AmbientFacts {
    /// Subtracted before the split and added to the body image after it, counts; null: nothing.
    pub subtracted: Option<[f64; 3]>,
    /// Why ambient light was subtracted, or why not: `off`, `not_estimated`, `given`, `subtracted`, `few_lines`, `black`, `negative`, `no_meeting` or
    /// `darker_pixels`.
    pub verdict: String,
    /// The same in words.
    pub reason: String,
    /// The meeting point of the matte lines, counts; null where ambient light is off, or fewer than two lines are known.
    pub meeting: Option<[f64; 3]>,
    /// Standard deviation of the meeting point in each band, counts.
    pub sd_counts: Option<[f64; 3]>,
    /// Number of lines that the meeting point is computed from.
    pub lines: usize,
    /// Root mean square distance of the lines from the meeting point, counts.
    pub miss_counts: Option<f64>,
    /// Root mean square distance of the lines from black, counts.
    pub miss_of_black_counts: Option<f64>,
    /// Squared distance of the meeting point from black, in variances: 16.3 is significant.
    pub chi_square: Option<f64>,
}

impl AmbientFacts {
    pub(super) fn new(analysis: &Analysis) -> Self {
        let Ambient { subtracted, meeting, verdict } = analysis.intrinsic.ambient;
        Self {
            subtracted,
            verdict: verdict.name().to_owned(),
            reason: ambient_reason(verdict).to_owned(),
            meeting: meeting.map(|meeting| meeting.counts),
            sd_counts: meeting.map(|meeting| meeting.sd_counts),
            lines: meeting.map_or(0, |meeting| meeting.lines),
            miss_counts: meeting.map(|meeting| meeting.miss_counts[0]),
            miss_of_black_counts: meeting.map(|meeting| meeting.miss_counts[1]),
            chi_square: meeting.map(|meeting| meeting.chi_square),
        }
    }
}

/// The errors of the image's values.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct NoiseFacts {
    /// Standard deviation of a band in windows, counts; null where it could not be measured, or was not, as σ0 was given.
    pub window_sigma_counts: Option<f64>,
    /// The noise as a function of the intensity; null where the windows do not show that it grows with the light.
    #[serde(default)]
    pub shot: Option<ShotFacts>,
    /// The error of the file's way of storing values; null where the noise contains it (linear samples, floats).
    pub coding: Option<CodingFacts>,
    /// Whether the errors of neighboring pixels are alike: after lossy compression or demosaicing.
    pub extended: bool,
}

/// Noise whose variance grows with the light: `dark_variance` + `variance_per_count` × intensity.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ShotFacts {
    /// Variance of a band without light, counts².
    pub dark_variance: f64,
    /// Variance per count of intensity, counts.
    pub variance_per_count: f64,
}

/// The error of the file's way of storing values, as [`crate::photo::CodingError`] describes it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct CodingFacts {
    /// `rounding`, `compression`, or `earlier_compression`, which the correlation of the noise shows.
    pub cause: String,
    /// Whether color differences are stored with fewer samples than brightness.
    pub chroma_subsampled: bool,
    /// Standard deviation of a band, steps of 1/255 of the coded range.
    pub code_values: f64,
    /// The same in counts at a quarter, a half and the whole of full scale.
    pub sigma_counts: [f64; 3],
}

impl NoiseFacts {
    pub(super) fn new(analysis: &Analysis) -> Self {
        let coding = analysis.noise.coding.as_ref();
        Self {
            window_sigma_counts: analysis.noise.sigma,
            shot: analysis.noise.shot.map(|shot| ShotFacts {
                dark_variance: shot.dark_variance,
                variance_per_count: shot.variance_per_count,
            }),
            extended: analysis.noise.extended,
            coding: coding.map(|coding| CodingFacts {
                cause: coding.cause.name().to_owned(),
                chroma_subsampled: coding.chroma_subsampled,
                code_values: coding.code_values,
                sigma_counts: [0.25, 0.5, 1.0].map(|share| coding.at_share(share)),
            }),
        }
    }
}

/// The color of the light and its evidence.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct IlluminantFacts {
    /// Unit vector; null where the image gave no evidence of the light.
    pub direction: Option<[f64; 3]>,
    /// Number of regions whose highlights are the evidence; 0 where the light was given.
    pub objects: usize,
    /// Whether the light was given and not estimated.
    #[serde(default)]
    pub given: bool,
    /// The evidence: `given`, `average`, `planes`, `votes` or `none`.
    #[serde(default)]
    pub basis: String,
    /// Why this light was used, or why no light was.
    #[serde(default)]
    pub reason: String,
    /// Error of the light by its evidence, degrees; null where the light was given or is unknown.
    #[serde(default)]
    pub interval_deg: Option<f64>,
    /// A second lamp of another color; null where one light explains all regions.
    #[serde(default)]
    pub second: Option<SecondLampFacts>,
    /// The two estimates of the refined method; absent where the light is the paper's average of highlight directions.
    #[serde(flatten)]
    pub estimates: Option<LightEstimateFacts>,
}

/// A second lamp of another color (section 7.5). The regions that it lights have its color as surface reflection vector.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SecondLampFacts {
    /// Unit vector.
    pub direction: [f64; 3],
    /// Error of the direction by its evidence, degrees; null for a lamp that was given.
    pub interval_deg: Option<f64>,
    /// Number of regions whose highlights contradict the first light and agree with this lamp; of a lamp that was given, number of regions
    /// whose highlights agree better with it than with the first light.
    pub objects: usize,
    /// Whether the lamp was given and not found.
    #[serde(default)]
    pub given: bool,
    /// Angle between both lamps, degrees.
    pub angle_deg: f64,
}

/// The two estimates of the light of the refined method.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct LightEstimateFacts {
    /// The light by the dichromatic planes, unit.
    pub planes: Option<[f64; 3]>,
    /// Whether the planes are those of the highlights alone, as faint surface reflection has another color.
    pub highlights_alone: bool,
    /// The light by the votes of small highlights, unit.
    pub votes: Option<[f64; 3]>,
    /// Angle between both lights, degrees.
    pub agreement_deg: Option<f64>,
    /// Share of the votes for the light that was used, 0…1.
    pub vote_share: f64,
    /// Share of the lit pixels in regions that hold and show highlights, 0…1.
    pub support: f64,
}

impl LightEstimateFacts {
    fn new(light: &LightFindings) -> Self {
        Self {
            planes: light.planes,
            highlights_alone: light.highlights_alone,
            votes: light.votes,
            agreement_deg: light.agreement_deg(),
            vote_share: light.share,
            support: light.support,
        }
    }
}

impl IlluminantFacts {
    /// The facts of an analysis; `is_refined`: whether the refined estimates of the light were made.
    pub(super) fn new(analysis: &Analysis, is_refined: bool) -> Self {
        let light = &analysis.planar.light;
        let is_known = light.direction.is_some() || light.basis == LightBasis::NotSought;
        let basis = if is_known { light.basis } else { LightBasis::Nothing };
        Self {
            direction: analysis.illuminant.map(|light| light.direction),
            objects: analysis.illuminant.map_or(0, |light| light.objects),
            given: analysis.illuminant.is_some_and(|light| light.given),
            basis: basis.name().to_owned(),
            reason: light_reason(light).to_owned(),
            interval_deg: light.claimed_interval_deg(),
            second: light.second.map(|second| SecondLampFacts {
                direction: second.direction,
                interval_deg: second.interval_deg,
                objects: second.regions,
                given: second.given,
                angle_deg: light.lamps_angle_deg().unwrap_or_default(),
            }),
            estimates: is_refined.then(|| LightEstimateFacts::new(light)),
        }
    }
}
