use super::*;
use crate::export::colored;
use crate::intrinsic::{Intrinsic, Reason};
use crate::raster::{PixelIndex, RegionId};
use crate::segment::{MatteRegions, Windows};
use crate::trace::Class;
use crate::view::testing::{divided, gray, labels, picture, shown};
use crate::view::{Item, Selection};
use std::sync::Arc;

/// Draws which pixels have which of the `named` colors, others as `.`.
#[track_caller]
fn check(painted: &Raster<[u8; 4]>, named: &[(char, [u8; 4])], expected: &[&str]) {
    let name =
        |pixel: &[u8; 4]| named.iter().find(|(_, color)| color == pixel).map_or('.', |(name, _)| *name);
    let drawn: Vec<String> =
        (0..painted.height()).map(|y| painted.row(y).iter().map(name).collect()).collect();
    assert_eq!(drawn, expected);
}

const ROWS: [&str; 4] = ["11111", "11122", ".1122", "....2"];

#[test]
fn light_goes_through_exposure_srgb_and_gamma() {
    let picture = picture(2, &[[255, 54, 0], [27, 255, 1]]);
    let plain = paint(Layer::Input, &picture, None, None, &Look::default());
    assert_eq!(plain.as_slice(), [[255, 127, 0, 255], [92, 255, 13, 255]]);
    let brighter = Look { exposure_ev: 1.0, ..Look::default() };
    assert_eq!(paint(Layer::Input, &picture, None, None, &brighter)[1][0], 127);
}

#[test]
fn a_layer_without_a_result_shows_the_photograph() {
    let (picture, other) = (gray(&ROWS, 99), gray(&["....."], 99));
    let photograph = paint(Layer::Input, &picture, None, None, &Look::default());
    let foreign = shown(&other);
    for layer in Layer::ALL {
        assert_eq!(paint(layer, &picture, None, None, &Look::default()), photograph);
        assert_eq!(paint(layer, &picture, Some(&foreign), None, &Look::default()), photograph);
    }
    for layer in Layer::ALL {
        let painted = paint(layer, &picture, Some(&shown(&picture)), None, &Look::default());
        assert_eq!((painted.width(), painted.height()), (5, 4), "{layer:?}");
        assert!(painted.as_slice().iter().all(|pixel| pixel[3] == 255), "{layer:?}");
    }
}

#[test]
fn fills_cover_and_outlines_stay_inside() {
    let picture = gray(&ROWS, 255);
    let shown = divided(&picture, &ROWS);
    let opaque = Look { opacity: 1.0, ..Look::default() };
    let named = [('1', [10, 10, 10, 255]), ('2', [20, 20, 20, 255])];
    check(&paint(Layer::Regions, &picture, Some(&shown), None, &opaque), &named, &ROWS);
    let outlines = Look { fill: Fill::Outline, opacity: 0.1, ..opaque };
    let expected = ["...11", "1.122", ".112.", "....2"];
    check(&paint(Layer::Regions, &picture, Some(&shown), None, &outlines), &named, &expected);
}

#[test]
fn half_opaque_is_half_way_and_what_is_not_selected_is_dimmed() {
    let picture = gray(&ROWS, 255);
    let shown = divided(&picture, &ROWS);
    let look = Look { opacity: 0.5, selected: RegionId::from_label(2), ..Look::default() };
    let painted = paint(Layer::Regions, &picture, Some(&shown), None, &look);
    // 255 + (20 − 255)·128/255 and 255 + (10 − 255)·45/255.
    assert_eq!((painted[9][0], painted[0][0], painted[10][0]), (137, 212, 255));
}

#[test]
fn earlier_regions_have_the_colors_of_the_regions_that_overlap_them_most() {
    let picture = gray(&ROWS, 255);
    let mut shown = divided(&picture, &ROWS);
    let earlier = labels(&["33355", "33355", "4...7", "....7"]);
    let matte = MatteRegions { labels: earlier, ..MatteRegions::clone(&shown.analysis.matte) };
    shown.analysis.matte = Arc::new(matte);
    let look = Look { opacity: 1.0, ..Look::default() };
    let named = [('1', [10, 10, 10, 255]), ('2', [20, 20, 20, 255]), ('x', [150, 150, 150, 255])];
    let expected = ["11111", "11111", "x...2", "....2"];
    check(&paint(Layer::Linear, &picture, Some(&shown), None, &look), &named, &expected);
}

