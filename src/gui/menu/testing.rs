//! The rows of the menus, for the test that compares them with the command palette.

use super::{
    analyze, color_space, decisions, edit, file, help, item, open_photographs, read_as, recent, samples, view,
};
use crate::app::State;
use crate::gui::PanelContext;
use crate::gui::action::Action;
use crate::gui::dock::Dock;
use crate::gui::theme::ThemeColors;
use crate::params::Preset;
use crate::view::Theme;
use egui::accesskit::Role;
use egui::{Context, Id, Ui};

/// Notes the action of a row, by the row's widget.
pub fn note(ui: &Ui, row: Id, action: Action) {
    ui.data_mut(|data| data.get_temp_mut_or_default::<Vec<(Id, Action)>>(Id::NULL).push((row, action)));
}

/// The actions of the rows that menus show, and the names of rows that have no action.
pub fn shown_rows(state: &State) -> (Vec<Action>, Vec<String>) {
    let (ctx, palette) = (Context::default(), ThemeColors::of(Theme::Dark));
    let (mut commands, mut actions, mut dock) = (Vec::new(), Vec::new(), Dock::default());
    let mut unnamed = Vec::new();
    let mut output = ctx.run_ui(egui::RawInput::default(), |ui| {
        let mut cx = PanelContext::new(state, &palette, &mut commands, &mut actions);
        file(ui, &mut cx);
        recent(ui, &mut cx);
        samples(ui, &mut cx);
        read_as(ui, &mut cx);
        open_photographs(ui, &mut cx);
        edit(ui, &mut cx);
        view(ui, &mut cx, &mut dock);
        color_space(ui, &mut cx);
        analyze(ui, &mut cx);
        for preset in Preset::ALL {
            item(ui, &mut cx, preset.title(), Action::Preset(preset), true);
        }
        decisions(ui, &mut cx);
        help(ui, &mut cx);
        let rows = noted(ui.ctx());
        let roles = [Role::Button, Role::CheckBox, Role::RadioButton];
        unnamed = ui.ctx().viewport(|viewport| {
            let widgets = &viewport.this_pass.widgets;
            let of_layer = widgets.layers().flat_map(|(_, rects)| rects.iter().map(|rect| rect.id));
            let infos = of_layer.filter_map(|id| Some((id, widgets.info(id)?)));
            let without = infos
                .filter(|(id, info)| roles.contains(&info.role) && rows.iter().all(|(row, _)| row != id));
            without.map(|(_, info)| info.label.clone().unwrap_or_default()).collect()
        });
    });
    output.textures_delta.clear();
    (noted(&ctx).into_iter().map(|(_, action)| action).collect(), unnamed)
}

fn noted(ctx: &Context) -> Vec<(Id, Action)> {
    ctx.data(|data| data.get_temp(Id::NULL)).unwrap_or_default()
}
