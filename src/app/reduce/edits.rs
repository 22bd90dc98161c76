//! The reducer of the document's edits: each change is a step of the undo history, and is analyzed where needed.

use super::named_marks::{edit_named_marks, update_active_mark};
use crate::app::analysis_state::is_same_area;
use crate::app::{Combine, Document, Edit, Effect, Gesture, Severity, State};
use crate::params::{IlluminantSetting, Method, Parameter, Params};
use crate::raster::{Mask, Raster};
use crate::view::Selection;
use std::sync::Arc;

/// The notice about parameters of an earlier photograph; it goes when all parameters have their defaults.
const PARAMETERS_STAY: &str =
    "parameters that were changed for an earlier photograph stay in force; Reset takes the defaults";

/// Changes the document.
pub(super) fn reduce(state: &mut State, command: Edit) -> Vec<Effect> {
    let effects = change(state, command);
    forget_defaults(state);
    effects
}

/// Whether a parameter differs from the method's default.
fn is_changed(params: &Params) -> bool {
    *params != Params::of(params.method)
}

/// Takes the notice about parameters of an earlier photograph away, where none differs from its default any more.
pub(super) fn forget_defaults(state: &mut State) {
    if !is_changed(&state.document.params) {
        state.notices.retain(|notice| notice.text != PARAMETERS_STAY);
        state.told_of_parameters = false;
    }
}

/// Tells that the parameters of an earlier photograph stay in force, where one differs from its default: once, until all have
/// their defaults again.
pub(super) fn tell_of_parameters(state: &mut State) {
    if is_changed(&state.document.params) && !std::mem::replace(&mut state.told_of_parameters, true) {
        state.notify_of_files(Severity::Warning, PARAMETERS_STAY.to_owned());
    }
}

fn change(state: &mut State, command: Edit) -> Vec<Effect> {
    match command {
        Edit::Undo => {
            let earlier = state.history.undo(&state.document);
            restore_document(state, earlier)
        }
        Edit::Redo => {
            let later = state.history.redo(&state.document);
            restore_document(state, later)
        }
        Edit::GoTo(entry) => {
            let other = state.history.go_to(entry, &state.document);
            restore_document(state, other)
        }
        Edit::EndGesture(gesture) => {
            state.history.end_gesture(gesture);
            Vec::new()
        }
        Edit::SetParameter(parameter, setting, gesture) => {
            edit_params(state, gesture, |params| *params.slot(parameter) = setting)
        }
        Edit::SetMethod(method) => set_method(state, method),
        Edit::SetSwitch(switch, on) => {
            edit_params(state, None, |params| params.refinements_mut().set(switch, on))
        }
        Edit::SetReading(reading, on) => {
            edit_params(state, None, |params| params.paper.readings.set(reading, on))
        }
        Edit::SetParams(params) => edit_params(state, None, |old| *old = *params),
        Edit::PinIlluminant(direction, gesture) => {
            edit_params(state, gesture, |params| params.illuminant = illuminant_setting(direction))
        }
        Edit::PinSecondIlluminant(direction, gesture) => {
            edit_params(state, gesture, |params| params.second_illuminant = illuminant_setting(direction))
        }
        Edit::SetAmbient(setting, gesture) => edit_params(state, gesture, |params| params.ambient = setting),
        Edit::FitSkewedT(marked) => fit_skewed_t(state, marked),
        Edit::RestrictTo(area) => edit(state, None, |document| document.area = area),
        Edit::Select(item) => {
            begin_selection(state);
            edit(state, None, |document| document.selection.item = item)
        }
        Edit::Mark(mask, combine, gesture) => edit(state, gesture, |document| {
            let (selection, size) = (&mut document.selection, (mask.width(), mask.height()));
            selection.marked = combined_marks(selection.marked.take(), mask, combine);
            update_active_mark(selection, size);
        }),
        Edit::InvertMarked => invert_marked(state),
        Edit::NamedMark(change) => {
            edit(state, None, |document| edit_named_marks(&mut document.selection, change))
        }
        Edit::ClearSelection => {
            begin_selection(state);
            edit(state, None, |document| {
                let mut named = (*document.selection.named).clone();
                named.active = None;
                document.selection = Selection { named: Arc::new(named), ..Selection::default() };
            })
        }
    }
}

/// Changes the method. The method by hand is fitted to the marked pixels, where there are any and no area is set.
fn set_method(state: &mut State, method: Method) -> Vec<Effect> {
    let area = &state.document.area;
    match state.document.selection.marked.clone().filter(|_| area.is_none()) {
        // The method by hand has no use for the whole picture where pixels are marked.
        Some(marked) if method == Method::ByHand => fit_skewed_t(state, marked),
        _ => {
            tell_of_lost_lamp(state, method);
            edit_params(state, None, |params| *params = with_method(params, method))
        }
    }
}

