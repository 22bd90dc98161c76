//! The functions that change the state: a reducer for each kind of command.

use super::state::AfterPin;
use super::{
    Asked, Combine, Command, Debugger, Document, Edit, Export, Gesture, JobCommand, Notice, Severity, State,
    ViewCommand, ViewSettings, Workspace,
};
use crate::params::{IlluminantSetting, Method, Parameter, Params};
use crate::photo::ReadOptions;
use crate::raster::{Mask, Raster};
use crate::view::{MaskRuns, Origin, Picture, ResultSnapshot, Selection};
use std::path::PathBuf;
use std::sync::Arc;

/// Work that a command or a report asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Analyze the picture with the document as it is now.
    Analyze,
    /// Record the decisions of that analysis.
    Trace,
    /// Find which parameters would change what a pixel is.
    Inquire(Asked),
    /// Stop finding that.
    StopInquiring,
    /// Read a photograph in this way.
    Read(Origin, ReadOptions),
    /// Read parameters.
    ReadParams(PathBuf),
    /// Read a workspace.
    ReadWorkspace(PathBuf),
    /// Write a file or a folder.
    Write(Export),
    /// Stop writing.
    StopWriting,
}

/// Number of photographs remembered.
const MOST_RECENT: usize = 12;

/// Applies `command` to `state` and says what else is to be done.
pub fn reduce(state: &mut State, command: impl Into<Command>) -> Vec<Effect> {
    match command.into() {
        Command::Edit(edit) => reduce_edit(state, edit),
        Command::View(command) => {
            reduce_view(state, command);
            Vec::new()
        }
        Command::Job(command) => reduce_job(state, command),
        Command::Ask(ask) => super::what_if_job::reduce(state, ask),
        Command::Debug(command) => super::debugger::reduce(state, command),
    }
}

/// Starts or stops work in the background.
fn reduce_job(state: &mut State, command: JobCommand) -> Vec<Effect> {
    match command {
        JobCommand::Open(origin) => {
            state.restoring = None;
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        JobCommand::ReadAs(options) => {
            state.restoring = None;
            state.picture.iter().map(|picture| Effect::Read(picture.origin.clone(), options)).collect()
        }
        JobCommand::OpenWorkspace(path) => vec![Effect::ReadWorkspace(path)],
        JobCommand::LoadParams(path) => vec![Effect::ReadParams(path)],
        JobCommand::Export(_) if state.jobs.export.is_some() => {
            let text = "an export is still under way: wait for its end, or cancel it first";
            notify(state, Severity::Warning, text.to_owned());
            Vec::new()
        }
        JobCommand::Export(export) => vec![Effect::Write(export)],
        JobCommand::CancelExport => vec![Effect::StopWriting],
    }
}

/// Changes the document.
fn reduce_edit(state: &mut State, edit_command: Edit) -> Vec<Effect> {
    match edit_command {
        Edit::Undo => {
            let earlier = state.history.undo(&state.document);
            restore(state, earlier)
        }
        Edit::Redo => {
            let later = state.history.redo(&state.document);
            restore(state, later)
        }
        Edit::EndGesture => {
            state.history.end_gesture();
            Vec::new()
        }
        Edit::SetParameter(parameter, setting, gesture) => {
            edit_params(state, gesture, |params| *params.slot(parameter) = setting)
        }
        Edit::SetMethod(method) => edit_params(state, None, |params| *params = with_method(params, method)),
        Edit::SetSwitch(switch, on) => edit_params(state, None, |params| params.refine.set(switch, on)),
        Edit::SetParams(params) => edit_params(state, None, |old| *old = *params),
        Edit::PinIlluminant(direction, gesture) => pin_illuminant(state, direction, gesture),
        Edit::SetAmbient(setting, gesture) => edit_params(state, gesture, |params| params.ambient = setting),
        Edit::RestrictTo(area) => edit(state, None, |document| document.area = area),
        Edit::Select(item) => {
            state.asked_pixel = None;
            edit(state, None, |document| document.selection.item = item)
        }
        Edit::Mark(mask, combine, gesture) => edit(state, gesture, |document| {
            document.selection.marked = combined(document.selection.marked.take(), mask, combine);
        }),
        Edit::InvertMarked => {
            let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return Vec::new() };
            edit(state, None, |document| {
                let marked = &mut document.selection.marked;
                *marked = match marked.take() {
                    Some(mask) => some_if_any(mask.map(|&on| !on)),
                    None => Some(Arc::new(Mask::filled(size.0, size.1, true))),
                };
            })
        }
        Edit::ClearSelection => {
            state.asked_pixel = None;
            edit(state, None, |document| document.selection = Selection::default())
        }
    }
}

