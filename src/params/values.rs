//! The control parameters (section 7.3, table 6).
//!
//! A parameter has one name everywhere: here, as a flag, in TOML, on a slider. [`Parameter::spec`] holds what
//! all of them need to know. Values are in counts, 255 = full scale, whatever the depth of the file.

use super::refine::Refine;
use super::setting::{AmbientSetting, IlluminantSetting, Setting};
use serde::{Deserialize, Serialize};

/// Which algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// The paper's algorithm with the refinements that [`Refine`] switches on.
    #[default]
    Refined,
    /// The algorithm as written in 1990, its weaknesses included.
    Paper,
}

/// The eight control parameters of table 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// `clip_threshold`
    ClipThreshold,
    /// `bloom_density`
    BloomDensity,
    /// `camera_noise`
    CameraNoise,
    /// `min_intensity`
    MinIntensity,
    /// `cylinder_width`
    CylinderWidth,
    /// `slice_width`
    SliceWidth,
    /// `window_size`
    WindowSize,
    /// `min_area`
    MinArea,
}

/// What flags, files and sliders need to know of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterSpec {
    /// Its one name.
    pub name: &'static str,
    /// Unit of its values.
    pub unit: &'static str,
    /// Smallest and largest value accepted.
    pub range: (f64, f64),
    /// Whether only whole numbers make sense.
    pub whole: bool,
    /// Value in the first column of table 6.
    pub paper: f64,
    /// What it does, in one line.
    pub meaning: &'static str,
}

impl Parameter {
    /// All of them, in the order of table 6.
    pub const ALL: [Self; 8] = [
        Self::ClipThreshold,
        Self::BloomDensity,
        Self::CameraNoise,
        Self::MinIntensity,
        Self::CylinderWidth,
        Self::SliceWidth,
        Self::WindowSize,
        Self::MinArea,
    ];

    /// Name, unit, range, the paper's value and meaning.
    pub const fn spec(self) -> ParameterSpec {
        let (name, unit, range, whole, paper, meaning) = match self {
            Self::ClipThreshold => (
                "clip_threshold",
                "counts",
                (1.0, 1e6),
                false,
                240.0,
                "a pixel with a band at or above it is clipped: its color is not believed",
            ),
            Self::BloomDensity => (
                "bloom_density",
                "pixels",
                (1.0, 9.0),
                true,
                1.0,
                "a pixel with this many clipped 8-neighbors is bloomed (9: blooming is ignored)",
            ),
            Self::CameraNoise => (
                "camera_noise",
                "counts",
                (0.05, 64.0),
                false,
                2.5,
                "\u{3c3}0, twice the standard deviation of a pixel value",
            ),
            Self::MinIntensity => (
                "min_intensity",
                "counts",
                (0.0, 441.0),
                false,
                23.0,
                "radius of the dark sphere: colors nearer to black are not analyzed",
            ),
            Self::CylinderWidth => (
                "cylinder_width",
                "\u{d7}\u{3c3}0",
                (0.5, 32.0),
                false,
                4.0,
                "radius of the color cylinder of a linear hypothesis",
            ),
            Self::SliceWidth => (
                "slice_width",
                "\u{d7}\u{3c3}0",
                (0.5, 32.0),
                false,
                4.0,
                "half width of the slice around a dichromatic plane",
            ),
            Self::WindowSize => (
                "window_size",
                "px",
                (3.0, 64.0),
                true,
                10.0,
                "side of the windows whose local color variation is classified",
            ),
            Self::MinArea => (
                "min_area",
                "px",
                (4.0, 1e8),
                true,
                500.0,
                "smallest merged area that may start a linear hypothesis",
            ),
        };
        ParameterSpec { name, unit, range, whole, paper, meaning }
    }
}

/// Most ambient light that may be given, counts a band.
const MOST_AMBIENT: f64 = 200.0;

