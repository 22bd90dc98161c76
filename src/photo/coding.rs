//! How far a file's values are off because of the way in which the file stores them.
//!
//! One step of a code value is worth more counts in a bright pixel than in a dark one, because the tone curve is steeper
//! there. The error of the stored values is therefore constant in code values, and grows with the intensity in counts. It
//! has two causes: rounding (0.29 steps), and lossy compression. The error of JPEG extends over neighboring pixels, so that
//! the windows of [`super::NoiseEstimate`] miss most of it, while the distance of a region's pixels from its dichromatic
//! plane contains all of it.
//!
//! Measured on 230 regions of rendered scenes, each file with noise of 0.7–1.6 counts before compression: the distance from
//! the plane is 1.1–1.2 code values at JPEG quality 95, 92 and 85 alike, as coarser steps remove more of the noise.

use super::curve::ToneCurve;
use std::sync::Arc;

/// Standard deviation of rounding to whole code values: 1/√12.
const ROUNDING: f64 = 0.29;
/// Standard deviation that lossy compression leaves at fine quantization, in steps of 1/255 of the coded range.
const LOSSY: f64 = 0.85;
/// Share of a quantization step that remains as error of a pixel: a uniform error of a step of each of the about 8 of 64
/// coefficients that are not rounded to zero in a smooth block, √(8/64)/√12.
const OF_QUANTIZATION_STEP: f64 = 0.1;
/// Number of intensities in the table of a curve's slope.
const SLOPES: usize = 256;

/// What a file's format does to the values it stores.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Compression {
    /// The stored values are the values that were written.
    #[default]
    Lossless,
    /// Neighboring values were changed together, as by JPEG.
    Lossy(LossyCompression),
}

/// What is known of a lossy compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossyCompression {
    /// Root mean square quantization step of the lowest six frequencies of all tables, code values; 0 where the file does not
    /// state it.
    pub quantization_step: f64,
    /// Whether the color differences are stored with fewer samples than the brightness.
    pub chroma_subsampled: bool,
}

/// What makes the error of a file's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CodingCause {
    /// Rounding to whole code values: the errors of neighboring pixels are independent.
    Rounding,
    /// The file's lossy compression: the errors of neighboring pixels are alike.
    Compression,
    /// A lossy compression before the file was written, which the correlation of the noise shows.
    EarlierCompression,
}

impl CodingCause {
    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rounding => "rounding",
            Self::Compression => "compression",
            Self::EarlierCompression => "earlier_compression",
        }
    }
}

/// The error of a file's values that its way of storing them causes.
#[derive(Clone, Debug, PartialEq)]
pub struct CodingError {
    /// Standard deviation of a band, in steps of 1/255 of the coded range.
    pub code_values: f64,
    /// What makes the error.
    pub cause: CodingCause,
    /// Whether the color differences were stored with fewer samples than the brightness.
    pub chroma_subsampled: bool,
    /// Counts per step of 1/255 of the coded range at equally spaced intensities from 0 to full scale.
    counts_per_step: Arc<[f32]>,
    /// Counts at full scale.
    full_scale: f64,
}

impl CodingError {
    /// The error of integer samples from 0 to `max`, which `curve` takes to linear light; `full_scale` is the curve's 1 in
    /// counts. `None` for lossless linear samples: their rounding is the same at every intensity, so that the measured noise
    /// contains it.
    pub fn of_samples(
        compression: Compression,
        max: u32,
        curve: &ToneCurve,
        full_scale: f64,
    ) -> Option<Self> {
        let rounding = ROUNDING * 255.0 / f64::from(max.max(1));
        let (code_values, lossy) = match compression {
            Compression::Lossless if *curve == ToneCurve::Linear => return None,
            Compression::Lossless => (rounding, None),
            Compression::Lossy(lossy) => {
                let quantized = OF_QUANTIZATION_STEP * lossy.quantization_step;
                (LOSSY.hypot(rounding).hypot(quantized), Some(lossy))
            }
        };
        Some(Self {
            code_values,
            cause: if lossy.is_some() { CodingCause::Compression } else { CodingCause::Rounding },
            chroma_subsampled: lossy.is_some_and(|lossy| lossy.chroma_subsampled),
            counts_per_step: slopes(curve, full_scale),
            full_scale,
        })
    }

