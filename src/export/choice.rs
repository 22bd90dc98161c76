//! Which files a result folder holds.

use super::pictures::{ARRAYS, PICTURES};
use crate::describe;
use std::collections::BTreeSet;

/// The name that stands for the photograph without highlights, whose extension is that of its format.
pub(super) const MATTE: &str = "matte";

/// A choice among the files of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileChoice(BTreeSet<&'static str>);

/// Error: no file of a result has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` is no file of a result: expected one of {}", FileChoice::names().join(", "))]
pub struct UnknownFile {
    name: String,
}

impl Default for FileChoice {
    /// All files but the arrays.
    fn default() -> Self {
        let names = Self::names().into_iter();
        Self(names.filter(|name| !ARRAYS.iter().any(|(array, _)| array == name)).collect())
    }
}

impl FileChoice {
    /// Names of all files that a result can hold.
    pub fn names() -> Vec<&'static str> {
        let pictures = PICTURES.iter().chain(&ARRAYS).map(|(name, _)| *name);
        pictures.chain([MATTE, describe::FILE_NAME]).collect()
    }

    /// The files with these names.
    ///
    /// # Errors
    /// [`UnknownFile`]: the first name that no file has.
    pub fn of_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<Self, UnknownFile> {
        let known = Self::names();
        let find = |name: &str| {
            let found = known.iter().find(|known| **known == name).copied();
            found.ok_or_else(|| UnknownFile { name: name.to_owned() })
        };
        names.into_iter().map(|name| find(name.trim())).collect::<Result<_, _>>().map(Self)
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
        let message = FileChoice::of_names(["body.tif"]).unwrap_err().to_string();
        assert!(message.starts_with("`body.tif` is no file of a result") && message.contains("noise.npy"));
    }
}
