//! The line over the table of regions: the light's color, what it was estimated from, the ambient light, and the accuracy against the
//! ground truth.

use super::vector;
use crate::describe::{ambient_reason, light_reason};
use crate::gui::theme::{BODY_PT, SMALL_PT};
use crate::gui::{PanelContext, widgets};
use crate::segment::{Illuminant, LightBasis, LightFindings};
use crate::view::{ResultSnapshot, Separator, WIDE_INTERVAL_DEG, regions_text};
use egui::{Align, Label, Layout, RichText, Ui};

/// Width of the button "Copy" with its margin, points.
const COPY_PT: f32 = 56.0;
/// Angle between a given light and the light found in the picture from which the given light counts as far away, degrees.
const FAR_LIGHT_DEG: f64 = 10.0;

/// Shows the light's color, what it was estimated from, and the accuracy against the ground truth.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot) {
    let findings = &shown.analysis.finals.light;
    let copy = |ui: &mut Ui| {
        if ui.small_button("Copy").on_hover_text("The table as text, separated by tabs.").clicked() {
            ui.ctx().copy_text(regions_text(shown, Separator::Tab));
        }
    };
    let contents = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing = egui::vec2(6.0, 2.0);
        // A text that does not fit begins another line.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let tip = match findings.basis {
            LightBasis::Average => {
                "The color of the light: the average direction of all highlight clusters (section 5.4.1)."
            }
            LightBasis::ByHand => {
                "The color of the light: the direction of the highlight line of the marked pixels (section 6)."
            }
            _ => {
                "The color of the light: where the dichromatic planes of all objects intersect (section 5.4)."
            }
        };
        ui.label(RichText::new("light").color(cx.palette.secondary)).on_hover_text(tip);
        if let Some(light) = &shown.analysis.illuminant {
            vector(ui, cx.palette, "color of the light", Some(light.direction), true);
            let is_wide = findings.claimed_interval_deg().is_some_and(|degrees| degrees >= WIDE_INTERVAL_DEG);
            let tone = if is_wide { cx.palette.warning } else { cx.palette.secondary };
            let from = RichText::new(basis_text(light, findings)).size(SMALL_PT).color(tone);
            ui.label(from).on_hover_text(light_reason(findings));
            distance_from_found(ui, cx, light, findings);
        } else {
            let is_sought = findings.basis != LightBasis::NotSought;
            let text = format!("{}{}", if is_sought { "unknown: " } else { "" }, light_reason(findings));
            ui.add(Label::new(&text).truncate().show_tooltip_when_elided(false)).on_hover_text(text);
        }
        second_lamp(ui, cx, findings);
        ambient(ui, cx, shown);
        accuracy(ui, cx, shown);
    };
    ui.horizontal_top(|ui| {
        let room = (ui.available_width() - COPY_PT).max(80.0);
        ui.allocate_ui(egui::vec2(room, ui.spacing().interact_size.y), |ui| ui.horizontal_wrapped(contents));
        ui.with_layout(Layout::right_to_left(Align::Min), copy);
    });
}

/// Shows how far a given light lies from the light that was found in the picture before, if the light found is known.
fn distance_from_found(ui: &mut Ui, cx: &PanelContext, light: &Illuminant, findings: &LightFindings) {
    let Some(found) = cx.state.found_light.filter(|_| findings.basis == LightBasis::Given) else { return };
    let angle_deg = angle_between_deg(light.direction, found);
    let tone = if angle_deg >= FAR_LIGHT_DEG { cx.palette.warning } else { cx.palette.secondary };
    let text = format!("{angle_deg:.1}\u{b0} from the light found");
    ui.label(RichText::new(text).size(SMALL_PT).color(tone))
        .on_hover_text("Angle between the given light and the light that the picture itself gave.");
}

/// The angle between two unit vectors, degrees.
fn angle_between_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cosine: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    cosine.clamp(-1.0, 1.0).acos().to_degrees()
}

