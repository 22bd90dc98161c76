//! Which photographs to analyze, and what their results are called.

use super::{names, place};
use anyhow::{Result, bail};
use dichroscope::export::is_result_folder;
use dichroscope::photo::Format;
use globset::{GlobBuilder, GlobMatcher};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, WalkDir};

/// A photograph and the path of its result below the output folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Job {
    pub(super) input: PathBuf,
    pub(super) name: PathBuf,
}

/// The photographs of a call.
#[derive(Debug, Default)]
pub(super) struct Jobs {
    /// In the order of the arguments, folders in the order of their names.
    pub(super) list: Vec<Job>,
    /// What could not be looked at, a line each.
    pub(super) troubles: Vec<String>,
    /// Whether a folder was searched.
    pub(super) has_folders: bool,
    /// All inputs of `list`.
    seen: BTreeSet<PathBuf>,
}

impl Jobs {
    /// Adds a photograph; one that is named twice is analyzed once.
    fn add(&mut self, input: &Path, name: PathBuf) {
        if self.seen.insert(input.to_owned()) {
            self.list.push(Job { input: input.to_owned(), name });
        }
    }
}

/// The pattern of `--match`; `*` stays within a folder's name, `**` crosses folders.
pub(super) fn parse_pattern(text: &str) -> Result<GlobMatcher, globset::Error> {
    Ok(GlobBuilder::new(text).literal_separator(true).build()?.compile_matcher())
}

/// The jobs for files and folders as given, folders in the order of their names.
///
/// Hidden files, earlier results and the output folder are passed over. An entry of a folder that cannot be read is a line
/// of trouble. Fails where there is no photograph at all.
pub(super) fn plan(inputs: &[PathBuf], pattern: Option<&GlobMatcher>, out: &Path) -> Result<Jobs> {
    let mut found = Jobs::default();
    for input in inputs {
        if !place::is_standard_input(input) && input.is_dir() {
            found.has_folders = true;
            walk(input, pattern, out, &mut found);
        } else if let Some(stem) = place::stem_of(input) {
            found.add(input, stem);
        } else {
            bail!("{:?} is not the name of a file", input.display().to_string());
        }
    }
    if found.list.is_empty() && found.troubles.is_empty() {
        let folders: Vec<String> = inputs.iter().map(|input| input.display().to_string()).collect();
        let which =
            if pattern.is_some() { "no photograph that --match lets through" } else { "no photograph" };
        bail!("{which} in {}", folders.join(", "));
    }
    let pairs: Vec<(&Path, &Path)> =
        found.list.iter().map(|job| (job.input.as_path(), job.name.as_path())).collect();
    for (name, job) in names::distinct_names(&pairs).into_iter().zip(&mut found.list) {
        job.name = name;
    }
    Ok(found)
}

fn walk(folder: &Path, pattern: Option<&GlobMatcher>, out: &Path, found: &mut Jobs) {
    let out = out.canonicalize().ok();
    let wanted = |entry: &DirEntry| entry.depth() == 0 || !is_passed_over(entry, out.as_deref());
    let matches = |path: &Path| {
        let relative = path.strip_prefix(folder).unwrap_or(path);
        let name = path.file_name().unwrap_or_default();
        pattern.is_none_or(|glob| glob.is_match(name) || glob.is_match(relative))
    };
    for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name().into_iter().filter_entry(wanted)
    {
        let entry = match entry {
            Ok(entry) => entry,
            Err(error) => {
                if !is_dangling(&error) || error.path().is_none_or(matches) {
                    found.troubles.push(trouble(folder, &error));
                }
                continue;
            }
        };
        if entry.file_type().is_file() && Format::known_extension(entry.path()) && matches(entry.path()) {
            let relative = entry.path().strip_prefix(folder).unwrap_or(entry.path());
            found.add(entry.path(), relative.with_extension(""));
        }
    }
}

/// Whether an entry of a folder is a link that leads nowhere or back: no more than one name, which `--match` may leave out.
fn is_dangling(error: &walkdir::Error) -> bool {
    error.loop_ancestor().is_some()
        || error.io_error().is_some_and(|cause| cause.kind() == std::io::ErrorKind::NotFound)
}

/// What is wrong with an entry of a folder, in one line that names the entry.
fn trouble(folder: &Path, error: &walkdir::Error) -> String {
    let path = error.path().unwrap_or(folder).display();
    if error.loop_ancestor().is_some() {
        return format!("{path}: cannot be read: it leads back to a folder that it lies in");
    }
    match error.io_error() {
        Some(cause) => format!("{path}: cannot be read: {cause}"),
        None => format!("{path}: cannot be read"),
    }
}

