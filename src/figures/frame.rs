//! The beginning and the end of a page.

use super::html::escaped;
use super::scene::Scene;

/// The title of the paper.
const PAPER: &str = "G. J. Klinker, S. A. Shafer and T. Kanade, A Physical Approach to Color Image Understanding, International Journal \
     of Computer Vision 4 (1990)";

/// The title of a page and what the page shows.
pub fn header(title: &str, about: &str) -> String {
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"subtitle\">Figures and tables after Klinker, Shafer and Kanade (1990)</p>\n\
         <p class=\"abstract\">{}</p>\n</header>",
        escaped(title),
        escaped(about)
    )
}

/// A photograph's file, as markup.
pub fn file_line(scene: &Scene) -> String {
    let facts = &scene.report.image;
    format!(
        "{}: {} \u{d7} {} pixels, {}, SHA-256 {}.",
        escaped(&facts.file),
        facts.width,
        facts.height,
        escaped(&facts.encoding),
        escaped(&facts.sha256)
    )
}

/// The files, the program and the paper. `date`: printed as it is given.
pub fn footer(files: &[String], date: Option<&str>) -> String {
    let date = date.map_or_else(String::new, |date| format!(" {}.", escaped(date)));
    format!(
        "<footer>\n<p>{}</p>\n<p>Made by Dichroscope {}.{date} Sections, figures and tables that captions name as counterparts are those of: \
         {}.</p>\n</footer>",
        files.join("<br>\n"),
        escaped(env!("CARGO_PKG_VERSION")),
        escaped(PAPER)
    )
}
