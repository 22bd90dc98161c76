//! The table of the numeric parameters (section 7.3, table 6): one row makes a parameter known everywhere.
//!
//! A row makes the variant of [`Parameter`], the fields of [`Params`](super::Params), of
//! [`UsedParams`](super::UsedParams) and of the report, the flag of the command line, the key of a parameter file, the
//! row of sliders with its tooltips, the stages that run again after a change, and a line of `docs/parameters.md`. By
//! hand remains what `auto` resolves to, in `analysis/resolve.rs`, which does not compile without the new field.

use super::setting::Setting;
use super::stage::Stage;

/// What flags, files, sliders and documents need to know of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterSpec {
    /// Its name in code, files and reports; with `-` for `_` its flag.
    pub name: &'static str,
    /// Its name in the window.
    pub title: &'static str,
    /// Unit of its values.
    pub unit: &'static str,
    /// Smallest and largest value accepted, in the unit.
    pub range: [f64; 2],
    /// Whether only whole numbers make sense.
    pub whole: bool,
    /// How its slider moves.
    pub slider: SliderSpec,
    /// The section of the paper that uses it.
    pub section: &'static str,
    /// The first stage whose output depends on it. A change makes this stage and all later ones stale.
    pub first_stage: Stage,
    /// Value in the first column of table 6, in the unit.
    pub paper: f64,
    /// Default setting of the paper's method.
    pub paper_default: Setting,
    /// Default setting of the refined method.
    pub refined_default: Setting,
    /// What the parameter does, in one line that begins in lower case and has no period at its end.
    pub meaning: &'static str,
    /// What `auto` resolves to, in the same form. The function is `analysis::resolve::used_params`.
    pub auto: &'static str,
}

/// The section of a parameter that the paper does not have.
const NOT_IN_PAPER: &str = "none in the paper";

impl ParameterSpec {
    /// Whether the paper has the parameter.
    pub fn is_in_paper(&self) -> bool {
        self.section != NOT_IN_PAPER
    }
}

/// How a slider moves. Typed values may leave the slider's range, as far as the parameter's own range reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderSpec {
    /// Values at the left and right end.
    pub range: [f64; 2],
    /// Distance between neighboring values.
    pub step: f64,
    /// Whether equal distances on the slider are equal factors.
    pub logarithmic: bool,
}

impl SliderSpec {
    /// Equal distances are equal differences.
    const fn linear(low: f64, high: f64, step: f64) -> Self {
        Self { range: [low, high], step, logarithmic: false }
    }

    /// Equal distances are equal factors.
    const fn logarithmic(low: f64, high: f64, step: f64) -> Self {
        Self { range: [low, high], step, logarithmic: true }
    }
}

