//! Chooses the tone curve of a file: the user's choice, else the file's statement, else the default of its sample type.

use super::curve::ToneCurve;
use super::format::Format;
use super::icc;
use super::source::Source;
use crate::color::ContrastCurve;
use std::fmt;
use std::str::FromStr;

/// The user's choice of the tone curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum EncodingChoice {
    /// The file's statement decides. Without one, integers are sRGB and floats are linear.
    #[default]
    Auto,
    /// Linear light, whatever the file states.
    Linear,
    /// sRGB, whatever the file states.
    Srgb,
    /// `linear = value ^ exponent`, whatever the file states.
    Gamma(f64),
    /// sRGB after a camera's contrast curve of this contrast ([`ContrastCurve`]), whatever the file states.
    Contrast(f64),
}

impl fmt::Display for EncodingChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Linear => f.write_str("linear"),
            Self::Srgb => f.write_str("srgb"),
            Self::Gamma(exponent) => write!(f, "gamma:{exponent}"),
            Self::Contrast(contrast) => write!(f, "contrast:{contrast}"),
        }
    }
}

impl EncodingChoice {
    /// sRGB after a camera's contrast curve of this contrast; sRGB alone for 1.
    pub fn of_contrast(contrast: f64) -> Self {
        if ContrastCurve::new(contrast).is_straight() { Self::Srgb } else { Self::Contrast(contrast) }
    }

    /// Contrast of the camera's contrast curve that was chosen.
    pub fn contrast(self) -> Option<f64> {
        if let Self::Contrast(contrast) = self { Some(contrast) } else { None }
    }
}

/// Error: the text is not the name of an encoding.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no encoding: expected auto, linear, srgb, gamma:G with G from 0.1 to 10 (for example gamma:2.2) or contrast:C with C from 0.5 to 2.5 (for example contrast:1.3)"
)]
pub struct InvalidEncoding(String);

impl FromStr for EncodingChoice {
    type Err = InvalidEncoding;

    fn from_str(text: &str) -> Result<Self, InvalidEncoding> {
        let invalid = || InvalidEncoding(text.to_owned());
        match text.trim().to_ascii_lowercase().as_str() {
            "auto" => Ok(Self::Auto),
            "linear" => Ok(Self::Linear),
            "srgb" => Ok(Self::Srgb),
            other => {
                let (name, number) = other.split_once(':').ok_or_else(invalid)?;
                let number: f64 = number.trim().parse().map_err(|_| invalid())?;
                match name {
                    "gamma" if ToneCurve::EXPONENTS.contains(&number) => Ok(Self::Gamma(number)),
                    "contrast" if ContrastCurve::CONTRASTS.contains(&number) => Ok(Self::Contrast(number)),
                    _ => Err(invalid()),
                }
            }
        }
    }
}

/// The tone curves of a file, and the reason for their choice. Displayed as in `sRGB (assumed: the file does not say)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Encoding {
    /// Tone curves of the red, green and blue band; three equal curves for a gray picture.
    pub curves: [ToneCurve; 3],
    /// Reason for the choice of the curves, within a sentence.
    pub reason: String,
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.curves[0].name(), self.reason)
    }
}

impl Encoding {
    /// Whether the file's values are linear light in all bands.
    pub fn is_linear(&self) -> bool {
        self.curves.iter().all(|curve| *curve == ToneCurve::Linear)
    }

    /// The camera's contrast curve with which the file is read, that of contrast 1 for sRGB; `None` for curves that are not the curve of sRGB.
    pub fn contrast(&self) -> Option<ContrastCurve> {
        let of = |curve: &ToneCurve| match curve {
            ToneCurve::Contrast(curve) => Some(*curve),
            curve => curve.is_like_srgb().then(|| ContrastCurve::new(1.0)),
        };
        let bands = self.curves.each_ref().map(of);
        bands[0].filter(|_| bands[0] == bands[1] && bands[1] == bands[2])
    }

    fn new(curve: ToneCurve, reason: impl Into<String>) -> Self {
        Self { curves: [curve.clone(), curve.clone(), curve], reason: reason.into() }
    }

    /// The encoding of a file. A statement of the file that cannot be used is added to `warnings`, and the file is read
    /// as sRGB.
    pub(super) fn of(choice: EncodingChoice, source: &Source, warnings: &mut Vec<String>) -> Self {
        let asked = "as asked";
        match choice {
            EncodingChoice::Linear => Self::new(ToneCurve::Linear, asked),
            EncodingChoice::Srgb => Self::new(ToneCurve::Srgb, asked),
            EncodingChoice::Gamma(exponent) => Self::new(ToneCurve::Gamma(exponent), asked),
            EncodingChoice::Contrast(contrast) => {
                Self::new(ToneCurve::Contrast(ContrastCurve::new(contrast)), asked)
            }
            EncodingChoice::Auto => match said(source) {
                Some(Ok(encoding)) => encoding,
                Some(Err(problem)) => {
                    let encoding = Self::new(ToneCurve::Srgb, format!("assumed: {problem}"));
                    warnings.push(format!("{problem}: read as sRGB; --encoding says otherwise"));
                    encoding
                }
                None if source.max.is_none() => {
                    Self::new(ToneCurve::Linear, "assumed: a float file that does not say")
                }
                None => Self::new(ToneCurve::Srgb, "assumed: the file does not say"),
            },
        }
    }
}

