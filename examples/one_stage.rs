//! Run one stage alone: classify the windows of a photograph (section 5.2.1) and draw their classes as text.
//!
//! `cargo run --release --example one_stage [IMAGE]`

use dichroscope::photo::{self, MaskLimits, Masks, NoiseEstimate, ReadOptions};
use dichroscope::segment::{Classifier, classify};
use dichroscope::trace::{Class, NoopRecorder};
use std::path::Path;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");
const WINDOW_PX: usize = 10;

fn main() -> anyhow::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| SAMPLE.to_owned());
    let image = photo::read(Path::new(&path), &ReadOptions::default())?.image;

    // Masks of the pixels that are usable, with the parameters of table 6.
    let clip_threshold =
        image.saturation.map_or(f64::INFINITY, |saturation| f64::from(saturation) * 240.0 / 255.0);
    let masks = Masks::new(&image, &MaskLimits { min_intensity: 23.0, clip_threshold, bloom_density: 1 });
    // σ0 is twice the standard deviation of the camera's noise.
    let camera_noise = NoiseEstimate::measure(&image, &masks).map_or(2.5, |noise| 2.0 * noise.sigma);

    let mut classifier = Classifier::new(camera_noise, true);
    let believable = |pixel| masks.usable(pixel);
    let min_valid = WINDOW_PX * WINDOW_PX / 2;
    let windows =
        classify(&image.pixels, believable, WINDOW_PX, min_valid, &mut classifier, &mut NoopRecorder);

    println!("σ0 = {camera_noise:.2} counts; . point  / line  # plane  @ volume\n");
    for y in 0..windows.classes.height() {
        let row: String = windows.classes.row(y).iter().map(|class| symbol(*class)).collect();
        println!("{}", row.trim_end());
    }
    Ok(())
}

fn symbol(class: Option<Class>) -> char {
    match class {
        None => ' ',
        Some(Class::Point) => '.',
        Some(Class::Line) => '/',
        Some(Class::Plane) => '#',
        Some(Class::Volume) => '@',
    }
}
