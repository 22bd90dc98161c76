//! Tests of `dichroscope analyze`, `evaluate` and `screenshot`: files, output and exit codes.

use crate::folder::{WorkFolder, list, tiny};
use dichroscope::app::{Application, Edit, Executor, ExportKind, JobCommand, analyze_call};
use dichroscope::describe::RegionFacts;
use dichroscope::params::{Method, Parameter, Reading, Setting, Switch};
use dichroscope::photo::ReadOptions;
use dichroscope::raster::Raster;
use dichroscope::truth::ResultPictures;
use dichroscope::view::Origin;
use serde_json::Value;
use std::fs;
use std::sync::Arc;

const FILES: [&str; 16] = [
    "body.exr",
    "body.png",
    "confidence.png",
    "matte.png",
    "noise.exr",
    "noise.png",
    "regions.png",
    "report.json",
    "residual.exr",
    "stage-1-classification.png",
    "stage-2-merged.png",
    "stage-3-linear.png",
    "stage-4-planar.png",
    "stage-5-clipping.png",
    "surface.exr",
    "surface.png",
];

#[test]
fn help_and_version_are_no_errors() {
    let work = WorkFolder::new();
    assert!(work.succeeds("--help").out.contains("analyze"));
    assert!(work.succeeds("--version").out.contains(env!("CARGO_PKG_VERSION")));
    let help = work.succeeds("analyze --help").out;
    for part in [
        "--camera-noise <V|auto>",
        "[default: auto; paper: 2.5]",
        "radius of the dark sphere",
        "robust_lines",
    ] {
        assert!(help.contains(part), "{part} in {help}");
    }
}

#[test]
fn wrong_usage_is_exit_2_before_any_work() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put("empty/notes.txt", b"");
    if cfg!(not(feature = "gui")) {
        work.fails(2, "a.png", "`dichroscope analyze a.png --out DIR`");
        work.fails(2, "screenshot --out out", "no window built in");
    }
    for (arguments, says) in [
        ("screenshot --out out --size 10x20", "expected WIDTHxHEIGHT, each from 64 to 8192 pixels"),
        ("screenshot --out out --size large", "expected WIDTHxHEIGHT"),
        ("screenshot --size 640x400", "--out"),
        ("analyze a.png", "--out"),
        ("analyze --out out", "IMAGE|DIR"),
        (
            "analyze a.png --out out --window-size 2.5",
            "window_size = 2.5: expected `auto` or a whole number from 3 to 64 px",
        ),
        ("analyze a.png --out out --camera-noise -1", "camera_noise = -1"),
        ("analyze a.png --out out --camera-noise nan", "camera_noise = NaN"),
        ("analyze a.png --out out --min-area many", "neither a number nor `auto`"),
        ("analyze a.png --out out --with magic", "robust_lines"),
        ("analyze a.png --out out --with edge_body --without edge_body", "edge_body is both"),
        ("analyze a.png --out out --reading fill_holes", "belong to `--method paper`"),
        ("analyze a.png --out out --method paper --reading holes", "fill_holes"),
        (
            "analyze a.png --out out --method paper --reading fill_holes --without-reading fill_holes",
            "fill_holes is both",
        ),
        ("analyze a.png --out out --method 1990", "paper"),
        ("analyze a.png --out out --encoding gamma:x", "gamma:x"),
        ("analyze a.png --out out --full-scale 0", "above 0"),
        ("analyze a.png --out out --threads 0", "--threads"),
        ("analyze a.png --out out --match [", "--match"),
        ("analyze a.png --out out --truth nowhere", "nowhere: no such folder"),
        ("analyze a.png --out a.png", "--out a.png: this is a file, and results need a folder"),
        ("trace a.png --out a.png", "--out a.png: this is the photograph itself"),
        ("analyze a.png --out out --method paper --second-illuminant 1,0,0", "only the refined method"),
        ("analyze empty --out out", "no photograph in empty"),
        ("evaluate empty --truth TINY", "empty holds no result"),
        ("evaluate nowhere --truth TINY", "cannot walk nowhere"),
    ] {
        work.fails(2, arguments, says);
    }
    assert_eq!(work.list(""), ["a.png", "empty"]);
}

