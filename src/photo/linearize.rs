//! Converts the samples of a file to linear counts, composited on black.

use super::curve::ToneCurve;
use super::source::{AlphaKind, Layout, Samples, Source};
use rayon::prelude::*;

/// Linear counts of every pixel; the curve's 1 is `full_scale` counts.
pub(super) fn linear_pixels(source: &Source, curves: &[ToneCurve; 3], full_scale: f64) -> Vec<[f32; 3]> {
    let (layout, alpha) = (source.layout, source.alpha);
    let max = source.max.unwrap_or(1);
    let opacity = |sample: u32| sample.min(max) as f32 / max as f32;
    match &source.samples {
        Samples::U8(samples) => {
            let tables = curves.each_ref().map(|curve| curve.table(1 << 8, max, full_scale));
            let counts = |band: usize, sample: u8| tables[band][usize::from(sample)];
            convert(samples, layout, alpha, counts, |sample| opacity(u32::from(sample)))
        }
        Samples::U16(samples) => {
            let tables = curves.each_ref().map(|curve| curve.table(1 << 16, max, full_scale));
            let counts = |band: usize, sample: u16| tables[band][usize::from(sample)];
            convert(samples, layout, alpha, counts, |sample| opacity(u32::from(sample)))
        }
        Samples::U32(samples) => {
            let counts = |band: usize, sample| curves[band].counts(sample, max, full_scale);
            convert(samples, layout, alpha, counts, opacity)
        }
        Samples::F32(samples) => {
            let counts = |band: usize, sample| (curves[band].linear(f64::from(sample)) * full_scale) as f32;
            convert(samples, layout, alpha, counts, |sample| sample)
        }
    }
}

/// Number of pixels that are not fully opaque; 0 for a layout without alpha.
pub(super) fn count_transparent(source: &Source) -> usize {
    fn count<T: Copy + Sync>(samples: &[T], channels: usize, opaque: impl Fn(T) -> bool + Sync) -> usize {
        samples.par_chunks_exact(channels).filter(|pixel| !opaque(pixel[channels - 1])).count()
    }
    if !source.layout.has_alpha() {
        return 0;
    }
    let channels = source.layout.channels();
    let max = source.max.unwrap_or(1);
    match &source.samples {
        Samples::U8(v) => count(v, channels, |alpha| u32::from(alpha) >= max),
        Samples::U16(v) => count(v, channels, |alpha| u32::from(alpha) >= max),
        Samples::U32(v) => count(v, channels, |alpha| alpha >= max),
        Samples::F32(v) => count(v, channels, |alpha| alpha >= 1.0),
    }
}

/// Pixels of one parallel task: enough that the cost of starting a task does not matter.
const CHUNK: usize = 1 << 14;

fn convert<T: Copy + Sync>(
    samples: &[T],
    layout: Layout,
    alpha: AlphaKind,
    counts: impl Fn(usize, T) -> f32 + Sync,
    opacity: impl Fn(T) -> f32 + Sync,
) -> Vec<[f32; 3]> {
    let channels = layout.channels();
    let weighted = layout.has_alpha() && alpha == AlphaKind::Straight;
    let mut pixels = vec![[0.0; 3]; samples.len() / channels];
    let chunks = pixels.par_chunks_mut(CHUNK).zip(samples.par_chunks(CHUNK * channels));
    chunks.for_each(|(pixels, samples)| {
        for (pixel, sample) in pixels.iter_mut().zip(samples.chunks_exact(channels)) {
            *pixel = if layout.is_gray() {
                [counts(0, sample[0]); 3]
            } else {
                [counts(0, sample[0]), counts(1, sample[1]), counts(2, sample[2])]
            };
            if weighted {
                let weight = opacity(sample[channels - 1]);
                *pixel = pixel.map(|band| band * weight);
            }
        }
    });
    pixels
}
