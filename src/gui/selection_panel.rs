//! The selection panel: statistics of the marked or selected pixels (number, colors, place).

use super::action::Action;
use super::background_value::{BackgroundValue, SYNCHRONOUS_PX};
use super::cursor_owners::{CursorOwners, CursorPlace};
use super::named_marks_list::NamedMarksList;
use super::theme::{BODY_PT, SMALL_PT};
use super::{PanelContext, lacking_result, widgets};
use crate::app::Edit;
use crate::raster::{Mask, UNASSIGNED};
use crate::trace::Class;
use crate::view::{Band, Item, OwnerKind, Statistics, statistics, statistics_of};
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Label, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use std::sync::Arc;

/// Height of a band's histogram, points.
const HISTOGRAM_PT: f32 = 36.0;

/// Subject of the statistics: address of the photograph, and the item, none for the marked pixels.
type Subject = (usize, Option<Item>);

/// Version of the statistics: generation of the result, address of the mask of marked pixels, and place of the debugger's cursor, where
/// that is followed.
type Version = (u64, Option<usize>, Option<CursorPlace>);

/// The selection panel.
#[derive(Default)]
pub struct SelectionPanel {
    statistics: BackgroundValue<Subject, Version, Option<Statistics>>,
    owners: CursorOwners,
    named_marks: NamedMarksList,
}

impl SelectionPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let state = cx.state;
        let Some(shown) = state.shown().cloned() else {
            let text = "Statistics appear when a photograph has been analyzed.";
            return lacking_result::placeholder(ui, cx, text);
        };
        let (marked, item) = (state.document.selection.marked.clone(), state.document.selection.item);
        let subject = match (&marked, item) {
            (Some(_), _) => "Marked pixels".to_owned(),
            (None, Some(item)) => name_of(item, shown.picture.size().0),
            (None, None) if !state.document.selection.named.marks.is_empty() => {
                let frame = egui::Frame::new().inner_margin(8);
                frame.show(ui, |ui| self.named_marks.show(ui, cx));
                return;
            }
            (None, None) => {
                let hint = "Click a region, or mark pixels with a tool of the image or the color space.";
                return widgets::placeholder(ui, cx.palette, hint);
            }
        };
        let mask_address = marked.as_ref().map(|mask: &Arc<Mask>| Arc::as_ptr(mask) as usize);
        let (place, cursor) = self.owners.get(state).unzip();
        let about = (Arc::as_ptr(&shown.picture) as usize, item.filter(|_| marked.is_none()));
        let key = (about, (shown.generation, mask_address, place));
        let synchronous = shown.labels().len() <= SYNCHRONOUS_PX;
        let make = move || match (marked, item) {
            (Some(mask), _) => statistics(&shown, &mask, cursor.as_deref()),
            (None, item) => statistics_of(&shown, item?, cursor.as_deref()),
        };
        let found = self.statistics.get(ui.ctx(), key, synchronous, make);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                self.named_marks.show(ui, cx);
                match found {
                    Some(Some(found)) => {
                        buttons(ui, cx, &subject);
                        ui.horizontal_wrapped(|ui| facts(ui, cx, found));
                        bands(ui, cx, found);
                    }
                    Some(None) => {
                        buttons(ui, cx, &subject);
                        let text = match place {
                            Some(_) => "No pixel of the picture is in it so far.",
                            None => "No pixel of the picture is in it.",
                        };
                        ui.label(RichText::new(text).color(cx.palette.secondary));
                    }
                    None => {
                        ui.label(RichText::new("counting\u{2026}").color(cx.palette.secondary));
                    }
                }
            });
        });
    }
}

/// The name of an item; `width` is the photograph's, pixels.
fn name_of(item: Item, width: usize) -> String {
    match item {
        Item::Pixel(pixel) => {
            let [x, y] = pixel.position(width);
            format!("Pixel {x}, {y}")
        }
        Item::Window(window) => format!("Window {}", window + 1),
        Item::Region(region) => format!("Region {region}"),
        Item::Bin(bin) => format!("Color bin {}", bin + 1),
    }
}

/// Shows the subject, and the buttons that change the selection.
fn buttons(ui: &mut Ui, cx: &mut PanelContext, subject: &str) {
    let marked = cx.state.document.selection.marked.is_some();
    ui.horizontal(|ui| {
        ui.label(subject);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.small_button("Deselect").on_hover_text("Select and mark nothing (Esc).").clicked() {
                cx.send(Edit::ClearSelection);
            }
            if ui.add_enabled(marked, egui::Button::new("Invert").small()).clicked() {
                cx.send(Edit::InvertMarked);
            }
        });
    });
    let tip = "Lines are fitted to the matte and to the highlight pixels among the marked ones, which are split by both (section 6, the \
               method of 1987 and 1988). The method becomes `by-hand`; undo takes this back.";
    if marked && ui.small_button("Fit skewed T to the marked").on_hover_text(tip).clicked() {
        cx.act(Action::FitSkewedT);
    }
}

