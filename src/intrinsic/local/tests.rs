use super::*;
use crate::color::{Vec3, vec3};
use crate::intrinsic::split;
use crate::params::{Params, Refine, UsedParams};
use crate::photo::{LinearImage, MaskLimits, Masks};
use crate::raster::LabelMap;
use crate::segment::testing::Drawing;
use crate::segment::{FinalRegions, LightBasis};
use crate::trace::NoopRecorder;
use proptest::prelude::*;

const SIDE_PX: usize = 96;
const SIGMA: f64 = 1.25;
const CLIP_THRESHOLD: f32 = 240.0;

fn light() -> Vec3 {
    Vec3::new(0.62, 0.57, 0.54).normalize()
}

fn used_params() -> UsedParams {
    UsedParams { camera_noise: 2.0 * SIGMA, ..UsedParams::paper() }
}

/// The split of a picture in which no region was found, under a known light.
fn local(color: impl Fn(f64, f64) -> Vec3) -> (LinearImage, crate::intrinsic::Intrinsic) {
    local_by_votes(0.1, color)
}

/// The same where a share of the votes is for the light.
fn local_by_votes(
    share: f64,
    color: impl Fn(f64, f64) -> Vec3,
) -> (LinearImage, crate::intrinsic::Intrinsic) {
    local_refined(share, Params::default().refinements(), color)
}

/// The same with the refinements `refine`.
fn local_refined(
    share: f64,
    refine: Refine,
    color: impl Fn(f64, f64) -> Vec3,
) -> (LinearImage, crate::intrinsic::Intrinsic) {
    let place = |i: usize| ((i % SIDE_PX) as f64, (i / SIDE_PX) as f64);
    let data = (0..SIDE_PX * SIDE_PX).map(|i| {
        let color = color(place(i).0, place(i).1);
        // A fixed pattern instead of noise: smaller than the noise, and the same in every run.
        let noise = ((i * 7919 % 13) as f32 - 6.0) * 0.15;
        crate::color::rgb(&color).map(|band| (band + noise).clamp(0.0, 255.0))
    });
    let pixels = Raster::from_vec(SIDE_PX, SIDE_PX, data.collect()).unwrap();
    let image = LinearImage::new(pixels, Some(255.0));
    let limits =
        MaskLimits { min_intensity: 23.0, clip_threshold: f64::from(CLIP_THRESHOLD), bloom_density: 1 };
    let masks = Masks::new(&image, &limits);
    let used = used_params();
    let input = AnalysisInput::new(&image, &masks, &used, refine);
    let light = LightFindings {
        direction: Some(light().into()),
        basis: LightBasis::Votes,
        share,
        ..LightFindings::default()
    };
    let labels = LabelMap::filled(SIDE_PX, SIDE_PX, 0);
    let regions = FinalRegions { labels, hypotheses: Vec::new(), light, second_lamp_mask: None };
    let result = crate::intrinsic::Intrinsic::clone(&split(&input, &regions, &mut NoopRecorder).intrinsic);
    (image, result)
}

fn slope(x: f64, y: f64) -> Vec3 {
    Vec3::new(0.75, 0.4, 0.25) * (90.0 + 0.4 * x + 0.2 * y)
}

/// The surface reflection at (x, y) of a Gaussian highlight of width 4 px at (48, 40), counts.
fn highlight(x: f64, y: f64, amount: f64) -> Vec3 {
    light() * (amount * (-((x - 48.0).powi(2) + (y - 40.0).powi(2)) / 32.0).exp())
}

#[test]
fn a_gaussian_highlight_on_a_matte_slope_is_found() {
    let (_, result) = local(|x, y| slope(x, y) + highlight(x, y, 120.0));
    let error = |x: usize, y: usize| (vec3(result.body[y * SIDE_PX + x]) - slope(x as f64, y as f64)).norm();
    assert!(error(48, 40) < 8.0, "the peak of the highlight, 120 counts high: {}", error(48, 40));
    assert!(error(52, 42) < 8.0, "the flank of the highlight: {}", error(52, 42));
    let found = result.surface[40 * SIDE_PX + 48];
    assert!(crate::color::axis_angle_deg(&vec3(found), &light()) < 0.01);
    assert!(result.confidence[40 * SIDE_PX + 48] > 0.2);
    assert!(result.surface[80 * SIDE_PX + 10].iter().all(|band| *band == 0.0));
}

