//! The tables of `docs/parameters.md` and `docs/readings.md`, made from the rows of parameters, switches and readings.

use super::phoenix::{PhoenixParameter, PhoenixSettings};
use super::reading::Reading;
use super::refine::Switch;
use super::setting::Setting;
use super::table::Parameter;
use std::fmt::Write;

/// All numeric parameters as a Markdown table, one line each, in the order of table 6.
pub fn parameter_table() -> String {
    let mut table = String::from(
        "| parameter | unit | range | paper | default | stale from | meaning | `auto` |\n|---|---|---|---:|---:|---|---|---|\n",
    );
    for parameter in Parameter::ALL {
        let spec = parameter.spec();
        let default = match spec.refined_default {
            Setting::Auto => "`auto`".to_owned(),
            Setting::Value(value) => value.to_string(),
        };
        let numbers = if spec.whole { ", whole" } else { "" };
        let [low, high] = spec.range;
        let line = format!(
            "| `{}` | {} | {low} to {high}{numbers} | {} | {default} | {} | {} ({}) | {} |",
            spec.name,
            spec.unit,
            spec.paper,
            spec.first_stage.name(),
            spec.meaning,
            spec.section,
            spec.auto
        );
        writeln!(table, "{line}").expect("invariant: writing to a String cannot fail");
    }
    table
}

/// All refinement switches as a Markdown table, one line each, in the order in which they take effect.
pub fn switch_table() -> String {
    let mut table =
        String::from("| switch | stale from | what it does | measured effect |\n|---|---|---|---|\n");
    for switch in Switch::ALL {
        let (name, stage) = (switch.name(), switch.first_stage().name());
        let line = format!("| `{name}` | {stage} | {} | {} |", switch.meaning(), switch.worth());
        writeln!(table, "{line}").expect("invariant: writing to a String cannot fail");
    }
    table
}

/// All readings as a Markdown table, one line each, in the order of the stages.
pub fn reading_table() -> String {
    let mut table = String::from(
        "| reading | section and sentence | on | off | default | measured |\n|---|---|---|---|---|---|\n",
    );
    for reading in Reading::ALL {
        let spec = reading.spec();
        let default = if spec.paper { "on" } else { "off" };
        let (name, title, section, text) = (spec.name, spec.title, spec.section, spec.text);
        let line = format!(
            "| `{name}`: {title} | {section}: \u{201c}{text}\u{201d} | {} | {} | {default} | {} |",
            spec.on, spec.off, spec.measured
        );
        writeln!(table, "{line}").expect("invariant: writing to a String cannot fail");
    }
    table
}

/// All parameters of Phoenix as a Markdown table, one line each, in the order in which they take effect.
pub fn phoenix_table() -> String {
    let mut table =
        String::from("| parameter | unit | range | default | meaning |\n|---|---|---|---:|---|\n");
    let defaults = PhoenixSettings::default();
    for parameter in PhoenixParameter::ALL {
        let [low, high] = parameter.range();
        let (name, unit, default) = (parameter.name(), parameter.unit(), parameter.get(&defaults));
        let line = format!("| `{name}` | {unit} | {low} to {high} | {default} | {} |", parameter.meaning());
        writeln!(table, "{line}").expect("invariant: writing to a String cannot fail");
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A `|` in a row's text would add a column.
    #[test]
    fn every_line_has_as_many_cells_as_the_head() {
        for table in [parameter_table(), switch_table(), reading_table(), phoenix_table()] {
            let cells = |line: &str| line.matches('|').count();
            let head = table.lines().next().map(cells).unwrap();
            for line in table.lines() {
                assert_eq!(cells(line), head, "{line}");
            }
        }
        assert_eq!(parameter_table().lines().count(), 2 + Parameter::ALL.len());
        assert_eq!(switch_table().lines().count(), 2 + Switch::ALL.len());
    }
}
