//! Photographs of every format: written by the test itself, read back to exact linear counts, and written again.

#![allow(clippy::float_cmp, reason = "exactness is what is tested")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod broken;
mod encodings;
mod files;
mod formats;
mod matte;

use dichroscope::photo::{EncodingChoice, Photo, ReadOptions, decode};

/// The options that take every value for linear light.
fn linear() -> ReadOptions {
    ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() }
}

/// Reads a picture that must be readable.
fn read_with(bytes: &[u8], options: &ReadOptions) -> Photo {
    decode(bytes, "test", options).unwrap_or_else(|error| panic!("{error}"))
}

/// Reads a picture as linear light: its counts are its samples over their maximum times 255.
fn read_linear(bytes: &[u8]) -> Photo {
    read_with(bytes, &linear())
}

/// The pixels row by row.
fn pixels(photo: &Photo) -> &[[f32; 3]] {
    photo.image.pixels.as_slice()
}

/// Gray pixels of these counts.
fn gray(counts: &[f32]) -> Vec<[f32; 3]> {
    counts.iter().map(|&c| [c; 3]).collect()
}
