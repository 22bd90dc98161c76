//! The positions of the track's rows and steps on the screen.

use super::drawing::NAMED_PT;
use crate::view::{TimelineAxis, TimelineSection};
use egui::{Rect, pos2, vec2};

/// Height below which a track is low, points.
const LOW_PT: f32 = 44.0;

/// Rows of the track, from top to bottom; a row without room is empty.
pub struct Lanes {
    /// The row of the numbers of decisions.
    pub density: Rect,
    /// The row of the stages.
    pub stages: Rect,
    /// The row of the passes.
    pub passes: Rect,
    /// The row of the blocks: hypotheses, slices, candidates, holes.
    pub blocks: Rect,
}

/// The conversion of steps to positions on the screen.
#[derive(Clone, Copy)]
pub struct Scale<'a> {
    /// The conversion of steps to places along the axis.
    pub axis: &'a TimelineAxis,
    /// The section of the axis that is visible.
    pub section: TimelineSection,
    /// The area of the track on the screen, points.
    pub rect: Rect,
}

impl Scale<'_> {
    /// The place along the axis at a column of the screen.
    pub fn place_at(&self, x: f32) -> f64 {
        self.section.place(f64::from((x - self.rect.left()) / self.rect.width()))
    }

    /// The column of the screen after `steps` steps, points.
    pub fn x(&self, steps: usize) -> f32 {
        let share = self.section.share(self.axis.place_of(steps));
        // Places far outside are clamped, so that the numbers stay small.
        self.rect.left() + (share.clamp(-1.0, 2.0) * f64::from(self.rect.width())) as f32
    }

    /// The step at a column of the screen.
    pub fn step_at(&self, x: f32) -> Option<usize> {
        self.axis.step_at(self.place_at(x))
    }

    /// A range of steps in a lane; none where it is not visible.
    pub fn rect_of_steps(&self, lane: Rect, steps: &std::ops::Range<usize>) -> Option<Rect> {
        let (left, right) = (self.x(steps.start), self.x(steps.end));
        (right > lane.left() && left < lane.right())
            .then(|| Rect::from_x_y_ranges(left.max(lane.left())..=right.min(lane.right()), lane.y_range()))
    }
}

impl Lanes {
    /// The rows of a track that fills `rect`.
    pub fn of(rect: Rect) -> Self {
        let height = rect.height();
        // A low track has the names of the stages and the blocks alone.
        let is_low = height < LOW_PT;
        let density = if is_low { 0.0 } else { (height * 0.22).min(36.0) };
        let stages = (height * 0.26).clamp(NAMED_PT + 1.0, 16.0);
        // Passes have names where there is room for them.
        let passes = if height >= 96.0 {
            14.0
        } else if is_low {
            0.0
        } else {
            4.0
        };
        let mut top = rect.top();
        let mut lane = |height: f32| {
            let lane = Rect::from_min_size(pos2(rect.left(), top), vec2(rect.width(), height));
            top += if height > 0.0 { height + 1.0 } else { 0.0 };
            lane
        };
        let (density, stages, passes) = (lane(density), lane(stages), lane(passes));
        let blocks = Rect::from_min_max(pos2(rect.left(), top), rect.max);
        Self { density, stages, passes, blocks }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_track_of_any_height_has_room_for_the_names_of_the_stages_and_no_row_leaves_it() {
        for height in [26.0, 43.0, 44.0, 60.0, 96.0, 300.0] {
            let rect = Rect::from_min_size(pos2(8.0, 700.0), vec2(900.0, height));
            let Lanes { density, stages, passes, blocks } = Lanes::of(rect);
            assert!(stages.height() >= NAMED_PT, "{height}: {stages}");
            let rows = [density, stages, passes, blocks];
            assert!(rows.is_sorted_by(|above, below| above.bottom() <= below.top()), "{height}: {rows:?}");
            assert!(
                blocks.height() >= 8.0 && (blocks.bottom() - rect.bottom()).abs() < 0.01,
                "{height}: {blocks}"
            );
        }
    }
}
