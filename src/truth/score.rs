//! Scores of a result against the ground truth.

use super::folder::GroundTruth;
use super::measures::{Contingency, angle_deg, contingency, erode_labels, marginal, psnr_db, rand_index_of};
use crate::describe::{Report, Scores};
use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED};
use std::collections::BTreeMap;

/// Camera pixels nearer to black than this are dark, counts.
const DARK_COUNTS: f64 = 23.0;
/// Camera pixels with a band at or above this value are clipped, counts.
const CLIPPED_COUNTS: f32 = 240.0;
/// Objects with this many lit pixels or fewer are not scored.
const SMALL_OBJECT_PIXELS: u64 = 200;
/// Distance from an object's edge up to which the object's pixels mix with the background, steps of one pixel.
const EDGE_STEPS: usize = 2;

/// The pictures and the vectors of one result, to be scored.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<'a> {
    /// Region of each pixel.
    pub regions: &'a LabelMap,
    /// Body reflection, counts.
    pub body: &'a Raster<[f32; 3]>,
    /// Surface reflection, counts.
    pub surface: &'a Raster<[f32; 3]>,
    /// The report, for the vectors of regions and light.
    pub report: &'a Report,
}

/// Why a result cannot be scored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScoreError {
    /// A picture has another size than what it is compared with.
    #[error("the {what} is {}\u{d7}{}, the {compared_with} {}\u{d7}{}", found.0, found.1, expected.0, expected.1)]
    Size {
        /// The picture's name.
        what: &'static str,
        /// Columns and rows of the picture.
        found: (usize, usize),
        /// What the picture is compared with.
        compared_with: &'static str,
        /// Columns and rows that the picture should have.
        expected: (usize, usize),
    },
    /// A picture holds infinite values or NaN.
    #[error("the {0} holds values that are not finite")]
    NotFinite(&'static str),
    /// The report and the region map contradict each other.
    #[error("region {id}: the report says {reported} pixels, the region map holds {found}")]
    Pixels {
        /// The region.
        id: u16,
        /// Number of pixels according to the report, 0 where the report lacks the region.
        reported: u64,
        /// Number of pixels in the region map.
        found: u64,
    },
}

/// Scores a result. `camera` is the photograph that the truth belongs to, in linear counts.
///
/// # Errors
/// When sizes differ, a picture is not finite, or report and region map contradict each other.
pub fn score(
    truth: &GroundTruth,
    camera: &Raster<[f32; 3]>,
    outcome: &Outcome,
) -> Result<Scores, ScoreError> {
    check(truth, camera, outcome)?;
    let lit = camera.map(|&c| norm(c) >= DARK_COUNTS);
    let pairs = |keep: &dyn Fn(usize) -> bool| {
        let kept = (0..lit.len()).filter(|&pixel| keep(pixel));
        contingency(kept.map(|pixel| (truth.labels[pixel], outcome.regions[pixel])))
    };
    let all_lit = pairs(&|pixel| lit[pixel]);
    let visible = pairs(&|pixel| lit[pixel] && truth.labels[pixel] != UNASSIGNED);
    let objects: Vec<u16> = marginal(&visible, |pair| pair.0)
        .into_iter()
        .filter_map(|(id, pixels)| (pixels > SMALL_OBJECT_PIXELS).then_some(id))
        .collect();
    let matches: Vec<Match> = best_regions(&objects, &all_lit);
    let ious: Vec<f64> = matches.iter().map(|found| found.iou).collect();
    let light = outcome.report.illuminant.direction;
    Ok(Scores {
        ari: if objects.len() > 1 { rand_index_of(&visible) } else { 1.0 },
        iou: mean(ious.iter().copied()),
        iou_min: ious.iter().copied().reduce(f64::min),
        cover: coverage(&visible),
        regions: outcome.report.regions.len(),
        objects: objects.len(),
        body_deg: mean(body_errors_deg(truth, outcome.report, &matches)),
        illum_deg: light.map_or(90.0, |light| angle_deg(light, truth.illuminant)),
        ..pictures(truth, camera, outcome, &lit, &objects)
    })
}

/// Checks that sizes agree, that pictures are finite, and that report and region map agree.
fn check(truth: &GroundTruth, camera: &Raster<[f32; 3]>, outcome: &Outcome) -> Result<(), ScoreError> {
    let expected = (truth.labels.width(), truth.labels.height());
    let sizes = [
        ("photograph", (camera.width(), camera.height())),
        ("region map", (outcome.regions.width(), outcome.regions.height())),
        ("body image", (outcome.body.width(), outcome.body.height())),
        ("surface image", (outcome.surface.width(), outcome.surface.height())),
    ];
    if let Some(&(what, found)) = sizes.iter().find(|(_, size)| *size != expected) {
        return Err(ScoreError::Size { what, found, compared_with: "ground truth", expected });
    }
    for (what, picture) in [("body image", outcome.body), ("surface image", outcome.surface)] {
        if !picture.as_slice().iter().flatten().all(|v| v.is_finite()) {
            return Err(ScoreError::NotFinite(what));
        }
    }
    let reported: BTreeMap<u16, u64> =
        outcome.report.regions.iter().map(|region| (region.id, region.pixels as u64)).collect();
    let found = marginal(&contingency(outcome.regions.as_slice().iter().map(|&id| (id, id))), |pair| pair.0);
    for (id, found) in found.into_iter().filter(|&(id, _)| id != UNASSIGNED) {
        let reported = reported.get(&id).copied().unwrap_or(0);
        if reported != found {
            return Err(ScoreError::Pixels { id, reported, found });
        }
    }
    Ok(())
}

