//! Surface reflection by saturation: a color that is less saturated than the body reflection of its surroundings accounts for
//! (beyond section 6).
//!
//! J = I / (√3 s) makes the light s white; a is the mean of J, c the length of the chromatic part of J, which surface reflection
//! leaves unchanged. If body reflection of this hue has a = κc, then ms = a − κc is surface reflection where ms exceeds the noise;
//! ms is strong where ms exceeds the difference of κ from the median of a/c as well.
//!
//! The local split and the history of a pixel both use [`WhiteningGain`] and [`Desaturation`].

use crate::color::Vec3;

/// Standard deviation of ms, as a share of the value that independent bands would give.
const NOISE: f32 = 0.55;
/// ms below this number of standard deviations is noise.
const FAINT_SDS: f32 = 3.0;
/// ms below this number of standard deviations is not strong.
const STRONG_SDS: f32 = 5.0;
/// ms is strong above this multiple of the variation of a/c in its hue.
const VARIATIONS: f32 = 3.0;

/// The factor of each band that makes the light white: 1 / (√3 s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteningGain {
    gain: [f32; 3],
}

/// Mean, chromatic part and hue of a color under white light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WhitenedColor {
    /// a: the mean of J, counts.
    pub mean: f32,
    /// c: the length of the chromatic part of J, counts.
    pub chroma: f32,
    /// Hue: the direction of the chromatic part, turns, from 0 to less than 1.
    pub hue_turns: f32,
    /// The largest band of J, counts.
    pub largest: f32,
}

impl WhiteningGain {
    /// The gain for the light `light`; none where the light lacks a band.
    pub fn new(light: &Vec3) -> Option<Self> {
        let gain: [f32; 3] = std::array::from_fn(|band| (1.0 / (3f64.sqrt() * light[band])) as f32);
        gain.iter().all(|gain| gain.is_finite() && *gain > 0.0).then_some(Self { gain })
    }

    /// a: the mean of J of a color in counts, counts.
    #[inline]
    pub fn mean(&self, color: [f32; 3]) -> f32 {
        (color[0] * self.gain[0] + color[1] * self.gain[1] + color[2] * self.gain[2]) / 3.0
    }

    /// The chromatic part of J of a color in counts: J without its mean, counts.
    pub fn chromatic_part(&self, color: [f32; 3]) -> [f32; 3] {
        let mean = self.mean(color);
        std::array::from_fn(|band| color[band] * self.gain[band] - mean)
    }

    /// A color, counts, under white light.
    #[inline]
    pub fn whitened(&self, color: [f32; 3]) -> WhitenedColor {
        let j: [f32; 3] = std::array::from_fn(|band| color[band] * self.gain[band]);
        let mean = (j[0] + j[1] + j[2]) / 3.0;
        let (u, v) = ((2.0 * j[0] - j[1] - j[2]) / 6f32.sqrt(), (j[1] - j[2]) / 2f32.sqrt());
        let turns = v.atan2(u) / std::f32::consts::TAU;
        WhitenedColor {
            mean,
            chroma: (u * u + v * v).sqrt(),
            hue_turns: (turns + 1.0).fract(),
            largest: j[0].max(j[1]).max(j[2]),
        }
    }
}

/// The surface reflection that the saturation of one color indicates, and the limits of that. All in counts of J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Desaturation {
    /// ms = a − κc, at least 0: the brightness that the saturation does not account for.
    pub surface: f32,
    /// κc: the body reflection, which is the brightness that the saturation accounts for.
    pub body: f32,
    /// ms up to this value is noise.
    pub noise_limit: f32,
    /// ms up to this value is noise or variation of the hue in the surroundings.
    pub variation_limit: f32,
}

impl WhitenedColor {
    /// The unit vector of the chromatic part of J of this hue.
    pub fn hue(&self) -> [f32; 3] {
        let (v, u) = (self.hue_turns * std::f32::consts::TAU).sin_cos();
        let (across, along) = (v / 2f32.sqrt(), u / 6f32.sqrt());
        [2.0 * along, across - along, -across - along]
    }
}

