//! The parameters of Phoenix: its features as boxes, its numbers as fields (section 7.2).

use crate::app::Edit;
use crate::gui::PanelContext;
use crate::gui::theme::SMALL_PT;
use crate::params::{Feature, Params, PhoenixParameter, PhoenixSettings};
use egui::{DragValue, RichText, Ui};

/// Shows the features and the numbers.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    let before = cx.state.document.params.phoenix;
    let mut settings = before;
    heading(ui, cx, "Features");
    ui.horizontal_wrapped(|ui| {
        for feature in Feature::ALL {
            let mut on = settings.features.contains(feature);
            let tip = format!("Search the histogram of this feature ({}).", feature.letter());
            if ui.checkbox(&mut on, feature.name()).on_hover_text(tip).changed() {
                settings.features = settings.features.with(feature, on);
            }
        }
    });
    heading(ui, cx, "Phoenix");
    egui::Grid::new("phoenix").num_columns(3).show(ui, |ui| {
        for parameter in PhoenixParameter::ALL {
            number(ui, parameter, &mut settings);
            ui.end_row();
        }
    });
    if settings != before {
        let params = Params { phoenix: settings, ..cx.state.document.params };
        cx.send(Edit::SetParams(Box::new(params)));
    }
}

fn heading(ui: &mut Ui, cx: &PanelContext, text: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(text).size(SMALL_PT).color(cx.palette.secondary));
}

/// Shows name, field and unit of one number.
fn number(ui: &mut Ui, parameter: PhoenixParameter, settings: &mut PhoenixSettings) {
    let [low, high] = parameter.range();
    ui.label(parameter.name()).on_hover_text(parameter.meaning());
    let field = DragValue::new(parameter.slot(settings)).range(low..=high).update_while_editing(false);
    let field = ui.add(field).on_hover_text(parameter.meaning());
    field
        .widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, parameter.name()));
    ui.label(parameter.unit());
}
