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

/// A sentence of a report with thin spaces between groups of three digits of its numbers. Digits within a word, such as a file name, stay
/// as they are.
pub fn with_grouped_numbers(sentence: &str) -> String {
    let grouped_word = |word: &str| {
        let number = word.trim_matches(|letter: char| !letter.is_alphanumeric());
        let is_decimal = number.bytes().all(|letter| letter.is_ascii_digit() || letter == b'.');
        if is_decimal && number.parse::<f64>().is_ok() {
            word.replacen(number, &group_whole_part(number), 1)
        } else {
            word.to_owned()
        }
    };
    let words: Vec<String> = sentence.split(' ').map(grouped_word).collect();
    words.join(" ")
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
    use super::{counted, grouped, grouped_decimals, with_grouped_numbers};

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
    fn numbers_of_a_sentence_are_grouped_and_names_are_not() {
        let spaced = |sentence: &str| with_grouped_numbers(sentence).replace('\u{2009}', "_");
        assert_eq!(
            spaced(
                "12345 of 1234567 pixels (9999, 1000.5 counts): 2.25 in IMG_20240131.jpg, a 4000x3000 file"
            ),
            "12_345 of 1_234_567 pixels (9_999, 1_000.5 counts): 2.25 in IMG_20240131.jpg, a 4000x3000 file"
        );
        assert_eq!(
            spaced("no number  at \u{2212}1500 \u{2013} 1.2.3000"),
            "no number  at \u{2212}1_500 \u{2013} 1.2.3000"
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
