//! Parts of the documents that follow from the program are what the program says.
//!
//! Such a part stands between `<!-- generated: NAME -->` and `<!-- end -->`. `UPDATE_DOCS=1 cargo test --test cli` writes all of them
//! anew.

use crate::folder::WorkFolder;
use dichroscope::params::{parameter_table, phoenix_table, reading_table, switch_table};
use std::fs;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Compares the generated part `name` of a file in `docs/` with `text` as a block of code, or writes it there with
/// `UPDATE_DOCS=1`.
#[track_caller]
pub fn check(document: &str, name: &str, text: &str) {
    check_markdown(document, name, &code(text));
}

/// The same with a text that is Markdown itself.
#[track_caller]
fn check_markdown(document: &str, name: &str, text: &str) {
    /// Tests run at once, and several parts stand in one file.
    static FILES: Mutex<()> = Mutex::new(());
    let _one_at_a_time = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(document);
    let old = fs::read_to_string(&path).unwrap();
    let new = replaced(&old, name, text);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, new).unwrap();
    } else {
        assert!(
            old == new,
            "docs/{document}, {name}: not what the program says; UPDATE_DOCS=1 writes it anew"
        );
    }
}

/// A text as a block of code.
fn code(text: &str) -> String {
    let lines: Vec<&str> = text.trim_end().lines().map(str::trim_end).collect();
    format!("```text\n{}\n```\n", lines.join("\n"))
}

/// `document` with `text` in its generated part `name`.
#[track_caller]
fn replaced(document: &str, name: &str, text: &str) -> String {
    let begin = format!("<!-- generated: {name} -->\n");
    let (before, rest) = document.split_once(&begin).unwrap_or_else(|| panic!("no {begin}"));
    let (_, after) = rest.split_once("<!-- end -->").expect("a generated part has an end");
    format!("{before}{begin}{text}<!-- end -->{after}")
}

#[test]
fn the_help_of_every_command_is_in_the_documents() {
    let work = WorkFolder::new();
    for command in ["analyze", "compare", "evaluate", "figures", "screenshot", "trace", "why"] {
        check("command-line.md", command, &work.succeeds(&format!("{command} -h")).out);
    }
}

#[test]
fn the_tables_of_parameters_switches_and_readings_are_in_the_documents() {
    check_markdown("parameters.md", "parameters", &parameter_table());
    check_markdown("parameters.md", "switches", &switch_table());
    check_markdown("readings.md", "readings", &reading_table());
    check_markdown("baselines.md", "phoenix", &phoenix_table());
}

#[test]
fn links_between_documents_lead_to_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut dead = Vec::new();
    let mut links = 0;
    for folder in [root.to_path_buf(), root.join("docs")] {
        let files = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
        for file in files.filter(|file| file.extension().is_some_and(|extension| extension == "md")) {
            let text = fs::read_to_string(&file).unwrap();
            let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
            for target in targets.filter(|target| !target.is_empty() && !target.contains("://")) {
                links += 1;
                if !folder.join(target).exists() {
                    dead.push(format!("{}: {target}", file.display()));
                }
            }
        }
    }
    assert!(links > 20 && dead.is_empty(), "{links} links, of them dead: {dead:#?}");
}

#[test]
fn only_the_part_of_that_name_is_replaced() {
    let document = "a\n<!-- generated: x -->\nold\n<!-- end -->\nb\n<!-- generated: y -->\n<!-- end -->\n";
    let expected = "a\n<!-- generated: x -->\n```text\n  new\n```\n<!-- end -->\nb\n<!-- generated: y -->\n<!-- end -->\n";
    assert_eq!(replaced(document, "x", &code("  new \n")), expected);
}
