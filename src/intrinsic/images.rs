//! Section 6: the intrinsic images, and the pass over the picture that fills the images from the plans of the regions.

use super::Intrinsic;
use super::pixel::SplitPixel;
use super::reason::Reason;
use super::region_plan::RegionPlan;
use super::restore::Distorted;
use crate::raster::{LabelMap, Raster, RegionId};
use crate::segment::{AnalysisInput, Members, Pixels};
use crate::trace::{Ambient, PixelKind};
use rayon::prelude::*;

/// Largest distance of a believed color from the plane and from the sides of its lines, standard deviations of the region's fit.
const BELIEVED_SIGMAS: f32 = 2.5;

/// The intrinsic images while the split runs. All have the size of the picture; colors are counts above the ambient light.
pub(super) struct Images {
    /// Body reflection m_b·C_b, counts; the input where a pixel is unassigned.
    pub(super) body: Raster<[f32; 3]>,
    /// Surface reflection m_s·C_s, counts; zero where a pixel is unassigned.
    pub(super) surface: Raster<[f32; 3]>,
    /// Signed distance ε from the dichromatic plane, counts.
    pub(super) noise: Raster<f32>,
    /// Whether each pixel is matte, highlight, restored, lost or unassigned.
    pub(super) kinds: Raster<PixelKind>,
}

/// A distorted pixel after restoration.
struct RestoredPixel {
    /// Place of the pixel in the picture.
    pixel: u32,
    /// Body reflection, counts.
    body: [f32; 3],
    /// Surface reflection, counts.
    surface: [f32; 3],
    /// Signed distance ε from the dichromatic plane, counts.
    noise: f32,
    /// [`PixelKind::Restored`] or [`PixelKind::Lost`]; that of an undistorted pixel where the color is believed.
    kind: PixelKind,
}

impl Images {
    /// Splits the undistorted pixels by the plans of their regions, by [`RegionId::index`], rows in parallel. Pixels of a region that is
    /// not split keep their color; only their kinds are found.
    pub(super) fn split_undistorted(input: &AnalysisInput, labels: &LabelMap, plans: &[RegionPlan]) -> Self {
        let (width, height) = (input.pixels.width(), input.pixels.height());
        let mut images = Self {
            body: Raster::filled(width, height, [0.0; 3]),
            surface: Raster::filled(width, height, [0.0; 3]),
            noise: Raster::filled(width, height, 0.0),
            kinds: Raster::filled(width, height, PixelKind::Unassigned),
        };
        let rows = (
            images.body.as_mut_slice().par_chunks_mut(width.max(1)),
            images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
            images.noise.as_mut_slice().par_chunks_mut(width.max(1)),
            images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        );
        rows.into_par_iter().enumerate().for_each(|(y, (body, surface, noise, kinds))| {
            if input.stopped() {
                return;
            }
            // The input is copied row by row and not at once, so that the threads share the cost of fresh memory.
            body.copy_from_slice(input.pixels.row(y));
            for (x, &label) in labels.row(y).iter().enumerate() {
                let Some(region) = RegionId::from_label(label) else { continue };
                let (plan, pixel) = (&plans[region.index()], y * width + x);
                if !plan.splits_pixels {
                    kinds[x] = kind_of_unsplit(input, plan, pixel);
                    continue;
                }
                if input.masks.distorted(pixel) {
                    continue;
                }
                let split = plan.splitter.split(body[x]);
                (body[x], surface[x], noise[x], kinds[x]) =
                    (split.body, split.surface, split.noise, split.kind);
            }
        });
        images
    }

    /// Restores the distorted pixels of the regions that are split from their good bands and from the pixels around them. `origin`: the
    /// ambient light, counts.
    pub(super) fn restore(
        &mut self,
        origin: &[f64; 3],
        input: &AnalysisInput,
        labels: &LabelMap,
        plans: &[RegionPlan],
        members: &Members,
    ) {
        let distorted = Distorted { input, labels, clip_thresholds: input.clip_thresholds(origin) };
        let restored: Vec<Vec<RestoredPixel>> = plans
            .par_iter()
            .enumerate()
            .filter(|(_, plan)| plan.splits_pixels)
            .map(|(index, plan)| {
                restored(input, plan, &distorted, members.region(RegionId::from_index(index)))
            })
            .collect();
        for RestoredPixel { pixel, body, surface, noise, kind } in restored.into_iter().flatten() {
            let pixel = pixel as usize;
            self.body[pixel] = body;
            self.surface[pixel] = surface;
            self.noise[pixel] = noise;
            self.kinds[pixel] = kind;
        }
    }

