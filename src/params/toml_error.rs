//! What is wrong with a parameter file, and in which line.

use super::method::Method;
use super::nearest::nearest;
use super::paper::PaperMethod;
use super::phoenix::PhoenixSettings;
use super::refine::Refine;
use super::values::Params;
use toml::de::DeTable;

/// An error of the TOML file `name` with the text `text` as one line of text: name, number of the line, and what is wrong. Of a name
/// that is not known, the known name nearest to it.
pub fn toml_error(name: &str, text: &str, error: &toml::de::Error) -> String {
    let message = error.message().replace('\n', " ");
    let line =
        error.span().map_or(1, |span| line_at(text, span.start + offset_of_name(text, span.start, &message)));
    format!("{name}:{line}: {}", with_nearest_name(&message).unwrap_or(message))
}

/// Number of bytes from `start`, where the error begins, to the name that the message begins with in quotation marks: an error in a
/// table begins at the header of the table.
fn offset_of_name(text: &str, start: usize, message: &str) -> usize {
    let name = message.strip_prefix('"').and_then(|rest| rest.split('"').next());
    name.and_then(|name| text.get(start..)?.find(name)).unwrap_or(0)
}

/// The message about an unknown field or variant, whose list of all is replaced by the nearest one; none where none is near, and for
/// other messages.
fn with_nearest_name(message: &str) -> Option<String> {
    let (what, rest) = message.split_once(" `").filter(|(what, _)| what.starts_with("unknown "))?;
    let (unknown, expected) = rest.split_once("`, expected ")?;
    let known = nearest(unknown, expected.split('`').skip(1).step_by(2))?;
    Some(format!("{what} `{unknown}`: did you mean `{known}`?"))
}

/// What a parameter file sets although `method` does not read it, a sentence each, which begins with the file's name and the line.
/// A table that sets nothing but defaults is not mentioned.
pub fn unread_tables(name: &str, text: &str, method: Method) -> Vec<String> {
    let (Ok(params), Ok(table)) = (toml::from_str::<Params>(text), DeTable::parse(text)) else {
        return Vec::new();
    };
    let tables = [
        ("refine", Method::Refined, params.refine == Refine::default()),
        ("paper", Method::Paper, params.paper == PaperMethod::default()),
        ("phoenix", Method::Phoenix, params.phoenix == PhoenixSettings::default()),
    ];
    let unread = tables.into_iter().filter(|&(_, reader, is_default)| reader != method && !is_default);
    let line_of = |key: &str| {
        let found = table.get_ref().keys().find(|known| known.get_ref() == key);
        found.map_or(1, |known| line_at(text, known.span().start))
    };
    let sentence = |(key, reader, _): (&str, Method, bool)| {
        format!(
            "{name}:{}: [{key}] is not used, because it belongs to method = {} and the method is {}",
            line_of(key),
            reader.name(),
            method.name()
        )
    };
    unread.map(sentence).collect()
}

/// Number of the line that holds the byte `at`, from 1.
fn line_at(text: &str, at: usize) -> usize {
    text.get(..at).unwrap_or_default().matches('\n').count() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> String {
        toml_error("a.toml", text, &toml::from_str::<Params>(text).unwrap_err())
    }

    #[test]
    fn an_error_names_the_file_and_the_line() {
        let far = told("min_area = 100\nwindow = 3\n");
        assert!(far.starts_with("a.toml:2: unknown field `window`, expected one of `method`"), "{far}");
        assert!(!far.contains('\n'), "{far}");
    }

    #[test]
    fn a_misspelled_name_is_answered_with_the_nearest_one() {
        let near = "a.toml:2: unknown field `windowsize`: did you mean `window_size`?";
        assert_eq!(told("min_area = 100\nwindowsize = 3\n"), near);
        assert_eq!(told("\n[papper]\nx = 1\n"), "a.toml:2: unknown field `papper`: did you mean `paper`?");
        let near = "a.toml:3: unknown field `all_seed`: did you mean `all_seeds`?";
        assert_eq!(told("\n[refine]\nall_seed = true\n"), near);
        assert_eq!(told("method = \"papr\"\n"), "a.toml:1: unknown variant `papr`: did you mean `paper`?");
        let near = "a.toml:3: \"fill_hole\" is the name of no reading; did you mean `fill_holes`?";
        assert_eq!(told("[paper]\nevery_pixel = true\nfill_hole = true\n"), near);
    }

    #[test]
    fn a_table_of_another_method_is_named_with_its_line_unless_it_holds_defaults_only() {
        let text = "min_area = 100\n[paper]\nfill_holes = true\n\n[refine]\nall_seeds = true\n";
        let unread = unread_tables("a.toml", text, Method::Refined);
        let expected =
            "a.toml:2: [paper] is not used, because it belongs to method = paper and the method is refined";
        assert_eq!(unread, [expected]);
        assert!(unread_tables("a.toml", text, Method::Paper).is_empty());
        let text = "phoenix.maxmin = 150\n";
        assert!(unread_tables("a.toml", text, Method::TopDown)[0].starts_with("a.toml:1: [phoenix] is not"));
        let all = toml::to_string(&Params::default()).unwrap();
        assert!(unread_tables("a.toml", &all, Method::Phoenix).is_empty());
    }
}
