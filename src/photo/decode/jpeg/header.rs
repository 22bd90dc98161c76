//! What the markers of a JPEG say (ITU-T T.81, annex B).

use super::samples::Color;
use crate::photo::coding::{Compression, LossyCompression};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Density, DensityUnit};

/// One color component of the frame (B.2.2).
#[derive(Clone, Copy, Debug)]
pub(in crate::photo::decode) struct Component {
    pub id: u8,
    /// Horizontal sampling factor.
    pub across: u32,
    /// Vertical sampling factor.
    pub down: u32,
}

/// What the markers of a complete file say.
#[derive(Debug, Default)]
pub(in crate::photo::decode) struct Header {
    /// Second byte of the frame marker, 0xC0 to 0xCF; 0 before the frame header.
    process: u8,
    /// Bits of a sample.
    precision: u8,
    pub width: u32,
    pub height: u32,
    pub components: Vec<Component>,
    /// The identifiers of the components of each scan.
    pub scans: Vec<Vec<u8>>,
    /// Quantization steps of the lowest frequencies of all tables, code values.
    steps: Vec<u16>,
    /// Color transform of the Adobe segment: 0 none, 1 YCbCr, 2 YCCK.
    adobe_transform: Option<u8>,
    /// Whether there is a JFIF segment.
    jfif: bool,
    pub density: Option<Density>,
    /// Content of the EXIF segment.
    pub exif: Option<Vec<u8>>,
    /// Parts of the ICC profile, with their numbers.
    icc: Vec<(u8, Vec<u8>)>,
    /// A feature that no reader here supports, found in the markers.
    unsupported: Option<&'static str>,
}

/// Number of steps of a quantization table, in zigzag order, that enter [`Header::compression`]: those of the
/// frequencies of a smooth block.
const LOWEST_FREQUENCIES: usize = 6;

impl Header {
    /// Reads all markers up to the end marker. Errors: no end marker, no frame header or several, a damaged header, a
    /// height of 0.
    pub(in crate::photo::decode) fn of_file(bytes: &[u8]) -> Result<Self, Fault> {
        let cut = || Fault::damaged("it ends before its end marker");
        let rest = |at: usize| bytes.get(at..).unwrap_or_default();
        let mut header = Self::default();
        // The search starts after the start-of-image marker of two bytes.
        let mut at = 2;
        loop {
            let start = at + rest(at).iter().position(|&b| b == 0xFF).ok_or_else(cut)?;
            // Any number of fill bytes may precede a marker.
            let marker_at = start + rest(start).iter().position(|&b| b != 0xFF).ok_or_else(cut)?;
            let marker = bytes[marker_at];
            at = marker_at + 1;
            match marker {
                0xD9 if header.process == 0 => return Err(Fault::damaged("it has no frame header")),
                0xD9 => return Ok(header),
                // Stuffed zeros, and markers without content: restart markers, TEM and a second start of image.
                0x00 | 0x01 | 0xD0..=0xD8 => continue,
                _ => {}
            }
            let length = bytes.get(at..at + 2).ok_or_else(cut)?;
            let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
            if length < 2 {
                return Err(Fault::damaged("a segment is shorter than its length field"));
            }
            let segment = bytes.get(at..at + length).ok_or_else(cut)?;
            header.read_segment(marker, segment.get(2..).unwrap_or_default())?;
            // The coded data after a start-of-scan segment hold only restart markers, which the search above skips.
            at += length;
        }
    }

    /// Reads one segment; `content` is without the length.
    fn read_segment(&mut self, marker: u8, content: &[u8]) -> Result<(), Fault> {
        match marker {
            0xDB => self.read_tables(content),
            0xC4 | 0xC8 => {}
            0xCC => self.unsupported = Some("arithmetic coding"),
            0xC0..=0xCF => self.read_frame(marker, content)?,
            0xDA => {
                let count = usize::from(content.first().copied().unwrap_or_default());
                let cut = || Fault::damaged("its scan header is cut short");
                let entries = content.get(1..1 + 2 * count).ok_or_else(cut)?;
                self.scans.push(entries.chunks_exact(2).map(|entry| entry[0]).collect());
            }
            0xDC => self.unsupported = Some("a height behind its first scan (DNL)"),
            0xDE | 0xDF => return Err(unsupported("several frames (hierarchical coding)")),
            0xF7 => return Err(unsupported("JPEG-LS coding")),
            0xE0 => self.read_jfif(content),
            0xE1 => {
                if let Some(exif) = content.strip_prefix(b"Exif\0\0") {
                    self.exif.get_or_insert_with(|| exif.to_vec());
                }
            }
            0xE2 => {
                if let Some([number, _, part @ ..]) = content.strip_prefix(b"ICC_PROFILE\0") {
                    self.icc.push((*number, part.to_vec()));
                }
            }
            0xEE if content.starts_with(b"Adobe") => self.adobe_transform = content.get(11).copied(),
            _ => {}
        }
        Ok(())
    }

    /// Reads a segment of quantization tables (B.2.4.1), of which each has a byte of precision and number and 64 steps.
    fn read_tables(&mut self, content: &[u8]) {
        let mut rest = content;
        while let Some((&kind, steps)) = rest.split_first() {
            let bytes_per_step = if kind >> 4 == 0 { 1 } else { 2 };
            let read = |step: &[u8]| step.iter().fold(0, |value, &byte| (value << 8) | u16::from(byte));
            self.steps.extend(steps.chunks_exact(bytes_per_step).take(LOWEST_FREQUENCIES).map(read));
            rest = steps.get(64 * bytes_per_step..).unwrap_or_default();
        }
    }

