//! What was asked for and what was used: method, numbers, light and refinements together (section 7.3, table 6).
//!
//! Fields for numbers are made from the rows of `table.rs`. Values in counts refer to 255 counts at full scale, whatever
//! the depth of the file.

use super::paper::{Baseline, PaperMethod, Rules};
use super::phoenix::{PhoenixParameter, PhoenixSettings};
use super::reading::Readings;
use super::refine::Refine;
use super::setting::{AmbientSetting, IlluminantSetting, Setting};
use super::table::{Parameter, parameter_rows};
use serde::{Deserialize, Serialize};

/// Which algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The paper's algorithm with the refinements that [`Refine`] switches on.
    #[default]
    Refined,
    /// The algorithm as written in 1990, its weaknesses included.
    Paper,
    /// Phoenix, a system of recursive region splitting, to compare with (section 7.2).
    Phoenix,
    /// Clusters of the histogram of the whole picture, the way that section 5.1 rejects, to compare with.
    TopDown,
    /// A skewed T fitted to pixels that a person has marked, the method of 1987 and 1988 (section 6), to compare with.
    ByHand,
}

impl Method {
    /// All methods: the refined one first, then by age.
    pub const ALL: [Self; 5] = [Self::Refined, Self::Paper, Self::ByHand, Self::Phoenix, Self::TopDown];

    /// The name on the command line, in files and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Refined => "refined",
            Self::Paper => "paper",
            Self::Phoenix => "phoenix",
            Self::TopDown => "top-down",
            Self::ByHand => "by-hand",
        }
    }

    /// What the method is, in one sentence.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Refined => "The paper's algorithm with refinements, each a switch.",
            Self::Paper => "The algorithm as it was written in 1990, its weaknesses included.",
            Self::Phoenix => {
                "Regions alone, split by valleys in the histograms of color features (section 7.2, color figure 15)."
            }
            Self::TopDown => {
                "Regions alone: clusters of the whole picture's histogram, the way that section 5.1 rejects."
            }
            Self::ByHand => {
                "One skewed T fitted to the pixels of an area that a person has marked, as in 1987 and 1988 (section 6)."
            }
        }
    }
}

/// Most ambient light that may be given, counts a band.
const MOST_AMBIENT: f64 = 200.0;

macro_rules! define_params {
    ($($field:ident $variant:ident $meaning:literal { $($row:tt)* })*) => {
        /// What was asked for. [`Params::default`] is the refined method, [`Params::paper`] that of 1990.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct Params {
            /// Which algorithm.
            pub method: Method,
            $(#[doc = concat!($meaning, ".")] pub $field: Setting,)*
            /// The color of the light: estimated, or given.
            pub illuminant: IlluminantSetting,
            /// The ambient light: estimated, given, or left alone.
            pub ambient: AmbientSetting,
            /// The refinements of the refined method.
            pub refine: Refine,
            /// The readings of the paper's method, and the refinements added to it.
            pub paper: PaperMethod,
            /// The parameters of Phoenix.
            pub phoenix: PhoenixSettings,
        }

        impl Default for Params {
            fn default() -> Self {
                Self {
                    method: Method::Refined,
                    $($field: Parameter::$variant.spec().refined_default,)*
                    illuminant: IlluminantSetting::Auto,
                    ambient: AmbientSetting::Auto,
                    refine: Refine::default(),
                    paper: PaperMethod::default(),
                    phoenix: PhoenixSettings::default(),
                }
            }
        }

        impl Params {
            /// The paper's method with the first column of table 6.
            pub fn paper() -> Self {
                Self {
                    method: Method::Paper,
                    $($field: Parameter::$variant.spec().paper_default,)*
                    ..Self::default()
                }
            }

            /// The setting of one parameter.
            pub fn get(&self, parameter: Parameter) -> Setting {
                match parameter {
                    $(Parameter::$variant => self.$field,)*
                }
            }

            /// The setting of one parameter, to be changed.
            pub fn slot(&mut self, parameter: Parameter) -> &mut Setting {
                match parameter {
                    $(Parameter::$variant => &mut self.$field,)*
                }
            }
        }

        /// The numbers that a run worked with: those given, or those estimated from the image.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct UsedParams {
            $(#[doc = concat!($meaning, ".")] pub $field: f64,)*
            /// Direction of the light where it was given, unit length; none: the light is estimated.
            pub illuminant: Option<[f64; 3]>,
            /// What was asked of the ambient light.
            pub ambient: AmbientSetting,
        }

        impl UsedParams {
            /// The first column of table 6, with light and ambient light to be estimated.
            pub fn paper() -> Self {
                Self {
                    $($field: Parameter::$variant.spec().paper,)*
                    illuminant: None,
                    ambient: AmbientSetting::Auto,
                }
            }

            /// The number used for one parameter, in its unit.
            pub fn get(&self, parameter: Parameter) -> f64 {
                match parameter {
                    $(Parameter::$variant => self.$field,)*
                }
            }

            /// The number used for one parameter, to be changed.
            pub fn slot(&mut self, parameter: Parameter) -> &mut f64 {
                match parameter {
                    $(Parameter::$variant => &mut self.$field,)*
                }
            }
        }
    };
}
parameter_rows!(define_params);

