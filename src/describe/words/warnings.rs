//! The warnings about a run and about its regions, a sentence each.

use crate::analysis::{ContrastFinding, RunWarning};
use crate::baseline::{LEAST_MARKED_PX, NoSkewedT};
use crate::describe::light_words::light_reason;
use crate::describe::with_grouped_numbers;
use crate::intrinsic::{AngleWarning, RegionWarning};
use crate::reflection::MIN_ANGLE_DEG;
use std::fmt;

/// The warnings as sentences of a report, which hold numbers as they are.
pub fn sentences(warnings: &[impl fmt::Display]) -> Vec<String> {
    warnings.iter().map(ToString::to_string).collect()
}

/// The warnings as sentences to be read, with thin spaces between groups of three digits of their numbers.
pub fn grouped_sentences(warnings: &[impl fmt::Display]) -> Vec<String> {
    warnings.iter().map(|warning| with_grouped_numbers(&warning.to_string())).collect()
}

/// All pixels of the picture or of the area that a run was restricted to, as the subject of a sentence.
const fn every_pixel(is_restricted: bool) -> &'static str {
    if is_restricted { "every pixel of the area" } else { "every pixel" }
}

impl fmt::Display for RunWarning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::Dark { is_restricted } => {
                write!(f, "{} is darker than the minimal intensity: nothing was analyzed", every_pixel(is_restricted))
            }
            Self::Clipped { is_restricted } => write!(
                f,
                "{} that is bright enough is clipped or beside clipped ones: nothing was analyzed; a shorter exposure holds the colors",
                every_pixel(is_restricted)
            ),
            Self::NoLinearArea => {
                f.write_str("no linear area was found: no window varies along one direction beyond the noise")
            }
            Self::UnknownLight(light) => {
                let is_without_highlight = light.planes.is_none() && light.votes.is_none();
                let why = if is_without_highlight { "no highlight was found" } else { light_reason(&light) };
                write!(f, "{why}: the light's color is unknown and all is body reflection")
            }
            Self::RegionsAlone => f.write_str(
                "the method finds regions alone: no light and no highlights, all is body reflection",
            ),
            Self::SecondLampAlone => f.write_str(
                "a second lamp was given, but no light was found beside it: give the first light too (illuminant), or leave second_illuminant at \
                 `auto`",
            ),
            Self::SecondLampIsFirst { angle_deg } => write!(
                f,
                "the second lamp that was given is {angle_deg:.1}\u{b0} from the light found, both are one lamp: give the other light as \
                 illuminant, or leave second_illuminant at `auto`"
            ),
            Self::SecondLampIdle => f.write_str(
                "the highlights of no region agree better with the second lamp that was given than with the first light: all is split with the first",
            ),
            Self::NothingMarked => {
                f.write_str("no pixels were marked: the skewed T is fitted to the whole picture")
            }
            Self::NoSkewedT { why, is_restricted } => f.write_str(&no_skewed_t(why, marked(is_restricted))),
            Self::SkewedTMisfit { rms_counts, limit_counts, is_restricted } => write!(
                f,
                "one skewed T does not explain the {} pixels: they lie {rms_counts:.1} counts from its plane (rms), noise explains \
                 {limit_counts:.1}; they are not split",
                marked(is_restricted)
            ),
            Self::Contrast(found) => {
                let ContrastFinding { contrast, sd, read_with, regions } = found;
                let encoding = found.encoding();
                write!(
                    f,
                    "the colors of {regions} regions are bent as by a camera's contrast curve of contrast {contrast:.2} \u{b1} {sd:.2}, and the file was read with \
                     {read_with:.2}: the encoding `{encoding}` makes the light and the highlights more exact"
                )
            }
            Self::Compressed { code_values } => write!(
                f,
                "the picture is compressed so strongly that its values are off by {code_values:.1} code values (standard deviation): the \
                 light and faint highlights are not exact"
            ),
            Self::FewPixels { pixels, enough } => write!(
                f,
                "the picture has only {pixels} pixels: windows and regions hold too few of them to be exact, {enough} are enough"
            ),
        }
    }
}

/// Which pixels count as marked: those of the area, or all of the picture.
const fn marked(is_restricted: bool) -> &'static str {
    if is_restricted { "marked" } else { "picture's" }
}

/// Why the pixels have no skewed T; `which` they are.
fn no_skewed_t(why: NoSkewedT, which: &str) -> String {
    match why {
        NoSkewedT::TooFew(usable) => format!(
            "only {usable} of the {which} pixels are neither dark nor clipped: a skewed T needs {LEAST_MARKED_PX}, nothing was fitted"
        ),
        NoSkewedT::Point => {
            format!("the colors of the {which} pixels vary no more than the noise does: no line was fitted")
        }
        NoSkewedT::Line => format!(
            "the colors of the {which} pixels lie on one line: there is no highlight, and all is body reflection"
        ),
        NoSkewedT::Parallel => format!(
            "the matte and the highlight line of the {which} pixels are less than {MIN_ANGLE_DEG:.0}\u{b0} apart: body and surface reflection are not told from each \
             other, and all is body reflection"
        ),
        NoSkewedT::NoMeeting => format!(
            "the matte and the highlight line of the {which} pixels form no skewed T: all is body reflection"
        ),
    }
}

