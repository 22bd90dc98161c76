//! Does all surface reflection come from one light? (section 7.5; refinement `two_lights`)
//!
//! The surface reflects ambient light faintly and everywhere, and the lamp strongly and in few pixels. Where both lights have
//! different colors, the plane of all pixels off the matte line turns towards the ambient light, by up to 7° on a rendered
//! cup, and the estimated light turns by 5°. The plane in which a highlight rises above its surroundings does not turn.
//!
//! So the light is estimated a second time, by the highlights' planes. The second estimate is used where it explains the
//! outshone pixels (those with strong surface reflection) far better than the first: by their mean squared distance from the
//! planes of matte line and light. Neither estimate explains printed patterns.

use super::evidence::{branch_constraint, plane_of_highlights};
use super::illuminant::{Constraint, Intersection, Prior, intersect};
use super::in_plane::InPlane;
use super::input::AnalysisInput;
use crate::color::Vec3;
use crate::reflection::DichromaticPlane;
use crate::trace::TwoLightTest;

/// Largest mean squared distance of the outshone pixels that the light explains, σ².
const EXPLAINED: f64 = 3.0;
/// Least ratio of the mean squared distances under the first and the second light for the second to be used.
const BETTER: f64 = 2.0;
/// Largest squared distance of one pixel that counts, σ²; larger ones count as this.
const FAR: f64 = 9.0;
/// Fewest outshone pixels for the test.
const LEAST_PX: u32 = 30;

/// The evidence of one region for the direction of the light.
pub struct Evidence {
    /// The dichromatic plane under the estimate of the round before.
    pub plane: DichromaticPlane,
    /// The constraint by the plane of all the region's pixels off the matte line.
    pub lies_in: Constraint,
    /// The estimate by the region's highlights; `None` without a highlight.
    pub highlights: Option<InPlane>,
}

impl Evidence {
    /// The constraints on the light, given the constraint by the plane that contains the light.
    fn constraints(&self, lies_in: Constraint) -> impl Iterator<Item = Constraint> {
        let highlights = self.highlights.as_ref();
        let branch = highlights.map(|branch| branch_constraint(&lies_in, &self.plane, branch));
        std::iter::once(lies_in).chain(branch)
    }

    /// Distances of the outshone pixels from the plane of matte line and `light`, counts.
    fn distances(&self, light: &Vec3) -> impl Iterator<Item = f64> {
        let (rise, run) = (light.dot(&self.plane.normal), light.dot(&self.plane.inward));
        let length = rise.hypot(run).max(1e-9);
        let strong = self.highlights.iter().flat_map(|highlights| &highlights.strong);
        strong.map(move |[offset, height]| (height * run - offset * rise) / length)
    }
}

/// The light by the evidence of all regions, and the test that compares both estimates; no test (`None`) where there are too
/// few outshone pixels, or without the refinement.
pub fn light_of(
    input: &AnalysisInput,
    evidence: &[Evidence],
    prior: &Prior,
) -> (Intersection, Option<TwoLightTest>) {
    let intersection = |lies_in: &dyn Fn(&Evidence) -> Constraint| {
        let constraints: Vec<Constraint> =
            evidence.iter().flat_map(|evidence| evidence.constraints(lies_in(evidence))).collect();
        intersect(&constraints, prior)
    };
    let of_all = intersection(&|evidence| evidence.lies_in);
    let misfit_of = |light: &Vec3| misfit(evidence, light, input.sigma());
    let Some((by_all, pixels)) = misfit_of(&of_all.direction).filter(|_| input.refine.two_lights) else {
        return (of_all, None);
    };
    let test =
        TwoLightTest { pixels, by_all, by_highlights: None, limits: [EXPLAINED, BETTER], taken: false };
    // A misfit below the least ratio leaves no room for a second light: the misfit of pure noise is 1.
    if by_all < BETTER {
        return (of_all, Some(test));
    }
    let of_highlights = intersection(&|evidence| {
        let rise = evidence.highlights.as_ref().map(|highlights| &highlights.rise);
        plane_of_highlights(&evidence.lies_in, &evidence.plane, rise)
    });
    let by_highlights = misfit_of(&of_highlights.direction).map_or(FAR, |(misfit, _)| misfit);
    let taken = by_highlights < EXPLAINED && BETTER * by_highlights < by_all;
    let test = TwoLightTest { by_highlights: Some(by_highlights), taken, ..test };
    (if taken { of_highlights } else { of_all }, Some(test))
}

