//! The histograms that decided about a region of Phoenix, drawn in the inspector: one below the other, each with its valleys (section 7.2).

use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::trace::{FeatureHistogram, FeatureVerdict, HistogramsSearched};
use egui::accesskit::Role;
use egui::{Color32, Painter, Rect, RichText, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Height of a histogram, points.
const HEIGHT_PT: f32 = 44.0;

/// Shows the histograms of one search.
pub fn show(ui: &mut Ui, palette: &ThemeColors, searched: &HistogramsSearched) {
    for feature in &searched.features {
        let chosen = feature.verdict == FeatureVerdict::Chosen;
        let color = if chosen { palette.accent } else { palette.secondary };
        let title = format!("{}: {}", feature.feature.name(), feature.verdict.name());
        ui.label(RichText::new(&title).size(SMALL_PT).color(color));
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT_PT), Sense::hover());
        paint(ui.painter(), palette, rect, feature, color);
        let cuts: Vec<String> = feature.cuts.iter().map(ToString::to_string).collect();
        let valleys =
            if cuts.is_empty() { "no valley".to_owned() } else { format!("valley at {}", cuts.join(", ")) };
        let name = format!("Histogram of {title}, {valleys}");
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name.clone()));
        response.on_hover_text(format!(
            "Smoothed number of pixels with each code, 0 to 255; {valleys}. Heights are square roots, so that small peaks are seen."
        ));
    }
}

/// Paints the bars of one histogram, and a line at each valley that was kept.
fn paint(painter: &Painter, palette: &ThemeColors, rect: Rect, feature: &FeatureHistogram, color: Color32) {
    painter.rect_filled(rect, 2.0, palette.well);
    let most = feature.smoothed.iter().copied().fold(1.0, f32::max).sqrt();
    let codes = feature.smoothed.len().max(1) as f32;
    let column = |code: f32| rect.left() + rect.width() * code / codes;
    for (code, height) in feature.smoothed.iter().enumerate().filter(|(_, height)| **height > 0.0) {
        let top = rect.bottom() - rect.height() * height.sqrt() / most;
        let bar = Rect::from_min_max(
            pos2(column(code as f32), top),
            pos2(column(code as f32 + 1.0), rect.bottom()),
        );
        painter.rect_filled(bar, 0.0, color);
    }
    for &cut in &feature.cuts {
        let stroke = Stroke::new(1.5, palette.text);
        painter.vline(column(f32::from(cut)), rect.y_range(), stroke);
    }
}
