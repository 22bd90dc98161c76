//! The menu "Run to" with the goals that the cursor can run to.

use crate::app::{Command, DebugCommand, Direction, Goal};
use crate::gui::PanelContext;
use crate::gui::action::{Action, DebugAction};
use crate::gui::move_cursor::selected_goal;
use crate::gui::popup_scroll::menu_button;
use crate::gui::shortcuts::keys_of;
use crate::gui::theme::SMALL_PT;
use crate::trace::Kind;
use egui::{Button, RichText, Ui};

/// The submenus, each with its first kind: a submenu has all kinds up to the next submenu, in the order of the table of events.
const GROUPS: [(&str, Kind); 7] = [
    ("Stages and passes", Kind::Stage),
    ("Windows and areas (5.2)", Kind::Windows),
    ("Linear hypotheses (5.3)", Kind::Hypothesis),
    ("Highlights and planes (5.4)", Kind::Candidate),
    ("Clipping, numbers, vectors (5.5, 6)", Kind::Hole),
    ("Where no region holds", Kind::LocalSplit),
    ("Pixels", Kind::Claim),
];

/// The kinds of a submenu of [`GROUPS`].
fn kinds_of(group: usize) -> impl Iterator<Item = Kind> {
    let first = GROUPS.get(group).map(|&(_, first)| first);
    let next = GROUPS.get(group + 1).map(|&(_, first)| first);
    Kind::ALL
        .into_iter()
        .filter(move |&kind| first.is_some_and(|first| kind >= first) && next.is_none_or(|next| kind < next))
}

/// Shows the menu's button.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    let menu = menu_button(ui, "Run to", |ui| {
        let direction =
            if ui.input(|input| input.modifiers.shift) { Direction::Back } else { Direction::Forward };
        let mut chosen = None;
        let goal = selected_goal(cx.state);
        let words = match goal {
            Some(Goal::Pixel(_)) => "Next change of the selected pixel",
            Some(_) => "Next change of the selected region",
            None => "Next change of what is selected",
        };
        let keys = keys_of(ui.ctx(), Action::Debug(DebugAction::Change(Direction::Forward)));
        let button = ui.add_enabled(goal.is_some(), Button::new(words).shortcut_text(keys));
        if button.on_disabled_hover_text("Select a region, or with Alt + click a pixel.").clicked() {
            chosen = goal;
        }
        let any_breakpoint = cx.state.view.debug.breakpoints.iter().any(|breakpoint| breakpoint.enabled);
        let keys = keys_of(ui.ctx(), Action::Debug(DebugAction::Breakpoint(Direction::Forward)));
        let button = ui.add_enabled(any_breakpoint, Button::new("Next breakpoint").shortcut_text(keys));
        if button.on_disabled_hover_text("There is none that is enabled.").clicked() {
            chosen = Some(Goal::Breakpoint);
        }
        ui.separator();
        for (group, (title, _)) in GROUPS.into_iter().enumerate() {
            menu_button(ui, title, |ui| {
                for kind in kinds_of(group) {
                    if ui.button(kind.name()).clicked() {
                        chosen = Some(Goal::Kind(kind));
                    }
                }
            });
        }
        ui.label(RichText::new("With Shift: the one before").size(SMALL_PT).color(cx.palette.secondary));
        if let Some(goal) = chosen {
            cx.send(Command::Debug(DebugCommand::RunTo(goal, direction)));
            ui.close();
        }
    });
    menu.response.on_hover_text("Go to where something happens next.");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_in_the_menu_once() {
        let listed: Vec<Kind> = (0..GROUPS.len()).flat_map(kinds_of).collect();
        assert_eq!(listed, Kind::ALL);
        assert!((0..GROUPS.len()).all(|group| kinds_of(group).count() > 1));
    }
}
