//! The figures of the photograph and of its segmentation (color figures 1 to 7), and table 1.

use super::cube;
use super::html::{Column, Content, Figure, Row, Table, escaped, key, keys};
use super::numbers::{counted, grouped, percent};
use super::picture::{Values, image};
use super::scene::Scene;
use crate::params::Parameter;
use crate::raster::{LabelMap, Raster};
use crate::trace::Class;
use crate::view::{Layer, class_entries};

/// A layer as a figure.
fn layer(scene: &Scene, layer: Layer, values: Values, description: &str) -> Content {
    Content::Html(image(&scene.painted(layer), values, description))
}

/// The photograph (color figure 1).
pub fn photograph(scene: &Scene) -> Figure {
    let counts = &scene.counts;
    let facts = &scene.report.image;
    let area = if scene.shown.area.is_some() {
        format!("The analysis is restricted to an area of {}. ", counted(counts.pixels, "pixel", "pixels"))
    } else {
        String::new()
    };
    Figure {
        title: "The photograph",
        counterpart: "color figure 1",
        content: layer(scene, Layer::Input, Values::Light, "The photograph"),
        caption: format!(
            "{} \u{d7} {} pixels. {area}{} of the pixels are darker than the minimal intensity, {} are clipped and {} bloomed. {}",
            facts.width,
            facts.height,
            percent(counts.dark, counts.pixels),
            percent(counts.clipped, counts.pixels),
            percent(counts.bloomed, counts.pixels),
            scene.exposure_sentence(),
        ),
    }
}

/// The histogram from two sides (color figure 2).
pub fn histogram(scene: &Scene) -> Figure {
    let [left, right] = cube::SIDES.map(|side| cube::svg(scene, side));
    let bins = scene.shown.picture.histogram.bins.len();
    let regions = scene.report.regions.len();
    let drawn = if regions > cube::MOST_HYPOTHESES && scene.lacks_stage().is_none() {
        format!("Hypotheses are drawn for the {} largest regions. ", cube::MOST_HYPOTHESES)
    } else {
        String::new()
    };
    let meaning = if scene.lacks_stage().is_some() {
        "The method has no hypothesis to draw. "
    } else if regions == 0 {
        "No region was found, so that there is no hypothesis to draw. "
    } else {
        "Outlines: the cylinders of the linear hypotheses, in the colors of the regions; colored lines: matte lines; white lines: \
         highlight lines; dashed: the color of the light. "
    };
    Figure {
        title: "Color histogram from two sides",
        counterpart: "color figure 2",
        content: Content::Html(format!("<div class=\"quarters\"><div>{left}</div><div>{right}</div></div>")),
        caption: format!(
            "The colors of the photograph in the color cube, {} of 64\u{b3} bins, each in its own color and larger for more pixels; the right \
             view is turned by 90\u{b0} around the blue axis. {meaning}{drawn}",
            grouped(bins)
        ),
    }
}

/// Number of windows of each class, in the order of table 1, and without a class.
fn window_counts(scene: &Scene) -> ([usize; 4], usize) {
    let (mut counts, mut without) = ([0; 4], 0);
    for class in scene.shown.analysis.windows.classes.as_slice() {
        match class {
            Some(class) => counts[*class as usize] += 1,
            None => without += 1,
        }
    }
    (counts, without)
}

/// Side of the windows in the pixels that were classified.
fn window_size(scene: &Scene) -> usize {
    scene.shown.analysis.used.get(Parameter::WindowSize) as usize
}

