//! The timeline panel: all decisions of the analysis in order, the debugger's cursor, and the controls
//! that move the cursor.

mod drawing;
mod icons;
mod run_to;
mod scale;
mod tooltip;
mod track;
mod transport;

pub use track::track_id;
pub use transport::has_room_for_answers;

use super::notices::PASSING_SECONDS;
use super::{PanelContext, lacking_result, widgets};
use crate::app::{Command, DebugCommand, DebugSettings, Debugger, Missed};
use crate::describe::Names;
use crate::trace::Trace;
use egui::{Frame, Margin, RichText, Ui};
use std::time::Duration;
use track::Track;

/// The timeline panel.
#[derive(Default)]
pub struct TimelinePanel {
    track: Track,
    /// Names of hypotheses and regions, with the generation of the trace that they belong to.
    names: Option<(u64, Names)>,
    /// The move whose answer is told, and the time at which that was first told, seconds.
    answered: Option<(u64, f64)>,
}

impl TimelinePanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let state = cx.state;
        let debugger = &state.debugger;
        if state.picture.is_none() {
            return widgets::placeholder(ui, cx.palette, "The timeline appears when a photograph is open.");
        }
        if !state.view.debug.open {
            return recording_off(ui, cx);
        }
        let Some(replay) = debugger.replay.as_ref().filter(|replay| !replay.trace().is_empty()) else {
            let text = if state.lacks_trace() && state.newest.is_some() {
                "The decisions of this result are not recorded: F5 analyzes now."
            } else {
                "Recording the decisions of the analysis\u{2026}"
            };
            return lacking_result::placeholder(ui, cx, text);
        };
        let names = self.names(debugger.generation, replay.trace());
        let missed = self.missed(ui, debugger).filter(|_| has_room_for_answers(ui.max_rect()));
        Frame::new().inner_margin(Margin { left: 8, right: 8, top: 3, bottom: 5 }).show(ui, |ui| {
            transport::show(ui, cx, replay, &names, missed);
            self.track.show(ui, cx, replay, &names);
        });
    }

    /// What the last move of the cursor did not find, for as long as a notice would tell it.
    fn missed(&mut self, ui: &Ui, debugger: &Debugger) -> Option<Missed> {
        let missed = debugger.missed?;
        let now = ui.input(|input| input.time);
        let since =
            self.answered.filter(|(answered, _)| *answered == debugger.moves).map_or(now, |(_, since)| since);
        self.answered = Some((debugger.moves, since));
        let rest = PASSING_SECONDS - (now - since);
        (rest > 0.0).then(|| {
            ui.ctx().request_repaint_after(Duration::from_secs_f64(rest));
            missed
        })
    }

    /// The names of the trace's hypotheses and regions, computed once for each trace.
    fn names(&mut self, generation: u64, trace: &Trace) -> Names {
        let (known, names) = self.names.get_or_insert_with(|| (generation, Names::of(trace)));
        if *known != generation {
            (*known, *names) = (generation, Names::of(trace));
        }
        names.clone()
    }
}

/// Shows, while no decisions are recorded, a sentence and the button that starts recording.
fn recording_off(ui: &mut Ui, cx: &mut PanelContext) {
    ui.add_space((ui.available_height() / 2.0 - 14.0).max(4.0));
    ui.horizontal_wrapped(|ui| {
        ui.add_space(8.0);
        let keys = "Keep every decision of the analysis, to stop it, rewind it and ask why (D).";
        if ui.button("Record decisions").on_hover_text(keys).clicked() {
            let settings = DebugSettings { open: true, ..cx.state.view.debug.clone() };
            cx.send(Command::Debug(DebugCommand::Settings(settings)));
        }
        let text = "Nothing is recorded: the analysis is a little faster, and cannot be stopped or rewound.";
        ui.label(RichText::new(text).color(cx.palette.secondary));
    });
}
