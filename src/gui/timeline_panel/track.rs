//! The track of the timeline: stages, passes and blocks in order of time, the density of decisions, and the cursor.

use super::drawing::draw;
use super::scale::{Lanes, Scale};
use super::tooltip;
use crate::app::{Command, DebugCommand, Direction, Edit, Goal};
use crate::describe::Names;
use crate::gui::PanelContext;
use crate::trace::{Block, Replay};
use crate::view::{Item, TimelineAxis, TimelineSection, timeline_density};
use egui::accesskit::{Action, ActionData};
use egui::{CursorIcon, EventFilter, Id, PointerButton, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo};

/// Scrolling by this distance doubles the zoom, points.
const SCROLL_PT: f32 = 140.0;

/// The widget's id. While the track has the focus, arrow keys still move the debugger's cursor.
pub fn track_id() -> Id {
    Id::unique("timeline track")
}

/// Inputs of the density: generation of the trace, visible section, and number of columns.
type DensityKey = (u64, TimelineSection, usize);

/// The track: the visible section, and the values that were computed for the section.
#[derive(Default)]
pub struct Track {
    axis: Option<(u64, TimelineAxis)>,
    section: TimelineSection,
    density: Option<(DensityKey, Vec<usize>)>,
    /// Position of the cursor and length of the trace in the last frame, steps.
    cursor: [usize; 2],
}

impl Track {
    /// Shows the track in the rest of `ui`.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext, replay: &Replay, names: &Names) {
        let rect = ui.available_rect_before_wrap();
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        let generation = cx.state.debugger.generation;
        let axis = match self.axis.take() {
            Some((known, axis)) if known == generation => axis,
            _ => TimelineAxis::of(replay.trace()),
        };
        let response = ui.interact(rect, track_id(), Sense::click_and_drag());
        ui.advance_cursor_after_rect(rect);
        self.follow_cursor(&axis, replay);
        self.navigate(ui, &response, &axis);
        let scale = Scale { axis: &axis, section: self.section, rect };
        let lanes = Lanes::of(rect);
        handle_pointer(ui, cx, &response, &scale, &lanes, replay);
        set_accessible_value(ui, cx, &response, replay);
        let columns = rect.width() as usize;
        let key = (generation, self.section, columns);
        let density = match self.density.take() {
            Some((known, density)) if known == key => density,
            _ => timeline_density(replay.trace(), &axis, self.section, columns),
        };
        draw(&ui.painter_at(rect), cx, &scale, &lanes, replay, &density);
        if response.has_focus() {
            let stroke = Stroke::new(1.0, cx.palette.secondary.gamma_multiply(0.5));
            ui.painter().rect_stroke(rect.expand(2.0), 2.0, stroke, StrokeKind::Inside);
        }
        show_tooltip(&response, cx, &scale, replay, names);
        self.density = Some((key, density));
        self.axis = Some((generation, axis));
    }

    /// Moves the section to the cursor when the cursor has moved; shows the whole line of another trace.
    fn follow_cursor(&mut self, axis: &TimelineAxis, replay: &Replay) {
        let now = [replay.at(), replay.trace().len()];
        let before = std::mem::replace(&mut self.cursor, now);
        if before[1] != now[1] {
            self.section = TimelineSection::default();
        } else if before[0] != now[0] {
            self.section = self.section.showing(axis.place_of(now[0]));
        }
    }

    /// Zooms and pans by wheel, pinch, double click and middle button.
    fn navigate(&mut self, ui: &Ui, response: &Response, axis: &TimelineAxis) {
        let rect = response.rect;
        if response.double_clicked() {
            self.section = TimelineSection::default();
        }
        if response.dragged_by(PointerButton::Middle) {
            self.section = self.section.panned(f64::from(-response.drag_delta().x / rect.width()));
        }
        let Some(pointer) = response.hover_pos().filter(|_| response.contains_pointer()) else { return };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = f64::from((scroll.y / SCROLL_PT).exp2() * pinch);
        if (factor - 1.0).abs() > 1e-6 {
            let share = f64::from((pointer.x - rect.left()) / rect.width());
            self.section = self.section.zoomed(axis, factor, share);
        }
        if scroll.x != 0.0 {
            self.section = self.section.panned(f64::from(-scroll.x / rect.width()));
        }
    }
}