impl Params {
    /// The defaults of `method`.
    pub fn of(method: Method) -> Self {
        match method {
            Method::Refined => Self::default(),
            Method::Paper => Self::paper(),
            // The numbers of table 6: the earlier methods use those of the masks alone.
            Method::Phoenix | Method::TopDown | Method::ByHand => Self { method, ..Self::paper() },
        }
    }

    /// The earlier method that finds the regions; none under the paper's and the refined method.
    pub fn baseline(&self) -> Option<Baseline> {
        match self.method {
            Method::Refined | Method::Paper => None,
            Method::Phoenix => Some(Baseline::Phoenix(self.phoenix)),
            Method::TopDown => Some(Baseline::TopDown),
            Method::ByHand => Some(Baseline::ByHand),
        }
    }

    /// The refinements in force. Under `method = paper` these are the refinements that were added to it, by default none; the earlier
    /// methods have none but that the method by hand asks whether its skewed T holds.
    pub fn refinements(&self) -> Refine {
        match self.method {
            Method::Refined => self.refine,
            Method::Paper => self.paper.with,
            Method::Phoenix | Method::TopDown => Refine::all(false),
            // Whether the skewed T explains the marked pixels is asked; nothing else differs from the paper.
            Method::ByHand => Refine { region_holds: true, ..Refine::all(false) },
        }
    }

    /// The refinements in force, to be changed; under the earlier methods, which have none, those of the paper's method.
    pub fn refinements_mut(&mut self) -> &mut Refine {
        match self.method {
            Method::Refined => &mut self.refine,
            Method::Paper | Method::Phoenix | Method::TopDown | Method::ByHand => &mut self.paper.with,
        }
    }

    /// The switches in force: the refinements, and the readings, which the refined method has fixed.
    pub fn rules(&self) -> Rules {
        let readings = match self.method {
            Method::Refined => Readings::REFINED,
            Method::Paper => self.paper.readings,
            // Regions without a plane keep their colors, and every region counts.
            Method::Phoenix | Method::TopDown => Readings {
                small_regions: true,
                unsplit_without_highlight: true,
                cylinder_noise: false,
                ..Readings::PAPER
            },
            // The only region counts, however small.
            Method::ByHand => Readings { small_regions: true, ..Readings::PAPER },
        };
        Rules { refine: self.refinements(), readings, baseline: self.baseline() }
    }

    /// Every number finite, in range and whole where it must be, and the light a color.
    ///
    /// # Errors
    /// The first parameter that is not, with its value and what was expected.
    pub fn validate(&self) -> Result<(), InvalidParameter> {
        for parameter in Parameter::ALL {
            let spec = parameter.spec();
            let Setting::Value(value) = self.get(parameter) else { continue };
            let inside = (spec.range[0]..=spec.range[1]).contains(&value);
            if !inside || (spec.whole && value.fract() != 0.0) {
                return Err(InvalidParameter::Number { parameter, value });
            }
        }
        if let Some((parameter, value)) = self.phoenix.first_outside() {
            return Err(InvalidParameter::Phoenix { parameter, value });
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

impl UsedParams {
    /// Radius of the color cylinders, counts.
    pub fn radius_counts(&self) -> f64 {
        self.cylinder_width * self.camera_noise
    }

    /// Half width of the slices around dichromatic planes, counts.
    pub fn slice_half_width_counts(&self) -> f64 {
        self.slice_width * self.camera_noise
    }
}

/// A parameter outside the values that it accepts.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InvalidParameter {
    /// A number outside its range.
    #[error("{} = {value}: expected `auto` or a {} from {} to {} {}", parameter.spec().name,
        if parameter.spec().whole { "whole number" } else { "number" },
        parameter.spec().range[0], parameter.spec().range[1], parameter.spec().unit)]
    Number {
        /// The parameter.
        parameter: Parameter,
        /// The value that the parameter does not accept.
        value: f64,
    },
    /// A parameter of Phoenix outside its range.
    #[error("phoenix {} = {value}: expected a whole number from {} to {} {}", parameter.name(), parameter.range()[0],
        parameter.range()[1], parameter.unit())]
    Phoenix {
        /// The parameter.
        parameter: PhoenixParameter,
        /// The value that the parameter does not accept.
        value: u32,
    },
    /// A light with a negative or infinite band, or with all bands 0.
    #[error("illuminant = {0:?}: expected `auto` or three numbers from 0 on, not all of them 0")]
    Illuminant([f64; 3]),
    /// Ambient light with a band outside its range.
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
