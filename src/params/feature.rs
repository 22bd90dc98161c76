//! The color features whose histograms Phoenix searches (section 7.2): R, G, B, intensity, hue, saturation, Y, I, Q.
//!
//! These are the nine features of Ohlander, Price & Reddy (1978). Each feature is coded in 0…255, one code per bin of a histogram, as the
//! feature images of the published systems were. Colors are linear counts, as in the rest of this program.
//!
//! Deviation: the scale of hue begins at magenta (300°) and not at red, so that the noise of a red object does not fall to both ends of
//! the scale.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Largest code of a feature.
const MOST_CODE: f64 = 255.0;
/// Hue at which the scale of the feature begins, degrees.
const HUE_ORIGIN_DEG: f64 = 300.0;

/// A color feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// The red band.
    Red,
    /// The green band.
    Green,
    /// The blue band.
    Blue,
    /// Intensity: the mean of the three bands.
    Intensity,
    /// Hue: the angle around the gray axis.
    Hue,
    /// Saturation: 1 − 3·min(R, G, B)/(R + G + B).
    Saturation,
    /// Y of YIQ: .299 R + .587 G + .114 B.
    Luma,
    /// I of YIQ: .596 R − .274 G − .322 B.
    InPhase,
    /// Q of YIQ: .211 R − .523 G + .312 B.
    Quadrature,
}

impl Feature {
    /// All features, in the order of section 7.2.
    pub const ALL: [Self; 9] = [
        Self::Red,
        Self::Green,
        Self::Blue,
        Self::Intensity,
        Self::Hue,
        Self::Saturation,
        Self::Luma,
        Self::InPhase,
        Self::Quadrature,
    ];

    /// The letter in lists of features. I is intensity, therefore the I of YIQ is P, for "in phase".
    pub const fn letter(self) -> char {
        match self {
            Self::Red => 'R',
            Self::Green => 'G',
            Self::Blue => 'B',
            Self::Intensity => 'I',
            Self::Hue => 'H',
            Self::Saturation => 'S',
            Self::Luma => 'Y',
            Self::InPhase => 'P',
            Self::Quadrature => 'Q',
        }
    }

    /// The name in sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Green => "green",
            Self::Blue => "blue",
            Self::Intensity => "intensity",
            Self::Hue => "hue",
            Self::Saturation => "saturation",
            Self::Luma => "Y of YIQ",
            Self::InPhase => "I of YIQ",
            Self::Quadrature => "Q of YIQ",
        }
    }

    /// The code of a color (linear counts), 0…255. Hue and saturation of black, and the hue of a gray color, are 0.
    pub fn code(self, color: [f32; 3]) -> u8 {
        let [r, g, b] = color.map(f64::from);
        let sum = r + g + b;
        // I and Q of YIQ have both signs; their codes have 127.5 for 0, and the most saturated color of 255 counts at an end.
        let signed = |value: f64, most: f64| 0.5 * MOST_CODE * (1.0 + value / (most * MOST_CODE));
        let value = match self {
            Self::Red => r,
            Self::Green => g,
            Self::Blue => b,
            Self::Intensity => sum / 3.0,
            Self::Hue => hue_deg([r, g, b])
                .map_or(0.0, |hue| (hue - HUE_ORIGIN_DEG).rem_euclid(360.0) / 360.0 * MOST_CODE),
            Self::Saturation if sum > 0.0 => MOST_CODE * (1.0 - 3.0 * r.min(g).min(b) / sum),
            Self::Saturation => 0.0,
            Self::Luma => 0.299 * r + 0.587 * g + 0.114 * b,
            Self::InPhase => signed(0.596 * r - 0.274 * g - 0.322 * b, 0.596),
            Self::Quadrature => signed(0.211 * r - 0.523 * g + 0.312 * b, 0.523),
        };
        value.round().clamp(0.0, MOST_CODE) as u8
    }
}

/// The angle of a color around the gray axis, degrees from red over green to blue; none for a gray color.
fn hue_deg([r, g, b]: [f64; 3]) -> Option<f64> {
    let across = ((r - g).powi(2) + (r - b) * (g - b)).sqrt();
    if across.is_nan() || across <= 0.0 {
        return None;
    }
    let angle_deg = (0.5 * ((r - g) + (r - b)) / across).clamp(-1.0, 1.0).acos().to_degrees();
    Some(if b > g { 360.0 - angle_deg } else { angle_deg })
}

