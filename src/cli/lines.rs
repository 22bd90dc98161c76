//! `results.jsonl`: a JSON object a line for each photograph of a folder, by which a later call knows what is done.

use super::inputs::Job;
use super::one::Finished;
use super::place;
use anyhow::{Context, Result};
use dichroscope::export::write_file;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

/// What became of a photograph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Status {
    Done,
    Failed,
}

/// The line of a photograph.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Line {
    /// Path of the result below the output folder; what is not UTF-8 is replaced.
    pub(super) name: String,
    /// All bytes of the path of the result, percent-encoded (RFC 3986), where the path is not UTF-8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) name_encoded: Option<String>,
    pub(super) status: Status,
    /// The photograph as the call named it; what is not UTF-8 is replaced.
    pub(super) file: String,
    /// All bytes of the photograph's path, percent-encoded (RFC 3986), where the path is not UTF-8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) file_encoded: Option<String>,
    /// SHA-256 of the photograph's bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) sha256: Option<String>,
    /// SHA-256 of everything else that the result depends on: parameters, reading, area, files, version of the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) settings: Option<String>,
    /// What failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) error: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) regions: Option<usize>,
    /// Share of the lit pixels that are in a region.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) lit_share: Option<f64>,
    /// Color of the light, a unit vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) light: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) analysis_ms: Option<f64>,
    /// When the photograph was finished, milliseconds since 1970-01-01 UTC; 0 in lines of earlier versions.
    #[serde(default)]
    pub(super) finished_unix_ms: u64,
}

impl Line {
    pub(super) fn done(job: &Job, settings: &str, finished: &Finished) -> Self {
        let Finished { report, lit_share } = finished;
        Self {
            status: Status::Done,
            sha256: Some(report.image.sha256.clone()),
            settings: Some(settings.to_owned()),
            error: None,
            regions: Some(report.regions.len()),
            lit_share: *lit_share,
            light: report.illuminant.direction,
            warnings: report.warnings.clone(),
            analysis_ms: Some(report.timings_ms.analysis_ms()),
            ..Self::failed(job, "")
        }
    }

    pub(super) fn failed(job: &Job, error: &str) -> Self {
        Self {
            name: job.name.display().to_string(),
            name_encoded: encoded(&job.name),
            status: Status::Failed,
            file: place::name_of(&job.input),
            file_encoded: encoded(&job.input),
            sha256: None,
            settings: None,
            error: Some(error.to_owned()),
            regions: None,
            lit_share: None,
            light: None,
            warnings: Vec::new(),
            analysis_ms: None,
            finished_unix_ms: now_unix_ms(),
        }
    }
}

/// Milliseconds since 1970-01-01 UTC; 0 where the clock of the machine is set to an earlier time.
fn now_unix_ms() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_millis() as u64)
}

/// What tells the results of lines apart: the name and the encoded name.
type Key = (String, Option<String>);

impl Line {
    fn key(&self) -> Key {
        (self.name.clone(), self.name_encoded.clone())
    }
}

/// The bytes of a path that is not UTF-8, of which all but letters, digits and `-._~/` are written as `%FF`; `None` for UTF-8.
fn encoded(path: &Path) -> Option<String> {
    if path.to_str().is_some() {
        return None;
    }
    let mut text = String::new();
    for &byte in path.as_os_str().as_encoded_bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            text.push(char::from(byte));
        } else {
            let digit = |value: u8| char::from(b"0123456789ABCDEF"[usize::from(value)]);
            text.extend(['%', digit(byte >> 4), digit(byte & 15)]);
        }
    }
    Some(text)
}

/// The lines of an output folder.
#[derive(Debug)]
pub(super) struct Lines {
    path: PathBuf,
    /// The file, to which lines are appended; `None` before the first.
    file: Mutex<Option<File>>,
    /// The latest line of each name in all files of lines in the folder, as far as earlier calls wrote them.
    earlier: BTreeMap<Key, Line>,
}

/// What the names of files of lines begin with and end with.
const STEM: &str = "results";
const EXTENSION: &str = "jsonl";

impl Lines {
    /// The lines in the folder `out`; new ones go to the file of `shard` (its number and their count) or to that of all.
    pub(super) fn in_folder(out: &Path, shard: Option<[usize; 2]>) -> Self {
        let name = shard.map_or_else(String::new, |[number, count]| format!(".{number}-of-{count}"));
        let mut earlier: BTreeMap<Key, Line> = BTreeMap::new();
        for line in files_of_lines(out).iter().flat_map(|path| read(path)) {
            let is_later = |known: &Line| line.finished_unix_ms >= known.finished_unix_ms;
            if earlier.get(&line.key()).is_none_or(is_later) {
                earlier.insert(line.key(), line);
            }
        }
        Self { path: out.join(format!("{STEM}{name}.{EXTENSION}")), file: Mutex::new(None), earlier }
    }

    /// The line that an earlier call wrote for a name.
    pub(super) fn earlier(&self, name: &Path) -> Option<&Line> {
        self.earlier.get(&(name.display().to_string(), encoded(name)))
    }

