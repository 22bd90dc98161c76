//! Palette pictures (TIFF 6.0, section 5). The `tiff` crate rejects them, although palette indices are stored like gray
//! values.

use super::Reader;
use crate::photo::error::Fault;
use crate::photo::source::Samples;
use tiff::tags::Tag;

const PALETTE_COLOR: u16 = 3;
const BLACK_IS_ZERO: u16 = 1;

/// Color map of the file: all reds, then all greens, then all blues; 65535 is full intensity.
pub(super) struct Palette(Vec<u16>);

/// Reads the palette of the first picture; `None` when the picture has no palette.
pub(super) fn of(reader: &mut Reader) -> Result<Option<Palette>, Fault> {
    if reader.find_tag_unsigned::<u16>(Tag::PhotometricInterpretation)? != Some(PALETTE_COLOR) {
        return Ok(None);
    }
    let map = reader.find_tag_unsigned_vec::<u16>(Tag::ColorMap)?;
    let map = map.filter(|map| !map.is_empty() && map.len() % 3 == 0);
    map.map(Palette).map(Some).ok_or_else(|| Fault::damaged("its palette is missing"))
}

impl Palette {
    /// R, G and B of each index: 8-bit samples when every palette entry is an exact multiple of 257, else 16-bit
    /// samples.
    pub(super) fn look_up(&self, indices: &[u8]) -> Result<Samples, Fault> {
        let colors = self.0.len() / 3;
        if indices.iter().any(|&index| usize::from(index) >= colors) {
            return Err(Fault::damaged("it uses colors that its palette lacks"));
        }
        let bands = |index: u8| (0..3).map(move |band| self.0[band * colors + usize::from(index)]);
        let samples = indices.iter().flat_map(|&index| bands(index));
        Ok(if self.0.iter().all(|value| value % 257 == 0) {
            Samples::U8(samples.map(|value| (value / 257) as u8).collect())
        } else {
            Samples::U16(samples.collect())
        })
    }
}

/// A copy of the file in which the photometric interpretation of the first picture is set to gray.
pub(super) fn indices_as_gray(bytes: &[u8]) -> Result<Vec<u8>, Fault> {
    let directory = Directory::of(bytes);
    let value_at = directory
        .and_then(|d| d.value_of(262))
        .ok_or_else(|| Fault::damaged("its directory is cut short"))?;
    let mut copy = bytes.to_vec();
    let value =
        if bytes.starts_with(b"II") { BLACK_IS_ZERO.to_le_bytes() } else { BLACK_IS_ZERO.to_be_bytes() };
    copy[value_at..value_at + 2].copy_from_slice(&value);
    Ok(copy)
}

/// Position of the first image file directory (TIFF 6.0, section 2; `BigTIFF` has wider fields).
struct Directory<'a> {
    bytes: &'a [u8],
    big: bool,
    first_entry: usize,
    entries: usize,
}

impl<'a> Directory<'a> {
    fn of(bytes: &'a [u8]) -> Option<Self> {
        let big = number(bytes, 2, 2)? == 43;
        let start = if big { number(bytes, 8, 8)? } else { number(bytes, 4, 4)? };
        let count_bytes = if big { 8 } else { 2 };
        let entries = number(bytes, start, count_bytes)?;
        Some(Self { bytes, big, first_entry: start.checked_add(count_bytes)?, entries })
    }

    /// Position of the value of a tag whose value is short enough to be stored in the directory entry.
    fn value_of(&self, tag: usize) -> Option<usize> {
        let (entry_bytes, value_offset) = if self.big { (20, 12) } else { (12, 8) };
        let offsets = (0..self.entries).map(|entry| self.first_entry + entry * entry_bytes);
        for at in offsets.take_while(|at| at + entry_bytes <= self.bytes.len()) {
            if number(self.bytes, at, 2) == Some(tag) {
                return Some(at + value_offset);
            }
        }
        None
    }
}

/// The unsigned integer of `length` bytes at `at`, in the file's byte order.
fn number(bytes: &[u8], at: usize, length: usize) -> Option<usize> {
    let field = bytes.get(at..at.checked_add(length)?)?;
    let append = |number: usize, &byte: &u8| number.checked_mul(256)?.checked_add(usize::from(byte));
    if bytes.starts_with(b"II") {
        field.iter().rev().try_fold(0, append)
    } else {
        field.iter().try_fold(0, append)
    }
}
