//! Pages of small pictures: what they hold, what they say where there is nothing to show, and that they do not depend on threads.

use super::*;
use crate::analysis::Session;
use crate::describe::Timings;
use crate::params::{Method, Params};
use crate::photo::{EncodingChoice, Photo, ReadOptions, decode};
use crate::raster::Raster;
use crate::truth::sample::Sample;
use crate::truth::{self, GroundTruth, Reference, ReportInput};
use std::sync::Arc;

fn scene_of(photo: Photo, params: &Params, truth: Option<GroundTruth>) -> Scene {
    let analysis = Session::new(Arc::clone(&photo.image)).run(params, &mut ()).unwrap();
    let reference = truth.as_ref().map(|truth| Reference { truth, camera: &photo.image.pixels });
    let report = truth::report(ReportInput {
        photo: &photo,
        sha256: "5a",
        params,
        analysis: &analysis,
        area: None,
        timings_ms: Timings::default(),
        reference,
    });
    let input =
        AnalyzedPhotograph { photo, sha256: "5a".into(), params: *params, analysis, area: None, truth };
    Scene::of_photograph(input, report.unwrap())
}

fn tiny(params: &Params) -> Scene {
    let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png")).unwrap();
    scene_of(decode(&bytes, "camera8.png", &ReadOptions::default()).unwrap(), params, None)
}

/// A picture of one color.
fn plain(width: usize, height: usize, color: [u8; 3]) -> Scene {
    let mut bytes = format!("P6 {width} {height} 255\n").into_bytes();
    bytes.extend(color.repeat(width * height));
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    scene_of(decode(&bytes, "plain.ppm", &options).unwrap(), &Params::default(), None)
}

/// Every element is closed by its own end, as `svg`, `td` and `p` need.
fn assert_balanced(html: &str) {
    const VOID: [&str; 5] = ["meta", "img", "br", "path", "rect"];
    let mut open: Vec<&str> = Vec::new();
    let body = html.split_once("</style>").unwrap().1;
    for tag in body.split('<').skip(1) {
        let tag = tag.split('>').next().unwrap();
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        if let Some(name) = tag.strip_prefix('/') {
            let last = open.pop();
            // The head was begun before the style.
            assert!(
                last == Some(name) || (last.is_none() && ["head", "html"].contains(&name)),
                "</{name}> after {last:?}"
            );
        } else if !VOID.contains(&name) && !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

/// A page without its pictures, whose text may contain any letters.
fn without_data(html: &str) -> String {
    let mut parts = html.split("base64,");
    let first = parts.next().unwrap().to_owned();
    parts.fold(first, |text, part| text + part.split_once('"').unwrap().1)
}

fn assert_alone(html: &str) {
    for outside in ["<script", "http:", "https:", "url(", "@import", "<link"] {
        assert!(!html.contains(outside), "{outside}");
    }
    assert!(html.split("src=\"").skip(1).all(|rest| rest.starts_with("data:image/png;base64,iVBOR")));
    assert!(
        html.split("href=\"").skip(1).all(|rest| rest.starts_with("data:") || rest.contains("-figures.html"))
    );
}

#[test]
fn a_page_holds_all_figures_and_tables_and_needs_nothing_else() {
    for params in [Params::default(), Params::paper()] {
        let html = page(&tiny(&params), None);
        assert_balanced(&html);
        assert_alone(&html);
        for number in 1..=13 {
            assert!(html.contains(&format!("<b>Figure {number}.</b>")), "{number}");
        }
        for counterpart in ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "15"] {
            assert!(
                html.contains(&format!("Counterpart in the paper: color figure {counterpart}.")),
                "{counterpart}"
            );
        }
        assert!(
            html.contains("color figures 12 to 14")
                && html.contains("tables 2 to 5")
                && html.contains("table 6")
        );
        assert_eq!(html.matches("class=\"absent\"").count(), 0, "nothing is missing");
        assert!(html.contains("<span>Phoenix</span>") && html.contains("Phoenix: "));
        assert!(!without_data(&html).contains("NaN"));
    }
}

#[test]
fn methods_without_planes_say_which_figures_they_lack() {
    for (method, figures) in [(Method::Phoenix, 7), (Method::TopDown, 6)] {
        let html = page(&tiny(&Params::of(method)), None);
        assert_balanced(&html);
        assert_eq!(html.matches("without this stage.").count(), 6, "{method:?}");
        assert_eq!(html.matches("class=\"absent\"").count(), figures + 1, "{method:?}, and the noise image");
        assert!(html.contains("<span>Phoenix</span>") == (method == Method::TopDown));
    }
}

#[test]
fn pages_are_the_same_at_any_number_of_threads() {
    let pages = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let scene = tiny(&Params::default());
            (page(&scene, Some("May 1990")), side_by_side(&[ComparedScene::of(&scene)], &[], None))
        })
    });
    assert!(pages[0] == pages[1] && pages[0] == pages[2]);
    assert!(pages[0].0.contains("May 1990") && !pages[0].1.contains("May 1990"));
}

