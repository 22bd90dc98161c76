//! Samples of chosen bands, in the type and range that the rest of the program uses.

use super::chunks::gather;
use super::page::{Kind, Page};
use super::photometric;
use super::samples::Sample;
use crate::photo::decode::Decoded;
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Layout, Samples};

/// The bands `channels` of a page, which are those of `layout`.
pub(super) fn of_channels(page: &Page, channels: &[usize], layout: Layout) -> Result<Decoded, Fault> {
    match (page.kind, page.bits) {
        (Kind::Float, 16 | 24 | 32 | 64) => floats(page, channels, layout),
        // A sign alone is no number.
        (Kind::Signed, 1) => Err(Fault::unsupported("signed integers of 1 bit", CONVERT)),
        (Kind::Unsigned | Kind::Signed, 1..=8) => integers(page, channels, layout, Samples::U8),
        (Kind::Unsigned | Kind::Signed, 9..=16) => integers(page, channels, layout, Samples::U16),
        (Kind::Unsigned | Kind::Signed, 17..=32) => integers(page, channels, layout, Samples::U32),
        (kind, bits) => Err(Fault::unsupported(format!("{} of {bits} bits", kind.name()), CONVERT)),
    }
}

fn floats(page: &Page, channels: &[usize], layout: Layout) -> Result<Decoded, Fault> {
    let mut samples: Vec<f32> = gather(page, channels)?;
    if page.photometric == photometric::WHITE_IS_ZERO {
        for pixel in samples.chunks_exact_mut(channels.len()) {
            pixel[0] = 1.0 - pixel[0];
        }
    }
    Ok(Decoded::plain((page.width, page.height), layout, Samples::F32(samples)))
}

/// A type of integers that samples are unpacked to.
trait Integer: Sample + Into<u32> + TryFrom<u32> {}

impl Integer for u8 {}
impl Integer for u16 {}
impl Integer for u32 {}

fn integers<T: Integer>(
    page: &Page,
    channels: &[usize],
    layout: Layout,
    wrap: fn(Vec<T>) -> Samples,
) -> Result<Decoded, Fault> {
    let mut samples: Vec<T> = gather(page, channels)?;
    let is_signed = page.kind == Kind::Signed;
    let mut max = u32::MAX >> (32 - page.bits + u32::from(is_signed));
    let mut negative = None;
    let narrowed = |value: u32| T::try_from(value).unwrap_or_default();
    if is_signed {
        let marks = samples.chunks_exact_mut(channels.len()).map(|pixel| {
            let below_zero = pixel.iter().any(|&sample| sample.into() > max);
            for sample in pixel.iter_mut().filter(|sample| (**sample).into() > max) {
                *sample = T::default();
            }
            below_zero
        });
        negative = Some(marks.collect());
    }
    if page.photometric == photometric::WHITE_IS_ZERO {
        for pixel in samples.chunks_exact_mut(channels.len()) {
            pixel[0] = narrowed(max - pixel[0].into());
        }
    }
    if matches!(page.bits, 1 | 2 | 4) && !is_signed {
        let spread = 255 / max;
        for sample in &mut samples {
            *sample = narrowed((*sample).into() * spread);
        }
        max = 255;
    }
    let plain = Decoded::plain((page.width, page.height), layout, wrap(samples));
    Ok(Decoded { max: Some(max), negative, ..plain })
}
