//! The reducer of the reports of workers.

use super::debugger::{self, take_trace};
use super::edits::{analyze, edit_params, forget_defaults, tell_of_parameters};
use super::elsewhere::{lack_elsewhere, take_elsewhere, warning_of, with_unused_truth};
use super::jobs::open_files;
use super::photographs::{keep_open, show_open, take_written};
use super::questions::take_progress;
use crate::app::awaited::AfterPin;
use crate::app::files_to_open::with_unopened;
use crate::app::photographs::MOST_OTHERS;
use crate::app::report::{Report, Work, WrittenWorkspace};
use crate::app::state::Restoring;
use crate::app::{Document, Effect, Preview, Severity, State, ViewSettings, Workspace};
use crate::params::IlluminantSetting;
use crate::view::{
    ElsewhereKind, ElsewherePaths, Item, MaskRuns, NamedMark, NamedMarks, Origin, Picture, ProfileLine,
    ResultSnapshot,
};
use std::path::PathBuf;
use std::sync::Arc;

/// Number of photographs remembered.
const MOST_RECENT: usize = 12;

/// Applies a report to the state and returns the effects.
pub(crate) fn reduce_report(state: &mut State, report: Report) -> Vec<Effect> {
    match report {
        Report::Opened(picture) => {
            return telling_what_is_closed(state, |state| {
                open_picture(state, picture, &ElsewherePaths::default())
            });
        }
        Report::OpenedTogether { photographs, elsewhere, workspace } => {
            return telling_what_is_closed(state, |state| {
                open_together(state, photographs, elsewhere, workspace)
            });
        }
        Report::FoundInFolders(files, notes) => {
            state.jobs.reading = None;
            for (severity, text) in notes {
                state.notify_of_files(severity, text);
            }
            return open_files(state, files, true);
        }
        Report::OpenFailed(reason) => {
            (state.jobs.reading, state.restoring) = (None, None);
            state.notify(Severity::Error, reason);
        }
        Report::ParamsRead(params) => {
            state.jobs.reading = None;
            return edit_params(state, None, |old| *old = *params);
        }
        Report::WorkspaceRead { workspace, path } => {
            state.jobs.reading = None;
            return read_photograph_of(state, workspace, path);
        }
        Report::ElsewhereRead { kind, read, picture, shows } => {
            state.jobs.reading = None;
            if state.picture.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, &picture)) {
                take_elsewhere(state, kind, *read, shows);
            }
        }
        Report::ElsewhereFailed { kind, path, picture, reason } => {
            state.jobs.reading = None;
            let reason = with_unused_truth(state, &path, &picture, reason);
            lack_elsewhere(state, kind, &picture, reason);
        }
        Report::Failed(reason) => {
            state.jobs.reading = None;
            state.notify(Severity::Error, reason);
        }
        Report::Panicked { work, reason } => return end_panicked(state, work, &reason),
        Report::Rescued(outcome) => {
            let text = match outcome {
                Ok(path) => format!("the workspace was saved to {}", path.display()),
                Err(reason) => format!("the workspace was not saved: {reason}"),
            };
            state.notify(Severity::Warning, text);
        }
        Report::Progress { generation, stage } => {
            if let Some(job) = state.jobs.analysis.as_mut().filter(|_| generation == state.generation) {
                job.stage = Some(stage);
            }
        }
        Report::Analyzed(shown) => return show_result(state, shown),
        Report::Preview(preview) => show_preview(state, preview),
        Report::Recording { generation, stage } => debugger::take_progress(state, generation, stage),
        Report::Traced { generation, replay } => take_trace(state, generation, *replay),
        Report::Exporting { done, total } => {
            if let Some(job) = &mut state.jobs.export {
                job.files = Some((done, total));
            }
        }
        Report::Exported { outcome, workspace } => {
            end_export(state, outcome, workspace.map(|written| *written));
        }
        Report::WhatIf(request, progress) => take_progress(state, request, progress),
    }
    Vec::new()
}

/// Ends an export. `workspace`: where the export was a workspace, which is from now on the one that its photograph is saved to.
fn end_export(state: &mut State, outcome: Result<String, String>, workspace: Option<WrittenWorkspace>) {
    (state.jobs.export, state.jobs.failed_export, state.jobs.cancels_export) = (None, None, false);
    match outcome {
        Ok(text) => {
            if let Some(written) = workspace {
                take_written(state, written);
            }
            state.notify(Severity::Done, text);
        }
        Err(reason) => {
            state.notify(Severity::Error, reason);
            state.jobs.failed_export = Some(state.notices_so_far);
        }
    }
}

