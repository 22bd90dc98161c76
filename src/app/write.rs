//! The writers of the exports: a function for each kind, which makes the bytes of a file or writes a folder.

use super::export_input::{DrawnPicture, ExportInput, ExportOptions};
use super::jobs::Stop;
use crate::analysis::Stage;
use crate::describe::{AreaFacts, Report, Timings};
use crate::export::{ExportError, WholeResult, matte_bytes, png_of_rgba};
use crate::figures::{self, Scene};
use crate::truth::{self, Reference, ReportInput};
use crate::view::marking::mask_of;
use crate::view::{
    Against, Item, Picture, ResultSnapshot, Separator, layer_floats, paint_against, profile, profile_csv,
    regions_text, selected,
};
use std::error::Error;
use std::path::{Path, PathBuf};

/// The name that an area has in reports and in calls of `analyze`.
pub(super) const AREA_FILE: &str = "area.png";

/// The sentence for an export that was stopped.
pub(super) fn stopped(path: &Path) -> String {
    format!("stopped: {} was not written", path.display())
}

/// An error with its causes, in one line.
pub(super) fn error_chain(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}

/// The contents of a file.
pub(super) struct Contents {
    /// The file, with the extension that fits the contents.
    pub path: PathBuf,
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The contents of the file, for the notice.
    pub what: String,
}

/// A file at `path`.
fn file(path: &Path, bytes: Vec<u8>, what: &str) -> Contents {
    Contents { path: path.to_owned(), bytes, what: what.to_owned() }
}

/// The area that the analysis is restricted to, as a mask.
pub(super) fn area(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let area = input.document.area.as_ref();
    let area = area.ok_or("no area to export: the analysis is not restricted to one")?;
    Ok(file(path, selected::mask_png(area), "the area as a mask"))
}

/// The table of the regions, separated by commas, or by tabs in a file `.tsv` or `.txt`.
pub(super) fn regions(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let separator = match extension_of(path).as_str() {
        "tsv" | "txt" => Separator::Tab,
        _ => Separator::Comma,
    };
    Ok(file(path, regions_text(shown(input)?, separator).into_bytes(), "the regions table"))
}

/// The numbers along the profile's line.
pub(super) fn profile_table(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let picture = picture(input)?;
    let ends = input.profile.unwrap_or([[0.5; 2]; 2]);
    let samples = profile(picture, input.shown.as_deref(), ends);
    Ok(file(path, profile_csv(&samples, picture.size().0).into_bytes(), "the profile"))
}

/// A layer, one pixel of the file for each pixel of the photograph: as it is shown, or by the extensions `.exr` and `.npy` its numbers.
pub(super) fn layer(path: &Path, options: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let (picture, settings) = (picture(input)?, &input.image);
    let look = settings.look(input.selected_region);
    let shown = input.shown.as_deref();
    let against = Against { pinned: input.pinned.as_deref(), elsewhere: input.elsewhere.as_deref() };
    let layer = options.layer.unwrap_or(settings.layer);
    let what = format!("the layer \u{201c}{}\u{201d}", layer.name());
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let floats = || layer_floats(layer, picture, shown, against, &look);
    if extension == "exr" {
        return Ok(file(path, floats().exr(), &what));
    }
    if extension == "npy" {
        return Ok(file(path, floats().npy(), &what));
    }
    let painted = paint_against(layer, picture, shown, against, &look);
    let size = [painted.width() as u32, painted.height() as u32];
    Ok(file(path, png_of_rgba(size, painted.as_slice().as_flattened()), &what))
}

/// A picture that a view has drawn.
pub(super) fn drawn(path: &Path, options: &ExportOptions, _: &ExportInput) -> Result<Contents, String> {
    let DrawnPicture { size, rgba } = options
        .drawn
        .as_ref()
        .ok_or_else(|| format!("{}: no view was drawn; export the view again", path.display()))?;
    let bytes = png_of_rgba(*size, rgba);
    if bytes.is_empty() {
        return Err(format!("{}: the drawn picture has no pixels; choose a larger size", path.display()));
    }
    Ok(file(path, bytes, &format!("a picture of {} \u{d7} {} pixels", size[0], size[1])))
}