#[test]
fn what_a_picture_cannot_have_is_said_in_a_sentence() {
    for (width, height) in [(1, 1), (30, 20)] {
        for color in [[0, 0, 0], [90, 60, 30], [255, 255, 255]] {
            let (html, is_black) = (page(&plain(width, height, color), None), color == [0; 3]);
            assert_balanced(&html);
            assert_alone(&html);
            assert!(html.contains("Not shown: there is no planar hypothesis, as "), "{color:?}");
            assert!(html.contains("The color of the light is not known"), "{color:?}");
            assert!(html.contains("<p class=\"absent\">Not shown: there is no region, as ") || !is_black);
            assert!(!without_data(&html).contains("NaN"), "{color:?}");
        }
    }
}

#[test]
fn a_row_and_a_white_patch_are_inside_of_the_photograph() {
    let scene = || plain(30, 20, [90, 60, 30]);
    let error = scene().with_row(20).err().unwrap();
    assert_eq!(error.to_string(), "there is no row 20: the photograph has 20 rows, counted from 0");
    for (corner, size) in [([30, 0], [5, 5]), ([25, 5], [6, 3]), ([0, usize::MAX], [1, 1])] {
        let error = SceneError::PatchOutside { corner, size, photograph: (30, 20) };
        assert_eq!(scene().with_white_patch(corner, size).err(), Some(error));
    }
    let error = plain(30, 20, [0; 3]).with_white_patch([0, 0], [5, 5]).err();
    assert_eq!(error, Some(SceneError::Patch(0, 0)));
    let html = page(&scene().with_white_patch([25, 5], [5, 3]).unwrap().with_row(3).unwrap(), None);
    assert!(html.contains("(0.80,\u{a0}0.53,\u{a0}0.27)"), "the direction of (90, 60, 30)");
}

#[test]
fn the_light_is_compared_with_the_ground_truth() {
    let sample = Sample::find("cups3_yellow").unwrap();
    let photo = decode(sample.camera, "camera8.png", &ReadOptions::default()).unwrap();
    let scene = scene_of(photo, &Params::paper(), Some(sample.truth().unwrap())).named("cups <3>");
    let html = page(&scene, None);
    assert!(html.contains("from the ground truth, is (0.73,\u{a0}0.66,\u{a0}0.19)"));
    assert!(html.contains("Accuracy against the ground truth") && html.contains("cups &lt;3&gt;"));
    let compared = side_by_side(&[ComparedScene::of(&scene)], &["a-figures.html".into()], None);
    assert_balanced(&compared);
    assert_alone(&compared);
    assert!(
        compared.contains("The light of each photograph") && compared.contains("<a href=\"a-figures.html\">")
    );
}

#[test]
fn another_segmentation_is_shown_beside_the_own_one() {
    let other = |width, height| OtherSegmentation {
        name: "Phoenix".into(),
        about: "Three features.".into(),
        labels: Raster::filled(width, height, 1u16),
    };
    let html = page(&plain(30, 20, [0; 3]).with_other(other(30, 20)).unwrap(), None);
    assert!(html.contains("Phoenix: 1\u{a0}region; the refined method: 0\u{a0}regions. Three features."));
    assert!(plain(30, 20, [0; 3]).with_other(other(20, 30)).is_err());
}

#[test]
fn light_beyond_white_is_shown_darker_and_said_so() {
    let photo = |bright: f32| {
        let mut photo =
            decode(b"P6 2 1 255\n\x09\x09\x09\x09\x09\x09", "made.ppm", &ReadOptions::default()).unwrap();
        photo.image = Arc::new(crate::photo::LinearImage::new(
            Raster::filled(40, 40, [bright, bright / 2.0, 3.0]),
            None,
        ));
        photo
    };
    assert!(
        page(&scene_of(photo(2040.0), &Params::default(), None), None).contains("stops darker than the file")
    );
    assert!(
        page(&scene_of(photo(0.5), &Params::default(), None), None).contains("stops brighter than the file")
    );
}
