//! The paths that the export dialog proposes.

use super::PanelContext;
use super::action::LayerFile;
use crate::app::ExportKind;
use crate::raster::RegionId;
use crate::view::Layer;
use std::path::{Path, PathBuf};

/// The proposed path of an export: beside the photograph, or for a sample scene in the working directory, which is named. Without a photograph
/// the name is that of the kind.
pub fn proposed_path(kind: ExportKind, cx: &PanelContext) -> PathBuf {
    let picture = cx.state.picture.as_ref();
    let photo = picture.and_then(|picture| picture.origin.path());
    let working_directory = || std::env::current_dir().unwrap_or_default();
    let folder = photo.and_then(Path::parent).map_or_else(working_directory, Path::to_path_buf);
    let stem_of = |name: &str| Path::new(name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = picture.map_or_else(
        || kind.file().to_owned(),
        |picture| format!("{}-{}", stem_of(&picture.origin.name()), kind.file()),
    );
    if kind.is_folder() || kind.file().contains('.') {
        return folder.join(name);
    }
    let extension = photo.and_then(Path::extension).map_or("png".into(), |e| e.to_string_lossy());
    folder.join(format!("{name}.{extension}"))
}

/// The proposed path of the pixels of a region, or without a region of the marked pixels: `cups-region-3.png` beside `cups.png`.
pub fn proposed_pixels_path(region: Option<RegionId>, cx: &PanelContext) -> PathBuf {
    let proposed = proposed_path(ExportKind::Selection, cx);
    let Some(region) = region else { return proposed };
    let name = proposed.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let stem = name.strip_suffix(ExportKind::Selection.file()).unwrap_or(&name).to_owned();
    proposed.with_file_name(format!("{stem}region-{region}.png"))
}

/// The proposed path of a single layer's file: `cups-body.exr` beside `cups.png`.
pub fn proposed_layer_path(layer: Layer, file: LayerFile, cx: &PanelContext) -> PathBuf {
    let name = layer.name().to_lowercase().replace(' ', "-");
    let proposed = proposed_path(ExportKind::Layer, cx);
    let stem = proposed.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let stem = stem.strip_suffix("layer").unwrap_or(&stem).to_owned();
    proposed.with_file_name(format!("{stem}{name}.{}", file.extension()))
}