/// The classes of the windows (color figure 3).
pub fn classification(scene: &Scene) -> Figure {
    let (counts, without) = window_counts(scene);
    let all: usize = counts.iter().sum();
    let content = if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else if all == 0 {
        Content::Absent("Not shown: no window has enough usable pixels to be classified.".to_owned())
    } else {
        let picture =
            image(&scene.painted(Layer::Classes), Values::Codes, "Windows in the colors of their classes");
        let entries = class_entries();
        Content::Html(picture + &keys(entries.iter().map(|entry| (entry.color, entry.name))))
    };
    let [points, lines, planes, volumes] = counts.map(|count| percent(count, all));
    let size = window_size(scene);
    let blocks = scene.shown.analysis.working.blocks.side();
    let working = if blocks > 1 {
        format!(
            " A window has {size} \u{d7} {size} working pixels, each the mean of {blocks} \u{d7} {blocks} pixels."
        )
    } else {
        format!(" A window has {size} \u{d7} {size} pixels.")
    };
    Figure {
        title: "Classification of color clusters",
        counterpart: "color figure 3",
        content,
        caption: format!(
            "Of {} windows, {points} are pointlike, {lines} linear, {planes} planar and {volumes} volumetric; {} without enough usable \
             pixels.{working} ",
            grouped(all),
            counted(without, "window is", "windows are"),
        ),
    }
}

/// The interpretations of the classes, with the windows of the photograph (table 1).
pub fn class_table(scene: &Scene) -> Table {
    const INTERPRETATIONS: [&str; 4] = [
        "one object with little curvature, or dark, without a highlight",
        "one object: matte cluster or highlight cluster; two objects: dark or flat, both matte",
        "one object: matte and highlight pixels, the dichromatic plane; two objects: both matte or both highlights",
        "one object: noise by clipping or blooming; two objects with highlights; three objects and more",
    ];
    let (counts, _) = window_counts(scene);
    let all = counts.iter().sum();
    let significant = ["s s s", "l s s", "l l s", "l l l"];
    let row = |class: Class| {
        let i = class as usize;
        let entry = class_entries()[i];
        Row::of(vec![
            significant[i].to_owned(),
            format!("{}{}", key(entry.color), escaped(class.name())),
            INTERPRETATIONS[i].to_owned(),
            grouped(counts[i]),
            percent(counts[i], all),
        ])
    };
    let columns = [
        ("\u{3bb}\u{2081} \u{3bb}\u{2082} \u{3bb}\u{2083}", Column::Vector),
        ("class", Column::Vector),
        ("interpretation of a window", Column::Text),
        ("windows", Column::Number),
        ("share", Column::Number),
    ];
    Table {
        caption: "Interpretations of color clusters, and the windows of this photograph. Eigenvalues are small (s) or large (l) in \
                  comparison with the camera noise."
            .to_owned(),
        counterpart: "table 1",
        columns: columns.map(|(name, column)| (name.to_owned(), column)).to_vec(),
        rows: [Class::Point, Class::Line, Class::Plane, Class::Volume].into_iter().map(row).collect(),
        note: String::new(),
    }
}

/// Number of pixels of each label, from 1.
fn sizes<T: Copy + Into<u32>>(labels: &Raster<T>) -> Vec<usize> {
    let mut sizes = Vec::new();
    for &label in labels.as_slice() {
        let Some(index) = (label.into() as usize).checked_sub(1) else { continue };
        if sizes.len() <= index {
            sizes.resize(index + 1, 0);
        }
        sizes[index] += 1;
    }
    sizes
}

/// The merged areas (color figure 4).
pub fn areas(scene: &Scene) -> Figure {
    let sizes = sizes(&scene.shown.analysis.areas);
    let found = sizes.iter().filter(|&&size| size > 0).count();
    let block = scene.shown.analysis.working.blocks.side();
    let least = scene.shown.analysis.used.get(Parameter::MinArea);
    let large = sizes.iter().filter(|&&size| size as f64 >= least * (block * block) as f64).count();
    let content = if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else if found == 0 {
        Content::Absent("Not shown: no window has a class, so that there is no area.".to_owned())
    } else {
        layer(scene, Layer::Areas, Values::Codes, "Merged areas, each in a color")
    };
    let which = if block > 1 { "working pixels" } else { "pixels" };
    Figure {
        title: "Initial grouping into areas",
        counterpart: "color figure 4",
        content,
        caption: format!(
            "Neighboring windows of one class, merged into {}; {} at least the minimal area of {least:.0} {which}. The largest area \
             holds {} of the picture. ",
            counted(found, "area", "areas"),
            counted(large, "has", "have"),
            percent(sizes.iter().copied().max().unwrap_or(0), scene.counts.pixels),
        ),
    }
}

