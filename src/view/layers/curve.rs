//! The conversion of linear counts to 8-bit sRGB codes: one look-up in a table.

use crate::color::{ContrastCurve, srgb_from_linear};
use crate::photo::FULL_SCALE_COUNTS;

/// Share of white below which a value is black: 1/4 of a code at gamma 1.
const DARKEST: f32 = 1.0 / 65536.0;
/// Leading bits of a number that choose its entry: exponent and 10 bits of the mantissa.
const SHIFT: u32 = 13;
const FIRST: u32 = DARKEST.to_bits() >> SHIFT;
const ENTRIES: usize = ((1.0f32.to_bits() >> SHIFT) - FIRST + 1) as usize;

/// Exposure, the curve of sRGB, the camera's contrast curve and a gamma for display, tabulated over the leading bits of the number: the values of the
/// table are within a tenth of a code of the exact curve.
pub(crate) struct Curve {
    per_count: f32,
    codes: Vec<u8>,
}

impl Curve {
    /// A curve that brightens by `exposure_ev` stops, applies the contrast curve with which the photograph was read, and raises sRGB values to `1 / gamma`.
    pub(crate) fn new(exposure_ev: f32, contrast: Option<ContrastCurve>, gamma: f32) -> Self {
        let mut codes = vec![0u8; ENTRIES];
        // The first entry stays black.
        for (code, entry) in codes.iter_mut().zip(FIRST..).skip(1) {
            let middle = f32::from_bits((entry << SHIFT) + (1 << (SHIFT - 1)));
            let coded = f64::from(srgb_from_linear(middle.min(1.0)));
            let coded = contrast.map_or(coded, |curve| curve.apply(coded)) as f32;
            *code = (255.0 * coded.powf(1.0 / gamma.max(0.01))).round() as u8;
        }
        Self { per_count: exposure_ev.exp2() / FULL_SCALE_COUNTS as f32, codes }
    }

    /// The 8-bit value of linear counts; 255 for values brighter than white.
    #[inline]
    #[allow(clippy::manual_clamp, reason = "what is no number is black")]
    pub(crate) fn code(&self, counts: f32) -> u8 {
        let share = (counts * self.per_count).max(DARKEST).min(1.0);
        self.codes[((share.to_bits() >> SHIFT) - FIRST) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_curve() {
        for contrast in [1.0, 1.3] {
            let camera = ContrastCurve::new(contrast);
            let curve = Curve::new(0.0, Some(camera), 1.0);
            for step in 0..=100_000 {
                let linear = step as f32 / 100_000.0;
                let exact = 255.0 * camera.apply(f64::from(srgb_from_linear(linear))) as f32;
                let found = f32::from(curve.code(255.0 * linear));
                assert!((exact - found).abs() < 0.65, "{linear}: {found} instead of {exact}");
            }
        }
    }

    #[test]
    fn light_outside_the_visible_range_is_black_or_white() {
        let curve = Curve::new(0.0, None, 2.0);
        let odd = [f32::NAN, f32::NEG_INFINITY, -3.0, 0.0, 255.0, 1e9, f32::INFINITY];
        assert_eq!(odd.map(|counts| curve.code(counts)), [0, 0, 0, 0, 255, 255, 255]);
    }

    #[test]
    fn a_stop_doubles_light_and_gamma_leaves_black_and_white() {
        let (plain, brighter) = (Curve::new(0.0, None, 1.0), Curve::new(1.0, None, 1.0));
        assert_eq!([3.0, 50.0, 120.0].map(|c| brighter.code(c)), [6.0, 100.0, 240.0].map(|c| plain.code(c)));
        let lifted = Curve::new(0.0, None, 2.0);
        assert_eq!(lifted.code(54.0), (255.0 * (f32::from(plain.code(54.0)) / 255.0).sqrt()).round() as u8);
    }
}
