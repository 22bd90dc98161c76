//! Palette pictures (TIFF 6.0, section 5).

use super::chunks::gather;
use super::page::{Kind, Page};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::Samples;

/// Red, green and blue of each pixel, and whether the color map had 8 bits: 65535 is full intensity, but some programs write
/// values from 0 to 255, which readers recognize by their size. 8-bit samples where every color is exact in them, else 16-bit.
pub(super) fn look_up(page: &Page) -> Result<(Samples, bool), Fault> {
    if page.kind != Kind::Unsigned || page.bits > 16 {
        return Err(Fault::unsupported(format!("a palette with indices of {} bits", page.bits), CONVERT));
    }
    let map: Vec<u16> = page.color_map.iter().map(|&value| value as u16).collect();
    if map.is_empty() || !map.len().is_multiple_of(3) {
        return Err(Fault::damaged("its palette is missing"));
    }
    let indices: Vec<u16> = gather(page, &[0])?;
    let colors = map.len() / 3;
    if indices.iter().any(|&index| usize::from(index) >= colors) {
        return Err(Fault::damaged("it uses colors that its palette lacks"));
    }
    let bands = |index: u16| (0..3).map(move |band| band * colors + usize::from(index));
    let values = indices.iter().flat_map(|&index| bands(index)).map(|at| map[at]);
    let has_eight_bits = map.iter().all(|&value| value < 256) && map.iter().any(|&value| value > 0);
    let samples = if has_eight_bits {
        Samples::U8(values.map(|value| value as u8).collect())
    } else if map.iter().all(|value| value % 257 == 0) {
        Samples::U8(values.map(|value| (value / 257) as u8).collect())
    } else {
        Samples::U16(values.collect())
    };
    Ok((samples, has_eight_bits))
}
