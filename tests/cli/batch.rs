//! Tests of many photographs in one call: names, resuming, signals, parts, chosen files, and inputs that are no plain paths.

use crate::folder::{WorkFolder, tiny};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The lines of a file of results.
fn lines(work: &WorkFolder, name: &str) -> Vec<Value> {
    let text = fs::read_to_string(work.path(name)).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_second_call_passes_over_what_is_done_and_repeats_what_changed() {
    let work = WorkFolder::new();
    for name in ["d/a.png", "d/b.png", "d/c.png"] {
        work.photo(name);
    }
    work.put("d/bad.png", b"nothing");
    assert_eq!(work.run("analyze d --out out").code, 1);
    let found = lines(&work, "out/results.jsonl");
    let names: Vec<_> = found.iter().map(|line| (&line["name"], &line["status"])).collect();
    assert_eq!(format!("{names:?}").matches("done").count(), 3, "{names:?}");
    assert!(found[2]["error"].as_str().unwrap().contains("bad.png"), "{:?}", found[2]);
    assert_eq!(found[0]["regions"], work.report("out/a").regions.len());

    let unchanged = |err: &str| err.lines().filter(|line| line.contains(": unchanged")).count();
    let again = work.run("analyze d --out out");
    assert_eq!((again.code, unchanged(&again.err)), (1, 3), "{}", again.err);
    assert!(again.err.ends_with("1 of 4 photographs failed: d/bad.png\n"), "{}", again.err);
    let done = |lines: &[Value]| -> Vec<Value> {
        lines.iter().filter(|line| line["status"] == "done").cloned().collect()
    };
    assert_eq!(done(&lines(&work, "out/results.jsonl")), done(&found), "the lines of what is unchanged stay");
    // Another photograph, a result that is gone, and other parameters are reasons to analyze.
    let bytes = fs::read(tiny().join("camera8.png")).unwrap();
    work.put("d/a.png", &[&bytes[..], b"trailing bytes"].concat());
    fs::remove_dir_all(work.path("out/b")).unwrap();
    fs::remove_file(work.path("d/bad.png")).unwrap();
    assert_eq!(unchanged(&work.succeeds("analyze d --out out").err), 1);
    assert_eq!(unchanged(&work.succeeds("analyze d --out out --window-size 8").err), 0);
    assert_eq!(unchanged(&work.succeeds("analyze d --out out --window-size 8").err), 3);
    assert_eq!(unchanged(&work.succeeds("analyze d --out out --window-size 8 --again").err), 0);
}

#[test]
fn the_result_that_was_written_last_decides_what_is_unchanged() {
    let work = WorkFolder::new();
    work.photo("d/a.png");
    let is_unchanged = |call: &str| work.succeeds(call).err.contains("a: unchanged");
    assert!(!is_unchanged("analyze d --out out --method paper --shard 1/1"));
    assert!(!is_unchanged("analyze d --out out"));
    assert!(!is_unchanged("analyze d --out out --method paper"), "the folder has the refined result");
    assert!(is_unchanged("analyze d --out out --method paper"));
    assert!(is_unchanged("analyze d --out out --method paper --shard 1/1"));
}

#[test]
fn parts_of_a_folder_are_analyzed_apart_and_their_lines_are_put_together() {
    let work = WorkFolder::new();
    for name in ["d/s1/x.png", "d/s2/x.png", "d/y.png", "d/z.png", "d/z.bmp.png"] {
        work.photo(name);
    }
    for part in ["1/2", "2/2"] {
        work.succeeds(&format!("analyze d --out parts --shard {part} --quiet"));
    }
    work.succeeds("analyze d --out whole --quiet");
    let mut merged = lines(&work, "parts/results.1-of-2.jsonl");
    merged.extend(lines(&work, "parts/results.2-of-2.jsonl"));
    let names = |lines: &[Value]| {
        let mut names: Vec<String> = lines.iter().map(|line| line["name"].to_string()).collect();
        names.sort();
        names
    };
    assert_eq!(merged.len(), 5);
    assert_eq!(names(&merged), names(&lines(&work, "whole/results.jsonl")));
    // A call for the whole goes on from the parts.
    let ended = work.succeeds("analyze d --out parts");
    assert_eq!(ended.err.matches(": unchanged").count(), 5, "{}", ended.err);
    work.fails(2, "analyze d --out parts --shard 3/2", "as in 3/8");
}

/// The example of docs/command-line.md, where GNU Parallel is installed; it must be where `DICHROSCOPE_REQUIRE_PARALLEL` is set.
#[cfg(unix)]
#[test]
fn gnu_parallel_runs_the_parts() {
    let installed = Command::new("parallel").arg("--version").output();
    if !installed.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("GNU parallel")) {
        assert!(std::env::var_os("DICHROSCOPE_REQUIRE_PARALLEL").is_none(), "GNU Parallel is not installed");
        eprintln!("SKIP: GNU Parallel is not installed");
        return;
    }
    let work = WorkFolder::new();
    for name in ["d/a.png", "d/b.png", "d/c.png"] {
        work.photo(name);
    }
    let program = env!("CARGO_BIN_EXE_dichroscope");
    let command = format!("{program} analyze d --out out --quiet --shard {{}}/2");
    let status =
        Command::new("parallel").current_dir(work.path("")).args([&command, ":::", "1", "2"]).status();
    assert!(status.unwrap().success());
    assert_eq!(
        lines(&work, "out/results.1-of-2.jsonl").len() + lines(&work, "out/results.2-of-2.jsonl").len(),
        3
    );
}

