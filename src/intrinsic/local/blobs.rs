//! Rule `hysteresis`: a highlight is a blob of faint surface reflection with a strong core, or with clipped pixels in it.
//!
//! Components of {ms > low, weight > 0}, opened by 3 × 3 and of at least 8 px, that hold an opened core {ms > high, t < 0.15} or
//! clipped pixels. Without it, all of {ms > high} counts.

use super::shade::Shades;
use crate::raster::{ComponentSearch, Connectivity, Mask, Raster, dilate};
use crate::segment::AnalysisInput;
use crate::trace::{BlobJudged, LocalPoint, Recorder};

/// Texture at which surface reflection begins to lose weight, and over which it loses all.
const TEXTURE: (f32, f32) = (0.1, 0.2);
/// Where it begins to, and where it has lost all.
pub const TEXTURE_LIMITS: [f32; 2] = [TEXTURE.0, TEXTURE.0 + TEXTURE.1];
/// Most texture of a core.
pub const CORE_TEXTURE: f32 = 0.15;
/// Fewest pixels of a blob.
const LEAST_PX: usize = 8;

/// Which pixels of the window are highlights.
pub struct Highlights {
    /// The share of ms that is surface reflection, 0…1, of those outside of what holds; 0 of all others.
    pub weights: Raster<f32>,
    /// The blobs that were judged, where that is recorded.
    pub judged: Judged,
}

/// Finds them; `outside`: what holds no region.
pub fn highlights<R: Recorder>(
    input: &AnalysisInput,
    shades: &Shades,
    texture: Option<&Raster<f32>>,
    outside: &Mask,
) -> Highlights {
    let points = &shades.points;
    let texture_at = |pixel: usize| texture.map_or(0.0, |texture| texture[pixel]);
    let weight = |pixel: usize| 1.0 - ((texture_at(pixel) - TEXTURE.0) / TEXTURE.1).clamp(0.0, 1.0);
    let roi = shades.roi;
    let size = (points.width(), points.height());
    let strong = |pixel: usize| points[pixel].surface > points[pixel].high && points[pixel].high > 0.0;
    let calm = |pixel: usize| texture_at(pixel) < CORE_TEXTURE;
    let mut judged = Judged::default();
    let kept = if input.refine.hysteresis {
        let faint = opened(&mask(size, |pixel| {
            points[pixel].surface > points[pixel].low && points[pixel].low > 0.0 && weight(pixel) > 0.0
        }));
        let core = opened(&mask(size, |pixel| strong(pixel) && calm(pixel)));
        let clipped = roi.raster(|pixel| input.masks.clipped(pixel));
        with_core(&faint, &core, &clipped, |component, kept| {
            // What lies in regions that hold is theirs.
            if R::KEEPS && component.iter().any(|&pixel| outside[roi.pixel(pixel)]) {
                let count = |test: &dyn Fn(usize) -> bool| {
                    component.iter().filter(|&&pixel| test(pixel)).count() as u32
                };
                judged.hear(component, &faint, |blob, pixels| BlobJudged {
                    blob,
                    pixel: roi.pixel(component[0]) as u32,
                    pixels,
                    clipped: count(&|pixel| clipped[pixel]),
                    strong: count(&|pixel| faint[pixel] && strong(pixel)),
                    calm: count(&|pixel| faint[pixel] && strong(pixel) && calm(pixel)),
                    core: count(&|pixel| faint[pixel] && core[pixel]),
                    kept,
                });
            }
        })
    } else {
        mask(size, strong)
    };
    let share = |pixel: usize| if kept[pixel] && outside[roi.pixel(pixel)] { weight(pixel) } else { 0.0 };
    let data = (0..points.len()).map(share).collect();
    let weights = Raster::from_vec(points.width(), points.height(), data).unwrap_or_default();
    Highlights { weights, judged }
}

/// The blobs of a window as they are judged, one after the other.
#[derive(Default)]
pub struct Judged {
    /// Those large enough to count, in the order of their first pixels.
    pub blobs: Vec<BlobJudged>,
    /// Blobs that do not lie in what holds wholly: all, those too small to count, and the pixels of these.
    pub found: u32,
    pub small: u32,
    pub small_pixels: u32,
    /// The blob of pixels of the window, as [`LocalPoint`] has it; pixels that are of none are left out.
    pub of: Vec<(usize, u16)>,
}

impl Judged {
    fn hear(&mut self, component: &[usize], faint: &Mask, judge: impl FnOnce(u16, u32) -> BlobJudged) {
        let own = || component.iter().copied().filter(|&pixel| faint[pixel]);
        let pixels = own().count();
        self.found += 1;
        let small = pixels < LEAST_PX;
        if small {
            (self.small, self.small_pixels) = (self.small + 1, self.small_pixels + pixels as u32);
        }
        let number = if small || self.blobs.len() >= usize::from(LocalPoint::MOST_BLOBS) {
            LocalPoint::SMALL
        } else {
            let number = self.blobs.len() as u16 + 1;
            self.blobs.push(judge(number, pixels as u32));
            number
        };
        self.of.extend(own().map(|pixel| (pixel, number)));
    }

    /// Fewest pixels of a blob that counts.
    pub const LEAST: u32 = LEAST_PX as u32;
}

/// A mask of the pixels for which `test` holds.
fn mask((width, height): (usize, usize), test: impl Fn(usize) -> bool) -> Mask {
    let data = (0..width * height).map(test).collect();
    Mask::from_vec(width, height, data).unwrap_or_default()
}

/// What a square of 3 × 3 fits into.
fn opened(mask: &Mask) -> Mask {
    let rest = dilate(&mask.map(|set| !set), 1);
    dilate(&rest.map(|set| !set), 1)
}

/// The faint pixels of components, joined by clipped pixels, that hold a core or a clipped pixel. `judged` is told of every
/// component, its first faint pixel first, and whether it is kept.
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
