//! What the window says and offers while the photograph has no result for the present parameters and none is being computed: the analysis
//! was canceled, or ended by an error.

use super::action::Action;
use super::shortcuts::keys_of;
use super::theme::{BODY_PT, SMALL_PT};
use super::{PanelContext, widgets};
use crate::app::{NOT_ANALYZED, State};
use egui::{Button, Label, Link, RichText, Ui};

/// Name of the button, the link and the command that analyze.
pub const ANALYZE_NOW: &str = "Analyze now";

/// Shows in the status line that there is no result for the present parameters, and the button that analyzes.
pub fn show_status(ui: &mut Ui, cx: &mut PanelContext) {
    let keys = keys_of(ui.ctx(), Action::Analyze);
    let tip = format!("Analyze the photograph with the present parameters ({keys}).");
    let button = Button::new(RichText::new(ANALYZE_NOW).size(SMALL_PT).color(cx.palette.accent)).small();
    if ui.add(button).on_hover_text(tip).clicked() {
        cx.act(Action::Analyze);
    }
    let (text, why) = if cx.state.newest.is_none() && cx.state.preview.is_some() {
        (
            "preview",
            "The analysis was canceled, or ended by an error. What is shown was found in a smaller picture.",
        )
    } else {
        let why = "The analysis was canceled, or ended by an error. What is shown of a result belongs to other parameters.";
        ("not analyzed", why)
    };
    let text = RichText::new(text).size(SMALL_PT).color(cx.palette.warning);
    ui.add(Label::new(text).selectable(false)).on_hover_text(why);
}

/// Shows, in place of the verdict, that the result shown belongs to other parameters or that there is none, and the link that analyzes.
pub fn show_in_place_of_verdict(ui: &mut Ui, cx: &mut PanelContext) {
    let text = if cx.state.newest.is_some() {
        "This result belongs to other parameters."
    } else if cx.state.preview.is_some() {
        "This is a preview in larger pixels: the analysis was canceled."
    } else {
        "This photograph is not analyzed."
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = 0.0;
        ui.label(RichText::new(text).size(BODY_PT).color(cx.palette.warning));
        if ui.add(Link::new(RichText::new(ANALYZE_NOW).size(BODY_PT))).clicked() {
            cx.act(Action::Analyze);
        }
    });
}

/// Shows the sentence of a panel that has nothing to show. `otherwise`: the sentence of a photograph that has a result or is being analyzed.
pub fn placeholder(ui: &mut Ui, cx: &PanelContext, otherwise: &str) {
    let text = if has_none(cx.state) { NOT_ANALYZED } else { otherwise };
    widgets::placeholder(ui, cx.palette, text);
}

/// Whether the photograph has no result at all, and none is being computed.
pub fn has_none(state: &State) -> bool {
    state.lacks_result() && state.newest.is_none()
}