/// Shows the color of the second lamp (section 7.5), if there is one.
fn second_lamp(ui: &mut Ui, cx: &PanelContext, findings: &LightFindings) {
    let (Some(second), Some(angle_deg)) = (findings.second, findings.lamps_angle_deg()) else { return };
    let tip = if second.given {
        "A second lamp that was given (section 7.5): the highlights of these regions agree better with it than with the first light. \
         Each region is split with the lamp of its own highlights."
    } else {
        "A second lamp of another color (section 7.5): the highlights of these regions contradict the first light and agree on \
         this one. Each region is split with the lamp of its own highlights."
    };
    ui.label(RichText::new("second lamp").color(cx.palette.secondary)).on_hover_text(tip);
    vector(ui, cx.palette, "color of the second lamp", Some(second.direction), true);
    let objects = crate::describe::counted(second.regions, "object");
    let from = match second.interval_deg {
        Some(interval_deg) => format!("from {objects}, \u{b1}{interval_deg:.1}\u{b0}"),
        None => format!("given, lights {objects}"),
    };
    let text = format!("{from}, {angle_deg:.1}\u{b0} from the first");
    let is_idle = second.given && second.regions == 0;
    let tone = if is_idle { cx.palette.warning } else { cx.palette.secondary };
    ui.label(RichText::new(text).size(SMALL_PT).color(tone)).on_hover_text(tip);
}

/// Shows the counts subtracted as ambient light (section 7.5), if any.
fn ambient(ui: &mut Ui, cx: &PanelContext, shown: &ResultSnapshot) {
    let ambient = &shown.analysis.intrinsic.ambient;
    let Some(counts) = ambient.subtracted else { return };
    let spread = ambient.meeting.map_or(String::new(), |meeting| {
        let [r, g, b] = meeting.sd_counts;
        format!(" Standard deviations {r:.1}, {g:.1}, {b:.1} counts, from {} matte lines.", meeting.lines)
    });
    let tip = format!("Light from everywhere (section 7.5): {}.{spread}", ambient_reason(ambient.verdict));
    ui.label(RichText::new("ambient").color(cx.palette.secondary)).on_hover_text(&tip);
    let text = counts.map(|band| format!("{band:.1}")).join(" ");
    ui.label(format!("{text} counts")).on_hover_text(tip);
}

/// What the light was estimated from, and its interval, degrees.
fn basis_text(light: &Illuminant, findings: &LightFindings) -> String {
    let from = |what: &str| crate::describe::counted(light.objects, what);
    let from = match findings.basis {
        LightBasis::Given => return "given".to_owned(),
        LightBasis::Average => format!("average of {}", from("highlight")),
        LightBasis::ByHand => "of the marked pixels".to_owned(),
        LightBasis::Votes => format!("by {}", from("small highlight")),
        LightBasis::Planes | LightBasis::Nothing | LightBasis::NotSought => {
            format!("from {}", from("object"))
        }
    };
    findings
        .claimed_interval_deg()
        .map_or_else(|| from.clone(), |degrees| format!("{from}, \u{b1}{degrees:.1}\u{b0}"))
}

/// Shows the errors against the ground truth, and beside the score of the body image that of the unchanged photograph.
fn accuracy(ui: &mut Ui, cx: &PanelContext, shown: &ResultSnapshot) {
    let Some(scores) = shown.accuracy().map(|accuracy| &accuracy.scores) else { return };
    let fact = |ui: &mut Ui, name: &str, value: String, tip: &str| {
        // One widget, so that a wrapped row does not part name and value.
        let mut text = widgets::with_subscripts(name, SMALL_PT, cx.palette.secondary);
        let gap = if name.is_empty() { 0.0 } else { 6.0 };
        let font_id = egui::FontId::proportional(BODY_PT);
        let format = egui::TextFormat { font_id, color: cx.palette.text, ..egui::TextFormat::default() };
        text.append(&value, gap, format);
        ui.label(text).on_hover_text(tip);
    };
    if shown.analysis.illuminant.is_some() {
        let tip = "Angle between the light found and the scene's true light.";
        fact(ui, "light off by", format!("{:.2}\u{b0}", scores.illum_deg), tip);
    }
    if let Some(angle) = scores.body_deg {
        let tip = "Mean angle between the regions' body vectors and the true ones.";
        fact(ui, "body vectors off by", format!("{angle:.3}\u{b0}"), tip);
    }
    if let (Some(body), Some(nothing)) = (scores.psnr_body, scores.psnr_nothing) {
        let text = format!("{body:.1} dB, doing nothing {nothing:.1} dB");
        if body < nothing {
            let tip = "Peak signal to noise ratio of the body image inside objects, lower than that of the unchanged photograph (doing nothing).";
            let text = RichText::new(format!("body image {text}: worse")).color(cx.palette.warning);
            ui.label(text).on_hover_text(tip);
        } else {
            let tip = "Peak signal to noise ratio of the body image inside objects, higher is better. Doing nothing: that of the unchanged photograph.";
            fact(ui, "body image", text, tip);
        }
    }
}