impl Desaturation {
    /// The desaturation of a color. `ratios`: κ, the ratio a/c of body reflection in the surroundings, and the median of a/c
    /// there. `sigma`: standard deviation of the noise of a band, counts.
    #[inline]
    pub fn new(color: WhitenedColor, ratios: [f32; 2], sigma: f32) -> Self {
        let [ratio, median] = ratios;
        let body = ratio * color.chroma;
        let noise = NOISE * sigma * (1.0 / 3.0 + ratio * ratio).sqrt();
        let variation = VARIATIONS * body * (median / ratio).max(1.0).ln();
        Self {
            surface: (color.mean - body).max(0.0),
            body,
            noise_limit: FAINT_SDS * noise,
            variation_limit: (STRONG_SDS * noise).max(variation),
        }
    }

    /// The desaturation of a color that cannot be judged: no limits.
    #[inline]
    pub fn unjudged(color: WhitenedColor, ratio: f32) -> Self {
        let body = (ratio * color.chroma).min(color.mean);
        Self { body, surface: (color.mean - body).max(0.0), ..Self::default() }
    }

    /// Whether the color has a hue, so that its surface reflection can be judged.
    #[inline]
    pub fn is_judged(&self) -> bool {
        self.noise_limit > 0.0
    }

    /// Whether there is more surface reflection than noise explains.
    #[inline]
    pub fn exceeds_noise(&self) -> bool {
        self.surface > self.noise_limit && self.noise_limit > 0.0
    }

    /// Whether there is more surface reflection than noise and the variation of the hue in the surroundings explain.
    #[inline]
    pub fn is_strong(&self) -> bool {
        self.surface > self.variation_limit && self.variation_limit > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(ratios: [f32; 2], body: f32) -> [f32; 2] {
        let color = WhitenedColor { mean: 0.0, chroma: body / ratios[0], hue_turns: 0.0, largest: 0.0 };
        let found = Desaturation::new(color, ratios, 1.0);
        [found.noise_limit, found.variation_limit]
    }

    #[test]
    fn the_hue_is_the_direction_of_the_chromatic_part() {
        let gain = WhiteningGain::new(&Vec3::new(0.7, 0.5, 0.5)).unwrap();
        for color in [[200.0, 90.0, 30.0], [20.0, 90.0, 130.0], [60.0, 10.0, 80.0]] {
            let (whitened, part) = (gain.whitened(color), gain.chromatic_part(color));
            let along = whitened.hue().map(|band| band * whitened.chroma);
            assert!(part.iter().zip(along).all(|(a, b)| (a - b).abs() < 1e-3), "{part:?} {along:?}");
        }
    }

    #[test]
    fn noise_grows_with_the_ratio_and_variation_with_the_body() {
        let [low, high] = limits([1.0, 1.0], 100.0);
        assert!(
            (low - 3.0 * 0.55 * (4f32 / 3.0).sqrt()).abs() < 1e-5 && (high - low * 5.0 / 3.0).abs() < 1e-5
        );
        let [same, varied] = limits([1.0, 1.1], 100.0);
        assert!((same - low).abs() < 1e-6 && (varied - 300.0 * 1.1f32.ln()).abs() < 1e-3);
        assert!(limits([4.0, 4.0], 1.0)[0] > 3.0 * low);
        assert!((limits([1.0, 0.5], 100.0)[1] - high).abs() < 1e-6, "a median below the quantile is noise");
    }

    #[test]
    fn surface_reflection_adds_to_the_mean_alone() {
        let light = Vec3::new(0.62, 0.57, 0.54).normalize();
        let gain = WhiteningGain::new(&light).unwrap();
        let (matte, amount) = ([80.0f32, 40.0, 30.0], 60.0);
        let glossy = std::array::from_fn(|band| matte[band] + (amount * 3f64.sqrt() * light[band]) as f32);
        let (matte, glossy) = (gain.whitened(matte), gain.whitened(glossy));
        assert!((glossy.mean - matte.mean - amount as f32).abs() < 1e-3, "{matte:?} {glossy:?}");
        assert!((glossy.chroma - matte.chroma).abs() < 1e-3);
        assert!((glossy.hue_turns - matte.hue_turns).abs() < 1e-4);
        let found = Desaturation::new(glossy, [matte.mean / matte.chroma; 2], 1.0);
        assert!((found.surface - amount as f32).abs() < 1e-2 && found.exceeds_noise() && found.is_strong());
        let unjudged = Desaturation::unjudged(glossy, 1.0);
        assert!(!unjudged.exceeds_noise() && !unjudged.is_strong());
        assert!(WhiteningGain::new(&Vec3::new(1.0, 0.0, 0.0)).is_none());
    }
}
