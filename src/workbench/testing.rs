//! Small pictures and results for tests.

use super::{Histogram, Origin, Picture, Shown};
use crate::analysis::Session;
use crate::intrinsic::{Intrinsic, RegionReflection};
use crate::photo::{self, EncodingChoice, ReadOptions};
use crate::raster::{LabelMap, Raster};
use crate::segment::{FinalRegions, Params};
use std::sync::{Arc, OnceLock};

/// A picture `width` pixels wide, of linear 8-bit colours.
pub(super) fn picture(width: usize, colours: &[[u8; 3]]) -> Arc<Picture> {
    let mut bytes = format!("P6 {width} {} 255\n", colours.len() / width).into_bytes();
    bytes.extend(colours.as_flattened());
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    let photo = photo::decode(&bytes, "made.ppm", &options).unwrap();
    let origin = Origin::Bytes { name: "made.ppm".into(), bytes: bytes.as_slice().into() };
    let histogram = Histogram::of(&photo.image);
    Arc::new(Picture {
        origin,
        reading: options,
        photo,
        sha256: photo::sha256_hex(&bytes),
        read_ms: 0.0,
        histogram,
        truth: None,
    })
}

/// A grey picture of the size of `rows`.
pub(super) fn grey(rows: &[&str], value: u8) -> Arc<Picture> {
    picture(rows[0].len(), &vec![[value; 3]; rows[0].len() * rows.len()])
}

/// Labels drawn as digits, `.` = 0.
pub(super) fn labels(rows: &[&str]) -> LabelMap {
    let digit = |b: u8| if b == b'.' { 0 } else { u16::from(b - b'0') };
    Raster::from_vec(rows[0].len(), rows.len(), rows.iter().flat_map(|row| row.bytes().map(digit)).collect())
        .unwrap()
}

/// What an analysis of `picture` finds.
pub(super) fn shown(picture: &Arc<Picture>) -> Shown {
    let params = Params::paper();
    let image = Arc::new(picture.photo.image.clone());
    let analysis = Session::new(image).run(&params, &mut ()).unwrap();
    let count = analysis.intrinsic.regions.len();
    Shown {
        generation: 1,
        picture: Arc::clone(picture),
        params,
        area: None,
        analysis,
        stale_from: None,
        coverage: 0.0,
        region_colours: (0..count).map(|id| [id as u8; 3]).collect(),
        took_ms: [None; 7],
        trace: OnceLock::new(),
        accuracy: OnceLock::new(),
    }
}

/// A result with these final regions, in colours 10·id, whose body is the photograph.
pub(super) fn divided(picture: &Arc<Picture>, rows: &[&str]) -> Shown {
    let mut shown = shown(picture);
    let labels = labels(rows);
    let last = labels.as_slice().iter().copied().max().unwrap_or(0);
    let pixels = |id| labels.as_slice().iter().filter(|&&label| label == id).count();
    let regions = (1..=last).map(|id| region(id, pixels(id))).collect();
    shown.region_colours = (1..=last).map(|id| [10 * id as u8; 3]).collect();
    shown.analysis.intrinsic = Arc::new(Intrinsic { regions, ..Intrinsic::clone(&shown.analysis.intrinsic) });
    let finals = FinalRegions { labels, ..FinalRegions::clone(&shown.analysis.finals) };
    shown.analysis.finals = Arc::new(finals);
    shown
}

/// A grey region under red light.
pub(super) fn region(id: u16, pixels: usize) -> RegionReflection {
    RegionReflection {
        id,
        pixels,
        matte_pixels: pixels,
        highlight_pixels: 0,
        clipped_pixels: 0,
        body: [3f64.sqrt().recip(); 3],
        surface: Some([1.0, 0.0, 0.0]),
        matte_mean: [100.0; 3],
        highlight_start: None,
        highlight_branches: Vec::new(),
        plane_normal: None,
        angle_deg: None,
        fit_rms_counts: 1.5,
        holds: true,
        confidence: 1.0,
        texture: 0.0,
        separable: true,
        neighbours: Vec::new(),
        warnings: Vec::new(),
    }
}
