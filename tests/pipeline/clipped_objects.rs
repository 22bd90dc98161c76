//! White things that clip are no highlights: they keep their colors, with working pixels of one and of four pixels.

use crate::common::{analyze, assert_valid};
use crate::synthetic::{Ball, Scene};
use dichroscope::analysis::Session;
use dichroscope::intrinsic::Reason;
use dichroscope::params::{Method, Params, Setting};
use dichroscope::photo::{ClippedAreaVerdict, LinearImage};
use dichroscope::raster::PixelIndex;
use dichroscope::trace::{Event, HistoryKind, MaskVerdict, Step, pixel_history};
use std::sync::Arc;

const DISK_RADIUS_PX: f64 = 11.0;

fn balls() -> Scene {
    Scene::grid_of_balls([480, 320], 3, 2, 8)
}

/// Distance of a pixel from the rim of the white disk before the ball, pixels; positive inside. The disk lies opposite to the highlight.
fn inside_disk_px(ball: &Ball, pixel: usize, width: usize) -> f64 {
    let [x, y] = ball.center_px.map(|center| center + 0.35 * ball.radius_px);
    DISK_RADIUS_PX - (((pixel % width) as f64) - x).hypot((pixel / width) as f64 - y)
}

/// The picture of balls with a white disk before each that clips; the rim of a disk mixes the two over a pixel. Each pixel becomes
/// `factor` × `factor` pixels. The second value: the pixels inside of disks.
fn before_balls(scene: &Scene, factor: usize) -> (LinearImage, Vec<usize>) {
    let mut image = scene.render().image;
    let (width, height) = (image.width(), image.height());
    let mut inside = vec![false; width * height];
    for (pixel, color) in image.pixels.as_mut_slice().iter_mut().enumerate() {
        for ball in &scene.balls {
            let depth_px = inside_disk_px(ball, pixel, width);
            let share = (depth_px + 0.5).clamp(0.0, 1.0) as f32;
            *color = color.map(|value| (share * 320.0 + (1.0 - share) * value).round().min(255.0));
            inside[pixel] |= depth_px > 0.5;
        }
    }
    let of = |x: usize, y: usize| (y / factor) * width + x / factor;
    let large = crate::common::picture(width * factor, height * factor, |x, y| image.pixels[of(x, y)]);
    let pixels = 0..large.pixels.len();
    let inside =
        pixels.filter(|&pixel| inside[of(pixel % (width * factor), pixel / (width * factor))]).collect();
    (LinearImage::new(large.pixels, Some(255.0)), inside)
}

/// Largest loss of body reflection against the photograph in a band, counts.
fn loss(image: &LinearImage, body: impl Fn(usize) -> [f32; 3], pixels: &[usize]) -> f32 {
    let band_loss = |pixel: usize, band: usize| image.pixels[pixel][band] - body(pixel)[band];
    pixels.iter().flat_map(|&pixel| (0..3).map(move |band| band_loss(pixel, band))).fold(0.0, f32::max)
}

#[test]
fn white_things_before_objects_keep_their_colors_and_highlights_do_not() {
    for factor in [1, 2] {
        let (image, white) = before_balls(&balls(), factor);
        let params = Params { scale: Setting::Value(factor as f64), ..Params::default() };
        let analysis = analyze(&image, &params);
        let body = |pixel: usize| analysis.intrinsic.body[pixel];
        assert!(loss(&image, body, &white) == 0.0, "{factor}");
        assert!(white.iter().all(|&pixel| analysis.intrinsic.reasons[pixel] == Reason::ClippedObject));
        let highlights =
            balls().render().surface.as_slice().iter().filter(|surface| surface[0] > 60.0).count();
        let removed =
            analysis.intrinsic.surface.as_slice().iter().filter(|surface| surface[0] > 50.0).count();
        assert!(removed > highlights * factor * factor / 2, "{removed} of {highlights} pixels of highlights");
        assert_valid(&image, &analysis, "white disks");
        let mut without = params;
        without.refine.clipped_objects = false;
        let analysis = analyze(&image, &without);
        assert!(
            loss(&image, |pixel| analysis.intrinsic.body[pixel], &white) > 60.0,
            "the rule is what keeps them"
        );
    }
}

#[test]
fn each_object_is_a_step_with_its_numbers_and_part_of_the_history_of_its_pixels() {
    let (image, white) = before_balls(&balls(), 1);
    let image = Arc::new(image);
    let (analysis, trace) = Session::new(Arc::clone(&image)).run_traced(&Params::default(), &mut ()).unwrap();
    let judged: Vec<_> = trace
        .steps()
        .filter_map(|(_, step)| match step {
            Step::Event(Event::ClippedAreaJudged(judged)) => Some(judged),
            _ => None,
        })
        .collect();
    let objects = judged.iter().filter(|judged| judged.verdict == ClippedAreaVerdict::Object).count();
    assert_eq!(objects, 6, "{judged:?}");
    let pixel = PixelIndex::from_index(white[white.len() / 2]);
    let history = pixel_history(&trace, &image, &analysis.masks, pixel);
    let found = history.iter().find_map(|entry| match entry.what {
        HistoryKind::Masked(MaskVerdict::ClippedObject { clipped, left }) => Some((clipped, left)),
        _ => None,
    });
    let (clipped, left) = found.unwrap();
    assert!(left.value < left.limit && (250..450).contains(&clipped), "{clipped} {left:?}");
}

#[test]
fn the_papers_method_knows_no_clipped_objects() {
    let (image, white) = before_balls(&balls(), 1);
    let params = Params { method: Method::Paper, ..Params::default() };
    let analysis = analyze(&image, &params);
    assert!(white.iter().all(|&pixel| !analysis.masks.in_clipped_object(pixel)));
}
