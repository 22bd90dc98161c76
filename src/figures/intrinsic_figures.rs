//! The figures of the intrinsic images (color figures 8 to 11), their summary (12 to 14), and the comparison with another method
//! (15).

use super::html::{Content, Figure};
use super::numbers::{counted, decimals, percent};
use super::parameters::method_name;
use super::picture::{Values, image};
use super::profile_plot;
use super::scene::Scene;
use super::segmentation_figures::no_region;
use crate::export::colored;
use crate::raster::{LabelMap, UNASSIGNED};
use crate::truth::adjusted_rand_index;
use crate::view::Layer;

/// The body reflection image (color figure 8).
pub fn body(scene: &Scene) -> Figure {
    let regions = &scene.report.regions;
    let split = regions.iter().filter(|region| region.separable).count();
    let content = if regions.is_empty() {
        Content::Absent(no_region(scene))
    } else if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else {
        Content::Html(image(&scene.painted(Layer::Body), Values::Light, "Body reflection"))
    };
    let scores = scene.report.scores.and_then(|scores| Some((scores.psnr_body?, scores.psnr_nothing?)));
    let accuracy = scores.map_or_else(String::new, |(body, nothing)| {
        format!(
            "Peak signal-to-noise ratio against the true body reflection: {}\u{a0}dB; of the photograph itself: {}\u{a0}dB. ",
            decimals(body, 1),
            decimals(nothing, 1)
        )
    });
    Figure {
        title: "Body reflection image",
        counterpart: "color figure 8",
        content,
        caption: format!(
            "The photograph without its highlights. Body and surface reflection can be separated in {split} of {}; {} restored. \
             {accuracy}{}",
            counted(regions.len(), "region", "regions"),
            counted(scene.counts.restored, "clipped or bloomed pixel is", "clipped or bloomed pixels are"),
            scene.exposure_sentence(),
        ),
    }
}

/// The surface reflection image (color figure 9).
pub fn surface(scene: &Scene) -> Figure {
    let largest = scene
        .shown
        .analysis
        .intrinsic
        .surface
        .as_slice()
        .iter()
        .flatten()
        .fold(0.0f32, |most, &v| most.max(v));
    let content = if scene.report.regions.is_empty() {
        Content::Absent(no_region(scene))
    } else if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else if scene.report.illuminant.direction.is_none() {
        Content::Absent(
            "Not shown: no light was found, so that all light counts as body reflection.".to_owned(),
        )
    } else if largest <= 0.0 {
        Content::Absent("Not shown: no pixel has surface reflection.".to_owned())
    } else {
        Content::Html(image(&scene.painted(Layer::Surface), Values::Light, "Surface reflection"))
    };
    let counts = &scene.counts;
    Figure {
        title: "Surface reflection image",
        counterpart: "color figure 9",
        content,
        caption: format!(
            "The highlights alone. {} of the pixels in regions lie nearer to a highlight line than to their matte line, or are clipped or bloomed; the largest amount \
             in a band is {largest:.0} counts. {}",
            percent(counts.highlight + counts.restored + counts.lost, counts.in_regions),
            scene.exposure_sentence(),
        ),
    }
}

/// The noise image (color figure 10).
pub fn noise(scene: &Scene) -> Figure {
    let analysis = &scene.shown.analysis;
    let has_plane = scene.report.regions.iter().any(|region| region.separable);
    let content = if scene.report.regions.is_empty() {
        Content::Absent(no_region(scene))
    } else if has_plane {
        Content::Html(image(&scene.painted(Layer::Noise), Values::Codes, "Intrinsic noise"))
    } else {
        Content::Absent("Not shown: no region has a dichromatic plane to measure a distance from.".to_owned())
    };
    let assigned = analysis.finals.labels.as_slice().iter().zip(analysis.intrinsic.noise.as_slice());
    let (sum, count) = assigned
        .filter(|&(&label, _)| label != UNASSIGNED)
        .fold((0.0f64, 0usize), |(sum, count), (_, &noise)| (sum + f64::from(noise).powi(2), count + 1));
    Figure {
        title: "Intrinsic noise image",
        counterpart: "color figure 10",
        content,
        caption: format!(
            "The distance \u{3b5} of each color from its dichromatic plane: gray is 0, black and white are the faces of the slice at \
             \u{2213}{:.1} counts. Root mean square in the regions: {:.2} counts. ",
            analysis.used.slice_half_width_counts(),
            (sum / count.max(1) as f64).sqrt(),
        ),
    }
}

