//! What was asked for and what was used: method, numbers, light and refinements together (section 7.3, table 6).
//!
//! Fields for numbers are made from the rows of `table.rs`. Values in counts refer to 255 counts at full scale, whatever
//! the depth of the file.

use super::invalid::{InvalidParameter, LEAST_LAMPS_ANGLE_DEG, MOST_AMBIENT};
use super::method::Method;
use super::paper::{Baseline, PaperMethod, Rules};
use super::phoenix::PhoenixSettings;
use super::reading::Readings;
use super::refine::Refine;
use super::setting::{AmbientSetting, IlluminantSetting, Setting};
use super::table::{Parameter, parameter_rows};
use serde::{Deserialize, Serialize};

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
            /// The color of a second lamp: found where refinement `second_lamp` is on, or given.
            pub second_illuminant: IlluminantSetting,
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
                    second_illuminant: IlluminantSetting::Auto,
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
            /// Direction of the second lamp where it was given, unit length; none: a second lamp is sought.
            pub second_illuminant: Option<[f64; 3]>,
            /// What was asked of the ambient light.
            pub ambient: AmbientSetting,
        }

        impl UsedParams {
            /// The first column of table 6, with light and ambient light to be estimated.
            pub fn paper() -> Self {
                Self {
                    $($field: Parameter::$variant.spec().paper,)*
                    illuminant: None,
                    second_illuminant: None,
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
        self.validate_second_lamp()?;
        match self.ambient {
            AmbientSetting::Given(color) if color.iter().any(|band| !(0.0..=MOST_AMBIENT).contains(band)) => {
                Err(InvalidParameter::Ambient(color))
            }
            _ => Ok(()),
        }
    }

    /// A given second lamp is a color with light in every band, under the refined method, and no other name of the given first light.
    fn validate_second_lamp(&self) -> Result<(), InvalidParameter> {
        let IlluminantSetting::Given(color) = self.second_illuminant else { return Ok(()) };
        if self.method != Method::Refined {
            return Err(InvalidParameter::SecondIlluminantMethod { color, method: self.method });
        }
        let Some(direction) =
            self.second_illuminant.direction().filter(|direction| direction.iter().all(|&band| band > 0.0))
        else {
            return Err(InvalidParameter::SecondIlluminant(color));
        };
        let (IlluminantSetting::Given(first), Some(first_direction)) =
            (self.illuminant, self.illuminant.direction())
        else {
            return Ok(());
        };
        let angle_deg = angle_deg(direction, first_direction);
        if angle_deg < LEAST_LAMPS_ANGLE_DEG {
            return Err(InvalidParameter::SecondIlluminantNear { color, first, angle_deg });
        }
        Ok(())
    }
}

/// The angle between two unit vectors, degrees.
fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cosine: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    cosine.clamp(-1.0, 1.0).acos().to_degrees()
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
    fn a_second_lamp_is_a_positive_color_of_its_own_under_the_refined_method() {
        let given = IlluminantSetting::Given;
        let with =
            |illuminant, second_illuminant| Params { illuminant, second_illuminant, ..Params::default() };
        let second = given([0.7, 0.85, 1.0]);
        assert!(with(IlluminantSetting::Auto, second).validate().is_ok());
        assert!(with(given([1.0, 0.8, 0.55]), second).validate().is_ok());
        let says = |params: Params| params.validate().unwrap_err().to_string();
        for color in [[1.0, 0.0, 1.0], [1.0, -0.1, 1.0], [f64::NAN, 1.0, 1.0], [1.0, f64::INFINITY, 1.0]] {
            let message = says(with(IlluminantSetting::Auto, given(color)));
            assert!(
                message.starts_with(&format!("second_illuminant = {color:?}: expected"))
                    && message.contains("above 0"),
                "{message}"
            );
        }
        for method in Method::ALL.into_iter().filter(|&method| method != Method::Refined) {
            let message = says(Params { second_illuminant: second, ..Params::of(method) });
            assert!(
                message.starts_with("second_illuminant = [0.7, 0.85, 1.0] with method = ")
                    && message.ends_with("set method = refined or second_illuminant = auto"),
                "{message}"
            );
        }
        let near = says(with(given([1.4, 1.7, 2.02]), second));
        assert!(near.contains("at least 1\u{b0} from illuminant = [1.4, 1.7, 2.02], it is 0."), "{near}");
        assert!(with(given([1.4, 1.7, 2.1]), second).validate().is_ok(), "1.4\u{b0} apart");
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
