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

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn groups_of_three_digits_are_counted_from_the_right() {
        let spaced = |number| grouped(number).replace('\u{2009}', " ");
        assert_eq!(
            [0, 999, 1000, 14_452, 1_234_567].map(spaced),
            ["0", "999", "1 000", "14 452", "1 234 567"]
        );
    }
}