#[test]
fn only_the_chosen_files_are_written() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out --files body.exr,matte,report.json");
    assert_eq!(work.list("out/a"), ["body.exr", "matte.png", "report.json"]);
    work.succeeds("analyze a.png --out out --files body.exr --npy");
    assert_eq!(work.list("out/a"), ["body.exr", "body.npy", "noise.npy", "residual.npy", "surface.npy"]);
    let header = fs::read(work.path("out/a/body.npy")).unwrap();
    assert!(String::from_utf8_lossy(&header[..128]).contains("'shape': (150, 178, 3)"));
    assert_eq!(header.len(), 128 + 150 * 178 * 12);
    work.fails(2, "analyze a.png --out out --files body.tif", "`body.tif` is no file of a result");
}

#[test]
fn parts_of_a_result_are_added_to_and_replaced_without_being_forced() {
    let work = WorkFolder::new();
    work.photo("a.png");
    for _ in 0..2 {
        work.succeeds("analyze a.png --out out --files matte.png");
        assert_eq!(work.list("out/a"), ["matte.png"]);
    }
    work.succeeds("analyze a.png --out out --files body,regions");
    assert_eq!(work.list("out/a"), ["body.exr", "body.png", "matte.png", "regions.png"]);
    work.put("out/a/notes.txt", b"mine");
    work.fails(2, "analyze a.png --out out --files matte", "is not an earlier result");
    fs::remove_file(work.path("out/a/notes.txt")).unwrap();
    work.succeeds("analyze a.png --out out");
    assert!(work.list("out/a").contains(&"report.json".to_owned()));
    // In a folder of photographs, a result that lacks a chosen file is made again.
    work.photo("d/b.png");
    work.succeeds("analyze d --out many --files matte,noise.png");
    fs::remove_file(work.path("many/b/matte.png")).unwrap();
    work.succeeds("analyze d --out many --files matte,noise.png");
    assert_eq!(work.list("many/b"), ["matte.png", "noise.png"]);
}

#[test]
fn a_report_is_valid_by_the_published_schema() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put("dark.pgm", &[b"P5\n40 40\n255\n", &[0; 1600][..]].concat());
    work.put("mask.pgm", &[b"P5\n178 150\n255\n", &vec![1; 178 * 150][..]].concat());
    work.succeeds("analyze a.png --out plain --truth TINY");
    work.succeeds("analyze dark.pgm --out plain");
    work.succeeds(
        "analyze a.png --out other --method paper --area mask.pgm --illuminant 1,1,1 --ambient 1,2,3",
    );
    work.succeeds("analyze a.png --out lamps --illuminant 1,1,1 --second-illuminant 1,2,3");
    let schema = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/report.schema.json");
    let schema: Value = serde_json::from_slice(&fs::read(schema).unwrap()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    for folder in ["plain/a", "plain/dark", "other/a", "lamps/a"] {
        let text = fs::read(work.path(folder).join("report.json")).unwrap();
        let mut report: Value = serde_json::from_slice(&text).unwrap();
        let errors: Vec<String> = validator.iter_errors(&report).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{folder}: {errors:?}");
        // Every name of the report is described.
        for name in report.as_object().unwrap().keys() {
            assert!(schema["properties"][name].is_object(), "{name}");
        }
        report["regions"] = "none".into();
        assert!(!validator.is_valid(&report));
    }
    assert_eq!(schema["properties"]["schema"]["const"], dichroscope::describe::SCHEMA);
}

