//! The interface that scripts depend on: the flags of `analyze`, and the keys of its report.

use assert_cmd::Command;
use std::fmt::Write as _;

#[test]
fn the_flags_of_analyze_are_a_contract() {
    let output = Command::cargo_bin("dichroscope").unwrap().args(["analyze", "-h"]).output().unwrap();
    insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap());
}

#[test]
fn the_names_in_the_report_are_a_contract() {
    let folder = tempfile::tempdir().unwrap();
    Command::cargo_bin("dichroscope")
        .unwrap()
        .args(["analyze", "assets/tiny/camera8.png", "--truth", "assets/tiny", "--out"])
        .arg(folder.path())
        .assert()
        .success();
    let text = std::fs::read_to_string(folder.path().join("camera8/report.json")).unwrap();
    let report = serde_json::from_str(&text).unwrap();
    let mut names = String::new();
    outline(&report, 0, &mut names);
    crate::documents::check("results.md", "names", &names);
    insta::assert_snapshot!(names);
}

/// Keys and types of a JSON value as indented text; of an array only the first entry.
fn outline(value: &serde_json::Value, depth: usize, text: &mut String) {
    use serde_json::Value;
    match value {
        Value::Object(entries) => {
            for (name, entry) in entries {
                let kind = match entry {
                    Value::Object(_) => "",
                    Value::Array(_) => " []",
                    Value::String(_) => " text",
                    Value::Number(_) => " number",
                    Value::Bool(_) => " yes or no",
                    Value::Null => " null",
                };
                writeln!(text, "{:1$}{name}{kind}", "", 2 * depth).unwrap();
                outline(entry, depth + 1, text);
            }
        }
        Value::Array(entries) => {
            if let Some(first) = entries.first() {
                outline(first, depth, text);
            }
        }
        _ => {}
    }
}
