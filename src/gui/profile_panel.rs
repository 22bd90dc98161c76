//! The profile panel: amounts of body, surface and noise along a line, as in the paper's color figure 11.

mod chart;

use super::{PanelContext, context_menu, popup_scroll, widgets};
use crate::app::{Edit, ViewCommand};
use crate::raster::PixelIndex;
use crate::view::{Item, ProfileLine, ProfileSample, Theme, Tool, profile, profile_ends};
use chart::{Curve, ProfileChart};
use egui::{Align, Color32, Layout, Sense, Ui};

/// Identity of the samples: generation of the result, and the line's ends, hundredths of a pixel.
type SamplesKey = (u64, [[i64; 2]; 2]);

/// The profile panel.
#[derive(Default)]
pub struct ProfilePanel {
    samples: Option<(SamplesKey, Vec<ProfileSample>)>,
    /// Names of the curves that a person has hidden.
    hidden: Vec<&'static str>,
    /// The pixel that the context menu is about, once it was opened.
    menu_pixel: Option<PixelIndex>,
}

/// The colors of a curve in both themes.
#[derive(Clone, Copy)]
struct CurveColors {
    dark: [u8; 3],
    light: [u8; 3],
}

impl CurveColors {
    fn of(self, theme: Theme) -> Color32 {
        widgets::color(if theme == Theme::Dark { self.dark } else { self.light })
    }
}

/// The colors of a curve in the dark and in the light theme.
const fn colors(dark: [u8; 3], light: [u8; 3]) -> CurveColors {
    CurveColors { dark, light }
}

/// A curve: name, colors, and the value of a sample in counts (`None` in no region).
type CurveRow = (&'static str, CurveColors, fn(&ProfileSample) -> Option<f32>);

const CURVES: [CurveRow; 6] = [
    ("R", colors([0xB0, 0x5A, 0x52], [0xB0, 0x48, 0x40]), |sample| Some(sample.input[0])),
    ("G", colors([0x5C, 0x8E, 0x5A], [0x3C, 0x78, 0x3C]), |sample| Some(sample.input[1])),
    ("B", colors([0x5C, 0x7C, 0xB8], [0x38, 0x5C, 0xA4]), |sample| Some(sample.input[2])),
    ("body m_b", colors([0xD4, 0xCF, 0x62], [0x6E, 0x68, 0x00]), |sample| sample.body),
    ("surface m_s", colors([0x8F, 0xD3, 0xE8], [0x1E, 0x78, 0x96]), |sample| sample.surface),
    ("noise \u{3b5}", colors([0xA8, 0x8C, 0xD8], [0x70, 0x50, 0xA8]), |sample| sample.noise),
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
        // A click selects a region, and its pixel is the one that is explained.
        let through = selected.or(hovered).or(cx.state.explained_pixel());
        let ends = profile_ends(cx.state.view.profile, &picture, through);
        // At the debugger's cursor nothing is split yet.
        let is_split = cx.state.followed().is_none();
        let shown = cx.state.shown().filter(|_| is_split);
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
            plot(ui, cx, samples, hovered, &mut self.hidden, &mut self.menu_pixel);
        });
    }
}

/// Shows the choice of the line, the ends of the line, and the button "Copy".
fn toolbar(ui: &mut Ui, cx: &mut PanelContext, ends: [[f32; 2]; 2], samples: &[ProfileSample], width: usize) {
    let now = cx.state.view.profile;
    ui.horizontal(|ui| {
        for (line, name, tip) in [
            (ProfileLine::Row, "row", "Along the row of the selected, hovered or clicked pixel."),
            (ProfileLine::Column, "column", "Along the column of the selected, hovered or clicked pixel."),
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
        let places = format!("{x0:.0}, {y0:.0} \u{2192} {x1:.0}, {y1:.0}");
        let places = egui::RichText::new(places).color(cx.palette.secondary);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.small_button("Copy").on_hover_text("The numbers as CSV.").clicked() {
                ui.ctx().copy_text(crate::view::profile_csv(samples, width));
            }
            // In a narrow panel the places are cut with dots, and whole in the tooltip.
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(egui::Label::new(places).truncate());
            });
        });
    });
}

/// Draws the curves, and sends the pixel under the pointer as hovered. A click selects that pixel; the secondary button opens its menu.
fn plot(
    ui: &mut Ui,
    cx: &mut PanelContext,
    samples: &[ProfileSample],
    hovered: Option<PixelIndex>,
    hidden: &mut Vec<&'static str>,
    menu_pixel: &mut Option<PixelIndex>,
) {
    let theme = cx.state.view.theme;
    let all: Vec<Curve> = CURVES
        .iter()
        .map(|&(name, colors, value)| Curve { name, color: colors.of(theme), runs: runs(samples, value) })
        .collect();
    let position = |pixel: PixelIndex| samples.iter().find(|sample| sample.pixel == pixel);
    let marked = hovered.and_then(position).map(|sample| sample.position_px);
    if !cx.is_export {
        chart::legend(ui, cx.palette, &all, hidden, marked);
    }
    let shown: Vec<Curve> = all.into_iter().filter(|curve| !hidden.contains(&curve.name)).collect();
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::CLICK);
    if rect.width() < 48.0 || rect.height() < 48.0 {
        return;
    }
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, "Profile along the line")
    });
    let chart = ProfileChart::fit(&shown, rect);
    chart.paint(ui, cx.palette, &shown);
    if let Some(position_px) = marked {
        chart.mark(ui.painter(), cx.palette, &shown, position_px);
    }
    let pointed = response.interact_pointer_pos().or(response.hover_pos()).and_then(|pointer| {
        let at = chart.position_at(pointer);
        let distance = |sample: &&ProfileSample| (sample.position_px - at).abs();
        samples.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    });
    if let Some(sample) = pointed {
        // The row or column through a pixel of the line is the line.
        cx.hover(Item::Pixel(sample.pixel));
        if response.clicked() {
            cx.send(Edit::Select(Some(Item::Pixel(sample.pixel))));
        }
        if response.secondary_clicked() {
            *menu_pixel = Some(sample.pixel);
        }
    }
    if let Some(pixel) = *menu_pixel {
        popup_scroll::context_menu(&response, |ui| context_menu::of_pixel_alone(ui, cx, pixel));
    }
}

/// The runs of consecutive samples with a value, as points: position in pixels, value in counts.
fn runs(samples: &[ProfileSample], value: fn(&ProfileSample) -> Option<f32>) -> Vec<Vec<[f32; 2]>> {
    let point = |sample: &ProfileSample| Some([sample.position_px, value(sample)?]);
    let known = samples.chunk_by(|a, b| value(a).is_some() == value(b).is_some());
    known.map(|run| run.iter().filter_map(point).collect::<Vec<_>>()).filter(|run| !run.is_empty()).collect()
}