    /// Appends a line, whole.
    pub(super) fn append(&self, line: &Line) -> Result<()> {
        let mut text = serde_json::to_string(line)?;
        text.push('\n');
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let failed = || format!("cannot write {}", self.path.display());
        if file.is_none() {
            if let Some(folder) = self.path.parent() {
                fs::create_dir_all(folder).with_context(failed)?;
            }
            *file = Some(File::options().create(true).append(true).open(&self.path).with_context(failed)?);
        }
        match file.as_mut() {
            Some(file) => file.write_all(text.as_bytes()).with_context(failed),
            None => Ok(()),
        }
    }

    /// Replaces the file by one with the last line of each name, in the order of the names.
    pub(super) fn finish(self) -> Result<()> {
        if !self.path.exists() {
            return Ok(());
        }
        let lines: BTreeMap<Key, Line> =
            read(&self.path).into_iter().map(|line| (line.key(), line)).collect();
        let mut text = String::new();
        for line in lines.values() {
            text.push_str(&serde_json::to_string(line)?);
            text.push('\n');
        }
        // Windows replaces no open file.
        drop(self.file);
        Ok(write_file(&self.path, text.as_bytes())?)
    }
}

/// The files of lines of all shards, and that of all photographs first.
fn files_of_lines(out: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(out).into_iter().flatten().filter_map(Result::ok);
    let is_lines = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(&format!("{STEM}.")) && name.ends_with(EXTENSION)
    };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_lines).collect();
    paths
        .sort_by_key(|path| (path.file_name() != Some(format!("{STEM}.{EXTENSION}").as_ref()), path.clone()));
    paths
}

/// The whole lines of a file. A line that a killed program did not finish is passed over.
fn read(path: &Path) -> Vec<Line> {
    let text = fs::read(path).unwrap_or_default();
    text.split(|&byte| byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(name: &str, error: &str) -> Line {
        Line::failed(&Job { input: format!("{name}.png").into(), name: name.into() }, error)
    }

    #[test]
    fn the_latest_line_of_a_name_counts_in_whatever_file_it_is() {
        let out = tempfile::tempdir().unwrap();
        let earlier = |error: &str, finished_unix_ms| Line { finished_unix_ms, ..failed("a", error) };
        for (shard, line) in [(Some([1, 2]), earlier("shard", 5)), (None, earlier("all", 7))] {
            Lines::in_folder(out.path(), shard).append(&line).unwrap();
        }
        let found = |out: &Path| {
            Lines::in_folder(out, None).earlier(Path::new("a")).and_then(|line| line.error.clone())
        };
        assert_eq!(found(out.path()).as_deref(), Some("all"));
        Lines::in_folder(out.path(), Some([1, 2])).append(&earlier("shard again", 9)).unwrap();
        assert_eq!(found(out.path()).as_deref(), Some("shard again"));
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf_8_are_told_apart() {
        use std::os::unix::ffi::OsStringExt;
        let job = |bytes: &[u8]| {
            let name = PathBuf::from(std::ffi::OsString::from_vec(bytes.to_vec()));
            Job { input: name.with_extension("png"), name }
        };
        let out = tempfile::tempdir().unwrap();
        let lines = Lines::in_folder(out.path(), None);
        let jobs = [job(b"d/a%\xFE"), job(b"d/a%\xFF"), job(b"d/a%25%FF")];
        for (job, error) in jobs.iter().zip(["first", "second", "third"]) {
            lines.append(&Line::failed(job, error)).unwrap();
        }
        lines.finish().unwrap();
        let again = Lines::in_folder(out.path(), None);
        for (job, error) in jobs.iter().zip(["first", "second", "third"]) {
            assert_eq!(again.earlier(&job.name).unwrap().error.as_deref(), Some(error));
        }
        let line = again.earlier(&jobs[1].name).unwrap();
        assert_eq!(line.name, "d/a%\u{fffd}");
        assert_eq!(line.name_encoded.as_deref(), Some("d/a%25%FF"));
        assert_eq!(line.file_encoded.as_deref(), Some("d/a%25%FF.png"));
        assert_eq!(again.earlier(&jobs[2].name).unwrap().name_encoded, None);
    }

    #[test]
    fn the_last_line_of_a_name_counts_and_a_half_line_does_not() {
        let out = tempfile::tempdir().unwrap();
        let lines = Lines::in_folder(out.path(), None);
        lines.append(&failed("b", "no")).unwrap();
        lines.append(&failed("a", "first")).unwrap();
        lines.append(&failed("a", "second")).unwrap();
        let path = out.path().join("results.jsonl");
        File::options().append(true).open(&path).unwrap().write_all(b"{\"name\": \"c\", \"sta").unwrap();
        let again = Lines::in_folder(out.path(), Some([2, 3]));
        assert_eq!(again.earlier(Path::new("a")).unwrap().error.as_deref(), Some("second"));
        assert!(again.earlier(Path::new("c")).is_none());
        again.append(&failed("d", "no")).unwrap();
        assert!(out.path().join("results.2-of-3.jsonl").exists());
        lines.finish().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let names: Vec<&str> = text.lines().map(|line| &line[..11]).collect();
        assert_eq!(names, ["{\"name\":\"a\"", "{\"name\":\"b\""].map(|name| &name[..11]));
        assert!(text.contains("second") && !text.contains("first"));
    }
}
