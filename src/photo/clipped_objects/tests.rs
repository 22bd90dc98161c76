//! Closed forms of clipped areas: lobes of surface reflection, and white things with edges.

use super::*;
use crate::photo::MaskLimits;

const LIMITS: MaskLimits = MaskLimits { min_intensity: 5.0, clip_threshold: 250.0, bloom_density: 1 };
const SIZE: usize = 120;
const BODY: [f64; 3] = [150.0, 60.0, 20.0];

/// The areas of a picture whose color at a place is `color`, clipped at 255 counts.
fn areas(color: impl Fn(f64, f64) -> [f64; 3]) -> Vec<ClippedArea> {
    let at = |pixel: usize| color((pixel % SIZE) as f64, (pixel / SIZE) as f64);
    let data = (0..SIZE * SIZE).map(|pixel| at(pixel).map(|value| value.min(255.0) as f32)).collect();
    let image = LinearImage::new(Raster::from_vec(SIZE, SIZE, data).unwrap(), Some(255.0));
    clipped_areas(&image, &Masks::new(&image, &LIMITS), LIMITS.clip_threshold)
}

/// Body reflection and a Gaussian lobe of surface reflection with this peak, counts, and standard deviation, pixels.
fn lobe(peak: f64, width_px: f64) -> impl Fn(f64, f64) -> [f64; 3] {
    move |x, y| {
        let surface = peak * (-((x - 60.0).powi(2) + (y - 60.0).powi(2)) / (2.0 * width_px.powi(2))).exp();
        BODY.map(|body| body + surface)
    }
}

/// White of this brightness, counts, in a disk with this radius, pixels, before body reflection. The edge is mixed over `blur_px` to either side.
fn disk(white: f64, radius_px: f64, blur_px: f64) -> impl Fn(f64, f64) -> [f64; 3] {
    move |x, y| {
        let inside = radius_px - (x - 60.0).hypot(y - 60.0);
        let share = (0.5 + 0.5 * inside / blur_px).clamp(0.0, 1.0);
        BODY.map(|body| share * white + (1.0 - share) * body)
    }
}

#[test]
fn a_lobe_of_any_size_may_be_a_highlight() {
    for (peak, width_px) in [(400.0, 2.5), (400.0, 12.0), (1500.0, 3.0), (3000.0, 8.0)] {
        let found = areas(lobe(peak, width_px));
        assert_eq!(found.len(), 1, "peak {peak}, width {width_px}");
        assert_eq!(
            found[0].verdict,
            ClippedAreaVerdict::MayBeHighlight,
            "{} of {}",
            found[0].left,
            found[0].most_left
        );
    }
}

#[test]
fn a_white_disk_of_any_size_is_an_object() {
    for (white, radius_px, blur_px) in [(300.0, 6.0, 0.7), (300.0, 30.0, 0.7), (500.0, 12.0, 1.2)] {
        let found = areas(disk(white, radius_px, blur_px));
        assert_eq!(found.len(), 1);
        assert_eq!(
            found[0].verdict,
            ClippedAreaVerdict::Object,
            "{} of {}",
            found[0].left,
            found[0].most_left
        );
        let expected = std::f64::consts::PI * radius_px.powi(2);
        assert!((found[0].clipped as f64 / expected - 1.0).abs() < 0.2, "{} pixels", found[0].clipped);
        assert!(found[0].pixels.is_sorted() && found[0].pixels.len() > found[0].clipped);
    }
}

