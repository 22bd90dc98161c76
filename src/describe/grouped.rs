//! Numbers in sentences and in panels, in groups of three digits. Trace lines and reports hold numbers as they are.

use std::fmt;

/// A whole number of any type with thin spaces between groups of three digits.
pub fn grouped(number: impl fmt::Display + Ord + Copy) -> String {
    group_whole_part(&number.to_string())
}

/// A number with so many decimals, and with thin spaces between groups of three digits of its whole part.
pub fn grouped_decimals(number: f64, decimals: usize) -> String {
    group_whole_part(&format!("{number:.decimals$}"))
}

/// A number of things: `1 pixel`, `14 452 pixels` with thin spaces. `what` is the singular of a word whose plural ends in s.
pub fn counted(number: impl fmt::Display + Ord + Copy, what: &str) -> String {
    let number = grouped(number);
    let ending = if number == "1" { "" } else { "s" };
    format!("{number} {what}{ending}")
}

/// The text of a number with thin spaces between groups of three digits before the point.
fn group_whole_part(number: &str) -> String {
    let end = number.find('.').unwrap_or(number.len());
    let mut text = String::with_capacity(number.len() * 2);
    for (place, letter) in number.char_indices() {
        let is_between = letter.is_ascii_digit() && text.ends_with(|before: char| before.is_ascii_digit());
        if is_between && place < end && (end - place).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(letter);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{counted, grouped, grouped_decimals};

    #[test]
    fn one_thing_is_told_in_the_singular() {
        let texts = [0, 1, 2, 1200].map(|number| counted(number, "pixel").replace('\u{2009}', " "));
        assert_eq!(texts, ["0 pixels", "1 pixel", "2 pixels", "1 200 pixels"]);
    }

    #[test]
    fn groups_of_three_digits_are_counted_from_the_right() {
        let spaced = |number| grouped(number).replace('\u{2009}', " ");
        assert_eq!(
            [0, 999, 1000, 14_452, 1_234_567].map(spaced),
            ["0", "999", "1 000", "14 452", "1 234 567"]
        );
    }

    #[test]
    fn decimals_and_signs_are_in_no_group() {
        let spaced = |number| grouped_decimals(number, 4).replace('\u{2009}', " ");
        assert_eq!(
            [0.0, -123.0, -1234.5, 16_256.25, f64::INFINITY].map(spaced),
            ["0.0000", "-123.0000", "-1 234.5000", "16 256.2500", "inf"]
        );
    }
}
