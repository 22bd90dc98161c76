//! Rule `texture_test`: surface reflection of a highlight does not vary against the body reflection, that of texture does.
//!
//! hp(x) = x − G5(x); t = −min(G7\[hp ms · hp m_b\], 0) / √((G7\[hp m_b²\] + 0.3σ²) · G7\[ms²\]). The Gaussians are 5 and 7 px wide
//! (measured against 6 and 8: printed scenes +0.4 dB on average). Where t is above 0.1 surface reflection loses weight, from
//! 0.3 on surface reflection has none.

use super::desaturation_map::DesaturationMap;
use crate::raster::{Raster, blur};
use rayon::prelude::*;

/// Width of the Gaussian G5 whose result counts as shading, pixels.
const SHADING_PX: f64 = 5.0;
/// Width of the Gaussian G7 over which products are averaged, pixels.
const WINDOW_PX: f64 = 7.0;
/// Share of the noise's variance σ² that is added to the variance of m_b.
const NOISE: f32 = 0.3;

/// t of each pixel of the window, 0…1: how much surface and body reflection vary against each other around the pixel. `sigma`:
/// standard deviation of the noise of a band, counts.
pub fn texture(map: &DesaturationMap, sigma: f64) -> Raster<f32> {
    let (width, height) = (map.points.width(), map.points.height());
    let amounts = map.points.map(|point| [point.surface, point.body]);
    let mut smooth = blur(&amounts, SHADING_PX);
    let mut products = Raster::filled(width, height, [0.0f32; 3]);
    let pairs = products.as_mut_slice().par_iter_mut().zip(smooth.as_mut_slice()).zip(amounts.as_slice());
    pairs.with_min_len(1 << 12).for_each(|((product, smooth), amount)| {
        let (surface, body) = (amount[0] - smooth[0], amount[1] - smooth[1]);
        *product = [surface * body, body * body, amount[0] * amount[0]];
    });
    let floor = NOISE * (sigma * sigma) as f32;
    blur(&products, WINDOW_PX).map(|&[both, body, surface]| {
        let scale = ((body.max(0.0) + floor) * surface.max(0.0)).sqrt();
        if both < 0.0 && scale > 0.0 { (-both / scale).min(1.0) } else { 0.0 }
    })
}
