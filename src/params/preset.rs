//! The columns of table 6: what the paper set its parameters to for each of its pictures.
//!
//! The print has "4%" for the cups under pink light: 4σ0. The clipping threshold is 240 of 255 everywhere; it stays
//! automatic here, so that it holds for files of every depth.

use super::method::Method;
use super::setting::Setting;
use super::values::Params;

/// A column of table 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Preset {
    /// Eight plastic objects under white light.
    Plastic,
    /// Three cups under yellow light.
    CupsYellow,
    /// Three cups under white light.
    CupsWhite,
    /// Three cups under pink light.
    CupsPink,
}

impl Preset {
    /// All of them, in the order of table 6.
    pub const ALL: [Self; 4] = [Self::Plastic, Self::CupsYellow, Self::CupsWhite, Self::CupsPink];

    /// Its one name, for flags and menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plastic => "plastic",
            Self::CupsYellow => "cups_yellow",
            Self::CupsWhite => "cups_white",
            Self::CupsPink => "cups_pink",
        }
    }

    /// The preset with this name; none where no preset has the name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// The paper's heading of the column.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Plastic => "plastic scene",
            Self::CupsYellow => "cups yellow light",
            Self::CupsWhite => "cups white light",
            Self::CupsPink => "cups pink light",
        }
    }

    /// The paper's method with the numbers of the column.
    pub fn params(self) -> Params {
        // Minimal intensity in counts, width of cylinders and slices in σ0, window and area in pixels.
        let (min_intensity, width, window_size, min_area) = match self {
            Self::Plastic => (23.0, 4.0, 10.0, 500.0),
            Self::CupsYellow => (30.0, 4.0, 10.0, 500.0),
            Self::CupsWhite => (30.0, 6.0, 10.0, 500.0),
            Self::CupsPink => (30.0, 4.0, 15.0, 700.0),
        };
        Params {
            min_intensity: Setting::Value(min_intensity),
            cylinder_width: Setting::Value(width),
            slice_width: Setting::Value(width),
            window_size: Setting::Value(window_size),
            min_area: Setting::Value(min_area),
            ..Params::of(Method::Paper)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_column_is_the_papers_default_and_all_are_valid_and_different() {
        assert_eq!(Preset::Plastic.params(), Params::paper());
        for preset in Preset::ALL {
            assert!(preset.params().validate().is_ok());
            assert_eq!(Preset::from_name(preset.name()), Some(preset));
            let same = Preset::ALL.iter().filter(|other| other.params() == preset.params());
            assert_eq!(same.count(), 1, "{}", preset.name());
        }
    }

    #[test]
    fn the_columns_differ_as_in_table_6() {
        let pink = Preset::CupsPink.params();
        assert_eq!((pink.window_size, pink.min_area), (Setting::Value(15.0), Setting::Value(700.0)));
        assert_eq!(Preset::CupsWhite.params().slice_width, Setting::Value(6.0));
        assert_eq!(Preset::CupsYellow.params().min_intensity, Setting::Value(30.0));
    }
}