/// Changes how things are shown.
fn reduce_view(state: &mut State, command: ViewCommand) {
    match command {
        ViewCommand::Hover(item) => state.hover = item,
        ViewCommand::Pin(keep) => {
            state.pinned = if keep { state.newest.clone() } else { None };
            state.view.show_pinned = false;
        }
        ViewCommand::ShowPinned(pinned) => state.view.show_pinned = pinned && state.pinned.is_some(),
        ViewCommand::Image(settings) => state.view.image = settings,
        ViewCommand::Cube(settings) => state.view.cube = settings,
        ViewCommand::Plane(settings) => state.view.plane = settings,
        ViewCommand::Profile(line) => state.view.profile = line,
        ViewCommand::Theme(theme) => state.view.theme = theme,
        ViewCommand::Layout(layout) => state.view.layout = layout,
        ViewCommand::Camera(camera) => state.view.camera = camera,
        ViewCommand::Notify(severity, text) => notify(state, severity, text),
        ViewCommand::Dismiss(id) => state.notices.retain(|notice| notice.id != id),
        ViewCommand::ForgetRecent => state.recent.clear(),
    }
}

/// Shows a photograph that was read, and analyzes it.
pub(super) fn opened(state: &mut State, picture: Arc<Picture>) -> Vec<Effect> {
    state.jobs.reading = None;
    if let Some(path) = picture.origin.path() {
        state.recent.retain(|known| known != path);
        state.recent.insert(0, path.to_path_buf());
        state.recent.truncate(MOST_RECENT);
    }
    let warnings =
        picture.photo.warnings.iter().map(|warning| format!("{}: {warning}", picture.origin.name()));
    let warnings: Vec<String> = warnings.collect();
    let restored = state.restoring.take().filter(|workspace| workspace.origin == picture.origin);
    state.picture = Some(picture);
    state.debugger = Debugger::default();
    // Masks of another picture mean nothing here; parameters stay.
    state.document = Document { params: state.document.params, ..Document::default() };
    state.history.forget();
    (state.newest, state.pinned, state.hover, state.asked_pixel) = (None, None, None, None);
    state.view.show_pinned = false;
    (state.view.image.center_px, state.view.image.zoom) = (None, None);
    (state.view.profile, state.after_pin) = (crate::view::ProfileLine::Row, None);
    for warning in warnings {
        notify(state, Severity::Warning, warning);
    }
    if let Some(workspace) = restored {
        put_back(state, *workspace);
    }
    analyze(state)
}

/// Restores what a workspace holds beside its photograph, which is open by now.
fn put_back(state: &mut State, workspace: Workspace) {
    let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return };
    let Workspace { params, pinned, area, item, marked, view, .. } = workspace;
    let show_pinned = view.show_pinned;
    // The theme depends on the room that a person sits in, not on the workspace.
    state.view = ViewSettings { show_pinned: false, theme: state.view.theme, ..view };
    let mut mask = |what: &str, runs: Option<MaskRuns>| {
        let runs = runs?;
        let mask = runs.mask().filter(|mask| (mask.width(), mask.height()) == size);
        if mask.is_none() {
            let text = format!("the workspace's {what} belongs to a picture of another size: it is left out");
            notify(state, Severity::Warning, text);
        }
        mask.map(Arc::new)
    };
    let (area, marked) = (mask("area", area), mask("selection", marked));
    state.document.area = area;
    state.document.selection.marked = marked;
    if let Some(pinned) = pinned {
        state.document.params = pinned;
        state.after_pin = Some(AfterPin { params, item, show_pinned });
    } else {
        (state.document.params, state.document.selection.item) = (params, item);
    }
}

/// Shows a result, unless it is another photograph's or older than the one shown.
pub(super) fn analyzed(state: &mut State, shown: Arc<ResultSnapshot>) -> Vec<Effect> {
    let same_picture = state.picture.as_ref().is_some_and(|picture| Arc::ptr_eq(picture, &shown.picture));
    let newer = state.newest.as_ref().is_none_or(|newest| {
        (shown.generation, shown.stale_from.is_none()) >= (newest.generation, newest.stale_from.is_none())
    });
    if !same_picture || !newer {
        return Vec::new();
    }
    if shown.generation == state.generation && shown.stale_from.is_none() {
        state.jobs.analysis = None;
    }
    let is_last = shown.generation == state.generation && shown.stale_from.is_none();
    follow_region(state, &shown);
    state.newest = Some(shown);
    let Some(after) = state.after_pin.take_if(|_| is_last) else { return Vec::new() };
    state.pinned = state.newest.clone();
    state.view.show_pinned = after.show_pinned;
    (state.document.params, state.document.selection.item) = (after.params, after.item);
    analyze(state)
}

