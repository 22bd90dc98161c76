//! The one function that changes the state.

use super::state::AfterPin;
use super::{
    Asked, Combine, Command, Debugger, Document, Export, Gesture, Notice, Severity, State, ViewSettings,
    Workspace,
};
use crate::params::{IlluminantSetting, Method, Parameter, Params};
use crate::photo::ReadOptions;
use crate::raster::{Mask, Raster};
use crate::view::{MaskRuns, Origin, Picture, ResultSnapshot, Selection};
use std::path::PathBuf;
use std::sync::Arc;

/// What a command asks for beyond the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Analyze the picture with the document as it is now.
    Analyze,
    /// Record the decisions of that analysis.
    Trace,
    /// Find what would change a pixel's fate.
    Inquire(Asked),
    /// Stop that.
    StopInquiring,
    /// Read a photograph in this way.
    Read(Origin, ReadOptions),
    /// Read parameters.
    ReadParams(PathBuf),
    /// Read a workspace.
    ReadWorkspace(PathBuf),
    /// Write something.
    Write(Export),
    /// Stop writing.
    StopWriting,
}

/// Photographs remembered.
const MOST_RECENT: usize = 12;

/// Applies `command` to `state` and says what else is to be done.
pub fn reduce(state: &mut State, command: Command) -> Vec<Effect> {
    match command {
        Command::Open(origin) => {
            state.restoring = None;
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        Command::ReadAs(options) => {
            state.restoring = None;
            state.picture.iter().map(|picture| Effect::Read(picture.origin.clone(), options)).collect()
        }
        Command::Restore(workspace) => match workspace.reading() {
            Ok(options) => {
                let origin = workspace.origin.clone();
                state.restoring = Some(workspace);
                vec![Effect::Read(origin, options)]
            }
            Err(reason) => notify(state, Severity::Error, reason),
        },
        Command::Opened(picture) => opened(state, picture),
        Command::OpenFailed(reason) => {
            (state.jobs.reading, state.restoring) = (None, None);
            notify(state, Severity::Error, reason)
        }
        Command::Progress { generation, stage } => {
            if let Some(job) = state.jobs.analysis.as_mut().filter(|_| generation == state.generation) {
                job.stage = Some(stage);
            }
            Vec::new()
        }
        Command::Analyzed(shown) => analyzed(state, shown),
        Command::Exporting { done, total } => {
            if let Some(job) = &mut state.jobs.export {
                job.files = Some((done, total));
            }
            Vec::new()
        }
        Command::Exported(outcome) => {
            state.jobs.export = None;
            match outcome {
                Ok(said) => notify(state, Severity::Done, said),
                Err(reason) => notify(state, Severity::Error, reason),
            }
        }
        Command::Undo => {
            let earlier = state.history.undo(&state.document);
            restore(state, earlier)
        }
        Command::Redo => {
            let later = state.history.redo(&state.document);
            restore(state, later)
        }
        Command::EndGesture => {
            state.history.end_gesture();
            Vec::new()
        }
        Command::Ask(ask) => super::what_if_job::reduce(state, ask),
        Command::Debug(command) => super::debugger::reduce(state, command),
        Command::Export(_) if state.jobs.export.is_some() => {
            let text = "an export is still under way: wait for its end, or cancel it first";
            notify(state, Severity::Warning, text.to_owned())
        }
        Command::Export(export) => vec![Effect::Write(export)],
        Command::CancelExport => vec![Effect::StopWriting],
        Command::OpenWorkspace(path) => vec![Effect::ReadWorkspace(path)],
        Command::LoadParams(path) => vec![Effect::ReadParams(path)],
        Command::Notify(severity, text) => notify(state, severity, text),
        Command::Dismiss(id) => {
            state.notices.retain(|notice| notice.id != id);
            Vec::new()
        }
        Command::ForgetRecent => {
            state.recent.clear();
            Vec::new()
        }
        other => edit_or_look(state, other),
    }
}

/// The commands that change the document or the view.
fn edit_or_look(state: &mut State, command: Command) -> Vec<Effect> {
    match command {
        Command::SetParameter(parameter, setting, gesture) => {
            edit_params(state, gesture, |params| *params.slot(parameter) = setting)
        }
        Command::SetMethod(method) => {
            edit_params(state, None, |params| *params = with_method(params, method))
        }
        Command::SetSwitch(switch, on) => edit_params(state, None, |params| params.refine.set(switch, on)),
        Command::SetParams(params) => edit_params(state, None, |old| *old = *params),
        Command::PinIlluminant(direction, gesture) => pin_illuminant(state, direction, gesture),
        Command::SetAmbient(setting, gesture) => {
            edit_params(state, gesture, |params| params.ambient = setting)
        }
        Command::RestrictTo(area) => edit(state, None, |document| document.area = area),
        Command::Select(item) => {
            state.asked_pixel = None;
            edit(state, None, |document| document.selection.item = item)
        }
        Command::Mark(mask, combine, gesture) => edit(state, gesture, |document| {
            document.selection.marked = combined(document.selection.marked.take(), mask, combine);
        }),
        Command::InvertMarked => {
            let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return Vec::new() };
            edit(state, None, |document| {
                let marked = &mut document.selection.marked;
                *marked = match marked.take() {
                    Some(mask) => some_if_any(mask.map(|&on| !on)),
                    None => Some(Arc::new(Mask::filled(size.0, size.1, true))),
                };
            })
        }
        Command::ClearSelection => {
            state.asked_pixel = None;
            edit(state, None, |document| document.selection = Selection::default())
        }
        other => {
            look(state, other);
            Vec::new()
        }
    }
}