#[test]
fn a_large_white_area_is_an_object_with_a_wider_edge_than_a_colored_one() {
    let blurred = |color: [f64; 3]| {
        move |x: f64, y: f64| {
            let inside = 30.0 - (x - 60.0).hypot(y - 60.0);
            let share = 1.0 / (1.0 + (-inside / 1.2).exp());
            std::array::from_fn(|band| share * color[band] + (1.0 - share) * BODY[band])
        }
    };
    let white = areas(blurred([400.0; 3]));
    assert_eq!(white.len(), 1);
    assert!(white[0].left > MOST_LEFT_OF_AN_EDGE, "{}", white[0].left);
    assert_eq!(white[0].verdict, ClippedAreaVerdict::Object, "{} of {}", white[0].left, white[0].most_left);
    let red = areas(blurred([400.0, 140.0, 140.0]));
    assert_eq!(red.len(), 1);
    assert!(red[0].most_left <= MOST_LEFT_OF_AN_EDGE, "{}", red[0].most_left);
    assert_eq!(red[0].verdict, ClippedAreaVerdict::MayBeHighlight, "{}", red[0].left);
}

#[test]
fn a_small_abrupt_area_beside_large_highlights_is_few() {
    let (highlight, white) = (lobe(1500.0, 12.0), disk(300.0, 5.0, 0.7));
    let found = areas(|x, y| if x < 15.0 && y < 15.0 { white(x + 52.0, y + 52.0) } else { highlight(x, y) });
    let verdicts: Vec<_> = found.iter().map(|area| area.verdict).collect();
    assert_eq!(verdicts, [ClippedAreaVerdict::Few, ClippedAreaVerdict::MayBeHighlight]);
}

#[test]
fn small_saturated_areas_with_abrupt_edges_are_objects_if_they_are_several() {
    let (highlight, white) = (lobe(1500.0, 12.0), disk(600.0, 4.0, 0.7));
    let letters = |count: usize| {
        areas(|x, y| {
            let place = (x / 20.0).floor();
            if y < 20.0 && place < count as f64 {
                white(x - 20.0 * place + 50.0, y + 50.0)
            } else {
                highlight(x, y)
            }
        })
    };
    let objects = |areas: &[ClippedArea]| {
        areas.iter().filter(|area| area.verdict == ClippedAreaVerdict::Object).count()
    };
    let (two, three) = (letters(2), letters(3));
    assert_eq!((two.len(), objects(&two)), (3, 0));
    assert_eq!((three.len(), objects(&three)), (4, 3));
}

#[test]
fn an_edge_within_the_clipped_area_is_an_edge() {
    let body = [240.0, 60.0, 20.0];
    let found = areas(|x, y| {
        let inside = 20.0 - (x - 60.0).hypot(y - 60.0);
        let glare = if inside < 0.0 { 0.04 * (inside / 6.0).exp() } else { 0.04 };
        let share = 1.0 / (1.0 + (-inside / 0.5).exp()) + glare;
        std::array::from_fn(|band| share * 300.0 + (1.0 - share) * body[band])
    });
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].verdict, ClippedAreaVerdict::Object, "{} of {}", found[0].left, found[0].most_left);
}

#[test]
fn a_narrow_area_beside_an_object_is_one_too() {
    let white = disk(300.0, 20.0, 0.7);
    let found = areas(|x, y| if (x - 5.0).abs() < 1.0 { [300.0; 3] } else { white(x, y) });
    let verdicts: Vec<_> = found.iter().map(|area| area.verdict).collect();
    assert_eq!(verdicts, [ClippedAreaVerdict::Object; 2]);
}

#[test]
fn narrow_areas_that_are_not_saturated_tell_nothing_and_areas_of_the_color_around_them_are_not_judged() {
    let line = |x: f64, _| if (x - 60.0).abs() < 1.0 { [300.0, 240.0, 240.0] } else { BODY };
    assert!(areas(line).iter().all(|area| area.verdict == ClippedAreaVerdict::MayBeHighlight));
    let red = disk(0.0, 20.0, 0.7);
    assert_eq!(
        areas(|x, y| {
            let [r, g, b] = red(x, y);
            [if r < 75.0 { 300.0 } else { r }, g + 60.0, b + 20.0]
        }),
        []
    );
    assert_eq!(areas(|_, _| [300.0; 3]), [], "nothing is around");
    assert_eq!(areas(|_, _| BODY), []);
}
