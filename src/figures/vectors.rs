//! The reflection vectors of the regions, and the color of the light (tables 2 to 5).
//!
//! The paper fits the surface reflection vector of a region to the region's highlight pixels, and computes the light as the average
//! of these vectors. The refined method splits all regions with one light. To compare, the vectors are fitted here to the highlight
//! pixels as in section 6, whatever the method; the results of the analysis do not depend on the fits.

use super::html::{Column, Row, Table, escaped, key};
use super::numbers::{angle_deg, counted, degrees, grouped, swatch, vector};
use super::scene::{Measured, Scene, unit};
use crate::color::{Line, Moments, rgb};
use crate::describe::SecondLampFacts;
use crate::intrinsic::{PixelKind, RegionReflection};
use crate::params::IlluminantSetting;
use crate::raster::RegionId;
use std::collections::BTreeMap;

/// Most regions in a table, the largest first.
const MOST_ROWS: usize = 40;
/// Fewest highlight pixels for a fit, as many as a highlight candidate needs.
const LEAST_PIXELS: f64 = 10.0;
/// A direction with a band below this value is no color of a light; noise alone can make a band slightly negative.
const LEAST_BAND: f64 = -0.05;

/// The light's color by the analysis, by the fits and by a measurement.
pub struct Lights {
    /// The light of the analysis; none where no light was found.
    pub computed: Option<[f64; 3]>,
    /// The average of the regions' fitted surface reflection vectors.
    pub average: Option<[f64; 3]>,
    /// Number of these vectors.
    pub fitted: usize,
    /// The independent measurement.
    pub measured: Option<Measured>,
}

impl Lights {
    /// The lights of a scene, with the fits of its regions.
    pub fn of(scene: &Scene, fits: &[Option<[f64; 3]>]) -> Self {
        let sum = |sum: [f64; 3], v: &[f64; 3]| std::array::from_fn(|band| sum[band] + v[band]);
        Self {
            computed: scene.report.illuminant.direction,
            average: unit(fits.iter().flatten().fold([0.0; 3], sum)),
            fitted: fits.iter().flatten().count(),
            measured: scene.measured.clone(),
        }
    }

    /// Angle of a direction to the measured light, as text; a dash without a measurement.
    fn error(&self, direction: Option<[f64; 3]>) -> String {
        match (direction, &self.measured) {
            (Some(direction), Some(measured)) => degrees(angle_deg(direction, measured.direction)),
            _ => "\u{2013}".to_owned(),
        }
    }
}

/// The surface reflection vector of each region, fitted to its highlight pixels; none for a region with too few of them.
pub fn fits(scene: &Scene) -> Vec<Option<[f64; 3]>> {
    let analysis = &scene.shown.analysis;
    let regions = &analysis.intrinsic.regions;
    let params = &scene.shown.params;
    // The paper's method has fitted the vectors already.
    if !params.refinements().scene_illuminant && params.illuminant == IlluminantSetting::Auto {
        let fitted = |region: &RegionReflection| {
            let has_highlight = region.highlight_pixels as f64 >= LEAST_PIXELS;
            region.surface.filter(|surface| has_highlight && is_color(surface))
        };
        return regions.iter().map(fitted).collect();
    }
    let mut moments = vec![Moments::default(); regions.len()];
    let (labels, kinds) = (analysis.finals.labels.as_slice(), analysis.intrinsic.kinds.as_slice());
    let colors = scene.shown.picture.photo.image.pixels.as_slice();
    for (pixel, (&label, &kind)) in labels.iter().zip(kinds).enumerate() {
        if kind == PixelKind::Highlight
            && analysis.masks.usable(pixel)
            && let Some(moments) =
                RegionId::from_label(label).and_then(|region| moments.get_mut(region.index()))
        {
            moments.add(colors[pixel]);
        }
    }
    let fitted = |(moments, region): (&Moments, &RegionReflection)| {
        let line =
            Line::principal(moments).filter(|_| moments.n >= LEAST_PIXELS && region.surface.is_some())?;
        Some(rgb(&line.direction).map(f64::from)).filter(is_color)
    };
    moments.iter().zip(regions).map(fitted).collect()
}

/// Whether a direction can be the color of a light.
fn is_color(direction: &[f64; 3]) -> bool {
    direction.iter().all(|&band| band >= LEAST_BAND)
}

