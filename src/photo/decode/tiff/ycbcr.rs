//! Pictures of luminance and color differences without JPEG (TIFF 6.0, section 21).

use super::compression;
use super::page::Page;
use crate::photo::error::{CONVERT, Fault};

/// Red, green and blue of each pixel, 8 bits. Color differences are not interpolated between the pixels that share them.
pub(super) fn samples(page: &Page) -> Result<Vec<u8>, Fault> {
    let (across, down) = page.subsampling;
    if !matches!((across, down), (1 | 2 | 4, 1 | 2 | 4)) || page.bands != 3 || page.predictor != 1 {
        return Err(Fault::unsupported("unusually stored YCbCr", CONVERT));
    }
    let convert = Conversion::of(page)?;
    let (columns, rows) = page.chunk;
    let units = columns.div_ceil(across);
    // A unit holds the luminances of its pixels, and Cb and Cr.
    let unit_bytes = across * down + 2;
    let mut samples = vec![0; page.width * page.height * 3];
    for index in 0..page.chunks_across() * page.chunks_down() {
        let (left, top) = (index % page.chunks_across() * columns, index / page.chunks_across() * rows);
        let visible_rows = rows.min(page.height - top);
        let data = compression::chunk(page, index, visible_rows.div_ceil(down), units * unit_bytes)?;
        for y in 0..visible_rows {
            for x in 0..columns.min(page.width - left) {
                let unit = &data[(y / down * units + x / across) * unit_bytes..][..unit_bytes];
                let luma = unit[y % down * across + x % across];
                let at = ((top + y) * page.width + left + x) * 3;
                samples[at..at + 3].copy_from_slice(&convert.rgb([
                    luma,
                    unit[unit_bytes - 2],
                    unit[unit_bytes - 1],
                ]));
            }
        }
    }
    Ok(samples)
}

/// The conversion of a page, by its fields 529 and 532.
struct Conversion {
    /// Shares of red, green and blue in luminance.
    luma: [f64; 3],
    /// Code values of black and white, of Y, Cb and Cr.
    reference: [f64; 6],
}

impl Conversion {
    fn of(page: &Page) -> Result<Self, Fault> {
        let luma = <[f64; 3]>::try_from(&page.luma[..]).unwrap_or([0.299, 0.587, 0.114]);
        let reference =
            <[f64; 6]>::try_from(&page.reference[..]).unwrap_or([0.0, 255.0, 128.0, 255.0, 128.0, 255.0]);
        let usable = luma.iter().all(|share| *share > 0.0 && *share < 1.0)
            && reference.chunks_exact(2).all(|pair| pair[1] - pair[0] > 0.0 && pair[1].is_finite());
        if !usable {
            return Err(Fault::damaged("its conversion to RGB makes no sense"));
        }
        Ok(Self { luma, reference })
    }

    fn rgb(&self, [y, cb, cr]: [u8; 3]) -> [u8; 3] {
        let full = |code: u8, band: usize, range: f64| {
            let (black, white) = (self.reference[2 * band], self.reference[2 * band + 1]);
            (f64::from(code) - black) * range / (white - black)
        };
        let [red_share, green_share, blue_share] = self.luma;
        let (y, cb, cr) = (full(y, 0, 255.0), full(cb, 1, 127.0), full(cr, 2, 127.0));
        let red = cr * (2.0 - 2.0 * red_share) + y;
        let blue = cb * (2.0 - 2.0 * blue_share) + y;
        let green = (y - blue_share * blue - red_share * red) / green_share;
        // The cast limits to 0…255.
        [red, green, blue].map(|value| value.round() as u8)
    }
}
