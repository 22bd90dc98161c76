//! The command line end to end: what it writes, what it says, and how it ends.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

use assert_cmd::cargo::cargo_bin_cmd;
use dichroscope::app::{Application, Command, Executor, Export, analyze_call};
use dichroscope::describe::{RegionFacts, Report};
use dichroscope::export::read_report;
use dichroscope::photo::ReadOptions;
use dichroscope::raster::Raster;
use dichroscope::segment::{IlluminantSetting, Method, Parameter, Setting};
use dichroscope::truth::ResultPictures;
use dichroscope::view::Origin;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

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

/// A folder to work in, and the program in it.
struct LatestRequest {
    folder: TempDir,
}

/// How a run ended.
struct Ended {
    code: i32,
    out: String,
    err: String,
}

impl LatestRequest {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A copy of the tiny scene's photograph.
    fn photo(&self, name: &str) {
        self.put(name, &fs::read(tiny().join("camera8.png")).unwrap());
    }

    fn put(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// Runs the program as on a machine without a display.
    fn run(&self, arguments: &str) -> Ended {
        let tiny = tiny().display().to_string();
        let arguments = arguments.split_whitespace().map(|word| word.replace("TINY", &tiny));
        let mut program = cargo_bin_cmd!("dichroscope");
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            program.env_remove(name);
        }
        let output = program.current_dir(self.folder.path()).args(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Ended { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
    }

    #[track_caller]
    fn succeeds(&self, arguments: &str) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, 0, "{arguments}: {}", ended.err);
        ended
    }

    #[track_caller]
    fn fails(&self, code: i32, arguments: &str, says: &str) {
        let ended = self.run(arguments);
        assert_eq!(ended.code, code, "{arguments}: {}", ended.err);
        assert!(ended.err.contains(says), "{arguments}: expected {says:?} in {:?}", ended.err);
    }

    fn report(&self, result: &str) -> Report {
        read_report(&self.path(result)).unwrap()
    }

    /// What lies in a folder, hidden files included.
    fn list(&self, folder: &str) -> Vec<String> {
        list(&self.path(folder))
    }
}

fn tiny() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny")
}