/// Mean squared distance of the outshone pixels from the planes under a light, σ², and the number of these pixels; `None` with
/// too few of them.
fn misfit(evidence: &[Evidence], light: &Vec3, sigma: f64) -> Option<(f64, u32)> {
    let squares = evidence.iter().flat_map(|evidence| evidence.distances(light));
    let (sum, count) = squares
        .fold((0.0, 0u32), |(sum, count), distance| (sum + (distance / sigma).powi(2).min(FAR), count + 1));
    (count >= LEAST_PX).then(|| (sum / f64::from(count), count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Line, axis_angle_deg};
    use crate::segment::in_plane::Rise;
    use crate::segment::testing::Drawing;

    /// The estimated light of three bodies whose faint surface reflection has the color `faint` and whose highlights have the
    /// color `lamp`, and whether the highlights' light was used.
    fn light(faint: &Vec3, lamp: &Vec3, printed: bool) -> (Vec3, bool) {
        let white = Vec3::repeat(1.0).normalize();
        let bodies = [[0.9, 0.3, 0.2], [0.2, 0.8, 0.3], [0.3, 0.3, 0.9]];
        let evidence: Vec<Evidence> = bodies
            .iter()
            .enumerate()
            .map(|(index, body)| {
                let body = Vec3::from(*body).normalize();
                let plane = DichromaticPlane::new(&Line::new(body * 90.0, body), &white).unwrap();
                let tangent = |light: &Vec3| light.dot(&plane.normal) / light.dot(&plane.inward);
                let rise = tangent(lamp);
                let strong = (0..60).map(|i| {
                    let offset = 30.0 + f64::from(i);
                    // The pixels of a print lie off every plane.
                    [offset, if printed { offset * f64::from(i % 7 - 3) / 9.0 } else { offset * rise }]
                });
                let highlights = InPlane {
                    cotangent: lamp.dot(&body) / (1.0 - lamp.dot(&body).powi(2)).sqrt(),
                    variance_rad2: 0.01,
                    rise: Rise { tangent: rise, variance: 1e-4 },
                    strong: strong.collect(),
                };
                let normal = body.cross(faint).normalize();
                let lies_in = Constraint {
                    hypothesis: crate::raster::HypothesisId::from_index(index),
                    normal,
                    variance_deg2: 0.2,
                    residual_scale_deg: 1.0,
                    reliability: 1.0,
                };
                Evidence { plane, lies_in, highlights: Some(highlights) }
            })
            .collect();
        let drawing = Drawing::by_place(4, |_, _| Vec3::repeat(99.0));
        let (found, test) = light_of(&drawing.input(), &evidence, &Prior { direction: white, sd_deg: 30.0 });
        (found.direction, test.unwrap().taken)
    }

    #[test]
    fn highlights_of_another_color_than_faint_reflection_give_the_light() {
        let (faint, lamp) = (Vec3::new(0.65, 0.58, 0.5).normalize(), Vec3::new(0.55, 0.57, 0.61).normalize());
        let (found, taken) = light(&faint, &lamp, false);
        assert!(taken && axis_angle_deg(&found, &lamp) < 0.3, "{found}");
        let (found, taken) = light(&lamp, &lamp, false);
        assert!(!taken && axis_angle_deg(&found, &lamp) < 0.3, "{found}");
    }

    #[test]
    fn a_print_is_no_second_light() {
        let (faint, lamp) = (Vec3::new(0.65, 0.58, 0.5).normalize(), Vec3::new(0.55, 0.57, 0.61).normalize());
        assert!(!light(&faint, &lamp, true).1);
    }
}
