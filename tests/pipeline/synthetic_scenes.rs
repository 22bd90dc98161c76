//! Tests of the generator of test images: its ground truth agrees with its pixels.

use crate::synthetic::{FULL_SCALE, Random, Scene, dot, unit};

const GREEN: [f64; 3] = [0.2, 0.9, 0.3];

/// Length of the component of `color` perpendicular to the unit vector `axis`.
fn distance_from_axis(color: [f32; 3], axis: [f64; 3]) -> f64 {
    let color = color.map(f64::from);
    let along = dot(color, axis);
    (dot(color, color) - along * along).max(0.0).sqrt()
}

#[test]
fn a_ball_covers_its_disc() {
    let rendered = Scene::one_ball([100, 80], GREEN).render();
    let covered = rendered.labels.as_slice().iter().filter(|&&label| label == 1).count();
    let disc = std::f64::consts::PI * 32.0_f64.powi(2);
    assert!((covered as f64 - disc).abs() < 0.01 * disc, "{covered} pixels, the disc has {disc}");
    assert_eq!(rendered.labels.get(50, 40), Some(&1));
    assert_eq!(rendered.labels.get(0, 0), Some(&0));
    assert_eq!(rendered.image.pixels.get(0, 0), Some(&[0.0; 3]));
}

#[test]
fn matte_pixels_lie_on_the_line_through_black() {
    let rendered = Scene::one_ball([100, 80], GREEN).render();
    let mut matte = 0;
    for (pixel, surface) in rendered.image.pixels.as_slice().iter().zip(rendered.surface.as_slice()) {
        if surface[0] < 1e-3 && pixel[1] > 0.0 {
            matte += 1;
            assert!(distance_from_axis(*pixel, unit(GREEN)) < 0.01, "{pixel:?}");
        }
    }
    assert!(matte > 1000, "only {matte} matte pixels");
}

#[test]
fn without_noise_a_pixel_is_body_plus_surface_until_it_clips() {
    let rendered = Scene::one_ball([100, 80], GREEN).render();
    let mut clipped = 0;
    for index in 0..rendered.labels.len() {
        for band in 0..3 {
            let total = rendered.body[index][band] + rendered.surface[index][band];
            let seen = rendered.image.pixels[index][band];
            assert!((seen - total.min(FULL_SCALE as f32)).abs() < 1e-4, "{seen} for {total}");
            clipped += usize::from(total > FULL_SCALE as f32);
        }
    }
    assert!(clipped > 0, "the highlight of this ball should be brighter than the camera can see");
}

#[test]
fn surface_reflection_has_the_color_of_the_light_and_its_peak_between_light_and_view() {
    let scene = Scene { illuminant: unit([0.7, 0.6, 0.4]), ..Scene::one_ball([100, 80], GREEN) };
    let rendered = scene.render();
    for &surface in rendered.surface.as_slice() {
        assert!(distance_from_axis(surface, scene.illuminant) < 1e-3, "{surface:?}");
    }
    let peak = (0..rendered.surface.len())
        .max_by(|&a, &b| rendered.surface[a][0].total_cmp(&rendered.surface[b][0]));
    let peak = peak.unwrap();
    // The light is 45° from the view, up and to the left: the normal at the highlight is 22.5° from the view.
    let offset_px = 32.0 * 22.5_f64.to_radians().sin() * 0.5_f64.sqrt();
    let (x, y) = ((peak % 100) as f64 + 0.5, (peak / 100) as f64 + 0.5);
    assert!((x - (50.0 - offset_px)).abs() < 1.0 && (y - (40.0 - offset_px)).abs() < 1.0, "peak at {x}, {y}");
    let length = dot(rendered.surface[peak].map(f64::from), scene.illuminant);
    assert!((length - scene.balls[0].surface_counts).abs() < 2.0, "{length} counts at the peak");
}

#[test]
fn the_larger_ball_covers_the_smaller() {
    let mut scene = Scene::one_ball([100, 80], GREEN);
    let behind = crate::synthetic::Ball { radius_px: 16.0, center_px: [72.0, 40.0], ..scene.balls[0] };
    scene.balls.push(behind);
    let rendered = scene.render();
    assert_eq!(rendered.labels.get(72, 40), Some(&1), "inside the larger ball");
    assert_eq!(rendered.labels.get(86, 40), Some(&2), "beyond the larger ball's rim");
}

#[test]
fn an_eight_bit_camera_gives_whole_counts_with_the_noise_asked_for() {
    let scene = Scene::grid_of_balls([200, 150], 3, 2, 7);
    let rendered = scene.render();
    assert!(rendered.image.pixels.as_slice().iter().flatten().all(|&v| v.fract() == 0.0));
    for object in 1..=6 {
        assert!(rendered.labels.as_slice().contains(&object), "object {object} is not in the picture");
    }
    let noise: Vec<f64> = (0..rendered.labels.len())
        .flat_map(|i| [0, 1, 2].map(|b| (i, b)))
        .map(|(i, b)| (rendered.image.pixels[i][b], rendered.body[i][b] + rendered.surface[i][b]))
        .filter(|(_, truth)| (10.0..245.0).contains(truth))
        .map(|(seen, truth)| f64::from(seen - truth))
        .collect();
    let variance = noise.iter().map(|e| e * e).sum::<f64>() / noise.len() as f64;
    // Rounding to whole counts adds a variance of 1/12.
    let expected = scene.noise_sigma.powi(2) + 1.0 / 12.0;
    assert!((variance - expected).abs() < 0.05 * expected, "variance {variance}, expected {expected}");
}

#[test]
fn the_same_seed_gives_the_same_picture_and_another_seed_another() {
    let picture = |seed| Scene::grid_of_balls([60, 40], 2, 1, seed).render();
    assert_eq!(picture(3), picture(3));
    assert_ne!(picture(3).image, picture(4).image);
}

#[test]
fn the_normal_numbers_are_normal() {
    let mut random = Random::new(11);
    let numbers: Vec<f64> = (0..100_000).map(|_| random.normal()).collect();
    let moment = |power| numbers.iter().map(|v| v.powi(power)).sum::<f64>() / numbers.len() as f64;
    for (power, expected, tolerance) in [(1, 0.0, 0.02), (2, 1.0, 0.02), (3, 0.0, 0.05), (4, 3.0, 0.1)] {
        let found = moment(power);
        assert!((found - expected).abs() < tolerance, "moment {power} is {found}");
    }
}
