//! The start screen, which the image panel shows while no photograph is open: buttons, sample scenes and photographs opened
//! before.

use super::action::Action;
use super::theme::{TITLE_PT, heading_font};
use super::typed_path::unique_names;
use super::{PanelContext, widgets};
use crate::app::JobCommand;
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::Origin;
use egui::{Button, RichText, ScrollArea, Ui};

/// Largest number of recent photographs shown.
const MOST_RECENT: usize = 6;

/// Shows the start screen.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::Frame::new().inner_margin(24).show(ui, |ui| {
            let title = "Which light is the object's, and which is the lamp's?";
            ui.label(RichText::new(title).font(heading_font(TITLE_PT)));
            ui.add_space(4.0);
            ui.label(
                RichText::new("Open a photograph: Ctrl+O, drop a file here, or paste")
                    .color(cx.palette.secondary),
            );
            ui.add_space(8.0);
            ui.horizontal_wrapped(|ui| {
                let open = Button::new(RichText::new("Open a photograph\u{2026}").color(cx.palette.accent));
                if ui.add(open).clicked() {
                    cx.act(Action::Open);
                }
                if ui.button("Open a workspace\u{2026}").clicked() {
                    cx.act(Action::OpenWorkspace);
                }
            });
            widgets::heading(ui, cx.palette, "Sample scenes");
            for sample in &SAMPLES {
                ui.horizontal_wrapped(|ui| {
                    if ui.link(sample.name).clicked() {
                        cx.send(JobCommand::Open(Origin::Sample(sample.name.to_owned())));
                    }
                    ui.label(RichText::new(sample.about).color(cx.palette.secondary));
                });
            }
            ui.horizontal_wrapped(|ui| {
                if ui.link(THREE_LAMPS.name).clicked() {
                    cx.send(JobCommand::open_samples(&THREE_LAMPS));
                }
                ui.label(RichText::new(THREE_LAMPS.about).color(cx.palette.secondary));
            });
            if !cx.state.recent.is_empty() {
                widgets::heading(ui, cx.palette, "Opened before");
                let names = unique_names(&cx.state.recent);
                for (path, name) in cx.state.recent.iter().zip(names).take(MOST_RECENT) {
                    if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
                        cx.send(JobCommand::Open(Origin::File(path.clone())));
                    }
                }
            }
        });
    });
}
