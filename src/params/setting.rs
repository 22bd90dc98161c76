//! What a parameter may be set to: a value, or the wish that the image be asked.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A parameter's value, or the wish that it be estimated from the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// Estimated from the image; the report says what was used.
    Auto,
    /// This number.
    Value(f64),
}

impl Setting {
    /// The number, if one was given.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Auto => None,
            Self::Value(value) => Some(value),
        }
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Value(value) => write!(f, "{value}"),
        }
    }
}

impl std::str::FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        text.parse().map(Self::Value).map_err(|_| format!("{text:?} is neither a number nor `auto`"))
    }
}

impl Serialize for Setting {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Auto => serializer.serialize_str("auto"),
            Self::Value(value) => serializer.serialize_f64(value),
        }
    }
}

impl<'de> Deserialize<'de> for Setting {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl serde::de::Visitor<'_> for Visitor {
            type Value = Setting;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or \"auto\"")
            }

            fn visit_f64<E>(self, value: f64) -> Result<Setting, E> {
                Ok(Setting::Value(value))
            }

            fn visit_i64<E>(self, value: i64) -> Result<Setting, E> {
                Ok(Setting::Value(value as f64))
            }

            fn visit_u64<E>(self, value: u64) -> Result<Setting, E> {
                Ok(Setting::Value(value as f64))
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Setting, E> {
                text.parse().map_err(E::custom)
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// The color of the light: estimated from the highlights, or given.
///
/// In TOML and JSON `"auto"` or three numbers, as a flag `auto` or `R,G,B`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub enum IlluminantSetting {
    /// Estimated; the report says what was found.
    #[default]
    Auto,
    /// Red, green and blue of the light, of any length; every dichromatic plane turns to it.
    Given([f64; 3]),
}

impl IlluminantSetting {
    /// The unit direction of a given light; `None` when none is given, or one that is no color: a band that is negative or
    /// not finite, or no light at all.
    pub fn direction(self) -> Option<[f64; 3]> {
        let Self::Given(color) = self else { return None };
        let largest = color.iter().copied().fold(0.0, f64::max);
        if largest == 0.0 || color.iter().any(|band| !band.is_finite() || *band < 0.0) {
            return None;
        }
        // Relative to the largest band first: squares of huge and tiny lengths are no numbers.
        let relative = color.map(|band| band / largest);
        let length = relative.iter().map(|band| band * band).sum::<f64>().sqrt();
        Some(relative.map(|band| band / length))
    }
}

impl fmt::Display for IlluminantSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Given([r, g, b]) => write!(f, "{r},{g},{b}"),
        }
    }
}

impl std::str::FromStr for IlluminantSetting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        three_numbers(text)
            .map(Self::Given)
            .ok_or_else(|| format!("{text:?} is neither three numbers R,G,B nor `auto`"))
    }
}

/// How an [`IlluminantSetting`] or an [`AmbientSetting`] is written.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected three numbers or a word such as \"auto\"")]
enum Written {
    Color([f64; 3]),
    Word(String),
}

impl TryFrom<Written> for IlluminantSetting {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, Self::Error> {
        match written {
            Written::Color(color) => Ok(Self::Given(color)),
            Written::Word(word) if word == "auto" => Ok(Self::Auto),
            Written::Word(word) => Err(format!("{word:?} is neither three numbers nor `auto`")),
        }
    }
}

impl From<IlluminantSetting> for Written {
    fn from(setting: IlluminantSetting) -> Self {
        match setting {
            IlluminantSetting::Auto => Self::Word("auto".to_owned()),
            IlluminantSetting::Given(color) => Self::Color(color),
        }
    }
}

/// The ambient light (section 7.5): estimated from the matte lines, given, or left alone.
///
/// In TOML and JSON `"auto"`, `"off"` or three numbers, as a flag `auto`, `off` or `R,G,B`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub enum AmbientSetting {
    /// Estimated, and subtracted before the split where it is significant.
    #[default]
    Auto,
    /// Neither estimated nor subtracted.
    Off,
    /// What every pixel holds of it, counts.
    Given([f64; 3]),
}

