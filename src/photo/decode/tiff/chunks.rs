//! Puts the samples of strips or tiles together.

use super::compression;
use super::page::Page;
use super::samples::{Packing, Sample, undo_predictor};
use crate::photo::error::Fault;

/// The samples of the bands `channels` of all pixels, pixel by pixel.
pub(super) fn gather<T: Sample>(page: &Page, channels: &[usize]) -> Result<Vec<T>, Fault> {
    let mut samples = vec![T::default(); page.width * page.height * channels.len()];
    if page.in_planes {
        for (slot, &channel) in channels.iter().enumerate() {
            let plane = Plane { first_chunk: channel * page.chunks_across() * page.chunks_down() };
            plane.gather(page, &[(0, slot)], channels.len(), &mut samples)?;
        }
    } else {
        let picks: Vec<(usize, usize)> =
            channels.iter().enumerate().map(|(slot, &channel)| (channel, slot)).collect();
        Plane { first_chunk: 0 }.gather(page, &picks, channels.len(), &mut samples)?;
    }
    Ok(samples)
}

/// The strips or tiles of all bands, or of one.
struct Plane {
    first_chunk: usize,
}

impl Plane {
    /// Copies of each pixel the samples of the bands named first in `picks` to the places named second, of `stride` places.
    fn gather<T: Sample>(
        &self,
        page: &Page,
        picks: &[(usize, usize)],
        stride: usize,
        samples: &mut [T],
    ) -> Result<(), Fault> {
        let bands = page.bands_of_chunk();
        let (columns, rows) = page.chunk;
        let too_large = || Fault::damaged("its strips or tiles are too large");
        let values = columns.checked_mul(bands).ok_or_else(too_large)?;
        let row_bytes = values.checked_mul(page.bits as usize).ok_or_else(too_large)?.div_ceil(8);
        let mut row_values: Vec<T> = Vec::new();
        for index in 0..page.chunks_across() * page.chunks_down() {
            let (x, y) = (index % page.chunks_across() * columns, index / page.chunks_across() * rows);
            let visible_rows = rows.min(page.height - y);
            let visible_columns = columns.min(page.width - x);
            let mut data = compression::chunk(page, self.first_chunk + index, visible_rows, row_bytes)?;
            row_values.resize(values, T::default());
            for row in 0..visible_rows {
                let at = row * row_bytes..(row + 1) * row_bytes;
                let mut packing = Packing { bits: page.bits, big_endian: page.big_endian };
                if page.predictor != 1 {
                    packing.big_endian =
                        undo_predictor(&mut data.to_mut()[at.clone()], page.predictor, bands, packing);
                }
                T::unpack(&data[at], packing, &mut row_values);
                let first = ((y + row) * page.width + x) * stride;
                let pixels = samples[first..first + visible_columns * stride].chunks_exact_mut(stride);
                for (pixel, stored) in pixels.zip(row_values.chunks_exact(bands)) {
                    for &(band, slot) in picks {
                        pixel[slot] = stored[band];
                    }
                }
            }
        }
        Ok(())
    }
}