#[test]
fn nothing_is_split_under_a_light_with_too_few_votes() {
    let (image, result) = local_by_votes(0.001, |x, y| slope(x, y) + highlight(x, y, 120.0));
    assert_eq!(result.body.as_slice(), image.pixels.as_slice());
    assert!(result.confidence.as_slice().iter().all(|&confidence| confidence == 0.0));
}

#[test]
fn a_clipped_core_takes_the_body_around_it() {
    let (_, result) = local(|x, y| slope(x, y) + highlight(x, y, 420.0));
    let error = (vec3(result.body[40 * SIDE_PX + 48]) - slope(48.0, 40.0)).norm();
    assert!(error < 20.0, "{error}");
    assert_eq!(result.kinds[40 * SIDE_PX + 48], PixelKind::Unassigned);
}

#[test]
fn a_clipped_pixel_that_is_not_filled_has_the_surface_reflection_around_it() {
    // Surface reflection falls towards a single clipped pixel: the pixel is no core of a highlight.
    let distance = |x: f64, y: f64| (x - 48.0).hypot(y - 40.0);
    let ring = |x: f64, y: f64| light() * (90.0 * (-(distance(x, y) - 6.0).powi(2) / 32.0).exp());
    let (_, result) =
        local(|x, y| if distance(x, y) < 0.5 { Vec3::repeat(255.0) } else { slope(x, y) + ring(x, y) });
    let pixel = 40 * SIDE_PX + 48;
    assert!(result.surface[pixel - 1].iter().sum::<f32>() > 20.0, "the pixel beside it is split");
    let error = (vec3(result.body[pixel]) - slope(48.0, 40.0)).norm();
    assert!(error < 100.0, "{error} counts off, without surface reflection 350");
    assert!(result.confidence[pixel] < 1e-6, "a guess");
}

#[test]
fn no_surface_reflection_is_taken_beside_clipped_pixels_that_are_not_filled() {
    // A pale strip of 8 px beside clipped pixels of a much larger area, which are no core of so small a highlight.
    let (_, result) = local(|x, y| {
        let sheen = light() * (40.0 * (1.0 - (60.0 - x) / 8.0).clamp(0.0, 1.0));
        if x > 60.0 { Vec3::repeat(255.0) } else { slope(x, y) + sheen }
    });
    let surface = |x: usize| result.surface[48 * SIDE_PX + x].iter().sum::<f32>();
    assert!(
        (50..58).any(|x| surface(x) > 1.0),
        "the strip is split: {:?}",
        (50..61).map(surface).collect::<Vec<_>>()
    );
    assert!(surface(60) < 1e-3, "beside the clipped pixels: {}", surface(60));
    assert!(surface(70) < 1e-3, "the clipped pixels are not filled");
}

#[test]
fn pixels_in_which_another_color_replaces_the_body_keep_their_color() {
    let drawing = Drawing::by_place(SIDE_PX, |x, y| slope(x, y) + highlight(x, y, 120.0));
    let input = drawing.input();
    let findings = LightFindings {
        direction: Some(light().into()),
        basis: LightBasis::Votes,
        share: 0.1,
        ..LightFindings::default()
    };
    let labels = LabelMap::filled(SIDE_PX, SIDE_PX, 0);
    let members = crate::segment::Members::of(&labels, 0);
    let lamps = Lamps::one(&light()).unwrap();
    let explained = Mask::filled(SIDE_PX, SIDE_PX, false);
    let mut images = Images {
        body: input.pixels.clone(),
        surface: Raster::filled(SIDE_PX, SIDE_PX, [0.0; 3]),
        noise: Raster::filled(SIDE_PX, SIDE_PX, 0.0),
        kinds: Raster::filled(SIDE_PX, SIDE_PX, PixelKind::Unassigned),
    };
    let replaced =
        Mask::from_vec(SIDE_PX, SIDE_PX, (0..SIDE_PX * SIDE_PX).map(|pixel| pixel % SIDE_PX > 48).collect());
    let local = LocalInput {
        input: &input,
        restored: None,
        light: findings,
        lamps: Some(&lamps),
        explained_mask: &explained,
        replaced: replaced.as_ref(),
        observations: None,
        regions: Regions { labels: &labels, members: &members, matte: &[] },
    };
    split_locally(&local, &[0.0; 3], &mut images, &mut NoopRecorder).unwrap();
    let surface = |x: usize| images.surface[40 * SIDE_PX + x].iter().sum::<f32>();
    assert!(surface(46) > 60.0, "the left half is split: {}", surface(46));
    assert!(images.surface.row(40)[49..].iter().flatten().all(|band| *band == 0.0));
    assert_eq!(images.body.row(40)[49..], input.pixels.row(40)[49..]);
}

