//! Carries out actions that do not belong to one panel.

use super::action::{Action, CubeAction, Lamp};
use super::cube_choices::CUBE_BOXES;
use super::dialog::Dialog;
use super::menu::READINGS;
use super::move_cursor::move_cursor;
use super::{PanelContext, files, parameters};
use crate::app::{
    Combine, Command, DebugCommand, Edit, ExportKind, JobCommand, NamedMarkEdit, Question, Severity,
    ViewCommand,
};
use crate::params::Params;
use crate::photo::ReadOptions;
use crate::raster::{Mask, RegionId};
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::{CubeSettings, GeometrySettings, Item, Origin, PlaneSettings, ProfileLine, Theme, Tool};
use std::sync::Arc;

/// Carries out an action: sends its command, or opens a dialog or the list of keys (`help`).
pub fn carry_out(action: Action, cx: &mut PanelContext, dialogs: &mut files::Dialogs, help: &mut bool) {
    match action {
        Action::Open
        | Action::OpenWorkspace
        | Action::SaveWorkspaceAs
        | Action::LoadParameters
        | Action::SaveParameters
        | Action::OpenElsewhere(_)
        | Action::Export
        | Action::ExportLayer(..)
        | Action::ExportPixels(_) => open_dialog(action, cx, dialogs),
        Action::Save => match cx.state.workspace_path.clone() {
            Some(path) => cx.send(JobCommand::Export(ExportKind::Workspace.to(path))),
            None => dialogs.open(Dialog::SaveWorkspace),
        },
        // The window closes itself and photographs, arranges its panels, knows where they are and has the clipboard: an action has no window.
        Action::Quit
        | Action::CopyCommandLine
        | Action::CopyRegions
        | Action::CopyProfile
        | Action::Show(_)
        | Action::ShowAll
        | Action::Palette
        | Action::Menus
        | Action::ClosePhotograph
        | Action::TextSize(_)
        | Action::View(_) => {}
        Action::Help => *help = !*help,
        Action::CloseElsewhere(_)
        | Action::Switch(_)
        | Action::ComparePhotographs
        | Action::Sample(_)
        | Action::ThreeLamps
        | Action::ReadAs(_)
        | Action::ForgetRecent => change_photographs(action, cx),
        Action::CancelExport | Action::CancelAnalysis | Action::Analyze => start_or_cancel(action, cx),
        Action::Undo
        | Action::Redo
        | Action::Invert
        | Action::MarkRegion
        | Action::FitSkewedT
        | Action::AnalyzeMarked
        | Action::AnalyzeAll
        | Action::Method(_)
        | Action::Preset(_)
        | Action::ResetParameters
        | Action::PinLamp(_)
        | Action::AmbientAuto
        | Action::ReleaseMark
        | Action::KeepMark => edit(action, cx),
        Action::FindWhatIf => find_what_if(cx),
        Action::Escape => {
            if *help {
                *help = false;
            } else {
                cx.send(Edit::ClearSelection);
            }
        }
        Action::Region(next) => select_adjacent_region(cx, next),
        Action::Pin => pin(cx),
        Action::PinAnew => cx.send(ViewCommand::Pin(true)),
        Action::FirstDifference => cx.send(Command::Debug(DebugCommand::Compare)),
        Action::Swap if cx.state.pinned.is_none() => answer(cx, "no result is pinned: K pins the newest one"),
        Action::Swap => cx.send(ViewCommand::ShowPinned(!cx.state.view.show_pinned)),
        Action::Theme => cx.send(ViewCommand::Theme(other_theme(cx.state.view.theme))),
        Action::UseTheme(theme) => cx.send(ViewCommand::Theme(theme)),
        Action::Debug(action) => move_cursor(action, cx),
        Action::DismissNotices => dismiss_notices(cx),
        Action::Cube(_)
        | Action::PlaneByLabel(_)
        | Action::PlaneTool(_)
        | Action::Profile(_)
        | Action::DrawSphere => change_other_view(action, cx),
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

/// The theme that is not `theme`.
const fn other_theme(theme: Theme) -> Theme {
    match theme {
        Theme::Dark => Theme::Light,
        Theme::Light => Theme::Dark,
    }
}

/// Removes all notices.
fn dismiss_notices(cx: &mut PanelContext) {
    let state = cx.state;
    state.notices.iter().for_each(|notice| cx.send(ViewCommand::Dismiss(notice.id)));
}

/// Opens the dialog of an action.
fn open_dialog(action: Action, cx: &PanelContext, dialogs: &mut files::Dialogs) {
    match action {
        Action::Open => dialogs.open(Dialog::Open),
        Action::OpenWorkspace => dialogs.open(Dialog::OpenWorkspace),
        Action::SaveWorkspaceAs => dialogs.open(Dialog::SaveWorkspace),
        Action::LoadParameters => dialogs.open(Dialog::LoadParameters),
        Action::SaveParameters => dialogs.open(Dialog::SaveParameters),
        Action::OpenElsewhere(kind) => dialogs.open(Dialog::OpenElsewhere(kind)),
        Action::Export => dialogs.open(Dialog::Export),
        Action::ExportLayer(layer, file) => dialogs.open_layer_export(cx, layer, file),
        Action::ExportPixels(pixels) => dialogs.open_pixels_export(cx, pixels),
        _ => {}
    }
}

/// Opens, closes, shows or compares photographs.
fn change_photographs(action: Action, cx: &mut PanelContext) {
    match action {
        Action::CloseElsewhere(kind) => cx.send(ViewCommand::CloseElsewhere(kind)),
        Action::Switch(_) if cx.state.others.is_empty() => answer(cx, "no other photograph is open"),
        Action::Switch(switching) => cx.send(JobCommand::Switch(switching)),
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
        _ => {}
    }
}

/// Changes the document.
fn edit(action: Action, cx: &mut PanelContext) {
    match action {
        Action::Undo if !cx.state.history.can_undo() => answer(cx, "nothing to undo"),
        Action::Redo if !cx.state.history.can_redo() => answer(cx, "nothing to redo"),
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
        Action::ResetParameters => {
            cx.send(Edit::SetParams(Box::new(Params::of(cx.state.document.params.method))));
        }
        Action::PinLamp(Lamp::First) => parameters::toggle_light(cx),
        Action::PinLamp(Lamp::Second) => parameters::toggle_second_lamp(cx),
        Action::AmbientAuto => parameters::toggle_ambient(cx),
        Action::ReleaseMark => cx.send(Edit::NamedMark(NamedMarkEdit::Release)),
        Action::KeepMark => cx.send(Edit::NamedMark(NamedMarkEdit::Keep)),
        _ => {}
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

/// Changes the color space view, the plane view, the profile or the sphere.
fn change_other_view(action: Action, cx: &mut PanelContext) {
    let view = &cx.state.view;
    match action {
        Action::Cube(action) => {
            let cube = changed_cube(&view.cube, action);
            cx.send(ViewCommand::Cube(cube));
        }
        Action::PlaneByLabel(color_by_label) => {
            let plane = PlaneSettings { color_by_label, ..view.plane.clone() };
            cx.send(ViewCommand::Plane(plane));
        }
        Action::PlaneTool(tool) => {
            let plane = PlaneSettings { tool, ..view.plane.clone() };
            cx.send(ViewCommand::Plane(plane));
        }
        Action::Profile(column) => {
            cx.send(ViewCommand::Profile(if column { ProfileLine::Column } else { ProfileLine::Row }));
        }
        Action::DrawSphere => {
            let is_drawn = !view.geometry.is_drawn;
            cx.send(ViewCommand::Geometry(GeometrySettings { is_drawn, ..view.geometry }));
        }
        _ => {}
    }
}

/// The settings of the color space view after an action. The camera is no setting.
fn changed_cube(before: &CubeSettings, action: CubeAction) -> CubeSettings {
    let mut cube = before.clone();
    match action {
        CubeAction::ColorBy(color_by) => cube.color_by = color_by,
        CubeAction::Space(space) => cube.space = space,
        CubeAction::Lock => cube.locked = !cube.locked,
        CubeAction::Box(index) => {
            if let Some(shown) = CUBE_BOXES.get(index) {
                let slot = (shown.slot)(&mut cube);
                *slot = !*slot;
            }
        }
        CubeAction::View(_) | CubeAction::Perspective => {}
    }
    cube
}

/// Searches for what would change the fate of the clicked pixel, or stops that search.
fn find_what_if(cx: &mut PanelContext) {
    if cx.state.what_if_job.as_ref().is_some_and(|job| job.found.is_none()) {
        return cx.send(Command::Ask(Question::WhatIf(None)));
    }
    if let Some(pixel) = cx.state.explained_pixel() {
        cx.send(Command::Ask(Question::WhatIf(Some(pixel))));
    } else {
        let text = "click a pixel first: what would change it is asked of one pixel";
        cx.send(ViewCommand::Notify(Severity::Warning, text.to_owned()));
    }
}

/// Tells why an action has no effect.
fn answer(cx: &mut PanelContext, text: &str) {
    cx.send(ViewCommand::Notify(Severity::Answer, text.to_owned()));
}

/// Analyzes, or cancels the analysis or the export, or tells why not.
fn start_or_cancel(action: Action, cx: &mut PanelContext) {
    let (is_open, is_analyzing) = (cx.state.picture.is_some(), cx.state.jobs.analysis.is_some());
    let is_cancelable = is_analyzing || cx.state.jobs.recording.is_some();
    match action {
        Action::CancelExport => cx.send(JobCommand::CancelExport),
        Action::CancelAnalysis if is_cancelable => cx.send(JobCommand::CancelAnalysis),
        Action::CancelAnalysis => answer(cx, "no analysis is under way"),
        _ if is_analyzing => answer(cx, "the analysis is under way"),
        _ if is_open => cx.send(JobCommand::Analyze),
        _ => answer(cx, "open a photograph first"),
    }
}

/// Pins the newest result, or unpins the pinned one.
fn pin(cx: &mut PanelContext) {
    if cx.state.pinned.is_none() && cx.state.newest.is_none() {
        return answer(cx, "there is no result to pin yet");
    }
    cx.send(ViewCommand::Pin(cx.state.pinned.is_none()));
}

/// Marks the pixels of the selected region.
fn mark_region(cx: &mut PanelContext) {
    let (Some(region), Some(shown)) = (cx.state.selected_region(), cx.state.shown()) else {
        return answer(cx, "select a region first: its pixels are marked");
    };
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
