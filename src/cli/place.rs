//! Where a photograph is: a path, a `file:` URI (RFC 8089), or standard input.

use super::interrupt::Interrupt;
use anyhow::{Result, bail};
use clap::builder::{OsStringValueParser, TypedValueParser};
use dichroscope::photo::{self, ReadError};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// What stands for standard input.
const STANDARD_INPUT: &str = "-";
/// Name of a photograph from standard input, in messages and of its result.
const STANDARD_INPUT_NAME: &str = "stdin";

/// Time between two looks whether the program was asked to end while it waits for a pipe.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// Parser of arguments that name a photograph.
pub(super) fn parser() -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().map(path_of)
}

/// The path that an argument names.
fn path_of(text: OsString) -> PathBuf {
    text.to_str().and_then(path_of_uri).unwrap_or_else(|| text.into())
}

/// The path of a URI of this machine; `None` for other text.
fn path_of_uri(text: &str) -> Option<PathBuf> {
    let rest = text.strip_prefix("file:")?;
    let path = match rest.strip_prefix("//") {
        Some(with_host) => with_host.strip_prefix("localhost").unwrap_or(with_host),
        None => rest,
    };
    let bytes = path.starts_with('/').then(|| decoded(path.as_bytes()))?;
    Some(path_of_bytes(bytes))
}

/// Replaces `%41` by `A`; a percent sign before anything else than two hexadecimal digits stays.
fn decoded(text: &[u8]) -> Vec<u8> {
    let digit = |byte: u8| char::from(byte).to_digit(16).map(|digit| digit as u8);
    let mut bytes = Vec::new();
    let mut rest = text;
    while let Some((&first, after)) = rest.split_first() {
        let code = match after {
            [high, low, ..] if first == b'%' => digit(*high).zip(digit(*low)),
            _ => None,
        };
        bytes.push(code.map_or(first, |(high, low)| 16 * high + low));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    bytes
}

#[cfg(unix)]
fn path_of_bytes(bytes: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt;
    OsString::from_vec(bytes).into()
}

#[cfg(not(unix))]
fn path_of_bytes(bytes: Vec<u8>) -> PathBuf {
    let text = String::from_utf8_lossy(&bytes).into_owned();
    // `file:///C:/a.png` names the path `C:/a.png`.
    let has_drive = text.as_bytes().get(2) == Some(&b':');
    if has_drive { text[1..].into() } else { text.into() }
}

/// Whether a path stands for standard input.
pub(super) fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// Fails where both the mask of `--area` and a photograph are standard input, which can be read only once.
pub(super) fn expect_one_standard_input(area: Option<&Path>, photographs: &[PathBuf]) -> Result<()> {
    if area.is_some_and(is_standard_input) && photographs.iter().any(|path| is_standard_input(path)) {
        bail!("standard input cannot be both the photograph and the mask of --area");
    }
    Ok(())
}

/// The name of a photograph in messages.
pub(super) fn name_of(path: &Path) -> String {
    if is_standard_input(path) { STANDARD_INPUT_NAME.to_owned() } else { path.display().to_string() }
}

/// Name of the result of a photograph: the file's name without extension.
pub(super) fn stem_of(path: &Path) -> Option<PathBuf> {
    if is_standard_input(path) {
        Some(STANDARD_INPUT_NAME.into())
    } else {
        path.file_stem().map(PathBuf::from)
    }
}

/// The bytes of a photograph, read once.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    if is_standard_input(path) {
        photo::read_stream(std::io::stdin().lock(), STANDARD_INPUT_NAME)
    } else {
        photo::read_bytes(path)
    }
}

/// The bytes of a photograph, read once. The wait for another program at the other end of a pipe ends with the signals that end this
/// program: the thread that waits is left behind.
pub(super) fn read_bytes_until(path: &Path, interrupt: &Interrupt) -> Result<Vec<u8>> {
    if !is_standard_input(path) && !path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Ok(read_bytes(path)?);
    }
    let (sender, receiver) = mpsc::channel();
    let waiting = path.to_owned();
    // Nobody receives where the wait was given up.
    thread::spawn(move || drop(sender.send(read_bytes(&waiting))));
    loop {
        match receiver.recv_timeout(BETWEEN_LOOKS) {
            Ok(bytes) => return Ok(bytes?),
            Err(RecvTimeoutError::Timeout) if interrupt.came() => bail!("{}: interrupted", name_of(path)),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => bail!("{}: cannot be read", name_of(path)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_of_files_are_paths() {
        for (text, path) in [
            ("file:///a/b%20c.png", "/a/b c.png"),
            ("file://localhost/%C3%A4.png", "/\u{e4}.png"),
            ("file:/a.png", "/a.png"),
            ("file:///100%.png", "/100%.png"),
            ("file.png", "file.png"),
            ("file:a.png", "file:a.png"),
            ("file://server/a.png", "file://server/a.png"),
            ("./-", "./-"),
        ] {
            assert_eq!(path_of(text.into()), Path::new(path), "{text}");
        }
    }
}
