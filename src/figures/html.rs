//! The parts of a page: sections, numbered figures, numbered tables, and the whole document.
//!
//! Texts named `html` are markup already; all other texts are escaped here.

use std::fmt::Write;

/// The look of a page, on a screen and in print.
const STYLE: &str = include_str!("style.css");
/// Tables with at most this number of rows are not divided between two pages of a print.
const SHORT_TABLE_ROWS: usize = 18;

/// A text with the characters that HTML reserves as entities. Control characters become the replacement character.
pub fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            c if c.is_control() => html.push('\u{fffd}'),
            c => html.push(c),
        }
    }
    html
}

/// A small square of a color (sRGB), in front of a name.
pub fn key(color: [u8; 3]) -> String {
    let [r, g, b] = color;
    format!("<i class=\"key\" style=\"background:#{r:02x}{g:02x}{b:02x}\"></i>")
}

/// A row of colors (sRGB) and their names.
pub fn keys<'a>(entries: impl IntoIterator<Item = ([u8; 3], &'a str)>) -> String {
    let entry = |(color, name): ([u8; 3], &str)| format!("<span>{}{}</span>", key(color), escaped(name));
    let all: String = entries.into_iter().map(entry).collect();
    format!("<div class=\"keys\">{all}</div>")
}

/// What a figure shows.
pub enum Content {
    /// Pictures and plots, as markup.
    Html(String),
    /// Nothing, and why: a sentence.
    Absent(String),
}

/// A figure without its number.
pub struct Figure {
    /// The title, a few words.
    pub title: &'static str,
    /// The figure of the paper that the figure corresponds to.
    pub counterpart: &'static str,
    /// The picture.
    pub content: Content,
    /// The caption after the title, sentences. Not shown where the figure is absent.
    pub caption: String,
}

/// How the cells of a column are set.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Words.
    Text,
    /// Numbers, set to the right.
    Number,
    /// Three numbers in parentheses.
    Vector,
}

impl Column {
    const fn class(self) -> &'static str {
        match self {
            Self::Text => "",
            Self::Number => " class=\"number\"",
            Self::Vector => " class=\"vector\"",
        }
    }
}

/// A table without its number.
pub struct Table {
    /// The title and the caption, sentences.
    pub caption: String,
    /// The table of the paper that the table corresponds to.
    pub counterpart: &'static str,
    /// The headings of the columns and how their cells are set.
    pub columns: Vec<(String, Column)>,
    /// The cells of each row, as markup.
    pub rows: Vec<Row>,
    /// A remark below the table; empty for none.
    pub note: String,
}

/// A row of a table.
pub struct Row {
    /// A cell over several columns, as markup, before the others, and the number of its columns; none: no such cell.
    pub heading: Option<(String, usize)>,
    /// The cells, as markup.
    pub cells: Vec<String>,
    /// Whether a line separates the row from the row above.
    pub is_separated: bool,
}

impl Row {
    /// A row without a line above.
    pub fn of(cells: Vec<String>) -> Self {
        Self { heading: None, cells, is_separated: false }
    }
}

/// A page that is being composed; it numbers figures and tables.
#[derive(Default)]
pub struct Page {
    html: String,
    figures: usize,
    tables: usize,
}

impl Page {
    /// Adds markup.
    pub fn html(&mut self, html: &str) {
        self.html.push_str(html);
        self.html.push('\n');
    }

    /// Begins a section.
    pub fn section(&mut self, title: &str) {
        self.html(&format!("<h2>{}</h2>", escaped(title)));
    }

    /// Adds a paragraph of text.
    pub fn paragraph(&mut self, text: &str) {
        self.html(&format!("<p>{}</p>", escaped(text)));
    }

    /// Adds a list of sentences.
    pub fn list(&mut self, items: &[String]) {
        let items: Vec<String> = items.iter().map(|item| format!("<li>{}</li>", escaped(item))).collect();
        self.html(&format!("<ul>\n{}\n</ul>", items.join("\n")));
    }

    /// Adds a figure over the whole width.
    pub fn figure(&mut self, figure: &Figure) {
        let html = self.numbered(figure);
        self.html(&html);
    }

