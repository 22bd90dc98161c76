//! The reasons why pixels are not explained, in words.

use crate::intrinsic::Reason;

/// What is said of a pixel outside the area.
pub(super) const OUTSIDE_AREA: &str = "outside the area that the analysis is restricted to";
/// What is said of a pixel without a value.
pub(super) const NO_VALUE: &str = "the file holds no usable value here";

/// The name of a reason on the screen, a word or a few.
pub const fn reason_label(reason: Reason) -> &'static str {
    match reason {
        Reason::Explained => "explained",
        Reason::Shadow => "shadow",
        Reason::NoMatteLine => "no matte line",
        Reason::MixedBoundary => "mixed boundary",
        Reason::InterReflection => "off the plane",
        Reason::Texture => "texture",
        Reason::PartOfObject => "part of an object",
        Reason::OtherObject => "other object",
        Reason::Collinear => "collinear",
        Reason::ClippedAllBands => "clipped in all bands",
        Reason::ClippedObject => "clipped object",
        Reason::OutsideArea => "outside the area",
        Reason::NoValue => "no value",
    }
}

/// What a reason means, with the section of the paper where it is one of the paper.
pub const fn reason_meaning(reason: Reason) -> &'static str {
    match reason {
        Reason::Explained => "6: the skewed T of its region explains it",
        Reason::Shadow => "5.3.2: too dark to be analyzed, shadow or background",
        Reason::NoMatteLine => "5.3: lit, but on no matte line that was found",
        Reason::MixedBoundary => "6: between two objects, a mixture of both",
        Reason::InterReflection => "5.6, 7.5: off the plane, light of a neighbor or a second material",
        Reason::Texture => "7.5: body and surface reflection vary against each other, a print",
        Reason::PartOfObject => {
            "3: its region is only a part of an object, the surface reflection ends where the photograph has no edge"
        }
        Reason::OtherObject => "5.5: the clipped highlight of another object than its region's",
        Reason::Collinear => "7.5: the body has the light's color: gray, white, metal",
        Reason::ClippedAllBands => "5.5: nothing of its color is left to go by",
        Reason::ClippedObject => {
            "4: an object that clips, such as sky or white paint, or its edge: too abrupt for a highlight"
        }
        Reason::OutsideArea => OUTSIDE_AREA,
        Reason::NoValue => NO_VALUE,
    }
}