/// Calls the macro named `$with` with all rows, in the order of table 6; the working scale, which the paper does not have, is the
/// last. A row is the field's name, the variant's name,
/// the meaning, and the other fields of [`ParameterSpec`].
macro_rules! parameter_rows {
    ($with:ident) => {
        $with! {
            clip_threshold ClipThreshold "a pixel with a band at or above it is clipped: its color is not believed" {
                title: "clip threshold",
                unit: "counts",
                range: [1.0, 1e6],
                whole: false,
                slider: SliderSpec::linear(100.0, 255.0, 1.0),
                section: "section 4",
                first_stage: Stage::Masks,
                paper: 240.0,
                // The paper's files are integer files; a float file does not say where it saturates.
                paper_default: Setting::Auto,
                refined_default: Setting::Auto,
                auto: "240/255 of full scale for integer files, and of the largest value of floats if many are equal to it; else off",
            }
            bloom_density BloomDensity "a pixel with this many clipped 8-neighbors is bloomed (9: blooming is ignored)" {
                title: "bloom density",
                unit: "pixels",
                range: [1.0, 9.0],
                whole: true,
                slider: SliderSpec::linear(1.0, 9.0, 1.0),
                section: "section 4",
                first_stage: Stage::Masks,
                paper: 1.0,
                paper_default: Setting::Value(1.0),
                refined_default: Setting::Value(1.0),
                auto: "the paper's value",
            }
            camera_noise CameraNoise "\u{3c3}0, twice the standard deviation of a pixel value" {
                title: "camera noise \u{3c3}0",
                unit: "counts",
                range: [0.05, 64.0],
                whole: false,
                slider: SliderSpec::logarithmic(0.5, 12.0, 0.05),
                section: "section 5.2.1",
                first_stage: Stage::Classify,
                paper: 2.5,
                paper_default: Setting::Value(2.5),
                refined_default: Setting::Auto,
                auto: "twice the standard deviation measured in the image, from 1.5 to 16 counts, and at least twice the error of lossy compression; the paper's value where it cannot be measured",
            }
            min_intensity MinIntensity "radius of the dark sphere: colors nearer to black are not analyzed" {
                title: "min. intensity",
                unit: "counts",
                range: [0.0, 441.0],
                whole: false,
                slider: SliderSpec::linear(0.0, 80.0, 1.0),
                section: "section 5.3",
                first_stage: Stage::Masks,
                paper: 23.0,
                paper_default: Setting::Value(23.0),
                refined_default: Setting::Value(23.0),
                auto: "9.2 \u{d7} \u{3c3}0, the ratio of table 6",
            }
            cylinder_width CylinderWidth "radius of the color cylinder of a linear hypothesis" {
                title: "cylinder width",
                unit: "\u{d7}\u{3c3}0",
                range: [0.5, 32.0],
                whole: false,
                slider: SliderSpec::linear(1.0, 12.0, 0.1),
                section: "section 5.3",
                first_stage: Stage::Linear,
                paper: 4.0,
                paper_default: Setting::Value(4.0),
                refined_default: Setting::Auto,
                auto: "4 \u{d7} \u{3c3}0, at most 8 counts but at least 2 \u{d7} \u{3c3}0",
            }
            slice_width SliceWidth "half width of the slice around a dichromatic plane" {
                title: "slice width",
                unit: "\u{d7}\u{3c3}0",
                range: [0.5, 32.0],
                whole: false,
                slider: SliderSpec::linear(1.0, 12.0, 0.1),
                section: "section 5.4",
                first_stage: Stage::Planar,
                paper: 4.0,
                paper_default: Setting::Value(4.0),
                refined_default: Setting::Value(4.0),
                auto: "4 \u{d7} \u{3c3}0, at most 8 counts but at least 2 \u{d7} \u{3c3}0",
            }
            window_size WindowSize "side of the windows whose local color variation is classified" {
                title: "window size",
                unit: "px",
                range: [3.0, 64.0],
                whole: true,
                slider: SliderSpec::linear(4.0, 32.0, 1.0),
                section: "section 5.2.1",
                first_stage: Stage::Classify,
                paper: 10.0,
                paper_default: Setting::Value(10.0),
                refined_default: Setting::Value(10.0),
                auto: "the paper's share of the picture's side (10 of 512 \u{d7} 480 px), from 6 to 40 px",
            }
            min_area MinArea "smallest merged area that may start a linear hypothesis" {
                title: "min. area",
                unit: "px",
                range: [4.0, 1e8],
                whole: true,
                slider: SliderSpec::logarithmic(50.0, 10_000.0, 10.0),
                section: "section 5.3",
                first_stage: Stage::Linear,
                paper: 500.0,
                paper_default: Setting::Value(500.0),
                refined_default: Setting::Value(500.0),
                auto: "the paper's share of the picture (500 of 512 \u{d7} 480 px), at least 72 px",
            }
            scale Scale "side of a working pixel: regions and light are found in the photograph averaged over blocks of this many pixels" {
                title: "working scale",
                unit: "px",
                range: [1.0, 32.0],
                whole: true,
                slider: SliderSpec::linear(1.0, 8.0, 1.0),
                section: NOT_IN_PAPER,
                first_stage: Stage::Masks,
                paper: 1.0,
                paper_default: Setting::Value(1.0),
                refined_default: Setting::Auto,
                auto: "\u{221a}(pixels / 0.5 million), rounded: 1 up to 1.1 megapixels, 3 for 2048 \u{d7} 1920 px, 5 for 12 megapixels",
            }
        }
    };
}
pub(crate) use parameter_rows;

macro_rules! define_parameter {
    ($($field:ident $variant:ident $meaning:literal { $($key:ident: $value:expr),* $(,)? })*) => {
        /// The control parameters that are numbers (table 6).
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Parameter {
            $(#[doc = concat!("`", stringify!($field), "`: ", $meaning, ".")] $variant,)*
        }

        impl Parameter {
            /// All parameters, in the order of table 6, the working scale last.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$variant),*];

            /// The parameter's row of the table.
            pub const fn spec(self) -> ParameterSpec {
                match self {
                    $(Self::$variant => ParameterSpec {
                        name: stringify!($field),
                        meaning: $meaning,
                        $($key: $value),*
                    },)*
                }
            }
        }
    };
}
parameter_rows!(define_parameter);

#[cfg(test)]
mod tests {
    use super::*;

    /// A row that contradicts itself would show as a slider that cannot reach the parameter's own default.
    #[test]
    fn every_row_is_consistent() {
        for parameter in Parameter::ALL {
            let spec = parameter.spec();
            let inside = |value: f64, [low, high]: [f64; 2]| (low..=high).contains(&value);
            assert!(inside(spec.paper, spec.range) && inside(spec.paper, spec.slider.range), "{}", spec.name);
            for value in spec.slider.range {
                assert!(inside(value, spec.range), "{}: slider {value}", spec.name);
            }
            for value in [spec.paper_default, spec.refined_default].into_iter().filter_map(Setting::value) {
                assert!(inside(value, spec.range), "{}: default {value}", spec.name);
            }
            assert!(!spec.whole || spec.slider.step.fract() == 0.0, "{}", spec.name);
        }
    }

    #[test]
    fn names_and_titles_are_unique() {
        for (index, parameter) in Parameter::ALL.into_iter().enumerate() {
            for other in &Parameter::ALL[..index] {
                assert_ne!(other.spec().name, parameter.spec().name);
                assert_ne!(other.spec().title, parameter.spec().title);
            }
        }
    }
}
