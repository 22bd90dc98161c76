//! Decoder of JPEG. The decoding library fills missing data with gray, so this decoder first checks that the file is
//! complete.

use super::{Budget, Decoded};
use crate::photo::error::Fault;
use crate::photo::source::{Layout, Samples};
use image::ImageDecoder;
use image::codecs::jpeg::JpegDecoder;
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    if components(bytes)? == 4 {
        return Err(Fault::unsupported("CMYK, the colors of a printing press", "convert it to RGB"));
    }
    let mut decoder = JpegDecoder::new(Cursor::new(bytes))?;
    let (width, height) = decoder.dimensions();
    let size = budget.admit(width, height)?;
    let icc = decoder.icc_profile()?;
    let orientation = decoder.orientation()?;
    let channels = usize::from(decoder.color_type().channel_count());
    let layout = Layout::of_channels(channels)
        .ok_or_else(|| Fault::unsupported(format!("{channels} bands"), "convert it to RGB"))?;
    let mut data = vec![0; size.0 * size.1 * channels];
    decoder.read_image(&mut data)?;
    Ok(Decoded { icc, orientation, ..Decoded::plain(size, layout, Samples::U8(data)) })
}

/// Number of color components of a complete file (ITU-T T.81, annex B); an error for a file that ends early.
fn components(bytes: &[u8]) -> Result<u8, Fault> {
    let cut = || Fault::damaged("it ends before its end marker");
    let mut found = None;
    // The search starts after the start-of-image marker of two bytes.
    let mut at = 2;
    loop {
        let start = at + bytes[at..].iter().position(|&b| b == 0xFF).ok_or_else(cut)?;
        // Any number of fill bytes may precede a marker.
        let marker_at = start + bytes[start..].iter().position(|&b| b != 0xFF).ok_or_else(cut)?;
        let marker = bytes[marker_at];
        at = marker_at + 1;
        match marker {
            0xD9 => return found.ok_or_else(|| Fault::damaged("it has no frame header")),
            // Stuffed zeros, and markers without content: restart markers, TEM and a second start of image.
            0x00 | 0x01 | 0xD0..=0xD8 => continue,
            _ => {}
        }
        let length = bytes.get(at..at + 2).ok_or_else(cut)?;
        let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
        let segment = bytes.get(at..at + length).ok_or_else(cut)?;
        if matches!(marker, 0xC0..=0xCF) && !matches!(marker, 0xC4 | 0xC8 | 0xCC) {
            found = segment.get(7).copied();
        }
        // The coded data after a start-of-scan segment hold only restart markers, which the search above skips.
        at += length;
    }
}