/// For each region the body reflection vector of the object of the ground truth that covers most of it; none without a truth.
fn true_bodies(scene: &Scene) -> Vec<Option<[f64; 3]>> {
    let labels = &scene.shown.analysis.finals.labels;
    let regions = scene.report.regions.len();
    let truth = scene.shown.picture.truth.as_ref().filter(|truth| truth.labels.len() == labels.len());
    let Some(truth) = truth else { return vec![None; regions] };
    let mut shared: Vec<BTreeMap<u16, usize>> = vec![BTreeMap::new(); regions];
    for (&label, &object) in labels.as_slice().iter().zip(truth.labels.as_slice()) {
        if let Some(counts) = RegionId::from_label(label).and_then(|region| shared.get_mut(region.index())) {
            *counts.entry(object).or_default() += 1;
        }
    }
    let most = |counts: &BTreeMap<u16, usize>| {
        let (&object, _) =
            counts.iter().max_by_key(|&(&object, &count)| (count, std::cmp::Reverse(object)))?;
        truth.body_vector(object)
    };
    shared.iter().map(most).collect()
}

/// A vector with a square of its color; a dash for none.
fn shown_vector(direction: Option<[f64; 3]>) -> String {
    direction.map_or_else(
        || "\u{2013}".to_owned(),
        |direction| format!("{}{}", key(swatch(direction)), vector(direction)),
    )
}

/// The table of a scene's reflection vectors, with the light in its last rows.
pub fn table(scene: &Scene, fits: &[Option<[f64; 3]>], counterpart: &'static str) -> Table {
    let lights = Lights::of(scene, fits);
    let bodies = true_bodies(scene);
    let has_truth = bodies.iter().any(Option::is_some);
    let mut columns = vec![
        ("region".to_owned(), Column::Text),
        ("pixels".to_owned(), Column::Number),
        ("body vector".to_owned(), Column::Vector),
        ("surface vector".to_owned(), Column::Vector),
        ("highlight".to_owned(), Column::Number),
    ];
    if has_truth {
        columns.push(("body error".to_owned(), Column::Number));
    }
    if lights.measured.is_some() {
        columns.push(("surface error".to_owned(), Column::Number));
    }
    let regions = &scene.shown.analysis.intrinsic.regions;
    let regions = regions.iter().zip(fits).zip(&bodies).zip(&scene.shown.region_colors);
    let mut rows: Vec<Row> = regions
        .take(MOST_ROWS)
        .map(|(((region, &fit), body), &color)| {
            let mut cells = vec![
                format!("{}{}", key(color), region.id),
                grouped(region.pixels),
                shown_vector(Some(region.body)),
                shown_vector(fit),
                region.highlights().map_or_else(|| "\u{2013}".to_owned(), grouped),
            ];
            if has_truth {
                cells.push(
                    body.map_or_else(|| "\u{2013}".to_owned(), |body| degrees(angle_deg(body, region.body))),
                );
            }
            if lights.measured.is_some() {
                cells.push(lights.error(fit));
            }
            Row::of(cells)
        })
        .collect();
    rows.extend(light_rows(&lights, has_truth));
    Table {
        caption: format!(
            "Body and surface reflection vectors of {}. Vectors have unit length: red, green, blue. The surface reflection vector of \
             a region is fitted to the region\u{2019}s own highlight pixels.",
            scene.name()
        ),
        counterpart,
        columns,
        rows,
        note: table_note(scene, &lights, has_truth),
    }
}

fn table_note(scene: &Scene, lights: &Lights, has_truth: bool) -> String {
    let left_out = scene.report.regions.len().saturating_sub(MOST_ROWS);
    let mut parts = vec![
        "Highlight: pixels nearer to a highlight line than to the matte line, or clipped or bloomed."
            .to_owned(),
    ];
    if left_out > 0 {
        parts.push(format!("{} left out.", counted(left_out, "smaller region is", "smaller regions are")));
    }
    if has_truth {
        let text = "Body error: angle to the vector of the true object that covers most of the region.";
        parts.push(text.to_owned());
    }
    if lights.measured.is_some() {
        parts.push("Surface error: angle to the independent measurement.".to_owned());
    }
    parts.push("A dash stands for what could not be determined.".to_owned());
    parts.join(" ")
}

/// The rows of the light, as at the end of the paper's tables.
fn light_rows(lights: &Lights, has_truth: bool) -> Vec<Row> {
    // The name stands in the place of region, pixels and body vector.
    let row = |name: &str, direction: Option<[f64; 3]>, is_found: bool, is_separated: bool| {
        let mut cells = vec![shown_vector(direction), String::new()];
        if has_truth {
            cells.push(String::new());
        }
        // The measurement has no error against itself.
        if lights.measured.is_some() {
            cells.push(if is_found { lights.error(direction) } else { String::new() });
        }
        Row { heading: Some((escaped(name), 3)), cells, is_separated }
    };
    vec![
        row("Light, by the analysis", lights.computed, true, true),
        row("Light, average of the surface vectors", lights.average, true, false),
        row(
            "Light, independent measurement",
            lights.measured.as_ref().map(|measured| measured.direction),
            false,
            false,
        ),
    ]
}