#[test]
fn windows_have_the_papers_colors_and_areas_those_of_the_stage_pictures() {
    let rows = [".........................."; 22];
    let picture = gray(&rows, 255);
    let mut shown = shown(&picture);
    let classes = [Some(Class::Point), Some(Class::Line), None];
    let classes = classes.into_iter().chain([Some(Class::Plane), Some(Class::Volume), None]).chain([None; 3]);
    let classes = Raster::from_vec(3, 3, classes.collect()).unwrap();
    let windows = Windows { classes, ..Windows::clone(&shown.analysis.windows) };
    shown.analysis.windows = Arc::new(windows);
    let areas = (0..26 * 22).map(|i| [7, 0, 9][i % 26 / 10]).collect();
    shown.analysis.areas = Arc::new(Raster::from_vec(26, 22, areas).unwrap());
    let look = Look { opacity: 1.0, ..Look::default() };
    let painted = paint(Layer::Classes, &picture, Some(&shown), None, &look);
    let at = |x: usize, y: usize| <[u8; 3]>::try_from(&painted.row(y)[x][..3]).unwrap();
    let found = [at(0, 0), at(19, 9), at(9, 19), at(10, 10), at(20, 0), at(0, 20)];
    let [yellow, red, green, blue] =
        legend(Layer::Classes).try_into().map(|e: [LegendEntry; 4]| e.map(|e| e.color)).unwrap();
    assert_eq!(found, [yellow, red, green, blue, [255; 3], [255; 3]]);

    let painted = paint(Layer::Areas, &picture, Some(&shown), None, &look);
    let expected = colored(shown.areas());
    for (pixel, color) in painted.as_slice().iter().zip(expected.as_slice()) {
        assert_eq!(pixel[..3], if *color == [0; 3] { [255; 3] } else { *color });
    }
}

#[test]
fn masks_have_different_colors_and_the_most_severe_is_shown() {
    let mut colors = vec![[90u8; 3]; 12];
    (colors[0], colors[9]) = ([255; 3], [3; 3]);
    let picture = picture(6, &colors);
    let mut shown = shown(&picture);
    shown.area = Some(Arc::new(labels(&["111111", "11111."]).map(|&label| label == 1)));
    let look = Look { opacity: 1.0, ..Look::default() };
    let painted = paint(Layer::Masks, &picture, Some(&shown), None, &look);
    let named: Vec<(char, [u8; 4])> = legend(Layer::Masks)
        .iter()
        .map(|entry| {
            (entry.name.chars().next().unwrap(), [entry.color[0], entry.color[1], entry.color[2], 255])
        })
        .collect();
    check(&painted, &named, &["cb....", "bb.d.o"]);
}

#[test]
fn noise_and_difference_are_gray_at_zero() {
    let picture = gray(&["....."], 100);
    let mut now = shown(&picture);
    let mut noise = Raster::filled(5, 1, 0.0f32);
    noise.as_mut_slice()[1..].copy_from_slice(&[10.0, -10.0, 5.0, -99.0]);
    let mut body = now.analysis.intrinsic.body.clone();
    body.as_mut_slice()[1..3].copy_from_slice(&[[164.0, 36.0, 132.0], [900.0, 0.0, 100.0]]);
    let before = shown(&picture);
    now.analysis.intrinsic = Arc::new(Intrinsic { body, noise, ..Intrinsic::clone(&now.analysis.intrinsic) });
    let grays = |layer, pinned: Option<&ResultSnapshot>| -> Vec<[u8; 4]> {
        paint(layer, &picture, Some(&now), pinned, &Look::default()).into_vec()
    };
    let levels: Vec<u8> = grays(Layer::Noise, None).iter().map(|pixel| pixel[0]).collect();
    assert_eq!(levels, [128, 255, 1, 192, 0], "the slice is 10 counts to either side");
    let difference = grays(Layer::Difference, Some(&before));
    assert_eq!(difference[..3], [[128, 128, 128, 255], [255, 1, 192, 255], [255, 0, 128, 255]]);
    assert_eq!(grays(Layer::Difference, None), [[128, 128, 128, 255]; 5]);
}