/// Sends the commands of the pointer: a click moves the cursor, a click with Shift runs to the step, a drag moves the
/// cursor with the pointer, a click on a block selects the block's region.
fn handle_pointer(
    ui: &Ui,
    cx: &mut PanelContext,
    response: &Response,
    scale: &Scale,
    lanes: &Lanes,
    replay: &Replay,
) {
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let arrows = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(track_id(), arrows));
    let pointer = response.interact_pointer_pos().or(response.hover_pos());
    let block = pointer
        .filter(|pointer| lanes.blocks.contains(*pointer))
        .and_then(|pointer| replay.trace().block_at(scale.step_at(pointer.x)?));
    send_hover(cx, response.contains_pointer().then_some(block.as_ref()).flatten());
    if response.hovered() && !response.dragged() {
        ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
    }
    let Some(pointer) = response.interact_pointer_pos() else { return };
    let runs_to = response.clicked() && ui.input(|input| input.modifiers.shift);
    if response.clicked_by(PointerButton::Primary)
        && !runs_to
        && let Some(block) = block
    {
        select_block(cx, &block);
    } else if response.dragged_by(PointerButton::Primary) || response.clicked_by(PointerButton::Primary) {
        let n = scale.axis.taken_at(scale.place_at(pointer.x));
        let direction = if n < replay.at() { Direction::Back } else { Direction::Forward };
        if runs_to {
            cx.send(Command::Debug(DebugCommand::RunTo(Goal::StepCount(n), direction)));
        } else if n != replay.at() {
            cx.send(Command::Debug(DebugCommand::Seek(n)));
        }
    }
}

/// Sends the region under the pointer as hovered.
fn send_hover(cx: &mut PanelContext, block: Option<&Block>) {
    let names = &cx.state.debugger.names;
    if let Some(region) = block.and_then(|block| names.region_of(block.topic.hypothesis())) {
        cx.hover(Item::Region(region));
    }
}

/// Selects a block's region, and moves the cursor to the block's first decision.
fn select_block(cx: &mut PanelContext, block: &Block) {
    let hypothesis = block.topic.hypothesis();
    let item = cx.state.debugger.names.region_of(hypothesis).map(Item::Region);
    if item.is_some() && item != cx.state.document.selection.item {
        cx.send(Edit::Select(item));
    }
    cx.send(Command::Debug(DebugCommand::Choose(Some(hypothesis))));
    cx.send(Command::Debug(DebugCommand::Seek(block.steps.start + 1)));
}

/// Describes the track as a slider to assistive technology, and takes the value set there.
fn set_accessible_value(ui: &Ui, cx: &mut PanelContext, response: &Response, replay: &Replay) {
    response.widget_info(|| WidgetInfo::slider(true, replay.at() as f64, "Timeline"));
    let last = replay.trace().len();
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(last as f64);
        node.set_numeric_value_step(1.0);
        node.add_action(Action::SetValue);
    });
    let requested = ui.input(|input| {
        let values = input.accesskit_action_requests(response.id, Action::SetValue);
        values
            .filter_map(|request| match request.data {
                Some(ActionData::NumericValue(value)) => Some(value),
                _ => None,
            })
            .last()
    });
    if let Some(value) = requested {
        cx.send(Command::Debug(DebugCommand::Seek(value.max(0.0) as usize)));
    }
}

/// Shows the step under the pointer as a tooltip.
fn show_tooltip(response: &Response, cx: &PanelContext, scale: &Scale, replay: &Replay, names: &Names) {
    let step = response.hover_pos().and_then(|pointer| scale.step_at(pointer.x));
    if let Some(step) = step.filter(|_| !response.dragged()) {
        let regions = &cx.state.debugger.names;
        response.clone().on_hover_ui_at_pointer(|ui| {
            for line in tooltip::lines(replay.trace(), regions, names, step) {
                ui.label(line);
            }
        });
    }
}
