//! Decoder of BMP, based on the `image` crate, which leaves out what the header says about alpha, color space and density.

use super::{Budget, Decoded, simple};
use crate::photo::curve::ToneCurve;
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Density, DensityUnit, Layout, Samples};
use image::codecs::bmp::BmpDecoder;
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let header = Header { bytes };
    header.expect_supported()?;
    let mut decoded = simple::read(BmpDecoder::new(Cursor::new(bytes))?, budget)?;
    drop_unused_alpha(&mut decoded);
    decoded.density = header.density();
    decoded.transfer = header.tone_curves();
    match header.color_space() {
        Some(EMBEDDED_PROFILE) => decoded.icc = header.profile(),
        Some(LINKED_PROFILE) => {
            decoded.warnings.push("the BMP refers to a profile in another file: it is not read".into());
        }
        _ => {}
    }
    Ok(decoded)
}

const CALIBRATED_RGB: u32 = 0;
const EMBEDDED_PROFILE: u32 = u32::from_be_bytes(*b"MBED");
const LINKED_PROFILE: u32 = u32::from_be_bytes(*b"LINK");

/// Drops an alpha channel that is zero everywhere: the writer left it unused, and viewers show the picture opaque.
fn drop_unused_alpha(decoded: &mut Decoded) {
    let (Layout::Rgba, Samples::U8(samples)) = (decoded.layout, &mut decoded.samples) else { return };
    if samples.iter().skip(3).step_by(4).all(|&alpha| alpha == 0) {
        *samples = samples.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
        decoded.layout = Layout::Rgb;
    }
}

/// Fields of the header of bitmap information, which begins at byte 14; its later versions are longer.
struct Header<'a> {
    bytes: &'a [u8],
}

impl Header<'_> {
    /// The number of 32 bits at a position of the header; `None` behind the end that the header states.
    fn number(&self, at: usize) -> Option<u32> {
        let at_size = |at: usize| {
            let bytes = self.bytes.get(14 + at..14 + at + 4)?;
            Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
        };
        let length = at_size(0)? as usize;
        (at + 4 <= length).then(|| at_size(at)).flatten()
    }

    fn expect_supported(&self) -> Result<(), Fault> {
        let unsupported = |found: &str| Err(Fault::unsupported(found, CONVERT));
        match self.number(0) {
            None | Some(12 | 40 | 52 | 56 | 108 | 124) => {}
            Some(16 | 64) => return unsupported("a header of OS/2 2.x"),
            Some(length) => return Err(Fault::unsupported(format!("a header of {length} bytes"), CONVERT)),
        }
        match self.number(16) {
            Some(4) => unsupported("JPEG data"),
            Some(5) => unsupported("PNG data"),
            Some(6) => unsupported("a mask of alpha bits (BI_ALPHABITFIELDS)"),
            Some(11..=13) => unsupported("CMYK, the colors of a printing press"),
            _ => Ok(()),
        }
    }

    /// Pixels per meter.
    fn density(&self) -> Option<Density> {
        Density::new([(self.number(24)?, 1), (self.number(28)?, 1)], DensityUnit::Meter)
    }

    fn color_space(&self) -> Option<u32> {
        // The name of a color space is a number whose bytes are letters, the highest first.
        self.number(56)
    }

    /// The exponents of red, green and blue of a calibrated color space, as 16.16 fixed-point numbers.
    fn tone_curves(&self) -> Option<[ToneCurve; 3]> {
        if self.color_space()? != CALIBRATED_RGB {
            return None;
        }
        let exponents = [self.number(96)?, self.number(100)?, self.number(104)?];
        let exponents = exponents.map(|fixed| f64::from(fixed) / 65536.0);
        let plausible = exponents.iter().all(|exponent| ToneCurve::EXPONENTS.contains(exponent));
        #[allow(clippy::float_cmp, reason = "1.0 is coded exactly")]
        let curve = |exponent| if exponent == 1.0 { ToneCurve::Linear } else { ToneCurve::Gamma(exponent) };
        plausible.then(|| exponents.map(curve))
    }

    fn profile(&self) -> Option<Vec<u8>> {
        let (at, length) = (self.number(112)? as usize, self.number(116)? as usize);
        self.bytes.get(14..)?.get(at..at.checked_add(length)?).map(<[u8]>::to_vec)
    }
}