impl fmt::Display for AmbientSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Off => f.write_str("off"),
            Self::Given([r, g, b]) => write!(f, "{r},{g},{b}"),
        }
    }
}

impl std::str::FromStr for AmbientSetting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "auto" => Ok(Self::Auto),
            "off" => Ok(Self::Off),
            _ => three_numbers(text)
                .map(Self::Given)
                .ok_or_else(|| format!("{text:?} is neither three numbers R,G,B nor `auto` nor `off`")),
        }
    }
}

impl TryFrom<Written> for AmbientSetting {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, Self::Error> {
        match written {
            Written::Color(color) => Ok(Self::Given(color)),
            Written::Word(word) if word == "auto" => Ok(Self::Auto),
            Written::Word(word) if word == "off" => Ok(Self::Off),
            Written::Word(word) => Err(format!("{word:?} is neither three numbers nor `auto` nor `off`")),
        }
    }
}

impl From<AmbientSetting> for Written {
    fn from(setting: AmbientSetting) -> Self {
        match setting {
            AmbientSetting::Given(color) => Self::Color(color),
            word => Self::Word(word.to_string()),
        }
    }
}

/// Three numbers parted by commas.
fn three_numbers(text: &str) -> Option<[f64; 3]> {
    let bands: Option<Vec<f64>> = text.split(',').map(|band| band.trim().parse().ok()).collect();
    bands.and_then(|bands| <[f64; 3]>::try_from(bands).ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;

    #[test]
    fn a_light_is_a_word_or_three_numbers_in_toml_and_as_a_flag() {
        let given = IlluminantSetting::Given([1.0, 0.5, 0.0]);
        let read = |text: &str| toml::from_str::<Params>(text).map(|params| params.illuminant);
        assert_eq!(read("illuminant = [1, 0.5, 0]").unwrap(), given);
        assert_eq!(read("illuminant = \"auto\"").unwrap(), IlluminantSetting::Auto);
        for wrong in ["\"white\"", "[1, 2]", "3", "[1, 2, \"x\"]"] {
            assert!(read(&format!("illuminant = {wrong}")).is_err(), "{wrong}");
        }
        assert_eq!("1,.5,0".parse(), Ok(given));
        assert_eq!("auto".parse(), Ok(IlluminantSetting::Auto));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,x"] {
            assert!(wrong.parse::<IlluminantSetting>().is_err(), "{wrong}");
        }
        for setting in [given, IlluminantSetting::Auto] {
            assert_eq!(setting.to_string().parse(), Ok(setting));
            let params = Params { illuminant: setting, ..Params::default() };
            assert_eq!(toml::from_str::<Params>(&toml::to_string(&params).unwrap()).unwrap(), params);
        }
    }

    #[test]
    fn a_light_of_any_length_has_one_direction() {
        for length in [1e-300, 0.2, 255.0, 1e300] {
            let [r, g, b] =
                IlluminantSetting::Given([3.0, 4.0, 0.0].map(|v| v * length)).direction().unwrap();
            assert!((r - 0.6).abs() < 1e-12 && (g - 0.8).abs() < 1e-12 && b == 0.0, "{length}");
        }
        assert_eq!(IlluminantSetting::Auto.direction(), None);
    }

    #[test]
    fn ambient_light_is_a_word_or_three_numbers_in_toml_and_as_a_flag() {
        let given = AmbientSetting::Given([4.0, 5.5, 0.0]);
        for (text, setting) in
            [("auto", AmbientSetting::Auto), ("off", AmbientSetting::Off), ("4,5.5,0", given)]
        {
            assert_eq!(text.parse(), Ok(setting));
            assert_eq!(setting.to_string(), text);
            let params = Params { ambient: setting, ..Params::default() };
            assert_eq!(toml::from_str::<Params>(&toml::to_string(&params).unwrap()).unwrap(), params);
        }
        for wrong in ["", "on", "1,2", "1,2,x"] {
            assert!(wrong.parse::<AmbientSetting>().is_err(), "{wrong}");
        }
    }
}
