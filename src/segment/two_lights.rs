//! Do all reflections off the surface come from one light? (section 7.5; refinement `two_lights`)
//!
//! Ambient light is reflected by the surface too, faintly and everywhere, the lamp in few pixels and strongly. Where both have
//! another colour, the plane of all pixels off the matte line turns towards the ambient light, by up to 7° on a rendered cup,
//! and the light with it, by 5°; the plane in which a highlight itself rises above its surroundings does not. The regions'
//! planes are replaced by those of their highlights where, in a region without texture, both contradict each other, and the
//! highlights' planes agree with each other on a light far better than the others do: printed patterns contradict too, but do
//! not agree.

use super::evidence::{LiesIn, branch_constraint};
use super::illuminant::{Constraint, Intersection, Prior, intersect, residual_deg};
use super::in_plane::InPlane;
use super::scene::Scene;
use crate::reflection::DichromaticPlane;

/// A highlight that rises off the plane of all pixels off the matte line by more, in standard deviations, is of another light
/// than they.
const CONTRADICTED: f64 = 4.0;
/// Mean squared residual, in variances, up to which planes agree on a light …
const AGREED: f64 = 6.0;
/// … and how much better than the others they have to.
const BETTER: f64 = 2.0;

/// What a region's pixels say of the light.
pub struct Evidence {
    /// The plane that they were looked at in.
    pub plane: DichromaticPlane,
    /// The plane that all its pixels off the matte line lie in.
    pub lies_in: LiesIn,
    /// What its highlights say, if it has any.
    pub highlights: Option<InPlane>,
}

impl Evidence {
    /// As what the light is perpendicular to, by all pixels off the matte line or by the highlights themselves.
    fn constraints(&self, by_highlights: bool) -> impl Iterator<Item = Constraint> {
        let rise = self.highlights.as_ref().map(|highlights| &highlights.rise);
        let lies_in =
            if by_highlights { self.lies_in.by_highlights(&self.plane, rise) } else { self.lies_in };
        let branch = self.highlights.as_ref();
        let branch = branch.map(|branch| branch_constraint(&lies_in.constraint, &self.plane, branch));
        std::iter::once(lies_in.constraint).chain(branch)
    }
}

/// The light of the highlights, by what all regions say.
pub fn light_of(scene: &Scene, evidence: &[Evidence], prior: &Prior) -> Intersection {
    let of = |by_highlights: bool| {
        let constraints: Vec<Constraint> =
            evidence.iter().flat_map(|evidence| evidence.constraints(by_highlights)).collect();
        let found = intersect(&constraints, prior);
        let misfit = misfit(&constraints, &found);
        (found, misfit)
    };
    let (by_all, misfit_of_all) = of(false);
    let contradicted = |evidence: &Evidence| {
        let highlights = evidence.highlights.as_ref();
        highlights.is_some_and(|it| evidence.lies_in.contradiction(&it.rise, scene.sigma()) > CONTRADICTED)
    };
    if scene.refine.two_lights && evidence.iter().any(contradicted) {
        let (by_highlights, misfit) = of(true);
        if misfit < AGREED && BETTER * misfit < misfit_of_all {
            return by_highlights;
        }
    }
    by_all
}

/// Mean squared residual of the constraints, in variances.
fn misfit(constraints: &[Constraint], found: &Intersection) -> f64 {
    let square = |c: &Constraint| residual_deg(c, &found.direction).powi(2) / c.variance_deg2;
    constraints.iter().map(square).sum::<f64>() / constraints.len().max(1) as f64
}
