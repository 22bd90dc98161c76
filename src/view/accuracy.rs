//! The accuracy of a result against the ground truth: as a whole, and region by region.

use super::Picture;
use crate::analysis::Analysis;
use crate::describe::{ImageFacts, Report, Scores};
use crate::params::Params;
use crate::raster::UNASSIGNED;
use crate::truth::{GroundTruth, Outcome, angle_deg, score};

/// Camera pixels nearer to black are dark and match nothing, counts; the limit of the scores.
const DARK_COUNTS: f32 = 23.0;

/// A result against the ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// All scores; [`Scores::illum_deg`] is the error of the light, and each PSNR has the PSNR of the unchanged input beside it.
    pub scores: Scores,
    /// The accuracy of each region, by [`RegionId::index`](crate::raster::RegionId::index).
    pub regions: Vec<RegionAccuracy>,
}

/// The accuracy of a region against the object with the largest overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionAccuracy {
    /// Number of the object; none for a region on the background.
    pub object: Option<u16>,
    /// Intersection over union of their lit pixels.
    pub iou: f64,
    /// Angle between its body vector and the object's, degrees; none for an object without one.
    pub body_deg: Option<f64>,
    /// Angle between its surface vector and the light, degrees; none for a region without one.
    pub surface_deg: Option<f64>,
}

/// Measures the result of a picture for the given parameters; none where the picture has no ground truth of its size.
/// Takes about as long as the analysis.
pub(super) fn accuracy(picture: &Picture, params: &Params, analysis: &Analysis) -> Option<Accuracy> {
    let (truth, photo) = (picture.truth.as_ref()?, &picture.photo);
    let facts = ImageFacts::of(photo, &picture.sha256);
    let report = Report::new(facts, params, analysis, &[]);
    let (body, surface) = (&analysis.intrinsic.body, &analysis.intrinsic.surface);
    let outcome = Outcome { regions: &analysis.finals.labels, body, surface, report: &report };
    let scores = score(truth, &photo.image.pixels, &outcome).ok()?;
    Some(Accuracy { scores, regions: regions(picture, analysis, truth) })
}

fn regions(picture: &Picture, analysis: &Analysis, truth: &GroundTruth) -> Vec<RegionAccuracy> {
    let regions = &analysis.intrinsic.regions;
    let labels = &analysis.finals.labels;
    let objects = truth.labels.as_slice().iter().max().map_or(0, |&last| usize::from(last)) + 1;
    // Lit pixels of each region (row; the first: of none) in each object.
    let mut shared = vec![0u64; (regions.len() + 1) * objects];
    for (pixel, &color) in picture.photo.image.pixels.as_slice().iter().enumerate() {
        if crate::color::dot(color, color) >= DARK_COUNTS * DARK_COUNTS {
            shared[usize::from(labels[pixel]) * objects + usize::from(truth.labels[pixel])] += 1;
        }
    }
    let in_object: Vec<u64> =
        (0..objects).map(|object| shared.iter().skip(object).step_by(objects).sum()).collect();
    let best = |row: &[u64]| {
        let size: u64 = row.iter().sum();
        let iou = |object: usize| row[object] as f64 / (size + in_object[object] - row[object]).max(1) as f64;
        (usize::from(UNASSIGNED) + 1..objects)
            .filter(|&object| row[object] > 0)
            .map(|object| (object as u16, iou(object)))
            .reduce(|best, next| if next.1 > best.1 { next } else { best })
    };
    let rows = shared.chunks_exact(objects).skip(1);
    rows.zip(regions)
        .map(|(row, region)| {
            let found = best(row);
            let true_body = found.and_then(|(object, _)| truth.body_vector(object));
            RegionAccuracy {
                object: found.map(|(object, _)| object),
                iou: found.map_or(0.0, |(_, iou)| iou),
                body_deg: true_body.map(|vector| angle_deg(region.body, vector)),
                surface_deg: region.surface.map(|surface| angle_deg(surface, truth.illuminant)),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use crate::truth::TruthObject;
    use crate::view::testing::{divided, gray, labels};
    use std::sync::Arc;

    #[test]
    fn each_region_is_compared_with_the_object_that_it_overlaps_most() {
        let found = ["11122", "11122", "....3"];
        let mut picture = Arc::into_inner(gray(&found, 100)).unwrap();
        let real = labels(&["11112", "11112", "....."]);
        let objects = vec![
            TruthObject { id: 1, body_vector: Some([2.0, 2.0, 0.0]) },
            TruthObject { id: 2, body_vector: None },
        ];
        let (body, surface) = (Raster::filled(5, 3, [100.0; 3]), Raster::filled(5, 3, [0.0; 3]));
        picture.truth =
            Some(GroundTruth { labels: real, body, surface, illuminant: [1.0, 1.0, 0.0], objects });
        let mut shown = divided(&Arc::new(picture), &found);
        let mut intrinsic = crate::intrinsic::Intrinsic::clone(&shown.analysis.intrinsic);
        intrinsic.regions[2].surface = None;
        shown.analysis.intrinsic = Arc::new(intrinsic);
        shown.measure();
        let accuracy = shown.accuracy().unwrap();
        assert_eq!((accuracy.scores.regions, accuracy.scores.objects), (3, 0));
        let [first, second, third] = accuracy.regions[..] else { panic!("{accuracy:?}") };
        assert_eq!((first.object, first.iou), (Some(1), 0.75));
        assert!((first.body_deg.unwrap() - (2.0f64 / 6f64.sqrt()).acos().to_degrees()).abs() < 1e-9);
        assert!((first.surface_deg.unwrap() - 45.0).abs() < 1e-9);
        assert_eq!((second.object, second.iou, second.body_deg), (Some(2), 0.5, None));
        assert_eq!((third.object, third.iou, third.surface_deg), (None, 0.0, None));
    }

    #[test]
    fn without_a_truth_there_is_no_accuracy() {
        let shown = divided(&gray(&["11"], 100), &["11"]);
        assert!(shown.accuracy().is_none());
        shown.measure();
        assert!(shown.accuracy().is_none());
    }
}