#[test]
fn a_print_without_highlights_is_left_alone() {
    let check = |x: f64, y: f64| ((x / 9.0).floor() + (y / 9.0).floor()) as i64 % 2 == 0;
    let colors = [Vec3::new(0.8, 0.3, 0.2), Vec3::new(0.6, 0.5, 0.45)];
    let (image, result) = local(|x, y| colors[usize::from(check(x, y))] * (110.0 + 0.5 * x));
    let changed = result.surface.as_slice().iter().filter(|s| s.iter().sum::<f32>() > 6.0).count();
    assert!(changed < image.pixels.len() / 200, "{changed} pixels");
    let (image, result) = local(slope);
    assert_eq!(result.body.as_slice(), image.pixels.as_slice(), "shading alone is no highlight");
}

#[test]
fn under_a_light_slightly_off_body_reflection_takes_the_chromaticity_around() {
    let true_light = (light() + Vec3::new(0.03, -0.03, 0.0)).normalize();
    let blob =
        |x: f64, y: f64| true_light * (60.0 * (-((x - 48.0).powi(2) + (y - 40.0).powi(2)) / 32.0).exp());
    let worst_deg = |chromaticity_prior: bool| {
        let refine = Refine { chromaticity_prior, ..Params::default().refinements() };
        let (_, result) = local_refined(0.1, refine, |x, y| slope(x, y) + blob(x, y));
        let error = |x: usize, y: usize| {
            crate::color::axis_angle_deg(&vec3(result.body[y * SIDE_PX + x]), &slope(0.0, 0.0))
        };
        (44..53).map(|x| error(x, 40)).fold(0.0, f64::max)
    };
    let (with, without) = (worst_deg(true), worst_deg(false));
    assert!(with < 0.6 * without && without > 0.5, "{with}\u{b0} with the rule, {without}\u{b0} without");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn body_is_never_more_than_the_input_and_surface_is_the_rest(
        colors in prop::array::uniform2(prop::array::uniform3(0.05f64..1.0)), period in 3.0f64..20.0, peak in 0.0f64..500.0,
    ) {
        let color = |x: f64, y: f64| {
            let first = ((x / period).floor() + (y / period).floor()) as i64 % 2 == 0;
            Vec3::from(colors[usize::from(first)]) * (60.0 + x) + highlight(x, y, peak)
        };
        let refine = Refine { chromaticity_prior: false, ..Params::default().refinements() };
        let (_, plain) = local_refined(0.1, refine, color);
        let (image, result) = local(color);
        for (pixel, input) in image.pixels.as_slice().iter().enumerate() {
            let is_clipped = input.iter().any(|band| *band >= CLIP_THRESHOLD);
            if !is_clipped {
                let change = vec3(result.surface[pixel]) - vec3(plain.surface[pixel]);
                prop_assert!(change.norm() < 1e-9, "an unclipped pixel keeps its surface reflection");
            }
            for (band, input) in input.iter().enumerate() {
                let (body, surface) = (result.body[pixel][band], result.surface[pixel][band]);
                prop_assert!(body >= 0.0 && surface >= 0.0 && body <= *input);
                let rest = plain.body[pixel][band] + plain.surface[pixel][band] - input;
                // A band that was restored has more light than the file keeps.
                prop_assert!(rest.abs() < 1e-3 || (is_clipped && rest > 0.0), "body and surface reflection are the input without the rule");
            }
            prop_assert!((0.0..=1.0).contains(&result.confidence[pixel]));
        }
    }
}

proptest! {
    #[test]
    fn a_clipped_color_keeps_its_hue_and_loses_the_amount(
        color in prop::array::uniform3(1f32..255.0),
        share in 0f32..1.2,
    ) {
        let lamp = Lamp::new(&Vec3::new(0.7, 0.6, 0.4).normalize()).unwrap();
        let a = lamp.gain.mean(color);
        let Moved { surface, body } = Moved::of_clipped(color, share * a, &lamp);
        for band in 0..3 {
            prop_assert!((body[band] + surface[band] - color[band]).abs() < 1e-4);
            prop_assert!(body[band] >= -1e-4);
            // The ratio of two bands stays.
            prop_assert!((body[band] * color[0] - body[0] * color[band]).abs() < 1e-3 * color[0] * color[band]);
        }
        let left = (a - share * a).max(0.0);
        prop_assert!((lamp.gain.mean(body) - left).abs() < 1e-3 * a.max(1.0));
    }
}
