//! Numbers as text.

/// A whole number with thin spaces between groups of three digits.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 2);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A number of things: `1 pixel`, `14 452 pixels` with thin spaces. `what` is the singular of a word whose plural ends in s.
pub fn counted(number: usize, what: &str) -> String {
    format!("{} {what}{}", grouped(number), if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::{counted, grouped};

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
}
