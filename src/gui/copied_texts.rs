//! Texts that are copied: the call of the program, the table of the regions, the profile.

use super::PanelContext;
use crate::app::{Severity, ViewCommand, analyze_call};
use crate::view::{Separator, profile, profile_csv, regions_text};
use egui::Ui;

/// Copies the call of the program that reproduces what is on the screen.
pub fn copy_command_line(ui: &Ui, cx: &mut PanelContext) {
    if cx.state.picture.is_some() {
        copy(ui, cx, analyze_call(cx.state), "the command line is in the clipboard");
    }
}

/// Copies the table of the regions, separated by tabs.
pub fn copy_regions(ui: &Ui, cx: &mut PanelContext) {
    if let Some(shown) = cx.state.shown() {
        copy(ui, cx, regions_text(shown, Separator::Tab), "the table of the regions is in the clipboard");
    }
}

/// Copies the numbers along the profile's line as CSV.
pub fn copy_profile(ui: &Ui, cx: &mut PanelContext) {
    let Some((picture, ends)) = cx.state.picture.as_ref().zip(cx.state.profile_ends()) else { return };
    let samples = profile(picture, cx.state.shown().map(|shown| &**shown), ends);
    copy(ui, cx, profile_csv(&samples, picture.size().0), "the profile is in the clipboard");
}

/// Copies a text, and says so.
fn copy(ui: &Ui, cx: &mut PanelContext, text: String, notice: &str) {
    ui.ctx().copy_text(text);
    cx.send(ViewCommand::Notify(Severity::Done, notice.to_owned()));
}
