//! Checks the architecture: which room (top-level module) may use which other rooms and which dependencies.
//!
//! The sources are read as Rust tokens, so that comments, strings and line breaks do not mislead the check. The check
//! sees every `use` and every path in code (`crate::photo::…`, `std::fs::…`, inside macro calls too). Links in
//! documentation are not restricted.
//!
//! To change the rules on purpose, change the tables below and ARCHITECTURE.md together.

mod additions;
mod circles;
mod source;

use source::{Mention, mentions};
use std::io;
use std::path::{Path, PathBuf};

/// The rooms in order: a room may use the rooms of earlier lines, but no other room of its own line.
const ORDER: &[&[&str]] = &[
    &["params", "raster", "color"],
    &["reflection"],
    &["photo"],
    &["trace"],
    &["segment"],
    &["intrinsic", "baseline"],
    &["analysis"],
    &["describe"],
    &["truth", "export"],
    &["view"],
    &["figures"],
    &["app"],
    &["gui"],
];

/// Rooms outside of the order, see [`may_use`].
const BESIDE: &[&str] = &["cli", "gpu"];

/// Dependencies that only some rooms may use: names of crates (and of `name_*`), rooms, whether the rule
/// holds for tests too.
const AT_HOME: &[(&[&str], &[&str], bool)] = &[
    (&["egui", "eframe", "epaint", "emath", "ecolor", "winit"], &["gui"], true),
    (&["wgpu", "naga"], &["gpu", "gui"], true),
    (
        &[
            "image", "exr", "png", "tiff", "jpeg", "zune", "webp", "gif", "hdr", "exif", "moxcms", "qcms",
            "lcms2", "hpvcd",
        ],
        &["photo", "truth", "export"],
        false,
    ),
];

/// Rooms whose results depend on their arguments alone. Their tests are not restricted.
const PURE: &[&str] = &[
    "params",
    "raster",
    "color",
    "reflection",
    "trace",
    "segment",
    "intrinsic",
    "baseline",
    "analysis",
    "describe",
    "figures",
];

/// Paths that a pure room must not name.
const IMPURE: &[&[&str]] = &[
    &["std", "fs"],
    &["std", "env"],
    &["std", "net"],
    &["std", "process"],
    &["std", "time", "Instant"],
    &["std", "time", "SystemTime"],
    &["println!"],
    &["print!"],
    &["eprintln!"],
    &["eprint!"],
    &["dbg!"],
];

const LONGEST_FILE_LINES: usize = 800;

#[test]
fn the_walls_stand() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    collect_rust_files(&root.join("src"), &mut files)?;
    files.sort();
    assert!(!files.is_empty(), "no sources under {}", root.display());
    let mut complaints = Vec::new();
    for file in files {
        let path = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        complaints.extend(check(&path, &std::fs::read_to_string(&file)?));
    }
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
    Ok(())
}

#[test]
fn files_of_a_room_use_one_another_in_one_direction() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = Vec::new();
    collect_rust_files(&root.join("src"), &mut paths)?;
    let mut files = Vec::new();
    for path in paths {
        let relative = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        files.push((module_path(&relative), std::fs::read_to_string(&path)?));
    }
    let rooms: Vec<&str> =
        ORDER.iter().flat_map(|line| line.iter().copied()).chain(BESIDE.iter().copied()).collect();
    let found: Vec<(&str, Vec<String>)> = rooms
        .into_iter()
        .flat_map(|room| {
            circles::circles(&circles::uses(room, &files)).into_iter().map(move |circle| (room, circle))
        })
        .collect();
    assert!(found.is_empty(), "files of a room that use one another in a circle: {found:#?}");
    Ok(())
}

