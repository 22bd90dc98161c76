//! Decoder of JPEG (ITU-T T.81): baseline and progressive, gray and RGB, of 8 bits and any sampling.
//!
//! The decoding libraries fill missing data with gray, so this decoder first checks that the file is complete. The markers
//! also say which of two libraries decodes the file rightly, see the module `samples`.

mod header;
mod samples;

pub(super) use header::Header;
use samples::JpegSamples;
pub(super) use samples::{Color, samples};

use super::exif::Exif;
use super::{Budget, Decoded};
use crate::photo::error::Fault;
use crate::photo::source::{Layout, Samples};

/// The warning of a file whose data the library could decode only by leaving the standard.
const PATCHED: &str =
    "the JPEG's data are damaged or deviate from the standard: a part of the picture may be wrong";

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let header = Header::of_file(bytes)?;
    let size = budget.admit(header.width, header.height)?;
    header.expect_supported()?;
    header.expect_enough_bytes(bytes.len())?;
    let layout = if header.components.len() == 1 { Layout::Gray } else { Layout::Rgb };
    let JpegSamples { data, is_patched } = samples(bytes, &header, header.color())?;
    let mut decoded = Decoded::plain(size, layout, Samples::U8(data));
    if is_patched {
        decoded.warnings.push(PATCHED.into());
    }
    decoded.compression = header.compression();
    decoded.density = header.density;
    if let Some(exif) = header.exif.as_deref().map(Exif::of_block) {
        decoded.take_exif(&exif);
    }
    decoded.icc = header.icc_profile();
    Ok(decoded)
}
