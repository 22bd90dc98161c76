//! Reads photographs, parameters and workspaces for the state.

use super::files_to_open::with_unopened;
use super::report::Report;
use super::{FilesToOpen, Workspace};
use crate::params::{Params, toml_error};
use crate::photo::{self, ReadError, ReadOptions};
use crate::truth::sample::{CAMERA_FILE, Sample};
use crate::truth::{ForeignResult, GroundTruth, read_label_map};
use crate::view::{Elsewhere, ElsewhereKind, ElsewherePaths, Histogram, Origin, Picture};
use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// How the warning of a photograph begins whose ground truth cannot be used.
pub(super) const TRUTH_UNUSED: &str = "the ground truth beside the photograph is not used";

/// Reads the photograph at `origin`, with its ground truth where a sample or the file's folder holds one.
///
/// # Errors
/// A sentence that names the file.
pub(super) fn picture(origin: Origin, options: ReadOptions) -> Result<Picture, String> {
    let began_at = Instant::now();
    let origin = with_absolute_path(origin);
    let (photo, sha256) = match &origin {
        Origin::File(path) if path.is_dir() => {
            return Err(format!("{}: this is a folder; Ctrl+O opens the photographs in it", path.display()));
        }
        Origin::File(path) if !path.exists() => {
            return Err(format!(
                "{}: there is no such file; look for it with Ctrl+O, or check its name",
                path.display()
            ));
        }
        Origin::File(path) => {
            let bytes = photo::read_bytes(path).map_err(|error| with_source(&error))?;
            let name = path.display().to_string();
            (photo::decode(&bytes, &name, &options), photo::sha256_hex(&bytes))
        }
        Origin::Sample(name) => {
            let Some(sample) = Sample::find(name) else {
                return Err(format!("{name}: there is no such sample scene"));
            };
            (photo::decode(sample.camera, CAMERA_FILE, &options), photo::sha256_hex(sample.camera))
        }
        Origin::Bytes { name, bytes } => (photo::decode(bytes, name, &options), photo::sha256_hex(bytes)),
    };
    let mut photo = photo.map_err(|error| reason(&error))?;
    let read_ms = began_at.elapsed().as_secs_f64() * 1e3;
    let truth = truth(&origin).unwrap_or_else(|reason| {
        photo.warnings.push(reason);
        None
    });
    let histogram = Histogram::of(&photo.image);
    Ok(Picture { origin, reading: options, photo, sha256, read_ms, histogram, truth })
}

/// Why a photograph cannot be read, and what to do in the window, which has no flags.
fn reason(error: &ReadError) -> String {
    let ReadError::TooLarge { file, width, height, limit_megapixels, .. } = error else {
        return error.to_string();
    };
    format!(
        "{file}: the file declares {width} \u{d7} {height} pixels, and the window opens up to {limit_megapixels} megapixels; \
         open a smaller copy, or use `dichroscope analyze --max-megapixels`"
    )
}

/// Reads photographs that are opened together. One that cannot be read does not keep the others from being opened.
pub(super) fn photographs(files: FilesToOpen) -> Report {
    let FilesToOpen { photographs, shows_first, elsewhere, workspace } = files;
    let read = |origin| picture(origin, ReadOptions::default()).map(Arc::new);
    let mut photographs: Vec<Result<Arc<Picture>, String>> = photographs.into_iter().map(read).collect();
    if let Some(first) = photographs.iter().position(Result::is_ok).filter(|_| shows_first) {
        photographs.rotate_left(first + 1);
    }
    Report::OpenedTogether { photographs, elsewhere, workspace }
}

/// The origin with an absolute path, so that the list of recent photographs is valid in every working directory and names each
/// file once.
fn with_absolute_path(origin: Origin) -> Origin {
    match origin {
        Origin::File(path) => Origin::File(super::workspace::absolute_path(&path)),
        other => other,
    }
}

/// The ground truth in the folder of the photograph, or that of a sample scene; none where there is no ground truth.
///
/// # Errors
/// A sentence that says why the ground truth cannot be used.
fn truth(origin: &Origin) -> Result<Option<GroundTruth>, String> {
    let read = match origin {
        Origin::Sample(name) => Sample::find(name).map(Sample::truth),
        Origin::File(path) => {
            path.parent().filter(|folder| folder.join("truth.json").is_file()).map(GroundTruth::read)
        }
        Origin::Bytes { .. } => None,
    };
    read.transpose().map_err(|error| format!("{TRUTH_UNUSED}: {}", with_source(&error)))
}

