//! The profile panel: amounts of body, surface and noise along a line, as in the paper's color figure 11.

use super::{PanelContext, widgets};
use crate::app::ViewCommand;
use crate::raster::PixelIndex;
use crate::view::{Item, ProfileLine, ProfileSample, Tool, profile, profile_ends};
use egui::{Color32, Ui};
use egui_plot::{Corner, HoverPosition, Legend, Line, Plot, PlotPoints, VLine};

/// Identity of the samples: generation of the result, and the line's ends, hundredths of a pixel.
type SamplesKey = (u64, [[i64; 2]; 2]);

/// The profile panel.
#[derive(Default)]
pub struct ProfilePanel {
    samples: Option<(SamplesKey, Vec<ProfileSample>)>,
}

/// A curve: name, color, and the value of a sample in counts (`None` in no region).
type Curve = (&'static str, Color32, fn(&ProfileSample) -> Option<f32>);

const CURVES: [Curve; 6] = [
    ("R", Color32::from_rgb(0xB0, 0x5A, 0x52), |sample| Some(sample.input[0])),
    ("G", Color32::from_rgb(0x5C, 0x8E, 0x5A), |sample| Some(sample.input[1])),
    ("B", Color32::from_rgb(0x5C, 0x7C, 0xB8), |sample| Some(sample.input[2])),
    ("body m_b", Color32::from_rgb(0xE8, 0xA3, 0x3D), |sample| sample.body),
    ("surface m_s", Color32::from_rgb(0x8F, 0xD3, 0xE8), |sample| sample.surface),
    ("noise \u{3b5}", Color32::from_rgb(0xA8, 0x8C, 0xD8), |sample| sample.noise),
];

impl ProfilePanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(picture) = cx.state.picture.clone() else {
            return widgets::placeholder(ui, cx.palette, "The profile appears when a photograph is open.");
        };
        let selected = match cx.state.document.selection.item {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => None,
        };
        let hovered = match cx.state.hover {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => None,
        };
        let ends = profile_ends(cx.state.view.profile, &picture, selected.or(hovered));
        let shown = cx.state.shown();
        let generation = shown.map_or(0, |shown| shown.generation);
        let key = (generation, ends.map(|end| end.map(|v| (v * 100.0) as i64)));
        if self.samples.as_ref().is_none_or(|(known, _)| *known != key) {
            self.samples = Some((key, profile(&picture, shown.map(AsRef::as_ref), ends)));
        }
        let Some((_, samples)) = &self.samples else { return };
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
            if !cx.is_export {
                toolbar(ui, cx, ends, samples, picture.size().0);
            }
            plot(ui, cx, samples, hovered);
        });
    }
}

/// Shows the choice of the line, the ends of the line, and the button "Copy".
fn toolbar(ui: &mut Ui, cx: &mut PanelContext, ends: [[f32; 2]; 2], samples: &[ProfileSample], width: usize) {
    let now = cx.state.view.profile;
    ui.horizontal(|ui| {
        for (line, name, tip) in [
            (ProfileLine::Row, "row", "Along the row of the selected or hovered pixel."),
            (ProfileLine::Column, "column", "Along the column of the selected or hovered pixel."),
        ] {
            if ui.selectable_label(now == line, name).on_hover_text(tip).clicked() {
                cx.send(ViewCommand::Profile(line));
            }
        }
        let drawn = matches!(now, ProfileLine::Between(..));
        let tip = "Along a line drawn in the image with the profile tool (P).";
        if ui.selectable_label(drawn, "line").on_hover_text(tip).clicked() {
            let image = crate::view::ImageSettings { tool: Tool::Profile, ..cx.state.view.image.clone() };
            cx.send(ViewCommand::Image(image));
        }
        let [[x0, y0], [x1, y1]] = ends.map(|end| end.map(f32::floor));
        ui.label(
            egui::RichText::new(format!("{x0:.0}, {y0:.0} \u{2192} {x1:.0}, {y1:.0}"))
                .color(cx.palette.secondary),
        );
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.small_button("Copy").on_hover_text("The numbers as CSV.").clicked() {
                ui.ctx().copy_text(crate::view::profile_csv(samples, width));
            }
        });
    });
}

/// Plots the samples, and sends the pixel under the pointer as hovered.
fn plot(ui: &mut Ui, cx: &mut PanelContext, samples: &[ProfileSample], hovered: Option<PixelIndex>) {
    let accent = cx.palette.accent;
    let plot = Plot::new("profile")
        .legend(Legend::default().position(Corner::RightTop).background_alpha(0.6))
        .x_axis_label("px along the line")
        .y_axis_label("counts")
        .label_formatter(|selected| match selected {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}\n{:.1} counts at {:.0} px", position.y, position.x))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .allow_scroll(false);
    let response = plot.show(ui, |plot| {
        for (name, color, value) in CURVES {
            // A curve has gaps where pixels are in no region.
            for part in runs(samples, value) {
                plot.line(Line::new(name, PlotPoints::from(part)).color(color).width(1.3));
            }
        }
        let position = |pixel: PixelIndex| samples.iter().find(|sample| sample.pixel == pixel);
        if let Some(sample) = hovered.and_then(position) {
            plot.vline(VLine::new("pointer", f64::from(sample.position_px)).color(accent).width(1.0));
        }
        plot.pointer_coordinate().map(|selected| selected.x)
    });
    let pointed = response.inner.filter(|_| response.response.hovered()).and_then(|x| {
        let distance = |sample: &&ProfileSample| (f64::from(sample.position_px) - x).abs();
        samples.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    });
    if let Some(sample) = pointed {
        // Hovering is sent only for a fixed line: a row or column through the hovered pixel would move
        // with the pointer.
        let fixed = matches!(cx.state.view.profile, ProfileLine::Between(..))
            || matches!(cx.state.document.selection.item, Some(Item::Pixel(_)));
        if fixed && cx.state.hover != Some(Item::Pixel(sample.pixel)) {
            cx.send(ViewCommand::Hover(Some(Item::Pixel(sample.pixel))));
        }
    }
}

/// The runs of consecutive samples with a value, as points: position in pixels, value in counts.
fn runs(samples: &[ProfileSample], value: fn(&ProfileSample) -> Option<f32>) -> Vec<Vec<[f64; 2]>> {
    let point = |sample: &ProfileSample| Some([f64::from(sample.position_px), f64::from(value(sample)?)]);
    let known = samples.chunk_by(|a, b| value(a).is_some() == value(b).is_some());
    known.map(|run| run.iter().filter_map(point).collect::<Vec<_>>()).filter(|run| !run.is_empty()).collect()
}
