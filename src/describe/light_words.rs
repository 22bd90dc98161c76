//! Why a light is used, and why ambient light is subtracted or not.

use crate::segment::{LightBasis, LightFindings};
use crate::trace::AmbientVerdict;

/// Why the light of these findings is used, or why none is known, in words that complete a sentence.
pub const fn light_reason(light: &LightFindings) -> &'static str {
    match light.basis {
        LightBasis::NotSought => "the method finds regions alone and seeks no light",
        LightBasis::Given => "it was given",
        LightBasis::Average if light.direction.is_none() => {
            "no highlight was found: no neighbor of a region passed the tests"
        }
        LightBasis::Average => "the average of the highlight directions",
        LightBasis::ByHand if light.direction.is_none() => "the marked pixels have no skewed T",
        LightBasis::ByHand => "the highlight line of the marked pixels",
        LightBasis::Planes if light.highlights_alone => {
            "dichromatic planes, those of the highlights alone, as faint surface reflection has another color (ambient light)"
        }
        LightBasis::Planes => "dichromatic planes",
        LightBasis::Votes => {
            "votes of small highlights: the planes' light is less usual or less exactly known"
        }
        LightBasis::Nothing if light.planes.is_none() && light.votes.is_none() => {
            "no highlight was found, neither on a region nor a small one"
        }
        LightBasis::Nothing => {
            "the planes give no light that a lamp could have, and small highlights do not agree on a usual one"
        }
    }
}

/// Why ambient light is subtracted or not, in words that complete a sentence.
pub const fn ambient_reason(verdict: AmbientVerdict) -> &'static str {
    match verdict {
        AmbientVerdict::Off => "ambient light is off",
        AmbientVerdict::NotEstimated => {
            "the estimate of ambient light is the refinement ambient_light, which is off"
        }
        AmbientVerdict::Given => "it was given",
        AmbientVerdict::Subtracted => "the matte lines meet there, significantly away from black",
        AmbientVerdict::FewLines => {
            "too few matte lines are known well enough: three, or two that clearly meet, are needed"
        }
        AmbientVerdict::Black => "the matte lines meet in black, as far as they can tell",
        AmbientVerdict::Negative => {
            "the matte lines meet in a color that no light has: inter-reflection, or ambient light that differs from place to place"
        }
        AmbientVerdict::NoMeeting => "the matte lines do not meet in one point",
        AmbientVerdict::DarkerPixels => "some pixels are darker than the point where the matte lines meet",
    }
}