    /// Adds two figures side by side.
    pub fn pair(&mut self, [left, right]: [&Figure; 2]) {
        let (left, right) = (self.numbered(left), self.numbered(right));
        self.html(&format!("<div class=\"pair\">\n{left}\n{right}\n</div>"));
    }

    /// A figure with the next number.
    fn numbered(&mut self, figure: &Figure) -> String {
        self.figures += 1;
        let counterpart = counterpart(figure.counterpart);
        let (content, caption) = match &figure.content {
            Content::Html(html) => (html.clone(), escaped(&figure.caption)),
            Content::Absent(why) => (format!("<p class=\"absent\">{}</p>", escaped(why)), String::new()),
        };
        format!(
            "<figure>\n{content}\n<figcaption><b>Figure {}.</b> {}. {caption}{counterpart}</figcaption>\n</figure>",
            self.figures,
            escaped(figure.title),
        )
    }

    /// Adds a table.
    pub fn table(&mut self, table: &Table) {
        self.tables += 1;
        let mut html = String::new();
        let short = if table.rows.len() <= SHORT_TABLE_ROWS { " short" } else { "" };
        // Writing to a string cannot fail.
        let _ = write!(
            html,
            "<div class=\"table{short}\">\n<table>\n<caption><b>Table {}.</b> {}{}</caption>\n<thead><tr>",
            self.tables,
            escaped(&table.caption),
            counterpart(table.counterpart),
        );
        for (heading, column) in &table.columns {
            let _ = write!(html, "<th{}>{}</th>", column.class(), escaped(heading));
        }
        html.push_str("</tr></thead>\n<tbody>\n");
        for row in &table.rows {
            html.push_str(if row.is_separated { "<tr class=\"rule\">" } else { "<tr>" });
            let mut first = 0;
            if let Some((heading, columns)) = &row.heading {
                let _ = write!(html, "<td colspan=\"{columns}\">{heading}</td>");
                first = *columns;
            }
            for (cell, (_, column)) in row.cells.iter().zip(table.columns.iter().skip(first)) {
                let _ = write!(html, "<td{}>{cell}</td>", column.class());
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody>\n</table>");
        if !table.note.is_empty() {
            let _ = write!(html, "\n<p class=\"note\">{}</p>", escaped(&table.note));
        }
        html.push_str("\n</div>");
        self.html(&html);
    }

    /// The whole document. `title` is the title of the browser's tab.
    pub fn document(self, title: &str) -> String {
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
             <style>\n{STYLE}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
            escaped(title),
            self.html
        )
    }
}

/// The reference to the paper at the end of a caption; empty where there is none.
fn counterpart(what: &str) -> String {
    if what.is_empty() {
        String::new()
    } else {
        format!(" <span class=\"counterpart\">Counterpart in the paper: {}.</span>", escaped(what))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(content: Content) -> Figure {
        Figure { title: "A <title>", counterpart: "color figure 1", content, caption: "One & two. ".into() }
    }

    #[test]
    fn texts_are_escaped_and_markup_is_not() {
        let mut page = Page::default();
        page.figure(&figure(Content::Html("<img>".into())));
        let html = page.document("<&\u{1}>");
        assert!(html.contains("<title>&lt;&amp;\u{fffd}&gt;</title>"));
        assert!(html.contains("<img>\n<figcaption><b>Figure 1.</b> A &lt;title&gt;. One &amp; two. "));
        assert!(html.contains("Counterpart in the paper: color figure 1."));
    }

    #[test]
    fn figures_and_tables_are_numbered_apart_and_an_absent_figure_says_why() {
        let mut page = Page::default();
        let absent = figure(Content::Absent("No light was found.".into()));
        page.pair([&absent, &absent]);
        page.table(&Table {
            caption: "A table.".into(),
            counterpart: "",
            columns: vec![("n".into(), Column::Number)],
            rows: vec![Row::of(vec!["1".into()])],
            note: String::new(),
        });
        let html = page.document("");
        assert!(html.contains("Figure 2.") && html.contains("<b>Table 1.</b> A table.</caption>"));
        assert!(html.contains("<p class=\"absent\">No light was found.</p>") && !html.contains("One &amp;"));
        assert!(html.contains("<td class=\"number\">1</td>"));
    }
}
