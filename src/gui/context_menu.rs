//! Context menus: what can be done with a pixel or a region, by the secondary button of the pointer.

use super::PanelContext;
use super::action::{Action, CubeAction, LayerFile, PixelSet};
use super::cube_choices::NamedView;
use super::pane::Pane;
use super::popup_scroll::menu_button;
use super::shortcuts::keys_of;
use crate::app::{Combine, Edit, ViewCommand};
use crate::raster::{PixelIndex, RegionId};
use crate::view::{ImageSettings, Item, Layer};
use egui::{Button, Ui};
use std::sync::Arc;

/// Shows what can be done with a pixel of the photograph, and with the picture.
pub fn of_pixel(ui: &mut Ui, cx: &mut PanelContext, pixel: PixelIndex) {
    of_pixel_alone(ui, cx, pixel);
    ui.separator();
    menu_button(ui, "Layer", |ui| {
        for layer in Layer::ALL.into_iter().filter(|&layer| cx.state.lacks(layer).is_none()) {
            let is_shown = cx.state.view.image.layer == layer;
            let keys = keys_of(ui.ctx(), Action::Layer(layer));
            if ui.add(Button::selectable(is_shown, layer.name()).shortcut_text(keys)).clicked() {
                cx.send(ViewCommand::Image(ImageSettings { layer, ..cx.state.view.image.clone() }));
            }
        }
    });
    export_layer(ui, cx, cx.state.view.image.layer);
    action(ui, cx, "Fit the whole picture", Action::Fit);
    action(ui, cx, "Export\u{2026}", Action::Export);
}

/// Shows what can be done with a color of the color space and with its region, and the named views.
pub fn of_color(ui: &mut Ui, cx: &mut PanelContext, bin: Option<u32>, region: Option<RegionId>) {
    if let Some(bin) = bin {
        if ui.button("Select this color").clicked() {
            cx.send(Edit::Select(Some(Item::Bin(bin))));
        }
        ui.separator();
    }
    if let Some(region) = region {
        of_region(ui, cx, region);
        ui.separator();
    }
    for (view, key, name, tip) in NamedView::ALL {
        let is_possible = !view.is_of_plane() || cx.state.selected_region().is_some();
        let row = Button::new(name).shortcut_text(key.name());
        if ui.add_enabled(is_possible, row).on_hover_text(tip).clicked() {
            cx.act(Action::Cube(CubeAction::View(view)));
        }
    }
    ui.separator();
    action(ui, cx, "Export\u{2026}", Action::Export);
}

/// Shows what can be done with a pixel of the photograph, wherever the pixel is shown.
pub fn of_pixel_alone(ui: &mut Ui, cx: &mut PanelContext, pixel: PixelIndex) {
    let Some(picture) = cx.state.picture.clone() else { return };
    let [x, y] = pixel.position(picture.size().0);
    ui.label(format!("Pixel {x}, {y}"));
    if ui.button("Why is this pixel what it is?").clicked() {
        cx.send(Edit::Select(Some(Item::Pixel(pixel))));
        cx.act(Action::Show(Pane::Inspector));
    }
    if ui.button("Select this color in the color space").clicked() {
        cx.send(Edit::Select(picture.histogram.bin_of(pixel.index()).map(Item::Bin)));
        cx.act(Action::Show(Pane::Colors));
    }
    if ui.button("Copy place and color").clicked() {
        let [r, g, b] = picture.photo.image.pixels[pixel.index()];
        ui.ctx().copy_text(format!("{x}\t{y}\t{r}\t{g}\t{b}"));
    }
    if let Some(region) = cx.state.region_of(Item::Pixel(pixel)) {
        ui.separator();
        of_region(ui, cx, region);
    }
    if cx.state.document.selection.marked.is_some() {
        ui.separator();
        action(ui, cx, "Fit skewed T to the marked", Action::FitSkewedT);
    }
}

/// Shows what can be done with a region.
pub fn of_region(ui: &mut Ui, cx: &mut PanelContext, region: RegionId) {
    ui.label(format!("Region {region}"));
    if ui.button("Select the region").clicked() {
        cx.send(Edit::Select(Some(Item::Region(region))));
    }
    if ui.button("Show its dichromatic plane").clicked() {
        cx.send(Edit::Select(Some(Item::Region(region))));
        cx.act(Action::Show(Pane::Plane));
    }
    if ui.button("Tell how it was made").clicked() {
        cx.send(Edit::Select(Some(Item::Region(region))));
        cx.act(Action::Show(Pane::Inspector));
    }
    if ui.button("Mark its pixels").clicked()
        && let Some(shown) = cx.state.shown()
    {
        let mask = shown.labels().map(|&label| label == region.get());
        cx.send(Edit::Mark(Arc::new(mask), Combine::Replace, None));
    }
    action(ui, cx, "Export its pixels\u{2026}", Action::ExportPixels(PixelSet::Region(region)));
}

/// Shows the submenu that exports one layer as one file.
pub fn export_layer(ui: &mut Ui, cx: &mut PanelContext, layer: Layer) {
    let menu = menu_button(ui, format!("Export {}", layer.name().to_lowercase()), |ui| {
        for file in LayerFile::ALL {
            if ui.button(format!("{}\u{2026}", file.name())).clicked() {
                cx.act(Action::ExportLayer(layer, file));
            }
        }
    });
    menu.response.on_hover_text(
        "Writes this layer alone: PNG as shown, OpenEXR or NumPy with its numbers (section 6).",
    );
}

/// Shows an action with its key.
pub fn action(ui: &mut Ui, cx: &mut PanelContext, text: &str, action: Action) {
    let keys = keys_of(ui.ctx(), action);
    if ui.add(Button::new(text).shortcut_text(keys)).clicked() {
        cx.act(action);
    }
}
