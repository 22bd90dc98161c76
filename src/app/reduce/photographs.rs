//! The reducer of the change between open photographs.

use super::edits::{analyze, forget_defaults};
use crate::app::photographs::MOST_OTHERS;
use crate::app::report::WrittenWorkspace;
use crate::app::{Effect, OpenPhotograph, Severity, State, Switching};
use crate::view::{Arrangement, Picture};
use std::sync::Arc;

/// Puts the photograph that is shown to the end of the others, before another one is shown. Of too many, the one without unsaved work that
/// was shown longest ago is closed; where all have some, the one shown longest ago.
pub(super) fn keep_open(state: &mut State) {
    let shown = take_shown(state);
    state.others.extend(shown);
    if state.others.len() > MOST_OTHERS {
        let closed = state.others.iter().position(|other| !other.is_unsaved()).unwrap_or(0);
        state.others.remove(closed);
    }
}

/// Shows another open photograph, with its document and its last result, and analyzes it anew: results are not kept by generation.
pub(super) fn switch(state: &mut State, switching: Switching) -> Vec<Effect> {
    let index = match switching {
        Switching::Next => 0,
        Switching::Previous => state.others.len().saturating_sub(1),
        Switching::To(index) => index,
    };
    if index >= state.others.len() || state.picture.is_none() {
        return Vec::new();
    }
    // The circle of photographs is turned until the wanted one is first, so that its order stays.
    let shown = take_shown(state);
    let mut circle: Vec<OpenPhotograph> =
        shown.into_iter().chain(std::mem::take(&mut state.others)).collect();
    circle.rotate_left(index + 1);
    state.others = circle.split_off(1);
    circle.pop().map_or_else(Vec::new, |next| show(state, next))
}

/// Shows a photograph that is open already, unchanged and read in the same way, as it was left: opening it again loses no marks and no
/// history. None where it is not open.
pub(super) fn show_open(state: &mut State, picture: &Picture) -> Option<Vec<Effect>> {
    let is_same = |known: &Picture| {
        known.origin == picture.origin && known.sha256 == picture.sha256 && known.reading == picture.reading
    };
    let effects = if state.picture.as_ref().is_some_and(|shown| is_same(shown)) {
        Vec::new()
    } else {
        let index = state.others.iter().position(|other| is_same(&other.picture))?;
        switch(state, Switching::To(index))
    };
    state.notify(
        Severity::Done,
        format!("{} is open already: it is shown as it was left", picture.origin.name()),
    );
    Some(effects)
}

/// Closes an open photograph. In place of the photograph that is shown, the next one is shown; the only one stays.
pub(super) fn close(state: &mut State, picture: &Arc<Picture>) -> Vec<Effect> {
    let next = if state.shows_photograph(picture) {
        if state.others.is_empty() {
            return Vec::new();
        }
        take_shown(state);
        Some(state.others.remove(0))
    } else {
        state.others.retain(|other| !Arc::ptr_eq(&other.picture, picture));
        None
    };
    if state.others.is_empty() {
        compare(state, false);
    }
    next.map_or_else(Vec::new, |next| show(state, next))
}

/// Begins or ends the comparison with the next photograph. At its end the views are as before, but for what was chosen meanwhile.
pub(super) fn compare(state: &mut State, compares: bool) {
    if compares == state.compares_photographs {
        return;
    }
    if compares && state.others.is_empty() {
        let text = "there is no second photograph to compare with: open one first";
        return state.notify(Severity::Warning, text.to_owned());
    }
    state.compares_photographs = compares;
    let image = &mut state.view.image;
    if compares {
        state.before_comparison = Some((image.arrangement, image.other));
        if image.arrangement == Arrangement::Single {
            image.arrangement = Arrangement::SideBySide;
        }
        image.other = image.layer;
    } else if let Some((arrangement, other)) = state.before_comparison.take() {
        if arrangement == Arrangement::Single && image.arrangement == Arrangement::SideBySide {
            image.arrangement = arrangement;
        }
        // The same layer twice is of no use once both are of one photograph.
        if image.other == image.layer {
            image.other = other;
        }
    }
}

/// Takes a written workspace for what is saved of its photograph, which may not be the one that is shown any more.
pub(super) fn take_written(state: &mut State, written: WrittenWorkspace) {
    let WrittenWorkspace { path, picture, document } = written;
    if state.shows_photograph(&picture) {
        (state.workspace_path, state.saved) = (Some(path), document);
    } else if let Some(other) = state.others.iter_mut().find(|other| Arc::ptr_eq(&other.picture, &picture)) {
        (other.workspace_path, other.saved) = (Some(path), document);
    }
}

/// The photograph that is shown, taken out of the state.
fn take_shown(state: &mut State) -> Option<OpenPhotograph> {
    state.keep_complete_result();
    Some(OpenPhotograph {
        picture: state.picture.take()?,
        document: std::mem::take(&mut state.document),
        history: std::mem::take(&mut state.history),
        saved: std::mem::take(&mut state.saved),
        newest: state.newest.take(),
        pinned: state.pinned.take(),
        elsewhere: state.elsewhere.take(),
        found_light: state.found_light.take(),
        workspace_path: state.workspace_path.take(),
        explained_pixel: state.explained_pixel.take(),
        awaited: std::mem::take(&mut state.awaited),
    })
}

fn show(state: &mut State, photograph: OpenPhotograph) -> Vec<Effect> {
    let has_other_size =
        state.others.last().is_some_and(|other| other.picture.size() != photograph.picture.size());
    if has_other_size {
        (state.view.image.center_px, state.view.image.zoom) = (None, None);
    }
    state.leave_photograph();
    state.picture = Some(photograph.picture);
    state.document = photograph.document;
    state.history = photograph.history;
    state.saved = photograph.saved;
    state.newest = photograph.newest;
    state.pinned = photograph.pinned;
    state.found_light = photograph.found_light;
    state.elsewhere = photograph.elsewhere;
    state.workspace_path = photograph.workspace_path;
    state.explained_pixel = photograph.explained_pixel;
    state.awaited = photograph.awaited;
    state.leave_missing_layers();
    forget_defaults(state);
    analyze(state)
}