/// Reads a picture that another program made of a photograph: a diffuse picture with the options of the photograph. The report is of the
/// picture, for the image view to show where `shows`, or of a sentence that says what is wrong with the file and what to do.
pub(super) fn elsewhere(kind: ElsewhereKind, path: &Path, picture: Arc<Picture>, shows: bool) -> Report {
    let path = super::workspace::absolute_path(path);
    match foreign(kind, &path, &picture) {
        Ok(pictures) => {
            let paths = ElsewherePaths::default().with(kind, path);
            let read = Box::new(Elsewhere { paths, pictures });
            Report::ElsewhereRead { kind, read, picture, shows }
        }
        Err(reason) => Report::ElsewhereFailed { kind, path, picture, reason },
    }
}

fn foreign(kind: ElsewhereKind, path: &Path, picture: &Picture) -> Result<ForeignResult, String> {
    let file = path.display();
    if !path.is_file() {
        return Err(format!(
            "{file}: the {} of another program is not there; put it back, or open it from where it is now",
            kind.name()
        ));
    }
    let (pictures, size) = match kind {
        ElsewhereKind::Labels => {
            let labels = read_label_map(path).map_err(|error| with_source(&error))?;
            let size = (labels.width(), labels.height());
            (ForeignResult { labels: Some(labels), diffuse: None }, size)
        }
        ElsewhereKind::Diffuse => {
            let photo = photo::read(path, &picture.reading).map_err(|error| with_source(&error))?;
            let size = (photo.image.width(), photo.image.height());
            (ForeignResult { labels: None, diffuse: Some(Arc::unwrap_or_clone(photo.image).pixels) }, size)
        }
    };
    let (width, height) = picture.size();
    if size != (width, height) {
        let scaled = match kind {
            ElsewhereKind::Labels => "scale it to the size of the photograph without smoothing",
            ElsewhereKind::Diffuse => "scale it to the size of the photograph",
        };
        return Err(format!(
            "{file}: the {} is {}\u{d7}{} pixels and the photograph {} is {width}\u{d7}{height}: choose the one of this photograph, or {scaled}",
            kind.name(),
            size.0,
            size.1,
            picture.origin.name(),
        ));
    }
    let checked = pictures.check(width, height).map_err(|error| format!("{file}: {error}; write it again"));
    checked.map(|()| pictures)
}

/// An error with its cause, as one sentence.
fn with_source(error: &dyn Error) -> String {
    error.source().map_or_else(|| error.to_string(), |source| format!("{error}: {source}"))
}

/// Reads parameters from a TOML file.
pub(super) fn params(path: &Path) -> Report {
    let read = || -> Result<Params, String> {
        let text = std::fs::read_to_string(path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let name = path.display().to_string();
        let params: Params = toml::from_str(&text).map_err(|error| toml_error(&name, &text, &error))?;
        params.validate().map_err(|error| format!("{name}: {error}"))?;
        Ok(params)
    };
    match read() {
        Ok(params) => Report::ParamsRead(Box::new(params)),
        Err(reason) => Report::Failed(reason),
    }
}

/// Reads a workspace file. The files of `elsewhere` take the place of those that the workspace names.
pub(super) fn workspace(path: &Path, elsewhere: ElsewherePaths) -> Report {
    match Workspace::load(path) {
        Ok(mut workspace) => {
            workspace.elsewhere = elsewhere.or(workspace.elsewhere);
            Report::WorkspaceRead { workspace: Box::new(workspace), path: path.to_owned() }
        }
        Err(reason) => Report::Failed(with_unopened(reason, &elsewhere)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_photograph_that_is_too_large_is_answered_with_what_can_be_done_in_the_window() {
        let tiny = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");
        let options = ReadOptions { max_megapixels: 0.01, ..ReadOptions::default() };
        let error = picture(Origin::File(tiny.into()), options).unwrap_err();
        assert!(error.contains("178 \u{d7} 150 pixels") && error.contains("open a smaller copy"), "{error}");
    }
    #[test]
    fn a_folder_and_a_missing_file_are_answered_with_what_to_do() {
        let root = tempfile::tempdir().unwrap();
        let open = |path: &Path| picture(Origin::File(path.to_owned()), ReadOptions::default()).unwrap_err();
        assert!(open(root.path()).ends_with("this is a folder; Ctrl+O opens the photographs in it"));
        assert!(open(&root.path().join("none.png")).contains("there is no such file"));
    }
}
