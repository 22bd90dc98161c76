//! A label map and a diffuse picture that another program made of the open photograph, held against a result.

use super::figure_words::{FigureWords, agreement_words, score_words};
use super::snapshot::{best_overlaps, overlaps};
use super::{ElsewhereKind, ElsewherePaths, ResultSnapshot};
use crate::describe::{ImageFacts, Report};
use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED, dilate};
use crate::truth::{ForeignResult, ScoreError, psnr_db};
use std::cmp::Reverse;

/// Distance up to which two borders are one border, pixels.
const NEAR_PX: usize = 2;
/// Color of labels that no region of the result covers, sRGB.
const UNCOVERED: [u8; 3] = [150, 150, 150];
/// Shares of white (above 0) or black (below 0) that are mixed into the color of a region which covers several labels, the largest label
/// first.
const SHADES: [f32; 5] = [0.0, 0.4, -0.4, 0.65, -0.6];

/// What another program made of the open photograph, at the size of the photograph. Shared, never changed.
#[derive(Clone, Debug, Default)]
pub struct Elsewhere {
    /// The files.
    pub paths: ElsewherePaths,
    /// The pictures.
    pub pictures: ForeignResult,
}

impl Elsewhere {
    /// Whether there is a picture of a kind.
    pub const fn has(&self, kind: ElsewhereKind) -> bool {
        match kind {
            ElsewhereKind::Labels => self.pictures.labels.is_some(),
            ElsewhereKind::Diffuse => self.pictures.diffuse.is_some(),
        }
    }

    /// The pictures with those of `read`, a picture of one kind, in place of the picture of that kind.
    #[must_use]
    pub fn with(&self, read: Self) -> Self {
        let mut all = self.clone();
        if read.pictures.labels.is_some() {
            (all.paths.labels, all.pictures.labels) = (read.paths.labels, read.pictures.labels);
        }
        if read.pictures.diffuse.is_some() {
            (all.paths.diffuse, all.pictures.diffuse) = (read.paths.diffuse, read.pictures.diffuse);
        }
        all
    }

    /// The pictures without that of a kind; none where nothing is left.
    pub fn without(&self, kind: ElsewhereKind) -> Option<Self> {
        let mut rest = self.clone();
        match kind {
            ElsewhereKind::Labels => (rest.paths.labels, rest.pictures.labels) = (None, None),
            ElsewhereKind::Diffuse => (rest.paths.diffuse, rest.pictures.diffuse) = (None, None),
        }
        ElsewhereKind::ALL.into_iter().any(|kind| rest.has(kind)).then_some(rest)
    }

    /// What is known of a pixel.
    pub fn at(&self, pixel: usize) -> ElsewherePixel {
        let labels = self.pictures.labels.as_ref();
        ElsewherePixel {
            label: labels.and_then(|labels| labels.as_slice().get(pixel).copied()),
            diffuse: self.pictures.diffuse.as_ref().and_then(|body| body.as_slice().get(pixel).copied()),
        }
    }
}

/// The values of another program at a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElsewherePixel {
    /// The label, 0 for none; none without a label map.
    pub label: Option<u16>,
    /// The diffuse picture, linear counts; none without one.
    pub diffuse: Option<[f32; 3]>,
}

/// A figure of another program's pictures, beside those of the result and of doing nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldFigure {
    /// Key of the figure in files.
    pub key: &'static str,
    /// The words with which the figure is shown.
    pub words: FigureWords,
    /// Of the other program.
    pub elsewhere: Option<f64>,
    /// Of the result; none for a figure that compares both.
    pub result: Option<f64>,
    /// Of the unchanged photograph in place of a diffuse picture; none for figures of regions.
    pub nothing: Option<f64>,
}

/// How another program's pictures agree with a result, and the scores of both against the ground truth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held {
    /// The agreement with the result.
    pub agreement: Vec<HeldFigure>,
    /// The scores against the ground truth; empty without one.
    pub scores: Vec<HeldFigure>,
}

/// Holds the pictures of another program against a result, and both against the ground truth, where the photograph has one. Takes some
/// passes over the photograph, with a ground truth about as long as an analysis.
///
/// # Errors
/// Where the pictures have another size than the photograph.
pub fn held_against(elsewhere: &Elsewhere, shown: &ResultSnapshot) -> Result<Held, ScoreError> {
    let (pictures, body) = (&elsewhere.pictures, &shown.analysis.intrinsic.body);
    let agreement = pictures.agreement(shown.labels(), body)?;
    let photo = &shown.picture.photo.image.pixels;
    let figure = |(key, value): (&'static str, Option<f64>)| {
        let words = agreement_words(key);
        let apart = || photo.as_slice().iter().flatten().zip(body.as_slice().iter().flatten());
        let nothing =
            (key == "psnr_body").then(|| psnr_db(apart().map(|(a, b)| f64::from(*a) - f64::from(*b))));
        let elsewhere = value.map(|value| words.factor * value);
        HeldFigure { key, words, elsewhere, result: None, nothing: nothing.flatten() }
    };
    let agreement = agreement.figures().into_iter().map(figure).collect();
    Ok(Held { agreement, scores: scores(pictures, shown)? })
}

