//! What the reducer does with pictures of other programs that were read, or could not be read.

use crate::app::read::TRUTH_UNUSED;
use crate::app::state::own_layer;
use crate::app::{Severity, State};
use crate::describe::with_grouped_numbers;
use crate::truth::GroundTruth;
use crate::view::{Elsewhere, ElsewhereKind, Layer, Picture};
use std::path::Path;
use std::sync::Arc;

/// Holds a picture of another program against the results of the photograph from now on, and shows the picture where `shows`.
pub(super) fn take_elsewhere(state: &mut State, kind: ElsewhereKind, read: Elsewhere, shows: bool) {
    let all = state.elsewhere.take().unwrap_or_default().with(read);
    state.elsewhere = Some(Arc::new(all));
    if shows {
        let layer = match kind {
            ElsewhereKind::Labels => Layer::OtherRegions,
            ElsewhereKind::Diffuse => Layer::OtherBody,
        };
        // A wipe or a second view shows the same of the result.
        (state.view.image.layer, state.view.image.other) = (layer, own_layer(kind));
    }
}

/// Says why a picture of another program could not be read. A layer of that picture, as a workspace may have been saved with, gives way to
/// the layer of the result.
pub(super) fn lack_elsewhere(state: &mut State, kind: ElsewhereKind, picture: &Arc<Picture>, reason: String) {
    let is_shown = state.picture.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, picture));
    let left = if is_shown { state.leave_layers_of(kind) } else { None };
    let text = match left {
        Some(layer) => format!(
            "{reason}; the layer {} shows nothing until then, and {} is shown in its place",
            layer.name(),
            own_layer(kind).name()
        ),
        None => reason,
    };
    state.notify(Severity::Error, text);
}

/// The sentence that says why a picture of another program could not be read. Where that is the label picture of the ground truth, which
/// could not be used for the same reason, one sentence says both.
pub(super) fn with_unused_truth(state: &mut State, path: &Path, picture: &Picture, reason: String) -> String {
    let folder = picture.origin.path().and_then(Path::parent);
    if folder.is_none_or(|folder| GroundTruth::labels_path(folder) != path) {
        return reason;
    }
    let mut warnings = picture.photo.warnings.iter();
    let Some(told) = warnings.find(|warning| warning.starts_with(TRUTH_UNUSED)) else { return reason };
    let told = warning_of(picture, told);
    state.notices.retain(|notice| notice.text != told);
    format!("{reason}; the ground truth, of which it is a part, is not used either")
}

/// A warning of a photograph that was read, as a notice.
pub(super) fn warning_of(picture: &Picture, warning: &str) -> String {
    format!("{}: {}", picture.origin.name(), with_grouped_numbers(warning))
}