/// The file's statement about its tone curve: `None`, an encoding, or the reason why the statement cannot be used.
///
/// Of a PNG's chunks the first present one of cICP, iCCP, sRGB and gAMA decides (PNG 3rd edition, 12.1 and 13.13).
/// A HEIF has a profile or code points.
fn said(source: &Source) -> Option<Result<Encoding, String>> {
    match source.format {
        Format::Exr => return Some(Ok(Encoding::new(ToneCurve::Linear, "OpenEXR is linear light"))),
        Format::Hdr => return Some(Ok(Encoding::new(ToneCurve::Linear, "Radiance HDR is linear light"))),
        _ => {}
    }
    if let Some(cicp) = source.cicp
        && let Some(said) = of_cicp(cicp, source.format)
    {
        return Some(said);
    }
    if let Some(profile) = &source.icc {
        let curves = icc::tone_curves(profile, source.layout.is_gray());
        return Some(curves.map(|curves| Encoding { curves, reason: "ICC profile".into() }));
    }
    if let Some(curves) = &source.transfer {
        return Some(if curves.iter().all(ToneCurve::is_usable) {
            Ok(Encoding { curves: curves.clone(), reason: format!("{} tone curve", source.format) })
        } else {
            Err(format!("the {} tone curve cannot be undone", source.format))
        });
    }
    if source.is_adobe_rgb {
        return Some(Ok(Encoding::new(ToneCurve::Gamma(ADOBE_RGB_EXPONENT), "EXIF says Adobe RGB")));
    }
    if source.png.srgb.is_some() {
        return Some(Ok(Encoding::new(ToneCurve::Srgb, "PNG sRGB chunk")));
    }
    source.png.gama.map(of_gama)
}

/// Exponent of Adobe RGB (1998), 4.3.4.2.
const ADOBE_RGB_EXPONENT: f64 = 563.0 / 256.0;

/// Tone curve of the transfer characteristics of ITU-T H.273, table 3; `None` for "unspecified".
fn of_cicp([_, transfer, _, full_range]: [u8; 4], format: Format) -> Option<Result<Encoding, String>> {
    let field = if format == Format::Heif { "HEIF nclx" } else { "PNG cICP" };
    let curve = match transfer {
        2 => return None,
        1 | 6 | 14 | 15 => Ok(ToneCurve::Bt709),
        4 => Ok(ToneCurve::Gamma(2.2)),
        5 => Ok(ToneCurve::Gamma(2.8)),
        8 => Ok(ToneCurve::Linear),
        13 => Ok(ToneCurve::Srgb),
        16 => Err(format!("{field} says PQ (SMPTE ST 2084), which is not supported")),
        18 => Err(format!("{field} says HLG (ARIB STD-B67), which is not supported")),
        other => Err(format!("{field} says transfer characteristics {other}, which is not supported")),
    };
    Some(match curve {
        Ok(_) if full_range == 0 => Err(format!("{field} says narrow range, which is not supported")),
        Ok(curve) => Ok(Encoding::new(curve, format!("{field} transfer {transfer}"))),
        Err(problem) => Err(problem),
    })
}

/// The gAMA chunk holds the exponent of the encoding × 100 000; decoding uses the inverse.
fn of_gama(gama: u32) -> Result<Encoding, String> {
    let exponent = 100_000.0 / f64::from(gama);
    let file_exponent = f64::from(gama) / 100_000.0;
    if !ToneCurve::EXPONENTS.contains(&exponent) {
        return Err(format!("PNG gAMA {file_exponent} makes no sense"));
    }
    let curve = if gama == 100_000 { ToneCurve::Linear } else { ToneCurve::Gamma(exponent) };
    Ok(Encoding::new(curve, format!("PNG gAMA {file_exponent:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_read_as_they_are_written() {
        for text in ["auto", "linear", "srgb", "gamma:2.2", "contrast:1.3", "contrast:0.8"] {
            assert_eq!(text.parse::<EncodingChoice>().unwrap().to_string(), text);
        }
        assert_eq!(" sRGB".parse(), Ok(EncodingChoice::Srgb));
        for text in [
            "",
            "gamma",
            "gamma:",
            "gamma:x",
            "gamma:0",
            "gamma:-1",
            "gamma:nan",
            "gamma:inf",
            "rec709",
            "contrast",
            "contrast:9",
            "contrast:nan",
        ] {
            let message = text.parse::<EncodingChoice>().unwrap_err().to_string();
            assert!(message.contains(&format!("`{text}`")) && message.contains("gamma:2.2"), "{message}");
        }
    }

    #[test]
    fn cicp_names_its_curves() {
        let curve = |transfer| {
            of_cicp([1, transfer, 0, 1], Format::Png).map(|said| said.map(|e| e.curves[0].clone()))
        };
        assert_eq!(curve(2), None);
        assert_eq!(curve(1), Some(Ok(ToneCurve::Bt709)));
        assert_eq!(curve(4), Some(Ok(ToneCurve::Gamma(2.2))));
        assert_eq!(curve(5), Some(Ok(ToneCurve::Gamma(2.8))));
        assert_eq!(curve(8), Some(Ok(ToneCurve::Linear)));
        assert_eq!(curve(13), Some(Ok(ToneCurve::Srgb)));
        for unsupported in [16, 18, 200] {
            assert!(curve(unsupported).unwrap().unwrap_err().contains("not supported"));
        }
        assert!(of_cicp([1, 13, 0, 0], Format::Png).unwrap().unwrap_err().contains("narrow range"));
    }

    #[test]
    fn gama_is_taken_at_its_word() {
        assert_eq!(of_gama(100_000).unwrap().to_string(), "linear (PNG gAMA 1.0)");
        let encoding = of_gama(45455).unwrap();
        assert_eq!(encoding.curves[0], ToneCurve::Gamma(100_000.0 / 45455.0));
        assert_eq!(encoding.to_string(), "gamma 2.2 (PNG gAMA 0.45455)");
        assert!(of_gama(1).is_err() && of_gama(u32::MAX).is_err());
    }
}
