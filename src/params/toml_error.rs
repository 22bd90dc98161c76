//! What is wrong with a parameter file, and in which line.

/// An error of the TOML file `name` with the text `text` as one line of text: name, number of the line, and what is wrong.
pub fn toml_error(name: &str, text: &str, error: &toml::de::Error) -> String {
    let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
    let line = before.matches('\n').count() + 1;
    format!("{name}:{line}: {}", error.message().replace('\n', " "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;

    #[test]
    fn an_error_names_the_file_and_the_line() {
        let text = "min_area = 100\nwindow = 3\n";
        let error = toml::from_str::<Params>(text).unwrap_err();
        let told = toml_error("a.toml", text, &error);
        assert!(told.starts_with("a.toml:2: unknown field `window`"), "{told}");
        assert!(!told.contains('\n'), "{told}");
    }
}