    /// The result of a run that was stopped: these images, no confidence and no regions.
    pub(super) fn unfinished(self) -> Intrinsic {
        let Self { body, surface, noise, kinds } = self;
        let confidence = Raster::filled(body.width(), body.height(), 0.0);
        let reasons = confidence.map(|_| Reason::default());
        let ambient = Ambient::default();
        Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: Vec::new() }
    }
}

/// The distorted ones among a region's pixels, restored by the region's plan.
fn restored(
    input: &AnalysisInput,
    plan: &RegionPlan,
    distorted: &Distorted,
    pixels: Pixels,
) -> Vec<RestoredPixel> {
    let waiting: Vec<u32> = pixels.iter().filter(|&pixel| input.masks.distorted(pixel as usize)).collect();
    let rule = &plan.splitter.rule;
    let start_body = |pixel: usize| plan.start_bodies[plan.branch_near(input, pixel as u32)];
    let amounts = match rule.transform().filter(|_| input.refine.restore_prior) {
        Some(transform) => {
            let undistorted = |color| rule.amounts(color).components.body;
            distorted.body_amounts(&waiting, transform, undistorted, start_body)
        }
        None => vec![f32::NAN; waiting.len()],
    };
    waiting
        .into_iter()
        .zip(amounts)
        .map(|(pixel, amount)| {
            if let Some(split) = believed_split(input, plan, pixel as usize) {
                let SplitPixel { body, surface, noise, kind } = split;
                return RestoredPixel { pixel, body, surface, noise, kind };
            }
            let noise = 0.0;
            let Some(transform) = rule.transform() else {
                let body = input.pixels[pixel as usize];
                return RestoredPixel { pixel, body, surface: [0.0; 3], noise, kind: PixelKind::Lost };
            };
            let restored = if input.refine.restore_prior {
                distorted.with_body(pixel as usize, transform, amount)
            } else {
                let test = plan.splitter.highlight_test.as_ref();
                distorted.smallest_band(pixel as usize, transform, test, start_body(pixel as usize))
            };
            let [body, surface] = rule.colors(restored.components);
            let kind = if restored.lost { PixelKind::Lost } else { PixelKind::Restored };
            RestoredPixel { pixel, body, surface, noise, kind }
        })
        .collect()
}

/// The kind of a pixel whose region is not split: which line of the region is nearer to an undistorted or believed color.
fn kind_of_unsplit(input: &AnalysisInput, plan: &RegionPlan, pixel: usize) -> PixelKind {
    if !input.masks.distorted(pixel) || is_believed(input, plan, pixel) {
        plan.splitter.kind(input.pixels[pixel])
    } else {
        PixelKind::Lost
    }
}

/// The split of a pixel beside clipped ones whose color fits the plane of its region as well as that of an undistorted pixel: bloom
/// has not changed it (refinement `restore_prior`). None for a clipped pixel, where the color does not fit, and in compressed and
/// demosaiced photographs, where the clipped values are mixed into the pixels beside them.
fn believed_split(input: &AnalysisInput, plan: &RegionPlan, pixel: usize) -> Option<SplitPixel> {
    is_believed(input, plan, pixel).then(|| plan.splitter.split(input.pixels[pixel]))
}

/// Whether a distorted pixel is split as an undistorted one; see [`believed_split`].
fn is_believed(input: &AnalysisInput, plan: &RegionPlan, pixel: usize) -> bool {
    let is_asked = input.refine.restore_prior && !input.masks.clipped(pixel) && input.mixing_reach_px() == 1;
    let limit_counts = BELIEVED_SIGMAS * plan.fit.sigma_counts as f32;
    let transform = plan.transform().filter(|_| is_asked);
    transform.is_some_and(|transform| transform.misfit_counts(input.pixels[pixel]) <= limit_counts)
}
