//! Which photographs to analyze, and what their results are called.

use anyhow::{Context, Result, bail};
use dichroscope::export::is_result_folder;
use dichroscope::photo::Format;
use globset::{GlobBuilder, GlobMatcher};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, WalkDir};

/// A photograph and the path of its result below the output folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Job {
    pub(super) input: PathBuf,
    pub(super) name: PathBuf,
}

/// The pattern of `--match`; `*` stays within a folder's name, `**` crosses folders.
pub(super) fn parse_pattern(text: &str) -> Result<GlobMatcher, globset::Error> {
    Ok(GlobBuilder::new(text).literal_separator(true).build()?.compile_matcher())
}

/// The jobs for files and folders as given, folders in the order of their names.
///
/// Hidden files, earlier results and the output folder are passed over. Fails where a folder cannot be read, where there
/// is no photograph, and where two results would have the same folder.
pub(super) fn plan(inputs: &[PathBuf], pattern: Option<&GlobMatcher>, out: &Path) -> Result<Vec<Job>> {
    let mut jobs = Vec::new();
    for input in inputs {
        if input.is_dir() {
            jobs.extend(walk(input, pattern, out)?);
        } else if let Some(stem) = input.file_stem() {
            jobs.push(Job { input: input.clone(), name: stem.into() });
        } else {
            bail!("{} is not the name of a file", input.display());
        }
    }
    if jobs.is_empty() {
        let folders: Vec<String> = inputs.iter().map(|input| input.display().to_string()).collect();
        let which =
            if pattern.is_some() { "no photograph that --match lets through" } else { "no photograph" };
        bail!("{which} in {}", folders.join(", "));
    }
    name_apart(&mut jobs);
    expect_apart(&jobs, out)?;
    Ok(jobs)
}

fn walk(folder: &Path, pattern: Option<&GlobMatcher>, out: &Path) -> Result<Vec<Job>> {
    let out = out.canonicalize().ok();
    let wanted = |entry: &DirEntry| entry.depth() == 0 || !is_passed_over(entry, out.as_deref());
    let mut jobs = Vec::new();
    for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name().into_iter().filter_entry(wanted)
    {
        let entry = entry.with_context(|| format!("cannot walk {}", folder.display()))?;
        let relative = entry.path().strip_prefix(folder).unwrap_or(entry.path());
        let matches = pattern.is_none_or(|glob| glob.is_match(entry.file_name()) || glob.is_match(relative));
        if entry.file_type().is_file() && Format::known_extension(entry.path()) && matches {
            jobs.push(Job { input: entry.path().to_owned(), name: relative.with_extension("") });
        }
    }
    Ok(jobs)
}

fn is_passed_over(entry: &DirEntry, out: Option<&Path>) -> bool {
    let hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
    let is_out = || out.is_some() && entry.path().canonicalize().ok().as_deref() == out;
    hidden || (entry.file_type().is_dir() && (is_result_folder(entry.path()) || is_out()))
}

/// Replaces names that occur more than once by the names of the photographs' folders.
fn name_apart(jobs: &mut [Job]) {
    let mut uses = BTreeMap::new();
    for job in jobs.iter() {
        *uses.entry(job.name.clone()).or_insert(0) += 1;
    }
    for job in jobs.iter_mut().filter(|job| uses[&job.name] > 1) {
        if let Some(parent) = parent_name(&job.input) {
            job.name = parent;
        }
    }
}

/// Name of the folder that a file lies in.
pub(super) fn parent_name(file: &Path) -> Option<PathBuf> {
    std::path::absolute(file).ok()?.parent()?.file_name().map(PathBuf::from)
}

/// Fails where two results would have the same folder, or one result would lie inside another.
fn expect_apart(jobs: &[Job], out: &Path) -> Result<()> {
    let mut sorted: Vec<&Job> = jobs.iter().collect();
    sorted.sort_by(|a, b| a.name.cmp(&b.name));
    for pair in sorted.windows(2) {
        let [a, b] = pair else { continue };
        let (first, second) = (a.input.display(), b.input.display());
        if a.name == b.name {
            bail!("{first} and {second} would both be written to {}", out.join(&a.name).display());
        }
        if b.name.starts_with(&a.name) {
            let (outer, inner) = (out.join(&a.name), out.join(&b.name));
            bail!("{first} and {second}: {} would lie inside {}", inner.display(), outer.display());
        }
    }
    Ok(())
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
        Ok(jobs.iter().map(|job| job.name.display().to_string()).collect())
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
    fn colliding_stems_take_their_folders_names() {
        let files = ["p/x.png", "q/x.png", "q/y.png"];
        assert_eq!(names(&files, &["p/x.png", "q/x.png", "q/y.png"], None).unwrap(), ["p", "q", "y"]);
    }

    #[test]
    fn what_stays_ambiguous_is_refused() {
        let error = names(&["p/x.png", "p/x.jpg"], &["p/x.png", "p/x.jpg"], None).unwrap_err().to_string();
        assert!(error.contains("would both be written to"), "{error}");
        let error = names(&["d/a.png", "d/a/b.png"], &["d"], None).unwrap_err().to_string();
        assert!(error.contains("would lie inside"), "{error}");
    }
}
