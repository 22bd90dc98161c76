//! Rule `hysteresis`: a highlight is a blob of faint surface reflection with a strong core, or with clipped pixels in it.
//!
//! Components of {ms > low, weight > 0}, opened by 3 × 3 and of at least 8 px, that contain an opened core {ms > high, t < 0.15} or
//! clipped pixels. Without this rule, all pixels of {ms > high} are highlight.

use super::desaturation_map::DesaturationMap;
use crate::raster::{ComponentSearch, Connectivity, Mask, PixelIndex, Raster, dilate};
use crate::segment::AnalysisInput;
use crate::trace::{BlobJudged, LocalLimits, LocalPoint, Recorder};

/// Fewest pixels of a blob.
const LEAST_PX: usize = 8;

/// Which pixels of the window are highlights.
pub struct Highlights {
    /// The share of ms that is surface reflection, 0…1; 0 for pixels that are explained by a region or in no highlight.
    pub weights: Raster<f32>,
    /// The blobs that were judged; empty where nothing is recorded.
    pub blobs: BlobRecord,
}

/// Finds the highlights of a window. `texture`: t of the window's pixels, none without rule `texture_test`. `unexplained`: the lit
/// pixels of the picture that no region explains.
pub fn highlights<R: Recorder>(
    input: &AnalysisInput,
    limits: &LocalLimits,
    map: &DesaturationMap,
    texture: Option<&Raster<f32>>,
    unexplained: &Mask,
) -> Highlights {
    let points = &map.points;
    let texture_at = |pixel: usize| texture.map_or(0.0, |texture| texture[pixel]);
    let weight = |pixel: usize| limits.weight(texture_at(pixel));
    let roi = map.roi;
    let (width, height) = (points.width(), points.height());
    let is_strong = |pixel: usize| points[pixel].is_strong();
    let is_calm = |pixel: usize| texture_at(pixel) < limits.core_texture;
    let mut blobs = BlobRecord::default();
    let kept = if input.refine.hysteresis {
        let faint =
            opened(&mask(width, height, |pixel| points[pixel].exceeds_noise() && weight(pixel) > 0.0));
        let core = opened(&mask(width, height, |pixel| is_strong(pixel) && is_calm(pixel)));
        let clipped = roi.raster(|pixel| input.masks.clipped(pixel));
        with_core(&faint, &core, &clipped, |component, kept| {
            // Blobs that regions explain are not recorded.
            if R::KEEPS && component.iter().any(|&pixel| unexplained[roi.pixel(pixel)]) {
                let count = |test: &dyn Fn(usize) -> bool| {
                    component.iter().filter(|&&pixel| test(pixel)).count() as u32
                };
                blobs.add(component, &faint, |blob, pixels| BlobJudged {
                    blob,
                    pixel: PixelIndex::from_index(roi.pixel(component[0])),
                    pixels,
                    clipped: count(&|pixel| clipped[pixel]),
                    strong: count(&|pixel| faint[pixel] && is_strong(pixel)),
                    calm: count(&|pixel| faint[pixel] && is_strong(pixel) && is_calm(pixel)),
                    core: count(&|pixel| faint[pixel] && core[pixel]),
                    kept,
                });
            }
        })
    } else {
        mask(width, height, is_strong)
    };
    let share = |pixel: usize| if kept[pixel] && unexplained[roi.pixel(pixel)] { weight(pixel) } else { 0.0 };
    let data = (0..points.len()).map(share).collect();
    let weights = Raster::from_vec(width, height, data).unwrap_or_default();
    Highlights { weights, blobs }
}

/// The blobs of a window that contain unexplained pixels, for the record.
#[derive(Default)]
pub struct BlobRecord {
    /// The blobs that have a number, in the order of their first pixels; blob `number` is at index `number − 1`.
    pub judged: Vec<BlobJudged>,
    /// Number of all blobs.
    pub found: u32,
    /// Number of blobs with fewer than [`BlobRecord::LEAST`] pixels.
    pub small: u32,
    /// Number of pixels in the small blobs.
    pub small_pixels: u32,
    /// Pixels of the window (by index) and the blob of each, as in [`LocalPoint::blob`]; pixels that are in no blob are left out.
    pub pixels: Vec<(usize, u16)>,
}

