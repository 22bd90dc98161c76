//! Painting of the track. Single steps are painted only where neighboring steps are at least four points apart.

use super::scale::{Lanes, Scale};
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::{PanelContext, widgets};
use crate::trace::{Replay, Step, Trace};
use egui::{Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2, vec2};

/// Smallest distance of steps at which single steps are painted, points.
const TICK_PT: f32 = 4.0;
/// Smallest height of a bar with a name, points.
pub const NAMED_PT: f32 = 12.0;

/// Paints the track: density, stages, passes, blocks, single steps if neighboring steps are far enough apart, and the cursor. A row without
/// height is left out.
/// `density` is the number of decisions per column of the track.
pub fn draw(
    painter: &Painter,
    cx: &PanelContext,
    scale: &Scale,
    lanes: &Lanes,
    replay: &Replay,
    density: &[usize],
) {
    let (palette, trace) = (cx.palette, replay.trace());
    let has_density = lanes.density.is_positive();
    if has_density {
        bars(painter, palette, scale, lanes.density, density);
    }
    let now = trace.stage_at(replay.at().saturating_sub(1));
    for (index, (stage, steps)) in trace.stages().enumerate() {
        let fill = if index % 2 == 0 { palette.well } else { palette.line };
        let text_color = if Some(stage) == now { palette.text } else { palette.secondary };
        paint_span(painter, scale.rect_of_steps(lanes.stages, &steps), fill, text_color, stage.name());
    }
    for (index, pass) in trace.passes().enumerate() {
        let fill = palette.secondary.gamma_multiply(if index % 2 == 0 { 0.18 } else { 0.30 });
        paint_span(
            painter,
            scale.rect_of_steps(lanes.passes, &pass.steps),
            fill,
            palette.secondary,
            pass.pass.name(),
        );
    }
    painter.rect_filled(lanes.blocks, 0.0, palette.well.gamma_multiply(0.6));
    if lanes.passes.height() < NAMED_PT && lanes.blocks.height() >= NAMED_PT {
        names_of_empty(painter, palette, scale, lanes.blocks, trace);
    }
    blocks(painter, cx, scale, lanes.blocks, trace);
    if has_density {
        ticks(painter, palette, scale, lanes.density, trace);
    }
    cursor(painter, palette, scale, lanes, replay.at());
}

/// Paints the bar of a range of steps, with a name if the bar has room.
fn paint_span(painter: &Painter, rect: Option<Rect>, fill: Color32, text_color: Color32, name: &str) {
    let Some(rect) = rect else { return };
    let right = (rect.right() - 1.0).max(rect.left() + 0.5);
    painter.rect_filled(rect.with_max_x(right), 0.0, fill);
    if rect.height() >= NAMED_PT {
        label(painter, rect, text_color, name);
    }
}

/// Writes a text into a bar that is wide enough for the text.
fn label(painter: &Painter, rect: Rect, text_color: Color32, name: &str) {
    let galley = painter.layout_no_wrap(name.to_owned(), FontId::proportional(SMALL_PT), text_color);
    if galley.size().x + 8.0 <= rect.width() {
        let at = pos2(rect.left() + 4.0, rect.center().y - galley.size().y / 2.0);
        painter.galley(at, galley, text_color);
    }
}

/// Paints the number of decisions per column as bars, on a logarithmic scale.
fn bars(painter: &Painter, palette: &ThemeColors, scale: &Scale, lane: Rect, density: &[usize]) {
    let most = density.iter().copied().max().unwrap_or(0).max(1);
    let full = (most as f32).ln_1p();
    let width = scale.rect.width() / density.len().max(1) as f32;
    let mut mesh = Mesh::default();
    for (column, &count) in density.iter().enumerate().filter(|(_, count)| **count > 0) {
        let height = ((count as f32).ln_1p() / full * lane.height()).max(1.0);
        let left = lane.left() + column as f32 * width;
        let bar = Rect::from_min_max(pos2(left, lane.bottom() - height), pos2(left + width, lane.bottom()));
        mesh.add_colored_rect(bar, palette.secondary.gamma_multiply(0.55));
    }
    painter.add(mesh);
}

/// Writes the names of passes without blocks into the row of blocks, which is empty there.
fn names_of_empty(painter: &Painter, palette: &ThemeColors, scale: &Scale, lane: Rect, trace: &Trace) {
    for pass in trace.passes() {
        let block = trace.blocks().find(|block| block.steps.start >= pass.steps.start);
        let empty = block.is_none_or(|block| block.steps.start >= pass.steps.end);
        if let Some(rect) = scale.rect_of_steps(lane, &pass.steps).filter(|_| empty) {
            label(painter, rect, palette.secondary.gamma_multiply(0.8), pass.pass.name());
        }
    }
}

