//! Tests of `dichroscope trace` and `dichroscope why`, run as programs.

#[path = "../synthetic/marbled.rs"]
mod marbled;

use assert_cmd::cargo::cargo_bin_cmd;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};

/// Number of columns of the tiny scene.
const WIDTH: u64 = 178;

struct Ended {
    code: i32,
    out: String,
    err: String,
}

fn run(arguments: &str) -> Ended {
    let arguments = arguments.replace("TINY", "assets/tiny/camera8.png --encoding linear");
    let output = cargo_bin_cmd!("dichroscope").args(arguments.split_whitespace()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Ended { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

#[track_caller]
fn succeeds(arguments: &str) -> String {
    let ended = run(arguments);
    assert_eq!(ended.code, 0, "{arguments}: {}", ended.err);
    ended.out
}

#[track_caller]
fn fails(code: i32, arguments: &str, says: &str) {
    let ended = run(arguments);
    assert_eq!(ended.code, code, "{arguments}: {}", ended.err);
    assert!(ended.err.contains(says), "{arguments}: expected {says:?} in {:?}", ended.err);
}

/// The schema line of a trace, and the lines of the steps.
#[track_caller]
fn lines(text: &str) -> (Value, Vec<Value>) {
    let mut lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    (lines.next().unwrap(), lines.collect())
}

fn pixel_of(line: &Value) -> Option<[u64; 2]> {
    let pixel = line["ids"]["pixel"].as_array()?;
    Some([pixel[0].as_u64()?, pixel[1].as_u64()?])
}

/// Column and row of a pixel of the tiny scene with this kind.
fn pixel_with(steps: &[Value], role: &str) -> [u64; 2] {
    let labeled = |line: &&Value| line["kind"] == "label" && line["values"]["role"] == role;
    pixel_of(steps.iter().filter(labeled).nth(200).unwrap()).unwrap()
}

#[test]
fn a_trace_is_every_step_in_order_after_a_schema_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.jsonl");
    assert_eq!(succeeds(&format!("trace TINY --out {}", file.display())), "");
    let text = fs::read_to_string(&file).unwrap();
    let (schema, steps) = lines(&text);
    assert_eq!(schema["schema"], 1);
    assert_eq!(schema["width"], WIDTH);
    assert_eq!(schema["steps"], steps.len());
    assert!(steps.iter().enumerate().all(|(n, line)| line["seq"] == n));
    for (stage, range) in schema["stages"].as_object().unwrap() {
        let first = usize::try_from(range[0].as_u64().unwrap()).unwrap();
        assert_eq!(
            (&steps[first]["stage"], &steps[first]["kind"]),
            (&Value::from(&**stage), &"stage".into())
        );
    }
    assert_eq!(succeeds("trace TINY --out -"), text, "the same on standard output");
    assert_eq!(succeeds("trace TINY --out - --threads 1"), text, "and at any number of threads");
}

#[test]
fn a_trace_can_be_narrowed_to_a_stage_a_region_and_a_pixel() {
    let (schema, all) = lines(&succeeds("trace TINY --out -"));
    let (_, split) = lines(&succeeds("trace TINY --out - --stage split"));
    assert_eq!(split, all.iter().filter(|line| line["stage"] == "split").cloned().collect::<Vec<_>>());

    let [x, y] = pixel_with(&all, "matte");
    let (_, about) = lines(&succeeds(&format!("trace TINY --out - --pixel {x},{y}")));
    let told: Vec<&Value> = about.iter().filter(|line| pixel_of(line).is_some()).collect();
    // A refusal happens when a neighbor is claimed.
    let beside = |[u, v]: [u64; 2]| u.abs_diff(x) + v.abs_diff(y) <= 1;
    assert!(told.iter().all(|line| line["kind"] == "hole filled" || pixel_of(line).is_some_and(beside)));
    let own = |line: &&Value| pixel_of(line) == Some([x, y]);
    assert_eq!(about.iter().filter(own).count(), all.iter().filter(own).count());
    assert!(about.iter().any(|line| line["kind"] == "window"), "its window's class");
    assert!(about.len() < all.len() / 100);

    let births = schema["regions"].as_array().unwrap();
    let birth = births.iter().position(|number| *number == 1).unwrap() + 1;
    let (_, region) = lines(&succeeds("trace TINY --out - --region 1"));
    let kinds: BTreeSet<&str> = region.iter().map(|line| line["kind"].as_str().unwrap()).collect();
    assert!(kinds.is_superset(&["hypothesis", "slice", "claim", "vectors"].into()), "{kinds:?}");
    assert!(region.iter().any(|line| line["kind"] == "hypothesis" && line["ids"]["region"] == birth));
    let (_, both) = lines(&succeeds("trace TINY --out - --region 1 --stage linear"));
    assert!(both.iter().all(|line| line["stage"] == "linear") && both.len() < region.len());
}

#[test]
fn why_tells_newest_first_with_value_and_threshold() {
    let (_, all) = lines(&succeeds("trace TINY --out -"));
    for role in ["matte", "highlight"] {
        let [x, y] = pixel_with(&all, role);
        let text = succeeds(&format!("why TINY {x},{y}"));
        assert!(text.starts_with(&format!("pixel ({x}, {y}), color (")), "{text}");
        assert!(text.lines().next().unwrap().contains(&format!("{role}, in region ")), "{text}");
        let history = text.split("\n\n").nth(1).unwrap();
        let steps: Vec<u64> =
            history.lines().map(|line| line.split_whitespace().next().unwrap().parse().unwrap()).collect();
        assert!(steps.is_sorted_by(|a, b| a >= b) && steps.len() > 4, "{text}");
        for part in ["counts from the matte line", "believed:", "\u{3c7}\u{b2}"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
    let dark = succeeds("why TINY 0,0 --min-intensity 441");
    assert!(dark.contains("in no region") && dark.contains("counts from black, below 441.0"), "{dark}");
}

#[test]
fn of_an_averaged_picture_why_begins_with_the_pass_at_full_resolution_and_trace_says_the_scale() {
    let (schema, all) = lines(&succeeds("trace TINY --out - --scale 2"));
    assert_eq!((schema["width"].as_u64(), schema["scale"].as_u64()), (Some(WIDTH), Some(2)));
    let [x, y] = pixel_with(&all, "matte");
    let text = succeeds(&format!("why TINY {x},{y} --scale 2"));
    assert!(text.starts_with(&format!("pixel ({x}, {y}), color (")), "{text}");
    let history = text.split("\n\n").nth(1).unwrap();
    let first = history.lines().next().unwrap();
    assert!(first.contains("split     at full resolution the pixel takes region"), "{text}");
    assert!(first.ends_with("the mean of 2 \u{d7} 2 pixels"), "{text}");
    let (_, own) = lines(&succeeds(&format!("trace TINY --out - --scale 2 --pixel {x},{y}")));
    assert!(!own.is_empty() && own.iter().filter_map(pixel_of).all(|pixel| pixel == [x, y]));
    let (plain, _) = lines(&succeeds("trace TINY --out -"));
    assert!(plain["scale"].is_null());
    fails(2, "why TINY 1,1 --scale 1.5", "whole number");
}

/// Column and row on the marbled sheet of a highlight with a clipped core (`CLIPPED`), of one without (`HIGHLIGHT`),
/// and of a
/// printed speck (`SPECK`).
const CLIPPED: [usize; 2] = [60, 18];
const HIGHLIGHT: [usize; 2] = [20, 20];
const SPECK: [usize; 2] = [33, 137];

/// Output of `why` for a pixel of the marbled sheet; `body_share` scales the sheet's body reflection.
fn why_marbled(pixel: [usize; 2], body_share: f64) -> String {
    why_marbled_with(pixel, body_share, "")
}

fn why_marbled_with([x, y]: [usize; 2], body_share: f64, flags: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = marbled_sheet(&folder, body_share);
    succeeds(&format!("why {file} {x},{y} --encoding linear{flags}"))
}

fn marbled_sheet(folder: &tempfile::TempDir, body_share: f64) -> String {
    let file = folder.path().join("marbled.ppm");
    let [width, height] = marbled::SIZE_PX;
    let mut bytes = format!("P6\n{width} {height}\n255\n").into_bytes();
    bytes.extend(marbled::marbled(body_share).as_flattened());
    fs::write(&file, bytes).unwrap();
    file.display().to_string()
}

#[track_caller]
fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part:?} in {text}");
    }
}

#[test]
fn why_tells_of_a_highlight_where_no_region_holds() {
    let text = why_marbled(HIGHLIGHT, 1.0);
    says(&text, &["does not hold: ", "rms from its plane (at most ", "its surroundings give it "]);
    says(&text, &["log odds of ", "highlights are believed: "]);
    says(
        &text,
        &[
            "around it its hue has \u{3ba} = a/c ",
            "log odds of a highlight ",
            "independence of the body ",
            "weight ",
            "paler than their hue most is ",
        ],
    );
    let amount = |before: &str| -> f64 {
        let after = text.split(before).nth(1).unwrap_or_else(|| panic!("{before:?} in {text}"));
        after.split(' ').next().unwrap().parse().unwrap()
    };
    let [given, found] = ["its surroundings give it ", "surface is "].map(amount);
    assert!((given - found).abs() < 0.01 && given > 20.0, "{text}");
}

#[test]
fn why_tells_of_print_and_of_a_clipped_core_where_no_region_holds() {
    let speck = why_marbled(SPECK, 1.0);
    says(
        &speck,
        &["but it looks like white print: log odds of a highlight ", "(nothing counts up to \u{2212}1.5"],
    );
    let restored = why_marbled(CLIPPED, 1.0);
    says(
        &restored,
        &[
            "restored, in region",
            "its red alone is clipped, and is ",
            " counts by the other two bands and the hue around; a ",
        ],
    );
    let saturated_core = why_marbled_with(CLIPPED, 1.0, " --without hue_restoration");
    says(
        &saturated_core,
        &["restored, in region", "it is filled with the body around it", "but it is clipped"],
    );
    says(&saturated_core, &["of its ring of 2 px are highlight (at least 40 %)"]);
}

#[test]
fn why_tells_why_nothing_was_split_locally() {
    let text = why_marbled_with(HIGHLIGHT, 1.0, " --without local_split");
    says(&text, &["they keep their colors, as the local split is off", "it keeps its color as body"]);
}

#[test]
fn what_if_tells_a_value_at_which_the_pixel_is_something_else() {
    let (_, all) = lines(&succeeds("trace TINY --out -"));
    let [x, y] = pixel_with(&all, "matte");
    let text = succeeds(&format!("why TINY {x},{y} --what-if"));
    let (history, changes) = text.split_once("\nwhat if\n").unwrap();
    assert_eq!(history, succeeds(&format!("why TINY {x},{y}")).trim_end_matches('\n').to_owned() + "\n");
    let dark = changes.lines().find(|line| line.contains("min intensity \u{2265}")).unwrap();
    assert!(
        dark.contains("is in no region at min intensity \u{2265} ") && dark.ends_with("counts (now 23)"),
        "{dark}"
    );
    // An analysis with the value that was found has the result that was predicted.
    let value = dark.split(['\u{2265}', 'c']).nth(1).unwrap().trim();
    let moved = succeeds(&format!("why TINY {x},{y} --min-intensity {value}"));
    assert!(moved.lines().next().unwrap().contains("in no region, not explained: "), "{moved}");
}

#[test]
fn wrong_calls_are_refused_in_a_sentence() {
    let outside = "there is no pixel (178, 0): the picture has 178 \u{d7} 150 pixels";
    fails(2, "why TINY 178,0", outside);
    fails(2, "trace TINY --out - --pixel 178,0", outside);
    fails(2, "why TINY 12;7", "expected column and row, counted from 0");
    fails(2, "trace TINY", "--out <FILE.jsonl>");
    fails(2, "trace TINY --out - --stage tail", "classify");
    fails(2, "trace TINY --out - --region 99", "regions, numbered from 1");
    fails(2, "why TINY 1,1 --window-size 2.5", "window_size = 2.5");
    fails(1, "why none.png 1,1", "none.png");
    fails(1, "trace TINY --out /nowhere/at/all.jsonl", "/nowhere/at/all.jsonl");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let program = assert_cmd::cargo::cargo_bin!("dichroscope");
    let mut child = Command::new(program)
        .args(["trace", "assets/tiny/camera8.png", "--out", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0; 64];
    child.stdout.take().unwrap().read_exact(&mut first).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()));
}

