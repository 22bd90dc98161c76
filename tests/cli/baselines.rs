//! The earlier methods on the command line, the count of Gershon's test, and what was made elsewhere.

use crate::folder::{WorkFolder, tiny};
use dichroscope::params::{Method, PhoenixSettings};
use serde_json::Value;
use std::fs;

#[test]
fn by_hand_splits_the_pixels_of_a_mask_and_says_what_it_needs() {
    let work = WorkFolder::new();
    work.photo("a.png");
    let image = dichroscope::photo::read(&work.path("a.png"), &dichroscope::photo::ReadOptions::default())
        .unwrap()
        .image;
    let (width, height) = (image.width(), image.height());
    let mut mask = format!("P5 {width} {height} 255\n").into_bytes();
    mask.extend((0..width * height).map(|pixel| if pixel % width < width / 2 { 255u8 } else { 0 }));
    work.put("mask.pgm", &mask);
    work.succeeds("analyze a.png --out out --method by-hand --area mask.pgm");
    let report = work.report("out/a");
    assert_eq!((report.params.method, report.params.asked().method), (Method::ByHand, Method::ByHand));
    assert!(report.area.is_some() && report.regions.len() <= 1);
    for command in [
        "analyze a.png --out other",
        "why a.png 1,1",
        "trace a.png --out t.jsonl",
        "figures a.png --out pages",
    ] {
        work.fails(2, &format!("{command} --method by-hand"), "give their mask with --area MASK.png");
    }
    work.fails(
        2,
        "analyze a.png --out other --method by-hand --area mask.pgm --with edge_body",
        "belong to `--method refined`",
    );
    let lit = (0..width * height)
        .find(|&pixel| pixel % width < width / 2 && image.pixels[pixel][0] > 60.0)
        .unwrap();
    let why = work
        .succeeds(&format!("why a.png {},{} --method by-hand --area mask.pgm", lit % width, lit / width))
        .out;
    assert!(why.contains("it was marked and belongs to hypothesis 1"), "{why}");
    let trace = work.succeeds("trace a.png --out t.jsonl --method by-hand --area mask.pgm");
    assert!(trace.out.is_empty() || !trace.out.contains("error"));
    let lines = fs::read_to_string(work.path("t.jsonl")).unwrap();
    assert!(lines.contains("line of the marked") && lines.contains("marked pixels"), "the steps of 1987");
    work.succeeds("figures a.png --out pages --method by-hand --area mask.pgm");
    let first = fs::read(work.path("out/a/body.exr")).unwrap();
    work.succeeds("analyze a.png --out one --method by-hand --area mask.pgm --threads 1");
    assert_eq!(first, fs::read(work.path("one/a/body.exr")).unwrap());
}

#[test]
fn phoenix_takes_features_and_numbers_and_its_report_says_so() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds(
        "analyze a.png --out out --method phoenix --features R,g --phoenix maxmin=200 --phoenix noise=20",
    );
    let params = work.report("out/a").params;
    let expected = PhoenixSettings {
        features: "R,G".parse().unwrap(),
        maxmin: 200,
        noise: 20,
        ..PhoenixSettings::default()
    };
    assert_eq!((params.method, params.phoenix), (Method::Phoenix, Some(expected)));
    assert_eq!(params.asked().phoenix, expected);
    work.put("p.toml", b"method = \"phoenix\"\n[phoenix]\nfeatures = \"I\"\nsplitmin = 90\n");
    work.succeeds("analyze a.png --out out --params p.toml --phoenix depth=3");
    let phoenix = work.report("out/a").params.phoenix.unwrap();
    assert_eq!((phoenix.features.to_string().as_str(), phoenix.splitmin, phoenix.depth), ("I", 90, 3));
    work.succeeds("analyze a.png --out out --method top-down");
    let report = work.report("out/a");
    assert_eq!(
        (report.params.method, report.params.phoenix, report.illuminant.direction),
        (Method::TopDown, None, None)
    );
    let why = work.succeeds("why a.png 40,20 --method phoenix").out;
    assert!(why.contains("it belongs to hypothesis 1, a part of the picture"), "{why}");
    assert!(why.contains("its hue 205 puts it into"), "{why}");
    work.fails(2, "analyze a.png --out out --features R", "belong to `--method phoenix`");
    work.fails(
        2,
        "analyze a.png --out out --method phoenix --features X",
        "is no feature: R, G, B, I (intensity)",
    );
    work.fails(
        2,
        "analyze a.png --out out --method phoenix --phoenix valley=3",
        "is no parameter of Phoenix: depth, ",
    );
    work.fails(
        2,
        "analyze a.png --out out --method phoenix --phoenix hsmooth=0",
        "phoenix hsmooth = 0: expected",
    );
    work.fails(
        2,
        "analyze a.png --out out --method phoenix --with edge_body",
        "belong to `--method refined`",
    );
}

