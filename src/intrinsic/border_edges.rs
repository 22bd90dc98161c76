//! The edges that the split of a region would make at the border of the region (refinement `border_edges`, beyond the paper).
//!
//! Surface reflection rises and falls smoothly on one material, so that body reflection has an edge only where the photograph has one. A
//! region that is only a part of an object breaks this rule: its plane has a wrong direction, the split takes an even amount of
//! surface reflection from the whole region, and the body image shows the outline of the region, often the blocks of its windows. White
//! tiles, paper, plastic foil and wood are split so where their color is close to the color of the light. Therefore the model does
//! not fit a region at whose border the body reflection has new edges on more than 12 % of the sides against lit pixels outside.
//!
//! The test follows the limit at borders (`border_mixtures`), without which mixed colors are edges. Pixels outside count with the split of their own region where the model fits it, and else with their color: what the local split does
//! to them is not known yet. A new edge is a side at which the body differs more than the photograph does, by more than 3 standard
//! deviations of the noise and more than 4 % of the color.
//!
//! Over 335 regions that fit in 82 rendered scenes: 6 regions exceed .12, of printed objects and one beside a strong
//! inter-reflection, no region of a plain object exceeds .08. Of 45 regions that fit in 20 photographs 23 exceed .12.

use super::images::Images;
use super::region_plan::RegionPlan;
use crate::raster::{LabelMap, RegionId};
use crate::segment::{AnalysisInput, Members, NewEdges, Pixels};
use rayon::prelude::*;

/// Least difference of the body that is an edge, standard deviations of the noise.
const EDGE_SIGMAS: f32 = 3.0;
/// Least difference of the body that is an edge, as a share of the color.
const EDGE_SHARE: f32 = 0.04;

/// Counts the new edges of each region that the model fits, and rejects the regions with too many.
pub(super) fn reject_regions_with_new_edges(
    input: &AnalysisInput,
    labels: &LabelMap,
    members: &Members,
    images: &Images,
    plans: &mut [RegionPlan],
) {
    if !input.refine.border_edges || !input.refine.region_holds {
        return;
    }
    let borders = Borders { input, labels, images, plans };
    let counted: Vec<NewEdges> = RegionId::all(plans.len())
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|id| borders.new_edges(id, members.region(id)))
        .collect();
    for (plan, edges) in plans.iter_mut().zip(counted) {
        plan.fit.new_edges = edges;
        plan.model_fits &= plan.fit.model_fits();
    }
}

/// The split by the regions, as far as the model fits them.
struct Borders<'a> {
    input: &'a AnalysisInput<'a>,
    labels: &'a LabelMap,
    images: &'a Images,
    plans: &'a [RegionPlan],
}

impl Borders<'_> {
    /// The new edges at the border of a region; none of a region that the model does not fit.
    fn new_edges(&self, id: RegionId, pixels: Pixels) -> NewEdges {
        let mut edges = NewEdges::default();
        if !self.plans[id.index()].model_fits {
            return edges;
        }
        let floor = EDGE_SIGMAS * self.input.sigma() as f32;
        for pixel in pixels.iter().map(|pixel| pixel as usize) {
            if !self.input.masks.usable(pixel) {
                continue;
            }
            self.labels.for_each_neighbor(pixel, |near| {
                if self.labels[near] == id.get() || !self.input.masks.usable(near) {
                    return;
                }
                let (color, body) = (self.color(pixel), mean(self.images.body[pixel]));
                let change = (color - self.color(near)).abs();
                let change_of_body = (body - self.body(near)).abs();
                edges.sides += 1;
                edges.new += u32::from(change_of_body - change > floor.max(EDGE_SHARE * color));
            });
        }
        edges
    }

    fn color(&self, pixel: usize) -> f32 {
        mean(self.input.pixels[pixel])
    }

    /// The body reflection of a pixel outside, mean of the bands: by its region where the model fits it, else the color.
    fn body(&self, pixel: usize) -> f32 {
        let plan = RegionId::from_label(self.labels[pixel]).and_then(|id| self.plans.get(id.index()));
        match plan {
            Some(plan) if plan.model_fits => mean(self.images.body[pixel]),
            _ => self.color(pixel),
        }
    }
}

fn mean(color: [f32; 3]) -> f32 {
    color.iter().sum::<f32>() / 3.0
}