#[test]
fn standard_input_and_uris_are_photographs_too() {
    let work = WorkFolder::new();
    let bytes = fs::read(tiny().join("camera8.png")).unwrap();
    let ended = work.run_piped("analyze - --out out", &bytes);
    assert_eq!(ended.code, 0, "{}", ended.err);
    assert_eq!(work.report("out/stdin").image.sha256, dichroscope::photo::sha256_hex(&bytes));
    let ended = work.run_piped("why - 50,50", &bytes);
    assert!(ended.out.starts_with("pixel (50, 50)"), "{} {}", ended.out, ended.err);
    let ended = work.run_piped("analyze - --out out", b"no picture");
    assert_eq!(ended.code, 1);
    assert!(ended.err.starts_with("stdin: "), "{}", ended.err);
    work.photo("\u{3b1} \u{e4}.png");
    let uri =
        format!("file://{}/%CE%B1%20%C3%A4.png", work.path("").display().to_string().trim_end_matches('/'));
    work.succeeds(&format!("analyze {uri} --out uri"));
    assert_eq!(work.list("uri"), ["\u{3b1} \u{e4}"]);
}

#[test]
fn the_mask_of_area_may_be_standard_input_too() {
    let work = WorkFolder::new();
    work.photo("a.png");
    let mask = [&b"P5\n178 150\n255\n"[..], &[1; 178 * 75], &[0; 178 * 75]].concat();
    work.put("mask.pgm", &mask);
    let ended = work.run_piped("analyze a.png --out piped --area -", &mask);
    assert_eq!(ended.code, 0, "{}", ended.err);
    work.succeeds("analyze a.png --out named --area mask.pgm");
    let area = |folder: &str| work.report(folder).area.unwrap();
    assert_eq!((area("piped/a").file.as_str(), area("piped/a").pixels), ("stdin", area("named/a").pixels));
    let ended = work.run_piped("why a.png 50,140 --area -", &mask);
    assert!(ended.code == 0 && ended.out.contains("outside"), "{} {}", ended.out, ended.err);
    for arguments in ["analyze - --out o --area -", "why - 1,1 --area -", "trace - --out t --area -"] {
        work.fails(2, arguments, "standard input cannot be both the photograph and the mask of --area");
    }
    let ended = work.run_piped("analyze a.png --out o --area -", b"no picture");
    assert_eq!((ended.code, ended.err.lines().count()), (2, 1), "{}", ended.err);
    assert!(ended.err.starts_with("error: stdin: "), "{}", ended.err);
    work.fails(2, "-", "the window cannot show standard input");
    work.fails(2, "screenshot - --out o", "the window cannot show standard input");
}

/// A name cannot give a terminal commands.
#[cfg(unix)]
#[test]
fn control_characters_of_a_name_are_not_written_to_the_terminal() {
    let work = WorkFolder::new();
    work.put("d/a\x1b[2J\nb.png", b"no picture");
    let ended = work.run("analyze d --out out");
    assert_eq!((ended.code, ended.err.lines().count()), (1, 1), "{:?}", ended.err);
    assert!(ended.err.starts_with("d/a\u{fffd}[2J\u{fffd}b.png: "), "{:?}", ended.err);
}

/// The bytes of names that are not UTF-8 are in the lines, and tell the results of a later call apart.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_not_utf_8_are_kept_in_the_lines() {
    use std::os::unix::ffi::OsStrExt;
    let work = WorkFolder::new();
    work.photo("x.png");
    fs::create_dir(work.path("d")).unwrap();
    for name in [&b"d/a\xFE.png"[..], b"d/a\xFF.png"] {
        fs::copy(work.path("x.png"), work.path("").join(std::ffi::OsStr::from_bytes(name))).unwrap();
    }
    work.succeeds("analyze d --out out");
    let encoded: Vec<_> = lines(&work, "out/results.jsonl")
        .iter()
        .map(|line| {
            [&line["name_encoded"], &line["file_encoded"]].map(|text| text.as_str().unwrap().to_owned())
        })
        .collect();
    assert_eq!(encoded, [["a%FE", "d/a%FE.png"], ["a%FF", "d/a%FF.png"]]);
    assert_eq!(work.succeeds("analyze d --out out").err.matches(": unchanged").count(), 2);
}