/// How the light was found and how exactly, sentences.
pub fn light_sentence(scene: &Scene, lights: &Lights) -> String {
    let Some(computed) = lights.computed else {
        return format!("The color of the light is not known: {}.", scene.report.illuminant.reason);
    };
    let average = match lights.average {
        Some(average) => format!(
            "The average of {} fitted to the highlights, as the paper computes the light, is {}.",
            counted(lights.fitted, "surface reflection vector", "surface reflection vectors"),
            vector(average)
        ),
        None => {
            "No region has enough highlight pixels for a surface reflection vector of its own.".to_owned()
        }
    };
    format!("{} {average} {}", found_sentence(scene, computed), measured_sentence(lights, computed))
}

/// How the light of the analysis was found.
fn found_sentence(scene: &Scene, computed: [f64; 3]) -> String {
    let facts = &scene.report.illuminant;
    let light = vector(computed);
    let second = facts.second.as_ref().map_or_else(String::new, second_lamp_sentence);
    if facts.given {
        return format!("The light is {light}, as it was given.{second}");
    }
    let [one, many] =
        if facts.basis == "votes" { ["small highlight", "small highlights"] } else { ["object", "objects"] };
    let interval = facts
        .interval_deg
        .map_or_else(String::new, |interval| format!(" to within {} by its own evidence", degrees(interval)));
    let objects = counted(facts.objects, one, many);
    format!("The light is {light}, found from {objects}{interval} ({}).{second}", facts.reason)
}

/// What the second lamp is, and where its color comes from; begins with a space.
fn second_lamp_sentence(second: &SecondLampFacts) -> String {
    let objects = counted(second.objects, "object", "objects");
    let known = match second.interval_deg {
        Some(interval) => format!("found from {objects} to within {}", degrees(interval)),
        None => format!("as it was given, with the highlights of {objects}"),
    };
    format!(
        " A second lamp is {}, {known}, {} from the first; the regions with its highlights are split with its color.",
        vector(second.direction),
        degrees(second.angle_deg)
    )
}

/// How far the light of the analysis and the average are from the independent measurement.
fn measured_sentence(lights: &Lights, computed: [f64; 3]) -> String {
    let Some(Measured { direction, source }) = &lights.measured else {
        return "No independent measurement of the light is known.".to_owned();
    };
    let average = lights.average.map_or_else(String::new, |average| {
        format!(" and {} from the average", degrees(angle_deg(average, *direction)))
    });
    format!(
        "The independent measurement, from {source}, is {}: {} from the light of the analysis{average}.",
        vector(*direction),
        degrees(angle_deg(computed, *direction)),
    )
}

/// The lights of several photographs, each with its name, a row each, as in the last rows of tables 3 to 5.
pub fn lights_table(photographs: &[(&str, &Lights)]) -> Table {
    let row = |(name, lights): &(&str, &Lights)| {
        Row::of(vec![
            escaped(name),
            shown_vector(lights.computed),
            lights.error(lights.computed),
            shown_vector(lights.average),
            lights.error(lights.average),
            shown_vector(lights.measured.as_ref().map(|measured| measured.direction)),
        ])
    };
    let columns = [
        ("photograph", Column::Text),
        ("by the analysis", Column::Vector),
        ("error", Column::Number),
        ("average of surface vectors", Column::Vector),
        ("error", Column::Number),
        ("independent measurement", Column::Vector),
    ];
    let note = if photographs.iter().any(|(_, lights)| lights.measured.is_some()) {
        "Error: angle to the independent measurement. The paper\u{2019}s own errors, from its tables, are 0.5\u{b0} under white light with \
         eight objects, and 1.3\u{b0} (yellow), 9.0\u{b0} (white) and 13.1\u{b0} (pink light) with three cups."
    } else {
        "No independent measurement is known."
    };
    Table {
        caption: "The light of each photograph.".to_owned(),
        counterpart: "the last rows of tables 3 to 5",
        columns: columns.map(|(name, column)| (name.to_owned(), column)).to_vec(),
        rows: photographs.iter().map(row).collect(),
        note: note.to_owned(),
    }
}