/// Ends the job of a worker that panicked, and asks for the workspace to be saved.
fn end_panicked(state: &mut State, work: Work, reason: &str) -> Vec<Effect> {
    match work {
        Work::Photograph | Work::Folder | Work::File => (state.jobs.reading, state.restoring) = (None, None),
        Work::Analysis => state.give_up_analysis(),
        Work::Export => (state.jobs.export, state.jobs.cancels_export) = (None, false),
        Work::WhatIf => state.what_if_job = None,
        Work::Rescue => {}
    }
    let text = format!(
        "{} was ended by an error of the program ({reason}); please report the error, and go on",
        work.name()
    );
    state.notify(Severity::Error, text);
    if work == Work::Export {
        state.jobs.failed_export = Some(state.notices_so_far);
    }
    let is_work_lost = state.picture.is_some() && work != Work::Rescue;
    if is_work_lost { vec![Effect::Rescue] } else { Vec::new() }
}

/// Asks for the photograph of a workspace; the rest of the workspace is restored when the photograph is open.
fn read_photograph_of(state: &mut State, workspace: Box<Workspace>, path: PathBuf) -> Vec<Effect> {
    match workspace.reading() {
        Ok(options) => {
            let origin = workspace.origin.clone();
            state.restoring = Some(Restoring { workspace, path });
            vec![Effect::Read(origin, options)]
        }
        Err(reason) => {
            state.notify(Severity::Error, reason);
            Vec::new()
        }
    }
}

/// Opens photographs by `open`, and names those that were closed because no more can be open.
fn telling_what_is_closed(state: &mut State, open: impl FnOnce(&mut State) -> Vec<Effect>) -> Vec<Effect> {
    let open_ones = |state: &State| -> Vec<Origin> {
        let shown = state.picture.iter().chain(state.others.iter().map(|other| &other.picture));
        shown.map(|picture| picture.origin.clone()).collect()
    };
    let before = open_ones(state);
    let effects = open(state);
    let after = open_ones(state);
    let closed: Vec<String> =
        before.iter().filter(|origin| !after.contains(origin)).map(Origin::name).collect();
    if !closed.is_empty() {
        let (names, were) = (closed.join(", "), if closed.len() == 1 { "was" } else { "were" });
        let text = format!("{names} {were} closed: {} photographs can be open at once", MOST_OTHERS + 1);
        state.notify_of_files(Severity::Warning, text);
    }
    effects
}

/// Opens photographs, and shows and analyzes the last; the others are analyzed when they are shown. The pictures of another program are
/// read for the last photograph, or for that of the workspace, which is read after the photographs.
fn open_together(
    state: &mut State,
    photographs: Vec<Result<Arc<Picture>, String>>,
    elsewhere: ElsewherePaths,
    workspace: Option<PathBuf>,
) -> Vec<Effect> {
    (state.jobs.reading, state.restoring) = (None, None);
    let (mut beside, of_workspace) = match workspace {
        Some(_) => (ElsewherePaths::default(), elsewhere),
        None => (elsewhere, ElsewherePaths::default()),
    };
    let last = photographs.len().saturating_sub(1);
    let (mut effects, mut failures) = (Vec::new(), Vec::new());
    for (index, photograph) in photographs.into_iter().enumerate() {
        let of_this = if index == last { std::mem::take(&mut beside) } else { ElsewherePaths::default() };
        match photograph {
            Ok(picture) => effects = open_picture(state, picture, &of_this),
            Err(reason) => failures.push(with_unopened(reason, &of_this)),
        }
    }
    for reason in failures {
        // The photograph of the workspace is opened after these.
        match workspace {
            Some(_) => state.notify_of_files(Severity::Error, reason),
            None => state.notify(Severity::Error, reason),
        }
    }
    effects.extend(workspace.map(|path| Effect::ReadWorkspace { path, elsewhere: of_workspace }));
    effects
}

/// Puts the file of a photograph first in the list of recent photographs.
fn remember(state: &mut State, origin: &Origin) {
    if let Some(path) = origin.path() {
        state.recent.retain(|known| known != path);
        state.recent.insert(0, path.to_path_buf());
        state.recent.truncate(MOST_RECENT);
    }
}