/// Marks the pixels that are not marked, and no others.
fn invert_marked(state: &mut State) -> Vec<Effect> {
    let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return Vec::new() };
    edit(state, None, |document| {
        let marked = &mut document.selection.marked;
        *marked = match marked.take() {
            Some(mask) => some_if_any(mask.map(|&on| !on)),
            None => Some(Arc::new(Mask::filled(size.0, size.1, true))),
        };
        update_active_mark(&mut document.selection, size);
    })
}

/// Forgets the pixel and the hypothesis whose histories are shown: what is selected now has a history of its own, and its number is that of
/// the result that is shown.
fn begin_selection(state: &mut State) {
    (state.explained_pixel, state.debugger.chosen) = (None, None);
    state.awaited.is_numbered = false;
}

/// Changes the parameters as a step of the history; parameters that are not valid change nothing.
pub(super) fn edit_params(
    state: &mut State,
    gesture: Option<Gesture>,
    change: impl FnOnce(&mut Params),
) -> Vec<Effect> {
    state.give_up_pin();
    let mut params = state.document.params;
    change(&mut params);
    if let Err(invalid) = params.validate() {
        state.notify(Severity::Error, invalid.to_string());
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

/// Replaces the document by an earlier or undone one, and analyzes where parameters or area differ.
fn restore_document(state: &mut State, document: Option<Document>) -> Vec<Effect> {
    let Some(document) = document else { return Vec::new() };
    let before = std::mem::replace(&mut state.document, document);
    let effects = analyze_if_needed(state, &before);
    state.awaited.is_numbered = !effects.is_empty();
    effects
}

/// Analyzes if parameters or area differ from those of `before`.
fn analyze_if_needed(state: &mut State, before: &Document) -> Vec<Effect> {
    let same_area = is_same_area(before.area.as_ref(), state.document.area.as_ref());
    if before.params == state.document.params && same_area { Vec::new() } else { analyze(state) }
}

/// Asks for an analysis of the open photograph, and stops a what-if job.
pub(super) fn analyze(state: &mut State) -> Vec<Effect> {
    if state.picture.is_none() {
        return Vec::new();
    }
    state.generation += 1;
    // A what-if job is about the earlier result.
    let is_searching = state.what_if_job.take().is_some_and(|what_if_job| what_if_job.found.is_none());
    let stop = is_searching.then_some(Effect::StopWhatIf);
    stop.into_iter().chain([Effect::Analyze]).collect()
}

/// The setting of a lamp with this direction; none: the analysis finds the lamp.
fn illuminant_setting(direction: Option<[f64; 3]>) -> IlluminantSetting {
    direction.map_or(IlluminantSetting::Auto, IlluminantSetting::Given)
}

/// Says that a given second lamp is not kept under a method that splits with one lamp.
fn tell_of_lost_lamp(state: &mut State, method: Method) {
    let is_given = state.document.params.second_illuminant != IlluminantSetting::Auto;
    if is_given && method != Method::Refined {
        let text = format!(
            "the second lamp that was given is let go: {} splits with one lamp, only the refined method with two; undo brings the lamp back",
            method.name()
        );
        state.notify(Severity::Warning, text);
    }
}

/// Chooses the method by hand and restricts the analysis to the marked pixels, in one step of the history. Their region is selected when the
/// result is there.
fn fit_skewed_t(state: &mut State, marked: Arc<Mask>) -> Vec<Effect> {
    state.give_up_pin();
    tell_of_lost_lamp(state, Method::ByHand);
    let params = with_method(&state.document.params, Method::ByHand);
    if params == state.document.params
        && state.document.area.as_ref().is_some_and(|area| Arc::ptr_eq(area, &marked))
    {
        return Vec::new();
    }
    let effects = edit(state, None, |document| {
        (document.params, document.area) = (params, Some(marked));
        document.selection.item = None;
    });
    state.awaited.selects_region = !effects.is_empty();
    effects
}

/// `params` with the other method: each parameter at the old method's default gets the new method's default. A given second lamp is kept
/// under the refined method alone.
fn with_method(params: &Params, method: Method) -> Params {
    let (from, to) = (Params::of(params.method), Params::of(method));
    let mut changed = Params { method, ..*params };
    if method != Method::Refined {
        changed.second_illuminant = IlluminantSetting::Auto;
    }
    for parameter in Parameter::ALL {
        if params.get(parameter) == from.get(parameter) {
            *changed.slot(parameter) = to.get(parameter);
        }
    }
    changed
}

/// The marked pixels after `new` were marked; none where no pixel is marked.
fn combined_marks(before: Option<Arc<Mask>>, new: Arc<Mask>, combine: Combine) -> Option<Arc<Mask>> {
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

/// A mask with at least one pixel; none for an empty mask.
fn some_if_any(mask: Mask) -> Option<Arc<Mask>> {
    mask.as_slice().contains(&true).then(|| Arc::new(mask))
}
