//! Names of results: the shortest paths that tell the photographs apart.

use super::place;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};

/// A photograph and how much of its path is its name.
#[derive(Debug)]
struct Named {
    /// The folders that the photograph lies in, from the root, and the file's name without extension.
    parts: Vec<OsString>,
    /// The file's whole name.
    file: OsString,
    /// Number of the last parts that are the name.
    taken: usize,
    /// Whether the name ends with the file's extension.
    keeps_extension: bool,
    /// Number that tells equal paths apart; 0 for none.
    number: usize,
}

impl Named {
    /// A photograph whose name so far is `name`.
    fn new(input: &Path, name: &Path) -> Self {
        let taken = name.iter().count();
        let file = input.file_name().unwrap_or(input.as_os_str()).to_owned();
        // The name is the end of the photograph's path, below the folder that was searched.
        let searched = input.ancestors().nth(taken).filter(|_| !place::is_standard_input(input));
        let mut parts = searched.map(folders).unwrap_or_default();
        parts.extend(name.iter().map(OsString::from));
        Self { taken, parts, file, keeps_extension: false, number: 0 }
    }

    fn name(&self) -> PathBuf {
        let mut name: PathBuf = self.parts[self.parts.len() - self.taken..].iter().collect();
        if self.keeps_extension {
            name.set_file_name(&self.file);
        }
        if self.number > 0 {
            let mut last = name.file_name().unwrap_or_default().to_owned();
            last.push(format!("-{}", self.number));
            name.set_file_name(last);
        }
        name
    }

    fn can_grow(&self) -> bool {
        self.taken < self.parts.len()
    }

    fn folder(&self) -> &[OsString] {
        &self.parts[..self.parts.len() - 1]
    }
}

/// Names of the folders from the root to `folder`, links followed.
fn folders(folder: &Path) -> Vec<OsString> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let whole = folder.canonicalize().or_else(|_| std::path::absolute(folder)).unwrap_or_default();
    let normal = whole.components().filter_map(|component| match component {
        Component::Normal(name) => Some(name.to_owned()),
        _ => None,
    });
    normal.collect()
}

/// Names of the results of photographs, each with an initial name, such that no two are equal and none lies inside
/// another.
///
/// Equal names grow by the photographs' folders; photographs of one folder keep their extensions; what still is equal gets
/// numbers. A name that another one would lie inside keeps its extension too.
pub(super) fn distinct_names(photographs: &[(&Path, &Path)]) -> Vec<PathBuf> {
    let mut named: Vec<Named> = photographs.iter().map(|(input, name)| Named::new(input, name)).collect();
    while lengthen_equal_names(&mut named) || add_extensions_to_parents(&mut named) {}
    number(&mut named);
    named.iter().map(Named::name).collect()
}

/// Lengthens equal names by one folder, or by their extensions in one folder; false where all names differ or no name
/// can be longer.
fn lengthen_equal_names(named: &mut [Named]) -> bool {
    let mut groups: BTreeMap<PathBuf, Vec<usize>> = BTreeMap::new();
    for (index, photograph) in named.iter().enumerate() {
        groups.entry(photograph.name()).or_default().push(index);
    }
    let mut has_grown = false;
    for group in groups.into_values().filter(|group| group.len() > 1) {
        let first = named[group[0]].folder().to_vec();
        let in_one_folder = group.iter().all(|&index| named[index].folder() == first);
        for index in group {
            let photograph = &mut named[index];
            if in_one_folder && !photograph.keeps_extension {
                photograph.keeps_extension = true;
                has_grown = true;
            } else if !in_one_folder && photograph.can_grow() {
                photograph.taken += 1;
                has_grown = true;
            }
        }
    }
    has_grown
}

/// Adds the extension to each name that is a parent folder of another name; false where no name changed.
fn add_extensions_to_parents(named: &mut [Named]) -> bool {
    let mut folders = BTreeSet::new();
    for photograph in named.iter() {
        folders.extend(photograph.name().ancestors().skip(1).map(Path::to_owned));
    }
    let mut has_left = false;
    for photograph in named {
        if !photograph.keeps_extension && folders.contains(&photograph.name()) {
            photograph.keeps_extension = true;
            has_left = true;
        }
    }
    has_left
}

/// Numbers the names that are still equal or still lie inside one another.
fn number(named: &mut [Named]) {
    let mut used: BTreeSet<PathBuf> = BTreeSet::new();
    // The next number of each name, so that many equal names are not tried again and again.
    let mut next_numbers: BTreeMap<PathBuf, usize> = BTreeMap::new();
    let all: BTreeSet<PathBuf> = named
        .iter()
        .flat_map(|photograph| photograph.name().ancestors().skip(1).map(Path::to_owned).collect::<Vec<_>>())
        .collect();
    for photograph in named {
        let is_taken = |name: &PathBuf| used.contains(name) || all.contains(name);
        let unnumbered = photograph.name();
        while is_taken(&photograph.name()) {
            let next = next_numbers.entry(unnumbered.clone()).or_insert(2);
            photograph.number = *next;
            *next += 1;
        }
        used.insert(photograph.name());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(photographs: &[(&str, &str)]) -> Vec<String> {
        let paths: Vec<_> =
            photographs.iter().map(|(input, name)| (Path::new(input), Path::new(name))).collect();
        distinct_names(&paths).iter().map(|name| name.display().to_string()).collect()
    }

    #[test]
    fn equal_names_grow_by_their_folders() {
        let cards =
            [("/c/s1/IMG_1.jpg", "IMG_1"), ("/c/s2/IMG_1.jpg", "IMG_1"), ("/c/s2/IMG_2.jpg", "IMG_2")];
        assert_eq!(names(&cards), ["s1/IMG_1", "s2/IMG_1", "IMG_2"]);
        let deep = [("/a/x/1.png", "1"), ("/b/x/1.png", "1")];
        assert_eq!(names(&deep), ["a/x/1", "b/x/1"]);
    }

    #[test]
    fn files_of_one_folder_keep_their_extensions() {
        let both = [("/r/x.png", "x"), ("/r/x.jpg", "x"), ("/q/x.png", "x")];
        assert_eq!(names(&both), ["r/x.png", "r/x.jpg", "q/x"]);
        assert_eq!(names(&[("/d/a.png", "a"), ("/d/a/b.png", "a/b")]), ["a.png", "a/b"]);
    }

    #[test]
    fn the_same_file_twice_is_numbered_and_names_never_leave_the_folder() {
        assert_eq!(names(&[("/r/x.png", "x"), ("/r/x.png", "x")]), ["x.png", "x.png-2"]);
        assert_eq!(names(&[("-", "stdin"), ("/r/stdin.png", "stdin")]), ["stdin", "r/stdin"]);
        assert_eq!(names(&[("/x.png", "x"), ("/r/x.png", "x")]), ["x", "r/x"]);
    }
}