    /// Reads a frame header (B.2.2): precision, height, width, and the components, of three bytes each.
    fn read_frame(&mut self, marker: u8, content: &[u8]) -> Result<(), Fault> {
        if self.process != 0 {
            return Err(Fault::damaged("it has two frame headers"));
        }
        let [precision, h1, h0, w1, w0, count, components @ ..] = content else {
            return Err(Fault::damaged("its frame header is cut short"));
        };
        (self.process, self.precision) = (marker, *precision);
        self.height = u32::from(u16::from_be_bytes([*h1, *h0]));
        self.width = u32::from(u16::from_be_bytes([*w1, *w0]));
        if self.height == 0 && self.width > 0 {
            return Err(unsupported("a height behind its first scan (DNL)"));
        }
        let component = |entry: &[u8]| Component {
            id: entry[0],
            across: u32::from(entry[1] >> 4),
            down: u32::from(entry[1] & 15),
        };
        self.components = components.chunks_exact(3).take(usize::from(*count)).map(component).collect();
        let factors = self.components.iter().flat_map(|component| [component.across, component.down]);
        let is_complete = !self.components.is_empty() && self.components.len() == usize::from(*count);
        if !is_complete || factors.into_iter().any(|factor| !(1..=4).contains(&factor)) {
            return Err(Fault::damaged("its frame header contradicts itself"));
        }
        Ok(())
    }

    /// Reads the density of a JFIF segment.
    fn read_jfif(&mut self, content: &[u8]) {
        if let [b'J', b'F', b'I', b'F', 0, _, _, unit, x1, x0, y1, y0, ..] = content {
            self.jfif = true;
            let unit = match unit {
                1 => DensityUnit::Inch,
                2 => DensityUnit::Centimeter,
                _ => DensityUnit::Ratio,
            };
            let [x, y] = [[*x1, *x0], [*y1, *y0]].map(|bytes| u32::from(u16::from_be_bytes(bytes)));
            self.density = Density::new([(x, 1), (y, 1)], unit);
        }
    }

    /// Fails for a file that is intact but not supported.
    pub(in crate::photo::decode) fn expect_supported(&self) -> Result<(), Fault> {
        match self.process {
            0xC0..=0xC2 => {}
            0xC3 => return Err(unsupported("lossless coding")),
            0xC9..=0xCB => return Err(unsupported("arithmetic coding")),
            _ => return Err(unsupported("several frames (hierarchical coding)")),
        }
        if let Some(feature) = self.unsupported {
            return Err(unsupported(feature));
        }
        if self.precision != 8 {
            return Err(unsupported(&format!("samples of {} bits", self.precision)));
        }
        match self.components.len() {
            1 | 3 => Ok(()),
            4 => Err(Fault::unsupported("CMYK, the colors of a printing press", "convert it to RGB")),
            count => Err(unsupported(&format!("{count} bands"))),
        }
    }

    /// Fails for a file that is shorter than the shortest code of all its blocks: a bit for each block of 8 × 8 samples.
    pub(in crate::photo::decode) fn expect_enough_bytes(&self, bytes: usize) -> Result<(), Fault> {
        let blocks = u64::from(self.width.div_ceil(8)) * u64::from(self.height.div_ceil(8));
        if blocks / 8 > bytes as u64 {
            return Err(Fault::damaged("it is too short for its size"));
        }
        Ok(())
    }

    /// The largest sampling factors of all components, across and down.
    pub(super) fn largest_factors(&self) -> (u32, u32) {
        let of = |factor: fn(&Component) -> u32| self.components.iter().map(factor).max().unwrap_or(1);
        (of(|component| component.across), of(|component| component.down))
    }

    pub(in crate::photo::decode) fn is_progressive(&self) -> bool {
        self.process == 0xC2
    }

    /// The meaning of the components by the rules of libjpeg: JFIF segment, else Adobe segment, else the identifiers
    /// `RGB`.
    pub(in crate::photo::decode) fn color(&self) -> Color {
        let ids: Vec<u8> = self.components.iter().map(|component| component.id).collect();
        let is_rgb = match self.adobe_transform {
            _ if self.jfif => false,
            Some(transform) => transform == 0,
            None => ids == *b"RGB",
        };
        if ids.len() != 3 || is_rgb { Color::AsStored } else { Color::FromYcbcr }
    }

    /// Whether a component has fewer samples than another.
    fn is_subsampled(&self) -> bool {
        self.components
            .windows(2)
            .any(|pair| (pair[0].across, pair[0].down) != (pair[1].across, pair[1].down))
    }

    pub(in crate::photo::decode) fn compression(&self) -> Compression {
        let squares: f64 = self.steps.iter().map(|&step| f64::from(step).powi(2)).sum();
        Compression::Lossy(LossyCompression {
            quantization_step: (squares / self.steps.len().max(1) as f64).sqrt(),
            chroma_subsampled: self.is_subsampled(),
        })
    }

    /// The embedded profile, put together from its parts.
    pub(in crate::photo::decode) fn icc_profile(mut self) -> Option<Vec<u8>> {
        self.icc.sort_by_key(|(number, _)| *number);
        (!self.icc.is_empty()).then(|| self.icc.into_iter().flat_map(|(_, part)| part).collect())
    }
}

fn unsupported(feature: &str) -> Fault {
    Fault::unsupported(feature, CONVERT)
}
