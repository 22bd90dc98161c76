//! Decoder of JPEG. The decoding library fills missing data with gray, so this decoder first checks that the file is
//! complete.

use super::{Budget, Decoded};
use crate::photo::coding::{Compression, LossyCompression};
use crate::photo::error::Fault;
use crate::photo::source::{Layout, Samples};
use image::ImageDecoder;
use image::codecs::jpeg::JpegDecoder;
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let header = Header::of_file(bytes)?;
    if header.components == 4 {
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
    let compression = Compression::Lossy(header.compression());
    Ok(Decoded { icc, compression, orientation, ..Decoded::plain(size, layout, Samples::U8(data)) })
}

/// What the markers of a complete file say (ITU-T T.81, annex B).
#[derive(Debug, Default)]
struct Header {
    /// Number of color components; 0 before the frame header.
    components: u8,
    /// Whether a component has fewer samples than another.
    subsampled: bool,
    /// Quantization steps of the lowest frequencies of all tables, code values.
    steps: Vec<u16>,
}

/// Number of lowest frequencies of a quantization table that count, in zigzag order: those that a smooth block needs.
const LOWEST_FREQUENCIES: usize = 6;

impl Header {
    /// Reads all markers; an error for a file that ends before its end marker.
    fn of_file(bytes: &[u8]) -> Result<Self, Fault> {
        let cut = || Fault::damaged("it ends before its end marker");
        let mut header = Self::default();
        // The search starts after the start-of-image marker of two bytes.
        let mut at = 2;
        loop {
            let start = at + bytes[at..].iter().position(|&b| b == 0xFF).ok_or_else(cut)?;
            // Any number of fill bytes may precede a marker.
            let marker_at = start + bytes[start..].iter().position(|&b| b != 0xFF).ok_or_else(cut)?;
            let marker = bytes[marker_at];
            at = marker_at + 1;
            match marker {
                0xD9 if header.components == 0 => return Err(Fault::damaged("it has no frame header")),
                0xD9 => return Ok(header),
                // Stuffed zeros, and markers without content: restart markers, TEM and a second start of image.
                0x00 | 0x01 | 0xD0..=0xD8 => continue,
                _ => {}
            }
            let length = bytes.get(at..at + 2).ok_or_else(cut)?;
            let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
            let segment = bytes.get(at..at + length).ok_or_else(cut)?;
            match marker {
                0xDB => header.read_tables(segment),
                0xC4 | 0xC8 | 0xCC => {}
                0xC0..=0xCF => header.read_frame(segment),
                _ => {}
            }
            // The coded data after a start-of-scan segment hold only restart markers, which the search above skips.
            at += length;
        }
    }

    /// Reads a segment of quantization tables (B.2.4.1), of which each has a byte of precision and number and 64 steps.
    fn read_tables(&mut self, segment: &[u8]) {
        let mut rest = segment.get(2..).unwrap_or_default();
        while let Some((&kind, steps)) = rest.split_first() {
            let bytes_per_step = if kind >> 4 == 0 { 1 } else { 2 };
            let read = |step: &[u8]| step.iter().fold(0, |value, &byte| (value << 8) | u16::from(byte));
            self.steps.extend(steps.chunks_exact(bytes_per_step).take(LOWEST_FREQUENCIES).map(read));
            rest = steps.get(64 * bytes_per_step..).unwrap_or_default();
        }
    }

    /// Reads a frame header (B.2.2): behind six bytes the components, of three bytes each, the second of which holds the
    /// sampling factors.
    fn read_frame(&mut self, segment: &[u8]) {
        self.components = segment.get(7).copied().unwrap_or_default();
        let factors = || segment.get(8..).unwrap_or_default().chunks_exact(3).map(|component| component[1]);
        self.subsampled = factors().any(|factor| Some(factor) != factors().next());
    }

    fn compression(&self) -> LossyCompression {
        let squares: f64 = self.steps.iter().map(|&step| f64::from(step).powi(2)).sum();
        LossyCompression {
            quantization_step: (squares / self.steps.len().max(1) as f64).sqrt(),
            chroma_subsampled: self.subsampled,
        }
    }
}