fn list(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn help_and_version_are_no_errors() {
    let desk = LatestRequest::new();
    assert!(desk.succeeds("--help").out.contains("analyze"));
    assert!(desk.succeeds("--version").out.contains(env!("CARGO_PKG_VERSION")));
    let help = desk.succeeds("analyze --help").out;
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
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.put("empty/notes.txt", b"");
    if cfg!(not(feature = "gui")) {
        desk.fails(2, "a.png", "`dichroscope analyze a.png --out DIR`");
        desk.fails(2, "screenshot --out out", "no window built in");
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
        ("analyze a.png --out out --method paper --with edge_body", "the paper's method refines nothing"),
        ("analyze a.png --out out --method 1990", "paper"),
        ("analyze a.png --out out --encoding gamma:x", "gamma:x"),
        ("analyze a.png --out out --full-scale 0", "above 0"),
        ("analyze a.png --out out --threads 0", "--threads"),
        ("analyze a.png --out out --match [", "--match"),
        ("analyze a.png --out out --truth nowhere", "nowhere: no such folder"),
        ("analyze empty --out out", "no photograph in empty"),
        ("evaluate empty --truth TINY", "empty holds no result"),
        ("evaluate nowhere --truth TINY", "cannot walk nowhere"),
    ] {
        desk.fails(2, arguments, says);
    }
    assert_eq!(desk.list(""), ["a.png", "empty"]);
}

#[test]
fn a_photograph_becomes_a_whole_result() {
    let desk = LatestRequest::new();
    let ended = desk.succeeds("analyze TINY/camera8.png --out out --truth TINY");
    assert_eq!(ended.out, "");
    assert_eq!(ended.err.lines().count(), 1, "{}", ended.err);
    assert!(
        ended.err.starts_with("camera8: ") && ended.err.contains("\u{2192} out/camera8"),
        "{}",
        ended.err
    );
    assert_eq!(desk.list("out"), ["camera8"]);
    let files = desk.list("out/camera8");
    assert_eq!(files, FILES);
    let report = desk.report("out/camera8");
    assert_eq!(
        (report.image.file.as_str(), report.image.width, report.image.height),
        ("camera8.png", 178, 150)
    );
    assert_eq!(report.image.sha256.len(), 64);
    assert!(report.scores.is_some());
    assert!(report.timings_ms.read.is_some() && report.timings_ms.write.is_some());
    let pictures = ResultPictures::read(&desk.path("out/camera8")).unwrap();
    assert_eq!((pictures.regions.width(), pictures.regions.height()), (178, 150));
    let has = |name: &str, chunk: &[u8]| {
        fs::read(desk.path("out/camera8").join(name)).unwrap().windows(4).any(|window| window == chunk)
    };
    assert!(has("body.png", b"sRGB") && !has("regions.png", b"sRGB"));
}

#[test]
fn the_same_photograph_gives_the_same_files_with_any_number_of_threads() {
    let desk = LatestRequest::new();
    desk.succeeds("analyze TINY/camera8.png --out one --threads 1");
    desk.succeeds("analyze TINY/camera8.png --out many --threads 4");
    for name in FILES.iter().filter(|name| **name != "report.json") {
        let bytes = |root: &str| fs::read(desk.path(root).join("camera8").join(name)).unwrap();
        assert!(bytes("one") == bytes("many"), "{name} differs");
    }
}

#[test]
fn folders_are_walked_and_keep_their_relative_paths() {
    let desk = LatestRequest::new();
    for name in ["d/b.png", "d/s/camera8.png", "d/s/other.png"] {
        desk.photo(name);
    }
    desk.succeeds("analyze d --out out --match camera8.png --quiet");
    assert_eq!(desk.list("out"), ["s"]);
    let ended = desk.succeeds("analyze d --out d/out");
    assert_eq!(ended.err.lines().count(), 3, "{}", ended.err);
    assert_eq!(desk.list("d/out"), ["b", "s"]);
    assert_eq!(desk.list("d/out/s"), ["camera8", "other"]);
    let again = desk.succeeds("analyze d --out d/out");
    assert_eq!(again.err.lines().count(), 3, "results are not photographs: {}", again.err);
    assert_eq!(desk.succeeds("analyze d --out d/out --quiet").err, "");
}

#[test]
fn colliding_names_take_the_folders_name_or_are_refused() {
    let desk = LatestRequest::new();
    for name in ["p/x.png", "q/x.png", "q/x.bmp.png", "r/x.png", "r/x.jpg"] {
        desk.photo(name);
    }
    desk.succeeds("analyze p/x.png q/x.png q/x.bmp.png --out out");
    assert_eq!(desk.list("out"), ["p", "q", "x.bmp"]);
    desk.fails(
        2,
        "analyze r/x.png r/x.jpg --out other",
        "r/x.png and r/x.jpg would both be written to other/r",
    );
    assert!(!desk.path("other").exists());
}

#[test]
fn results_are_replaced_whole_and_nothing_else_is_without_force() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.put("out/a/thesis.tex", b"years of work");
    desk.fails(
        2,
        "analyze a.png --out out",
        "out/a exists and is not an earlier result: --force replaces it",
    );
    assert_eq!(desk.list("out/a"), ["thesis.tex"]);
    desk.succeeds("analyze a.png --out out --force");
    assert!(!desk.path("out/a/thesis.tex").exists());
    desk.put("out/a/stale.png", b"");
    desk.succeeds("analyze a.png --out out --window-size 8");
    assert!(!desk.path("out/a/stale.png").exists());
    assert_eq!(desk.report("out/a").params.window_size.asked, Setting::Value(8.0));
    assert_eq!(desk.list("out"), ["a"]);
    desk.put("plain/a", b"a file");
    desk.fails(2, "analyze a.png --out plain --force", "plain/a is a file");
    fs::create_dir_all(desk.path("fresh/a")).unwrap();
    desk.succeeds("analyze a.png --out fresh");
}

#[test]
fn what_fails_says_so_in_a_line_and_leaves_nothing_half_written() {
    let desk = LatestRequest::new();
    desk.photo("good.png");
    let bytes = fs::read(desk.path("good.png")).unwrap();
    desk.put("short.png", &bytes[..bytes.len() / 2]);
    desk.put("empty.png", b"");
    desk.put("text.png", b"no picture at all");
    let ended = desk.run("analyze good.png short.png empty.png text.png gone.png --out out");
    assert_eq!(ended.code, 1);
    let mut lines: Vec<&str> = ended.err.lines().collect();
    lines.sort_unstable();
    let starts: Vec<&str> = lines.iter().map(|line| line.split(':').next().unwrap()).collect();
    assert_eq!(starts, ["empty.png", "gone.png", "good", "short.png", "text.png"], "{}", ended.err);
    assert_eq!(desk.list("out"), ["good"]);
    assert_eq!(desk.run("analyze short.png --out none").code, 1);
    assert!(!desk.path("none").exists());
}

