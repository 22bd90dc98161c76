//! Tests of the parameters of `dichroscope analyze`: defaults, the parameter file, flags, presets and readings.

use crate::folder::WorkFolder;
use dichroscope::params::{IlluminantSetting, Method, Readings, Refine, Setting};

#[test]
fn defaults_give_way_to_the_file_and_the_file_to_flags() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put(
        "p.toml",
        b"camera_noise = 3\nwindow_size = 12\nmin_area = 400\n[refine]\nsecond_look = false\n",
    );
    work.succeeds(
        "analyze a.png --out out --params p.toml --window-size 8 --min-area auto --without edge_body",
    );
    let params = work.report("out/a").params;
    assert_eq!(params.method, Method::Refined);
    assert_eq!(params.camera_noise.asked, Setting::Value(3.0));
    assert_eq!(params.window_size.asked, Setting::Value(8.0));
    assert_eq!(params.min_area.asked, Setting::Auto);
    assert_eq!(params.cylinder_width.asked, Setting::Auto, "left to the method");
    assert!(!params.refine.second_look && !params.refine.edge_body && params.refine.robust_lines);

    work.succeeds("analyze a.png --out out --params p.toml --with second_look --auto --window-size 8");
    let params = work.report("out/a").params;
    assert_eq!(params.camera_noise.asked, Setting::Auto);
    assert_eq!(params.window_size.asked, Setting::Value(8.0));
    assert!(params.refine.second_look);

    work.put("paper.toml", b"method = \"paper\"\nslice_width = 5\n");
    work.succeeds("analyze a.png --out out --params paper.toml");
    let params = work.report("out/a").params;
    assert_eq!((params.method, params.slice_width.asked), (Method::Paper, Setting::Value(5.0)));
    assert_eq!(params.camera_noise.asked, Setting::Value(2.5), "table 6, because the file says paper");
    work.succeeds("analyze a.png --out out --params paper.toml --method refined");
    assert_eq!(work.report("out/a").params.camera_noise.asked, Setting::Auto);
}

#[test]
fn the_papers_method_takes_readings_and_added_refinements() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out --method paper");
    let params = work.report("out/a").params;
    assert_eq!((params.refine, params.readings), (Refine::all(false), Some(Readings::PAPER)));

    work.succeeds(
        "analyze a.png --out out --method paper --with edge_body --reading fill_holes --without-reading every_pixel",
    );
    let params = work.report("out/a").params;
    assert_eq!(params.refine, Refine { edge_body: true, ..Refine::all(false) });
    let readings = Readings { fill_holes: true, every_pixel: false, ..Readings::PAPER };
    assert_eq!(params.readings, Some(readings));

    let file = b"method = \"paper\"\n[paper]\nfill_holes = true\nwith = [\"edge_body\", \"all_seeds\"]\n";
    work.put("paper.toml", file);
    work.succeeds(
        "analyze a.png --out out --params paper.toml --without-reading fill_holes --without all_seeds",
    );
    let params = work.report("out/a").params;
    assert_eq!(params.refine, Refine { edge_body: true, ..Refine::all(false) });
    assert_eq!(params.readings, Some(Readings { fill_holes: false, ..Readings::PAPER }));

    let ended = work.succeeds("analyze a.png --out out --params paper.toml --method refined");
    assert!(ended.err.starts_with("warning: paper.toml:"), "{}", ended.err);
    assert!(ended.err.contains(": [paper] is not used, because"), "{}", ended.err);
    let params = work.report("out/a").params;
    assert_eq!((params.refine, params.readings), (Refine::all(true), None), "the table is the paper's alone");
}

#[test]
fn a_preset_is_a_column_of_table_6_and_gives_way_to_flags() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.succeeds("analyze a.png --out out --preset cups_pink --min-area 300");
    let params = work.report("out/a").params;
    assert_eq!((params.method, params.window_size.asked), (Method::Paper, Setting::Value(15.0)));
    assert_eq!(params.min_area.asked, Setting::Value(300.0));
    work.succeeds("analyze a.png --out out --preset cups_white --method refined");
    let params = work.report("out/a").params;
    assert_eq!((params.method, params.slice_width.asked), (Method::Refined, Setting::Value(6.0)));
}