#[test]
fn a_photograph_becomes_a_whole_result() {
    let work = WorkFolder::new();
    let ended = work.succeeds("analyze TINY/camera8.png --out out --truth TINY");
    assert_eq!(ended.out, "");
    assert_eq!(ended.err.lines().count(), 1, "{}", ended.err);
    assert!(
        ended.err.starts_with("camera8: ") && ended.err.contains("\u{2192} out/camera8"),
        "{}",
        ended.err
    );
    assert_eq!(work.list("out"), ["camera8"]);
    let files = work.list("out/camera8");
    assert_eq!(files, FILES);
    let report = work.report("out/camera8");
    assert_eq!(
        (report.image.file.as_str(), report.image.width, report.image.height),
        ("camera8.png", 178, 150)
    );
    assert_eq!(report.image.sha256.len(), 64);
    assert!(report.scores.is_some());
    assert!(report.timings_ms.read.is_some() && report.timings_ms.write.is_some());
    let pictures = ResultPictures::read(&work.path("out/camera8")).unwrap();
    assert_eq!((pictures.regions.width(), pictures.regions.height()), (178, 150));
    let has = |name: &str, chunk: &[u8]| {
        fs::read(work.path("out/camera8").join(name)).unwrap().windows(4).any(|window| window == chunk)
    };
    assert!(has("body.png", b"sRGB") && !has("regions.png", b"sRGB"));
}

/// A pipe can be read only once: a second reading would give the hash of no bytes.
#[cfg(unix)]
#[test]
fn a_photograph_from_a_pipe_has_the_hash_of_its_bytes() {
    let work = WorkFolder::new();
    let bytes = fs::read(tiny().join("camera8.png")).unwrap();
    let ended = work.run_piped("analyze /dev/stdin --out out", &bytes);
    assert_eq!(ended.code, 0, "{}", ended.err);
    assert_eq!(work.report("out/stdin").image.sha256, dichroscope::photo::sha256_hex(&bytes));
}

#[test]
fn the_same_photograph_gives_the_same_files_with_any_number_of_threads() {
    let work = WorkFolder::new();
    work.succeeds("analyze TINY/camera8.png --out one --threads 1");
    work.succeeds("analyze TINY/camera8.png --out many --threads 4");
    for name in FILES.iter().filter(|name| **name != "report.json") {
        let bytes = |root: &str| fs::read(work.path(root).join("camera8").join(name)).unwrap();
        assert!(bytes("one") == bytes("many"), "{name} differs");
    }
}

#[test]
fn folders_are_walked_and_keep_their_relative_paths() {
    let work = WorkFolder::new();
    for name in ["d/b.png", "d/s/camera8.png", "d/s/other.png"] {
        work.photo(name);
    }
    work.succeeds("analyze d --out out --match camera8.png --quiet");
    assert_eq!(work.list("out"), ["results.jsonl", "s"]);
    let ended = work.succeeds("analyze d --out d/out");
    assert_eq!(ended.err.lines().count(), 3, "{}", ended.err);
    assert_eq!(work.list("d/out"), ["b", "results.jsonl", "s"]);
    assert_eq!(work.list("d/out/s"), ["camera8", "other"]);
    let again = work.succeeds("analyze d --out d/out");
    assert_eq!(again.err.lines().count(), 3, "results are not photographs: {}", again.err);
    assert_eq!(work.succeeds("analyze d --out d/out --quiet").err, "");
}

#[test]
fn colliding_names_take_what_tells_them_apart() {
    let work = WorkFolder::new();
    for name in ["p/x.png", "q/x.png", "q/x.bmp.png", "r/x.png", "r/x.jpg"] {
        work.photo(name);
    }
    work.succeeds("analyze p/x.png q/x.png q/x.bmp.png --out out");
    assert_eq!(work.list("out"), ["p", "q", "results.jsonl", "x.bmp"]);
    assert_eq!(work.list("out/p"), ["x"]);
    work.succeeds("analyze r/x.png r/x.jpg --out other");
    assert_eq!(work.list("other"), ["results.jsonl", "x.jpg", "x.png"]);
}

#[test]
fn results_are_replaced_whole_and_nothing_else_is_without_force() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put("out/a/thesis.tex", b"years of work");
    work.fails(
        2,
        "analyze a.png --out out",
        "out/a exists and is not an earlier result: --force replaces it",
    );
    assert_eq!(work.list("out/a"), ["thesis.tex"]);
    work.succeeds("analyze a.png --out out --force");
    assert!(!work.path("out/a/thesis.tex").exists());
    work.put("out/a/stale.png", b"");
    work.succeeds("analyze a.png --out out --window-size 8");
    assert!(!work.path("out/a/stale.png").exists());
    assert_eq!(work.report("out/a").params.window_size.asked, Setting::Value(8.0));
    assert_eq!(work.list("out"), ["a"]);
    work.put("plain/a", b"a file");
    work.fails(2, "analyze a.png --out plain --force", "plain/a is a file");
    fs::create_dir_all(work.path("fresh/a")).unwrap();
    work.succeeds("analyze a.png --out fresh");
}

