//! Where no region holds: what can be said of a pixel from its surroundings alone (`REAL` photographs; beyond the paper).
//!
//! Printed cups, fruit and skin break "one object, one skewed T", and a plane fitted to them makes the body image worse than
//! the input. What still holds there is the dichromatic model at a point: surface reflection adds the light's colour, and so
//! lowers a pixel's saturation below what the same hue has around it. `shade` measures that, `texture` and `blobs` decide
//! where it is a highlight, `belief` whether this picture has any, and `repair` fills what has clipped.
//!
//! Body is the input less what is found, so that input = body + surface, and never more than the input. On a rendered scene of
//! printed objects the body image goes from 19.8 dB (planes alone; doing nothing: 30.2 dB) to 40 dB.

mod belief;
mod blobs;
mod repair;
mod shade;
mod texture;

use super::confidence::LOCAL;
use super::split::Images;
use crate::color::Vec3;
use crate::raster::{Mask, Raster, Window};
use crate::segment::{FinalRegions, Scene};
use crate::trace::PixelKind;
use rayon::prelude::*;
use shade::Shades;

/// Fewest lit pixels that are worth a look, and the least share of all that are lit.
const LEAST_PIXELS: usize = 64;
const LEAST_SHARE: f64 = 0.01;
/// How far around them the surroundings matter, pixels.
const MARGIN_PX: usize = 24;

/// Takes the planes' split back where it does not hold, and splits locally there. Returns the confidence of the pixels that
/// were split so, 0 elsewhere; none where no pixel was.
pub fn split_locally(
    scene: &Scene,
    regions: &FinalRegions,
    holding: &Mask,
    images: &mut Images,
) -> Option<Raster<f32>> {
    let outside = take_back(scene, holding, images);
    let pixels = outside.as_slice().iter().filter(|&&outside| outside).count();
    let lit = (0..outside.len()).filter(|&pixel| !scene.masks.dark(pixel)).count();
    let few = pixels < LEAST_PIXELS || (pixels as f64) < LEAST_SHARE * lit as f64;
    let light = Vec3::from(regions.light.direction?);
    if !scene.refine.local_split || few || scene.stopped() {
        return None;
    }
    let window =
        Window::around((outside.width(), outside.height()), MARGIN_PX, |pixel| outside[pixel])?;
    let shades = Shades::new(scene, &light, window)?;
    let texture = scene.refine.texture_test.then(|| texture::texture(&shades, scene.sigma()));
    let weights = blobs::weights(scene, &shades, texture.as_ref(), &outside);
    if scene.refine.belief
        && belief::Doubt::about(scene, &regions.light, &shades, &weights, &outside).is_some()
    {
        return None;
    }
    let mut confidence = apply(&light, &shades, &weights, images);
    if scene.refine.clip_repair {
        repair::repair(scene, &outside, images, &mut confidence);
    }
    Some(confidence)
}

/// Gives lit pixels outside of what holds their input back, and tells which they are.
fn take_back(scene: &Scene, holding: &Mask, images: &mut Images) -> Mask {
    let (width, height) = (holding.width(), holding.height());
    let mut outside = Raster::filled(width, height, false);
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.noise.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        outside.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    rows.into_par_iter().enumerate().for_each(|(y, (body, surface, noise, kinds, outside))| {
        for x in 0..width {
            let pixel = y * width + x;
            if holding[pixel] {
                continue;
            }
            outside[x] = !scene.masks.dark(pixel);
            if kinds[x] == PixelKind::Unassigned {
                continue;
            }
            (body[x], surface[x], noise[x]) = (scene.pixels[pixel], [0.0; 3], 0.0);
            // Nothing was restored there.
            if kinds[x] == PixelKind::Restored {
                kinds[x] = PixelKind::Lost;
            }
        }
    });
    outside
}

/// Moves surface reflection from body to surface. Returns the confidence of each pixel.
fn apply(light: &Vec3, shades: &Shades, weights: &Raster<f32>, images: &mut Images) -> Raster<f32> {
    let width = images.body.width();
    let mut confidence = Raster::filled(width, images.body.height(), 0.0);
    let window = shades.window;
    let per_amount: [f32; 3] = std::array::from_fn(|band| (3f64.sqrt() * light[band]) as f32);
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        confidence.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    let rows = rows.into_par_iter().skip(window.top).take(window.height);
    rows.enumerate().for_each(|(row, (body, surface, kinds, confidence))| {
        let found = weights.row(row).iter().zip(shades.points.row(row));
        for (x, (&weight, point)) in (window.left..).zip(found).filter(|(_, (weight, _))| **weight > 0.0) {
            let amount = weight * point.surface;
            // Never more than there is in any band.
            surface[x] = std::array::from_fn(|band| (amount * per_amount[band]).min(body[x][band]));
            body[x] = std::array::from_fn(|band| body[x][band] - surface[x][band]);
            kinds[x] = if kinds[x] == PixelKind::Unassigned { kinds[x] } else { PixelKind::Highlight };
            confidence[x] = LOCAL * weight;
        }
    });
    confidence
}