#[test]
fn a_light_can_be_given_and_the_report_says_so() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put("p.toml", b"illuminant = [1, 1, 1]\n");
    work.succeeds("analyze a.png --out out --params p.toml --illuminant 0,3,4");
    let report = work.report("out/a");
    assert_eq!(report.params.illuminant.asked, IlluminantSetting::Given([0.0, 3.0, 4.0]));
    assert_eq!(report.illuminant.direction, Some([0.0, 0.6, 0.8]));
    assert!(report.illuminant.given);
    work.succeeds("analyze a.png --out out --params p.toml --illuminant auto");
    assert!(!work.report("out/a").illuminant.given);
    work.fails(2, "analyze a.png --out out --illuminant 1,-1,0", "illuminant = [1.0, -1.0, 0.0]: expected");
    work.fails(2, "analyze a.png --out out --illuminant white", "neither three numbers");
}

#[test]
fn a_second_lamp_can_be_given_and_the_report_says_so() {
    let work = WorkFolder::new();
    work.photo("a.png");
    work.put("p.toml", b"illuminant = [1, 1, 1]\nsecond_illuminant = [1, 2, 3]\n");
    work.succeeds("analyze a.png --out out --params p.toml --second-illuminant 2,3,6");
    let report = work.report("out/a");
    assert_eq!(report.params.second_illuminant.asked, IlluminantSetting::Given([2.0, 3.0, 6.0]));
    let second = report.illuminant.second.unwrap();
    assert!(second.given && second.interval_deg.is_none(), "{second:?}");
    let of_sevenths = second.direction.iter().zip([2.0, 3.0, 6.0]);
    assert!(of_sevenths.clone().all(|(band, sevenths)| (band - sevenths / 7.0).abs() < 1e-12), "{second:?}");
    assert_eq!(report.params.second_illuminant.used, Some(second.direction));
    work.succeeds("analyze a.png --out out --params p.toml --second-illuminant auto");
    assert!(work.report("out/a").illuminant.second.is_none(), "beside a given light none is sought");
    let start = "second_illuminant = [1.0, 0.0, 1.0]: expected `auto` or three numbers above 0";
    work.fails(2, "analyze a.png --out out --second-illuminant 1,0,1", start);
    work.fails(
        2,
        "analyze a.png --out out --method paper --second-illuminant 1,2,3",
        "second_illuminant = [1.0, 2.0, 3.0] with method = paper: expected `auto`",
    );
    work.fails(
        2,
        "analyze a.png --out out --illuminant 1,1,1 --second-illuminant 2,2,2.01",
        "expected a color at least 1\u{b0} from illuminant = [1.0, 1.0, 1.0]",
    );
    work.put("p.toml", b"illuminant = [1, 1, 1]\nsecond_illuminant = [1, 0, 3]\n");
    work.fails(2, "analyze a.png --out out --params p.toml", "p.toml: second_illuminant = [1.0, 0.0, 3.0]");
}

#[test]
fn mistakes_in_the_file_are_named_with_their_line() {
    let work = WorkFolder::new();
    work.photo("a.png");
    for (text, says) in [
        ("window_size = 12\nwindowsize = 12\n", "p.toml:2: unknown field `windowsize`"),
        ("[refine]\nmagic = true\n", "p.toml:2: unknown field `magic`"),
        ("window_size = \n", "p.toml:1: "),
        ("\nmethod = \"1990\"\n", "p.toml:2: unknown variant `1990`"),
        ("illuminant = \"white\"\n", "p.toml:1: \"white\" is neither three numbers nor `auto`"),
        ("illuminant = [0, 0, 0]\n", "p.toml: illuminant = [0.0, 0.0, 0.0]: expected"),
        ("min_area = 2\n", "p.toml: min_area = 2: expected `auto` or a whole number from 4"),
    ] {
        work.put("p.toml", text.as_bytes());
        work.fails(2, "analyze a.png --out out --params p.toml", says);
    }
    work.fails(2, "analyze a.png --out out --params none.toml", "cannot read none.toml");
}
