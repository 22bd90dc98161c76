//! The parameters of Phoenix (section 7.2), by their published names.
//!
//! One row makes a parameter known everywhere: the field of [`PhoenixSettings`], the value of `--phoenix NAME=VALUE`, the key under
//! `[phoenix]` of a parameter file, the entry of the report, and a line of `docs/baselines.md`. The names are those of Laws, *The Phoenix
//! image segmentation system: description and evaluation* (SRI, 1982). The report itself was not at hand: the names, their meaning and the
//! defaults of `hsmooth`, `maxmin`, `splitmin` and `height` are those usually quoted, and were not compared with it. The other defaults, and
//! the formulas of `absmin` and of the score, are this program's. `absscore` is 600 because the rendered plastic scene then behaves as
//! section 7.2 describes color figure 15; its adjusted Rand index is .81 (with 700 it is .88, and no matte area is broken at its shading).

use super::feature::FeatureSet;
use serde::{Deserialize, Serialize};

macro_rules! phoenix_parameters {
    ($($field:ident $variant:ident $default:literal, $low:literal to $high:literal $unit:literal: $meaning:literal;)*) => {
        /// The parameters of Phoenix.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct PhoenixSettings {
            /// The features whose histograms are searched.
            pub features: FeatureSet,
            $(#[doc = $meaning] pub $field: u32,)*
        }

        impl Default for PhoenixSettings {
            fn default() -> Self {
                Self { features: FeatureSet::default(), $($field: $default),* }
            }
        }

        /// The name of a parameter of Phoenix: a field of [`PhoenixSettings`] as a value.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum PhoenixParameter {
            $(#[doc = $meaning] $variant,)*
        }

        impl PhoenixParameter {
            /// All parameters, in the order in which they take effect.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$variant),*];

            /// The published name.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($field),)*
                }
            }

            /// Unit of the values.
            pub const fn unit(self) -> &'static str {
                match self {
                    $(Self::$variant => $unit,)*
                }
            }

            /// What the parameter does.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$variant => $meaning,)*
                }
            }

            /// Least and largest value.
            pub const fn range(self) -> [u32; 2] {
                match self {
                    $(Self::$variant => [$low, $high],)*
                }
            }

            /// The value in `settings`.
            pub const fn get(self, settings: &PhoenixSettings) -> u32 {
                match self {
                    $(Self::$variant => settings.$field,)*
                }
            }

            /// The value in `settings`, to be changed.
            pub fn slot(self, settings: &mut PhoenixSettings) -> &mut u32 {
                match self {
                    $(Self::$variant => &mut settings.$field,)*
                }
            }
        }
    };
}

phoenix_parameters! {
    depth Depth 10, 1 to 100 "levels": "Largest number of splits between the picture and a region.";
    splitmin Splitmin 40, 1 to 100_000_000 "px": "Smallest region that is split.";
    hsmooth Hsmooth 9, 1 to 99 "codes": "Width of the moving average that smooths a histogram.";
    maxmin Maxmin 160, 100 to 10000 "%": "Least height of a peak, in percent of the higher of the two valleys beside it.";
    absarea Absarea 10, 0 to 100_000_000 "px": "Least number of pixels of an interval of a histogram.";
    relarea Relarea 2, 0 to 50 "%": "Least number of pixels of an interval, in percent of the region.";
    height Height 20, 0 to 100 "%": "Least height of a peak, in percent of the second highest peak.";
    absmin Absmin 30, 0 to 100 "%": "Largest height of a valley above the lowest valley, in percent of the height of the second highest peak above it.";
    intsmax Intsmax 2, 2 to 64 "intervals": "Largest number of intervals of a feature: the most prominent valleys remain.";
    absscore Absscore 600, 0 to 1000 "of 1000": "Least score of a feature: 1000 \u{d7} (1 \u{2212} valley / lower peak beside it), of its least prominent valley.";
    relscore Relscore 80, 0 to 100 "%": "Least score of a feature, in percent of the best score.";
    isetsmax Isetsmax 3, 1 to 9 "features": "Largest number of features that are tried on the picture, the best scores first.";
    noise Noise 10, 0 to 100_000_000 "px": "Smallest patch: smaller patches are absorbed by the patches around them.";
    retain Retain 20, 0 to 100 "%": "Least share of the region that lies in patches of at least `noise` pixels.";
}

impl PhoenixParameter {
    /// The parameter of a name; none for any other text.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }
}

impl PhoenixSettings {
    /// The first parameter whose value lies outside its range, with the value.
    pub fn first_outside(&self) -> Option<(PhoenixParameter, u32)> {
        PhoenixParameter::ALL.into_iter().find_map(|parameter| {
            let (value, [low, high]) = (parameter.get(self), parameter.range());
            (!(low..=high).contains(&value)).then_some((parameter, value))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_lie_in_their_ranges_and_a_name_leads_to_its_own_field() {
        let mut settings = PhoenixSettings::default();
        assert_eq!(settings.first_outside(), None);
        for parameter in PhoenixParameter::ALL {
            assert_eq!(PhoenixParameter::from_name(parameter.name()), Some(parameter));
            assert!(parameter.meaning().ends_with('.') && parameter.meaning().len() > 20);
            *parameter.slot(&mut settings) = parameter.range()[1];
            assert_eq!(parameter.get(&settings), parameter.range()[1]);
        }
        assert_eq!(PhoenixParameter::from_name("hue"), None);
        settings.hsmooth = 0;
        assert_eq!(settings.first_outside(), Some((PhoenixParameter::Hsmooth, 0)));
    }
}
