//! Texts in the chart of the plane, which keep away from each other and from the points.

use crate::gui::glossary::Term;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets::with_subscripts;
use egui::{Align2, FontId, Galley, Painter, Pos2, Rect, Response, Sense, Ui, Vec2, pos2, vec2};
use std::sync::Arc;

/// A text label with a tooltip.
pub struct ChartLabel {
    /// Where the anchor of the text lies, screen points.
    pub at: Pos2,
    /// The part of the text that lies there.
    pub anchor: Align2,
    /// The text.
    pub text: &'static str,
    /// The tooltip, where there is no card.
    pub tip: &'static str,
    /// The word whose card is the tooltip.
    pub term: Option<Term>,
}

/// What labels keep away from.
pub struct Obstacles<'a> {
    /// The places of the points.
    pub points: &'a PointDensity,
    /// Rectangles of other texts, screen points.
    pub taken: Vec<Rect>,
}

/// Side of a cell of [`PointDensity`], points.
const CELL_PT: f32 = 6.0;

/// Which cells of the view hold points.
#[derive(Default)]
pub struct PointDensity {
    rect: Option<Rect>,
    columns: usize,
    cells: Vec<bool>,
}

impl PointDensity {
    /// No point in the view `rect`.
    pub fn new(rect: Rect) -> Self {
        let cells = |length: f32| (length / CELL_PT).ceil().clamp(0.0, 4096.0) as usize + 1;
        let (columns, rows) = (cells(rect.width()), cells(rect.height()));
        Self { rect: Some(rect), columns, cells: vec![false; columns * rows] }
    }

    /// Adds a point.
    pub fn add(&mut self, at: Pos2) {
        let Some(rect) = self.rect.filter(|rect| rect.contains(at)) else { return };
        let cell = ((at - rect.min) / CELL_PT).to_pos2();
        if let Some(cell) = self.cells.get_mut(cell.y as usize * self.columns + cell.x as usize) {
            *cell = true;
        }
    }

    /// Share of the cells under `area` that hold points, 0…1.
    fn share_under(&self, area: Rect) -> f32 {
        let Some(rect) = self.rect else { return 0.0 };
        let [from, to] = [area.min, area.max].map(|corner| ((corner - rect.min) / CELL_PT).max(Vec2::ZERO));
        let (columns, rows) = (from.x as usize..to.x as usize + 1, from.y as usize..to.y as usize + 1);
        let all = (columns.len() * rows.len()).max(1);
        let held = rows.flat_map(|row| columns.clone().map(move |column| (row, column)));
        let is_held = |(row, column): &(usize, usize)| {
            *column < self.columns && self.cells.get(row * self.columns + column).copied().unwrap_or(false)
        };
        held.filter(is_held).count() as f32 / all as f32
    }
}

impl ChartLabel {
    /// The rectangle of the label with the given size: near its place, inside the view, on no other text, and on as few points as
    /// possible; none where every place lies on another text.
    fn place(&self, size: Vec2, rect: Rect, points: &PointDensity, taken: &[Rect]) -> Option<Rect> {
        let first = self.anchor.anchor_size(self.at, size);
        let steps = [0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0];
        let sides = [0.0, -0.6, 0.6, -1.2, 1.2];
        let moves = steps.into_iter().flat_map(|y| sides.into_iter().map(move |x| vec2(x, y)));
        let places = moves.filter_map(|step| {
            let place = first.translate(vec2(step.x * size.x, step.y * (size.y + 2.0)));
            let is_free =
                rect.contains_rect(place) && !taken.iter().any(|other| other.intersects(place.expand(2.0)));
            // Far from its place, a label is harder to relate than over a few points.
            is_free.then(|| (points.share_under(place) + 0.12 * step.length(), place))
        });
        places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
    }

    /// Paints the label where it lies on no other text and on few points; no label where every place is taken.
    pub fn show(
        &self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        palette: &ThemeColors,
        points: &PointDensity,
        taken: &mut Vec<Rect>,
    ) {
        let painter = ui.painter_at(rect);
        let galley = painter.layout_job(with_subscripts(self.text, SMALL_PT, palette.text));
        let Some(place) = self.place(galley.size(), rect, points, taken) else { return };
        taken.push(place);
        painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, palette.panel.gamma_multiply(0.75));
        painter.galley(place.min, galley, palette.text);
        let name = ui.interact(place, response.id.with(self.text), Sense::hover());
        name.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, self.text));
        match self.term {
            Some(term) => drop(term.card(name, palette)),
            None => drop(name.on_hover_text(self.tip)),
        }
    }
}

