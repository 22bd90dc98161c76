//! Write the photograph without its highlights, in the photograph's own encoding and depth.
//!
//! `cargo run --release --example remove_highlights [IMAGE [FOLDER]]` writes `matte.png`, `.jpg` or `.tif` to FOLDER (the
//! system's temporary folder if not given).

use dichroscope::analysis::Session;
use dichroscope::export::write_matte;
use dichroscope::params::Params;
use dichroscope::photo::{self, ReadOptions};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| SAMPLE.to_owned());
    let folder = arguments.next().map_or_else(std::env::temp_dir, PathBuf::from);

    let photo = photo::read(Path::new(&path), &ReadOptions::default())?;
    let analysis = Session::new(Arc::clone(&photo.image)).run(&Params::default(), &mut ())?;

    // The body image shows the scene as if every surface were matte. A pixel in no region keeps its input color.
    let written = write_matte(&photo, &analysis.intrinsic, 0.0, &folder)?;
    let removed = analysis
        .intrinsic
        .surface
        .as_slice()
        .iter()
        .filter(|color| color.iter().any(|&band| band > 0.0))
        .count();
    println!("{removed} pixels had surface reflection; without it: {}", written.display());
    Ok(())
}