/// The figures and tables of the paper for the result shown, with the profile along the profile's line.
pub(super) fn figures(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let complete = shown(input)?;
    let (report, name) = (report(complete)?, complete.picture.origin.name());
    let shown = input.shown.clone().ok_or("nothing to export: the analysis gave no result")?;
    let mut scene = Scene::of_snapshot(shown, report).named(&name);
    if let Some(line) = input.profile {
        scene = scene.with_line(line);
    }
    Ok(file(path, figures::page(&scene, None).into_bytes(), "the figures and tables"))
}

/// The parameters as TOML.
pub(super) fn parameters(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let text = toml::to_string(&input.document.params);
    let text = text.map_err(|error| format!("{}: cannot be written: {error}", path.display()))?;
    Ok(file(path, text.into_bytes(), "the parameters"))
}

/// The workspace as JSON.
pub(super) fn workspace(path: &Path, _: &ExportOptions, input: &ExportInput) -> Result<Contents, String> {
    let workspace = input.workspace.as_ref().map_err(String::clone)?;
    Ok(file(path, workspace.to_json(path)?.into_bytes(), "the workspace"))
}

/// The photograph; an error where no photograph is open.
fn picture(input: &ExportInput) -> Result<&Picture, String> {
    input.picture.as_deref().ok_or_else(|| "nothing to export: open a photograph first".to_owned())
}

/// The result shown, unless some of its stages are still to be computed.
fn shown(input: &ExportInput) -> Result<&ResultSnapshot, String> {
    picture(input)?;
    match input.shown.as_deref() {
        // The result before belongs to other parameters.
        _ if input.is_analyzing => {
            Err("nothing to export yet: the analysis is still under way; try again when it has ended".into())
        }
        Some(shown) if shown.stale_from.is_none() && !input.lacks_result => Ok(shown),
        _ => Err(
            "nothing to export: there is no result for the present parameters; analyze now (F5), and try again".into(),
        ),
    }
}

/// The photograph without its highlights, or with a share of them.
pub(super) fn matte(
    given_path: &Path,
    options: &ExportOptions,
    input: &ExportInput,
) -> Result<Contents, String> {
    let (shown, keep_surface) = (shown(input)?, options.keep_surface);
    let (extension, bytes) = matte_bytes(&shown.picture.photo, &shown.analysis.intrinsic, keep_surface)
        .map_err(|error| error_chain(&error))?;
    // The format is the photograph's own, or a format that can hold the photograph's values.
    let path = with_fitting_extension(given_path, extension);
    if path != given_path && path.exists() {
        return Err(format!(
            "{}: exists, and the picture would be written there because its format is {extension}; choose another name",
            path.display()
        ));
    }
    let what = match percent_kept(keep_surface) {
        None => "the photograph without highlights".to_owned(),
        Some(percent) => format!("the photograph with {percent} % of its surface reflection"),
    };
    Ok(Contents { path, bytes, what })
}

/// The share of the surface reflection that is kept, percent with at most three decimals; none where nothing is kept.
fn percent_kept(keep_surface: f64) -> Option<f64> {
    let share = keep_surface.clamp(0.0, 1.0);
    // A share above 0 is never named 0 %.
    (share > 0.0).then(|| ((share * 1e5).round() / 1e3).max(1e-3))
}

/// `path` with an extension that names the format `format` (`jpg`, `tif` or `png`). The extension of another picture format is
/// replaced. Any other extension belongs to the name, and the format's extension is appended.
fn with_fitting_extension(path: &Path, format: &str) -> PathBuf {
    const PICTURES: [&str; 17] = [
        "bmp", "exr", "hdr", "heic", "heif", "hif", "jpeg", "jpg", "pbm", "pgm", "png", "pnm", "ppm", "qoi",
        "tif", "tiff", "webp",
    ];
    let given = extension_of(path);
    let fits = match format {
        "jpg" => ["jpg", "jpeg"].contains(&given.as_str()),
        "tif" => ["tif", "tiff"].contains(&given.as_str()),
        other => other == given,
    };
    if fits {
        path.to_owned()
    } else if PICTURES.contains(&given.as_str()) {
        path.with_extension(format)
    } else {
        let mut name = path.as_os_str().to_owned();
        name.push(".");
        name.push(format);
        PathBuf::from(name)
    }
}

