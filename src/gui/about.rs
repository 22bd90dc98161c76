//! Which result a panel is about: told on its tab while the pinned result is shown, and over the panel while a newer result is being
//! computed or its computation was canceled.

use super::PanelContext;
use super::theme::SMALL_PT;
use super::work_shown::is_work_shown;
use crate::app::State;
use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Rect, Sense, Ui, WidgetInfo, vec2};

/// The result that a panel is about.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// The result that is shown: the pinned or the newest one.
    Shown,
    /// The newest result, also while the pinned one is shown.
    Newest,
    /// What the newest result is to be made of, which is never older than it.
    Request,
    /// No result, or both.
    None,
}

impl About {
    /// What follows the title of the panel: the name of the result, while the pinned one is shown.
    pub fn suffix(self, state: &State) -> &'static str {
        match self {
            Self::Shown if state.shows_pinned() => " (A)",
            Self::Newest | Self::Request if state.shows_pinned() => " (B)",
            _ => "",
        }
    }

    /// What is told over the panel; none where the panel shows the result for the present parameters, or a newer one appears at once.
    fn note(self, state: &State) -> Option<&'static str> {
        let can_be_older = match self {
            Self::Shown => !state.shows_pinned(),
            Self::Newest => true,
            Self::Request | Self::None => false,
        };
        let takes_long = state.preview.is_some() || is_work_shown(state.jobs.analysis.as_ref());
        if !can_be_older || state.newest.is_none() || state.is_current() {
            None
        } else if state.lacks_result() {
            Some("the result before \u{b7} of other parameters")
        } else {
            takes_long.then_some("the result before \u{b7} computing\u{2026}")
        }
    }

    /// Dims a panel that shows the result before, and says so in its lower right corner. `full`: the place of the panel; `ground`: its
    /// color.
    pub fn mark(self, ui: &Ui, cx: &PanelContext, full: Rect, ground: Color32) {
        let Some(text) = self.note(cx.state).filter(|_| !cx.is_export) else { return };
        let painter = ui.painter();
        painter.rect_filled(full, 0.0, ground.gamma_multiply(0.45));
        let font = FontId::proportional(SMALL_PT);
        let galley = painter.layout_no_wrap(text.to_owned(), font, cx.palette.text);
        let place = full.right_bottom() - vec2(8.0, 8.0);
        let area = Align2::RIGHT_BOTTOM.anchor_size(place, galley.size() + vec2(12.0, 6.0));
        painter.rect(area, 3.0, cx.palette.panel, (1.0, cx.palette.line), egui::StrokeKind::Inside);
        painter.galley(area.min + vec2(6.0, 3.0), galley, cx.palette.text);
        let label = ui.interact(area, ui.scope_id().with("the result before"), Sense::hover());
        label.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    }
}