#[test]
fn defaults_give_way_to_the_file_and_the_file_to_flags() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.put(
        "p.toml",
        b"camera_noise = 3\nwindow_size = 12\nmin_area = 400\n[refine]\nsecond_look = false\n",
    );
    desk.succeeds(
        "analyze a.png --out out --params p.toml --window-size 8 --min-area auto --without edge_body",
    );
    let params = desk.report("out/a").params;
    assert_eq!(params.method, Method::Refined);
    assert_eq!(params.camera_noise.asked, Setting::Value(3.0));
    assert_eq!(params.window_size.asked, Setting::Value(8.0));
    assert_eq!(params.min_area.asked, Setting::Auto);
    assert_eq!(params.cylinder_width.asked, Setting::Auto, "left to the method");
    assert!(!params.refine.second_look && !params.refine.edge_body && params.refine.robust_lines);

    desk.succeeds("analyze a.png --out out --params p.toml --with second_look --auto --window-size 8");
    let params = desk.report("out/a").params;
    assert_eq!(params.camera_noise.asked, Setting::Auto);
    assert_eq!(params.window_size.asked, Setting::Value(8.0));
    assert!(params.refine.second_look);

    desk.put("paper.toml", b"method = \"paper\"\nslice_width = 5\n");
    desk.succeeds("analyze a.png --out out --params paper.toml");
    let params = desk.report("out/a").params;
    assert_eq!((params.method, params.slice_width.asked), (Method::Paper, Setting::Value(5.0)));
    assert_eq!(params.camera_noise.asked, Setting::Value(2.5), "table 6, because the file says paper");
    desk.succeeds("analyze a.png --out out --params paper.toml --method refined");
    assert_eq!(desk.report("out/a").params.camera_noise.asked, Setting::Auto);
}

#[test]
fn a_preset_is_a_column_of_table_6_and_gives_way_to_flags() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.succeeds("analyze a.png --out out --preset cups_pink --min-area 300");
    let params = desk.report("out/a").params;
    assert_eq!((params.method, params.window_size.asked), (Method::Paper, Setting::Value(15.0)));
    assert_eq!(params.min_area.asked, Setting::Value(300.0));
    desk.succeeds("analyze a.png --out out --preset cups_white --method refined");
    let params = desk.report("out/a").params;
    assert_eq!((params.method, params.slice_width.asked), (Method::Refined, Setting::Value(6.0)));
}

#[test]
fn a_light_can_be_given_and_the_report_says_so() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.put("p.toml", b"illuminant = [1, 1, 1]\n");
    desk.succeeds("analyze a.png --out out --params p.toml --illuminant 0,3,4");
    let report = desk.report("out/a");
    assert_eq!(report.params.illuminant.asked, IlluminantSetting::Given([0.0, 3.0, 4.0]));
    assert_eq!(report.illuminant.direction, Some([0.0, 0.6, 0.8]));
    assert!(report.illuminant.given);
    desk.succeeds("analyze a.png --out out --params p.toml --illuminant auto");
    assert!(!desk.report("out/a").illuminant.given);
    desk.fails(2, "analyze a.png --out out --illuminant 1,-1,0", "illuminant = [1.0, -1.0, 0.0]: expected");
    desk.fails(2, "analyze a.png --out out --illuminant white", "neither three numbers");
}

#[test]
fn an_area_restricts_the_analysis_and_must_fit_the_photograph() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    // Its own regions as the area: all of it lies where the picture is lit.
    desk.succeeds("analyze a.png --out out");
    let regions = fs::read(desk.path("out/a/regions.png")).unwrap();
    desk.put("mask.png", &regions);
    let whole = desk.report("out/a");
    desk.succeeds("analyze a.png --out out --area mask.png");
    let report = desk.report("out/a");
    let area = report.area.unwrap();
    let assigned = |regions: &[RegionFacts]| regions.iter().map(|region| region.pixels).sum::<usize>();
    assert_eq!((area.file.as_str(), area.pixels), ("mask.png", assigned(&whole.regions)));
    assert_eq!(assigned(&report.regions) + report.unassigned_pixels, area.pixels);
    desk.put("small.pgm", b"P5\n2 1\n255\n\0\x01");
    desk.fails(1, "analyze a.png --out other --area small.pgm", "a.png: --area small.pgm: the area has 2");
    desk.fails(2, "analyze a.png --out other --area none.png", "none.png: cannot be read");
    assert!(!desk.path("other").exists());
}