/// The pixels of a region, or the marked pixels: a mask (`.png`), a table (`.csv`) or points (`.ply`).
pub(super) fn selection(
    path: &Path,
    options: &ExportOptions,
    input: &ExportInput,
) -> Result<Contents, String> {
    let (picture, shown) = (picture(input)?, input.shown.as_deref());
    let mask = match options.region {
        Some(region) => shown.and_then(|shown| mask_of(Item::Region(region), shown)),
        None => selected::selected_pixels(&input.document.selection, picture, shown),
    };
    let mask = mask.ok_or("nothing is selected: mark pixels or select a region, then export again")?;
    let of = options
        .region
        .map_or_else(|| "the selected pixels".to_owned(), |id| format!("the pixels of region {id}"));
    let (bytes, what) = match extension_of(path).as_str() {
        "png" if options.region.is_none() => {
            (selected::mask_png(&mask), "the selection as a mask".to_owned())
        }
        "png" => (selected::mask_png(&mask), format!("{of} as a mask")),
        "csv" => (selected::csv(&mask, picture, shown).into_bytes(), format!("{of} as a table")),
        "ply" => (selected::ply(&mask, picture), format!("{of} as points")),
        _ => {
            let path = path.display();
            return Err(format!(
                "{path}: a selection is written as .png (mask), .csv (table) or .ply (points)"
            ));
        }
    };
    Ok(Contents { path: path.to_owned(), bytes, what })
}

/// The extension of a path in lower case; empty without one.
fn extension_of(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// The files that `analyze` would write for the photograph and the parameters of the result shown.
pub(super) fn result(
    folder: &Path,
    options: &ExportOptions,
    input: &ExportInput,
    stop: &Stop,
    report_progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<String, String> {
    let shown = shown(input)?;
    let (report, keep_surface) = (report(shown)?, options.keep_surface);
    let whole = WholeResult { photo: &shown.picture.photo, analysis: &shown.analysis, keep_surface };
    let goes_on = |done, total| {
        report_progress(done, total);
        !stop.stopped()
    };
    match whole.write(report, folder, options.force, &goes_on) {
        Ok(_) => {
            let kept = percent_kept(keep_surface).map_or_else(String::new, |percent| {
                format!(", its matte picture with {percent} % of the surface reflection")
            });
            Ok(format!("wrote the result to {}{kept}", folder.display()))
        }
        Err(ExportError::Stopped) => Ok(stopped(folder)),
        Err(ExportError::Occupied(folder)) => Err(format!(
            "{} holds something else than an earlier result: choose another folder, or let it be replaced",
            folder.display()
        )),
        Err(error @ ExportError::NotAFolder(_)) => Err(format!("{error}; choose another place")),
        Err(error) => Err(format!("{}; choose another place", error_chain(&error))),
    }
}

/// The report of a result, as `analyze` writes it.
fn report(shown: &ResultSnapshot) -> Result<Report, String> {
    let Picture { photo, sha256, read_ms, truth, .. } = &*shown.picture;
    let mut timings_ms = Timings { read: Some(*read_ms), ..Timings::default() };
    for (stage, took_ms) in Stage::ALL.into_iter().zip(shown.took_ms) {
        // A stage whose earlier output was reused took no time in this run.
        *timings_ms.slot(stage) = Some(took_ms.unwrap_or(0.0));
    }
    let input = ReportInput {
        photo,
        sha256,
        params: &shown.params,
        analysis: &shown.analysis,
        area: shown.area.as_deref().map(|mask| AreaFacts::new(AREA_FILE, mask)),
        timings_ms,
        reference: truth.as_ref().map(|truth| Reference { truth, camera: &photo.image.pixels }),
    };
    truth::report(input).map_err(|error| error.to_string())
}
