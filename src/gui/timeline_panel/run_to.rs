//! The menu "Run to" with the goals that the cursor can run to.

use crate::app::{Command, DebugCommand, Direction, Goal};
use crate::gui::PanelContext;
use crate::gui::action::{Action, DebugAction};
use crate::gui::move_cursor::selected;
use crate::gui::shortcuts::keys_of;
use crate::gui::theme::SMALL_PT;
use crate::trace::Kind;
use egui::{Button, RichText, Ui};

/// Kinds of steps, grouped by section of the paper.
const GROUPS: [(&str, &[Kind]); 7] = [
    ("Stages and passes", &[Kind::Stage, Kind::Pass, Kind::Masks]),
    ("Windows and areas (5.2)", &[Kind::Windows, Kind::Window, Kind::Merge]),
    (
        "Linear hypotheses (5.3)",
        &[
            Kind::Hypothesis,
            Kind::PassedOver,
            Kind::Seeds,
            Kind::Growth,
            Kind::Refit,
            Kind::Absorbed,
            Kind::Merged,
        ],
    ),
    (
        "Highlights and planes (5.4)",
        &[Kind::Candidate, Kind::Highlight, Kind::Illuminant, Kind::Votes, Kind::LightChoice, Kind::Slice],
    ),
    (
        "Clipping, numbers, vectors (5.5, 6)",
        &[Kind::Hole, Kind::Dropped, Kind::Part, Kind::Numbers, Kind::Ambient, Kind::Branches, Kind::Vectors],
    ),
    ("Where no region holds", &[Kind::LocalSplit, Kind::Blobs, Kind::Blob, Kind::Plausibility, Kind::Repair]),
    ("Pixels", &[Kind::Claim, Kind::Refusal, Kind::Label]),
];

/// Shows the menu's button.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    let menu = ui.menu_button("Run to", |ui| {
        let direction =
            if ui.input(|input| input.modifiers.shift) { Direction::Back } else { Direction::Forward };
        let mut chosen = None;
        let goal = selected(cx.state);
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
        let any = cx.state.view.debug.breakpoints.iter().any(|breakpoint| breakpoint.enabled);
        let keys = keys_of(ui.ctx(), Action::Debug(DebugAction::Breakpoint(Direction::Forward)));
        let button = ui.add_enabled(any, Button::new("Next breakpoint").shortcut_text(keys));
        if button.on_disabled_hover_text("There is none that is enabled.").clicked() {
            chosen = Some(Goal::Breakpoint);
        }
        ui.separator();
        for (title, kinds) in GROUPS {
            ui.menu_button(title, |ui| {
                for &kind in kinds {
                    if ui.button(kind.name()).clicked() {
                        chosen = Some(Goal::Kind(kind));
                    }
                }
            });
        }
        ui.label(RichText::new("With Shift: the one before").size(SMALL_PT).color(cx.tones.quiet));
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
        let mut listed: Vec<Kind> = GROUPS.iter().flat_map(|(_, kinds)| kinds.iter().copied()).collect();
        listed.sort_unstable();
        assert_eq!(listed, Kind::ALL);
    }
}