fn is_passed_over(entry: &DirEntry, out: Option<&Path>) -> bool {
    let hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
    let is_out = || out.is_some() && entry.path().canonicalize().ok().as_deref() == out;
    hidden || (entry.file_type().is_dir() && (is_result_folder(entry.path()) || is_out()))
}

/// Name of the folder that a file lies in.
pub(super) fn parent_name(file: &Path) -> Option<PathBuf> {
    std::path::absolute(file).ok()?.parent()?.file_name().map(PathBuf::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Plans `inputs` in a folder that holds `files`, and hands out the names of the results.
    fn names(files: &[&str], inputs: &[&str], pattern: Option<&str>) -> Result<Vec<String>> {
        let root = tempfile::tempdir().unwrap();
        for file in files {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            let report = r#"{"schema": 1, "program": "0", "image": {}}"#;
            fs::write(&path, if file.ends_with("report.json") { report } else { "" }).unwrap();
        }
        let inputs: Vec<PathBuf> = inputs.iter().map(|input| root.path().join(input)).collect();
        let pattern = pattern.map(|text| parse_pattern(text).unwrap());
        let jobs = plan(&inputs, pattern.as_ref(), &root.path().join("out"))?;
        Ok(jobs.list.iter().map(|job| job.name.display().to_string()).collect())
    }

    #[test]
    fn folders_are_walked_in_order_and_keep_their_relative_paths() {
        let files = ["d/b.png", "d/a.JPG", "d/sub/c.tif", "d/notes.txt", "d/.hidden.png", "d/.h/x.png"];
        assert_eq!(names(&files, &["d"], None).unwrap(), ["a", "b", "sub/c"]);
    }

    #[test]
    fn patterns_see_the_name_or_the_relative_path() {
        let files = ["d/s/camera8.png", "d/s/labels.png", "d/t/camera8.png", "d/camera8.png"];
        assert_eq!(
            names(&files, &["d"], Some("camera8.png")).unwrap(),
            ["camera8", "s/camera8", "t/camera8"]
        );
        assert_eq!(names(&files, &["d"], Some("s/*.png")).unwrap(), ["s/camera8", "s/labels"]);
        let error = names(&files, &["d"], Some("*.exr")).unwrap_err().to_string();
        assert!(error.starts_with("no photograph that --match lets through in "), "{error}");
    }

    #[test]
    fn results_and_the_output_folder_are_not_photographs() {
        let files = ["d/a.png", "d/old/report.json", "d/old/body.png", "out/x/body.png"];
        assert_eq!(names(&files, &["d"], None).unwrap(), ["a"]);
        assert_eq!(names(&files, &[""], None).unwrap(), ["d/a"]);
    }

    #[test]
    fn colliding_names_take_what_tells_them_apart() {
        let files = ["p/x.png", "q/x.png", "q/y.png"];
        assert_eq!(names(&files, &files, None).unwrap(), ["p/x", "q/x", "y"]);
        let files = ["p/x.png", "p/x.jpg"];
        assert_eq!(names(&files, &files, None).unwrap(), ["x.png", "x.jpg"]);
        assert_eq!(names(&["d/a.png", "d/a/b.png"], &["d"], None).unwrap(), ["a/b", "a.png"]);
        assert_eq!(names(&["a/1.png", "b/1.png"], &["a", "b"], None).unwrap(), ["a/1", "b/1"]);
        assert_eq!(names(&["a/1.png"], &["a/1.png", "a/1.png"], None).unwrap(), ["1"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_bad_entry_is_a_line_and_the_others_are_found() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("a.png"), "").unwrap();
        std::os::unix::fs::symlink(root.path().join("gone.png"), root.path().join("b.png")).unwrap();
        std::os::unix::fs::symlink(root.path(), root.path().join("loop")).unwrap();
        let found = plan(&[root.path().to_owned()], None, &root.path().join("out")).unwrap();
        assert_eq!(found.list.len(), 1);
        assert_eq!(found.troubles.len(), 2, "{:?}", found.troubles);
        assert!(found.troubles[0].contains("b.png: cannot be read"), "{:?}", found.troubles);
        assert!(found.troubles[1].contains("loop: cannot be read: it leads back"), "{:?}", found.troubles);
        let pattern = parse_pattern("a*").unwrap();
        let found = plan(&[root.path().to_owned()], Some(&pattern), &root.path().join("out")).unwrap();
        assert_eq!(
            (found.list.len(), found.troubles.len()),
            (1, 0),
            "links that the pattern leaves out are no troubles"
        );
    }
}