/// What was asked for. [`Params::default`] is the refined method, [`Params::paper`] that of 1990.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(missing_docs, reason = "Parameter::spec describes each")]
pub struct Params {
    pub method: Method,
    pub clip_threshold: Setting,
    pub bloom_density: Setting,
    pub camera_noise: Setting,
    pub min_intensity: Setting,
    pub cylinder_width: Setting,
    pub slice_width: Setting,
    pub window_size: Setting,
    pub min_area: Setting,
    /// The color of the light: estimated, or given.
    pub illuminant: IlluminantSetting,
    /// The ambient light: estimated, given, or left alone.
    pub ambient: AmbientSetting,
    pub refine: Refine,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            method: Method::Refined,
            camera_noise: Setting::Auto,
            cylinder_width: Setting::Auto,
            ..Self::paper()
        }
    }
}

impl Params {
    /// The paper's method with the first column of table 6.
    pub fn paper() -> Self {
        let paper = |parameter: Parameter| Setting::Value(parameter.spec().paper);
        Self {
            method: Method::Paper,
            // 240 of 255 for integer files; a float file does not say where it saturates.
            clip_threshold: Setting::Auto,
            bloom_density: paper(Parameter::BloomDensity),
            camera_noise: paper(Parameter::CameraNoise),
            min_intensity: paper(Parameter::MinIntensity),
            cylinder_width: paper(Parameter::CylinderWidth),
            slice_width: paper(Parameter::SliceWidth),
            window_size: paper(Parameter::WindowSize),
            min_area: paper(Parameter::MinArea),
            illuminant: IlluminantSetting::Auto,
            ambient: AmbientSetting::Auto,
            refine: Refine::default(),
        }
    }

    /// The defaults of `method`.
    pub fn of(method: Method) -> Self {
        match method {
            Method::Refined => Self::default(),
            Method::Paper => Self::paper(),
        }
    }

    /// The setting of one parameter.
    pub fn get(&self, parameter: Parameter) -> Setting {
        *self.clone().slot(parameter)
    }

    /// The setting of one parameter, to be changed.
    pub fn slot(&mut self, parameter: Parameter) -> &mut Setting {
        match parameter {
            Parameter::ClipThreshold => &mut self.clip_threshold,
            Parameter::BloomDensity => &mut self.bloom_density,
            Parameter::CameraNoise => &mut self.camera_noise,
            Parameter::MinIntensity => &mut self.min_intensity,
            Parameter::CylinderWidth => &mut self.cylinder_width,
            Parameter::SliceWidth => &mut self.slice_width,
            Parameter::WindowSize => &mut self.window_size,
            Parameter::MinArea => &mut self.min_area,
        }
    }

    /// The refinements in force: none under `method = paper`.
    pub fn refinements(&self) -> Refine {
        match self.method {
            Method::Refined => self.refine,
            Method::Paper => Refine::all(false),
        }
    }

    /// Every number finite, in range and whole where it must be, and the light a color.
    ///
    /// # Errors
    /// The first parameter that is not, with its value and what was expected.
    pub fn validate(&self) -> Result<(), InvalidParameter> {
        for parameter in Parameter::ALL {
            let spec = parameter.spec();
            let Setting::Value(value) = self.get(parameter) else { continue };
            let inside = (spec.range.0..=spec.range.1).contains(&value);
            if !inside || (spec.whole && value.fract() != 0.0) {
                return Err(InvalidParameter::Number { spec, value });
            }
        }
        match self.illuminant {
            IlluminantSetting::Given(color) if self.illuminant.direction().is_none() => {
                return Err(InvalidParameter::Illuminant(color));
            }
            _ => {}
        }
        match self.ambient {
            AmbientSetting::Given(color) if color.iter().any(|band| !(0.0..=MOST_AMBIENT).contains(band)) => {
                Err(InvalidParameter::Ambient(color))
            }
            _ => Ok(()),
        }
    }
}

/// The numbers that a run worked with: what was given, or what the image said.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "Parameter::spec describes each")]
pub struct UsedParams {
    pub clip_threshold: f64,
    pub bloom_density: f64,
    pub camera_noise: f64,
    pub min_intensity: f64,
    pub cylinder_width: f64,
    pub slice_width: f64,
    pub window_size: f64,
    pub min_area: f64,
    /// Direction of the light where it was given, unit; none: the image is asked.
    pub illuminant: Option<[f64; 3]>,
    /// What was asked of the ambient light.
    pub ambient: AmbientSetting,
}