#[test]
fn confidence_is_gray_and_each_reason_has_its_color() {
    let picture = gray(&["....."], 100);
    let mut now = shown(&picture);
    let confidence = Raster::from_vec(5, 1, vec![0.0, 0.5, 1.0, 2.0, f32::NAN]).unwrap();
    let mut reasons = now.analysis.intrinsic.reasons.map(|_| Reason::Explained);
    reasons.as_mut_slice()[1..4].copy_from_slice(&[Reason::Shadow, Reason::Texture, Reason::ClippedAllBands]);
    let intrinsic = Intrinsic { confidence, reasons, ..Intrinsic::clone(&now.analysis.intrinsic) };
    now.analysis.intrinsic = Arc::new(intrinsic);
    let look = Look { opacity: 1.0, ..Look::default() };
    let drawn = |layer| paint(layer, &picture, Some(&now), None, &look).into_vec();
    let levels: Vec<u8> = drawn(Layer::Confidence).iter().map(|pixel| pixel[0]).collect();
    assert_eq!(levels, [0, 128, 255, 255, 0]);
    let color = |name: &str| legend(Layer::Reasons).iter().find(|entry| entry.name == name).unwrap().color;
    let drawn: Vec<[u8; 3]> = drawn(Layer::Reasons).iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    let expected = [color("shadow"), color("texture"), color("clipped in all bands")];
    assert_eq!(drawn[1..4], expected);
    assert_eq!(drawn[0], drawn[4], "what is explained is the photograph");
    assert_eq!(legend(Layer::Reasons).len() + 1, Reason::ALL.len());
}

#[test]
fn legends_explain_with_colors_that_differ() {
    for layer in Layer::ALL {
        let legend = legend(layer);
        for (index, entry) in legend.iter().enumerate() {
            assert!(legend[..index].iter().all(|other| other.color != entry.color), "{layer:?}");
            assert!(!entry.name.is_empty() && !entry.tooltip.is_empty());
        }
    }
}

#[test]
fn marks_are_a_fill_an_outline_and_what_is_hovered() {
    let picture = gray(&ROWS, 100);
    let shown = divided(&picture, &ROWS);
    let none = Selection::default();
    assert_eq!(marks(&picture, Some(&shown), &none, Some(Item::Pixel(PixelIndex::new(3)))), None);
    assert_eq!(
        marks(&picture, None, &none, Some(Item::Region(RegionId::from_index(1 - 1)))),
        None,
        "there is no result"
    );
    let mask = labels(&["1111.", "1111.", "1111.", "...1."]).map(|&label| label == 1);
    let marked = Selection { marked: Some(Arc::new(mask)), ..Selection::default() };
    let named = [
        ('f', [0xE8, 0xA3, 0x3D, 72]),
        ('o', [0xE8, 0xA3, 0x3D, 255]),
        ('h', [255, 255, 255, 220]),
        ('a', [0, 0, 0, 150]),
    ];
    let painted =
        marks(&picture, Some(&shown), &marked, Some(Item::Region(RegionId::from_index(2 - 1)))).unwrap();
    // The dark line around the hovered region does not cover the outline of the marked pixels.
    check(&painted, &named, &["ooooa", "ofahh", "ooohh", "aaaoh"]);
    let bin = Item::Bin(picture.histogram.bin_of(0).unwrap());
    check(&marks(&picture, None, &none, Some(bin)).unwrap(), &named, &["hhhhh"; 4]);
    let window = Selection { item: Some(Item::Window(0)), ..Selection::default() };
    check(
        &marks(&picture, Some(&shown), &window, None).unwrap(),
        &named,
        &["ooooo", "o...o", "o...o", "ooooo"],
    );
}
