//! Copies of a picture at half, a quarter and so on of its size, for views of large pictures.

use crate::color::linear_from_srgb;
use crate::raster::Raster;
use rayon::prelude::*;

/// Longest side of the last copy, pixels.
const SMALLEST_PX: usize = 64;

/// Copies of `picture` (sRGB and straight alpha), each half as wide and high as the one before, rounded up; the last is at
/// most 64 pixels wide and high. `picture` itself is not among them.
///
/// A pixel is the mean of 2 × 2 in linear light, weighted by alpha: an average of sRGB values would darken highlights.
pub fn pyramid(picture: &Raster<[u8; 4]>) -> Vec<Raster<[u8; 4]>> {
    let light = Light::new();
    let mut levels: Vec<Raster<[u8; 4]>> = Vec::new();
    loop {
        let last = levels.last().unwrap_or(picture);
        if last.width().max(last.height()) <= SMALLEST_PX {
            return levels;
        }
        levels.push(halved(last, &light));
    }
}

/// Tables from sRGB to linear light and back; 4095 is white.
struct Light {
    linear: [u16; 256],
    code: Vec<u8>,
}

impl Light {
    fn new() -> Self {
        let decode = |code: usize| (linear_from_srgb(code as f64 / 255.0) * 65535.0).round() as u16;
        let linear: [u16; 256] = std::array::from_fn(decode);
        // The code whose linear value is nearer.
        let mut code = Vec::with_capacity(1 << 14);
        let mut best = 0usize;
        for step in 0..1u32 << 14 {
            let value = step * 4 + 2;
            let apart = |code: usize| u32::from(linear[code]).abs_diff(value);
            while best < 255 && apart(best + 1) <= apart(best) {
                best += 1;
            }
            code.push(best as u8);
        }
        Self { linear, code }
    }
}

fn halved(picture: &Raster<[u8; 4]>, light: &Light) -> Raster<[u8; 4]> {
    let (width, height) = (picture.width().div_ceil(2), picture.height().div_ceil(2));
    let mut half = Raster::filled(width, height, [0u8; 4]);
    half.as_mut_slice().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let above = picture.row(2 * y);
        let below = picture.row((2 * y + 1).min(picture.height() - 1));
        for (x, pixel) in row.iter_mut().enumerate() {
            let right = (2 * x + 1).min(picture.width() - 1);
            *pixel = mean([above[2 * x], above[right], below[2 * x], below[right]], light);
        }
    });
    half
}

fn mean(four: [[u8; 4]; 4], light: &Light) -> [u8; 4] {
    let weight: u32 = four.iter().map(|pixel| u32::from(pixel[3])).sum();
    if weight == 0 {
        return [0; 4];
    }
    // Most pixels of an overlay are equal, and the mean of equal codes is the code.
    if four[0] == four[1] && four[0] == four[2] && four[0] == four[3] {
        return four[0];
    }
    let band = |band: usize| {
        let linear = |pixel: &[u8; 4]| u32::from(light.linear[usize::from(pixel[band])]);
        let sum: u32 = if weight == 4 * 255 {
            four.iter().map(linear).sum::<u32>() / 4
        } else {
            four.iter().map(|pixel| linear(pixel) * u32::from(pixel[3])).sum::<u32>() / weight
        };
        light.code[(sum >> 2) as usize]
    };
    [band(0), band(1), band(2), ((weight + 2) / 4) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_halve_until_they_are_small() {
        let sizes = |width, height| -> Vec<(usize, usize)> {
            let levels = pyramid(&Raster::filled(width, height, [9, 9, 9, 255]));
            levels.iter().map(|level| (level.width(), level.height())).collect()
        };
        assert_eq!(sizes(257, 3), [(129, 2), (65, 1), (33, 1)]);
        assert_eq!(sizes(64, 64), []);
        assert_eq!(sizes(0, 0), []);
    }

    #[test]
    fn every_code_survives_an_average_of_itself() {
        let light = Light::new();
        for code in 0..=255u8 {
            let pixel = [code, 255 - code, code, 255];
            assert_eq!(mean([pixel; 4], &light), pixel);
        }
    }

    #[test]
    fn smaller_copies_average_linear_light_without_transparent_pixels() {
        let light = Light::new();
        let (black, white, clear) = ([0, 0, 0, 255], [255, 255, 255, 255], [255, 0, 0, 0]);
        assert_eq!(mean([black, white, white, black], &light), [188, 188, 188, 255]);
        assert_eq!(mean([white, clear, clear, clear], &light), [255, 255, 255, 64]);
        assert_eq!(mean([clear; 4], &light), [0; 4]);
    }
}