#[test]
fn evaluate_counts_which_test_of_candidates_was_right() {
    let work = WorkFolder::new();
    work.succeeds("analyze TINY/camera8.png --out out --method paper");
    let text = work.succeeds("evaluate out --truth TINY --candidates").out;
    assert!(text.contains("50 % right") && text.lines().last().unwrap().starts_with("SUM"), "{text}");
    let all: Value =
        serde_json::from_str(&work.succeeds("evaluate out --truth TINY --candidates --json").out).unwrap();
    let counts = &all["candidates"]["camera8"];
    let number = |name: &str| counts[name].as_u64().unwrap();
    assert!(number("tests") >= number("highlights") && number("highlights") > 0, "{counts}");
    assert!(number("right_by_position") <= number("tests"));
}

#[test]
fn evaluate_counts_no_candidates_of_a_result_that_is_restricted_to_an_area() {
    let work = WorkFolder::new();
    work.put("mask.pgm", &[&b"P5 178 150 255\n"[..], &vec![255; 178 * 150]].concat());
    work.succeeds("analyze TINY/camera8.png --out out --area mask.pgm");
    work.succeeds("evaluate out --truth TINY");
    work.fails(
        1,
        "evaluate out --truth TINY --candidates",
        "the area mask.pgm of this result is not at hand",
    );
}

#[test]
fn what_was_made_elsewhere_is_held_against_a_result() {
    let work = WorkFolder::new();
    work.succeeds("analyze TINY/camera8.png --out out");
    let body = tiny().join("body.exr").display().to_string();
    let held =
        format!("compare out/camera8 --labels TINY/labels.png --diffuse {body} --truth TINY --out held");
    let text = work.succeeds(&held).out;
    assert!(text.starts_with("agreement") || text.contains("agreement"), "{text}");
    assert_eq!(work.list("held"), ["difference.png", "diffuse.png", "labels.png"]);
    let all: Value = serde_json::from_str(&work.succeeds(&format!("{held} --json")).out).unwrap();
    assert_eq!(all["elsewhere"]["ari"], 1.0, "the true labels: {all}");
    assert!(all["elsewhere"]["psnr_body"].as_f64().unwrap() > 60.0, "the true body: {all}");
    assert!(all["result"]["ari"].as_f64().unwrap() > 0.9 && all["agreement"]["ari"].as_f64().unwrap() > 0.9);

    // The result's own colored regions are a label map too, in which each color is a label.
    let own = "compare out/camera8 --labels out/camera8/stage-5-clipping.png --json";
    let all: Value = serde_json::from_str(&work.succeeds(own).out).unwrap();
    assert!(all["agreement"]["shared"] == 1.0 && all["agreement"].get("psnr_body").is_none(), "{all}");
    work.fails(2, "compare out/camera8", "expected --labels FILE, --diffuse FILE or both");
    work.fails(2, "compare out --labels TINY/labels.png", "holds no result");
    fs::copy("assets/plastic8_white/labels.png", work.path("other.png")).unwrap();
    work.fails(2, "compare out/camera8 --labels other.png", "the label map is 512\u{d7}480");
}
