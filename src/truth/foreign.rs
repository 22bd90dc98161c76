//! Label maps and diffuse pictures that were made elsewhere, held against a result and against the ground truth.

use super::measures::{adjusted_rand_index, psnr_db};
use super::{GroundTruth, Outcome, ScoreError, score};
use crate::describe::{RegionFacts, Report, Scores};
use crate::raster::{LabelMap, Raster, UNASSIGNED};
use std::collections::BTreeMap;

/// What was made elsewhere from a photograph: a label map, a diffuse picture, or both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForeignResult {
    /// Label of each pixel, 0 for none.
    pub labels: Option<LabelMap>,
    /// Body reflection, linear counts.
    pub diffuse: Option<Raster<[f32; 3]>>,
}

/// How far what was made elsewhere agrees with a result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Agreement {
    /// Adjusted Rand index of both label maps over the pixels that both give a label.
    pub ari: Option<f64>,
    /// Share of the result's assigned pixels that the other map gives a label too.
    pub shared: Option<f64>,
    /// PSNR between the diffuse picture and the result's body image, over all pixels.
    pub psnr_body: Option<f64>,
}

impl Agreement {
    /// The figures that there are, with their names.
    pub fn figures(&self) -> Vec<(&'static str, Option<f64>)> {
        let all = [("ari", self.ari), ("shared", self.shared), ("psnr_body", self.psnr_body)];
        all.into_iter().filter(|(_, figure)| figure.is_some()).collect()
    }
}

/// The scores that mean something for a label map alone, and those for a diffuse picture alone.
const OF_LABELS: [&str; 5] = ["ari", "iou", "iou_min", "cover", "regions"];
const OF_DIFFUSE: [&str; 6] = [
    "psnr_body",
    "psnr_nothing",
    "psnr_surface",
    "psnr_surface_nothing",
    "psnr_restored",
    "psnr_restored_nothing",
];

impl ForeignResult {
    /// The figures of `scores` that mean something for what was made elsewhere, with their names: those of regions for a label map, those
    /// of pictures for a diffuse picture.
    pub fn figures(&self, scores: &Scores) -> Vec<(&'static str, Option<f64>)> {
        let wanted = |name: &str| {
            (self.labels.is_some() && OF_LABELS.contains(&name))
                || (self.diffuse.is_some() && OF_DIFFUSE.contains(&name))
        };
        scores.figures().into_iter().filter(|(name, _)| wanted(name)).collect()
    }

    /// An error where a picture has another size than `width` × `height`, or holds values that are not finite.
    ///
    /// # Errors
    /// [`ScoreError::Size`] or [`ScoreError::NotFinite`].
    pub fn check(&self, width: usize, height: usize) -> Result<(), ScoreError> {
        let sizes = [
            ("label map", self.labels.as_ref().map(|labels| (labels.width(), labels.height()))),
            ("diffuse picture", self.diffuse.as_ref().map(|diffuse| (diffuse.width(), diffuse.height()))),
        ];
        for (what, found) in sizes {
            if let Some(found) = found.filter(|&found| found != (width, height)) {
                return Err(ScoreError::Size {
                    what,
                    found,
                    compared_with: "analyzed photograph",
                    expected: (width, height),
                });
            }
        }
        let finite = |diffuse: &Raster<[f32; 3]>| diffuse.as_slice().iter().flatten().all(|v| v.is_finite());
        if self.diffuse.as_ref().is_some_and(|diffuse| !finite(diffuse)) {
            return Err(ScoreError::NotFinite("diffuse picture"));
        }
        Ok(())
    }

    /// The agreement with a result: `regions` are the labels of its regions, `body` is its body reflection in counts.
    ///
    /// # Errors
    /// As [`ForeignResult::check`].
    pub fn agreement(&self, regions: &LabelMap, body: &Raster<[f32; 3]>) -> Result<Agreement, ScoreError> {
        self.check(regions.width(), regions.height())?;
        let mut agreement = Agreement::default();
        if let Some(labels) = &self.labels {
            let pairs = labels.as_slice().iter().copied().zip(regions.as_slice().iter().copied());
            let assigned: Vec<(u16, u16)> = pairs.filter(|pair| pair.1 != UNASSIGNED).collect();
            let shared: Vec<(u16, u16)> =
                assigned.iter().copied().filter(|pair| pair.0 != UNASSIGNED).collect();
            agreement.shared = (!assigned.is_empty()).then(|| shared.len() as f64 / assigned.len() as f64);
            agreement.ari = (!shared.is_empty()).then(|| adjusted_rand_index(shared));
        }
        if let Some(diffuse) = &self.diffuse {
            let both = diffuse.as_slice().iter().flatten().zip(body.as_slice().iter().flatten());
            agreement.psnr_body = psnr_db(both.map(|(a, b)| f64::from(*a) - f64::from(*b)));
        }
        Ok(agreement)
    }

