//! What the second look looks at: the patches that the working picture leaves unexplained.

use crate::analysis::working_outputs::WorkingOutputs;
use crate::intrinsic::{Intrinsic, Reason};
use crate::photo::Masks;
use crate::raster::{Border, ComponentSearch, Connectivity, Mask, RegionId, dilate, erode, pixels_where};

/// A patch contains a square of unexplained working pixels that reaches this far from its middle: what is narrower is the mixed
/// colors at a border.
const PATCH_REACH_PX: usize = 2;

/// The working pixels that are lit and that no plane explains, and those beside them; without narrow strips, and without
/// patches that lie mostly beside a region that its plane does not explain, of which they are a part. None where there is no such pixel.
pub(super) fn patches(masks: &Masks, working: &WorkingOutputs) -> Option<Mask> {
    let Intrinsic { reasons, regions, .. } = &*working.split.value.intrinsic;
    let labels = &working.finals.value.labels;
    let unexplained =
        |reason: Reason| matches!(reason, Reason::NoMatteLine | Reason::MixedBoundary | Reason::OtherObject);
    let left = masks.mask(|masks, pixel| !masks.dark(pixel) && unexplained(reasons[pixel]));
    let cores = erode(&left, PATCH_REACH_PX);
    if !cores.as_slice().contains(&true) {
        return None;
    }
    let wide = dilate(&cores, PATCH_REACH_PX);
    let mut kept = left.map(|_| false);
    let mut search = ComponentSearch::new(labels.width(), labels.height(), Connectivity::Four);
    let inside = |pixel: usize| left[pixel] && wide[pixel];
    for start in pixels_where(labels.len(), inside) {
        let Some(patch) = search.component_at(start, inside) else { continue };
        let beside = Border::of(labels, patch, |pixel| !inside(pixel)).main_region();
        let region = beside.and_then(|(label, _)| RegionId::from_label(label));
        if region.is_none_or(|region| regions[region.index()].model_fits()) {
            for &pixel in patch {
                kept[pixel] = true;
            }
        }
    }
    Some(dilate(&kept, 1))
}
