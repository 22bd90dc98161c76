//! Numbers as text, in the forms that captions and tables use.

use crate::color::srgb_from_linear;

/// A whole number in groups of three digits, with narrow spaces at which no line is broken.
pub fn grouped(number: usize) -> String {
    crate::describe::grouped(number).replace('\u{2009}', "\u{202f}")
}

/// A sentence with its numbers in groups of three digits, at which no line is broken.
pub fn with_grouped_numbers(sentence: &str) -> String {
    crate::describe::with_grouped_numbers(sentence).replace('\u{2009}', "\u{202f}")
}

/// A share as percent with one decimal.
pub fn percent(part: usize, whole: usize) -> String {
    format!("{:.1}\u{a0}%", 100.0 * part as f64 / whole.max(1) as f64)
}

/// A number with a noun in the singular or in the plural: `1 region`, `12 regions`.
pub fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{}\u{a0}{}", grouped(number), if number == 1 { one } else { many })
}

/// A unit vector as in the tables of the paper: two decimals. No line is broken inside.
pub fn vector(v: [f64; 3]) -> String {
    let [r, g, b] = v.map(|v| decimals(v, 2));
    format!("({r},\u{a0}{g},\u{a0}{b})")
}

/// A number with a fixed number of decimals and the sign of mathematics; a zero has none.
pub fn decimals(value: f64, digits: usize) -> String {
    let text = format!("{:.digits$}", value.abs());
    let is_zero = text.bytes().all(|byte| byte == b'0' || byte == b'.');
    if value < 0.0 && !is_zero { format!("\u{2212}{text}") } else { text }
}

/// A number with at most three decimals, without zeros at its end.
pub fn short(value: f64) -> String {
    let text = decimals(value, 3);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// An angle with two decimals.
pub fn degrees(angle_deg: f64) -> String {
    format!("{angle_deg:.2}\u{b0}")
}

/// Angle between two unit vectors, degrees.
pub fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    crate::truth::angle_deg(a, b)
}

/// A direction as the brightest color of that direction, sRGB.
pub fn swatch(direction: [f64; 3]) -> [u8; 3] {
    let largest = direction.iter().fold(1e-9f64, |most, v| most.max(*v));
    direction.map(|v| (255.0 * srgb_from_linear((v / largest).clamp(0.0, 1.0) as f32)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_form_of_the_papers_tables() {
        assert_eq!(vector([0.994, -0.081, -0.001]), "(0.99,\u{a0}\u{2212}0.08,\u{a0}0.00)");
        assert_eq!(
            (short(2.5), short(4.0), short(0.0626), short(-1.0)),
            ("2.5".into(), "4".into(), "0.063".into(), "\u{2212}1".into())
        );
        assert_eq!(
            (counted(1, "region", "regions"), percent(1, 0)),
            ("1\u{a0}region".into(), "100.0\u{a0}%".into())
        );
        assert_eq!(swatch([0.5, 0.25, -0.1]), [255, 188, 0]);
    }
}
