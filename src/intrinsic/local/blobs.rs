//! Rule `hysteresis`: a highlight is a blob of faint surface reflection with a strong core, or with clipped pixels in it.
//!
//! Components of {ms > low, weight > 0}, opened by 3 × 3 and of at least 8 px, that hold an opened core {ms > high, t < 0.15} or
//! clipped pixels. Without it, all of {ms > high} counts.

use super::shade::Shades;
use crate::raster::{Mask, Raster, dilate};
use crate::segment::Scene;

/// Texture at which surface reflection begins to lose weight, and over which it loses all.
const TEXTURE: (f32, f32) = (0.1, 0.2);
/// Most texture of a core.
const CORE_TEXTURE: f32 = 0.15;
/// Fewest pixels of a blob.
const LEAST_PX: usize = 8;

/// The share of ms that is surface reflection, 0…1, at each pixel of the window that lies in `outside`; 0 elsewhere.
pub fn weights(scene: &Scene, shades: &Shades, texture: Option<&Raster<f32>>, outside: &Mask) -> Raster<f32> {
    let points = &shades.points;
    let texture_at = |pixel: usize| texture.map_or(0.0, |texture| texture[pixel]);
    let weight = |pixel: usize| 1.0 - ((texture_at(pixel) - TEXTURE.0) / TEXTURE.1).clamp(0.0, 1.0);
    let window = shades.window;
    let size = (points.width(), points.height());
    let strong = |pixel: usize| points[pixel].surface > points[pixel].high && points[pixel].high > 0.0;
    let kept = if scene.refine.hysteresis {
        let faint = opened(&mask(size, |pixel| {
            points[pixel].surface > points[pixel].low && points[pixel].low > 0.0 && weight(pixel) > 0.0
        }));
        let core = opened(&mask(size, |pixel| strong(pixel) && texture_at(pixel) < CORE_TEXTURE));
        with_core(&faint, &core, &window.raster(|pixel| scene.masks.clipped(pixel)))
    } else {
        mask(size, strong)
    };
    let share = |pixel: usize| if kept[pixel] && outside[window.pixel(pixel)] { weight(pixel) } else { 0.0 };
    let data = (0..points.len()).map(share).collect();
    Raster::from_vec(points.width(), points.height(), data).unwrap_or_default()
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

/// The faint pixels of components, joined by clipped pixels, that hold a core or a clipped pixel.
fn with_core(faint: &Mask, core: &Mask, clipped: &Mask) -> Mask {
    let mut kept = Raster::filled(faint.width(), faint.height(), false);
    let mut seen = kept.clone();
    let mut component = Vec::new();
    for start in 0..faint.len() {
        if seen[start] || !faint[start] {
            continue;
        }
        seen[start] = true;
        component.clear();
        component.push(start);
        let (mut at, mut faint_px, mut believed) = (0, 0, false);
        while let Some(&pixel) = component.get(at) {
            at += 1;
            faint_px += usize::from(faint[pixel]);
            believed |= clipped[pixel] || (core[pixel] && faint[pixel]);
            faint.for_each_neighbour(pixel, |near| {
                if !seen[near] && (faint[near] || clipped[near]) {
                    seen[near] = true;
                    component.push(near);
                }
            });
        }
        if believed && faint_px >= LEAST_PX {
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
        let kept = with_core(&faint, &drawn(&rows, "#"), &drawn(&rows, "X"));
        assert_eq!(kept.row(0), drawn(&["oooo......ooo."], "o").row(0));
        let small = ["o#o..", "oXo.."];
        let none = with_core(&drawn(&small, "o#"), &drawn(&small, "#"), &drawn(&small, "X"));
        assert!(none.as_slice().iter().all(|kept| !kept), "five pixels are no blob");
    }
}