/// The scores of another program's pictures against the ground truth, beside those of a result.
fn scores(pictures: &ForeignResult, shown: &ResultSnapshot) -> Result<Vec<HeldFigure>, ScoreError> {
    let (Some(truth), Some(accuracy)) = (&shown.picture.truth, shown.accuracy()) else {
        return Ok(Vec::new());
    };
    let photo = &shown.picture.photo;
    let facts = ImageFacts::of(photo, &shown.picture.sha256);
    let report = Report::new(facts, &shown.params, &shown.analysis, &[]);
    let theirs = pictures.scores(truth, &photo.image.pixels, &report)?;
    let (theirs, ours) = (pictures.figures(&theirs), pictures.figures(&accuracy.scores));
    let nothing_of = |key: &str| match key {
        "psnr_body" => "psnr_nothing",
        "psnr_surface" => "psnr_surface_nothing",
        "psnr_restored" => "psnr_restored_nothing",
        _ => "",
    };
    let value = |figures: &[(&'static str, Option<f64>)], key: &str, words: FigureWords| {
        let found = figures.iter().find(|figure| figure.0 == key).and_then(|figure| figure.1);
        found.map(|value| words.factor * value)
    };
    let rows = theirs.iter().filter(|(key, _)| !key.ends_with("nothing"));
    Ok(rows
        .map(|&(key, _)| {
            let words = score_words(key);
            let [elsewhere, result] = [&theirs, &ours].map(|figures| value(figures, key, words));
            HeldFigure { key, words, elsewhere, result, nothing: value(&ours, nothing_of(key), words) }
        })
        .collect())
}

/// The color of each label of another program's map, from label 0 (without a meaning) on, sRGB: the color of the region of the result that
/// covers most of its pixels. Of several labels in one region the largest has the region's own color, and the others have shades of it.
pub(super) fn label_colors(labels: &LabelMap, shown: &ResultSnapshot) -> Vec<[u8; 3]> {
    let covers = overlaps(labels, shown.labels());
    let best = best_overlaps(labels, shown.labels());
    let size = |label: usize| covers[label].iter().map(|cover| cover.1).sum::<usize>();
    let mut by_size: Vec<usize> = (1..covers.len()).filter(|&label| size(label) > 0).collect();
    by_size.sort_by_key(|&label| (Reverse(size(label)), label));
    let mut colors = vec![UNCOVERED; covers.len()];
    // Number of labels so far of each region, and of no region at the end.
    let mut used = vec![0usize; shown.region_colors.len() + 1];
    for label in by_size {
        let region = best.get(label).copied().flatten().map(crate::raster::RegionId::index);
        let region = region.filter(|&region| region < shown.region_colors.len());
        let color = region.map_or(UNCOVERED, |region| shown.region_colors[region]);
        let count = &mut used[region.unwrap_or(shown.region_colors.len())];
        colors[label] = shaded(color, SHADES[*count % SHADES.len()]);
        *count += 1;
    }
    colors
}

/// A color mixed with a share of white, or of black below 0.
fn shaded(color: [u8; 3], share: f32) -> [u8; 3] {
    let end = if share > 0.0 { 255.0 } else { 0.0 };
    color.map(|band| (f32::from(band) + (end - f32::from(band)) * share.abs()).round() as u8)
}

/// Kinds of border pixels: 0 none, 1 a border of both maps, up to [`NEAR_PX`] apart, 2 of the result alone, 3 of the other map alone.
pub(super) fn borders(ours: &LabelMap, theirs: &LabelMap) -> Raster<u8> {
    let (our_edges, their_edges) = (edges(ours), edges(theirs));
    let (near_ours, near_theirs) = (dilate(&our_edges, NEAR_PX), dilate(&their_edges, NEAR_PX));
    let mut kinds = Raster::filled(ours.width(), ours.height(), 0u8);
    for (pixel, kind) in kinds.as_mut_slice().iter_mut().enumerate() {
        *kind = match (our_edges[pixel], their_edges[pixel]) {
            (true, _) if near_theirs[pixel] => 1,
            (_, true) if near_ours[pixel] => 1,
            (true, _) => 2,
            (_, true) => 3,
            _ => 0,
        };
    }
    kinds
}

/// Pixels whose right or lower neighbor has another label.
fn edges(labels: &LabelMap) -> Mask {
    let (width, height) = (labels.width(), labels.height());
    let mut edges = Raster::filled(width, height, false);
    for y in 0..height {
        for x in 0..width {
            let here = labels.row(y)[x];
            let differs = |other: Option<&u16>| other.is_some_and(|&other| other != here);
            edges[y * width + x] = differs(labels.get(x + 1, y)) || differs(labels.get(x, y + 1));
        }
    }
    edges
}

/// Number of labels of a map, that for no label left out.
pub fn label_count(labels: &LabelMap) -> usize {
    let mut known = vec![false; usize::from(u16::MAX) + 1];
    for &label in labels.as_slice() {
        known[usize::from(label)] = true;
    }
    known[usize::from(UNASSIGNED)] = false;
    known.into_iter().filter(|&known| known).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::{divided, gray, labels};
    use std::sync::Arc;

    const ROWS: [&str; 2] = ["111222", "111222"];

    fn elsewhere(rows: &[&str], counts: f32) -> Elsewhere {
        let map = labels(rows);
        let diffuse = Raster::filled(map.width(), map.height(), [counts; 3]);
        let paths = ElsewherePaths { labels: Some("l.png".into()), diffuse: Some("d.png".into()) };
        Elsewhere { paths, pictures: ForeignResult { labels: Some(map), diffuse: Some(diffuse) } }
    }

    #[test]
    fn both_maps_and_both_pictures_are_compared() {
        let picture = gray(&ROWS, 90);
        let shown = divided(&picture, &ROWS);
        let held = held_against(&elsewhere(&["5577..", "5577.."], 80.0), &shown).unwrap();
        assert!(held.scores.is_empty(), "there is no ground truth");
        let names: Vec<_> = held.agreement.iter().map(|figure| (figure.key, figure.words.unit)).collect();
        assert_eq!(names, [("ari", ""), ("shared", "%"), ("psnr_body", "dB")]);
        assert!((held.agreement[1].elsewhere.unwrap() - 200.0 / 3.0).abs() < 1e-9);
        let [elsewhere_db, nothing_db] =
            [held.agreement[2].elsewhere.unwrap(), held.agreement[2].nothing.unwrap()];
        assert!((elsewhere_db - 20.0 * (255f64 / 10.0).log10()).abs() < 1e-6, "10 counts apart");
        assert!(nothing_db > 100.0, "the body image is the photograph here");
        assert!(held_against(&elsewhere(&["1"], 1.0), &shown).is_err());
    }

    #[test]
    fn with_a_ground_truth_both_have_scores_beside_those_of_doing_nothing() {
        let rows = vec!["1".repeat(20) + &"2".repeat(20); 20];
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let mut picture = Arc::into_inner(gray(&rows, 100)).unwrap();
        let body = Raster::filled(40, 20, [80.0; 3]);
        let surface = Raster::filled(40, 20, [20.0; 3]);
        let objects = [1, 2].map(|id| crate::truth::TruthObject { id, body_vector: None }).to_vec();
        let labels = labels(&rows);
        picture.truth =
            Some(crate::truth::GroundTruth { labels, body, surface, illuminant: [1.0; 3], objects });
        let shown = divided(&Arc::new(picture), &rows);
        shown.measure();
        let held = held_against(&elsewhere(&rows, 80.0), &shown).unwrap();
        let score = |name: &str| *held.scores.iter().find(|figure| figure.key == name).unwrap();
        assert_eq!((score("ari").elsewhere, score("ari").nothing), (Some(1.0), None));
        let body = score("psnr_body");
        assert!(body.elsewhere > body.nothing && body.nothing.is_some(), "{body:?}");
        assert!(held.scores.iter().all(|figure| !figure.key.contains("nothing")));
    }

    #[test]
    fn labels_have_the_colors_of_the_regions_that_cover_them_and_shades_of_it() {
        let shown = divided(&gray(&ROWS, 90), &ROWS);
        let colors = label_colors(&labels(&["8899.6", "889966"]), &shown);
        let [first, second] = [0, 1].map(|region: usize| shown.region_colors[region]);
        assert_eq!([colors[8], colors[9], colors[6]], [first, shaded(first, 0.4), second]);
        let free = label_colors(&labels(&["3"]), &divided(&gray(&["."], 9), &["."]));
        assert_eq!(free[3], UNCOVERED);
    }

    #[test]
    fn borders_of_both_maps_may_lie_two_pixels_apart() {
        let kinds = |ours: &str, theirs: &str| borders(&labels(&[ours]), &labels(&[theirs])).into_vec();
        assert_eq!(kinds("111122222", "111111222"), [0, 0, 0, 1, 0, 1, 0, 0, 0]);
        assert_eq!(kinds("111222222", "111111122"), [0, 0, 2, 0, 0, 0, 3, 0, 0]);
    }

    #[test]
    fn a_picture_is_taken_away_and_put_in_place_of_another() {
        let all = elsewhere(&ROWS, 7.0);
        let rest = all.without(ElsewhereKind::Labels).unwrap();
        assert!(!rest.has(ElsewhereKind::Labels) && rest.has(ElsewhereKind::Diffuse));
        assert!(rest.without(ElsewhereKind::Diffuse).is_none());
        assert_eq!(rest.paths.files().count(), 1);
        let again = rest.with(Elsewhere {
            paths: ElsewherePaths { labels: Some("new.png".into()), diffuse: None },
            pictures: ForeignResult { labels: Some(labels(&["332.", "...."])), diffuse: None },
        });
        assert_eq!(again.at(0), ElsewherePixel { label: Some(3), diffuse: Some([7.0; 3]) });
        assert_eq!(again.paths.get(ElsewhereKind::Labels), Some(std::path::Path::new("new.png")));
        assert_eq!(label_count(again.pictures.labels.as_ref().unwrap()), 2);
    }
}
