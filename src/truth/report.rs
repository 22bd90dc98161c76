//! The report of an analysis, with the scores against a ground truth.

use super::resemblance::doubt_about_truth;
use super::{GroundTruth, Outcome, ScoreError, score};
use crate::analysis::Analysis;
use crate::describe::{AreaFacts, ImageFacts, Report, Timings};
use crate::params::Params;
use crate::photo::Photo;
use crate::raster::Raster;

/// The data from which a report is made.
pub struct ReportInput<'a> {
    /// The photograph analyzed.
    pub photo: &'a Photo,
    /// SHA-256 of the photograph's file, hexadecimal.
    pub sha256: &'a str,
    /// The parameters of the analysis.
    pub params: &'a Params,
    /// The analysis.
    pub analysis: &'a Analysis,
    /// The area that the analysis was restricted to; none: the whole picture.
    pub area: Option<AreaFacts>,
    /// Durations of reading and of the stages.
    pub timings_ms: Timings,
    /// The ground truth to compare the result with; none: the report has no scores.
    pub reference: Option<Reference<'a>>,
}

/// A ground truth and the photograph that belongs to it.
#[derive(Clone, Copy)]
pub struct Reference<'a> {
    /// The ground truth.
    pub truth: &'a GroundTruth,
    /// The photograph's colors, linear counts.
    pub camera: &'a Raster<[f32; 3]>,
}

/// The report of an analysis, for `report.json`. A reference that is hardly that of the photograph is a warning.
///
/// # Errors
/// As [`score()`], where there is a reference.
pub fn report(input: ReportInput) -> Result<Report, ScoreError> {
    let ReportInput { photo, sha256, params, analysis, area, timings_ms, reference } = input;
    let mut report = Report::new(ImageFacts::of(photo, sha256), params, analysis, &photo.warnings);
    report.area = area;
    report.timings_ms = timings_ms;
    if let Some(Reference { truth, camera }) = reference {
        let intrinsic = &analysis.intrinsic;
        let outcome = Outcome {
            regions: &analysis.finals.labels,
            body: &intrinsic.body,
            surface: &intrinsic.surface,
            report: &report,
        };
        report.scores = Some(score(truth, camera, &outcome)?);
        report.warnings.extend(doubt_about_truth(truth, &photo.image.pixels));
    }
    Ok(report)
}