#[test]
fn with_all_its_surface_reflection_the_matte_picture_is_brighter() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.succeeds("analyze a.png --out none");
    desk.succeeds("analyze a.png --out all --keep-surface 1");
    let sum = |name: &str| {
        let photo = dichroscope::photo::read(&desk.path(name), &ReadOptions::default()).unwrap();
        photo.image.pixels.as_slice().iter().flatten().map(|&band| f64::from(band)).sum::<f64>()
    };
    assert!(sum("none/a/matte.png") < sum("all/a/matte.png"));
    assert!((sum("all/a/matte.png") / sum("a.png") - 1.0).abs() < 0.01);
    desk.fails(2, "analyze a.png --out all --keep-surface 1.5", "expected a number from 0 to 1");
}

#[test]
fn mistakes_in_the_file_are_named_with_their_line() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    for (text, says) in [
        ("window_size = 12\nwindowsize = 12\n", "p.toml:2: unknown field `windowsize`"),
        ("[refine]\nmagic = true\n", "p.toml:2: unknown field `magic`"),
        ("window_size = \n", "p.toml:1: "),
        ("\nmethod = \"1990\"\n", "p.toml:2: unknown variant `1990`"),
        ("illuminant = \"white\"\n", "p.toml:1: \"white\" is neither three numbers nor `auto`"),
        ("illuminant = [0, 0, 0]\n", "p.toml: illuminant = [0.0, 0.0, 0.0]: expected"),
        ("min_area = 2\n", "p.toml: min_area = 2: expected `auto` or a whole number from 4"),
    ] {
        desk.put("p.toml", text.as_bytes());
        desk.fails(2, "analyze a.png --out out --params p.toml", says);
    }
    desk.fails(2, "analyze a.png --out out --params none.toml", "cannot read none.toml");
}

#[test]
fn truth_is_found_by_the_results_name_or_the_folders() {
    let desk = LatestRequest::new();
    for name in list(&tiny()) {
        desk.put(&format!("scenes/cups/{name}"), &fs::read(tiny().join(&name)).unwrap());
    }
    desk.photo("cups.png");
    desk.photo("stranger.png");
    desk.succeeds("analyze cups.png scenes/cups/camera8.png --out out --truth scenes");
    assert!(desk.report("out/cups").scores.is_some() && desk.report("out/camera8").scores.is_some());
    desk.fails(
        1,
        "analyze stranger.png --out other --truth scenes",
        "stranger.png: no ground truth for stranger",
    );
    assert!(!desk.path("other").exists());
    fs::remove_file(desk.path("scenes/cups/surface.exr")).unwrap();
    desk.fails(1, "analyze cups.png --out other --truth scenes", "surface.exr");
    assert!(!desk.path("other").exists());
}

#[test]
fn evaluate_prints_a_table_or_json() {
    let desk = LatestRequest::new();
    desk.photo("second.png");
    desk.succeeds("analyze TINY/camera8.png second.png --out out --truth TINY");
    let table = desk.succeeds("evaluate out --truth TINY").out;
    let starts: Vec<&str> = table.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(starts, ["result", "camera8", "second", "MEAN"], "{table}");
    assert!(table.contains("psnr_body  (nothing)"), "{table}");

    let json = desk.succeeds("evaluate out/camera8 --truth TINY --json").out;
    let json: Value = serde_json::from_str(&json).unwrap();
    let in_report = serde_json::to_value(desk.report("out/camera8").scores).unwrap();
    let scores = json["results"]["camera8"].as_object().unwrap();
    assert_eq!(scores.len(), 14);
    for (name, score) in scores {
        let (a, b) = (score.as_f64(), in_report[name].as_f64());
        // Files hold counts / 255 as 32-bit floats: a rounding away from what the analysis held.
        assert!(a == b || (a.unwrap() - b.unwrap()).abs() < 1e-3, "{name}: {a:?} and {b:?}");
    }
}

#[test]
fn evaluate_says_what_is_wrong_with_a_result() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    desk.succeeds("analyze a.png --out out");
    desk.fails(1, "evaluate out --truth TINY --image none.png", "out/a: --image none.png: not in");
    desk.fails(1, "evaluate out --truth out", "no ground truth for a in out");
    desk.put("out/a/body.exr", b"nonsense");
    desk.fails(1, "evaluate out/a --truth TINY", "out/a: cannot decode out/a/body.exr");
}