#[test]
fn names_may_be_as_long_as_the_file_system_allows() {
    let work = WorkFolder::new();
    let long = "n".repeat(251);
    work.photo(&format!("{long}.png"));
    work.succeeds(&format!("analyze {long}.png --out out"));
    work.succeeds(&format!("analyze {long}.png --out out"));
    assert_eq!(work.list("out"), [long]);
}

#[cfg(unix)]
#[test]
fn a_bad_entry_of_a_folder_is_a_line_and_the_rest_is_analyzed() {
    let work = WorkFolder::new();
    work.photo("d/a.png");
    std::os::unix::fs::symlink("nowhere.png", work.path("d/gone.png")).unwrap();
    fs::create_dir(work.path("d/sub")).unwrap();
    std::os::unix::fs::symlink("..", work.path("d/sub/loop")).unwrap();
    let ended = work.run("analyze d --out out");
    assert_eq!(ended.code, 1);
    let lines: Vec<&str> = ended.err.lines().collect();
    assert_eq!(lines.len(), 3, "{}", ended.err);
    assert!(lines[0].starts_with("d/gone.png: cannot be read: "), "{}", ended.err);
    assert!(lines[1].starts_with("d/sub/loop: cannot be read: "), "{}", ended.err);
    assert_eq!(work.list("out"), ["a", "results.jsonl"]);
}

/// `/dev/full` takes no bytes.
#[cfg(target_os = "linux")]
#[test]
fn a_standard_output_that_cannot_be_written_is_exit_1() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out");
    let tiny = tiny().display().to_string();
    for arguments in [
        "--help",
        "--version",
        "analyze --help",
        "why a.png 50,50",
        "trace a.png --out -",
        &format!("evaluate out --truth {tiny}"),
        &format!("evaluate out --truth {tiny} --json"),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut program = Command::new(env!("CARGO_BIN_EXE_dichroscope"));
        program.current_dir(work.path("")).args(arguments.split_whitespace()).stdout(full);
        let output = program.output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments}");
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1, "{arguments}");
    }
}

/// A program that analyzes a folder of many photographs again and again.
#[cfg(unix)]
fn start(work: &WorkFolder) -> std::process::Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_dichroscope"));
    program
        .current_dir(work.path(""))
        .args(["analyze", "d", "--out", "out", "--quiet", "--again", "--jobs", "2"]);
    program.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[cfg(unix)]
