//! Tone curves convert coded values (0 to 1) to linear light (0 to 1); the inverse is found by search.

use crate::color::{ContrastCurve, linear_from_srgb, srgb_from_linear};
use rayon::prelude::*;

/// Relation between the coded values of a file and linear light.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ToneCurve {
    /// Coded values are linear light.
    Linear,
    /// sRGB curve, IEC 61966-2-1.
    Srgb,
    /// sRGB curve, and after it the contrast curve of a camera.
    Contrast(ContrastCurve),
    /// Curve of ITU-R BT.709, BT.601 and BT.2020: the inverse of their camera curve.
    Bt709,
    /// `linear = coded ^ exponent`.
    Gamma(f64),
    /// ICC.1:2022, 10.18, type 4: `(a·x + b)^g + e` for `x ≥ d`, `c·x + f` below `d`.
    #[allow(missing_docs, reason = "the specification's names")]
    Parametric { g: f64, a: f64, b: f64, c: f64, d: f64, e: f64, f: f64 },
    /// Equally spaced linear values (65535 = 1), at least two, interpolated linearly.
    Table(Vec<u16>),
}

impl ToneCurve {
    /// Plausible exponents; a file with an exponent outside this range is taken to be wrong.
    pub(super) const EXPONENTS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

    /// Linear light of a coded value. Above 1 the curve is continued, except that a table keeps its last value.
    pub fn linear(&self, coded: f64) -> f64 {
        match self {
            Self::Linear => coded,
            Self::Srgb => linear_from_srgb(coded),
            Self::Contrast(curve) => linear_from_srgb(curve.undo(coded)),
            // H.273, table 3, value 1: the two pieces of the curve meet at 0.018 053 968 510 807 × 4.5.
            Self::Bt709 if coded < 0.081_242_858_298_635 => coded / 4.5,
            Self::Bt709 => ((coded + 0.099_296_826_809_44) / 1.099_296_826_809_44).powf(1.0 / 0.45),
            Self::Gamma(exponent) => coded.powf(*exponent),
            Self::Parametric { g, a, b, e, d, .. } if coded >= *d => (a * coded + b).powf(*g) + e,
            Self::Parametric { c, f, .. } => c * coded + f,
            Self::Table(values) => interpolate(values, coded),
        }
    }

    /// Whether the curve is that of sRGB within half a step of 8 bits.
    pub(super) fn is_like_srgb(&self) -> bool {
        let off = |i: u32| {
            let coded = f64::from(i) / 64.0;
            let linear = self.linear(coded).clamp(0.0, 1.0) as f32;
            (f64::from(srgb_from_linear(linear)) - coded).abs()
        };
        *self == Self::Srgb || (0..=64).all(|i| off(i) < 0.5 / 255.0)
    }

    /// Whether the curve has an inverse: finite, not negative and not falling from 0 to 1.
    pub(super) fn is_usable(&self) -> bool {
        let points: Vec<f64> = (0..=1024).map(|i| self.linear(f64::from(i) / 1024.0)).collect();
        points.iter().all(|v| v.is_finite() && *v >= -1e-3)
            && points.is_sorted()
            && points.first() < points.last()
            && !matches!(self, Self::Table(values) if !values.is_sorted())
    }

    /// Name of the curve within a sentence.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Linear => "linear".into(),
            Self::Srgb => "sRGB".into(),
            Self::Contrast(curve) => format!("sRGB with contrast {}", curve.contrast()),
            Self::Bt709 => "BT.709".into(),
            Self::Gamma(exponent) => {
                let text = format!("{exponent:.3}");
                format!("gamma {}", text.trim_end_matches('0').trim_end_matches('.'))
            }
            Self::Parametric { .. } => "parametric curve".into(),
            Self::Table(values) => format!("curve of {} points", values.len()),
        }
    }

    /// Counts of each integer code `0..codes`. The code `max` and all codes above it have the counts of the curve at 1,
    /// which is `full_scale` for a curve through (1, 1).
    pub(crate) fn table(&self, codes: usize, max: u32, full_scale: f64) -> Vec<f32> {
        let counts = |code: usize| self.counts((code as u32).min(max), max, full_scale);
        (0..codes).into_par_iter().map(counts).collect()
    }

    /// Counts of one integer code, at least zero.
    #[inline]
    pub(crate) fn counts(&self, code: u32, max: u32, full_scale: f64) -> f32 {
        match self {
            // A single rounding makes a linear 8-bit code of 37 exactly 37 counts.
            Self::Linear => (f64::from(code) * full_scale / f64::from(max)) as f32,
            curve => (curve.linear(f64::from(code) / f64::from(max)) * full_scale).max(0.0) as f32,
        }
    }
}