impl BlobRecord {
    /// Fewest pixels of a blob that may be a highlight.
    pub const LEAST: u32 = LEAST_PX as u32;

    /// Adds the faint pixels of a component as a blob. `judge` makes the event from the blob's number and number of pixels.
    fn add(&mut self, component: &[usize], faint: &Mask, judge: impl FnOnce(u16, u32) -> BlobJudged) {
        let own = || component.iter().copied().filter(|&pixel| faint[pixel]);
        let pixels = own().count();
        self.found += 1;
        let small = pixels < LEAST_PX;
        if small {
            (self.small, self.small_pixels) = (self.small + 1, self.small_pixels + pixels as u32);
        }
        let number = if small || self.judged.len() >= usize::from(LocalPoint::MOST_BLOBS) {
            LocalPoint::SMALL
        } else {
            let number = self.judged.len() as u16 + 1;
            self.judged.push(judge(number, pixels as u32));
            number
        };
        self.pixels.extend(own().map(|pixel| (pixel, number)));
    }
}

/// A mask of the pixels for which `test` is true.
fn mask(width: usize, height: usize, test: impl Fn(usize) -> bool) -> Mask {
    let data = (0..width * height).map(test).collect();
    Mask::from_vec(width, height, data).unwrap_or_default()
}

/// The morphological opening: the pixels of all squares of 3 × 3 pixels inside the mask.
fn opened(mask: &Mask) -> Mask {
    let rest = dilate(&mask.map(|set| !set), 1);
    dilate(&rest.map(|set| !set), 1)
}

/// The faint pixels of components that contain a core or a clipped pixel; clipped pixels connect faint ones. `judged` receives
/// every component, its first faint pixel first, and whether the component is kept.
fn with_core(faint: &Mask, core: &Mask, clipped: &Mask, mut judged: impl FnMut(&[usize], bool)) -> Mask {
    let mut kept = Raster::filled(faint.width(), faint.height(), false);
    let mut search = ComponentSearch::new(faint.width(), faint.height(), Connectivity::Four);
    for start in (0..faint.len()).filter(|&start| faint[start]) {
        let Some(component) = search.component_at(start, |pixel| faint[pixel] || clipped[pixel]) else {
            continue;
        };
        let faint_px = component.iter().filter(|&&pixel| faint[pixel]).count();
        let has_core = component.iter().any(|&pixel| clipped[pixel] || (core[pixel] && faint[pixel]));
        let is_kept = has_core && faint_px >= LEAST_PX;
        judged(component, is_kept);
        if is_kept {
            component.iter().filter(|&&pixel| faint[pixel]).for_each(|&pixel| kept[pixel] = true);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(rows: &[&str], which: &str) -> Mask {
        let data = rows.iter().flat_map(|row| row.chars().map(|c| which.contains(c))).collect();
        Raster::from_vec(rows[0].len(), rows.len(), data).unwrap()
    }

    #[test]
    fn opening_takes_threads_and_leaves_blobs() {
        let rows = ["###....", "###.#..", "###.###", "....#.."];
        let left = ["###....", "###....", "###....", "......."];
        assert_eq!(opened(&drawn(&rows, "#")), drawn(&left, "#"));
    }

    #[test]
    fn a_blob_needs_a_core_and_a_clipped_one_is_a_core() {
        // o faint, # core, X clipped.
        let rows = ["oooo.oooo.oooX", "oo#o.oooo.oooX", "oooo.oooo.oooX"];
        let faint = drawn(&rows, "o#");
        let kept = with_core(&faint, &drawn(&rows, "#"), &drawn(&rows, "X"), |_, _| ());
        assert_eq!(kept.row(0), drawn(&["oooo......ooo."], "o").row(0));
        let small = ["o#o..", "oXo.."];
        let none = with_core(&drawn(&small, "o#"), &drawn(&small, "#"), &drawn(&small, "X"), |_, _| ());
        assert!(none.as_slice().iter().all(|kept| !kept), "five pixels are no blob");
    }
}
