//! Carries out actions that do not belong to one panel.

use super::action::Action;
use super::dialog::Dialog;
use super::menu::READINGS;
use super::move_cursor::move_cursor;
use super::{PanelContext, files};
use crate::app::{Combine, Edit, ExportKind, JobCommand, NamedMarkEdit, Severity, ViewCommand};
use crate::photo::ReadOptions;
use crate::raster::{Mask, RegionId};
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::{Item, Origin, Tool};
use std::sync::Arc;

/// Carries out an action: sends its command, or opens a dialog or the list of keys (`help`).
pub fn carry_out(action: Action, cx: &mut PanelContext, dialogs: &mut files::Dialogs, help: &mut bool) {
    match action {
        Action::Open => dialogs.open(Dialog::Open),
        Action::OpenWorkspace => dialogs.open(Dialog::OpenWorkspace),
        Action::SaveWorkspaceAs => dialogs.open(Dialog::SaveWorkspace),
        Action::LoadParameters => dialogs.open(Dialog::LoadParameters),
        Action::SaveParameters => dialogs.open(Dialog::SaveParameters),
        Action::OpenElsewhere(kind) => dialogs.open(Dialog::OpenElsewhere(kind)),
        Action::CloseElsewhere(kind) => cx.send(ViewCommand::CloseElsewhere(kind)),
        Action::Export => dialogs.open(Dialog::Export),
        Action::ExportLayer(layer, file) => dialogs.open_layer_export(cx, layer, file),
        Action::ExportPixels(pixels) => dialogs.open_pixels_export(cx, pixels),
        Action::Save => match cx.state.workspace_path.clone() {
            Some(path) => cx.send(JobCommand::Export(ExportKind::Workspace.to(path))),
            None => dialogs.open(Dialog::SaveWorkspace),
        },
        // The window closes itself, arranges its panels, knows where they are and has the clipboard: an action has no window.
        Action::Quit
        | Action::CopyCommandLine
        | Action::Show(_)
        | Action::ShowAll
        | Action::Palette
        | Action::Menus
        | Action::View(_) => {}
        Action::Help => *help = !*help,
        Action::Switch(switching) => cx.send(JobCommand::Switch(switching)),
        Action::ClosePhotograph => cx.send(JobCommand::ClosePhotograph),
        Action::ComparePhotographs => {
            cx.send(ViewCommand::ComparePhotographs(!cx.state.compares_photographs));
        }
        Action::Sample(index) => {
            let sample = SAMPLES.get(index).unwrap_or(&SAMPLES[0]);
            cx.send(JobCommand::Open(Origin::Sample(sample.name.to_owned())));
        }
        Action::ThreeLamps => cx.send(JobCommand::open_samples(&THREE_LAMPS)),
        Action::ReadAs(index) => {
            if let (Some(picture), Some(reading)) = (&cx.state.picture, READINGS.get(index)) {
                cx.send(JobCommand::ReadAs(ReadOptions { encoding: reading.encoding, ..picture.reading }));
            }
        }
        Action::ForgetRecent => cx.send(ViewCommand::ForgetRecent),
        Action::Undo => cx.send(Edit::Undo),
        Action::Redo => cx.send(Edit::Redo),
        Action::Invert => cx.send(Edit::InvertMarked),
        Action::MarkRegion => mark_region(cx),
        Action::FitSkewedT => with_marked(cx, "a skewed T is fitted to them", Edit::FitSkewedT),
        Action::AnalyzeMarked => {
            with_marked(cx, "only they are analyzed", |marked| Edit::RestrictTo(Some(marked)));
        }
        Action::AnalyzeAll => cx.send(Edit::RestrictTo(None)),
        Action::Method(method) => cx.send(Edit::SetMethod(method)),
        Action::Preset(preset) => cx.send(Edit::SetParams(Box::new(preset.params()))),
        Action::KeepMark => cx.send(Edit::NamedMark(NamedMarkEdit::Keep)),
        Action::Escape => {
            if *help {
                *help = false;
            } else {
                cx.send(Edit::ClearSelection);
            }
        }
        Action::Region(next) => select_adjacent_region(cx, next),
        Action::Pin => cx.send(ViewCommand::Pin(cx.state.pinned.is_none())),
        Action::Swap => cx.send(ViewCommand::ShowPinned(!cx.state.view.show_pinned)),
        Action::Theme => {
            use crate::view::Theme::{Dark, Light};
            cx.send(ViewCommand::Theme(if cx.state.view.theme == Dark { Light } else { Dark }));
        }
        Action::UseTheme(theme) => cx.send(ViewCommand::Theme(theme)),
        Action::Debug(action) => move_cursor(action, cx),
        Action::Layer(_)
        | Action::Arrange(_)
        | Action::SecondLayer(_)
        | Action::Tool(_)
        | Action::Fit
        | Action::OneToOne
        | Action::Outline
        | Action::LockReadout => change_image_view(action, cx),
    }
}

/// Changes the layers, tool, zoom, fill or readout of the image view.
fn change_image_view(action: Action, cx: &mut PanelContext) {
    use crate::view::Fill;
    let mut image = cx.state.view.image.clone();
    match action {
        Action::Layer(layer) => image.layer = layer,
        Action::Arrange(kind) => image.arrange(kind),
        Action::SecondLayer(layer) => image.show_beside(layer),
        Action::Tool(tool) => {
            image.tool = tool;
            let mut cube = cx.state.view.cube.clone();
            if matches!(tool, Tool::Pointer | Tool::Rectangle | Tool::Lasso | Tool::Polygon) {
                cube.tool = tool;
                cx.send(ViewCommand::Cube(cube));
            }
        }
        Action::Fit => (image.zoom, image.center_px) = (None, None),
        Action::OneToOne => image.zoom = Some(1.0),
        Action::Outline => image.fill = if image.fill == Fill::Fill { Fill::Outline } else { Fill::Fill },
        Action::LockReadout => image.readout_locked = !image.readout_locked,
        _ => {}
    }
    cx.send(ViewCommand::Image(image));
}

/// Marks the pixels of the selected region.
fn mark_region(cx: &mut PanelContext) {
    let (Some(region), Some(shown)) = (cx.state.selected_region(), cx.state.shown()) else { return };
    let mask = shown.labels().map(|&label| label == region.get());
    cx.send(Edit::Mark(Arc::new(mask), Combine::Replace, None));
}

/// Sends an edit of the marked pixels, or tells that none are marked. `what`: what is done with them, as a clause.
fn with_marked(cx: &mut PanelContext, what: &str, edit: impl FnOnce(Arc<Mask>) -> Edit) {
    if let Some(marked) = cx.state.document.selection.marked.clone() {
        cx.send(edit(marked));
    } else {
        let text = format!("mark the pixels of one object first: {what}");
        cx.send(ViewCommand::Notify(Severity::Warning, text));
    }
}

/// Selects the region after or before the selected one, by id.
fn select_adjacent_region(cx: &mut PanelContext, next: bool) {
    let Some(count) = cx.state.shown().map(|shown| shown.analysis.intrinsic.regions.len()) else {
        return;
    };
    if count == 0 {
        return;
    }
    let region = match (cx.state.selected_region(), next) {
        (Some(region), true) => (region.index() + 1) % count,
        (Some(region), false) => (region.index() + count - 1) % count,
        (None, true) => 0,
        (None, false) => count - 1,
    };
    cx.send(Edit::Select(Some(Item::Region(RegionId::from_index(region)))));
}
