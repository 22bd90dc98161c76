//! Which files a result folder holds.

use super::matte_format::MatteFormat;
use super::pictures::{ARRAYS, PICTURES};
use crate::describe;
use std::collections::BTreeSet;
use std::error::Error;
use std::fmt;
use std::path::Path;

/// The name that stands for the photograph without highlights, whose extension is that of its format.
pub(super) const MATTE: &str = "matte";

/// A choice among the files of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileChoice(BTreeSet<&'static str>);

/// Error: no file of a result has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownFile {
    name: String,
}

impl fmt::Display for UnknownFile {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "`{}` is no file of a result: expected ", self.name)?;
        let beside = FileChoice::names_of_stem(stem(&self.name));
        if beside.is_empty() {
            let stems: BTreeSet<&str> = FileChoice::names().into_iter().map(stem).collect();
            let stems: Vec<&str> = stems.into_iter().collect();
            write!(f, "{}, alone or with an extension, as in body.exr", stems.join(", "))
        } else {
            f.write_str(&beside.join(", "))
        }
    }
}

impl Error for UnknownFile {}

impl Default for FileChoice {
    /// All files but the arrays.
    fn default() -> Self {
        let names = Self::names().into_iter();
        Self(names.filter(|name| !is_array(name)).collect())
    }
}

impl FileChoice {
    /// Names of all files that a result can hold.
    pub fn names() -> Vec<&'static str> {
        let pictures = PICTURES.iter().chain(&ARRAYS).map(|(name, _)| *name);
        pictures.chain([MATTE, describe::FILE_NAME]).collect()
    }

    /// The files with these names. A name without extension stands for all files of that name but the arrays, and `matte.png`,
    /// `matte.jpg` and `matte.tif` for the photograph without highlights in whatever format it will have.
    ///
    /// # Errors
    /// [`UnknownFile`]: the first name that no file has.
    pub fn of_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<Self, UnknownFile> {
        let mut chosen = BTreeSet::new();
        for name in names.into_iter().map(str::trim) {
            let files = Self::files_of(name);
            if files.is_empty() {
                return Err(UnknownFile { name: name.to_owned() });
            }
            chosen.extend(files);
        }
        Ok(Self(chosen))
    }

    /// The files that a name stands for.
    fn files_of(name: &str) -> Vec<&'static str> {
        if is_matte(name) {
            return vec![MATTE];
        }
        match Self::names().into_iter().find(|known| *known == name) {
            Some(known) => vec![known],
            None if name.contains('.') => Vec::new(),
            None => Self::names_of_stem(name).into_iter().filter(|known| !is_array(known)).collect(),
        }
    }

    /// The files that are called `wanted` but for their extensions.
    fn names_of_stem(wanted: &str) -> Vec<&'static str> {
        Self::names().into_iter().filter(|known| stem(known) == wanted).collect()
    }

    /// The choice with all arrays.
    #[must_use]
    pub fn with_arrays(mut self) -> Self {
        self.0.extend(ARRAYS.iter().map(|(name, _)| *name));
        self
    }

    /// Whether the file called `name` is chosen.
    pub fn has(&self, name: &str) -> bool {
        self.0.contains(name)
    }

    /// Whether all chosen files are in a folder.
    pub fn is_in(&self, folder: &Path) -> bool {
        self.iter().all(|name| match name {
            MATTE => MatteFormat::ALL
                .iter()
                .any(|format| folder.join(MATTE).with_extension(format.extension()).is_file()),
            name => folder.join(name).is_file(),
        })
    }

    /// Number of chosen files.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether no file is chosen.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The chosen names in alphabetical order.
    pub fn iter(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().copied()
    }
}

/// Whether a file of this name can be in a result folder.
pub(super) fn is_result_file(name: &str) -> bool {
    is_matte(name) || name != MATTE && FileChoice::names().contains(&name)
}

/// Whether a name is that of the photograph without highlights.
pub(super) fn is_matte(name: &str) -> bool {
    name.strip_prefix(MATTE)
        .and_then(|rest| rest.strip_prefix('.'))
        .is_some_and(|extension| MatteFormat::ALL.iter().any(|format| format.extension() == extension))
}

fn is_array(name: &str) -> bool {
    ARRAYS.iter().any(|(array, _)| *array == name)
}

/// A name without its extension.
fn stem(name: &str) -> &str {
    name.split_once('.').map_or(name, |(stem, _)| stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_chosen_by_their_names() {
        let usual = FileChoice::default();
        assert!(usual.has("body.exr") && usual.has("matte") && !usual.has("body.npy"));
        assert!(usual.with_arrays().has("body.npy"));
        let few = FileChoice::of_names("body.exr, matte,report.json".split(',')).unwrap();
        assert_eq!(few.len(), 3);
    }

    #[test]
    fn a_name_without_extension_stands_for_its_usual_files() {
        let of = |text: &str| FileChoice::of_names(text.split(',')).unwrap().iter().collect::<Vec<_>>();
        assert_eq!(of("body"), ["body.exr", "body.png"]);
        assert_eq!(of("residual,regions,body.npy"), ["body.npy", "regions.png", "residual.exr"]);
        assert_eq!(of("matte.png,matte.jpg,report"), ["matte", "report.json"]);
        let all: Vec<&str> = FileChoice::names().into_iter().map(stem).collect();
        assert_eq!(FileChoice::of_names(all).unwrap(), FileChoice::default());
    }

    #[test]
    fn an_unknown_name_is_answered_with_what_comes_nearest() {
        let answer = |name: &str| FileChoice::of_names(["matte", name]).unwrap_err().to_string();
        assert_eq!(
            answer("body.tif"),
            "`body.tif` is no file of a result: expected body.exr, body.png, body.npy"
        );
        assert_eq!(answer("matte.gif"), "`matte.gif` is no file of a result: expected matte");
        let message = answer("specular.png");
        assert!(message.starts_with("`specular.png` is no file of a result: expected body, confidence, "));
        assert_eq!(message.matches("noise").count(), 1, "{message}");
    }
}
