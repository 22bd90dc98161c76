//! Paths that a person types or pastes, and the names of paths in lists.

use std::path::{Path, PathBuf};

/// The path in a typed or pasted text; none where the text holds none.
///
/// The text may be a path, a path in quotes, a path that begins with `~/`, a `file:` URI, or several lines of which the first
/// that holds a path counts: file managers copy a list of URIs, some with a header.
pub fn typed_path(text: &str) -> Option<PathBuf> {
    typed_paths(text).into_iter().next()
}

/// All paths in a typed or pasted text, one per line.
pub fn typed_paths(text: &str) -> Vec<PathBuf> {
    // Nautilus and others copy a header line and a word for the operation before the URIs.
    let is_header = |line: &str| line.starts_with("x-special/") || ["copy", "cut"].contains(&line);
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let has_header = lines.len() > 1 && lines.iter().any(|line| line.starts_with("file:"));
    lines
        .into_iter()
        .filter(|line| !(line.starts_with('#') || has_header && is_header(line)))
        .map(path_of_line)
        .collect()
}

/// The path in one line.
fn path_of_line(line: &str) -> PathBuf {
    let line = unquoted(line);
    if let Some(rest) = line.strip_prefix("file:") {
        // `file:///path`, `file://localhost/path` and `file:/path` name local files.
        let local = rest.strip_prefix("//localhost").or_else(|| rest.strip_prefix("//")).unwrap_or(rest);
        return path_from_percent_encoded(local);
    }
    let home = || directories::BaseDirs::new().map(|folders| folders.home_dir().to_path_buf());
    let below_home = line.strip_prefix("~/").and_then(|rest| Some(home()?.join(rest)));
    below_home.unwrap_or_else(|| PathBuf::from(line))
}

/// The text between quotes; the text itself where it stands in none.
fn unquoted(text: &str) -> &str {
    ['"', '\'']
        .into_iter()
        .find_map(|quote| text.strip_prefix(quote)?.strip_suffix(quote))
        .filter(|inside| !inside.is_empty())
        .unwrap_or(text)
}

/// The path that a percent-encoded text stands for. A percent sign without two hexadecimal digits stays.
fn path_from_percent_encoded(text: &str) -> PathBuf {
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let digits = bytes.get(at + 1..at + 3).and_then(|digits| std::str::from_utf8(digits).ok());
        let digits = digits.filter(|_| bytes[at] == b'%');
        if let Some(byte) = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            decoded.push(byte);
            at += 3;
        } else {
            decoded.push(bytes[at]);
            at += 1;
        }
    }
    path_from_bytes(decoded)
}

/// The path with these bytes. On Unix a path need not be UTF-8.
#[cfg(unix)]
fn path_from_bytes(bytes: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt;
    PathBuf::from(std::ffi::OsString::from_vec(bytes))
}

/// The path with these bytes, which are taken for UTF-8; `/C:/a` becomes `C:/a`.
#[cfg(not(unix))]
fn path_from_bytes(bytes: Vec<u8>) -> PathBuf {
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let drive = text.strip_prefix('/').filter(|rest| rest.as_bytes().get(1) == Some(&b':'));
    PathBuf::from(drive.unwrap_or(&text))
}

/// The file names of paths in their order; a name that occurs twice is followed by its folder.
pub fn unique_names(paths: &[PathBuf]) -> Vec<String> {
    let name = |path: &Path| path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let names: Vec<String> = paths.iter().map(|path| name(path)).collect();
    let is_twice = |wanted: &String| names.iter().filter(|name| *name == wanted).count() > 1;
    paths
        .iter()
        .zip(&names)
        .map(|(path, name)| match path.parent() {
            Some(folder) if is_twice(name) => format!("{name} \u{2013} {}", folder.display()),
            _ => name.clone(),
        })
        .collect()
}

/// First and last place, in characters, of the name of the file in a path, without the extension.
pub fn file_name_span(path: &str) -> [usize; 2] {
    let first = path.rfind(std::path::is_separator).map_or(0, |separator| separator + 1);
    let name = &path[first..];
    // A name that begins with a dot has no extension there.
    let stem = name.rfind('.').filter(|&dot| dot > 0).unwrap_or(name.len());
    [first, first + stem].map(|bytes| path[..bytes].chars().count())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str) -> String {
        typed_path(text).map_or_else(|| "none".to_owned(), |path| path.display().to_string())
    }

    #[test]
    fn every_form_of_a_path_is_read() {
        for (text, expected) in [
            ("/a/b c.png", "/a/b c.png"),
            ("  b.png \r\n", "b.png"),
            ("\"/a/b c.png\"", "/a/b c.png"),
            ("'/a/b.png'", "/a/b.png"),
            ("file:///a/b%20c%C3%A9.png", "/a/b c\u{e9}.png"),
            ("file://localhost/a/100%.png", "/a/100%.png"),
            ("file:/a/b.png", "/a/b.png"),
            ("\nfile:///a.png\r\nfile:///b.png\r\n", "/a.png"),
            ("x-special/nautilus-clipboard\ncopy\nfile:///a%2Bb.png", "/a+b.png"),
            ("# comment\nfile:///c.png", "/c.png"),
            ("copy", "copy"),
            ("\"", "\""),
            ("", "none"),
            (" \n ", "none"),
        ] {
            assert_eq!(path(text), expected, "{text:?}");
        }
        assert_eq!(typed_paths("file:///a.png\nfile:///b.png").len(), 2);
    }

    #[test]
    fn a_path_below_the_home_folder_is_absolute() {
        if let Some(folders) = directories::BaseDirs::new() {
            assert_eq!(typed_path("~/a.png"), Some(folders.home_dir().join("a.png")));
        }
        assert_eq!(path("~a.png"), "~a.png");
    }

    #[test]
    fn equal_names_are_followed_by_their_folders() {
        let paths: Vec<PathBuf> = ["/x/a.png", "/y/a.png", "/y/b.png"].map(PathBuf::from).to_vec();
        assert_eq!(unique_names(&paths), ["a.png \u{2013} /x", "a.png \u{2013} /y", "b.png"]);
    }

    #[test]
    fn the_name_of_a_file_is_between_the_last_separator_and_the_last_dot() {
        for (path, selected) in [
            ("/h\u{fc}te/cups-matte.png", "cups-matte"),
            ("/cups/cups-result", "cups-result"),
            ("parameters.toml", "parameters"),
            ("/cups/.hidden", ".hidden"),
            ("/cups/a.b.tif", "a.b"),
            ("", ""),
        ] {
            let [first, last] = file_name_span(path);
            let found: String = path.chars().skip(first).take(last - first).collect();
            assert_eq!(found, selected, "{path}");
        }
    }
}