impl UsedParams {
    /// The number used for one parameter, in its unit.
    pub fn get(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::ClipThreshold => self.clip_threshold,
            Parameter::BloomDensity => self.bloom_density,
            Parameter::CameraNoise => self.camera_noise,
            Parameter::MinIntensity => self.min_intensity,
            Parameter::CylinderWidth => self.cylinder_width,
            Parameter::SliceWidth => self.slice_width,
            Parameter::WindowSize => self.window_size,
            Parameter::MinArea => self.min_area,
        }
    }

    /// Radius of the color cylinders, counts.
    pub fn radius_counts(&self) -> f64 {
        self.cylinder_width * self.camera_noise
    }

    /// Half width of the slices around dichromatic planes, counts.
    pub fn slice_half_width_counts(&self) -> f64 {
        self.slice_width * self.camera_noise
    }
}

/// A parameter that makes no sense.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InvalidParameter {
    /// A number outside its range.
    #[error("{} = {value}: expected `auto` or a {} from {} to {} {}", spec.name,
        if spec.whole { "whole number" } else { "number" }, spec.range.0, spec.range.1, spec.unit)]
    Number {
        /// The parameter.
        spec: ParameterSpec,
        /// The value that it does not accept.
        value: f64,
    },
    /// A light that is no color.
    #[error("illuminant = {0:?}: expected `auto` or three numbers from 0 on, not all of them 0")]
    Illuminant([f64; 3]),
    /// Ambient light that is no color.
    #[error("ambient = {0:?}: expected `auto`, `off` or three numbers from 0 to {MOST_AMBIENT} counts")]
    Ambient([f64; 3]),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_table_6_and_what_the_image_says() {
        assert!(Params::default().validate().is_ok());
        assert!(Params::paper().validate().is_ok());
        assert_eq!(Params::default().camera_noise, Setting::Auto);
        assert_eq!(Params::paper().camera_noise, Setting::Value(2.5));
        assert_eq!(Params::paper().refinements(), Refine::all(false));
    }

    #[test]
    fn a_bad_value_is_named_with_its_range() {
        let params = Params { window_size: Setting::Value(2.5), ..Params::default() };
        let message = params.validate().unwrap_err().to_string();
        assert_eq!(message, "window_size = 2.5: expected `auto` or a whole number from 3 to 64 px");
        let params = Params { camera_noise: Setting::Value(f64::NAN), ..Params::default() };
        assert!(params.validate().unwrap_err().to_string().starts_with("camera_noise = NaN"));
    }

    #[test]
    fn a_light_has_any_positive_length_and_no_negative_band() {
        let with = |color| Params { illuminant: IlluminantSetting::Given(color), ..Params::default() };
        for color in [[1.0, 0.9, 0.7], [255.0, 0.0, 0.0], [1e-300; 3], [f64::MAX; 3]] {
            assert!(with(color).validate().is_ok(), "{color:?}");
        }
        for color in [[0.0; 3], [1.0, -0.1, 1.0], [f64::NAN, 1.0, 1.0], [f64::INFINITY, 1.0, 1.0]] {
            let message = with(color).validate().unwrap_err().to_string();
            assert!(message.starts_with(&format!("illuminant = {color:?}: expected")), "{message}");
        }
        for color in [[-1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0], [0.0, 0.0, 201.0]] {
            let params = Params { ambient: AmbientSetting::Given(color), ..Params::default() };
            let message = params.validate().unwrap_err().to_string();
            assert!(message.starts_with(&format!("ambient = {color:?}: expected")), "{message}");
        }
    }

    #[test]
    fn toml_takes_numbers_and_auto_and_refuses_unknown_names() {
        let params: Params =
            toml::from_str("window_size = 12\ncamera_noise = \"auto\"\n[refine]\nsecond_look = false")
                .unwrap();
        assert_eq!(params.window_size, Setting::Value(12.0));
        assert!(!params.refine.second_look && params.refine.all_seeds);
        assert!(toml::from_str::<Params>("windowsize = 12").is_err());
        let text = toml::to_string(&Params::default()).unwrap();
        assert_eq!(toml::from_str::<Params>(&text).unwrap(), Params::default());
    }
}
