//! The estimate of the ambient light from the matte lines (section 7.5).

use super::EventData;

/// The estimate of the ambient light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Ambient {
    /// The color that was subtracted from every pixel before the split, and added to the body reflection after the split, counts;
    /// none: nothing was subtracted.
    pub subtracted: Option<[f64; 3]>,
    /// The meeting point of the matte lines; none where ambient light is off, or without a line.
    pub meeting: Option<Meeting>,
    /// Why ambient light was subtracted, or why not.
    pub verdict: AmbientVerdict,
}

/// The point nearest to all matte lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Meeting {
    /// Color of the point, counts.
    pub counts: [f64; 3],
    /// Standard deviation of the point in each band, counts.
    pub sd_counts: [f64; 3],
    /// Number of lines that the point is computed from.
    pub lines: usize,
    /// Root mean square distance of the lines from the point, and from black, counts.
    pub miss_counts: [f64; 2],
    /// Squared distance of the point from black, in variances; more than [`Self::SIGNIFICANT_CHI_SQUARE`] is significant.
    pub chi_square: f64,
}

impl Meeting {
    /// 99.9 % quantile of χ² with three degrees of freedom: a larger `chi_square` is significant.
    pub const SIGNIFICANT_CHI_SQUARE: f64 = 16.27;
}

/// Why ambient light was subtracted, or why not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum AmbientVerdict {
    /// Ambient light is off.
    #[default]
    Off,
    /// The method does not estimate ambient light: that of 1990, or the refined method without `ambient_light`.
    NotEstimated,
    /// Ambient light was given.
    Given,
    /// Ambient light was estimated and subtracted.
    Subtracted,
    /// Too few matte lines are known well enough, or the two that are do not clearly meet.
    FewLines,
    /// The lines meet in black, within their errors.
    Black,
    /// The lines meet in a color that no light has: a band is negative.
    Negative,
    /// The lines do not meet in one point.
    NoMeeting,
    /// Pixels are darker than the meeting point of the lines.
    DarkerPixels,
}

impl AmbientVerdict {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::NotEstimated => "not_estimated",
            Self::Given => "given",
            Self::Subtracted => "subtracted",
            Self::FewLines => "few_lines",
            Self::Black => "black",
            Self::Negative => "negative",
            Self::NoMeeting => "no_meeting",
            Self::DarkerPixels => "darker_pixels",
        }
    }
}

impl EventData for Ambient {}
