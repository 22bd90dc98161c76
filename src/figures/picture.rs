//! Pictures in the page: reduced to a sensible size, as PNG in a data URI.

use super::html::escaped;
use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::export::{png_of_rgb, png_of_rgba};
use crate::raster::Raster;
use rayon::prelude::*;

/// Most columns of a picture, pixels: twice the columns of a figure on an ordinary screen would be seldom seen.
const WIDEST_PX: usize = 900;
/// Most rows of a picture, pixels.
const HIGHEST_PX: usize = 1200;
/// Most height of a picture on the page, CSS pixels.
const HIGHEST_ON_PAGE: f64 = 480.0;
/// Most columns of a picture whose pixels are shown as squares.
const SMALL_PX: usize = 160;
/// Largest side of a pixel on the page, CSS pixels.
const LARGEST_PIXEL: f64 = 24.0;

/// How pixels are averaged where a picture is reduced.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Values {
    /// Colors of light: the mean of linear light.
    Light,
    /// Numbers shown as grays, and colors of labels: the mean of the codes.
    Codes,
}

/// A picture as an `img` element. `description` is read in place of the picture by programs that read pages aloud.
pub fn image(picture: &Raster<[u8; 4]>, values: Values, description: &str) -> String {
    let (width, height) = (picture.width(), picture.height());
    if picture.is_empty() {
        return "<p class=\"absent\">The photograph has no pixels.</p>".to_owned();
    }
    let reduced = reduced(picture, values);
    let ratio = width as f64 / height as f64;
    let widest = (HIGHEST_ON_PAGE * ratio).min(LARGEST_PIXEL * width as f64).max(1.0);
    let class = if width <= SMALL_PX { " class=\"enlarged\"" } else { "" };
    format!(
        "<img{class} src=\"{}\" width=\"{}\" height=\"{}\" style=\"max-width:{widest:.0}px\" alt=\"{}\">",
        png_uri(&png_of_rgb(&reduced)),
        reduced.width(),
        reduced.height(),
        escaped(description)
    )
}

/// A picture with transparency as a data URI. `size`: columns and rows.
pub fn transparent_uri(size: [u32; 2], rgba: &[u8]) -> String {
    png_uri(&png_of_rgba(size, rgba))
}

/// The bytes of a PNG as a data URI.
fn png_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64(png))
}

/// Bytes as text (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            if digit <= group.len() {
                text.push(char::from(DIGITS[(bits >> (18 - 6 * digit) & 63) as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

/// Side of the blocks of pixels that become one pixel.
fn block_side(width: usize, height: usize) -> usize {
    width.div_ceil(WIDEST_PX).max(height.div_ceil(HIGHEST_PX)).max(1)
}

/// The means of square blocks; the picture itself where it is small.
fn reduced(picture: &Raster<[u8; 4]>, values: Values) -> Raster<[u8; 3]> {
    let (width, height) = (picture.width(), picture.height());
    let side = block_side(width, height);
    if side == 1 {
        return picture.map(|&[r, g, b, _]| [r, g, b]);
    }
    let linear: Vec<f32> = (0..=255).map(|code| linear_from_srgb(f64::from(code) / 255.0) as f32).collect();
    let value = |code: u8| match values {
        Values::Light => linear[usize::from(code)],
        Values::Codes => f32::from(code),
    };
    let code = |mean: f32| match values {
        Values::Light => (255.0 * srgb_from_linear(mean)).round() as u8,
        Values::Codes => mean.round() as u8,
    };
    let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
    let mut small = Raster::filled(columns, rows, [0u8; 3]);
    small.as_mut_slice().par_chunks_mut(columns).enumerate().for_each(|(row, pixels)| {
        let mut sums = vec![([0f32; 3], 0f32); columns];
        for y in row * side..((row + 1) * side).min(height) {
            for (x, color) in picture.row(y).iter().enumerate() {
                let (sum, count) = &mut sums[x / side];
                for band in 0..3 {
                    sum[band] += value(color[band]);
                }
                *count += 1.0;
            }
        }
        for (pixel, (sum, count)) in pixels.iter_mut().zip(sums) {
            *pixel = sum.map(|sum| code(sum / count));
        }
    });
    small
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn bytes_become_text() {
        let texts: Vec<String> = (0..=6).map(|length| base64(&b"foobar"[..length])).collect();
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
    }

    #[test]
    fn a_large_picture_becomes_the_means_of_blocks() {
        let pixel = |i: usize| if i.is_multiple_of(2) { [0, 0, 0, 255] } else { [255, 100, 0, 255] };
        let picture = Raster::from_vec(1000, 2, (0..2000).map(pixel).collect()).unwrap();
        let codes = reduced(&picture, Values::Codes);
        assert_eq!((codes.width(), codes.height(), codes[7]), (500, 1, [128, 50, 0]));
        let light = reduced(&picture, Values::Light);
        assert_eq!(light[7], [188, 71, 0], "half the light of white is code 188");
        assert_eq!(block_side(4000, 3000), 5);
    }

    #[test]
    fn one_pixel_is_shown_as_a_square_and_none_by_a_sentence() {
        let one = image(&Raster::filled(1, 1, [9, 9, 9, 255]), Values::Codes, "a \"pixel\"");
        assert!(one.contains("max-width:24px") && one.contains("alt=\"a &quot;pixel&quot;\""), "{one}");
        assert!(image(&Raster::filled(0, 0, [0; 4]), Values::Codes, "").contains("no pixels"));
    }
}
