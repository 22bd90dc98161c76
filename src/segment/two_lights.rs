//! Do all reflections off the surface come from one light? (section 7.5; refinement `two_lights`)
//!
//! Ambient light is reflected by the surface too, faintly and everywhere, the lamp in few pixels and strongly. Where both have
//! another color, the plane of all pixels off the matte line turns towards the ambient light, by up to 7° on a rendered cup,
//! and the light with it, by 5°; the plane in which a highlight itself rises above its surroundings does not.
//!
//! So the light is sought a second time, with the highlights' planes, and that one is taken where it explains the pixels that
//! the light outshines far better: their mean squared distance from the planes of matte line and light. Printed patterns are
//! explained by neither.

use super::evidence::{branch_constraint, plane_of_highlights};
use super::illuminant::{Constraint, Intersection, Prior, intersect};
use super::in_plane::InPlane;
use super::input::AnalysisInput;
use crate::color::Vec3;
use crate::reflection::DichromaticPlane;
use crate::trace::TwoLightTest;

/// Mean squared distance of outshone pixels, σ², up to which a light explains them …
const EXPLAINED: f64 = 3.0;
/// … and how much better than the other light it has to.
const BETTER: f64 = 2.0;
/// Squared distances beyond this count no more, σ².
const FAR: f64 = 9.0;
/// Fewest pixels that can tell.
const LEAST_PX: u32 = 30;

/// What a region's pixels say of the light.
pub struct Evidence {
    /// The plane that they were looked at in.
    pub plane: DichromaticPlane,
    /// The plane that all its pixels off the matte line lie in.
    pub lies_in: Constraint,
    /// What its highlights say, if it has any.
    pub highlights: Option<InPlane>,
}

impl Evidence {
    /// As what the light is perpendicular to, given the plane that holds it.
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

/// The light of the highlights, by what all regions say, and how it was chosen; none of that where few pixels can tell.
pub fn light_of(
    input: &AnalysisInput,
    evidence: &[Evidence],
    prior: &Prior,
) -> (Intersection, Option<TwoLightTest>) {
    let meeting = |lies_in: &dyn Fn(&Evidence) -> Constraint| {
        let constraints: Vec<Constraint> =
            evidence.iter().flat_map(|evidence| evidence.constraints(lies_in(evidence))).collect();
        intersect(&constraints, prior)
    };
    let of_all = meeting(&|evidence| evidence.lies_in);
    let misfit_of = |light: &Vec3| misfit(evidence, light, input.sigma());
    let Some((by_all, pixels)) = misfit_of(&of_all.direction).filter(|_| input.refine.two_lights) else {
        return (of_all, None);
    };
    let told =
        TwoLightTest { pixels, by_all, by_highlights: None, limits: [EXPLAINED, BETTER], taken: false };
    if by_all < BETTER {
        return (of_all, Some(told));
    }
    let of_highlights = meeting(&|evidence| {
        let rise = evidence.highlights.as_ref().map(|highlights| &highlights.rise);
        plane_of_highlights(&evidence.lies_in, &evidence.plane, rise)
    });
    let by_highlights = misfit_of(&of_highlights.direction).map_or(FAR, |(misfit, _)| misfit);
    let taken = by_highlights < EXPLAINED && BETTER * by_highlights < by_all;
    let told = TwoLightTest { by_highlights: Some(by_highlights), taken, ..told };
    (if taken { of_highlights } else { of_all }, Some(told))
}

/// Mean squared distance of the outshone pixels from the planes under a light, σ², and their number; none where they are few.
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

    /// What three bodies say whose faint surface reflection has the color of `faint` and whose highlights that of `lamp`.
    fn light(faint: &Vec3, lamp: &Vec3, printed: bool) -> (Vec3, bool) {
        let asked = Vec3::repeat(1.0).normalize();
        let bodies = [[0.9, 0.3, 0.2], [0.2, 0.8, 0.3], [0.3, 0.3, 0.9]];
        let evidence: Vec<Evidence> = bodies
            .iter()
            .enumerate()
            .map(|(index, body)| {
                let body = Vec3::from(*body).normalize();
                let plane = DichromaticPlane::new(&Line::new(body * 90.0, body), &asked).unwrap();
                let tangent = |light: &Vec3| light.dot(&plane.normal) / light.dot(&plane.inward);
                let rise = tangent(lamp);
                let strong = (0..60).map(|i| {
                    let offset = 30.0 + f64::from(i);
                    // A print's pixels lie anywhere.
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
                    doubt_deg: 1.0,
                    reliability: 1.0,
                };
                Evidence { plane, lies_in, highlights: Some(highlights) }
            })
            .collect();
        let drawing = Drawing::by_place(4, |_, _| Vec3::repeat(99.0));
        let (found, told) = light_of(&drawing.input(), &evidence, &Prior { direction: asked, sd_deg: 30.0 });
        (found.direction, told.unwrap().taken)
    }

    #[test]
    fn highlights_of_another_color_than_faint_reflection_tell_the_light() {
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