/// Shows numbers, class, axes, place and regions of the pixels.
fn facts(ui: &mut Ui, cx: &PanelContext, found: &Statistics) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let fact = |ui: &mut Ui, name: &str, value: String, tip: &str| {
        // One widget, so that the end of a line does not part name and value.
        let mut job = LayoutJob::default();
        let font = FontId::proportional;
        job.append(name, 0.0, TextFormat::simple(font(SMALL_PT), cx.palette.secondary));
        job.append(&format!(" {value}"), 0.0, TextFormat::simple(font(BODY_PT), cx.palette.text));
        ui.add(Label::new(job).selectable(true).extend()).on_hover_text(tip);
        ui.add_space(8.0);
    };
    fact(ui, "pixels", crate::describe::grouped(found.pixels), "How many pixels are selected.");
    let class = found.class.map_or("\u{2013}", Class::name);
    fact(
        ui,
        "class",
        class.to_owned(),
        "By the number of significant eigenvalues of their colors (section 5.2.1, table 1).",
    );
    let [a, b, c] = found.variances.map(f64::sqrt);
    let tip = "Standard deviations along the principal axes, counts: square roots of the eigenvalues (section 5.2.1).";
    fact(ui, "\u{221a}\u{3bb}", format!("{a:.2}  {b:.2}  {c:.2}"), tip);
    let [x, y, z] = found.axes[0];
    fact(
        ui,
        "axis",
        format!("{x:.3}  {y:.3}  {z:.3}"),
        "The first principal axis: the matte line's direction, of a linear cluster (section 5.3).",
    );
    let bounds = &found.bounds;
    fact(
        ui,
        "box",
        format!("{}, {}  {} \u{d7} {}", bounds.left, bounds.top, bounds.width, bounds.height),
        "Left, top, width and height of the smallest rectangle, pixels.",
    );
    let percent = |n: usize| format!("{:.1} %", 100.0 * n as f64 / found.pixels.max(1) as f64);
    fact(ui, "clipped", percent(found.clipped), "A band is at or above the clipping threshold (section 4).");
    fact(ui, "dark", percent(found.dark), "Inside the dark sphere: not analyzed (section 5.3).");
    let owners = found.owners.iter().take(4).map(|&(label, n)| match label {
        UNASSIGNED => format!("none: {}", percent(n)),
        _ => format!("{label}: {}", percent(n)),
    });
    let tip = match found.owner_kind {
        OwnerKind::Region => "The regions that most of them are in.",
        OwnerKind::Hypothesis => "The hypotheses that own most of them at the debugger's cursor.",
    };
    fact(ui, found.owner_kind.plural(), owners.collect::<Vec<_>>().join("   "), tip);
}

/// Shows the table of the bands with their histograms.
fn bands(ui: &mut Ui, cx: &PanelContext, found: &Statistics) {
    let colors = [
        ("R", Color32::from_rgb(0xD8, 0x6A, 0x5E)),
        ("G", Color32::from_rgb(0x6C, 0xB0, 0x6A)),
        ("B", Color32::from_rgb(0x6E, 0x96, 0xDE)),
    ];
    let secondary_text =
        |text: &str| RichText::new(text.to_owned()).size(SMALL_PT).color(cx.palette.secondary);
    egui::Grid::new("bands").num_columns(6).spacing([12.0, 2.0]).show(ui, |ui| {
        for title in ["", "min", "median", "mean", "max", "counts"] {
            ui.label(secondary_text(title));
        }
        ui.end_row();
        for ((band, (name, color)), mean) in found.bands.iter().zip(colors).zip(found.mean) {
            ui.label(RichText::new(name).color(color));
            for value in [f64::from(band.min), f64::from(band.median), mean, f64::from(band.max)] {
                widgets::number(ui, cx.palette, 44.0, &format!("{value:.1}"), "");
            }
            histogram(ui, band, color, cx.palette.well);
            ui.end_row();
        }
    });
}

/// Paints a band's histogram from 0 to full scale; the tallest bar has full height.
fn histogram(ui: &mut Ui, band: &Band, color: Color32, background: Color32) {
    let size = vec2(ui.available_width().clamp(96.0, 220.0), HISTOGRAM_PT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, "histogram of a band"));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, background);
    let most = band.histogram.iter().copied().max().unwrap_or(0).max(1) as f32;
    let width = rect.width() / band.histogram.len().max(1) as f32;
    for (bin, &count) in band.histogram.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = rect.left() + bin as f32 * width;
        // The square root keeps rare values visible beside frequent ones.
        let top = rect.bottom() - rect.height() * (count as f32 / most).sqrt().max(0.04);
        let bar = egui::Rect::from_min_max(pos2(left, top), pos2(left + width, rect.bottom()));
        painter.rect_filled(bar, 0.0, color);
    }
    response.on_hover_text("Share of pixels (square root) at each value, from 0 to full scale.");
}