    /// The scores against the ground truth, as those of a result: without a label map the figures of regions mean nothing, without a
    /// diffuse picture those of pictures. The surface reflection is the photograph without the diffuse picture. `camera`: the photograph
    /// that the truth belongs to, linear counts; `report`: that of the result.
    ///
    /// # Errors
    /// As [`ForeignResult::check`] and [`score()`].
    pub fn scores(
        &self,
        truth: &GroundTruth,
        camera: &Raster<[f32; 3]>,
        report: &Report,
    ) -> Result<Scores, ScoreError> {
        let (width, height) = (truth.labels.width(), truth.labels.height());
        self.check(width, height)?;
        let regions = self.labels.clone().unwrap_or_else(|| LabelMap::filled(width, height, UNASSIGNED));
        let body = self.diffuse.as_ref().unwrap_or(camera);
        let mut surface = camera.clone();
        for (color, diffuse) in surface.as_mut_slice().iter_mut().zip(body.as_slice()) {
            *color = std::array::from_fn(|band| color[band] - diffuse[band]);
        }
        let mut report = report.clone();
        report.regions = region_facts(&regions, body);
        report.illuminant.direction = None;
        score(truth, camera, &Outcome { regions: &regions, body, surface: &surface, report: &report })
    }
}

/// Number of pixels and mean color, as a unit vector, of each label.
fn region_facts(labels: &LabelMap, body: &Raster<[f32; 3]>) -> Vec<RegionFacts> {
    let mut sums: BTreeMap<u16, (usize, [f64; 3])> = BTreeMap::new();
    for (&label, color) in labels.as_slice().iter().zip(body.as_slice()).filter(|(label, _)| **label > 0) {
        let (pixels, sum) = sums.entry(label).or_default();
        *pixels += 1;
        sum.iter_mut().zip(color).for_each(|(sum, &band)| *sum += f64::from(band));
    }
    let facts = |(id, (pixels, sum)): (u16, (usize, [f64; 3]))| {
        let length = sum.iter().map(|band| band * band).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        RegionFacts { id, pixels, body: sum.map(|band| band / length), ..RegionFacts::default() }
    };
    sums.into_iter().map(facts).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn agreement(foreign: &ForeignResult) -> Result<Agreement, ScoreError> {
        let regions = LabelMap::from_vec(4, 1, vec![1, 1, 2, 0]).unwrap();
        foreign.agreement(&regions, &Raster::filled(4, 1, [50.0; 3]))
    }

    #[test]
    fn agreement_counts_pixels_of_both_maps_only() {
        let labels = LabelMap::from_vec(4, 1, vec![7, 7, 9, 9]);
        let diffuse = Some(Raster::filled(4, 1, [50.0; 3]));
        let found = agreement(&ForeignResult { labels, diffuse }).unwrap();
        assert_eq!((found.ari, found.shared), (Some(1.0), Some(1.0)));
        assert!(found.psnr_body.unwrap() > 130.0);
        let labels = LabelMap::from_vec(4, 1, vec![7, 0, 7, 7]);
        let found = agreement(&ForeignResult { labels, diffuse: None }).unwrap();
        assert_eq!((found.shared, found.psnr_body), (Some(2.0 / 3.0), None));
    }

    #[test]
    fn another_size_and_values_that_are_not_finite_are_errors() {
        let other = ForeignResult { labels: LabelMap::from_vec(2, 1, vec![1, 1]), diffuse: None };
        let error = agreement(&other).unwrap_err().to_string();
        assert!(error.starts_with("the label map is 2\u{d7}1"), "{error}");
        let bad = ForeignResult { labels: None, diffuse: Some(Raster::filled(4, 1, [f32::NAN; 3])) };
        assert_eq!(agreement(&bad), Err(ScoreError::NotFinite("diffuse picture")));
    }
}
