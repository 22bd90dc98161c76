//! What the dialogs that open a file show beside the path.

use super::typed_path::unique_names;
use super::{PanelContext, widgets};
use crate::app::JobCommand;
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::{ElsewhereKind, Origin};
use egui::{RichText, Ui};

/// Shows the sample scenes and the photographs opened before. Returns whether one was chosen.
pub fn samples_and_recent(ui: &mut Ui, cx: &mut PanelContext) -> bool {
    let mut chosen: Option<JobCommand> = None;
    ui.add_space(4.0);
    widgets::heading(ui, cx.palette, "Sample scenes");
    for sample in &SAMPLES {
        let tip = format!("{} Rendered, with its ground truth.", sample.about);
        if ui.link(sample.name).on_hover_text(tip).clicked() {
            chosen = Some(JobCommand::Open(Origin::Sample(sample.name.to_owned())));
        }
    }
    if ui.link(THREE_LAMPS.name).on_hover_text(THREE_LAMPS.about).clicked() {
        chosen = Some(JobCommand::open_samples(&THREE_LAMPS));
    }
    if !cx.state.recent.is_empty() {
        widgets::heading(ui, cx.palette, "Recent");
        for (path, name) in cx.state.recent.iter().zip(unique_names(&cx.state.recent)) {
            if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
                chosen = Some(JobCommand::Open(Origin::File(path.clone())));
            }
        }
    }
    let is_chosen = chosen.is_some();
    if let Some(command) = chosen {
        cx.send(command);
    }
    is_chosen
}

/// Shows what a file of another program is to hold.
pub fn elsewhere_note(ui: &mut Ui, cx: &PanelContext, kind: ElsewhereKind) {
    let text = match kind {
        ElsewhereKind::Labels => {
            "A picture of the photograph's size: gray of 8 or 16 bits with 0 for no label, or one color for each label and black for none; not smoothed, no JPEG."
        }
        ElsewhereKind::Diffuse => {
            "The photograph without its highlights, of the photograph's size, read as the photograph is (menu Read as)."
        }
    };
    ui.add(egui::Label::new(RichText::new(text).color(cx.palette.secondary)).wrap());
}