/// The commands that change how things are shown.
fn look(state: &mut State, command: Command) {
    match command {
        Command::Hover(item) => state.hover = item,
        Command::Pin(keep) => {
            state.pinned = if keep { state.newest.clone() } else { None };
            state.view.show_pinned = false;
        }
        Command::ShowPinned(pinned) => state.view.show_pinned = pinned && state.pinned.is_some(),
        Command::Image(settings) => state.view.image = settings,
        Command::Cube(settings) => state.view.cube = settings,
        Command::Plane(settings) => state.view.plane = settings,
        Command::Profile(line) => state.view.profile = line,
        Command::Theme(theme) => state.view.theme = theme,
        Command::Layout(layout) => state.view.layout = layout,
        Command::Camera(camera) => state.view.camera = camera,
        // The others are handled before; a new one cannot be forgotten, as all are listed.
        Command::Open(_)
        | Command::ReadAs(_)
        | Command::Restore(_)
        | Command::Opened(_)
        | Command::Progress { .. }
        | Command::Analyzed(_)
        | Command::Exporting { .. }
        | Command::Exported(_)
        | Command::OpenFailed(_)
        | Command::SetParameter(..)
        | Command::SetMethod(_)
        | Command::SetSwitch(..)
        | Command::SetParams(_)
        | Command::LoadParams(_)
        | Command::PinIlluminant(..)
        | Command::SetAmbient(..)
        | Command::RestrictTo(_)
        | Command::EndGesture
        | Command::Undo
        | Command::Redo
        | Command::Select(_)
        | Command::Mark(..)
        | Command::InvertMarked
        | Command::ClearSelection
        | Command::Ask(_)
        | Command::Debug(_)
        | Command::Export(_)
        | Command::CancelExport
        | Command::OpenWorkspace(_)
        | Command::Notify(..)
        | Command::Dismiss(_)
        | Command::ForgetRecent => {}
    }
}

fn opened(state: &mut State, picture: Arc<Picture>) -> Vec<Effect> {
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

/// Puts back what a workspace holds beside its photograph, which is open by now.
fn put_back(state: &mut State, workspace: Workspace) {
    let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return };
    let Workspace { params, pinned, area, item, marked, view, .. } = workspace;
    let show_pinned = view.show_pinned;
    // Dark or light is a matter of the room that one sits in.
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

fn analyzed(state: &mut State, shown: Arc<ResultSnapshot>) -> Vec<Effect> {
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

fn edit_params(state: &mut State, gesture: Option<Gesture>, change: impl FnOnce(&mut Params)) -> Vec<Effect> {
    if let Some(after) = state.after_pin.take() {
        state.document.params = after.params;
    }
    let mut params = state.document.params;
    change(&mut params);
    if let Err(invalid) = params.validate() {
        return notify(state, Severity::Error, invalid.to_string());
    }
    edit(state, gesture, |document| document.params = params)
}

/// Changes the document as a step of the history; analyses anew where that needs it.
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
    // What was asked, was asked of the result before.
    let inquiring = state.what_if_job.take().is_some_and(|what_if_job| what_if_job.found.is_none());
    let stop = inquiring.then_some(Effect::StopInquiring);
    stop.into_iter().chain([Effect::Analyze]).collect()
}

fn pin_illuminant(state: &mut State, direction: Option<[f64; 3]>, gesture: Option<Gesture>) -> Vec<Effect> {
    let setting = direction.map_or(IlluminantSetting::Auto, IlluminantSetting::Given);
    edit_params(state, gesture, |params| params.illuminant = setting)
}

/// The other method, with what stood at the first one's default at the second one's.
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

/// Adds a notice, unless the same one is up already.
fn notify(state: &mut State, severity: Severity, text: String) -> Vec<Effect> {
    if state.notices.iter().any(|notice| notice.text == text) {
        return Vec::new();
    }
    state.notices_so_far += 1;
    state.notices.push(Notice { id: state.notices_so_far, severity, text });
    Vec::new()
}

#[cfg(test)]
mod tests;
