//! The control parameters (table 6), the switches, the accuracy and the warnings.

use super::html::{Column, Page, Row, Table, escaped};
use super::numbers::{decimals, short, with_grouped_numbers};
use super::scene::Scene;
use crate::params::{Method, Parameter, PhoenixParameter, Reading, Switch};

/// The method in words.
pub fn method_name(method: Method) -> &'static str {
    match method {
        Method::Refined => "refined method",
        Method::Paper => "method of the paper",
        Method::Phoenix => "method Phoenix",
        Method::TopDown => "top-down method",
        Method::ByHand => "method by hand",
    }
}

/// The table of a scene's parameters: the paper's values, what was asked for, what was used.
pub fn table(scene: &Scene) -> Table {
    let row = |parameter: Parameter| {
        let spec = parameter.spec();
        Row::of(vec![
            escaped(spec.title),
            escaped(spec.section),
            escaped(spec.unit),
            paper_value(parameter),
            scene.shown.params.get(parameter).to_string(),
            used(scene, parameter),
        ])
    };
    let columns = [
        ("parameter", Column::Text),
        ("where", Column::Text),
        ("unit", Column::Text),
        ("paper", Column::Number),
        ("asked", Column::Number),
        ("used", Column::Number),
    ];
    Table {
        caption: format!(
            "Control parameters: the values of the paper for its scene with eight objects, what was asked for, and what was used. \
             Counts refer to {} at full scale.",
            short(scene.report.image.full_scale)
        ),
        counterpart: "table 6",
        columns: columns.map(|(name, column)| (name.to_owned(), column)).to_vec(),
        rows: Parameter::ALL.into_iter().map(row).collect(),
        note: switches(scene),
    }
}

/// The values of a scene's parameters that were used, in the order of table 6.
pub fn used_values(scene: &Scene) -> Vec<String> {
    Parameter::ALL.into_iter().map(|parameter| used(scene, parameter)).collect()
}

/// The parameters of several photographs, a column each: the photograph's name, its values and its method.
pub fn side_by_side(photographs: &[(&str, &[String], &str)]) -> Table {
    let mut columns = vec![("parameter".to_owned(), Column::Text), ("unit".to_owned(), Column::Text)];
    columns.extend(photographs.iter().map(|(name, ..)| ((*name).to_owned(), Column::Number)));
    let row = |(i, parameter): (usize, Parameter)| {
        let spec = parameter.spec();
        let mut cells = vec![escaped(spec.title), escaped(spec.unit)];
        cells.extend(photographs.iter().map(|(_, values, _)| values.get(i).cloned().unwrap_or_default()));
        Row::of(cells)
    };
    let mut methods = vec!["method".to_owned(), String::new()];
    methods.extend(photographs.iter().map(|(.., method)| escaped(method)));
    let mut rows: Vec<Row> = Parameter::ALL.into_iter().enumerate().map(row).collect();
    rows.push(Row { cells: methods, is_separated: true, heading: None });
    Table {
        caption: "Control parameters, as they were used.".to_owned(),
        counterpart: "table 6",
        columns,
        rows,
        note: String::new(),
    }
}

fn paper_value(parameter: Parameter) -> String {
    short(parameter.spec().paper)
}

/// The value of a parameter that was used; `off` where it is infinite.
fn used(scene: &Scene, parameter: Parameter) -> String {
    let value = scene.shown.analysis.used.get(parameter);
    if value.is_finite() { short(value) } else { "off".to_owned() }
}