/// Keys and value types of all kinds of lines, which scripts depend on.
#[test]
fn the_names_in_trace_lines_are_a_contract() {
    let mut kinds: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let folder = tempfile::tempdir().unwrap();
    let marbled = format!("{} --encoding linear", marbled_sheet(&folder, 1.0));
    for arguments in ["TINY", "TINY --illuminant 1,1,1", "TINY --method paper", &marbled] {
        let (schema, steps) = lines(&succeeds(&format!("trace {arguments} --out -")));
        let names: Vec<&str> = schema.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(names, ["schema", "program", "fields", "width", "height", "steps", "stages", "regions"]);
        for line in &steps {
            let names: Vec<&str> = line.as_object().unwrap().keys().map(String::as_str).collect();
            assert_eq!(names, ["seq", "stage", "kind", "ids", "values", "thresholds"]);
            let kind = kinds.entry(line["kind"].as_str().unwrap().to_owned()).or_default();
            for part in ["ids", "values", "thresholds"] {
                kind.extend(line[part].as_object().unwrap().keys().map(|name| format!("{part}.{name}")));
            }
        }
    }
    let mut text = String::new();
    for (kind, names) in kinds {
        let names: Vec<String> = names.into_iter().collect();
        writeln!(text, "{kind}: {}", names.join(" ")).unwrap();
    }
    crate::documents::check("explanations.md", "names", &text);
    insta::assert_snapshot!(text);
}

#[test]
fn the_flags_of_trace_and_why_are_a_contract() {
    let start = |command: &str| {
        let help = succeeds(&format!("{command} -h"));
        help.split("Method and parameters:").next().unwrap().to_owned()
    };
    insta::assert_snapshot!(format!("{}\n{}", start("trace"), start("why")));
}