/// Shows a photograph that was read, analyzes it, and reads the pictures of another program of it, for the image view to show.
fn open_picture(state: &mut State, picture: Arc<Picture>, elsewhere: &ElsewherePaths) -> Vec<Effect> {
    state.jobs.reading = None;
    remember(state, &picture.origin);
    let restored = state.restoring.take().filter(|restoring| restoring.workspace.origin == picture.origin);
    if restored.is_none()
        && let Some(mut effects) = show_open(state, &picture)
    {
        effects.extend(reading_of(elsewhere, true));
        return effects;
    }
    let warnings = picture.photo.warnings.iter().map(|warning| warning_of(&picture, warning));
    let warnings: Vec<String> = warnings.collect();
    let params = state.document.params;
    // A photograph that is read again, with another encoding or by a workspace, replaces itself.
    let is_other = state.picture.as_ref().is_some_and(|shown| shown.origin != picture.origin);
    if is_other {
        keep_open(state);
    }
    let earlier = state.others.iter().position(|other| other.picture.origin == picture.origin);
    let earlier = earlier.map(|index| state.others.remove(index));
    // The pictures of another program of a photograph that is read again are read again too, and stay until then.
    let of_shown = state.elsewhere.take();
    state.elsewhere = earlier
        .filter(|earlier| earlier.picture.size() == picture.size())
        .and_then(|earlier| earlier.elsewhere);
    let again = of_shown.as_ref().or(state.elsewhere.as_ref());
    let again = again.map_or_else(ElsewherePaths::default, |all| all.paths.clone());
    let mut saved = again.except(elsewhere);
    state.leave_photograph();
    state.picture = Some(picture);
    // Masks belong to one picture; parameters stay.
    state.document = Document { params, ..Document::default() };
    state.history.forget();
    state.newest = None;
    state.pinned = None;
    state.found_light = None;
    state.workspace_path = None;
    state.view.image.center_px = None;
    state.view.image.zoom = None;
    state.view.profile = ProfileLine::Row;
    for warning in warnings {
        state.notify(Severity::Warning, warning);
    }
    state.awaited.preselects = restored.is_none();
    if let Some(Restoring { workspace, path }) = restored {
        saved = workspace.elsewhere.except(elsewhere);
        restore_workspace(state, *workspace);
        state.workspace_path = Some(path);
    } else if is_other {
        tell_of_parameters(state);
    }
    state.saved = state.document.clone();
    if let Some(after) = &state.awaited.after_pin {
        // The parameters of the document are those of the pinned result, which is computed first.
        state.saved.params = after.params;
    }
    forget_defaults(state);
    for kind in ElsewhereKind::ALL {
        if elsewhere.get(kind).or(saved.get(kind)).is_none() {
            state.leave_layers_of(kind);
        }
    }
    let mut effects = analyze(state);
    effects.extend(reading_of(elsewhere, true));
    effects.extend(reading_of(&saved, false));
    effects
}

/// The reading of the pictures of another program; `shows`: whether the image view is to show them.
pub(super) fn reading_of(paths: &ElsewherePaths, shows: bool) -> Vec<Effect> {
    let read = |(kind, path): (ElsewhereKind, &std::path::Path)| Effect::ReadElsewhere {
        kind,
        path: path.to_owned(),
        shows,
    };
    paths.files().map(read).collect()
}

/// Restores the parts of a workspace other than its photograph, which is open by now.
fn restore_workspace(state: &mut State, workspace: Workspace) {
    let Some(size) = state.picture.as_ref().map(|picture| picture.size()) else { return };
    let Workspace { params, pinned, area, item, marked, named_marks, view, .. } = workspace;
    let show_pinned = view.show_pinned;
    // Theme and size of the texts are choices for the whole program: a workspace does not change them.
    let ViewSettings { theme, text_size, .. } = state.view;
    state.view = ViewSettings { show_pinned: false, theme, text_size, ..view };
    let mut mask = |what: &str, runs: Option<MaskRuns>| {
        let runs = runs?;
        let mask = runs.mask().filter(|mask| (mask.width(), mask.height()) == size);
        if mask.is_none() {
            let text = format!("the workspace's {what} belongs to a picture of another size: it is left out");
            state.notify(Severity::Warning, text);
        }
        mask.map(Arc::new)
    };
    let (area, marked) = (mask("area", area), mask("selection", marked));
    let named = named_marks
        .into_iter()
        .filter_map(|saved| {
            Some(NamedMark::new(saved.name, saved.color, mask("named mark", Some(saved.pixels))?))
        })
        .collect();
    state.document.selection.named = Arc::new(NamedMarks { marks: named, active: None });
    state.document.area = area;
    state.document.selection.marked = marked;
    if let Some(pinned) = pinned {
        state.document.params = pinned;
        state.awaited.after_pin = Some(AfterPin { params, item, show_pinned });
    } else {
        (state.document.params, state.document.selection.item) = (params, item);
    }
}