/// A selected region stays selected: it becomes the one that overlaps it most.
fn follow_region(state: &mut State, shown: &ResultSnapshot) {
    let Some(crate::view::Item::Region(region)) = state.document.selection.item else { return };
    let Some(before) = &state.newest else { return };
    let followed = crate::view::best_overlap(before.labels(), shown.labels(), region);
    state.document.selection.item = followed.map(crate::view::Item::Region);
    if let Some(crate::view::Item::Region(_)) = state.hover {
        state.hover = None;
    }
}

/// Changes the parameters as a step of the history; parameters that are not valid change nothing.
pub(super) fn edit_params(
    state: &mut State,
    gesture: Option<Gesture>,
    change: impl FnOnce(&mut Params),
) -> Vec<Effect> {
    if let Some(after) = state.after_pin.take() {
        state.document.params = after.params;
    }
    let mut params = state.document.params;
    change(&mut params);
    if let Err(invalid) = params.validate() {
        notify(state, Severity::Error, invalid.to_string());
        return Vec::new();
    }
    edit(state, gesture, |document| document.params = params)
}

/// Changes the document as a step of the history, and analyzes anew where the change needs it.
fn edit(state: &mut State, gesture: Option<Gesture>, change: impl FnOnce(&mut Document)) -> Vec<Effect> {
    let before = state.document.clone();
    change(&mut state.document);
    if state.document == before {
        return Vec::new();
    }
    state.history.step(&before, gesture);
    analyze_if_needed(state, &before)
}

fn restore(state: &mut State, document: Option<Document>) -> Vec<Effect> {
    let Some(document) = document else { return Vec::new() };
    let before = std::mem::replace(&mut state.document, document);
    analyze_if_needed(state, &before)
}

fn analyze_if_needed(state: &mut State, before: &Document) -> Vec<Effect> {
    let same_area = match (&before.area, &state.document.area) {
        (None, None) => true,
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    };
    if before.params == state.document.params && same_area { Vec::new() } else { analyze(state) }
}

fn analyze(state: &mut State) -> Vec<Effect> {
    if state.picture.is_none() {
        return Vec::new();
    }
    state.generation += 1;
    // A what-if job is about the result before.
    let inquiring = state.what_if_job.take().is_some_and(|what_if_job| what_if_job.found.is_none());
    let stop = inquiring.then_some(Effect::StopInquiring);
    stop.into_iter().chain([Effect::Analyze]).collect()
}

fn pin_illuminant(state: &mut State, direction: Option<[f64; 3]>, gesture: Option<Gesture>) -> Vec<Effect> {
    let setting = direction.map_or(IlluminantSetting::Auto, IlluminantSetting::Given);
    edit_params(state, gesture, |params| params.illuminant = setting)
}

/// `params` with the other method: each parameter at the old method's default gets the new method's default.
fn with_method(params: &Params, method: Method) -> Params {
    let (from, to) = (Params::of(params.method), Params::of(method));
    let mut changed = Params { method, ..*params };
    for parameter in Parameter::ALL {
        if params.get(parameter) == from.get(parameter) {
            *changed.slot(parameter) = to.get(parameter);
        }
    }
    changed
}

fn combined(before: Option<Arc<Mask>>, new: Arc<Mask>, combine: Combine) -> Option<Arc<Mask>> {
    match (before, combine) {
        (None, Combine::Subtract) => None,
        (None, _) | (Some(_), Combine::Replace) => new.as_slice().contains(&true).then_some(new),
        (Some(before), combine) => {
            let join = |(&old, &new): (&bool, &bool)| {
                if combine == Combine::Union { old || new } else { old && !new }
            };
            let data = before.as_slice().iter().zip(new.as_slice()).map(join).collect();
            Raster::from_vec(before.width(), before.height(), data).and_then(some_if_any)
        }
    }
}

fn some_if_any(mask: Mask) -> Option<Arc<Mask>> {
    mask.as_slice().contains(&true).then(|| Arc::new(mask))
}

/// Adds a notice, unless one with the same text is shown already.
pub(super) fn notify(state: &mut State, severity: Severity, text: String) {
    if state.notices.iter().any(|notice| notice.text == text) {
        return;
    }
    state.notices_so_far += 1;
    state.notices.push(Notice { id: state.notices_so_far, severity, text });
}

#[cfg(test)]
mod tests;