/// The numbers at the ticks. A number that would lie on an earlier one is left out: on an axis at a small angle to the other axis, and beside
/// an axis that has left the view, the ticks are closer than the numbers are high.
pub struct TickNumbers<'a> {
    /// What paints the numbers.
    pub painter: &'a Painter,
    /// The view.
    pub rect: Rect,
    /// The colors of the theme.
    pub palette: &'a ThemeColors,
    /// The rectangles of the numbers so far.
    pub taken: Vec<Rect>,
    /// The numbers so far.
    pub texts: Vec<Arc<Galley>>,
}

impl TickNumbers<'_> {
    /// Adds a number at `at`, moved sideways as far as the view requires.
    pub fn add(&mut self, value: f32, at: Pos2, anchor: Align2) {
        let font = FontId::proportional(SMALL_PT);
        let galley = self.painter.layout_no_wrap(number_text(value), font, self.palette.secondary);
        let Some(place) = tick_number_place(anchor.anchor_size(at, galley.size()), self.rect, &self.taken)
        else {
            return;
        };
        self.taken.push(place);
        self.texts.push(galley);
    }

    /// Paints the numbers, over the points that were painted after the axes. Returns their rectangles.
    pub fn paint(self) -> Vec<Rect> {
        let ground = self.palette.panel.gamma_multiply(0.7);
        for (place, text) in self.taken.iter().zip(self.texts) {
            self.painter.rect_filled(place.expand2(vec2(1.0, -1.0)), 2.0, ground);
            self.painter.galley(place.min, text, self.palette.secondary);
        }
        self.taken
    }
}

/// The rectangle of a number, moved sideways into the view `rect`; none where it lies on another number.
fn tick_number_place(number: Rect, rect: Rect, taken: &[Rect]) -> Option<Rect> {
    // In a view that is narrower than the number, the left border wins.
    let left = number.left().min(rect.right() - 2.0 - number.width()).max(rect.left() + 2.0);
    let place = Rect::from_min_size(pos2(left, number.top()), number.size());
    let is_free = taken.iter().all(|other| !other.expand2(vec2(2.0, 0.0)).intersects(place));
    is_free.then_some(place)
}

/// A number as text, with a decimal where it is no whole number.
fn number_text(value: f32) -> String {
    let digits = usize::from(value.fract() != 0.0);
    if value < 0.0 { format!("\u{2212}{:.digits$}", -value) } else { format!("{value:.digits$}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_lie_on_no_other_text_and_keep_away_from_points() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(400.0, 300.0));
        let label = ChartLabel {
            at: pos2(200.0, 150.0),
            anchor: Align2::CENTER_TOP,
            text: "matte line",
            tip: "",
            term: None,
        };
        let size = vec2(60.0, 14.0);
        let mut points = PointDensity::new(rect);
        let free = label.place(size, rect, &points, &[]).unwrap();
        assert_eq!(free.center_top(), label.at);
        let other = label.place(size, rect, &points, &[free]).unwrap();
        assert!(!other.intersects(free) && rect.contains_rect(other));
        (0..400).for_each(|x| (146..168).for_each(|y| points.add(pos2(x as f32, y as f32))));
        let away = label.place(size, rect, &points, &[]).unwrap();
        assert!(points.share_under(away) < 0.4, "{away}");
        assert_eq!(label.place(size, rect, &points, &[rect]), None);
    }

    #[test]
    fn tick_numbers_stay_in_the_view_and_off_each_other() {
        let view = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0));
        let number = |x: f32, y: f32| Rect::from_min_size(pos2(x, y), vec2(30.0, 12.0));
        let first = tick_number_place(number(-20.0, 40.0), view, &[]).unwrap();
        assert_eq!(first.min, pos2(2.0, 40.0));
        assert_eq!(tick_number_place(number(-50.0, 47.0), view, &[first]), None, "half a line below");
        assert!(tick_number_place(number(-50.0, 53.0), view, &[first]).is_some());
        assert_eq!(tick_number_place(number(190.0, 0.0), view, &[first]).unwrap().max, pos2(198.0, 12.0));
    }

    #[test]
    fn numbers_have_a_minus_sign() {
        assert_eq!(number_text(-50.0), "\u{2212}50");
    }
}