/// Some of the features, at least one; as text their letters with commas, as in `I,H,S`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct FeatureSet([bool; Feature::ALL.len()]);

impl FeatureSet {
    /// Whether a feature is among them.
    pub fn contains(&self, feature: Feature) -> bool {
        self.0[feature as usize]
    }

    /// The features, in the order of [`Feature::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = Feature> + '_ {
        Feature::ALL.into_iter().filter(|&feature| self.contains(feature))
    }

    /// The set with a feature added or removed; the last feature is not removed.
    #[must_use]
    pub fn with(self, feature: Feature, on: bool) -> Self {
        let mut changed = self;
        changed.0[feature as usize] = on;
        if changed.0.contains(&true) { changed } else { self }
    }
}

impl Default for FeatureSet {
    /// Intensity, hue and saturation, as in color figure 15.
    fn default() -> Self {
        let mut set = [false; Feature::ALL.len()];
        for feature in [Feature::Intensity, Feature::Hue, Feature::Saturation] {
            set[feature as usize] = true;
        }
        Self(set)
    }
}

impl fmt::Display for FeatureSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters: Vec<String> = self.iter().map(|feature| feature.letter().to_string()).collect();
        f.write_str(&letters.join(","))
    }
}

impl FromStr for FeatureSet {
    type Err = UnknownFeature;

    fn from_str(text: &str) -> Result<Self, UnknownFeature> {
        let mut set = [false; Feature::ALL.len()];
        for word in text.split(',').map(str::trim) {
            let named = |feature: &Feature| word.eq_ignore_ascii_case(&feature.letter().to_string());
            let feature = Feature::ALL.into_iter().find(named);
            set[feature.ok_or_else(|| UnknownFeature(word.to_owned()))? as usize] = true;
        }
        Ok(Self(set))
    }
}

impl TryFrom<String> for FeatureSet {
    type Error = UnknownFeature;

    fn try_from(text: String) -> Result<Self, UnknownFeature> {
        text.parse()
    }
}

impl From<FeatureSet> for String {
    fn from(set: FeatureSet) -> Self {
        set.to_string()
    }
}

/// A text that is no feature's letter.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{0:?} is no feature: R, G, B, I (intensity), H (hue), S (saturation), Y, P (the I of YIQ) or Q, separated by commas"
)]
pub struct UnknownFeature(pub String);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_codes_of_known_colors() {
        let codes = |color: [f32; 3]| Feature::ALL.map(|feature| feature.code(color));
        assert_eq!(codes([0.0; 3]), [0, 0, 0, 0, 0, 0, 0, 128, 128]);
        assert_eq!(codes([90.0; 3])[..7], [90, 90, 90, 90, 0, 0, 90]);
        // The hues of red, green and blue are 60°, 180° and 300° after magenta.
        let hue = |color| Feature::Hue.code(color);
        assert_eq!([[9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]].map(hue), [43, 128, 213]);
        assert_eq!(Feature::Saturation.code([200.0, 0.0, 0.0]), 255);
        assert_eq!(Feature::Saturation.code([150.0, 75.0, 75.0]), 64);
        assert_eq!(Feature::InPhase.code([255.0, 0.0, 0.0]), 255);
        assert_eq!(Feature::Red.code([400.0, 0.0, -3.0]), 255);
    }

    #[test]
    fn hue_and_saturation_do_not_depend_on_the_intensity() {
        for feature in [Feature::Hue, Feature::Saturation] {
            let codes =
                [1.0f32, 2.5, 3.0].map(|gain| feature.code([60.0, 20.0, 44.0].map(|band| band * gain)));
            assert_eq!(codes, [codes[0]; 3], "{feature:?}");
        }
    }

    #[test]
    fn a_list_of_letters_is_a_set_and_any_other_text_is_an_error() {
        let set: FeatureSet = "s, i,h".parse().unwrap();
        assert_eq!((set, set.to_string().as_str()), (FeatureSet::default(), "I,H,S"));
        assert_eq!("Z".parse::<FeatureSet>(), Err(UnknownFeature("Z".to_owned())));
        assert!("".parse::<FeatureSet>().unwrap_err().to_string().starts_with("\"\" is no feature: R, G, B"));
        let alone: FeatureSet = "Q".parse().unwrap();
        assert_eq!(alone.with(Feature::Quadrature, false), alone, "the last feature stays");
        assert_eq!(alone.with(Feature::Red, true).to_string(), "R,Q");
    }
}
