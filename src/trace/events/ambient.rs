//! What the matte lines tell of ambient light (section 7.5).

use super::{EventData, Subject};

/// What is known of the ambient light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ambient {
    /// What was subtracted from every pixel before the split, and added to its body reflection after it, counts; none: nothing.
    pub subtracted: Option<[f64; 3]>,
    /// Where the matte lines meet; none where it was not asked, or there is no line.
    pub meeting: Option<Meeting>,
    /// Why it was subtracted, or why not.
    pub verdict: AmbientVerdict,
}

/// The point nearest to all matte lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Meeting {
    /// Its color, counts.
    pub counts: [f64; 3],
    /// Its standard deviation in each band, counts.
    pub sd_counts: [f64; 3],
    /// Lines that it rests on.
    pub lines: usize,
    /// Root mean square distance of the lines from it, and from black, counts.
    pub miss_counts: [f64; 2],
    /// Its squared distance from black, in variances: 16.3 is significant.
    pub chi_square: f64,
}

/// Why ambient light was subtracted, or why not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AmbientVerdict {
    /// Nothing was asked of it.
    #[default]
    Off,
    /// It was given.
    Given,
    /// Estimated and subtracted.
    Subtracted,
    /// Too few matte lines are known well enough, or two that do not clearly meet.
    FewLines,
    /// The lines meet in black, as far as they can tell.
    Black,
    /// The lines meet in a color that no light has: it is negative in some band.
    Negative,
    /// The lines meet nowhere.
    NoMeeting,
    /// Pixels are darker than the lines' meeting point.
    DarkerPixels,
}

impl AmbientVerdict {
    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Given => "given",
            Self::Subtracted => "subtracted",
            Self::FewLines => "few_lines",
            Self::Black => "black",
            Self::Negative => "negative",
            Self::NoMeeting => "no_meeting",
            Self::DarkerPixels => "darker_pixels",
        }
    }

    /// It in words.
    pub const fn reason(self) -> &'static str {
        match self {
            Self::Off => "ambient light was not asked for",
            Self::Given => "it was given",
            Self::Subtracted => "the matte lines meet there, significantly away from black",
            Self::FewLines => {
                "too few matte lines are known well enough: three, or two that clearly meet, are needed"
            }
            Self::Black => "the matte lines meet in black, as far as they can tell",
            Self::Negative => {
                "the matte lines meet in a color that no light has: inter-reflection, or ambient light that differs from place to place"
            }
            Self::NoMeeting => "the matte lines do not meet in one point",
            Self::DarkerPixels => "some pixels are darker than the point where the matte lines meet",
        }
    }
}

impl EventData for Ambient {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}
