//! Circles between the files of a room: files that use one another, directly or through others.
//!
//! A file is named by its first module below the room (`src/view/layers/table.rs` is `layers` of `view`). A name that the room's
//! `mod.rs` re-exports, by itself or by a glob, counts as a use of the file that defines the name. Tests may use
//! whatever they like.

use crate::source::mentions;
use std::collections::{BTreeMap, BTreeSet};

/// Which file uses which other files of its room, by module names.
pub type Uses = BTreeMap<String, BTreeSet<String>>;

/// The uses between the files of `room`; `files` are the module path below the crate's root and the source of each file.
pub fn uses(room: &str, files: &[(Vec<String>, String)]) -> Uses {
    let own = |modules: &[String]| modules.first().is_some_and(|first| first == room);
    let names: BTreeSet<&str> = files
        .iter()
        .filter(|(modules, _)| own(modules))
        .filter_map(|(modules, _)| modules.get(1))
        .map(String::as_str)
        .collect();
    let paths_in = |modules: &[String], source: &str| -> Vec<Vec<String>> {
        let found = mentions(source, modules, false).unwrap_or_default();
        let outside_tests = found.into_iter().filter(|mention| !mention.in_test);
        outside_tests.map(|mention| mention.path).collect()
    };
    // Re-exported names and the file of each.
    let mut defined_in: BTreeMap<String, String> = BTreeMap::new();
    for (modules, source) in files.iter().filter(|(modules, _)| modules.len() == 1 && own(modules)) {
        // Paths that begin with a module that the source declares are no mentions: without declarations they are.
        let lines = source.lines().filter(|line| !line.trim_start_matches("pub ").starts_with("mod "));
        for path in paths_in(modules, &lines.collect::<Vec<_>>().join("\n")) {
            let [file, .., name] = path.as_slice() else { continue };
            if !names.contains(file.as_str()) {
                continue;
            }
            if name == "*" {
                let of_file =
                    files.iter().filter(|(modules, _)| own(modules) && modules.get(1) == Some(file));
                let all = of_file.flat_map(|(_, source)| public_names(source));
                defined_in.extend(all.map(|name| (name, file.clone())));
            } else {
                defined_in.insert(name.clone(), file.clone());
            }
        }
    }
    let mut uses = Uses::new();
    for (modules, source) in files.iter().filter(|(modules, _)| modules.len() > 1 && own(modules)) {
        let is_test = modules.last().is_some_and(|last| last.ends_with("tests") || last == "testing");
        let used = uses.entry(modules[1].clone()).or_default();
        for path in paths_in(modules, source).into_iter().filter(|_| !is_test) {
            let [root, found, name, ..] = path.as_slice() else { continue };
            if root != "crate" || found != room {
                continue;
            }
            let file = if names.contains(name.as_str()) { Some(name) } else { defined_in.get(name) };
            used.extend(file.filter(|file| **file != modules[1]).cloned());
        }
    }
    uses
}

/// The names of the public items of a source, those in macros too: a glob re-exports at most these names.
fn public_names(source: &str) -> impl Iterator<Item = String> + '_ {
    source.lines().filter_map(|line| {
        let mut words =
            line.trim_start().strip_prefix("pub ")?.split(|c: char| !c.is_alphanumeric() && c != '_');
        let keyword = words.find(|word| !["const", "unsafe", "async"].contains(word))?;
        let is_item = ["struct", "enum", "trait", "fn", "type", "static", "union"].contains(&keyword);
        // A constant: its name follows `const`.
        let name = if is_item { words.next()? } else { keyword };
        Some(name.to_owned())
    })
}

/// The sets of files that can reach one another, each sorted.
pub fn circles(uses: &Uses) -> BTreeSet<Vec<String>> {
    let reached = |from: &String| {
        let mut seen = BTreeSet::new();
        let mut waiting: Vec<&String> = uses.get(from).into_iter().flatten().collect();
        while let Some(file) = waiting.pop() {
            if seen.insert(file.clone()) {
                waiting.extend(uses.get(file).into_iter().flatten());
            }
        }
        seen
    };
    let reach: BTreeMap<&String, BTreeSet<String>> = uses.keys().map(|file| (file, reached(file))).collect();
    let circle_of = |file: &String| -> Vec<String> {
        reach[file]
            .iter()
            .filter(|other| reach.get(other).is_some_and(|back| back.contains(file)))
            .cloned()
            .collect()
    };
    uses.keys().map(circle_of).filter(|circle| circle.len() > 1).collect()
}
