//! Chooses the main picture of a TIFF: neither a preview, nor a mask, nor the mosaic of a camera's sensor.

use super::photometric;
use crate::photo::decode::ifd::{Directory, IfdFile};
use crate::photo::error::Fault;
use std::collections::BTreeSet;

/// The directory of the main picture.
pub(super) struct Chosen<'a> {
    pub directory: Directory<'a>,
    /// The directories of green and blue, where the main picture is red.
    pub planes: Vec<Directory<'a>>,
    pub warnings: Vec<String>,
}

/// Number of directories that are looked at.
const MOST_DIRECTORIES: usize = 4096;
const SUB_DIRECTORIES: u16 = 330;
const DNG_VERSION: u16 = 50706;

/// Flags of tag 254.
const REDUCED: u64 = 1;
const MASK: u64 = 4;

pub(super) fn main_picture<'a>(file: &IfdFile<'a>) -> Result<Chosen<'a>, Fault> {
    if file.bytes.get(8..10) == Some(b"CR") {
        return Err(raw());
    }
    let chain = chain(file)?;
    let mut below = Vec::new();
    for directory in &chain {
        for at in directory.integers(SUB_DIRECTORIES).into_iter().take(MOST_DIRECTORIES) {
            below.extend(file.directory(at));
        }
    }
    if chain.iter().chain(&below).any(is_raw) {
        return Err(raw());
    }
    let full = |directory: &&Directory| role(directory) & (REDUCED | MASK) == 0;
    let pictures: Vec<&Directory> = chain.iter().filter(full).collect();
    let mut warnings = Vec::new();
    let directory = match (pictures.first(), below.iter().find(full)) {
        (Some(first), _) => {
            if role(&chain[0]) & (REDUCED | MASK) != 0 {
                warnings.push("the TIFF begins with a preview: its main picture is read".to_owned());
            }
            (*first).clone()
        }
        (None, Some(below)) => {
            warnings.push("the TIFF begins with a preview: its main picture is read".to_owned());
            below.clone()
        }
        (None, None) => {
            warnings
                .push("the TIFF calls its picture a preview or a mask: it is read nevertheless".to_owned());
            chain[0].clone()
        }
    };
    let described = ImagejDescription::of(&directory);
    if let Some(planes) = composite(&described, &pictures) {
        warnings.push("the TIFF holds three channels of ImageJ: read as red, green and blue".to_owned());
        return Ok(Chosen { directory, planes, warnings });
    }
    if pictures.len() > 1 || described.images > 1 {
        let several = pictures.len().max(described.images);
        warnings.push(format!("the TIFF holds several pictures ({several}): only the first is read"));
    }
    Ok(Chosen { directory, planes: Vec::new(), warnings })
}

/// The directories of a file, each of which names the next.
fn chain<'a>(file: &IfdFile<'a>) -> Result<Vec<Directory<'a>>, Fault> {
    let mut at = file.first()?;
    let mut chain = vec![file.directory(at)?];
    let mut seen = BTreeSet::from([at]);
    while chain.len() < MOST_DIRECTORIES {
        at = chain[chain.len() - 1].next.ok_or_else(|| Fault::damaged("its directory is cut short"))?;
        if at == 0 || !seen.insert(at) {
            break;
        }
        // The pictures before a broken directory can still be read.
        match file.directory(at) {
            Ok(directory) => chain.push(directory),
            Err(_) => break,
        }
    }
    Ok(chain)
}

/// What tag 254, or else its predecessor 255, says about a picture.
fn role(directory: &Directory) -> u64 {
    let of_predecessor = || if directory.integer(255) == Some(2) { REDUCED } else { 0 };
    let is_mask = directory.integer(262) == Some(photometric::MASK);
    directory.integer(254).unwrap_or_else(of_predecessor) | if is_mask { MASK } else { 0 }
}

fn is_raw(directory: &Directory) -> bool {
    let interpretation = directory.integer(262);
    directory.has(DNG_VERSION)
        || matches!(interpretation, Some(photometric::MOSAIC | photometric::LINEAR_RAW))
}

fn raw() -> Fault {
    let hint = "develop it, without sharpening, to a linear TIFF of 16 bits";
    Fault::unsupported("a camera's raw data, whose previews are not the photograph", hint)
}

/// What ImageJ writes in the description (tag 270), a `name=value` a line.
#[derive(Default)]
struct ImagejDescription {
    images: usize,
    channels: usize,
    is_composite: bool,
}

impl ImagejDescription {
    fn of(directory: &Directory) -> Self {
        let text = String::from_utf8_lossy(directory.bytes(270).unwrap_or_default()).into_owned();
        if !text.starts_with("ImageJ=") {
            return Self::default();
        }
        let value = |name: &str| text.lines().find_map(|line| line.trim().strip_prefix(name));
        let number = |name| value(name).and_then(|text| text.parse().ok()).unwrap_or(0);
        Self {
            images: number("images="),
            channels: number("channels="),
            is_composite: value("mode=") == Some("composite"),
        }
    }
}

/// The directories of green and blue, where the pages are the three channels of one composite picture.
fn composite<'a>(described: &ImagejDescription, pictures: &[&Directory<'a>]) -> Option<Vec<Directory<'a>>> {
    let ImagejDescription { images: 3, channels: 3, is_composite: true } = described else { return None };
    let [_, green, blue] = pictures else { return None };
    Some(vec![(*green).clone(), (*blue).clone()])
}
