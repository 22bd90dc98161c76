//! What is known of the light's color, and from where.

pub use crate::trace::LightBasis;

/// The color of the scene's light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminant {
    /// Unit vector.
    pub direction: [f64; 3],
    /// Number of regions, or of small highlights that voted, that it rests on; 0 where it was given.
    pub objects: usize,
    /// Whether it was given and not estimated.
    pub given: bool,
}

/// The light by two ways that know nothing of one another, and which was used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightFindings {
    /// The unit vector that was used.
    pub direction: Option<[f64; 3]>,
    /// What it rests on.
    pub basis: LightBasis,
    /// The light by the dichromatic planes, unit.
    pub planes: Option<[f64; 3]>,
    /// Whether the planes are those of the highlights alone, as faint surface reflection has another color (7.5).
    pub highlights_alone: bool,
    /// The light by the votes of small highlights, unit.
    pub votes: Option<[f64; 3]>,
    /// Share of the votes that the light used has, 0…1; 0 without votes.
    pub share: f64,
    /// Share of the lit pixels whose regions hold and show highlights under the planes' light, 0…1.
    pub support: f64,
    /// Within so many degrees the light lies, as far as the evidence itself can tell.
    pub interval_deg: Option<f64>,
}

impl LightFindings {
    /// A light that was given.
    pub fn given(direction: [f64; 3]) -> Self {
        Self { direction: Some(direction), basis: LightBasis::Given, ..Self::default() }
    }

    /// Degrees between both ways, where both found a light.
    pub fn agreement_deg(&self) -> Option<f64> {
        let (planes, votes) = (self.planes?, self.votes?);
        Some(crate::color::axis_angle_deg(&planes.into(), &votes.into()))
    }

    /// Why this light was used and no other, in words.
    pub fn reason(&self) -> String {
        let support = 100.0 * self.support;
        match self.basis {
            LightBasis::Given => "it was given".to_owned(),
            LightBasis::Planes => {
                let alone = if self.highlights_alone {
                    ", those of the highlights alone, as faint surface reflection has another color (ambient light)"
                } else {
                    ""
                };
                format!(
                    "dichromatic planes{alone}: regions that hold and show highlights cover {support:.0} % of the lit pixels"
                )
            }
            LightBasis::Votes => format!(
                "votes of small highlights: regions that hold and show highlights cover only {support:.0} % of the lit pixels"
            ),
            LightBasis::Nothing if self.planes.is_none() && self.votes.is_none() => {
                "no highlight was found, neither on a region nor a small one".to_owned()
            }
            LightBasis::Nothing => {
                "the regions whose planes tell of a light do not hold, and small highlights do not agree on a usual one"
                    .to_owned()
            }
        }
    }
}
