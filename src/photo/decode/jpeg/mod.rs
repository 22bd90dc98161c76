//! Decoder of JPEG (ITU-T T.81): baseline and progressive, gray and RGB, of 8 bits.
//!
//! The decoding libraries fill missing data with gray, so this decoder first checks that the file is complete, and walks its
//! codes to find missing blocks (module `gaps`). The markers also say which of two libraries decodes the file rightly, see
//! the module `samples`.

mod bits;
mod gaps;
mod header;
mod samples;

pub(super) use header::Header;
use samples::JpegSamples;
pub(super) use samples::{Color, samples};

use super::exif::Exif;
use super::{Budget, Decoded};
use crate::photo::error::Fault;
use crate::photo::source::{Layout, Samples};

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let header = Header::of_file(bytes)?;
    let size = budget.admit(header.width, header.height)?;
    header.expect_supported()?;
    header.expect_enough_bytes(bytes.len())?;
    let layout = if header.components.len() == 1 { Layout::Gray } else { Layout::Rgb };
    let JpegSamples { data, flaw } = samples(bytes, &header, header.color())?;
    let mut decoded = Decoded::plain(size, layout, Samples::U8(data));
    decoded.warnings.extend(flaw.map(|flaw| flaw.to_string()));
    decoded.compression = header.compression();
    decoded.density = header.density;
    if let Some(exif) = header.exif.as_deref().map(Exif::of_block) {
        decoded.take_exif(&exif);
    }
    decoded.icc = header.icc_profile();
    Ok(decoded)
}
