//! The words of figures: a score is known by the key that files have, and shown with a name, a unit and a sentence.

use crate::params::{Parameter, PhoenixParameter, Reading, Switch};

/// The words of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureWords {
    /// The name that is shown.
    pub name: &'static str,
    /// What the figure measures, in a sentence.
    pub meaning: &'static str,
    /// Unit of the figure; empty for pure numbers.
    pub unit: &'static str,
    /// Factor from the figure in files to the unit.
    pub factor: f64,
}

/// The words of a figure that has its unit in files too.
const fn words(name: &'static str, unit: &'static str, meaning: &'static str) -> FigureWords {
    FigureWords { name, meaning, unit, factor: 1.0 }
}

/// The words of a share, 0…1 in files.
const fn share(name: &'static str, meaning: &'static str) -> FigureWords {
    FigureWords { name, meaning, unit: "%", factor: 100.0 }
}

/// The words of a score against the ground truth, by its key in files.
pub fn score_words(key: &'static str) -> FigureWords {
    match key {
        "ari" => words(
            "adjusted Rand index",
            "",
            "How well the regions are the true objects, over the objects' lit pixels: 1 where every pair of pixels is rightly together or apart, about 0 by chance.",
        ),
        "iou" => share(
            "overlap with objects, mean",
            "Intersection over union of each true object and the region that fits it best, averaged over the objects.",
        ),
        "iou_min" => share(
            "overlap with objects, least",
            "Intersection over union of a true object and the region that fits it best, for the object with the least.",
        ),
        "cover" => share("objects in regions", "Share of the true objects' lit pixels that lie in a region."),
        "regions" => words("regions", "", "Number of regions, or of labels."),
        "objects" => words("true objects", "", "Number of true objects with more than 200 lit pixels."),
        "body_deg" => words(
            "body colors off by",
            "\u{b0}",
            "Mean angle between the true body vector of an object and that of the region that fits it best.",
        ),
        "illum_deg" => words(
            "light off by",
            "\u{b0}",
            "Angle between the true color of the light and the one that was found; 90\u{b0} where none was found.",
        ),
        "psnr_body" => words(
            "body image",
            "dB",
            "Peak signal to noise ratio of the body image, or of a diffuse picture, against the true one, on the unclipped pixels of objects.",
        ),
        "psnr_surface" => words(
            "surface image",
            "dB",
            "Peak signal to noise ratio of the surface image against the true one, on the unclipped pixels of objects; for a diffuse picture, of the photograph without it.",
        ),
        "psnr_restored" => words(
            "body image, clipped pixels",
            "dB",
            "Peak signal to noise ratio of the body image against the true one where the photograph of an object is partly clipped.",
        ),
        "psnr_nothing" => words(
            "doing nothing: body",
            "dB",
            "Peak signal to noise ratio of the unchanged photograph against the true body image: what the body image is to surpass.",
        ),
        "psnr_surface_nothing" => words(
            "doing nothing: surface",
            "dB",
            "Peak signal to noise ratio of a black picture against the true surface image: what the surface image is to surpass.",
        ),
        "psnr_restored_nothing" => words(
            "doing nothing: clipped pixels",
            "dB",
            "Peak signal to noise ratio of the unchanged photograph against the true body image where the photograph is partly clipped.",
        ),
        key => words(key, "", ""),
    }
}

/// The words of a figure of the agreement of another program's pictures with the result, by its key in files.
pub fn agreement_words(key: &'static str) -> FigureWords {
    match key {
        "ari" => words(
            "adjusted Rand index",
            "",
            "How well both label maps agree, over the pixels that both give a label: 1 where they agree, about 0 by chance.",
        ),
        "shared" => {
            share("labeled too", "Share of the pixels in a region that the other label map labels too.")
        }
        "psnr_body" => words(
            "as the body image",
            "dB",
            "Peak signal to noise ratio between the diffuse picture and the body image, over all pixels; beside it that of the unchanged photograph.",
        ),
        key => words(key, "", ""),
    }
}

/// What a setting does, in a sentence without a full stop; none for an unknown one.
pub fn setting_meaning(name: &str) -> Option<&'static str> {
    let parameter =
        Parameter::ALL.into_iter().map(|parameter| (parameter.spec().name, parameter.spec().meaning));
    let phoenix = PhoenixParameter::ALL.into_iter().map(|parameter| (parameter.name(), parameter.meaning()));
    let switches = Switch::ALL.into_iter().map(|switch| (switch.name(), switch.meaning()));
    let readings = Reading::ALL.into_iter().map(|reading| (reading.name(), reading.spec().title));
    let others = [
        ("method", "The method that finds the regions"),
        ("illuminant", "The light's color: given, or found (auto)"),
        ("second_illuminant", "The color of a second lamp: given, or sought (auto)"),
        ("ambient", "Light from all sides that is subtracted: given, found (auto) or none (off)"),
        ("features", "The features whose histograms Phoenix divides (section 7.2)"),
        ("area", "The pixels that are analyzed"),
    ];
    let mut all = parameter.chain(phoenix).chain(switches).chain(readings).chain(others);
    all.find(|(known, _)| *known == name).map(|(_, meaning)| meaning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::describe::Scores;
    use crate::params::{IlluminantSetting, Method, Params, Preset, Setting};
    use crate::view::compare::setting_changes;

    #[test]
    fn every_score_has_a_name_in_words_and_a_sentence() {
        for (key, _) in Scores::default().figures() {
            let words = score_words(key);
            assert!(!words.name.contains('_') && words.meaning.ends_with('.'), "{words:?}");
            assert_eq!(words.unit == "dB", key.starts_with("psnr"), "{key}");
        }
        for key in ["ari", "shared", "psnr_body"] {
            assert!(agreement_words(key).meaning.ends_with('.'), "{key}");
        }
    }

    #[test]
    fn every_setting_that_can_differ_has_a_meaning() {
        let given = Params {
            illuminant: IlluminantSetting::Given([0.5, 0.6, 0.7]),
            camera_noise: Setting::Value(9.0),
            ..Params::of(Method::Paper)
        };
        let pairs = [
            (Params::default(), given),
            (Params::default(), Params::of(Method::Phoenix)),
            (Params::of(Method::Paper), Preset::ALL[0].params()),
        ];
        for change in pairs.iter().flat_map(|(before, after)| setting_changes(before, after)) {
            assert!(setting_meaning(change.name).is_some_and(|text| !text.is_empty()), "{}", change.name);
        }
    }
}