#[test]
fn what_fails_says_so_in_a_line_and_leaves_nothing_half_written() {
    let work = WorkFolder::new();
    work.photo("good.png");
    let bytes = fs::read(work.path("good.png")).unwrap();
    work.put("short.png", &bytes[..bytes.len() / 2]);
    work.put("empty.png", b"");
    work.put("text.png", b"no picture at all");
    let ended = work.run("analyze good.png short.png empty.png text.png gone.png --out out");
    assert_eq!(ended.code, 1);
    let mut lines: Vec<&str> = ended.err.lines().collect();
    let last = lines.pop().unwrap();
    assert!(last.starts_with("4 of 5 photographs failed: ") && last.contains("gone.png"), "{last}");
    lines.sort_unstable();
    let starts: Vec<&str> = lines.iter().map(|line| line.split(':').next().unwrap()).collect();
    assert_eq!(starts, ["empty.png", "gone.png", "good", "short.png", "text.png"], "{}", ended.err);
    assert_eq!(work.list("out"), ["good", "results.jsonl"]);
    assert_eq!(work.run("analyze short.png --out none").code, 1);
    assert!(!work.path("none").exists());
}

#[test]
fn an_area_restricts_the_analysis_and_must_fit_the_photograph() {
    let work = WorkFolder::new();
    work.photo("a.png");
    // The area is the union of the picture's own regions, which contains lit pixels only.
    work.succeeds("analyze a.png --out out");
    let regions = fs::read(work.path("out/a/regions.png")).unwrap();
    work.put("mask.png", &regions);
    let whole = work.report("out/a");
    work.succeeds("analyze a.png --out out --area mask.png");
    let report = work.report("out/a");
    let area = report.area.unwrap();
    let assigned = |regions: &[RegionFacts]| regions.iter().map(|region| region.pixels).sum::<usize>();
    assert_eq!((area.file.as_str(), area.pixels), ("mask.png", assigned(&whole.regions)));
    assert_eq!(assigned(&report.regions) + report.unassigned_pixels, area.pixels);
    let outside = whole.image.width * whole.image.height - area.pixels;
    assert_eq!((report.reasons["outside_area"], report.reasons["shadow"]), (outside, 0));
    assert_eq!((whole.reasons["outside_area"], whole.reasons["no_value"]), (0, 0));
    let told = work.succeeds("why a.png 0,0 --area mask.png");
    assert!(told.out.contains("in no region, not explained: outside the area\n"), "{}", told.out);
    work.put("small.pgm", b"P5\n2 1\n255\n\0\x01");
    work.fails(1, "analyze a.png --out other --area small.pgm", "a.png: --area small.pgm: the area has 2");
    work.fails(2, "analyze a.png --out other --area none.png", "none.png: cannot be read");
    work.put("black.pgm", b"P5\n2 1\n255\n\0\0");
    work.fails(2, "analyze a.png --out other --area black.pgm", "black.pgm: every pixel is black");
    assert!(!work.path("other").exists());
}

#[test]
fn with_all_its_surface_reflection_the_matte_picture_is_the_photograph() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out none");
    work.succeeds("analyze a.png --out all --keep-surface 1");
    let sum = |name: &str| {
        let photo = dichroscope::photo::read(&work.path(name), &ReadOptions::default()).unwrap();
        photo.image.pixels.as_slice().iter().flatten().map(|&band| f64::from(band)).sum::<f64>()
    };
    assert!(sum("none/a/matte.png") < sum("all/a/matte.png"));
    let samples = |name: &str| image::open(work.path(name)).unwrap().into_rgb8().into_raw();
    assert!(work.report("all/a").regions.iter().any(|region| region.clipped_pixels > 0));
    assert!(samples("all/a/matte.png") == samples("a.png"), "clipped pixels too");
    work.fails(2, "analyze a.png --out all --keep-surface 1.5", "expected a number from 0 to 1");
}

