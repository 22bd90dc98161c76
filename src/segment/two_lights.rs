//! Do all reflections off the surface come from one light? (section 7.5; refinement `two_lights`)
//!
//! Ambient light is reflected by the surface too, faintly and everywhere, the lamp in few pixels and strongly. Where both have
//! another colour, the plane of all pixels off the matte line turns towards the ambient light, by up to 7° on a rendered cup,
//! and the light with it, by 5°; the plane in which a highlight itself rises above its surroundings does not.
//!
//! So the light is sought a second time, with the highlights' planes, and that one is taken where it explains the pixels that
//! the light outshines far better: their mean squared distance from the planes of matte line and light. Printed patterns are
//! explained by neither.

use super::evidence::{branch_constraint, by_highlights};
use super::illuminant::{Constraint, Intersection, Prior, intersect};
use super::in_plane::InPlane;
use super::scene::Scene;
use crate::color::Vec3;
use crate::reflection::DichromaticPlane;

/// Mean squared distance of outshone pixels, σ², up to which a light explains them …
const EXPLAINED: f64 = 3.0;
/// … and how much better than the other light it has to.
const BETTER: f64 = 2.0;
/// Squared distances beyond this count no more, σ².
const FAR: f64 = 9.0;
/// Fewest pixels that can tell.
const LEAST_PX: usize = 30;

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

/// The light of the highlights, by what all regions say.
pub fn light_of(scene: &Scene, evidence: &[Evidence], prior: &Prior) -> Intersection {
    let meeting = |lies_in: &dyn Fn(&Evidence) -> Constraint| {
        let constraints: Vec<Constraint> =
            evidence.iter().flat_map(|evidence| evidence.constraints(lies_in(evidence))).collect();
        intersect(&constraints, prior)
    };
    let by_all = meeting(&|evidence| evidence.lies_in);
    let misfit_of = |light: &Vec3| misfit(evidence, light, scene.sigma());
    let misfit_of_all = misfit_of(&by_all.direction);
    if !scene.refine.two_lights || misfit_of_all < BETTER {
        return by_all;
    }
    let by_highlights = meeting(&|evidence| {
        let rise = evidence.highlights.as_ref().map(|highlights| &highlights.rise);
        by_highlights(&evidence.lies_in, &evidence.plane, rise)
    });
    let misfit = misfit_of(&by_highlights.direction);
    if misfit < EXPLAINED && BETTER * misfit < misfit_of_all { by_highlights } else { by_all }
}

/// Mean squared distance of the outshone pixels from the planes under a light, σ²; 0 where there are few.
fn misfit(evidence: &[Evidence], light: &Vec3, sigma: f64) -> f64 {
    let squares = evidence.iter().flat_map(|evidence| evidence.distances(light));
    let (sum, count) = squares
        .fold((0.0, 0usize), |(sum, count), distance| (sum + (distance / sigma).powi(2).min(FAR), count + 1));
    if count < LEAST_PX { 0.0 } else { sum / count as f64 }
}