    /// The same error where it is known to extend over neighboring pixels, although the file does not say so: a picture that
    /// was compressed before it was stored.
    #[must_use]
    pub fn as_extended(&self) -> Self {
        Self {
            code_values: self.code_values.hypot(LOSSY),
            cause: CodingCause::EarlierCompression,
            // Most compressed pictures are stored so; the file does not say.
            chroma_subsampled: true,
            ..self.clone()
        }
    }

    /// The error of the mean of `side` × `side` pixels. Rounding errors are independent and average out as noise does. The error of
    /// lossy compression is alike in neighboring pixels: over blocks of 4 × 4 pixels it falls from .71 to .55 code values only, as
    /// the fourth root of the side.
    #[must_use]
    pub fn averaged(&self, side: usize) -> Self {
        if side <= 1 {
            return self.clone();
        }
        let side = side as f64;
        let remaining = if self.is_extended() { side.powf(-0.25) } else { 1.0 / side };
        Self { code_values: self.code_values * remaining, ..self.clone() }
    }

    /// Whether the errors of neighboring pixels are alike, so that a window contains only a part of the error.
    pub fn is_extended(&self) -> bool {
        self.cause != CodingCause::Rounding
    }

    /// Standard deviation of a band at a share of full scale, counts.
    pub fn at_share(&self, share: f64) -> f64 {
        self.at_intensity(share * self.full_scale)
    }

    /// Standard deviation of a band at an intensity of `counts`, counts.
    pub fn at_intensity(&self, counts: f64) -> f64 {
        let last = self.counts_per_step.len() - 1;
        let place = (counts / self.full_scale).clamp(0.0, 1.0) * last as f64;
        // The cast of a number that is none gives 0.
        self.code_values * f64::from(self.counts_per_step[(place.round() as usize).min(last)])
    }
}

/// Counts per step of 1/255 of the coded range, at [`SLOPES`] equally spaced intensities from 0 to full scale.
fn slopes(curve: &ToneCurve, full_scale: f64) -> Arc<[f32]> {
    let counts: Vec<f64> = (0..=255).map(|step| full_scale * curve.linear(f64::from(step) / 255.0)).collect();
    (0..SLOPES)
        .map(|place| {
            let intensity = full_scale * place as f64 / (SLOPES - 1) as f64;
            let above = counts.partition_point(|&value| value < intensity).clamp(1, 255);
            (counts[above] - counts[above - 1]) as f32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const JPEG: Compression =
        Compression::Lossy(LossyCompression { quantization_step: 2.6, chroma_subsampled: true });

    #[test]
    fn lossless_linear_samples_have_no_error_of_their_own() {
        assert_eq!(CodingError::of_samples(Compression::Lossless, 255, &ToneCurve::Linear, 255.0), None);
    }

    #[test]
    fn an_error_in_code_values_grows_with_the_slope_of_the_curve() {
        let error = CodingError::of_samples(JPEG, 255, &ToneCurve::Srgb, 255.0).unwrap();
        assert!((error.code_values - 0.935).abs() < 0.01, "{}", error.code_values);
        // The derivative of the sRGB curve at linear 1 is 2.4 / 1.055.
        let bright = error.at_intensity(255.0) / error.code_values;
        assert!((bright - 2.4 / 1.055).abs() < 0.02, "{bright}");
        // At linear 0.001 the curve is the line c / 12.92.
        let dark = error.at_intensity(0.255) / error.code_values;
        assert!((dark - 1.0 / 12.92).abs() < 0.01, "{dark}");
        assert!(error.at_intensity(f64::NAN).is_finite() && error.at_intensity(1e9) > 0.0);
    }

    #[test]
    fn finer_samples_round_less_and_coarser_tables_err_more() {
        let of = |compression, max| {
            CodingError::of_samples(compression, max, &ToneCurve::Srgb, 255.0).unwrap().code_values
        };
        assert!(of(Compression::Lossless, 65535) < 0.01 * of(Compression::Lossless, 255));
        let coarse =
            Compression::Lossy(LossyCompression { quantization_step: 15.0, chroma_subsampled: true });
        assert!(of(coarse, 255) > 1.5 * of(JPEG, 255));
    }
}