fn send(signal: &str, process: &std::process::Child) {
    let sent = Command::new("kill").args([signal, &process.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

/// Waits until the first result is there.
#[cfg(unix)]
fn wait_for_a_result(work: &WorkFolder) {
    let begin = Instant::now();
    while !work.path("out/results.jsonl").exists() {
        assert!(begin.elapsed() < Duration::from_mins(1), "no result after a minute");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[cfg(unix)]
fn many(count: usize) -> WorkFolder {
    let work = WorkFolder::new();
    for number in 0..count {
        work.photo(&format!("d/p{number:03}.png"));
    }
    work
}

/// The names in the folder of results that are no results and no lines.
#[cfg(unix)]
fn hidden(work: &WorkFolder) -> Vec<String> {
    work.list("out").into_iter().filter(|name| name.starts_with('.')).collect()
}

#[cfg(unix)]
#[test]
fn a_signal_ends_the_run_without_leftovers_and_says_what_is_done() {
    for signal in ["-INT", "-TERM"] {
        let work = many(300);
        let process = start(&work);
        wait_for_a_result(&work);
        send(signal, &process);
        let output = process.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(130), "{err}");
        assert!(err.starts_with("interrupted: ") && err.contains(" of 300 photographs are done"), "{err}");
        assert_eq!(hidden(&work), Vec::<String>::new());
        let done = lines(&work, "out/results.jsonl").len();
        assert_eq!(work.list("out").len(), done + 1, "a line for each result");
        assert!(done < 300);
    }
}

/// The wait for the other end of a named pipe ends with a signal.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_wait_for_a_pipe() {
    for command in ["analyze", "figures"] {
        let work = WorkFolder::new();
        assert!(Command::new("mkfifo").arg(work.path("pipe.png")).status().unwrap().success());
        let mut program = Command::new(env!("CARGO_BIN_EXE_dichroscope"));
        program.current_dir(work.path("")).args([command, "pipe.png", "--out", "out"]);
        let mut process = program.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // A signal before the program listens ends it as well, with another code.
        std::thread::sleep(Duration::from_secs(1));
        send("-INT", &process);
        let begin = Instant::now();
        let status = loop {
            if let Some(status) = process.try_wait().unwrap() {
                break status;
            }
            if begin.elapsed() > Duration::from_secs(20) {
                process.kill().unwrap();
                panic!("{command} still waits after 20 s");
            }
            std::thread::sleep(Duration::from_millis(10));
        };
        assert_eq!(status.code(), Some(130), "{command}");
    }
}

/// Every result is whole after a kill at any moment, and the next run removes what the killed one left.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_whole_results_and_the_next_one_tidies_up() {
    let work = many(12);
    let rounds = if std::env::var_os("DICHROSCOPE_LONG_TESTS").is_some() { 200 } else { 10 };
    for round in 0..rounds {
        let mut process = start(&work);
        std::thread::sleep(Duration::from_millis(40 + (round * 37) % 240));
        let _ = process.kill();
        process.wait().unwrap();
        for name in fs::read_dir(work.path("out")).into_iter().flatten().map(|entry| entry.unwrap()) {
            let name = name.file_name().into_string().unwrap();
            if !name.starts_with('.') && !name.contains(".jsonl") {
                assert_eq!(work.list(&format!("out/{name}")).len(), 16, "{name}");
                work.report(&format!("out/{name}"));
            }
        }
    }
    work.succeeds("analyze d --out out --quiet");
    assert_eq!((hidden(&work), work.list("out").len()), (Vec::new(), 13));
}

/// An earlier result survives a disk that is full, which a limit of the size of files stands for.
#[cfg(unix)]
#[test]
fn what_cannot_be_written_leaves_the_earlier_result() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out");
    let before = fs::read(work.path("out/a/report.json")).unwrap();
    let program = env!("CARGO_BIN_EXE_dichroscope");
    // A write beyond the limit fails instead of ending the program where the signal is ignored.
    let limited = |arguments: &str| {
        let call = format!("trap '' XFSZ; ulimit -f 8; {program} {arguments}");
        let output = Command::new("sh").args(["-c", &call]).current_dir(work.path("")).output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        (output, err)
    };
    work.put("t.jsonl", b"earlier");
    let (output, err) = limited("trace a.png --out t.jsonl");
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("t.jsonl") && err.lines().count() == 1, "{err}");
    assert_eq!(fs::read(work.path("t.jsonl")).unwrap(), b"earlier");
    let (output, err) = limited("analyze a.png --out out --window-size 8");
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.starts_with("a.png: cannot write out/a/"), "{err}");
    assert_eq!(err.matches("File too large").count(), 1, "{err}");
    assert_eq!(
        (work.list("out"), fs::read(work.path("out/a/report.json")).unwrap()),
        (vec!["a".to_owned()], before)
    );
}

/// Files of less than a kilobyte that declare as much as their formats allow, read with a gigabyte of address space.
#[cfg(target_os = "linux")]
#[test]
fn a_short_file_never_takes_a_gigabyte() {
    let work = WorkFolder::new();
    work.put("a.pgm", b"P5\n9999 9999\n255\n");
    work.put("a.hdr", b"#?RADIANCE\n\n-Y 9999 +X 9999\n");
    work.put(
        "a.jpg",
        b"\xff\xd8\xff\xc0\0\x11\x08\x27\x0f\x27\x0f\x03\x01\x22\0\x02\x11\0\x03\x11\0\xff\xd9",
    );
    let mut bmp = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bmp.extend([9999u32.to_le_bytes(), 9999u32.to_le_bytes()].concat());
    bmp.extend([1, 0, 24, 0].iter().chain(&[0; 24]).chain(&[7; 90]));
    work.put("a.bmp", &bmp);
    // 4 megapixels of one color, which is as much as is believed.
    let mut webp = Vec::new();
    let encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut webp);
    encoder.encode(&vec![90; 2000 * 1000 * 3], 2000, 1000, image::ExtendedColorType::Rgb8).unwrap();
    assert!(webp.len() < 1000);
    work.put("a.webp", &webp);
    let program = env!("CARGO_BIN_EXE_dichroscope");
    for name in ["a.pgm", "a.hdr", "a.jpg", "a.bmp", "a.webp"] {
        let call = format!("ulimit -v 1000000; {program} analyze {name} --out out --threads 2 --quiet");
        let output = Command::new("sh").args(["-c", &call]).current_dir(work.path("")).output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        let expected = i32::from(name != "a.webp");
        assert_eq!(output.status.code(), Some(expected), "{name}: {err}");
        assert_eq!(err.lines().count(), expected as usize, "{err}");
    }
}