fn interpolate(values: &[u16], coded: f64) -> f64 {
    let last = values.len() - 1;
    let position = coded.clamp(0.0, 1.0) * last as f64;
    let below = (position as usize).min(last);
    let above = (below + 1).min(last);
    let fraction = position - below as f64;
    let (low, high) = (f64::from(values[below]), f64::from(values[above]));
    (low + (high - low) * fraction) / 65535.0
}

/// The integer code in `0..=max` whose counts are nearest to `counts`; `counts_of` must not fall.
pub(crate) fn nearest_code(counts: f32, max: u32, counts_of: impl Fn(u32) -> f32) -> u32 {
    let (mut low, mut high) = (0, max);
    // Comparisons with NaN are false, so NaN gives code 0, black.
    if counts >= counts_of(max) {
        return max;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if counts >= counts_of(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (below, above) = (counts_of(low), counts_of(high));
    if counts - below >= above - counts { high } else { low }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    fn curves() -> Vec<ToneCurve> {
        vec![
            ToneCurve::Linear,
            ToneCurve::Srgb,
            ToneCurve::Contrast(ContrastCurve::new(1.3)),
            ToneCurve::Bt709,
            ToneCurve::Gamma(2.2),
            ToneCurve::Parametric {
                g: 2.4,
                a: 1.0 / 1.055,
                b: 0.055 / 1.055,
                c: 1.0 / 12.92,
                d: 0.04045,
                e: 0.0,
                f: 0.0,
            },
            ToneCurve::Table(vec![0, 1000, 20000, 65535]),
        ]
    }

    #[test]
    fn curves_run_from_black_to_white() {
        for curve in curves() {
            assert!(curve.is_usable(), "{curve:?}");
            assert!(curve.linear(0.0).abs() < 1e-12 && (curve.linear(1.0) - 1.0).abs() < 1e-9, "{curve:?}");
        }
        assert!((ToneCurve::Srgb.linear(0.5) - 0.214_041_140).abs() < 1e-8);
        // H.273: V = 1.0993 · 0.18^0.45 − 0.0993 for a mid gray.
        let mid_gray = 1.099_296_826_809_44 * 0.18f64.powf(0.45) - 0.099_296_826_809_44;
        assert!((ToneCurve::Bt709.linear(mid_gray) - 0.18).abs() < 1e-12);
        // The two pieces of the curve meet at the same value.
        let (below, above) = (ToneCurve::Bt709.linear(0.081_242), ToneCurve::Bt709.linear(0.081_243));
        assert!(below < above && above - below < 1e-6);
        assert!(!ToneCurve::Table(vec![65535, 0]).is_usable());
        assert!(!ToneCurve::Table(vec![7, 7]).is_usable());
        assert!(!ToneCurve::Gamma(f64::NAN).is_usable());
    }

    #[test]
    fn linear_codes_are_their_own_counts() {
        let table = ToneCurve::Linear.table(256, 255, 255.0);
        assert!(table.iter().enumerate().all(|(code, &counts)| counts == code as f32));
        let table = ToneCurve::Linear.table(65536, 65535, 255.0);
        assert!((0..256).all(|count| table[count * 257] == count as f32));
        assert_eq!(ToneCurve::Linear.table(256, 100, 2040.0)[255], 2040.0);
    }

    #[test]
    fn every_code_is_found_again() {
        for curve in curves() {
            for max in [1, 2, 100, 255, 65535] {
                let table = curve.table(max as usize + 1, max, 255.0);
                for code in 0..=max {
                    let found = nearest_code(table[code as usize], max, |c| table[c as usize]);
                    assert_eq!(table[found as usize], table[code as usize], "{curve:?} {code}/{max}");
                }
                assert_eq!(nearest_code(f32::NAN, max, |c| table[c as usize]), 0);
                assert_eq!(nearest_code(-1.0, max, |c| table[c as usize]), 0);
                assert_eq!(nearest_code(f32::INFINITY, max, |c| table[c as usize]), max);
            }
        }
        assert_eq!(nearest_code(99.6, 255, |c| c as f32), 100);
    }
}