fn collect_rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect_rust_files(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// All violations in the file at `path` (relative to the crate, with slashes), one line each.
fn check(path: &str, source: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    let modules = module_path(path);
    let room = match path {
        "src/lib.rs" | "src/main.rs" => None,
        _ => Some(modules[0].as_str()),
    };
    if room.is_some_and(|room| !is_room(room)) {
        complaints.push(format!("{path}:1: belongs to no room"));
    }
    let lines = source.lines().count();
    if lines > LONGEST_FILE_LINES {
        complaints.push(format!("{path}:{lines}: longer than {LONGEST_FILE_LINES} lines"));
    }
    if path.ends_with("/mod.rs") && modules.len() == 1 && !source.starts_with("//!") {
        complaints.push(format!("{path}:1: a room introduces itself with `//!`"));
    }
    match mentions(source, &modules, path.ends_with("/tests.rs")) {
        Ok(mentions) => complaints.extend(mentions.iter().filter_map(|mention| {
            let complaint = judge(room, mention)?;
            Some(format!("{path}:{}: {complaint} (`{}`)", mention.line, mention.path.join("::")))
        })),
        Err(error) => complaints.push(format!("{path}:1: not Rust: {error}")),
    }
    complaints
}

/// `src/photo/linear.rs` → photo, linear; `src/photo/mod.rs` → photo; `src/lib.rs` → nothing.
fn module_path(path: &str) -> Vec<String> {
    let inner = path.trim_start_matches("src/").trim_end_matches(".rs");
    let names = inner.split('/').filter(|name| !["mod", "lib", "main"].contains(name));
    names.map(str::to_owned).collect()
}

fn rank(room: &str) -> Option<usize> {
    ORDER.iter().position(|line| line.contains(&room))
}

fn is_room(name: &str) -> bool {
    rank(name).is_some() || BESIDE.contains(&name)
}

fn may_use(user: &str, used: &str) -> bool {
    match (user, used) {
        _ if user == used => true,
        ("gpu", _) | (_, "cli") => false,
        ("cli", _) => !["gui", "view", "app", "gpu"].contains(&used),
        (_, "gpu") => user == "gui",
        _ => rank(used) < rank(user),
    }
}

/// The violation of a path named in a room, if any. `lib.rs` and `main.rs` are in no room.
fn judge(room: Option<&str>, mention: &Mention) -> Option<String> {
    let path: Vec<&str> = mention.path.iter().map(String::as_str).collect();
    if let (Some(room), ["crate", inside @ ..]) = (room, path.as_slice()) {
        let Some(used) = inside.first().filter(|name| is_room(name)) else {
            return Some(format!("{room} → the crate's root: name the room that it comes from"));
        };
        return (!may_use(room, used)).then(|| format!("{room} → {used}: the arrow runs backwards"));
    }
    for (crates, rooms, tests_too) in AT_HOME {
        let named = crates.iter().any(|name| is_crate(path[0], name));
        let bound = *tests_too || !mention.in_test;
        if named && bound && !room.is_some_and(|room| rooms.contains(&room)) {
            return Some(format!("{} → {}: only for {}", room.unwrap_or("root"), path[0], rooms.join(", ")));
        }
    }
    let pure = room.filter(|room| PURE.contains(room) && !mention.in_test)?;
    let impure = IMPURE.iter().any(|forbidden| reaches(&path, forbidden));
    impure.then(|| format!("{pure} → {}: a pure room", path.join("::")))
}

/// Whether a crate belongs to a family: `egui` and `egui_extras` belong to the family `egui`.
fn is_crate(name: &str, family: &str) -> bool {
    name.strip_prefix(family).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}

/// Whether `path` is `forbidden`, lies within it, or is a parent of it: `use std::time` gives access to
/// `std::time::Instant`.
fn reaches(path: &[&str], forbidden: &[&str]) -> bool {
    let path = path.strip_suffix(&["*"]).unwrap_or(path);
    path.starts_with(forbidden) || forbidden.starts_with(path)
}

mod the_checker_can_fail {
    use super::*;

    /// Checks `source` as the file at `path`, and compares the beginnings of the violations with `expected`.
    #[track_caller]
    fn assert_complaints(path: &str, source: &str, expected: &[&str]) {
        let found = check(path, source);
        let agree =
            found.len() == expected.len() && found.iter().zip(expected).all(|(f, e)| f.starts_with(e));
        assert!(agree, "{source}\nexpected {expected:#?}\nfound {found:#?}");
    }

    #[test]
    fn arrows() {
        let forwards = "use crate::raster::Raster;\nfn f() -> crate::photo::LinearImage {}";
        assert_complaints("src/segment/linear.rs", forwards, &[]);
        let backwards =
            "use crate::raster::{Mask, Raster};\nuse crate::{\n  color::Line,\n  gui::{self, Panel},\n};";
        assert_complaints(
            "src/segment/linear.rs",
            backwards,
            &["src/segment/linear.rs:4: segment → gui: the arrow", "src/segment/linear.rs:4: segment → gui"],
        );
        let in_place = "fn f() {\n vec![<u8 as Into>::into(1), crate::analysis::run()];\n}";
        assert_complaints(
            "src/trace/event.rs",
            in_place,
            &["src/trace/event.rs:2: trace → analysis: the arrow runs backwards (`crate::analysis::run`)"],
        );
    }

    #[test]
    fn the_table() {
        for (user, used) in [("gui", "gpu"), ("gui", "app"), ("cli", "export"), ("export", "describe")] {
            assert!(may_use(user, used), "{user} → {used}");
        }
        let forbidden = [
            ("raster", "color"),
            ("truth", "export"),
            ("cli", "gui"),
            ("cli", "app"),
            ("cli", "view"),
            ("view", "app"),
            ("cli", "gpu"),
            ("app", "gpu"),
            ("app", "cli"),
            ("gpu", "raster"),
            ("photo", "segment"),
        ];
        for (user, used) in forbidden {
            assert!(!may_use(user, used), "{user} → {used}");
        }
    }

    #[test]
    fn paths_relative_to_the_module() {
        assert_complaints(
            "src/raster/grid.rs",
            "use super::mask::Mask; mod tests { use super::super::x; }",
            &[],
        );
        assert_complaints(
            "src/raster/mod.rs",
            "use super::photo::A;",
            &["src/raster/mod.rs:1: a room", "src/raster/mod.rs:1: raster → photo"],
        );
        assert_complaints(
            "src/raster/grid.rs",
            "use super::super::photo::A;",
            &["src/raster/grid.rs:1: raster → photo"],
        );
        assert_complaints(
            "src/raster/grid.rs",
            "mod t { use super::super::super::gui::A; }",
            &["src/raster/grid.rs:1: raster → gui"],
        );
    }

    #[test]
    fn no_way_around_through_the_root() {
        assert_complaints(
            "src/color/line.rs",
            "use crate::Session;",
            &["src/color/line.rs:1: color → the crate's root"],
        );
        assert_complaints(
            "src/color/line.rs",
            "use crate::*;",
            &["src/color/line.rs:1: color → the crate's root"],
        );
        assert_complaints("src/main.rs", "use dichroscope::gui::App; fn main() { println!() }", &[]);
    }

    #[test]
    fn crates_in_foreign_rooms() {
        assert_complaints("src/gui/cube.rs", "use {egui_extras::Table, wgpu::Device};", &[]);
        assert_complaints("src/app/mod.rs", "//! W\nuse egui::Ui;", &["src/app/mod.rs:2: app → egui"]);
        assert_complaints(
            "src/cli/mod.rs",
            "//! C\nfn f() { ::wgpu::x(); }",
            &["src/cli/mod.rs:2: cli → wgpu"],
        );
        assert_complaints("src/main.rs", "use eframe as e;", &["src/main.rs:1: root → eframe"]);
        assert_complaints("src/export/mod.rs", "//! E\nmod png;\nuse exr::prelude::*;", &[]);
        assert_complaints(
            "src/segment/holes.rs",
            "use image::open;",
            &["src/segment/holes.rs:1: segment → image"],
        );
        assert_complaints("src/gui/mod.rs", "//! G\nfn f() { image::show(); }\nmod image;", &[]);
    }

    #[test]
    fn impure_rooms() {
        let doors = [
            "use std::fs;",
            "use std::{io, fs::File};",
            "use std::fs::{self};",
            "use std::time;",
            "use std::time::{Duration, Instant as Clock};",
            "use std::*;",
            "fn f() { ::std::time::SystemTime::now(); }",
            "macro_rules! m { () => { println!() } }",
        ];
        for source in doors {
            assert_complaints("src/color/line.rs", source, &["src/color/line.rs:1: color → "]);
            assert_complaints("src/cli/line.rs", source, &[]);
        }
        let innocent = "use std::time::Duration; // std::fs\n/// [crate::gui::A] println!()\nconst A: &str = \"std::fs::read\";";
        assert_complaints("src/color/line.rs", innocent, &[]);
    }

    #[test]
    fn tests_may_be_impure_but_not_look_forwards() {
        let source = "#[cfg(test)]\nmod tests {\n use std::fs; use crate::gui::A; use image::open;\n}\n";
        assert_complaints("src/color/line.rs", source, &["src/color/line.rs:3: color → gui"]);
        let only_the_next_item =
            "#[cfg(test)] use std::fs;\nuse std::fs;\n#[cfg(all(test, unix))] fn f() {}\nuse std::env;";
        assert_complaints(
            "src/color/line.rs",
            only_the_next_item,
            &["src/color/line.rs:2: color → std::fs", "src/color/line.rs:4: color → std::env"],
        );
        assert_complaints("src/color/tests.rs", "use std::fs;", &[]);
        assert_complaints("src/color/line.rs", "#[cfg(not(test))] use std::fs;", &["src/color/line.rs:1: "]);
    }

    #[test]
    fn circles_between_files() {
        let file = |path: &str, source: &str| (module_path(path), source.to_owned());
        let room = file("src/view/mod.rs", "mod a;\nmod b;\nmod c;\npub use b::{Name, Second};");
        let a = file("src/view/a.rs", "use super::Name;");
        let c = file("src/view/c.rs", "use crate::view::a::Other;");
        let circles = |b: &str| {
            let files = [room.clone(), a.clone(), file("src/view/b/inner.rs", b), c.clone()];
            circles::circles(&circles::uses("view", &files)).into_iter().collect::<Vec<_>>()
        };
        assert!(circles("use crate::trace::Replay;").is_empty());
        assert_eq!(circles("use super::super::c::Third;"), [["a", "b", "c"]]);
        assert_eq!(circles("fn f() { crate::view::a::g(); }"), [["a", "b"]]);
        assert!(circles("#[cfg(test)] mod tests { use crate::view::a::g; }").is_empty());
        let glob = [
            file("src/view/mod.rs", "mod a;\nmod b;\npub use b::*;"),
            a.clone(),
            file("src/view/b/inner.rs", "    pub struct Name;\nfn f() { crate::view::a::g(); }"),
        ];
        assert_eq!(
            circles::circles(&circles::uses("view", &glob)).into_iter().collect::<Vec<_>>(),
            [["a", "b"]]
        );
    }

    #[test]
    fn shape_of_files() {
        assert_complaints("src/photo/mod.rs", "pub mod a;", &["src/photo/mod.rs:1: a room introduces"]);
        assert_complaints("src/photo/long.rs", &"//\n".repeat(801), &["src/photo/long.rs:801: longer"]);
        assert_complaints("src/helpers.rs", "", &["src/helpers.rs:1: belongs to no room"]);
        assert_complaints("src/attic/mod.rs", "//! Old things.", &["src/attic/mod.rs:1: belongs to no room"]);
        assert_complaints("src/photo/a.rs", "fn f( {", &["src/photo/a.rs:1: not Rust"]);
    }
}
