//! Surface reflection by saturation: a color that is paler than the body reflection around it accounts for (beyond section 6).
//!
//! J = I / (√3 s) makes the light s white; a is its mean, c the length of its chromatic part, which surface reflection leaves as
//! it is. If body reflection of this hue has a = κc, then ms = a − κc is surface reflection, as far as it exceeds noise; it is
//! strong where it exceeds what the median of a/c differs from κ by.

/// Noise of ms, as a share of what independent bands would give.
const NOISE: f32 = 0.55;
/// Standard deviations of ms that are nothing, and that are not strong.
const FAINT_SDS: f32 = 3.0;
const STRONG_SDS: f32 = 5.0;
/// By how many times the differences of its hue ms has to exceed κc to be strong.
const VARIATIONS: f32 = 3.0;

/// What ms must exceed to be more than noise of standard deviation `sigma` a band, and to be strong, counts; `body` is κc.
#[inline]
pub fn desaturation_limits(sigma: f32, [ratio, median]: [f32; 2], body: f32) -> [f32; 2] {
    let noise = NOISE * sigma * (1.0 / 3.0 + ratio * ratio).sqrt();
    let variation = VARIATIONS * body * (median / ratio).max(1.0).ln();
    [FAINT_SDS * noise, (STRONG_SDS * noise).max(variation)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_grows_with_the_ratio_and_variation_with_the_body() {
        let [low, high] = desaturation_limits(1.0, [1.0, 1.0], 100.0);
        assert!(
            (low - 3.0 * 0.55 * (4f32 / 3.0).sqrt()).abs() < 1e-5 && (high - low * 5.0 / 3.0).abs() < 1e-5
        );
        let [same, varied] = desaturation_limits(1.0, [1.0, 1.1], 100.0);
        assert!((same - low).abs() < 1e-6 && (varied - 300.0 * 1.1f32.ln()).abs() < 1e-3);
        assert!(desaturation_limits(1.0, [4.0, 4.0], 1.0)[0] > 3.0 * low);
        assert!(
            (desaturation_limits(1.0, [1.0, 0.5], 100.0)[1] - high).abs() < 1e-6,
            "a median below the quantile is noise"
        );
    }
}
