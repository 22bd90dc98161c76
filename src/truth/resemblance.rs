//! Whether a ground truth is that of a photograph.
//!
//! Body and surface reflection of a truth together are the photograph without noise and clipping. Both are compared as means over
//! blocks of pixels, which noise and compression hardly change. On all rendered scenes, also with noise of 20 counts and as JPEG of
//! quality 30, the truth of the photograph has 28.4 dB or more. The truth of another scene has 17 dB or less; that of the same objects
//! under a lamp of another color 22.7 to 29.9; the photograph read in the wrong encoding 25.4 or less.

use super::folder::GroundTruth;
use super::measures::psnr_db;
use crate::raster::{Raster, UNASSIGNED};
use std::collections::BTreeMap;

/// Least peak signal-to-noise ratio of the photograph that a truth belongs to, decibels.
const LEAST_DB: f64 = 27.0;
/// Side of the blocks over whose pixels colors are averaged.
const BLOCK_PX: usize = 8;
/// Brighter values are not compared: most photographs clip there, counts.
const MOST_COUNTS: f32 = 255.0;

/// The sentence that says that a truth is hardly that of `photograph` (linear counts); none where it may be, and where sizes differ.
pub fn doubt_about_truth(truth: &GroundTruth, photograph: &Raster<[f32; 3]>) -> Option<String> {
    let found = resemblance_db(truth, photograph)?;
    (found < LEAST_DB).then(|| {
        format!(
            "the ground truth is hardly that of this photograph: its body and surface reflection together are at {found:.1} dB from \
             the photograph, where at least {LEAST_DB:.0} are usual; is it the truth of another picture, or is the photograph read in \
             the wrong encoding?"
        )
    })
}

/// How near a photograph is to body and surface reflection of a truth together, decibels; none without objects and where sizes differ.
fn resemblance_db(truth: &GroundTruth, photograph: &Raster<[f32; 3]>) -> Option<f64> {
    let width = truth.labels.width();
    if (photograph.width(), photograph.height()) != (width, truth.labels.height()) {
        return None;
    }
    let mut blocks: BTreeMap<(usize, usize), (f64, [f64; 3])> = BTreeMap::new();
    for pixel in (0..photograph.len()).filter(|&pixel| truth.labels[pixel] != UNASSIGNED) {
        let block = (pixel / width / BLOCK_PX, pixel % width / BLOCK_PX);
        let (count, sums) = blocks.entry(block).or_default();
        *count += 1.0;
        for (band, sum) in sums.iter_mut().enumerate() {
            let expected = truth.body[pixel][band] + truth.surface[pixel][band];
            *sum += f64::from(photograph[pixel][band].min(MOST_COUNTS) - expected.min(MOST_COUNTS));
        }
    }
    let least = (BLOCK_PX * BLOCK_PX) as f64 / 2.0;
    let whole = blocks.into_values().filter(|(count, _)| *count >= least);
    psnr_db(whole.flat_map(|(count, sums)| sums.map(|sum| sum / count)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::{EncodingChoice, ReadOptions, decode};
    use crate::truth::sample::SAMPLES;
    use std::sync::Arc;

    fn photograph(bytes: &[u8], encoding: EncodingChoice) -> Raster<[f32; 3]> {
        let options = ReadOptions { encoding, ..ReadOptions::default() };
        Arc::unwrap_or_clone(decode(bytes, "camera8.png", &options).unwrap().image).pixels
    }

    #[test]
    fn a_truth_is_told_from_that_of_another_scene_and_of_another_encoding() {
        for sample in &SAMPLES {
            let truth = sample.truth().unwrap();
            for other in &SAMPLES {
                let own = sample.name == other.name;
                let found = resemblance_db(&truth, &photograph(other.camera, EncodingChoice::Auto)).unwrap();
                assert!(
                    if own { found > 40.0 } else { found < 30.0 },
                    "{} {} {found}",
                    sample.name,
                    other.name
                );
            }
            let wrong = photograph(sample.camera, EncodingChoice::Srgb);
            assert!(doubt_about_truth(&truth, &wrong).is_some(), "{}", sample.name);
            assert_eq!(doubt_about_truth(&truth, &photograph(sample.camera, EncodingChoice::Auto)), None);
        }
        let [plastic, cups, ..] = &SAMPLES;
        let text =
            doubt_about_truth(&plastic.truth().unwrap(), &photograph(cups.camera, EncodingChoice::Auto));
        assert!(text.unwrap().starts_with("the ground truth is hardly that of this photograph"));
    }

    #[test]
    fn noise_does_not_make_a_truth_doubtful_and_another_size_is_no_matter_of_doubt() {
        let sample = &SAMPLES[0];
        let mut noisy = photograph(sample.camera, EncodingChoice::Auto);
        // A linear congruential generator; values of ±35 counts have a standard deviation of 20.
        let mut state = 1u32;
        for band in noisy.as_mut_slice().iter_mut().flatten() {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *band = (*band + ((state >> 16) as f32 / 65536.0 - 0.5) * 70.0).max(0.0);
        }
        assert_eq!(doubt_about_truth(&sample.truth().unwrap(), &noisy), None);
        let small = Raster::filled(3, 3, [0.0; 3]);
        assert_eq!(doubt_about_truth(&sample.truth().unwrap(), &small), None);
    }
}
