//! The regions as text for other programs.

use super::ResultSnapshot;
use crate::describe::sentences;
use crate::intrinsic::RegionReflection;
use std::borrow::Cow;

/// The columns of the table.
const HEADINGS: [&str; 16] = [
    "region",
    "pixels",
    "matte_pixels",
    "highlight_pixels",
    "clipped_pixels",
    "body_r",
    "body_g",
    "body_b",
    "surface_r",
    "surface_g",
    "surface_b",
    "angle_deg",
    "fit_rms_counts",
    "holds",
    "separable",
    "warnings",
];

/// What stands between the columns of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// Tabs, as spreadsheets expect of copied cells.
    Tab,
    /// Commas; a field that holds a comma, a quotation mark or a line end is quoted (RFC 4180).
    Comma,
}

/// The table of the regions as text: one region a line, with a line of headings.
pub fn regions_text(shown: &ResultSnapshot, separator: Separator) -> String {
    let mut text = separator.line(HEADINGS);
    for region in &shown.analysis.intrinsic.regions {
        text += &separator.line(fields(region).iter().map(String::as_str));
    }
    text
}

/// The fields of a region in the order of the headings.
fn fields(region: &RegionReflection) -> [String; HEADINGS.len()] {
    let [body_r, body_g, body_b] = region.body.map(|share| format!("{share:.5}"));
    let surface = region.surface.map(|vector| vector.map(|share| format!("{share:.5}")));
    let [surface_r, surface_g, surface_b] = surface.unwrap_or_default();
    [
        region.id.to_string(),
        region.pixels.to_string(),
        region.matte_pixels.to_string(),
        region.highlight_pixels.to_string(),
        region.clipped_pixels.to_string(),
        body_r,
        body_g,
        body_b,
        surface_r,
        surface_g,
        surface_b,
        region.angle_deg.map_or_else(String::new, |angle| format!("{angle:.2}")),
        format!("{:.3}", region.fit_rms_counts),
        region.model_fits().to_string(),
        region.separable.to_string(),
        sentences(&region.warnings).join("; "),
    ]
}

impl Separator {
    /// Fields as one line with its end.
    fn line<'a>(self, fields: impl IntoIterator<Item = &'a str>) -> String {
        let fields: Vec<Cow<str>> = fields.into_iter().map(|field| self.field(field)).collect();
        let mut line = fields.join(match self {
            Self::Tab => "\t",
            Self::Comma => ",",
        });
        line.push('\n');
        line
    }

    /// A field such that it stays one field.
    fn field(self, text: &str) -> Cow<'_, str> {
        match self {
            Self::Tab if text.contains(['\t', '\n', '\r']) => text.replace(['\t', '\n', '\r'], " ").into(),
            Self::Comma if text.contains([',', '"', '\n', '\r']) => {
                format!("\"{}\"", text.replace('"', "\"\"")).into()
            }
            Self::Tab | Self::Comma => text.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::tiny;

    #[test]
    fn the_table_has_a_field_for_each_heading_and_says_what_holds() {
        let shown = tiny();
        for (separator, character) in [(Separator::Tab, '\t'), (Separator::Comma, ',')] {
            let text = regions_text(&shown, separator);
            let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(character).collect()).collect();
            assert_eq!(rows.len(), 1 + shown.analysis.intrinsic.regions.len());
            assert_eq!(rows[0], HEADINGS);
            for (row, region) in rows[1..].iter().zip(&shown.analysis.intrinsic.regions) {
                assert_eq!(row.len(), HEADINGS.len(), "{row:?}");
                assert_eq!(row[13], region.model_fits().to_string());
            }
        }
    }

    #[test]
    fn a_field_with_a_separator_stays_one_field() {
        assert_eq!(Separator::Comma.line(["a", "b, \"c\"; d"]), "a,\"b, \"\"c\"\"; d\"\n");
        assert_eq!(Separator::Tab.line(["a, b", "c\td"]), "a, b\tc d\n");
    }
}
