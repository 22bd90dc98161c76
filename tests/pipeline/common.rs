//! Helpers that run scenes, and invariants of every result.

use crate::synthetic::{Rendered, Scene};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::describe::{ImageFacts, Report, Scores};
use dichroscope::intrinsic::Intrinsic;
use dichroscope::params::{Method, Params, Reading, Readings};
use dichroscope::photo::LinearImage;
use dichroscope::raster::{Raster, RegionId, UNASSIGNED};
use dichroscope::trace::PixelKind;
use dichroscope::truth::{GroundTruth, Outcome, TruthObject, score};
use proptest::prelude::*;
use std::sync::Arc;

pub const METHODS: [Method; 5] = Method::ALL;

/// Any readings of the paper: each on or off.
pub fn any_readings() -> impl Strategy<Value = Readings> {
    prop::collection::vec(any::<bool>(), Reading::ALL.len()).prop_map(|switches| {
        let mut readings = Readings::PAPER;
        for (reading, on) in Reading::ALL.into_iter().zip(switches) {
            readings.set(reading, on);
        }
        readings
    })
}

pub fn picture(width: usize, height: usize, color: impl Fn(usize, usize) -> [f32; 3]) -> LinearImage {
    let data = (0..width * height).map(|pixel| color(pixel % width, pixel / width)).collect();
    LinearImage::new(Raster::from_vec(width, height, data).unwrap(), Some(255.0))
}

/// Whether a pixel of a region has no surface reflection, or so little that a part of it may have been taken for noise: less than three times
/// the least distance off the body line, which is σ0 for linear values, where body and surface vector are less than 30° apart.
pub fn may_be_cut(analysis: &Analysis, pixel: usize) -> bool {
    let surface = analysis.intrinsic.surface[pixel];
    let region = RegionId::from_label(analysis.finals.labels[pixel]);
    let angle_deg = region.and_then(|region| analysis.intrinsic.regions[region.index()].angle_deg);
    let norm = surface.iter().map(|band| f64::from(*band).powi(2)).sum::<f64>().sqrt();
    let fades =
        |angle: f64| angle < 30.0 && norm * angle.to_radians().sin() < 3.0 * analysis.used.camera_noise;
    surface == [0.0; 3] || angle_deg.is_some_and(fades)
}

/// The result of a new session.
pub fn analyze(image: &LinearImage, params: &Params) -> Analysis {
    Session::new(Arc::new(image.clone())).run(params, &mut ()).unwrap()
}

/// The image in 8-bit sRGB, row by row.
pub fn srgb(image: &LinearImage) -> Vec<u8> {
    let coded = |counts: f32| {
        let linear = f64::from(counts / 255.0).clamp(0.0, 1.0);
        let coded =
            if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
        (255.0 * coded).round() as u8
    };
    image.pixels.as_slice().as_flattened().iter().map(|&counts| coded(counts)).collect()
}

/// Every number of a result as text. As text, floats keep all bits, −0 differs from 0, and NaN equals itself.
pub fn fingerprint(analysis: &Analysis) -> String {
    format!("{analysis:?}")
}

pub fn report(analysis: &Analysis, params: &Params) -> Report {
    let facts = ImageFacts {
        file: String::new(),
        sha256: String::new(),
        width: analysis.areas.width(),
        height: analysis.areas.height(),
        encoding: "linear".to_owned(),
        full_scale: 255.0,
    };
    Report::new(facts, params, analysis, &[])
}

/// The scene's ground truth in the form of a truth folder.
pub fn truth_of(scene: &Scene, rendered: &Rendered) -> GroundTruth {
    let object = |(index, ball): (usize, &crate::synthetic::Ball)| TruthObject {
        id: index as u16 + 1,
        body_vector: Some(ball.body),
    };
    GroundTruth {
        labels: rendered.labels.clone(),
        body: rendered.body.clone(),
        surface: rendered.surface.clone(),
        illuminant: scene.illuminant,
        objects: scene.balls.iter().enumerate().map(object).collect(),
    }
}