#[test]
fn truth_is_found_by_the_results_name_or_the_folders() {
    let work = WorkFolder::new();
    for name in list(&tiny()) {
        work.put(&format!("scenes/cups/{name}"), &fs::read(tiny().join(&name)).unwrap());
    }
    work.photo("cups.png");
    work.photo("stranger.png");
    work.succeeds("analyze cups.png scenes/cups/camera8.png --out out --truth scenes");
    assert!(work.report("out/cups").scores.is_some() && work.report("out/camera8").scores.is_some());
    work.fails(
        1,
        "analyze stranger.png --out other --truth scenes",
        "stranger.png: no ground truth for stranger",
    );
    assert!(!work.path("other").exists());
    fs::remove_file(work.path("scenes/cups/surface.exr")).unwrap();
    work.fails(1, "analyze cups.png --out other --truth scenes", "surface.exr");
    assert!(!work.path("other").exists());
}

#[test]
fn a_truth_of_another_picture_is_warned_of_and_scored() {
    let work = WorkFolder::new();
    let mirrored = image::open(tiny().join("camera8.png")).unwrap().fliph();
    mirrored.save(work.path("other.png")).unwrap();
    work.photo("own.png");
    let doubt = "the ground truth is hardly that of this photograph";
    for (name, is_doubted) in [("own", false), ("other", true)] {
        work.succeeds(&format!("analyze {name}.png --encoding linear --out out --truth TINY"));
        let report = work.report(&format!("out/{name}"));
        assert!(report.scores.is_some());
        assert_eq!(report.warnings.iter().any(|text| text.starts_with(doubt)), is_doubted, "{name}");
        let ended = work.succeeds(&format!("evaluate out/{name} --truth TINY"));
        assert_eq!(ended.err.contains(doubt), is_doubted, "{name}: {}", ended.err);
        assert!(ended.out.contains(name));
    }
}

#[test]
fn evaluate_prints_a_table_or_json() {
    let work = WorkFolder::new();
    work.photo("second.png");
    work.succeeds("analyze TINY/camera8.png second.png --out out --truth TINY");
    let table = work.succeeds("evaluate out --truth TINY").out;
    let starts: Vec<&str> = table.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(starts, ["result", "camera8", "second", "MEAN"], "{table}");
    assert!(table.contains("psnr_body  (nothing)"), "{table}");

    let json = work.succeeds("evaluate out/camera8 --truth TINY --json").out;
    let json: Value = serde_json::from_str(&json).unwrap();
    let in_report = serde_json::to_value(work.report("out/camera8").scores).unwrap();
    let scores = json["results"]["camera8"].as_object().unwrap();
    assert_eq!(scores.len(), 14);
    for (name, score) in scores {
        let (a, b) = (score.as_f64(), in_report[name].as_f64());
        // Files hold counts / 255 as 32-bit floats, so values differ from those of the analysis by rounding.
        assert!(a == b || (a.unwrap() - b.unwrap()).abs() < 1e-3, "{name}: {a:?} and {b:?}");
    }
}

#[test]
fn evaluate_says_what_is_wrong_with_a_result() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out");
    work.fails(1, "evaluate out --truth TINY --image none.png", "out/a: --image none.png: not in");
    work.fails(1, "evaluate out --truth out", "no ground truth for a in out");
    work.put("out/a/body.exr", b"nonsense");
    work.fails(1, "evaluate out/a --truth TINY", "out/a: cannot decode out/a/body.exr");
}

#[cfg(feature = "gui")]
#[test]
fn without_a_display_one_sentence_names_what_needs_none() {
    let work = WorkFolder::new();
    work.photo("a.png");
    for arguments in ["", "a.png"] {
        let ended = work.run(arguments);
        assert_eq!((ended.code, ended.out.as_str()), (1, ""), "{}", ended.err);
        assert_eq!(ended.err.lines().count(), 1, "{}", ended.err);
        assert!(ended.err.contains("`dichroscope analyze PHOTO --out DIR` needs none"), "{}", ended.err);
        assert!(!ended.err.contains(".rs"), "{}", ended.err);
    }
    assert_eq!(work.list(""), ["a.png"]);
}

