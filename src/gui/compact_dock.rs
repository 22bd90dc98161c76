//! The arrangement of the panels where there is no room for several of them, as a large interface in a small window has: all panels
//! are tabs of one group, so that the panel in front has all the room.

use super::PanelContext;
use super::dock::{Dock, Panels};
use super::pane::Pane;
use egui::{Ui, Vec2, vec2};

/// Smallest width and height of the room in which the panels stand as a person arranged them, points.
const LEAST_ROOM_PT: Vec2 = vec2(620.0, 420.0);

/// Smallest area of that room: a narrow one has to be high, and a low one wide, square points.
const LEAST_AREA: f32 = 400_000.0;

/// All visible panels as tabs of one group. The arrangement that a person made stays as it is.
#[derive(Default)]
pub struct CompactDock {
    /// Whether the panels are tabs of one group in this frame.
    pub is_in_use: bool,
    /// The tabs; none before the room was small for the first time.
    tabs: Option<Tabs>,
}

/// The tabs and the panels that they were made of.
struct Tabs {
    dock: Dock,
    panes: Vec<Pane>,
}

impl CompactDock {
    /// Whether a room is too small for several panels.
    pub fn is_needed(room: Vec2) -> bool {
        room.x < LEAST_ROOM_PT.x || room.y < LEAST_ROOM_PT.y || room.x * room.y < LEAST_AREA
    }

    /// Shows the panels that `arranged` shows as tabs of one group.
    pub fn show(&mut self, ui: &mut Ui, arranged: &Dock, panels: &mut Panels, cx: &mut PanelContext) {
        let panes: Vec<Pane> = Pane::ALL.into_iter().filter(|&pane| arranged.is_visible(pane)).collect();
        let front = match &self.tabs {
            Some(tabs) if tabs.panes == panes => None,
            Some(tabs) => Some(tabs.panes.iter().copied().find(|&pane| tabs.dock.is_in_front(pane))),
            None => Some(None),
        };
        if let Some(front) = front {
            let mut dock = Dock::of_tabs(&panes);
            if let Some(front) = front.filter(|pane| panes.contains(pane)).or(panes.first().copied()) {
                dock.activate(front);
            }
            self.tabs = Some(Tabs { dock, panes });
        }
        if let Some(tabs) = &mut self.tabs {
            tabs.dock.show(ui, panels, cx);
        }
    }

    /// Whether the panel's tab is in front of the others.
    pub fn is_in_front(&self, pane: Pane) -> bool {
        self.tabs.as_ref().is_some_and(|tabs| tabs.dock.is_in_front(pane))
    }

    /// Brings the panel's tab to the front.
    pub fn activate(&mut self, pane: Pane) {
        if let Some(tabs) = &mut self.tabs {
            tabs.dock.activate(pane);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_room_that_is_high_and_a_low_one_that_is_wide_have_several_panels() {
        let needed = [[640.0, 870.0], [900.0, 530.0], [700.0, 470.0], [2000.0, 400.0]];
        let needed = needed.map(|[width, height]| CompactDock::is_needed(vec2(width, height)));
        assert_eq!(needed, [false, false, true, true]);
    }
}
