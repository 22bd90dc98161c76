//! One block of the inspector: subject and verdict, what the verdict means, the values against their thresholds, section and actions.

use super::actions::{self, Subject};
use super::distances;
use crate::gui::theme::{BODY_PT, SMALL_PT, heading_font};
use crate::gui::{PanelContext, threshold_bar, widgets};
use crate::raster::PixelIndex;
use crate::view::{Amounts, Inspection, Item, PixelAmounts, Tone};
use egui::accesskit::Role;
use egui::{Color32, Label, RichText, Ui, WidgetInfo};

/// Shows the findings about a subject.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, found: &Inspection, subject: Subject) {
    ui.spacing_mut().item_spacing.y = 3.0;
    head(ui, cx, found, subject);
    if !found.sentence.is_empty() {
        let sentence = widgets::unbroken(&found.sentence);
        let sentence = widgets::with_subscripts(&sentence, SMALL_PT, cx.palette.text);
        ui.add(Label::new(sentence).wrap());
    }
    if let Subject::Hovered(Item::Pixel(pixel)) | Subject::Selected(Item::Pixel(pixel)) = subject {
        color_and_amounts(ui, cx, pixel);
    }
    threshold_bar::show(ui, cx.palette, &found.tests);
    if let Some((region, tests)) = &found.of_region {
        let text = format!("Its region {region} does not hold");
        ui.label(RichText::new(text).size(SMALL_PT).color(cx.palette.warning)).on_hover_text(
            "The pixel is split by its region's plane only where the region holds (section 6).",
        );
        threshold_bar::show(ui, cx.palette, tests);
    }
    if matches!(subject, Subject::Selected(Item::Pixel(_))) {
        ui.scope(|ui| distances::show(ui, cx));
    }
    actions::show(ui, cx, found, subject);
    ui.add_space(6.0);
}

/// Shows the subject, the verdict and the section in a line that wraps.
fn head(ui: &mut Ui, cx: &PanelContext, found: &Inspection, subject: Subject) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        let verdict = RichText::new(&found.verdict).font(heading_font(BODY_PT));
        let verdict = ui.add(Label::new(verdict.color(tone_color(cx, found.tone))));
        let name = format!("Verdict: {}", found.verdict);
        verdict.widget_info(|| WidgetInfo::labeled(Role::Label, true, name.clone()));
        let how = if matches!(subject, Subject::Hovered(_)) { ", pointed at" } else { "" };
        let text = format!("{}{how} \u{b7} section {}", found.subject, found.section);
        ui.add(Label::new(RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)));
    });
}

/// The color of a verdict. A bad verdict has the color of warnings, which is readable as text.
fn tone_color(cx: &PanelContext, tone: Tone) -> Color32 {
    match tone {
        Tone::Good => cx.palette.accent,
        Tone::Bad => cx.palette.warning,
        Tone::Neutral => cx.palette.text,
    }
}

/// Shows the values of the readout: color, class and kind, and the amounts of body and surface reflection.
fn color_and_amounts(ui: &mut Ui, cx: &PanelContext, pixel: PixelIndex) {
    let Some(reading) = cx.state.reading_of(pixel) else { return };
    let quiet = |text: String| RichText::new(text).size(SMALL_PT).color(cx.palette.secondary);
    ui.horizontal_wrapped(|ui| {
        widgets::chip(
            ui,
            cx.palette,
            widgets::own_color(reading.color, cx.state.contrast()),
            "the pixel's color",
        );
        let [r, g, b] = reading.color.map(|band| widgets::signed(f64::from(band), 1));
        ui.label(quiet(format!("{r} {g} {b} counts")));
        let Some(analyzed) = &reading.analyzed else { return };
        if let Some(class) = analyzed.class {
            ui.label(quiet(format!("window {}", class.name())))
                .on_hover_text("Class of its window (section 5.2.1).");
        }
    });
    if let Some(amounts) = reading.analyzed.as_ref().and_then(|analyzed| analyzed.amounts.as_ref()) {
        let text = widgets::with_subscripts(&amounts_text(amounts), SMALL_PT, cx.palette.secondary);
        ui.add(Label::new(text).wrap());
    }
}

/// The amounts of body and surface reflection in the result, and as measured where the two differ.
fn amounts_text(amounts: &PixelAmounts) -> String {
    let counts = |value: f32| widgets::signed(f64::from(value), 1);
    let text = |of: &Amounts| {
        let surface = of.surface.map_or_else(String::new, |surface| format!(", m_s {}", counts(surface)));
        format!("m_b {}{surface}", counts(of.body))
    };
    let result = format!("result {}, \u{3b5} {}", text(&amounts.result), counts(amounts.result.noise));
    match amounts.different_measured() {
        Some(measured) => format!("{result}; measured {}, before the cut at noise", text(&measured)),
        None => result,
    }
}
