//! Read the result of an analysis: the light, and for each region size, reflection vectors, quality of the fit and
//! warnings.
//!
//! `cargo run --release --example regions [IMAGE]`

use dichroscope::analysis::Session;
use dichroscope::params::Params;
use dichroscope::photo::{self, ReadOptions};
use std::path::Path;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

fn main() -> anyhow::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| SAMPLE.to_owned());
    let photo = photo::read(Path::new(&path), &ReadOptions::default())?;
    println!("{path}: {} × {} pixels, {}", photo.image.width(), photo.image.height(), photo.encoding);

    let analysis = Session::new(photo.image).run(&Params::default(), &mut ())?;
    match analysis.illuminant {
        Some(light) => {
            println!("light: {}, from the highlights of {} regions", vector(light.direction), light.objects);
        }
        None => println!("light: unknown, as there is no highlight"),
    }
    println!("noise: σ = {:.2} counts\n", analysis.used.camera_noise / 2.0);

    println!("  id  pixels  highlight  body (r, g, b)        angle   fit");
    for region in &analysis.intrinsic.regions {
        let angle = region.angle_deg.map_or("  none".to_owned(), |angle| format!("{angle:5.1}°"));
        println!(
            "{:4}  {:6}  {:9}  {}  {angle}  {:.2} counts",
            region.id,
            region.pixels,
            region.highlight_pixels,
            vector(region.body),
            region.fit_rms_counts
        );
        for warning in &region.warnings {
            println!("      {warning}");
        }
    }
    // The label map holds the region's `id` per pixel, and 0 for no region.
    let unassigned = analysis.finals.labels.as_slice().iter().filter(|&&id| id == 0).count();
    println!("\n{unassigned} pixels in no region");
    Ok(())
}

fn vector([r, g, b]: [f64; 3]) -> String {
    format!("({r:.3}, {g:.3}, {b:.3})")
}