/// Shows a result, unless it is another photograph's or older than the one shown.
fn show_result(state: &mut State, shown: Arc<ResultSnapshot>) -> Vec<Effect> {
    let same_picture = state.picture.as_ref().is_some_and(|picture| Arc::ptr_eq(picture, &shown.picture));
    let newer = state.newest.as_ref().is_none_or(|newest| {
        (shown.generation, shown.stale_from.is_none()) >= (newest.generation, newest.stale_from.is_none())
    });
    // What a canceled analysis had still to say is not heard, unless it is the whole result.
    let is_canceled = shown.stale_from.is_some() && state.jobs.analysis.is_none();
    if !same_picture || !newer || is_canceled {
        return Vec::new();
    }
    if shown.stale_from.is_none() {
        state.preview = state.preview.take().filter(|preview| preview.shown.generation > shown.generation);
    }
    let is_last = shown.generation == state.generation && shown.stale_from.is_none();
    if is_last {
        state.jobs.analysis = None;
        if shown.params.illuminant == IlluminantSetting::Auto {
            state.found_light = shown.analysis.illuminant.map(|light| light.direction);
        }
    }
    if !state.awaited.is_numbered {
        follow_region(state, &shown);
    }
    state.awaited.is_numbered &= !is_last;
    if is_last && std::mem::take(&mut state.awaited.preselects) {
        select_largest_region(state, &shown);
    }
    if is_last && std::mem::take(&mut state.awaited.selects_region) && state.document.selection.item.is_none()
    {
        state.document.selection.item = largest_region(&shown);
    }
    replace_newest(state, shown);
    let Some(after) = state.awaited.after_pin.take_if(|_| is_last) else { return Vec::new() };
    state.pinned = state.newest.clone();
    state.view.show_pinned = after.show_pinned;
    (state.document.params, state.document.selection.item) = (after.params, after.item);
    state.awaited.is_numbered = true;
    analyze(state)
}

/// Takes a result for the newest one. The last complete one is kept while some stages of the newest are still to be computed.
fn replace_newest(state: &mut State, shown: Arc<ResultSnapshot>) {
    let is_complete = |result: &Arc<ResultSnapshot>| result.stale_from.is_none();
    let before = state.newest.take().filter(is_complete).or(state.last_complete.take());
    state.last_complete = before.filter(|_| !is_complete(&shown));
    state.newest = Some(shown);
}

/// Shows the result for the working picture, unless the whole result or a newer one is there.
fn show_preview(state: &mut State, preview: Preview) {
    let same_picture =
        state.picture.as_ref().is_some_and(|picture| Arc::ptr_eq(picture, &preview.shown.picture));
    let generation = preview.shown.generation;
    let newest = state.newest.as_ref().filter(|newest| newest.stale_from.is_none());
    let is_newer = newest.is_none_or(|newest| newest.generation < generation)
        && state.preview.as_ref().is_none_or(|shown| shown.shown.generation < generation);
    // What a canceled analysis had still to say is not heard.
    let is_canceled = state.jobs.analysis.is_none() && generation <= state.generation;
    if same_picture && is_newer && !is_canceled {
        state.preview = Some(preview);
    }
}

/// Selects the largest region, where a person has neither selected nor marked anything. The selection is no step of the history.
fn select_largest_region(state: &mut State, shown: &ResultSnapshot) {
    if state.document.selection.is_empty() {
        state.document.selection.item = largest_region(shown);
    }
}

/// The largest region of a result, of regions of one size the first.
fn largest_region(shown: &ResultSnapshot) -> Option<Item> {
    let regions = shown.analysis.intrinsic.regions.iter();
    regions.rev().max_by_key(|region| region.pixels).map(|region| Item::Region(region.id))
}

/// Selects the region of the new result that overlaps the selected region most.
fn follow_region(state: &mut State, shown: &ResultSnapshot) {
    let Some(Item::Region(region)) = state.document.selection.item else { return };
    let Some(before) = &state.newest else { return };
    let followed = crate::view::best_overlap(before.labels(), shown.labels(), region);
    state.document.selection.item = followed.map(Item::Region);
    if let Some(Item::Region(_)) = state.hover {
        state.hover = None;
    }
}