/// The switches that are on or off, and the readings, sentences.
fn switches(scene: &Scene) -> String {
    let params = &scene.shown.params;
    let refine = params.refinements();
    let named = |on: bool| -> Vec<&str> {
        Switch::ALL.into_iter().filter(|&switch| refine.get(switch) == on).map(Switch::name).collect()
    };
    match params.method {
        Method::Refined => {
            let off = named(false);
            if off.is_empty() {
                "All refinements are on.".to_owned()
            } else {
                format!("All refinements are on but {}.", off.join(", "))
            }
        }
        Method::Phoenix => {
            let settings = &params.phoenix;
            let values = PhoenixParameter::ALL
                .map(|parameter| format!("{} {}", parameter.name(), parameter.get(settings)));
            format!(
                "Of these, Phoenix reads only those of the masks. Its own: features {}, {}.",
                settings.features,
                values.join(", ")
            )
        }
        Method::ByHand => {
            "Of these, the method by hand reads those of the masks, the noise and the widths.".to_owned()
        }
        Method::TopDown => "Of these, the top-down method reads only those of the masks.".to_owned(),
        Method::Paper => {
            let on = named(true);
            let readings = &params.paper.readings;
            let read: Vec<&str> = Reading::ALL
                .into_iter()
                .filter(|&reading| readings.get(reading))
                .map(Reading::name)
                .collect();
            let added = if on.is_empty() {
                "No refinement is added.".to_owned()
            } else {
                format!("Added refinements: {}.", on.join(", "))
            };
            let read = if read.is_empty() { "none".to_owned() } else { read.join(", ") };
            format!("{added} Readings of the text that are on: {read}.")
        }
    }
}

/// The table of the scores against the ground truth; none without one.
pub fn accuracy(scene: &Scene) -> Option<Table> {
    let scores = scene.report.scores?;
    let db = |value: Option<f64>| {
        value.map_or_else(|| "\u{2013}".to_owned(), |value| format!("{} dB", decimals(value, 1)))
    };
    let share = |value: Option<f64>| value.map_or_else(|| "\u{2013}".to_owned(), |value| decimals(value, 3));
    let angle =
        |value: Option<f64>| value.map_or_else(|| "\u{2013}".to_owned(), |value| format!("{value:.2}\u{b0}"));
    let none = || "\u{2013}".to_owned();
    let rows = [
        ("adjusted Rand index of regions and objects", share(Some(scores.ari)), none()),
        ("mean intersection over union", share(scores.iou), none()),
        ("share of the objects\u{2019} lit pixels in a region", share(scores.cover), none()),
        ("mean angle of the body reflection vectors", angle(scores.body_deg), none()),
        ("angle of the light", angle(Some(scores.illum_deg)), none()),
        ("body image, unclipped pixels", db(scores.psnr_body), db(scores.psnr_nothing)),
        ("surface image, unclipped pixels", db(scores.psnr_surface), db(scores.psnr_surface_nothing)),
        ("body image, partly clipped pixels", db(scores.psnr_restored), db(scores.psnr_restored_nothing)),
    ];
    let columns = [("measure", Column::Text), ("result", Column::Number), ("doing nothing", Column::Number)];
    Some(Table {
        caption: "Accuracy against the ground truth. \u{201c}Doing nothing\u{201d} is the photograph as the body image and black as the \
                  surface image."
            .to_owned(),
        counterpart: "",
        columns: columns.map(|(name, column)| (name.to_owned(), column)).to_vec(),
        rows: rows.map(|(name, result, nothing)| Row::of(vec![escaped(name), result, nothing])).into(),
        note: String::new(),
    })
}

/// Most regions whose warnings are listed.
const MOST_WARNED: usize = 40;

/// Adds the section of the warnings.
pub fn add_warnings(page: &mut Page, scene: &Scene) {
    page.section("Warnings");
    let mut warnings: Vec<String> = scene.report.warnings.clone();
    let warned = scene.report.regions.iter().filter(|region| !region.warnings.is_empty());
    let all = warned.clone().count();
    warnings.extend(
        warned
            .take(MOST_WARNED)
            .map(|region| format!("Region {}: {}.", region.id, region.warnings.join("; "))),
    );
    if all > MOST_WARNED {
        warnings.push(format!("{} more regions have warnings.", all - MOST_WARNED));
    }
    if warnings.is_empty() {
        page.paragraph("The analysis gave no warning.");
    } else {
        let warnings: Vec<String> = warnings.iter().map(|warning| with_grouped_numbers(warning)).collect();
        page.list(&warnings);
    }
}
