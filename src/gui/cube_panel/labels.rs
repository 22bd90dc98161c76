//! Text labels over the color space, placed so that they never overlap.

use crate::gui::glossary::Term;
use crate::gui::theme::ThemeColors;
use egui::{Align2, Color32, FontId, Id, Pos2, Rect, Sense, Ui, Vec2, vec2};

/// Distance between a label and its point, screen points.
const GAP_PT: f32 = 5.0;
/// Distance between a label and its point when a line connects them, screen points.
const LEADER_PT: f32 = 16.0;
/// Free space around a label, screen points.
const SPACE_PT: f32 = 1.5;

/// A text label of a point on the screen.
#[derive(Clone, Debug)]
pub struct Label {
    /// The text of the label.
    pub text: String,
    /// The labeled point on the screen.
    pub at: Pos2,
    /// Directions from the point in which the label may be placed, the best first; zero centers the label on the point.
    pub sides: Vec<Vec2>,
    /// Color of the text.
    pub color: Color32,
    /// Size of type, points.
    pub size_pt: f32,
    /// Tooltip of one sentence; empty for none.
    pub tip: &'static str,
    /// Whether a line connects label and point.
    pub leader: bool,
}

/// Eight unit directions, up and to the right first, for labels that may be placed on any side.
pub fn all_around() -> Vec<Vec2> {
    [(1, -1), (1, 1), (-1, -1), (-1, 1), (1, 0), (-1, 0), (0, -1), (0, 1)]
        .map(|(x, y)| vec2(x as f32, y as f32).normalized())
        .to_vec()
}

/// The rectangle of each label, given with its size, in the order of importance; `None` when the label would cover
/// another or leave `bounds`.
pub fn arrange(labels: &[(&Label, Vec2)], bounds: Rect, occupied: &[Rect]) -> Vec<Option<Rect>> {
    let mut occupied_rects = occupied.to_vec();
    let mut places = Vec::with_capacity(labels.len());
    for (label, size) in labels {
        let free = |rect: &Rect| {
            bounds.contains_rect(*rect)
                && occupied_rects.iter().all(|other| !other.intersects(rect.expand(SPACE_PT)))
        };
        let place = label.sides.iter().map(|&side| rect_on_side(label, side, *size)).find(free);
        occupied_rects.extend(place);
        places.push(place);
    }
    places
}

/// The rectangle of a label of `size`, placed on `side` of the labeled point.
fn rect_on_side(label: &Label, side: Vec2, size: Vec2) -> Rect {
    let gap = if label.leader { LEADER_PT } else { GAP_PT };
    // Half the extent of the rectangle in the direction `side`.
    let reach = side.x.abs() * size.x / 2.0 + side.y.abs() * size.y / 2.0;
    let away = if side == Vec2::ZERO { 0.0 } else { gap + reach };
    Rect::from_center_size(label.at + side * away, size)
}

/// Paints the labels that fit, in the order of importance, outside of the `occupied` rectangles. Words with a card show the card.
pub fn show(ui: &Ui, id: Id, labels: &[Label], bounds: Rect, occupied: &[Rect], palette: &ThemeColors) {
    let painter = ui.painter_at(bounds);
    let galleys: Vec<_> = labels
        .iter()
        .map(|label| {
            painter.layout_no_wrap(label.text.clone(), FontId::proportional(label.size_pt), label.color)
        })
        .collect();
    let sized: Vec<(&Label, Vec2)> =
        labels.iter().zip(&galleys).map(|(label, galley)| (label, galley.size())).collect();
    let places = arrange(&sized, bounds, occupied);
    for (index, ((label, galley), place)) in labels.iter().zip(galleys).zip(places).enumerate() {
        let Some(place) = place else { continue };
        if label.leader {
            let end = place.clamp(label.at);
            painter.line_segment([label.at, end], egui::Stroke::new(1.0, label.color.gamma_multiply(0.6)));
        }
        painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, palette.background.gamma_multiply(0.7));
        painter.galley(Align2::LEFT_TOP.align_size_within_rect(place.size(), place).min, galley, label.color);
        if !label.tip.is_empty() {
            let response = ui.interact(place, id.with(index), Sense::hover());
            response.widget_info(|| {
                egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, label.text.clone())
            });
            match Term::ALL.into_iter().find(|term| term.title() == label.text) {
                Some(term) => drop(term.card(response, palette)),
                None => drop(response.on_hover_text(label.tip)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn label(x: f32, y: f32, sides: Vec<Vec2>) -> Label {
        Label {
            text: String::new(),
            at: pos2(x, y),
            sides,
            color: Color32::WHITE,
            size_pt: 11.0,
            tip: "",
            leader: false,
        }
    }

    #[test]
    fn labels_keep_apart_and_inside_and_the_first_wins() {
        let bounds = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 100.0));
        let right = || vec![vec2(1.0, 0.0)];
        let labels = [
            label(50.0, 50.0, right()),
            label(52.0, 53.0, right()),
            label(52.0, 53.0, all_around()),
            label(190.0, 50.0, right()),
            label(10.0, 95.0, all_around()),
        ];
        let sized: Vec<_> = labels.iter().map(|label| (label, vec2(40.0, 14.0))).collect();
        let gizmo = Rect::from_min_max(pos2(0.0, 70.0), pos2(60.0, 100.0));
        let places = arrange(&sized, bounds, &[gizmo]);
        assert_eq!(places[0], Some(Rect::from_min_size(pos2(55.0, 43.0), vec2(40.0, 14.0))));
        assert_eq!(places[1], None, "covered by the first");
        assert!(places[2].is_some(), "there is room on another side");
        assert_eq!(places[3], None, "beyond the border");
        let placed: Vec<Rect> = places.into_iter().flatten().collect();
        for (i, one) in placed.iter().enumerate() {
            assert!(bounds.contains_rect(*one) && !one.intersects(gizmo));
            assert!(placed[..i].iter().all(|other| !other.intersects(*one)));
        }
    }

    #[test]
    fn a_label_keeps_a_distance_from_its_point() {
        for side in all_around() {
            let rect = rect_on_side(&label(0.0, 0.0, Vec::new()), side, vec2(40.0, 14.0));
            assert!(
                !rect.contains(pos2(0.0, 0.0)) && rect.distance_to_pos(pos2(0.0, 0.0)) >= 3.0,
                "{side:?}"
            );
        }
        assert_eq!(
            rect_on_side(&label(3.0, 4.0, Vec::new()), Vec2::ZERO, vec2(2.0, 2.0)).center(),
            pos2(3.0, 4.0)
        );
    }
}