/// Paints blocks (hypotheses, slices, candidates, holes) in the colors of their regions.
fn blocks(painter: &Painter, cx: &PanelContext, scale: &Scale, lane: Rect, trace: &Trace) {
    let (state, names) = (cx.state, &cx.state.debugger.names);
    let (selected, hovered) = (state.selected_region(), state.hover.and_then(|item| state.region_of(item)));
    // Right end of the last painted block: of blocks thinner than a column, one per column is painted.
    let mut drawn = f32::NEG_INFINITY;
    let mut outlined = Vec::new();
    for block in trace.blocks() {
        let Some(rect) = scale.rect_of_steps(lane, &block.steps) else { continue };
        if rect.right() <= drawn {
            continue;
        }
        drawn = (rect.left() + 1.0).max(rect.right());
        let hypothesis = block.topic.hypothesis();
        let region = names.region_of(hypothesis);
        let mut fill = widgets::color(names.color(hypothesis));
        if selected.is_some() && region != selected {
            fill = fill.gamma_multiply(0.55);
        }
        let gap = if rect.width() > 3.0 { 1.0 } else { 0.0 };
        let rect = rect.with_max_x((rect.right() - gap).max(rect.left() + 1.0));
        painter.rect_filled(rect, 0.0, fill);
        if region.is_some() && (region == selected || region == hovered) {
            outlined.push(rect);
        }
    }
    for rect in outlined.into_iter().filter(|rect| rect.width() >= 3.0) {
        painter.rect_stroke(rect, 0.0, Stroke::new(1.0, cx.palette.text), StrokeKind::Inside);
    }
}

/// Paints single steps where they are far enough apart: lines for events, dots for claims and labels,
/// rings for refusals.
fn ticks(painter: &Painter, palette: &ThemeColors, scale: &Scale, lane: Rect, trace: &Trace) {
    for (steps, width) in scale.axis.stretches(scale.section) {
        let paint_span = scale.section.to - scale.section.from;
        if width / paint_span * f64::from(scale.rect.width()) < f64::from(TICK_PT) {
            continue;
        }
        let first = scale.step_at(lane.left()).map_or(steps.start, |step| step.max(steps.start));
        let last = scale.step_at(lane.right()).map_or(steps.end, |step| (step + 1).min(steps.end));
        for (n, step) in trace.steps_in(first..last.max(first)) {
            let x = f32::midpoint(scale.x(n), scale.x(n + 1));
            let foot = pos2(x, lane.bottom());
            match step {
                Step::Event(_) => {
                    let range = egui::Rangef::new(lane.center().y, lane.bottom());
                    painter.vline(x, range, (1.0, palette.secondary));
                }
                Step::Refusal { .. } => {
                    painter.circle_stroke(foot - vec2(0.0, 3.0), 1.6, Stroke::new(1.0, palette.secondary));
                }
                Step::Claim { .. } | Step::Label { .. } => {
                    painter.circle_filled(foot - vec2(0.0, 3.0), 1.6, palette.secondary);
                }
            }
        }
    }
}

/// Paints the cursor, and shades the decisions after the cursor.
fn cursor(painter: &Painter, palette: &ThemeColors, scale: &Scale, lanes: &Lanes, at: usize) {
    let rect = scale.rect;
    let x = scale.x(at);
    let ahead = Rect::from_min_max(pos2(x.clamp(rect.left(), rect.right()), lanes.stages.top()), rect.max);
    painter.rect_filled(ahead, 0.0, palette.panel.gamma_multiply(0.4));
    // At either end of the track, half of the cursor's line would be cut off.
    let x = if (rect.left()..=rect.right()).contains(&x) {
        x.min(rect.right() - 1.0).max(rect.left() + 1.0)
    } else {
        return;
    };
    painter.vline(x, rect.y_range(), (1.6, palette.accent));
    let handle: Vec<Pos2> = [(-5.0, 0.0), (5.0, 0.0), (5.0, 4.0), (0.0, 9.0), (-5.0, 4.0)]
        .map(|(dx, dy)| pos2(x + dx, rect.top() + dy))
        .to_vec();
    painter.add(Shape::convex_polygon(handle, palette.accent, Stroke::NONE));
}
