//! Section 7.5: the angle between body and surface vector that a split needs.
//!
//! The refined method has fixed angles: below 3° the plane is undetermined, below 14° the split amplifies noise more than four
//! times.
//!
//! The paper says that the angle depends on the cylinder width (reading `angle_by_width`). A highlight cluster of length L that
//! leaves the matte line at an angle θ ends at the distance L·sin θ from the matte line. Where this distance is less than the
//! radius r of the matte cylinder, the whole highlight cluster lies in the cylinder, and the two clusters cannot be told apart:
//! the least angle is asin(r / L). Where the distance is less than 2r, at least half of the highlight cluster lies in the
//! cylinder: below asin(2r / L) the split is doubtful.

use super::region_warning::AngleWarning;
use crate::color::vec3;
use crate::reflection::{HighlightTest, MIN_ANGLE_DEG};
use crate::segment::{AnalysisInput, Pixels, PlanarHypothesis};

/// Below this angle between body and surface vector the split amplifies noise more than four times, degrees.
const SMALL_ANGLE_DEG: f64 = 14.0;

/// Limits of the angle between body and surface vector of one region, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AngleLimits {
    /// The region is not split below this angle.
    pub(super) least_deg: f64,
    /// The report warns that the split is doubtful below this angle.
    pub(super) doubtful_deg: f64,
    /// Length of the highlight cluster from which both angles follow, counts; none for the fixed angles.
    pub(super) extent_counts: Option<f64>,
}

impl AngleLimits {
    /// The fixed angles.
    pub(super) const FIXED: Self =
        Self { least_deg: MIN_ANGLE_DEG, doubtful_deg: SMALL_ANGLE_DEG, extent_counts: None };

    /// The limits of a region with the given pixels: the fixed angles, or those of the reading `angle_by_width`.
    pub(super) fn new(input: &AnalysisInput, hypothesis: &PlanarHypothesis, pixels: Pixels) -> Self {
        let (true, Some(plane)) = (input.readings.angle_by_width, hypothesis.plane) else {
            return Self::FIXED;
        };
        let test = HighlightTest::of_lines(&hypothesis.matte, &[hypothesis.start], &plane.surface);
        let colors = pixels.iter().map(|pixel| input.pixels[pixel as usize]);
        let lengths = colors
            .filter(|&color| test.is_highlight(color))
            .map(|color| (vec3(color) - hypothesis.start).dot(&plane.surface));
        Self::of_cluster(input.used.radius_counts(), lengths.fold(0.0, f64::max))
    }

    /// The limits for a cylinder of a radius and a highlight cluster of a length, both counts.
    fn of_cluster(radius: f64, extent: f64) -> Self {
        let angle_deg =
            |distance: f64| if distance < extent { (distance / extent).asin().to_degrees() } else { 90.0 };
        Self {
            least_deg: angle_deg(radius),
            doubtful_deg: angle_deg(2.0 * radius),
            extent_counts: Some(extent),
        }
    }

    /// The warning about a region whose vectors are `angle_deg` apart; none for an ample angle.
    pub(super) fn warning(&self, angle_deg: f64) -> Option<AngleWarning> {
        let Self { least_deg, doubtful_deg, extent_counts } = *self;
        if angle_deg >= doubtful_deg {
            return None;
        }
        Some(match (angle_deg < least_deg, extent_counts) {
            (true, None) => AngleWarning::Collinear { angle_deg },
            (false, None) => AngleWarning::Noise { angle_deg },
            (true, Some(extent_counts)) => AngleWarning::InCylinder { angle_deg, extent_counts, least_deg },
            (false, Some(extent_counts)) => AngleWarning::HalfInCylinder { angle_deg, extent_counts },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wider_cylinder_and_a_shorter_cluster_need_a_larger_angle() {
        let of = |radius: f64, extent: f64| AngleLimits::of_cluster(radius, extent);
        let limits = of(10.0, 100.0);
        assert!(
            (limits.least_deg - 5.74).abs() < 0.01 && (limits.doubtful_deg - 11.54).abs() < 0.01,
            "{limits:?}"
        );
        assert!(of(15.0, 100.0).least_deg > limits.least_deg);
        assert!(of(10.0, 60.0).least_deg > limits.least_deg);
        assert_eq!(
            (of(10.0, 9.0).least_deg, of(10.0, 0.0).doubtful_deg),
            (90.0, 90.0),
            "inside of the cylinder"
        );
    }

    #[test]
    fn only_an_angle_below_a_limit_is_worth_a_warning() {
        use AngleWarning::{Collinear, HalfInCylinder, InCylinder, Noise};
        let limits = AngleLimits::of_cluster(10.0, 100.0);
        assert_eq!(limits.warning(12.0), None);
        let half = HalfInCylinder { angle_deg: 8.0, extent_counts: 100.0 };
        assert_eq!(limits.warning(8.0), Some(half));
        let least_deg = limits.least_deg;
        let inside = InCylinder { angle_deg: 4.0, extent_counts: 100.0, least_deg };
        assert_eq!(limits.warning(4.0), Some(inside));
        assert_eq!(AngleLimits::FIXED.warning(2.0), Some(Collinear { angle_deg: 2.0 }));
        assert_eq!(AngleLimits::FIXED.warning(12.0), Some(Noise { angle_deg: 12.0 }));
        assert_eq!(AngleLimits::FIXED.warning(14.0), None);
    }
}
