//! The figures and tables of the paper for any photograph, as one HTML page that needs nothing else.
//!
//! Pictures are PNG files within the page, plots are SVG, and no script is needed, so that the page can be kept, sent and printed. The
//! order follows the paper: color figures 1 to 15, tables 1 to 6. A figure that a photograph cannot have says why. The page depends
//! on the scene alone: the same bytes at any number of threads, and no date but one that is given.

mod cube;
mod frame;
mod html;
mod intrinsic_figures;
mod numbers;
mod parameters;
mod picture;
mod profile_plot;
mod scene;
mod segmentation_figures;
mod side_by_side;
mod vectors;

pub use scene::{AnalyzedPhotograph, Measured, OtherSegmentation, Scene, SceneError};
pub use side_by_side::{ComparedScene, side_by_side};

use frame::{file_line, footer, header};
use html::Page;
use numbers::{counted, percent};
use vectors::Lights;

/// All figures and tables of one photograph as an HTML document. `date` is printed at its end; none: no date is.
pub fn page(scene: &Scene, date: Option<&str>) -> String {
    let mut page = Page::default();
    let fits = vectors::fits(scene);
    let lights = Lights::of(scene, &fits);
    page.html(&header(&format!("Figures of {}", scene.name()), &abstract_of(scene, &lights)));

    page.section("The photograph and its colors");
    page.figure(&segmentation_figures::photograph(scene));
    page.figure(&segmentation_figures::histogram(scene));

    page.section("From windows to regions");
    page.pair([&segmentation_figures::classification(scene), &segmentation_figures::areas(scene)]);
    page.pair([&segmentation_figures::linear(scene), &segmentation_figures::planar(scene)]);
    page.figure(&segmentation_figures::finals(scene));
    page.table(&segmentation_figures::class_table(scene));

    page.section("Reflection vectors and the light");
    page.paragraph(&vectors::light_sentence(scene, &lights));
    page.table(&vectors::table(scene, &fits, "tables 2 to 5"));

    page.section("Intrinsic images");
    page.pair([&intrinsic_figures::body(scene), &intrinsic_figures::surface(scene)]);
    page.figure(&intrinsic_figures::noise(scene));
    page.figure(&intrinsic_figures::profiles(scene));
    if let Some(accuracy) = parameters::accuracy(scene) {
        page.table(&accuracy);
    }

    page.section("Summary and comparison");
    page.figure(&intrinsic_figures::quarters(scene));
    page.figure(&intrinsic_figures::other_method(scene));

    page.section("Control parameters");
    page.table(&parameters::table(scene));
    parameters::add_warnings(&mut page, scene);
    page.html(&footer(&[file_line(scene)], date));
    page.document(&format!("Figures of {}", scene.name()))
}

/// What was found, sentences.
fn abstract_of(scene: &Scene, lights: &Lights) -> String {
    let (facts, counts) = (&scene.report.image, &scene.counts);
    let found = format!(
        "The {} found {} in this photograph of {} \u{d7} {} pixels; they hold {} of the lit pixels.",
        parameters::method_name(scene.shown.params.method),
        counted(scene.report.regions.len(), "region", "regions"),
        facts.width,
        facts.height,
        percent(counts.lit_in_regions[2], counts.lit),
    );
    let light = match (lights.computed, &lights.measured) {
        (Some(light), Some(measured)) => format!(
            "The light is {}, {} from the independent measurement.",
            numbers::vector(light),
            numbers::degrees(numbers::angle_deg(light, measured.direction))
        ),
        (Some(light), None) => format!("The light is {}.", numbers::vector(light)),
        (None, _) => "The color of the light is not known.".to_owned(),
    };
    format!("{found} {light}")
}

#[cfg(test)]
mod tests;
