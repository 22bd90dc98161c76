//! Words in the picture: they face the viewer and never cover one another.

use egui::{Align2, Color32, FontId, Id, Pos2, Rect, Sense, Ui, Vec2, vec2};

/// Between the place that a label names and the label.
const GAP_PT: f32 = 5.0;
/// The same, where a line leads from one to the other.
const LEADER_PT: f32 = 16.0;
/// Kept free around a label.
const AIR_PT: f32 = 1.5;

/// A word at a place.
#[derive(Clone, Debug)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// The place that it names, on the screen.
    pub at: Pos2,
    /// Where it may stand, seen from there, the best first; zero: centered on it.
    pub sides: Vec<Vec2>,
    /// Its color.
    pub color: Color32,
    /// Size of type, points.
    pub size_pt: f32,
    /// What it means, in one sentence.
    pub tip: &'static str,
    /// Whether a line leads to it.
    pub leader: bool,
}

/// Eight sides, up and to the right first: for what may be named from anywhere.
pub fn all_around() -> Vec<Vec2> {
    [(1, -1), (1, 1), (-1, -1), (-1, 1), (1, 0), (-1, 0), (0, -1), (0, 1)]
        .map(|(x, y)| vec2(x as f32, y as f32).normalized())
        .to_vec()
}

/// Where each label stands, by their order of importance; none where it would cover another or leave `bounds`.
pub fn arrange(labels: &[(&Label, Vec2)], bounds: Rect, occupied: &[Rect]) -> Vec<Option<Rect>> {
    let mut taken = occupied.to_vec();
    let mut places = Vec::with_capacity(labels.len());
    for (label, size) in labels {
        let free = |rect: &Rect| {
            bounds.contains_rect(*rect) && taken.iter().all(|other| !other.intersects(rect.expand(AIR_PT)))
        };
        let place = label.sides.iter().map(|&side| beside(label, side, *size)).find(free);
        taken.extend(place);
        places.push(place);
    }
    places
}

/// The rectangle of this size on that side of a place.
fn beside(label: &Label, side: Vec2, size: Vec2) -> Rect {
    let gap = if label.leader { LEADER_PT } else { GAP_PT };
    // As far out as the rectangle's own half width or height makes it.
    let reach = side.x.abs() * size.x / 2.0 + side.y.abs() * size.y / 2.0;
    let away = if side == Vec2::ZERO { 0.0 } else { gap + reach };
    Rect::from_center_size(label.at + side * away, size)
}

/// Writes the labels that have room, in their order of importance, around what is `occupied`.
pub fn show(ui: &Ui, id: Id, labels: &[Label], bounds: Rect, occupied: &[Rect], halo: Color32) {
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
        painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, halo);
        painter.galley(Align2::LEFT_TOP.align_size_within_rect(place.size(), place).min, galley, label.color);
        if !label.tip.is_empty() {
            let response = ui.interact(place, id.with(index), Sense::hover());
            response.widget_info(|| {
                egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, label.text.clone())
            });
            response.on_hover_text(label.tip);
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
        let kept: Vec<Rect> = places.into_iter().flatten().collect();
        for (i, one) in kept.iter().enumerate() {
            assert!(bounds.contains_rect(*one) && !one.intersects(gizmo));
            assert!(kept[..i].iter().all(|other| !other.intersects(*one)));
        }
    }

    #[test]
    fn a_label_stands_clear_of_its_place() {
        for side in all_around() {
            let rect = beside(&label(0.0, 0.0, Vec::new()), side, vec2(40.0, 14.0));
            assert!(
                !rect.contains(pos2(0.0, 0.0)) && rect.distance_to_pos(pos2(0.0, 0.0)) >= 3.0,
                "{side:?}"
            );
        }
        assert_eq!(beside(&label(3.0, 4.0, Vec::new()), Vec2::ZERO, vec2(2.0, 2.0)).center(), pos2(3.0, 4.0));
    }
}
