//! The figures of two results of one photograph, side by side.

use super::ResultSnapshot;
use super::figure_words::{FigureWords, score_words};

/// A figure of both results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The words with which the figure is shown.
    pub words: FigureWords,
    /// In the pinned result.
    pub pinned: Option<f64>,
    /// In the newest result.
    pub newest: Option<f64>,
}

/// The figures of both results: scores against the ground truth first, where there is one.
pub(super) fn figures(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> Vec<Figure> {
    let both = |name, unit, meaning, of: &dyn Fn(&ResultSnapshot) -> Option<f64>| Figure {
        words: FigureWords { name, meaning, unit, factor: 1.0 },
        pinned: of(pinned),
        newest: of(newest),
    };
    let regions = |shown: &ResultSnapshot| shown.analysis.intrinsic.regions.len();
    let highlights = |shown: &ResultSnapshot| {
        shown.analysis.intrinsic.regions.iter().filter(|region| region.highlights().is_some()).count()
    };
    let light = |band: usize| {
        move |shown: &ResultSnapshot| shown.analysis.illuminant.map(|light| light.direction[band])
    };
    let of_light = "A band of the unit vector of the light's color.";
    let of_results = [
        both("regions", "", "Number of regions.", &|shown| Some(regions(shown) as f64)),
        both("regions with a highlight", "", "Number of regions with a highlight line.", &|shown| {
            Some(highlights(shown) as f64)
        }),
        both(
            "lit pixels in regions",
            "%",
            "Share of the pixels that are not dark which lie in a region.",
            &|shown| Some(100.0 * shown.coverage),
        ),
        both("fit error", "counts", FIT_ERROR, &fit_error_counts),
        both("light R", "", of_light, &light(0)),
        both("light G", "", of_light, &light(1)),
        both("light B", "", of_light, &light(2)),
        both(
            "camera noise",
            "counts",
            "Standard deviation of the camera's noise that was used (section 5.2.1).",
            &|shown| Some(shown.analysis.used.camera_noise),
        ),
    ];
    // What a comparison is made for comes first: a low panel shows only the first rows.
    scores(pinned, newest).into_iter().chain(of_results).collect()
}

/// The scores of both results against the ground truth, those of images first, those of doing nothing last, which are the same for both;
/// empty without a ground truth.
fn scores(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> Vec<Figure> {
    let (Some(pinned), Some(newest)) = (pinned.accuracy(), newest.accuracy()) else { return Vec::new() };
    let mut scores: Vec<_> = pinned.scores.figures().into_iter().zip(newest.scores.figures()).collect();
    // The number of regions is among the figures of the results.
    scores.retain(|((key, _), _)| *key != "regions");
    scores.sort_by_key(|((key, _), _)| (key.ends_with("nothing"), !key.starts_with("psnr")));
    let figure = |((key, pinned), (_, newest)): ((&'static str, Option<f64>), (_, Option<f64>))| {
        let words = score_words(key);
        let [pinned, newest] = [pinned, newest].map(|value| value.map(|value| words.factor * value));
        Figure { words, pinned, newest }
    };
    scores.into_iter().map(figure).collect()
}

/// What the fit error measures.
const FIT_ERROR: &str =
    "Distance of the regions' pixels from their shapes: root mean square over all pixels in regions.";

/// Root mean square of the regions' fit errors, weighted by their pixels; none without a region.
fn fit_error_counts(shown: &ResultSnapshot) -> Option<f64> {
    let regions = &shown.analysis.intrinsic.regions;
    let pixels: usize = regions.iter().map(|region| region.pixels).sum();
    let sum: f64 = regions.iter().map(|region| region.pixels as f64 * region.fit_rms_counts.powi(2)).sum();
    (pixels > 0).then(|| (sum / pixels as f64).sqrt())
}