pub fn scores_of(truth: &GroundTruth, image: &LinearImage, analysis: &Analysis, params: &Params) -> Scores {
    let outcome = Outcome {
        regions: &analysis.finals.labels,
        body: &analysis.intrinsic.body,
        surface: &analysis.intrinsic.surface,
        report: &report(analysis, params),
    };
    score(truth, &image.pixels, &outcome).unwrap()
}

/// Whether body and surface reflection of a pixel are its color. A clipped band that was restored has more light than the file keeps; under
/// surface reflection the body may be turned by a small angle (`chromaticity_prior`), and the rest is in the residual.
fn is_whole(intrinsic: &Intrinsic, pixel: usize, color: [f32; 3], is_clipped: bool) -> bool {
    let (body, surface) = (intrinsic.body[pixel], intrinsic.surface[pixel]);
    let is_turned = surface.iter().any(|band| *band > 0.0);
    let rest: f32 = (0..3).map(|band| (color[band] - surface[band]).powi(2)).sum::<f32>().sqrt();
    (0..3).all(|band| {
        let (body, input) = (body[band], color[band]);
        let more = body + surface[band] - input;
        // Ambient light is subtracted and added again, which rounds.
        let rounding = 1e-5 * input.max(1.0);
        let limit = if is_turned { rounding + LARGEST_TURN * rest } else { rounding };
        (more.abs() <= limit || (more > 0.0 && is_clipped)) && body <= input + rounding
    })
}

/// Largest change of a band of body reflection under surface reflection, as a share of the length of body reflection.
const LARGEST_TURN: f32 = 0.5;