/// Skipped without a graphics adapter, unless `DICHROSCOPE_REQUIRE_GPU` is set.
#[cfg(feature = "gui")]
#[test]
fn the_gallery_is_drawn_without_a_display() {
    let work = WorkFolder::new();
    let ended = work.run("screenshot --out gallery --size 640x400");
    if ended.code == 1 && ended.err.contains("no graphics device") {
        let required = std::env::var_os("DICHROSCOPE_REQUIRE_GPU");
        assert!(!required.is_some_and(|value| !value.is_empty() && value != "0"), "{}", ended.err);
        eprintln!("SKIP: {}", ended.err);
        return;
    }
    assert_eq!(ended.code, 0, "{}", ended.err);
    let files = work.list("gallery");
    assert_eq!(ended.out.lines().count(), files.len(), "each picture is named: {}", ended.out);
    let size = |name: &str| image::image_dimensions(work.path("gallery").join(name)).unwrap();
    for name in &files {
        let whole = name.starts_with("window") || name.starts_with("debugger");
        let expected = match whole {
            // Four quarters of a scene of 512 × 480 pixels, reduced to a half.
            _ if name.starts_with("figure-") => (518, 486),
            true => (640, 400),
            false => (384, 240),
        };
        assert_eq!(size(name), expected, "{name}: the whole window, or three fifths of it");
    }
    assert!(files.len() >= 8, "{files:?}");
    let lamps = files.iter().filter(|name| name.starts_with("figure-")).count();
    assert_eq!(lamps, 3, "the three lamps: {files:?}");
    work.put("letter.txt", b"dear all");
    work.fails(1, "screenshot letter.txt --out other", "letter.txt");
}

#[cfg(not(feature = "gui"))]
#[test]
fn without_arguments_the_sample_is_analyzed() {
    let work = WorkFolder::new();
    let out = work.succeeds("").out;
    assert!(out.contains("plastic8_white") && out.contains("psnr_restored"), "{out}");
    assert!(out.contains(&work.path("dichroscope-sample").display().to_string()), "{out}");
    assert!(work.report("dichroscope-sample").scores.is_some());
    work.succeeds("");
    fs::remove_file(work.path("dichroscope-sample/report.json")).unwrap();
    work.put("dichroscope-sample/notes.txt", b"mine");
    work.fails(2, "", "run this in another folder");
}

/// The command line that the window offers for a photograph and changed parameters writes the same result as the
/// window, but
/// for the times. The window runs without a screen.
#[test]
fn the_call_that_the_window_hands_out_writes_the_windows_result() {
    let edits = [
        Edit::SetParameter(Parameter::CameraNoise, Setting::Value(3.5), None),
        Edit::SetSwitch(Switch::SecondLook, false),
        Edit::PinIlluminant(Some([1.0, 0.75, 0.5]), None),
    ];
    assert_that_the_call_repeats(edits.into());
    let second = Edit::PinSecondIlluminant(Some([0.25, 0.5, 1.0]), None);
    assert_that_the_call_repeats(vec![Edit::PinIlluminant(Some([1.0, 0.75, 0.5]), None), second]);
    let edits = [
        Edit::SetMethod(Method::Paper),
        Edit::SetSwitch(Switch::EdgeBody, true),
        Edit::SetReading(Reading::FillHoles, true),
    ];
    assert_that_the_call_repeats(edits.into());
}

fn assert_that_the_call_repeats(edits: Vec<Edit>) {
    let work = WorkFolder::new();
    for name in list(&tiny()) {
        work.put(&format!("scene/{name}"), &fs::read(tiny().join(&name)).unwrap());
    }
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(work.path("scene/camera8.png"))));
    for edit in edits {
        application.apply(edit);
    }
    let (width, height) = application.state().picture.as_ref().unwrap().size();
    let inside = (0..width * height).map(|pixel| pixel % width < width * 3 / 4).collect();
    let area = Arc::new(Raster::from_vec(width, height, inside).unwrap());
    application.apply(Edit::RestrictTo(Some(area)));
    application.apply(JobCommand::Export(ExportKind::Area.to(work.path("area.png"))));
    let folder = work.path("window");
    application.apply(JobCommand::Export(ExportKind::Result.to(folder.clone())));
    assert!(folder.is_dir(), "{:?}", application.state().notices);

    let call = analyze_call(application.state());
    let words = call.split("  # ").next().unwrap().strip_prefix("dichroscope ").unwrap();
    work.succeeds(words);
    for file in FILES.into_iter().filter(|file| *file != "report.json") {
        let same = fs::read(folder.join(file)).unwrap()
            == fs::read(work.path("results/camera8").join(file)).unwrap();
        assert!(same, "{file} differs");
    }
    let [mut ours, mut theirs] = ["window", "results/camera8"].map(|name| work.report(name));
    (ours.timings_ms, theirs.timings_ms) = Default::default();
    assert_eq!(ours, theirs);
    assert!(ours.scores.is_some() && ours.area.is_some());
}
