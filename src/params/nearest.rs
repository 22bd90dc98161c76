//! The known name that a misspelled name probably means.

use strsim::levenshtein;

/// Most single-letter edits, a third of the letters, by which a name may differ from the one that it means.
const LETTERS_PER_EDIT: usize = 3;

/// The name among `known` that `name` differs least from; none where all names are far away.
pub(super) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let simple = |text: &str| text.to_lowercase().replace([' ', '-', '.'], "_");
    let name = simple(name);
    let most = name.chars().count() / LETTERS_PER_EDIT;
    let distances = known.into_iter().map(|other| (levenshtein(&name, &simple(other)), other));
    distances
        .filter(|&(distance, _)| distance <= most)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, it)| it)
}

/// The hint for a name that is not known; empty where no known name is close.
pub(super) fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known).map_or_else(String::new, |known| format!("; did you mean `{known}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_close_name_is_found_and_a_far_one_is_not() {
        let known = ["window_size", "min_area", "slice_width"];
        for (name, expected) in [
            ("windowsize", Some("window_size")),
            ("Window-Size", Some("window_size")),
            ("min_aera", Some("min_area")),
            ("minarea", Some("min_area")),
            ("holes", None),
            ("", None),
        ] {
            assert_eq!(nearest(name, known), expected, "{name}");
        }
    }
}
