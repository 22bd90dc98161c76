//! The pixels that the skewed T of their region explains, and that therefore keep the split by the region's plane (refinement
//! `region_holds`).
//!
//! Not explained are the pixels of a region whose skewed T does not fit (see [`crate::segment::RegionFit`]); a separate part of a
//! region with hardly any matte pixel (clipped highlights of a white cup fit the plane of a teal jug, 21.8 → 34.4 dB on the jug's
//! region, but no object consists of highlight alone); and a clipped blob that is mostly surrounded by other regions, which the
//! region reached over a bridge of bright pixels.

use crate::raster::{Border, ComponentSearch, Connectivity, Mask, Raster, RegionId};
use crate::segment::{AnalysisInput, FinalRegions, Members, parts};
use crate::trace::PixelKind;

/// Least share of matte pixels in a part of a region that is explained.
const LEAST_MATTE: f64 = 0.1;
/// Least share of a clipped blob's own region in the assigned pixels around the blob.
const LEAST_OWN: f64 = 0.5;

/// The pixels that the skewed T of their region explains. `model_fits`: whether the skewed T
/// fits each region, by [`RegionId::index`]. Parts and blobs are not looked at where a person marked the area: a person has said that
/// all of it is one object.
pub fn explained_mask(
    input: &AnalysisInput,
    regions: &FinalRegions,
    members: &Members,
    model_fits: &[bool],
    kinds: &Raster<PixelKind>,
) -> Mask {
    let mut mask =
        regions.labels.map(|&label| RegionId::from_label(label).is_some_and(|id| model_fits[id.index()]));
    if !input.refine.region_holds || input.is_marked() {
        return mask;
    }
    let width = regions.labels.width();
    for id in RegionId::all(model_fits.len()).filter(|id| model_fits[id.index()]) {
        for part in parts(width, members.region(id)) {
            let matte = part.iter().filter(|&&pixel| kinds[pixel as usize] == PixelKind::Matte).count();
            if (matte as f64) < LEAST_MATTE * part.len() as f64 {
                for &pixel in &part {
                    mask[pixel as usize] = false;
                }
            }
        }
    }
    remove_blobs_of_other_objects(input, regions, &mut mask);
    mask
}

/// Removes the clipped blobs that are mostly surrounded by other regions than their own.
fn remove_blobs_of_other_objects(input: &AnalysisInput, regions: &FinalRegions, mask: &mut Mask) {
    let labels = &regions.labels;
    let mut search = ComponentSearch::new(labels.width(), labels.height(), Connectivity::Four);
    for start in 0..labels.len() {
        let label = labels[start];
        let member = |pixel: usize| mask[pixel] && labels[pixel] == label && input.masks.distorted(pixel);
        let Some(blob) = search.component_at(start, member) else { continue };
        let border = Border::of(labels, blob, |pixel| !input.masks.distorted(pixel));
        if (border.sides(label) as f64) < LEAST_OWN * border.assigned_sides() as f64 {
            for &pixel in blob {
                mask[pixel] = false;
            }
        }
    }
}
