//! Several photographs on one page, as the paper shows three cups under three lamps (color figures 12 to 14, tables 3 to 6).

use super::frame::{file_line, footer, header};
use super::html::{Figure, Page, Table, escaped};
use super::numbers::counted;
use super::scene::Scene;
use super::vectors::Lights;
use super::{intrinsic_figures, parameters, vectors};

/// What a page about several photographs shows of one of them. It holds no picture of full size, so that many can be kept.
pub struct ComparedScene {
    name: String,
    file_line: String,
    quarters: Figure,
    vectors: Table,
    lights: Lights,
    parameters: Vec<String>,
    method: &'static str,
}

impl ComparedScene {
    /// The scene as it is compared with others.
    pub fn of(scene: &Scene) -> Self {
        let fits = vectors::fits(scene);
        Self {
            name: scene.name().to_owned(),
            file_line: file_line(scene),
            quarters: intrinsic_figures::quarters(scene),
            vectors: vectors::table(scene, &fits, "tables 3 to 5"),
            lights: Lights::of(scene, &fits),
            parameters: parameters::used_values(scene),
            method: parameters::method_name(scene.shown.params.method),
        }
    }
}

/// Photographs side by side as an HTML document. `links` are the addresses of the photographs' own pages, in the same order, or
/// empty. `date` is printed at the end; none: no date is.
pub fn side_by_side(scenes: &[ComparedScene], links: &[String], date: Option<&str>) -> String {
    const TITLE: &str = "Photographs side by side";
    let mut page = Page::default();
    let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
    let about = format!(
        "{}: {}. Each is shown with its segmentation and its intrinsic images; the tables compare light, reflection vectors and \
         parameters.",
        counted(scenes.len(), "photograph", "photographs"),
        names.join(", ")
    );
    page.html(&header(TITLE, &about));
    if !links.is_empty() {
        let link =
            |(link, name): (&String, &&str)| format!("<a href=\"{}\">{}</a>", escaped(link), escaped(name));
        let list: Vec<String> = links.iter().zip(&names).map(link).collect();
        page.html(&format!("<p>All figures of each: {}.</p>", list.join(", ")));
    }
    page.section("Segmentation and reflection analysis");
    for scene in scenes {
        page.figure(&scene.quarters);
    }
    page.section("The light");
    let lights: Vec<(&str, &Lights)> =
        names.iter().copied().zip(scenes.iter().map(|scene| &scene.lights)).collect();
    page.table(&vectors::lights_table(&lights));
    page.section("Reflection vectors");
    for scene in scenes {
        page.table(&scene.vectors);
    }
    page.section("Control parameters");
    let columns: Vec<(&str, &[String], &str)> =
        scenes.iter().map(|scene| (scene.name.as_str(), scene.parameters.as_slice(), scene.method)).collect();
    page.table(&parameters::side_by_side(&columns));
    let files: Vec<String> = scenes.iter().map(|scene| scene.file_line.clone()).collect();
    page.html(&footer(&files, date));
    page.document(TITLE)
}