#[cfg(feature = "gui")]
#[test]
fn without_a_display_one_sentence_names_what_needs_none() {
    let desk = LatestRequest::new();
    desk.photo("a.png");
    for arguments in ["", "a.png"] {
        let ended = desk.run(arguments);
        assert_eq!((ended.code, ended.out.as_str()), (1, ""), "{}", ended.err);
        assert_eq!(ended.err.lines().count(), 1, "{}", ended.err);
        assert!(ended.err.contains("`dichroscope analyze PHOTO --out DIR` needs none"), "{}", ended.err);
        assert!(!ended.err.contains(".rs"), "{}", ended.err);
    }
    assert_eq!(desk.list(""), ["a.png"]);
}

/// Without a graphics adapter there is nothing to draw with: a skip, unless `DICHROSCOPE_REQUIRE_GPU` says that there is one.
#[cfg(feature = "gui")]
#[test]
fn the_gallery_is_drawn_without_a_display() {
    let desk = LatestRequest::new();
    let ended = desk.run("screenshot --out gallery --size 640x400");
    if ended.code == 1 && ended.err.contains("no graphics device") {
        let required = std::env::var_os("DICHROSCOPE_REQUIRE_GPU");
        assert!(!required.is_some_and(|value| !value.is_empty() && value != "0"), "{}", ended.err);
        eprintln!("SKIP: {}", ended.err);
        return;
    }
    assert_eq!(ended.code, 0, "{}", ended.err);
    let files = desk.list("gallery");
    assert_eq!(ended.out.lines().count(), files.len(), "each picture is named: {}", ended.out);
    let size = |name: &str| image::image_dimensions(desk.path("gallery").join(name)).unwrap();
    for name in &files {
        let whole = name.starts_with("window") || name.starts_with("debugger");
        let expected = if whole { (640, 400) } else { (384, 240) };
        assert_eq!(size(name), expected, "{name}: the whole window, or three fifths of it");
    }
    assert!(files.len() >= 8, "{files:?}");
    desk.put("letter.txt", b"dear all");
    desk.fails(1, "screenshot letter.txt --out other", "letter.txt");
}

#[cfg(not(feature = "gui"))]
#[test]
fn without_arguments_the_sample_is_analyzed() {
    let desk = LatestRequest::new();
    let out = desk.succeeds("").out;
    assert!(out.contains("plastic8_white") && out.contains("psnr_restored"), "{out}");
    assert!(out.contains(&desk.path("dichroscope-sample").display().to_string()), "{out}");
    assert!(desk.report("dichroscope-sample").scores.is_some());
    desk.succeeds("");
    fs::remove_file(desk.path("dichroscope-sample/report.json")).unwrap();
    desk.fails(2, "", "run this in another folder");
}

/// The window, without its screen: a photograph is opened, parameters are changed, and the call that the window hands out
/// is run. Both write the same result, but for the time that it took.
#[test]
fn the_call_that_the_window_hands_out_writes_the_windows_result() {
    let desk = LatestRequest::new();
    for name in list(&tiny()) {
        desk.put(&format!("scene/{name}"), &fs::read(tiny().join(&name)).unwrap());
    }
    let mut bench = Application::new(Executor::Inline, || ()).unwrap();
    bench.apply(Command::Open(Origin::File(desk.path("scene/camera8.png"))));
    bench.apply(Command::SetParameter(Parameter::CameraNoise, Setting::Value(3.5), None));
    bench.apply(Command::SetSwitch("second_look", false));
    bench.apply(Command::PinIlluminant(Some([1.0, 0.75, 0.5]), None));
    let (width, height) = bench.state().picture.as_ref().unwrap().size();
    let inside = (0..width * height).map(|pixel| pixel % width < width * 3 / 4).collect();
    let area = Arc::new(Raster::from_vec(width, height, inside).unwrap());
    bench.apply(Command::RestrictTo(Some(area)));
    bench.apply(Command::Export(Export::Area { path: desk.path("area.png") }));
    let folder = desk.path("window");
    bench.apply(Command::Export(Export::Result { folder: folder.clone(), force: false }));
    assert!(folder.is_dir(), "{:?}", bench.state().notices);

    let call = analyze_call(bench.state());
    let words = call.split("  # ").next().unwrap().strip_prefix("dichroscope ").unwrap();
    desk.succeeds(words);
    for file in FILES.into_iter().filter(|file| *file != "report.json") {
        let same = fs::read(folder.join(file)).unwrap()
            == fs::read(desk.path("results/camera8").join(file)).unwrap();
        assert!(same, "{file} differs");
    }
    let [mut ours, mut theirs] = ["window", "results/camera8"].map(|name| desk.report(name));
    (ours.timings_ms, theirs.timings_ms) = Default::default();
    assert_eq!(ours, theirs);
    assert!(ours.scores.is_some() && ours.area.is_some());
}
