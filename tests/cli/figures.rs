//! `dichroscope figures`: the pages that it writes, and what it says of calls and photographs that are wrong.

use crate::folder::WorkFolder;
use std::fs;

#[test]
fn a_photograph_has_a_page_that_needs_nothing_else() {
    let work = WorkFolder::new();
    work.photo("cup.png");
    let ended = work.succeeds("figures cup.png --out pages --date 1990");
    assert_eq!(ended.out, "pages/cup-figures.html\n");
    assert_eq!(work.list("pages"), ["cup-figures.html"]);
    let html = fs::read_to_string(work.path("pages/cup-figures.html")).unwrap();
    assert!(html.starts_with("<!DOCTYPE html>") && html.contains("<h1>Figures of cup.png</h1>"));
    assert!(html.contains(" 1990.") && !html.contains("<script") && !html.contains("http"));
}

#[test]
fn the_page_is_the_same_at_any_number_of_threads_and_from_standard_input() {
    let work = WorkFolder::new();
    work.photo("cup.png");
    for threads in [1, 3] {
        work.succeeds(&format!("figures cup.png --method paper --threads {threads} --out {threads}"));
    }
    let page = |folder: &str, name: &str| fs::read_to_string(work.path(folder).join(name)).unwrap();
    assert!(page("1", "cup-figures.html") == page("3", "cup-figures.html"));
    let bytes = fs::read(work.path("cup.png")).unwrap();
    let ended = work.run_piped("figures - --method paper --out piped", &bytes);
    assert_eq!((ended.code, ended.out.as_str()), (0, "piped/stdin-figures.html\n"));
    assert_eq!(
        page("piped", "stdin-figures.html").replace("stdin", "cup.png"),
        page("1", "cup-figures.html")
    );
}

#[test]
fn several_photographs_have_a_page_side_by_side_with_links() {
    let work = WorkFolder::new();
    work.photo("a/cam era.png");
    work.photo("b/cam era.png");
    work.put("b/broken.png", b"no picture");
    let ended = work.run("figures a b --truth TINY --out pages");
    assert_eq!(ended.code, 1, "{}", ended.err);
    assert!(ended.err.contains("broken.png"), "{}", ended.err);
    let pages = "pages/a/cam era-figures.html\npages/b/cam era-figures.html\npages/figures.html\n";
    assert_eq!(ended.out.lines().count(), 3, "{}", ended.out);
    assert_eq!(ended.out, pages);
    let html = fs::read_to_string(work.path("pages/figures.html")).unwrap();
    assert!(html.contains("<a href=\"a/cam%20era-figures.html\">a/cam era</a>"));
    assert!(html.contains("The light of each photograph") && html.contains("independent measurement"));
}

#[test]
fn without_a_photograph_there_are_the_three_lamps() {
    let work = WorkFolder::new();
    work.succeeds("figures --method paper --out pages");
    let names =
        ["cups3_pink-figures.html", "cups3_white-figures.html", "cups3_yellow-figures.html", "figures.html"];
    assert_eq!(work.list("pages"), names);
    let html = fs::read_to_string(work.path("pages/figures.html")).unwrap();
    // The measured lights of tables 3, 4 and 5.
    for measured in ["(0.73, 0.66, 0.19)", "(0.58, 0.57, 0.58)", "(0.71, 0.59, 0.38)"] {
        assert!(html.replace('\u{a0}', " ").contains(measured), "{measured}");
    }
    work.fails(2, "figures --truth TINY --out pages", "have their own ground truth");
}

#[test]
fn a_wrong_call_is_found_out_before_any_work() {
    let work = WorkFolder::new();
    work.photo("cup.png");
    work.fails(2, "figures cup.png", "--out");
    work.fails(2, "figures cup.png --out pages --white 1,2,3", "as in 120,40,30,30");
    work.fails(2, "figures cup.png --out pages --truth nowhere", "no such folder");
    work.fails(2, "figures cup.png --out cup.png", "is a file");
    work.fails(1, "figures cup.png --out pages --row 9999", "there is no row 9999");
    work.fails(1, "figures cup.png --out pages --white 9999,0,3,3", "reaches beyond the photograph");
    work.fails(1, "figures missing.png --out pages", "missing.png");
    assert!(!work.path("pages").exists());
}

#[test]
fn a_white_patch_is_the_independent_measurement() {
    let work = WorkFolder::new();
    work.photo("cup.png");
    work.succeeds("figures cup.png --out pages --row 40 --white 60,40,9,9");
    let html = fs::read_to_string(work.path("pages/cup-figures.html")).unwrap();
    assert!(html.contains("from a white patch of 9 \u{d7} 9 pixels at (60, 40)"));
    assert!(html.contains("Along row 40 of the photograph"));
    work.fails(
        1,
        "figures cup.png --out other --white 170,40,9,9",
        "reaches beyond the photograph, which has 178",
    );
    work.fails(2, "figures cup.png --out other --white -1,0,9,9", "expected column, row, columns and rows");
    assert!(!work.path("other").exists());
}