/// Number of labels that have pixels.
fn regions_of(labels: &LabelMap) -> usize {
    sizes(labels).iter().filter(|&&size| size > 0).count()
}

/// The regions after the linear stage (color figure 5).
pub fn linear(scene: &Scene) -> Figure {
    let matte = &scene.shown.analysis.matte;
    let regions = regions_of(&matte.labels);
    let content = if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else if regions == 0 {
        Content::Absent("Not shown: no linear hypothesis was found.".to_owned())
    } else {
        layer(scene, Layer::Linear, Values::Codes, "Regions of linear hypotheses")
    };
    Figure {
        title: "Linear segmentation",
        counterpart: "color figure 5",
        content,
        caption: format!(
            "{}, grown from linear hypotheses, hold {} of the lit pixels: matte pixels within {:.1} counts of the axis of a cylinder. ",
            counted(regions, "region", "regions"),
            percent(scene.counts.lit_in_regions[0], scene.counts.lit),
            scene.shown.analysis.used.radius_counts(),
        ),
    }
}

/// The regions after the planar stage (color figure 6).
pub fn planar(scene: &Scene) -> Figure {
    let planar = &scene.shown.analysis.planar;
    let regions = regions_of(&planar.labels);
    let planes =
        planar.hypotheses.iter().filter(|hypothesis| hypothesis.alive && hypothesis.plane.is_some()).count();
    let content = if let Some(why) = scene.lacks_stage() {
        Content::Absent(why)
    } else if planes == 0 {
        let why = if planar.illuminant.is_none() {
            format!("no light was found ({})", scene.report.illuminant.reason)
        } else {
            "no region was extended to a plane".to_owned()
        };
        Content::Absent(format!("Not shown: there is no planar hypothesis, as {why}."))
    } else {
        layer(scene, Layer::Planar, Values::Codes, "Regions of planar hypotheses")
    };
    Figure {
        title: "Planar segmentation",
        counterpart: "color figure 6",
        content,
        caption: format!(
            "{}, {} extended to a dichromatic plane, hold {} of the lit pixels: matte and highlight pixels within {:.1} counts of the \
             plane. ",
            counted(regions, "region", "regions"),
            counted(planes, "of them", "of them"),
            percent(scene.counts.lit_in_regions[1], scene.counts.lit),
            scene.shown.analysis.used.slice_half_width_counts(),
        ),
    }
}

/// The final regions (color figure 7).
pub fn finals(scene: &Scene) -> Figure {
    let counts = &scene.counts;
    let regions = scene.report.regions.len();
    let content = if regions == 0 {
        Content::Absent(no_region(scene))
    } else {
        layer(scene, Layer::Regions, Values::Codes, "The final regions")
    };
    Figure {
        title: "Final segmentation",
        counterpart: "color figure 7",
        content,
        caption: format!(
            "{}, clipped and bloomed pixels included, hold {} of the lit pixels and {} of all pixels. ",
            counted(regions, "region", "regions"),
            percent(counts.lit_in_regions[2], counts.lit),
            percent(counts.in_regions, counts.pixels),
        ),
    }
}

/// Why there is no region, a sentence.
pub fn no_region(scene: &Scene) -> String {
    let warning = scene.shown.analysis.warnings.first();
    let why = warning.map_or_else(|| "none was found".to_owned(), ToString::to_string);
    format!("Not shown: there is no region, as {why}.")
}
