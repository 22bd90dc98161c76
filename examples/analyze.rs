//! Analyze a photograph in ten lines: `cargo run --release --example analyze [IMAGE]`.

use dichroscope::{analysis::Session, describe::sentences, params::Params, photo};
use std::path::Path;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

fn main() -> anyhow::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| SAMPLE.to_owned());
    let photo = photo::read(Path::new(&path), &photo::ReadOptions::default())?;
    let analysis = Session::new(photo.image).run(&Params::default(), &mut ())?;
    println!("{} regions", analysis.intrinsic.regions.len());
    println!("color of the light: {:?}", analysis.illuminant.map(|light| light.direction));
    for warning in photo.warnings.iter().chain(&sentences(&analysis.warnings)) {
        println!("beware: {warning}");
    }
    Ok(())
}
