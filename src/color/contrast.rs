//! The contrast curve by which a camera changes the values of sRGB: darker shadows, brighter lights, a steeper middle.
//!
//! A camera develops its pictures for the eye: after the tone curve of sRGB it applies an S curve, whose contrast differs between makers and
//! picture styles. The curve here is a sigmoid, y = ½ + ½·tanh(a·(v − ½)/2)/tanh(a/4) of the coded value v, which keeps black, middle and
//! white. Its contrast is its slope in the middle, (a/4)/tanh(a/4). ImageMagick's `-sigmoidal-contrast 4x50%` is the curve with a = 4 and
//! contrast 1.31. A contrast below 1 is the inverse of the curve whose contrast is the reciprocal.

use std::ops::RangeInclusive;

/// Steps of Newton's method for the steepness; six are enough.
const STEPS: usize = 20;

/// A contrast curve of coded values; black is 0 and white 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContrastCurve {
    contrast: f64,
    /// a; 0 for no curve.
    steepness: f64,
}

impl ContrastCurve {
    /// Contrasts that a curve can have.
    pub const CONTRASTS: RangeInclusive<f64> = 0.5..=2.5;

    /// The curve with a slope of `contrast` in the middle, which is limited to [`Self::CONTRASTS`]; 1: no curve.
    pub fn new(contrast: f64) -> Self {
        let contrast = contrast.clamp(*Self::CONTRASTS.start(), *Self::CONTRASTS.end());
        Self { contrast, steepness: steepness(contrast.max(contrast.recip())) }
    }

    /// Slope in the middle.
    pub fn contrast(&self) -> f64 {
        self.contrast
    }

    /// Whether the curve changes no value.
    pub fn is_straight(&self) -> bool {
        self.steepness <= 0.0
    }

    /// The coded value after the curve. Beyond black and white the curve goes on straight.
    pub fn apply(&self, coded: f64) -> f64 {
        if self.contrast >= 1.0 { steeper(coded, self.steepness) } else { flatter(coded, self.steepness) }
    }

    /// The coded value before the curve, the inverse of [`Self::apply`].
    pub fn undo(&self, coded: f64) -> f64 {
        if self.contrast >= 1.0 { flatter(coded, self.steepness) } else { steeper(coded, self.steepness) }
    }
}

/// The steepness a ≥ 0 with (a/4)/tanh(a/4) = `contrast` ≥ 1.
fn steepness(contrast: f64) -> f64 {
    // x/tanh x = 1 + x²/3 − …, and x for large x.
    let mut x = (3.0 * (contrast - 1.0)).sqrt().max(contrast - 1.0);
    if x < 1e-4 {
        return 0.0;
    }
    for _ in 0..STEPS {
        let tanh = x.tanh();
        let slope = (tanh - x * (1.0 - tanh * tanh)) / (tanh * tanh);
        x -= (x / tanh - contrast) / slope;
    }
    4.0 * x
}

/// The sigmoid of a steepness.
fn steeper(coded: f64, steepness: f64) -> f64 {
    let sigmoid = |v: f64| 0.5 + 0.5 * (steepness * (v - 0.5) / 2.0).tanh() / (steepness / 4.0).tanh();
    straight_outside(coded, steepness, sigmoid, |end_slope| end_slope)
}

/// The inverse of the sigmoid of a steepness.
fn flatter(coded: f64, steepness: f64) -> f64 {
    let inverse = |y: f64| 0.5 + 2.0 / steepness * ((2.0 * y - 1.0) * (steepness / 4.0).tanh()).atanh();
    straight_outside(coded, steepness, inverse, f64::recip)
}

/// A `curve` from 0 to 1; beyond, a line with the slope that `slope` makes of that of the sigmoid at its ends.
fn straight_outside(
    coded: f64,
    steepness: f64,
    curve: impl Fn(f64) -> f64,
    slope: impl Fn(f64) -> f64,
) -> f64 {
    if steepness <= 0.0 {
        return coded;
    }
    if (0.0..=1.0).contains(&coded) {
        return curve(coded).clamp(0.0, 1.0);
    }
    let tanh = (steepness / 4.0).tanh();
    let end = coded.clamp(0.0, 1.0);
    end + (coded - end) * slope(steepness / 4.0 * (1.0 - tanh * tanh) / tanh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_curve_rises_and_is_undone(contrast in 0.5f64..=2.5, coded in -0.5f64..1.5) {
            let curve = ContrastCurve::new(contrast);
            let curved = curve.apply(coded);
            prop_assert!((curve.undo(curved) - coded).abs() < 1e-9, "{coded} comes back as {}", curve.undo(curved));
            prop_assert!(curve.apply(coded + 1e-5) > curved);
        }

        #[test]
        fn the_slope_in_the_middle_is_the_contrast(contrast in 0.5f64..=2.5) {
            let curve = ContrastCurve::new(contrast);
            let slope = (curve.apply(0.5 + 1e-6) - curve.apply(0.5 - 1e-6)) / 2e-6;
            prop_assert!((slope - contrast).abs() < 1e-5, "{slope} instead of {contrast}");
        }
    }

    #[test]
    fn black_middle_and_white_stay_and_shadows_get_darker() {
        for contrast in [0.6, 1.0, 1.3, 2.5] {
            let curve = ContrastCurve::new(contrast);
            for fixed in [0.0, 0.5, 1.0] {
                assert!(
                    (curve.apply(fixed) - fixed).abs() < 1e-12 && (curve.undo(fixed) - fixed).abs() < 1e-12
                );
            }
        }
        let curve = ContrastCurve::new(1.3);
        assert!(curve.apply(0.25) < 0.25 && curve.apply(0.75) > 0.75);
        assert!((ContrastCurve::new(1.0).apply(0.3) - 0.3).abs() < 1e-15, "no contrast changes nothing");
        assert!(ContrastCurve::new(1.0).is_straight() && !ContrastCurve::new(1.01).is_straight());
    }

    #[test]
    fn a_steepness_of_four_has_the_contrast_of_the_closed_form() {
        let contrast = 1.0 / 1f64.tanh();
        assert!((ContrastCurve::new(contrast).steepness - 4.0).abs() < 1e-9);
        // The logistic function of ImageMagick's documentation.
        let logistic = |v: f64| 1.0 / (1.0 + (4.0 * (0.5 - v)).exp());
        let expected = (logistic(0.3) - logistic(0.0)) / (logistic(1.0) - logistic(0.0));
        assert!((ContrastCurve::new(contrast).apply(0.3) - expected).abs() < 1e-12);
    }
}