/// An object and the region that overlaps the object best.
struct Match {
    object: u16,
    /// None where no region touches the object.
    region: Option<u16>,
    iou: f64,
}

/// Best region of each object by intersection over union of lit pixels; of equally good regions the one with the higher label.
fn best_regions(objects: &[u16], lit: &Contingency) -> Vec<Match> {
    let object_sizes = marginal(lit, |pair| pair.0);
    let region_sizes = marginal(lit, |pair| pair.1);
    objects
        .iter()
        .map(|&object| {
            let mut best = Match { object, region: None, iou: 0.0 };
            for (&(_, region), &shared) in lit.range((object, 1)..=(object, u16::MAX)) {
                let union = object_sizes[&object] + region_sizes[&region] - shared;
                let iou = shared as f64 / union as f64;
                if iou >= best.iou {
                    best = Match { object, region: Some(region), iou };
                }
            }
            best
        })
        .collect()
}

/// Share of the counted pixels that are in a region; none without pixels.
fn coverage(visible: &Contingency) -> Option<f64> {
    let assigned = visible.iter().filter(|((_, region), _)| *region != UNASSIGNED);
    let (assigned, all): (u64, u64) = (assigned.map(|(_, n)| n).sum(), visible.values().sum());
    (all > 0).then(|| assigned as f64 / all as f64)
}

/// Angle between the true body vector of each object and the body vector of the object's best region, degrees. Objects without
/// a true body vector or a best region are left out.
fn body_errors_deg(truth: &GroundTruth, report: &Report, matches: &[Match]) -> Vec<f64> {
    let found = |id| report.regions.iter().find(|region| region.id == id).map(|region| region.body);
    matches.iter().filter_map(|m| Some(angle_deg(found(m.region?)?, truth.body_vector(m.object)?))).collect()
}

/// The PSNRs of body, surface and restored pixels, and the PSNRs of the unchanged photograph; all other figures are zero.
fn pictures(
    truth: &GroundTruth,
    camera: &Raster<[f32; 3]>,
    outcome: &Outcome,
    lit: &Mask,
    objects: &[u16],
) -> Scores {
    let core = erode_labels(&truth.labels, EDGE_STEPS, |id| objects.contains(&id));
    let peak = |pixel: usize| camera[pixel].into_iter().fold(f32::MIN, f32::max);
    let least = |pixel: usize| camera[pixel].into_iter().fold(f32::MAX, f32::min);
    let interior: Vec<usize> =
        (0..core.len()).filter(|&p| core[p] && lit[p] && peak(p) < CLIPPED_COUNTS).collect();
    let distorted: Vec<usize> = (0..core.len())
        .filter(|&p| truth.labels[p] != UNASSIGNED && peak(p) >= CLIPPED_COUNTS && least(p) < CLIPPED_COUNTS)
        .collect();
    let nothing = Raster::filled(camera.width(), camera.height(), [0.0f32; 3]);
    Scores {
        psnr_body: psnr_between(outcome.body, &truth.body, &interior),
        psnr_nothing: psnr_between(camera, &truth.body, &interior),
        psnr_surface: psnr_between(outcome.surface, &truth.surface, &interior),
        psnr_surface_nothing: psnr_between(&nothing, &truth.surface, &interior),
        psnr_restored: psnr_between(outcome.body, &truth.body, &distorted),
        psnr_restored_nothing: psnr_between(camera, &truth.body, &distorted),
        ..Scores::default()
    }
}

/// PSNR between two pictures over the given pixels and all bands; none without pixels.
fn psnr_between(a: &Raster<[f32; 3]>, b: &Raster<[f32; 3]>, pixels: &[usize]) -> Option<f64> {
    psnr_db(
        pixels.iter().flat_map(|&p| (0..3).map(move |band| f64::from(a[p][band]) - f64::from(b[p][band]))),
    )
}

fn norm(color: [f32; 3]) -> f64 {
    color.iter().map(|&v| f64::from(v).powi(2)).sum::<f64>().sqrt()
}

fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (n, sum) = values.into_iter().fold((0usize, 0.0), |(n, sum), v| (n + 1, sum + v));
    (n > 0).then(|| sum / n as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Session;
    use crate::describe::{ImageFacts, RegionFacts};
    use crate::params::Params;
    use crate::photo::LinearImage;
    use crate::truth::TruthObject;
    use std::sync::Arc;

    const SIZE: (usize, usize) = (40, 20);
    const COLORS: [[f32; 3]; 3] = [[0.0; 3], [100.0, 0.0, 0.0], [0.0, 0.0, 60.0]];

    /// Two objects side by side, 18 columns each, with background between the objects and a clipped pixel in the first one.
    struct Scene {
        truth: GroundTruth,
        camera: Raster<[f32; 3]>,
        report: Report,
    }

    fn scene() -> Scene {
        let label = |i: usize| match i % SIZE.0 {
            0..18 => 1,
            22.. => 2,
            _ => 0,
        };
        let labels = Raster::from_vec(SIZE.0, SIZE.1, (0..SIZE.0 * SIZE.1).map(label).collect()).unwrap();
        let body = labels.map(|&id| COLORS[usize::from(id)]);
        let mut camera = body.clone();
        camera[5 * SIZE.0 + 5] = [250.0, 5.0, 5.0];
        let surface = Raster::filled(SIZE.0, SIZE.1, [0.0; 3]);
        let objects = vec![
            TruthObject { id: 1, body_vector: Some([1.0, 0.0, 0.0]) },
            TruthObject { id: 2, body_vector: None },
        ];
        let truth = GroundTruth { labels, body, surface, illuminant: [0.0, 3.0, 0.0], objects };
        Scene { report: report_of(&truth.labels, &camera), truth, camera }
    }

    fn report_of(regions: &LabelMap, camera: &Raster<[f32; 3]>) -> Report {
        let image = Arc::new(LinearImage::new(camera.clone(), None));
        let params = Params::default();
        let analysis = Session::new(image).run(&params, &mut ()).unwrap();
        let facts = ImageFacts {
            file: String::new(),
            sha256: String::new(),
            width: SIZE.0,
            height: SIZE.1,
            encoding: String::new(),
            full_scale: 255.0,
        };
        let region = |id| RegionFacts {
            id,
            pixels: regions.as_slice().iter().filter(|&&label| label == id).count(),
            body: if id == 1 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] },
            ..RegionFacts::default()
        };
        let last = regions.as_slice().iter().copied().max().unwrap();
        Report { regions: (1..=last).map(region).collect(), ..Report::new(facts, &params, &analysis, &[]) }
    }

    impl Scene {
        fn score(&self, regions: &LabelMap) -> Result<Scores, ScoreError> {
            let Self { truth, camera, report } = self;
            let outcome = Outcome { regions, body: &truth.body, surface: &truth.surface, report };
            score(truth, camera, &outcome)
        }
    }

    #[test]
    fn the_truth_itself_scores_best() {
        let scene = scene();
        let scores = scene.score(&scene.truth.labels).unwrap();
        assert_eq!(
            (scores.ari, scores.iou, scores.iou_min, scores.cover),
            (1.0, Some(1.0), Some(1.0), Some(1.0))
        );
        assert_eq!((scores.regions, scores.objects, scores.body_deg), (2, 2, Some(0.0)));
        assert!((scores.illum_deg - 90.0).abs() < 1e-12, "no illuminant was found");
        assert!(scores.psnr_body.unwrap() > 130.0 && scores.psnr_restored.unwrap() > 130.0);
        let offset = (150f64.powi(2) + 5f64.powi(2) + 5f64.powi(2)) / 3.0;
        let expected = 10.0 * (255f64.powi(2) / offset).log10();
        assert!((scores.psnr_restored_nothing.unwrap() - expected).abs() < 1e-9);
    }

    #[test]
    fn half_an_object_is_half_an_intersection() {
        let mut scene = scene();
        let mut index = 0;
        let regions = scene.truth.labels.map(|&id| {
            index += 1;
            if id == 2 || (id == 1 && (index - 1) % SIZE.0 < 9) { id } else { UNASSIGNED }
        });
        scene.report = report_of(&regions, &scene.camera);
        scene.report.illuminant.direction = Some([0.0, 0.5, 0.5]);
        let scores = scene.score(&regions).unwrap();
        assert_eq!((scores.iou, scores.iou_min, scores.cover), (Some(0.75), Some(0.5), Some(0.75)));
        assert!((scores.illum_deg - 45.0).abs() < 1e-9);
    }

    #[test]
    fn contradictory_results_are_not_scored() {
        let mut scene = scene();
        let wrong_size = Raster::filled(3, 3, 0);
        let error = scene.score(&wrong_size).unwrap_err().to_string();
        assert_eq!(error, "the region map is 3\u{d7}3, the ground truth 40\u{d7}20");
        scene.report.regions[0].pixels += 1;
        let error = scene.score(&scene.truth.labels).unwrap_err().to_string();
        assert_eq!(error, "region 1: the report says 361 pixels, the region map holds 360");
        scene.truth.surface[0] = [f32::NAN, 0.0, 0.0];
        let error = scene.score(&scene.truth.labels).unwrap_err();
        assert_eq!(error, ScoreError::NotFinite("surface image"));
    }

    #[test]
    fn a_dark_scene_has_no_figures_but_no_error_either() {
        let mut scene = scene();
        scene.camera = Raster::filled(SIZE.0, SIZE.1, [1.0; 3]);
        let scores = scene.score(&scene.truth.labels).unwrap();
        assert_eq!((scores.objects, scores.iou, scores.cover, scores.psnr_body), (0, None, None, None));
        assert!((scores.ari - 1.0).abs() < 1e-12);
    }
}