/// Checks the invariants of every result: labels, report and pictures agree, and no number is NaN or infinite.
///
/// Returns the violation as an error, so that property tests can shrink the input.
pub fn faults(image: &LinearImage, analysis: &Analysis) -> Vec<String> {
    let (intrinsic, regions) = (&analysis.intrinsic, &analysis.intrinsic.regions);
    let labels = &analysis.finals.labels;
    let mut faults = Vec::new();
    let mut expect = |holds: bool, what: &str| {
        if !holds {
            faults.push(what.to_owned());
        }
    };
    let size = (image.width(), image.height());
    expect((labels.width(), labels.height()) == size, "the region map has another size");
    expect((intrinsic.body.width(), intrinsic.body.height()) == size, "the body image has another size");
    expect((analysis.areas.width(), analysis.areas.height()) == size, "the area map has another size");
    let colors = intrinsic.body.as_slice().iter().chain(intrinsic.surface.as_slice());
    expect(colors.flatten().all(|v| v.is_finite()), "body or surface is not finite");
    expect(intrinsic.noise.as_slice().iter().all(|v| v.is_finite()), "noise is not finite");

    let mut counts = vec![[0usize; 3]; regions.len() + 1];
    for (pixel, &label) in labels.as_slice().iter().enumerate() {
        let kind = intrinsic.kinds[pixel];
        expect((label == UNASSIGNED) == (kind == PixelKind::Unassigned), "labels and kinds disagree");
        let Some(count) = counts.get_mut(usize::from(label)) else {
            expect(false, "a label without a region");
            continue;
        };
        count[0] += 1;
        count[1] += usize::from(kind == PixelKind::Matte);
        count[2] += usize::from(analysis.masks.clipped(pixel));
        if label == UNASSIGNED {
            let is_whole = is_whole(intrinsic, pixel, image.pixels[pixel], analysis.masks.clipped(pixel));
            expect(is_whole, "an unassigned pixel lost some of its color");
            expect(intrinsic.noise[pixel] == 0.0, "an unassigned pixel is noisy");
        }
    }
    let shares = intrinsic.confidence.as_slice();
    expect(shares.iter().all(|share| (0.0..=1.0).contains(share)), "a confidence is no share");
    expect(intrinsic.confidence.len() == labels.len(), "the confidence has another size");
    expect(intrinsic.reasons.len() == labels.len(), "the reasons have another size");
    expect(analysis.finals.hypotheses.len() == regions.len(), "a region without a skewed T");
    // The regions of the second look follow the others, and come from linear hypotheses of their own.
    for hypothesis in &analysis.working_finals.hypotheses {
        let origin = analysis.matte.hypotheses.get(hypothesis.origin.index());
        expect(origin.is_some(), "a region that comes from no linear hypothesis");
    }
    // Regions are numbered by their size in the working picture.
    let mut working_sizes = vec![0usize; regions.len() + 1];
    for &label in analysis.working_finals.labels.as_slice() {
        if let Some(size) = working_sizes.get_mut(usize::from(label)) {
            *size += 1;
        }
    }
    for (index, region) in regions.iter().enumerate() {
        let reported = [region.pixels, region.matte_pixels, region.clipped_pixels];
        expect(region.id.index() == index, "region numbers have gaps");
        expect(reported == counts[index + 1], "the report counts other pixels than the map holds");
        expect(region.matte_pixels + region.highlight_pixels == region.pixels, "matte + highlight ≠ pixels");
        expect(
            index == 0 || working_sizes[index] >= working_sizes[index + 1],
            "regions are not sorted by size",
        );
        expect(is_unit(region.body), "a body vector is not of unit length");
        expect(region.surface.is_none_or(is_unit), "a surface vector is not of unit length");
        expect(region.plane_normal.is_none_or(is_unit), "a plane's normal is not of unit length");
        expect(region.fit_rms_counts.is_finite(), "a fit is not finite");
        expect((0.0..=1.0).contains(&region.confidence), "a region's confidence is no share");
        expect(region.texture.is_finite(), "a texture is no number");
        expect(region.neighbors.is_sorted(), "neighbors are not sorted");
        let mutual = |other: &RegionId| {
            regions.get(other.index()).is_some_and(|other| other.neighbors.contains(&region.id))
        };
        expect(region.neighbors.iter().all(mutual), "a neighbor does not know its neighbor");
    }
    expect(
        analysis.illuminant.is_none_or(|light| is_unit(light.direction)),
        "the light is not of unit length",
    );
    expect(!regions.is_empty() || !analysis.warnings.is_empty(), "nothing was found, and nothing is said");
    faults.dedup();
    faults
}

#[track_caller]
pub fn assert_valid(image: &LinearImage, analysis: &Analysis, about: &str) {
    let faults = faults(image, analysis);
    assert!(faults.is_empty(), "{about}: {faults:?}");
}

fn is_unit(vector: [f64; 3]) -> bool {
    (vector.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-5
}

/// Largest difference between input and body + surface + ε·n, counts, over the pixels for which `counts` is true, and the number
/// of these pixels. A pixel in no region, and one whose region has no plane, has no ε·n.
pub fn largest_gap(image: &LinearImage, analysis: &Analysis, counts: impl Fn(usize) -> bool) -> (f32, usize) {
    let intrinsic = &analysis.intrinsic;
    let (mut gap, mut looked_at) = (0f32, 0);
    for pixel in (0..image.pixels.len()).filter(|&pixel| counts(pixel)) {
        let region = RegionId::from_label(analysis.finals.labels[pixel]);
        let region = region.and_then(|region| intrinsic.regions.get(region.index()));
        let normal = region.and_then(|region| region.plane_normal).unwrap_or_default();
        looked_at += 1;
        for (band, along) in normal.into_iter().enumerate() {
            let noise = intrinsic.noise[pixel] * along as f32;
            let sum = intrinsic.body[pixel][band] + intrinsic.surface[pixel][band] + noise;
            gap = gap.max((sum - image.pixels[pixel][band]).abs());
        }
    }
    (gap, looked_at)
}
