//! Every value returned is checked by an analysis: the fate is another at the value, and unchanged at the value before.

use super::*;
use crate::photo::LinearImage;
use crate::raster::{PixelIndex, Raster, RegionId};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const WIDTH: usize = 48;
const HEIGHT: usize = 32;

/// A red ramp, a green ramp, a strip of dark gray between both, and one pixel of the red ramp that is off the red line.
fn image() -> LinearImage {
    let color = |pixel: usize| {
        let (x, y) = (pixel % WIDTH, pixel / WIDTH);
        // A fixed zigzag instead of noise, the same along every axis.
        let zigzag = |k: usize| [0.8f32, -0.8, 0.4, -0.4][(x * 7 + y * 5 + k * 3) % 4];
        let level = 60.0 + 3.0 * y as f32;
        let base = match x {
            0..22 => [0.9 * level, 0.3 * level, 0.2 * level],
            22..26 => [8.0, 8.0, 8.0],
            _ => [0.2 * level, 0.9 * level, 0.3 * level],
        };
        let off = if pixel == off_line() { 9.0 } else { 0.0 };
        [base[0] + zigzag(0), base[1] + zigzag(1) - off, base[2] + zigzag(2) + off]
    };
    let pixels = (0..WIDTH * HEIGHT).map(color).collect();
    LinearImage::new(Raster::from_vec(WIDTH, HEIGHT, pixels).unwrap(), Some(255.0))
}

/// The pixel off the red line: at the edge of the picture, where no hole is filled.
fn off_line() -> usize {
    15 * WIDTH
}

fn params() -> Params {
    let set = Setting::Value;
    Params {
        camera_noise: set(2.0),
        cylinder_width: set(3.0),
        slice_width: set(3.0),
        window_size: set(6.0),
        min_area: set(72.0),
        ..Params::default()
    }
}

fn found(pixel: usize) -> Vec<WhatIf> {
    what_if(&mut Session::new(Arc::new(image())), &params(), PixelIndex::from_index(pixel), &mut ()).unwrap()
}

/// The fate at a value, in a session of its own.
fn fate_at(pixel: usize, parameter: Parameter, value: f64) -> Fate {
    let run = |params: &Params| Session::new(Arc::new(image())).run(params, &mut ()).unwrap();
    let unchanged = run(&params());
    let mut moved = params();
    *moved.slot(parameter) = Setting::Value(value);
    let analysis = run(&moved);
    let home = home(&unchanged.finals.labels, &analysis.finals.labels, pixel);
    Fate { home, kind: analysis.intrinsic.kinds[pixel] }
}

#[track_caller]
fn assert_confirmed(pixel: usize, what_if: &WhatIf) {
    let WhatIf { parameter, direction, now, at, unchanged_at, before, after, .. } = *what_if;
    assert_eq!(fate_at(pixel, parameter, at), after, "{what_if:?}");
    assert_eq!(fate_at(pixel, parameter, unchanged_at), before, "{what_if:?}");
    assert_ne!(before, after);
    let outward = if direction == Direction::Up { at > unchanged_at } else { at < unchanged_at };
    assert!(outward && (at - now).abs() > 0.0, "{what_if:?}");
}

#[test]
fn a_pixel_off_its_line_joins_when_the_cylinder_is_wide_enough() {
    let pixel = off_line();
    let analysis = Session::new(Arc::new(image())).run(&params(), &mut ()).unwrap();
    assert_eq!(analysis.finals.labels[pixel], UNASSIGNED, "9 counts off in two bands, radius 6");
    let found = found(pixel);
    for what_if in &found {
        assert_confirmed(pixel, what_if);
    }
    let wider = found
        .iter()
        .find(|what_if| (what_if.parameter, what_if.direction) == (Parameter::CylinderWidth, Direction::Up))
        .unwrap();
    assert!(wider.predicted, "its distance was recorded: {wider:?}");
    let own = analysis.finals.labels[pixel + 5];
    assert_eq!(wider.after.home, Home::Region(RegionId::from_label(own).unwrap()));
    // √2 · 9 counts across, σ0 2.
    assert!((wider.at - 9.0 * 2f64.sqrt() / 2.0).abs() < 0.6, "{wider:?}");
}

#[test]
fn a_matte_pixel_goes_dark_above_its_own_brightness() {
    let pixel = 10 * WIDTH + 10;
    let found = found(pixel);
    assert!(!found.is_empty());
    for what_if in &found {
        assert_confirmed(pixel, what_if);
    }
    let image = image();
    let brightness = image.pixels[pixel].iter().map(|v| f64::from(v * v)).sum::<f64>().sqrt();
    let dark = found.iter().find(|w| (w.parameter, w.direction) == (Parameter::MinIntensity, Direction::Up));
    let dark = dark.unwrap();
    assert!(dark.after.home == Home::Nowhere && dark.at <= brightness + 1.0, "{dark:?}, {brightness}");
    assert!(found.is_sorted_by_key(|w| (Parameter::ALL.iter().position(|&p| p == w.parameter), w.direction)));
    assert_eq!(found, super::tests::found(pixel), "the same again");
}

#[test]
fn for_a_dark_pixel_only_the_minimal_intensity_is_changed() {
    let found = found(8 * WIDTH + 24);
    assert!(found.iter().all(|what_if| what_if.parameter == Parameter::MinIntensity), "{found:?}");
    assert_eq!(super::tests::found(WIDTH * HEIGHT), [], "outside the picture");
    let empty = Arc::new(LinearImage::new(Raster::filled(0, 0, [0.0; 3]), None));
    assert_eq!(
        what_if(&mut Session::new(empty), &Params::default(), PixelIndex::new(0), &mut ()),
        Ok(Vec::new())
    );
}

/// Cancels at the call of `cancelled` after `limit` calls, and collects the progress.
struct CancelAfter {
    calls: AtomicUsize,
    limit: usize,
    progress: Vec<(usize, usize)>,
}

impl WhatIfObserver for CancelAfter {
    fn progress(&mut self, done: usize, of: usize) {
        self.progress.push((done, of));
    }

    fn cancelled(&self) -> bool {
        self.calls.fetch_add(1, Ordering::Relaxed) >= self.limit
    }
}

#[test]
fn a_search_reports_its_progress_and_can_be_cancelled() {
    let run = |limit| {
        let mut observer = CancelAfter { calls: AtomicUsize::new(0), limit, progress: Vec::new() };
        let mut session = Session::new(Arc::new(image()));
        let result = what_if(&mut session, &params(), PixelIndex::from_index(off_line()), &mut observer);
        (result, observer.progress)
    };
    let (result, progress) = run(usize::MAX);
    assert!(result.is_ok());
    // All parameters but the scale, up and down.
    let analyses = 2 * (Parameter::ALL.len() - 1);
    assert_eq!(progress, (1..=analyses).map(|done| (done, analyses)).collect::<Vec<_>>());
    let (result, progress) = run(200);
    assert_eq!(result, Err(Cancelled));
    assert!(progress.len() < analyses);
}