impl fmt::Display for RegionWarning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoPlane { keeps_color } => {
                let what = if *keeps_color {
                    "the region is not split"
                } else {
                    "everything counts as body reflection"
                };
                write!(f, "no dichromatic plane: {what}")
            }
            Self::Angle(warning) => warning.fmt(f),
            Self::PoorFit { has_plane, rms_counts, limit_counts } => {
                let what = if *has_plane { "plane" } else { "matte line" };
                write!(
                    f,
                    "poor fit: pixels lie {rms_counts:.1} counts from the {what} (rms), {limit_counts:.1} is noise"
                )
            }
            Self::Texture { anticorrelation } => write!(
                f,
                "texture: surface and body vary against each other (correlation \u{2212}{:.2})",
                anticorrelation.min(1.0)
            ),
            Self::ColorOfLight { light_share } => write!(
                f,
                "the light is uncertain by {light_share:.1} times the angle between body and surface vector: body and surface reflection are \
                 one color as far as is known"
            ),
            Self::NewEdges { share } => write!(
                f,
                "part of an object: the split would make new edges at {:.0} % of the border",
                100.0 * share
            ),
            Self::NoHighlights { probability } => write!(
                f,
                "print or another color: what the plane takes for surface reflection is a highlight with a probability of {probability:.2}"
            ),
            Self::ModelFails { is_split_locally } => {
                let pixels = if *is_split_locally {
                    "the local split alone divides its pixels"
                } else {
                    "its pixels are not split"
                };
                write!(f, "the model does not hold: the plane of the region is not used, {pixels}")
            }
            Self::OffBlack { counts } => write!(
                f,
                "the matte line misses black by {counts:.1} counts: ambient light, inter-reflection or no single material"
            ),
            Self::Clipped { pixels } => {
                write!(f, "{pixels} pixels are clipped in every band: their split is a guess")
            }
            Self::SeveralHighlights { bodies_counts } => several_highlights(bodies_counts, f),
        }
    }
}

/// The sentence about highlights on these amounts of body reflection, at least two.
fn several_highlights(bodies_counts: &[f32], f: &mut fmt::Formatter) -> fmt::Result {
    let many = match bodies_counts.len() {
        2 => "two",
        3 => "three",
        4 => "four",
        _ => "several",
    };
    write!(f, "{many} highlights with different body reflection under them: m_b ")?;
    let last = bodies_counts.len().saturating_sub(1);
    for (index, body) in bodies_counts.iter().enumerate() {
        let before = match index {
            0 => "",
            _ if index == last => " and ",
            _ => ", ",
        };
        write!(f, "{before}{body:.0}")?;
    }
    f.write_str(" counts (7.4)")
}

impl fmt::Display for AngleWarning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Collinear { angle_deg } => write!(
                f,
                "body and surface vector are collinear ({angle_deg:.1}\u{b0}): everything counts as body reflection"
            ),
            Self::Noise { angle_deg } => write!(
                f,
                "body and surface vector are only {angle_deg:.1}\u{b0} apart: the split amplifies noise {:.0} times",
                1.0 / angle_deg.to_radians().sin()
            ),
            Self::InCylinder { angle_deg, extent_counts, least_deg } => write!(
                f,
                "body and surface vector are {angle_deg:.1}\u{b0} apart, a highlight cluster of {extent_counts:.0} counts needs \
                 {least_deg:.1}\u{b0} to leave the matte cylinder: the region is not split (7.5)"
            ),
            Self::HalfInCylinder { angle_deg, extent_counts } => write!(
                f,
                "body and surface vector are {angle_deg:.1}\u{b0} apart: at least half of the highlight cluster of \
                 {extent_counts:.0} counts lies in the matte cylinder (7.5)"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::LightFindings;

    #[test]
    fn highlights_on_different_shades_are_counted_and_their_shades_named() {
        let told =
            |bodies: &[f32]| RegionWarning::SeveralHighlights { bodies_counts: bodies.to_vec() }.to_string();
        assert_eq!(
            told(&[84.4, 131.6]),
            "two highlights with different body reflection under them: m_b 84 and 132 counts (7.4)"
        );
        let three = told(&[84.4, 131.6, 20.0]);
        assert!(three.starts_with("three") && three.contains("m_b 84, 132 and 20 counts"), "{three}");
        assert!(told(&[1.0; 5]).starts_with("several"));
    }

    #[test]
    fn a_small_angle_is_told_with_what_it_does() {
        let noise = AngleWarning::Noise { angle_deg: 12.0 }.to_string();
        assert!(noise.contains("only 12.0\u{b0} apart") && noise.ends_with("noise 5 times"), "{noise}");
        let inside = AngleWarning::InCylinder { angle_deg: 4.0, extent_counts: 100.0, least_deg: 5.74 };
        assert!(inside.to_string().contains("100 counts needs 5.7\u{b0}"), "{inside}");
    }

    #[test]
    fn a_contrast_curve_is_told_with_the_encoding_that_undoes_it() {
        let found = ContrastFinding { contrast: 1.318, sd: 0.03, read_with: 1.0, regions: 5 };
        let told = RunWarning::Contrast(found).to_string();
        assert!(told.contains("contrast 1.32 \u{b1} 0.03") && told.contains("`contrast:1.32`"), "{told}");
        let none = ContrastFinding { contrast: 1.001, read_with: 1.3, ..found };
        assert!(RunWarning::Contrast(none).to_string().contains("`srgb`"));
    }

    #[test]
    fn a_light_that_nothing_was_found_for_is_unknown_for_want_of_a_highlight() {
        let nothing = RunWarning::UnknownLight(LightFindings::default()).to_string();
        assert!(nothing.starts_with("no highlight was found: the light's color is unknown"), "{nothing}");
        let found = LightFindings { planes: Some([0.6, 0.6, 0.5]), ..LightFindings::default() };
        let contradiction = RunWarning::UnknownLight(found).to_string();
        assert!(contradiction.starts_with(light_reason(&found)), "{contradiction}");
    }
}
