//! Tests of photographs of every format: files written by the tests are read to exact linear counts, and written
//! again.

#![allow(clippy::float_cmp, reason = "exactness is what is tested")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod arrangements;
mod broken;
mod encodings;
mod files;
mod formats;
mod gaps;
mod heif;
mod hostile;
mod kills;
mod matte;
mod tiffs;

use dichroscope::photo::{EncodingChoice, Photo, ReadOptions, decode};

/// Options under which samples are linear light.
fn linear() -> ReadOptions {
    ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() }
}

/// Reads a picture; fails if it cannot be read.
fn read_with(bytes: &[u8], options: &ReadOptions) -> Photo {
    decode(bytes, "test", options).unwrap_or_else(|error| panic!("{error}"))
}

/// Reads a picture as linear light: counts are samples, divided by their maximum, times 255.
fn read_linear(bytes: &[u8]) -> Photo {
    read_with(bytes, &linear())
}

/// The pixels, row-major.
fn pixels(photo: &Photo) -> &[[f32; 3]] {
    photo.image.pixels.as_slice()
}

/// Gray pixels with these counts in every band.
fn gray(counts: &[f32]) -> Vec<[f32; 3]> {
    counts.iter().map(|&c| [c; 3]).collect()
}
