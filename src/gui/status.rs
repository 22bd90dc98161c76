//! The status line: photograph, size, encoding, noise, number of regions, coverage, time, and the
//! progress of running work.

use super::PanelContext;
use super::theme::SMALL_PT;
use crate::app::JobCommand;
use crate::params::Parameter;
use egui::{Align, Layout, RichText, Ui};
use std::time::Duration;

/// Time after which running work is shown with a spinner and a progress bar.
pub const PROGRESS_DELAY: Duration = Duration::from_millis(150);

/// Shows the line, right-aligned in the remaining space of the menu bar.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        progress(ui, cx);
        let quiet = |text: String| RichText::new(text).size(SMALL_PT).color(cx.palette.secondary);
        for part in parts(cx).into_iter().rev() {
            ui.add(egui::Label::new(quiet(part)).truncate());
        }
    });
}

/// The parts of the line, from left to right.
fn parts(cx: &PanelContext) -> Vec<String> {
    let Some(picture) = &cx.state.picture else { return Vec::new() };
    let (width, height) = picture.size();
    let mut parts =
        vec![picture.origin.name(), format!("{width} \u{d7} {height}"), picture.photo.encoding.to_string()];
    if let Some(shown) = cx.state.shown() {
        let used = &shown.analysis.used;
        let auto = if shown.params.get(Parameter::CameraNoise).value().is_none() { " auto" } else { "" };
        let regions = shown.analysis.intrinsic.regions.len();
        parts.push(format!("\u{3c3}0 {:.2}{auto}", used.camera_noise));
        parts.push(format!("{regions} regions, {:.1} %", 100.0 * shown.coverage));
        parts.push(format!("{:.1} ms", shown.total_ms()));
    }
    parts
}

/// Shows the progress of work that takes longer than `PROGRESS_DELAY`.
fn progress(ui: &mut Ui, cx: &mut PanelContext) {
    let jobs = &cx.state.jobs;
    let stages = crate::analysis::Stage::ALL.len() as f32;
    let (job, words, done) = if let Some(job) = &jobs.analysis {
        let stage = job.stage.map_or("waiting", crate::analysis::Stage::name);
        (job, stage, job.stage.map(|stage| stage as usize as f32 / stages))
    } else if let Some(job) = &jobs.reading {
        (job, "reading", None)
    } else if let Some(job) = &jobs.export {
        (job, "writing", job.files.map(|(done, total)| done as f32 / total.max(1) as f32))
    } else {
        return;
    };
    let elapsed = job.since.elapsed();
    if let Some(rest) = PROGRESS_DELAY.checked_sub(elapsed) {
        ui.ctx().request_repaint_after(rest);
        return;
    }
    if words == "writing"
        && ui.small_button("Cancel").on_hover_text("Stop writing; nothing is left half written.").clicked()
    {
        cx.send(JobCommand::CancelExport);
    }
    let bar = egui::ProgressBar::new(done.unwrap_or(1.0)).desired_width(72.0).desired_height(6.0);
    ui.add(bar.fill(cx.palette.accent));
    ui.label(RichText::new(words).size(SMALL_PT).color(cx.palette.accent));
    ui.add(egui::Spinner::new().size(12.0).color(cx.palette.accent));
}
