//! What the paper's method is asked for beside its numbers: how the text is read, and which refinements are added to it.

use super::phoenix::PhoenixSettings;
use super::reading::{Reading, Readings};
use super::refine::{Refine, Switch};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The table `[paper]` of a parameter file: one key per reading, and the names of the added refinements under `with`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "PaperTable", into = "PaperTable")]
pub struct PaperMethod {
    /// How the text is read.
    pub readings: Readings,
    /// The refinements that are added to the paper's method; by default none.
    pub with: Refine,
}

impl Default for PaperMethod {
    fn default() -> Self {
        Self { readings: Readings::PAPER, with: Refine::all(false) }
    }
}

/// [`PaperMethod`] as a table of a file.
type PaperTable = BTreeMap<String, PaperValue>;

/// The value of a key of a [`PaperTable`].
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected true or false for a reading, or a list of names for `with`")]
enum PaperValue {
    /// Whether a reading is on.
    Switch(bool),
    /// The names of the added refinements.
    Names(Vec<String>),
}

/// The key of the added refinements.
const WITH: &str = "with";

impl From<PaperMethod> for PaperTable {
    fn from(paper: PaperMethod) -> Self {
        let added = Switch::ALL.into_iter().filter(|&switch| paper.with.get(switch));
        let names = added.map(|switch| switch.name().to_owned()).collect();
        let readings = Reading::ALL
            .map(|reading| (reading.name().to_owned(), PaperValue::Switch(paper.readings.get(reading))));
        readings.into_iter().chain([(WITH.to_owned(), PaperValue::Names(names))]).collect()
    }
}

impl TryFrom<PaperTable> for PaperMethod {
    type Error = String;

    fn try_from(table: PaperTable) -> Result<Self, String> {
        let mut paper = Self::default();
        for (key, value) in table {
            match (key.as_str(), value) {
                (WITH, PaperValue::Names(names)) => {
                    for name in names {
                        let switch = Switch::from_name(&name).map_err(|error| error.to_string())?;
                        paper.with.set(switch, true);
                    }
                }
                (WITH, PaperValue::Switch(_)) => return Err("with: expected a list of names".to_owned()),
                (name, PaperValue::Switch(on)) => {
                    let reading = Reading::from_name(name).map_err(|error| error.to_string())?;
                    paper.readings.set(reading, on);
                }
                (name, PaperValue::Names(_)) => return Err(format!("{name}: expected true or false")),
            }
        }
        Ok(paper)
    }
}

/// An earlier method that the paper is held against (sections 5.1, 6 and 7.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// Phoenix: regions are split by the histograms of color features (section 7.2).
    Phoenix(PhoenixSettings),
    /// Clusters of the histogram of the whole picture (section 5.1).
    TopDown,
    /// A skewed T fitted to pixels that a person has marked (section 6).
    ByHand,
}

impl Baseline {
    /// Whether the method finds regions alone, without lines, planes and a light.
    pub fn finds_regions_alone(self) -> bool {
        self != Self::ByHand
    }
}

/// The switches that a run obeys: those of its method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// The refinements in force.
    pub refine: Refine,
    /// The readings in force.
    pub readings: Readings,
    /// The earlier method that finds the regions; none: the paper's or the refined method.
    pub baseline: Option<Baseline>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_takes_readings_and_names_of_refinements_and_refuses_other_keys() {
        let paper: PaperMethod = toml::from_str("fill_holes = true\nwith = [\"edge_body\"]").unwrap();
        assert!(paper.readings.fill_holes && paper.with.edge_body && !paper.with.all_seeds);
        assert_eq!(paper.readings, Readings { fill_holes: true, ..Readings::PAPER });
        let text = toml::to_string(&paper).unwrap();
        assert_eq!(toml::from_str::<PaperMethod>(&text).unwrap(), paper);
        assert_eq!(toml::from_str::<PaperMethod>("").unwrap(), PaperMethod::default());
        for (text, expected) in [
            ("holes = true", "\"holes\" is the name of no reading"),
            ("with = [\"holes\"]", "\"holes\" is the name of no refinement"),
            ("with = true", "with: expected a list of names"),
            ("fill_holes = 1", "expected true or false for a reading"),
        ] {
            let error = toml::from_str::<PaperMethod>(text).unwrap_err();
            assert!(error.to_string().contains(expected), "{error}");
        }
    }
}
