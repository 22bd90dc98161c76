//! The light's color, and the evidence for it.

pub use crate::trace::LightBasis;

/// The color of the scene's light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Illuminant {
    /// Unit vector.
    pub direction: [f64; 3],
    /// Number of regions, or of small highlights that voted, that the light rests on; 0 for a light that was given.
    pub objects: usize,
    /// Whether the light was given and not estimated.
    pub given: bool,
}

/// The two independent estimates of the light, and which of them is used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LightFindings {
    /// Unit direction of the light that is used; `None`: no light is known.
    pub direction: Option<[f64; 3]>,
    /// The evidence that the used light rests on.
    pub basis: LightBasis,
    /// Unit direction of the light by the dichromatic planes.
    pub planes: Option<[f64; 3]>,
    /// Whether the planes are those of the highlights alone, because faint surface reflection has another color (section 7.5).
    pub highlights_alone: bool,
    /// Unit direction of the light by the votes of small highlights.
    pub votes: Option<[f64; 3]>,
    /// Share of the votes for the light that is used, 0…1; 0 without votes.
    pub share: f64,
    /// Share of the lit pixels in regions that fit the model and show highlights under the planes' light, 0…1.
    pub support: f64,
    /// Angle within which the light lies if all of its evidence is right, degrees: the tests of regions compare this angle with their limits.
    pub interval_deg: Option<f64>,
    /// Two standard deviations of the light as far as it depends on single regions, degrees; 0 for a light that does not rest on planes.
    pub spread_deg: f64,
    /// The second lamp; `None` where one light explains all regions.
    pub second: Option<SecondLampFindings>,
}

/// A second lamp of another color (section 7.5).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SecondLampFindings {
    /// Unit direction.
    pub direction: [f64; 3],
    /// Two standard deviations of the direction, degrees; `None` for a lamp that was given.
    pub interval_deg: Option<f64>,
    /// Number of regions whose highlights contradict the first light and agree with this one; of a lamp that was given, number of regions whose
    /// highlights agree better with it than with the first light.
    pub regions: usize,
    /// Whether the lamp was given and not found.
    pub given: bool,
}

impl LightFindings {
    /// The findings of a method that seeks no light.
    pub fn not_sought() -> Self {
        Self { basis: LightBasis::NotSought, ..Self::default() }
    }

    /// The findings for a light that was given (unit direction).
    pub fn given(direction: [f64; 3]) -> Self {
        Self { direction: Some(direction), basis: LightBasis::Given, ..Self::default() }
    }

    /// Angle within which the light is claimed to lie, degrees; `None` without a light and for a light that was given.
    pub fn claimed_interval_deg(&self) -> Option<f64> {
        self.interval_deg.map(|interval_deg| interval_deg.max(self.spread_deg))
    }

    /// Angle between both estimates, degrees; `None` unless both found a light.
    pub fn agreement_deg(&self) -> Option<f64> {
        let (planes, votes) = (self.planes?, self.votes?);
        Some(crate::color::axis_angle_deg(&planes.into(), &votes.into()))
    }

    /// Angle between the light that is used and the second lamp, degrees; `None` with one lamp.
    pub fn lamps_angle_deg(&self) -> Option<f64> {
        let (first, second) = (self.direction?, self.second?.direction);
        Some(crate::color::axis_angle_deg(&first.into(), &second.into()))
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn the_claimed_interval_is_at_least_the_spread_of_a_light_that_was_found() {
        let claimed = |interval_deg, spread_deg| {
            LightFindings { interval_deg, spread_deg, ..LightFindings::default() }.claimed_interval_deg()
        };
        assert_eq!(claimed(Some(1.0), 3.0), Some(3.0));
        assert_eq!(claimed(Some(4.0), 3.0), Some(4.0));
        assert_eq!(claimed(None, 3.0), None, "no light, or a light that was given");
    }
}