/// The profiles along the scene's line (color figure 11).
pub fn profiles(scene: &Scene) -> Figure {
    let samples = profile_plot::samples(scene);
    let content = if scene.report.regions.is_empty() {
        Content::Absent(no_region(scene))
    } else if samples.is_empty() {
        Content::Absent("Not shown: the line lies outside of the photograph.".to_owned())
    } else {
        Content::Html(profile_plot::svg(scene, &samples))
    };
    let [body, surface, noise] = profile_plot::largest(&samples);
    Figure {
        title: "Profiles of the intrinsic images",
        counterpart: "color figure 11",
        content,
        caption: format!(
            "{}. Largest amounts: body reflection {body:.0}, surface reflection {surface:.0}, noise {noise:.1} counts. The band below shows \
             the regions in their colors; curves are interrupted where a pixel belongs to no region. ",
            line_sentence(scene)
        ),
    }
}

/// Where the profile's line runs.
fn line_sentence(scene: &Scene) -> String {
    let [[x0, y0], [x1, y1]] = scene.line.map(|end| end.map(f32::floor));
    if (y0 - y1).abs() < 0.5 {
        format!("Along row {y0:.0} of the photograph, counted from 0")
    } else if (x0 - x1).abs() < 0.5 {
        format!("Along column {x0:.0} of the photograph, counted from 0")
    } else {
        format!("From pixel ({x0:.0}, {y0:.0}) to pixel ({x1:.0}, {y1:.0})")
    }
}

/// Photograph, segmentation, body and surface reflection as four quarters (color figures 12 to 14).
pub fn quarters(scene: &Scene) -> Figure {
    let quarter = |layer: Layer, values: Values, name: &str| {
        format!("<div>{}<span>{name}</span></div>", image(&scene.painted(layer), values, name))
    };
    let html = [
        quarter(Layer::Input, Values::Light, "photograph"),
        quarter(Layer::Regions, Values::Codes, "segmentation"),
        quarter(Layer::Body, Values::Light, "body reflection"),
        quarter(Layer::Surface, Values::Light, "surface reflection"),
    ]
    .concat();
    let nothing = if scene.report.regions.is_empty() {
        "No region was found: the body image is the photograph. "
    } else {
        ""
    };
    Figure {
        title: "Segmentation and reflection analysis",
        counterpart: "color figures 12 to 14",
        content: Content::Html(format!("<div class=\"quarters summary\">{html}</div>")),
        caption: format!(
            "{}: {}, {} of the lit pixels. {nothing}{}",
            scene.name(),
            counted(scene.report.regions.len(), "region", "regions"),
            percent(scene.counts.lit_in_regions[2], scene.counts.lit),
            scene.exposure_sentence()
        ),
    }
}

/// The segmentation by another method beside the own one (color figure 15).
pub fn other_method(scene: &Scene) -> Figure {
    let Some(other) = &scene.other else {
        return Figure {
            title: "Segmentation by another method",
            counterpart: "color figure 15",
            content: Content::Absent(
                "Not shown: the regions are those of Phoenix; another method shows both.".to_owned(),
            ),
            caption: String::new(),
        };
    };
    let opaque = |labels: &LabelMap| colored(labels).map(|&[r, g, b]| [r, g, b, 255]);
    let quarter = |labels: &LabelMap, name: &str| {
        let name = super::html::escaped(name);
        format!("<div>{}<span>{name}</span></div>", image(&opaque(labels), Values::Codes, &name))
    };
    let own = &scene.shown.analysis.finals.labels;
    let own_name = method_name(scene.shown.params.method);
    let html = [quarter(&other.labels, &other.name), quarter(own, own_name)].concat();
    let regions = |labels: &LabelMap| {
        let mut seen = vec![false; usize::from(u16::MAX) + 1];
        labels.as_slice().iter().for_each(|&label| seen[usize::from(label)] = true);
        seen.iter().skip(1).filter(|&&seen| seen).count()
    };
    let agreement = agreement(scene, &other.labels).map_or_else(String::new, |[theirs, ours]| {
        format!(
            "Adjusted Rand index against the true objects: {} for {}, {} for the {own_name}. ",
            decimals(theirs, 3),
            other.name,
            decimals(ours, 3)
        )
    });
    Figure {
        title: "Segmentation by another method",
        counterpart: "color figure 15",
        content: Content::Html(format!("<div class=\"quarters\">{html}</div>")),
        caption: format!(
            "{}: {}; the {own_name}: {}. {} {agreement}",
            other.name,
            counted(regions(&other.labels), "region", "regions"),
            counted(regions(own), "region", "regions"),
            other.about,
        ),
    }
}

/// Adjusted Rand indices of another segmentation and of the own one against the true objects, over their lit pixels.
fn agreement(scene: &Scene, other: &LabelMap) -> Option<[f64; 2]> {
    let truth = scene.shown.picture.truth.as_ref()?;
    let analysis = &scene.shown.analysis;
    if truth.labels.len() != other.len() {
        return None;
    }
    let index = |labels: &LabelMap| {
        let lit = (0..labels.len()).filter(|&pixel| truth.labels[pixel] != 0 && !analysis.masks.dark(pixel));
        adjusted_rand_index(lit.map(|pixel| (truth.labels[pixel], labels[pixel])))
    };
    Some([index(other), index(&analysis.finals.labels)])
}
