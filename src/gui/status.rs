//! The status line: photograph, size, encoding, noise, number of regions, coverage, time, and the
//! progress of running work.

use super::theme::SMALL_PT;
use super::work_shown::{PROGRESS_DELAY, RECORDING_DELAY};
use super::{PanelContext, lacking_result, working_sign};
use crate::analysis::Stage;
use crate::app::{Command, Job, JobCommand, JobState};
use crate::params::Parameter;
use egui::accesskit::Role;
use egui::{Align, Layout, RichText, Ui, WidgetInfo};
use std::time::Duration;

/// Smallest width of a part, points.
const LEAST_PART_PT: f32 = 44.0;

/// Shows the line, right-aligned in the remaining space of the menu bar.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        progress(ui, cx);
        for StatusPart { text, tip, is_bad } in parts(cx).into_iter().rev() {
            // A part without room for a word is left out, so that no text lies on the menus.
            if ui.available_width() < LEAST_PART_PT {
                break;
            }
            let color = if is_bad { cx.palette.warning } else { cx.palette.secondary };
            let job = super::widgets::with_subscripts(&text, SMALL_PT, color);
            let label = ui.add(egui::Label::new(job).truncate().show_tooltip_when_elided(false));
            label.on_hover_text(format!("{text}\n{tip}"));
        }
    });
}

/// A part of the line.
struct StatusPart {
    text: String,
    /// What the part says, as a sentence.
    tip: String,
    /// Whether the part says that something is bad or unusual.
    is_bad: bool,
}

/// The parts of the line, from left to right.
fn parts(cx: &PanelContext) -> Vec<StatusPart> {
    let Some(picture) = &cx.state.picture else { return Vec::new() };
    let (width, height) = picture.size();
    let quiet = |text: String, tip: &str| StatusPart { text, tip: tip.to_owned(), is_bad: false };
    let place =
        picture.origin.path().map_or_else(|| "A sample scene.".to_owned(), |path| path.display().to_string());
    let mut parts = vec![
        quiet(picture.origin.name(), &place),
        quiet(format!("{width} \u{d7} {height}"), "Columns and rows of the photograph."),
        quiet(
            picture.photo.encoding.to_string(),
            "How the numbers of the file were read as amounts of light (File, Read as).",
        ),
    ];
    // The verdict under the picture is about the same result.
    let preview = cx.state.shown_preview().map(|(preview, _)| &preview.shown);
    if let Some(shown) = preview.or_else(|| cx.state.shown()) {
        let used = &shown.analysis.used;
        let auto = if shown.params.get(Parameter::CameraNoise).value().is_none() { " auto" } else { "" };
        if cx.state.shows_pinned() {
            let tip = "The views show the pinned result; the key A goes back to the newest, B.".to_owned();
            parts.insert(0, StatusPart { text: "A: the pinned result".to_owned(), tip, is_bad: true });
        }
        if cx.state.shows_other_parameters() {
            let tip =
                "What follows belongs to other parameters: the present ones are not analyzed.".to_owned();
            parts.push(StatusPart { text: "the result before:".to_owned(), tip, is_bad: true });
        }
        parts.push(quiet(
            format!("\u{3c3}0 {:.2}{auto}", used.camera_noise),
            "Noise of the camera in counts, given or estimated from the photograph (section 5.2.1).",
        ));
        let regions = &shown.analysis.intrinsic.regions;
        let misfits = regions.iter().filter(|region| !region.model_fits()).count();
        let text = regions_and_coverage(regions.len(), misfits, shown.coverage);
        let tip = "Regions, those that the model does not fit, and the share of the lit pixels that lie in regions.";
        parts.push(StatusPart { text, tip: tip.to_owned(), is_bad: misfits > 0 });
        // Until the last stage is there, the sum would be the time of some of them; where no stage ran anew, that of none.
        let has_run = shown.took_ms.iter().any(Option::is_some);
        if shown.stale_from.is_none() && preview.is_none() && has_run {
            parts.push(quiet(duration_text(shown.total_ms()), "Time that the analysis took."));
        }
    }
    parts
}

/// The number of regions, of those the number that the model does not fit, and the share of the lit pixels in regions, 0…1.
fn regions_and_coverage(regions: usize, misfits: usize, coverage: f64) -> String {
    let misfits = match misfits {
        0 => String::new(),
        1 => ", 1 does not fit".to_owned(),
        some => format!(", {some} do not fit"),
    };
    let regions = crate::describe::counted(regions, "region");
    format!("{regions}{misfits}, {:.1} % of lit pixels", 100.0 * coverage)
}

/// A duration of `ms` milliseconds with two or three digits: in seconds from one second on.
fn duration_text(ms: f64) -> String {
    match ms {
        10_000.0.. => format!("{:.0} s", ms / 1000.0),
        1000.0.. => format!("{:.1} s", ms / 1000.0),
        100.0.. => format!("{ms:.0} ms"),
        _ => format!("{ms:.1} ms"),
    }
}

/// Work under way, as the line shows it.
struct Progress {
    job: Job,
    /// Time after which the work is shown.
    delay: Duration,
    words: String,
    /// The share that is done, 0…1; none where that is not known.
    done: Option<f32>,
    /// Of work that can be canceled: the accessible name of the button, its tooltip and its command.
    cancel: Option<(&'static str, &'static str, JobCommand)>,
}

/// The work that is under way; none where the window waits for nothing. `has_preview`: whether the result for the working picture is there,
/// after which the stages are those at full resolution.
fn progress_of(jobs: &JobState, has_preview: bool) -> Option<Progress> {
    if let Some(job) = jobs.analysis {
        let tip = "Stop the analysis; the result before stays (Esc).";
        let cancel = ("Cancel the analysis", tip, JobCommand::CancelAnalysis);
        let progress = staged(job, PROGRESS_DELAY, "analyzing", cancel);
        let words = "analyzing: full resolution".to_owned();
        return Some(if has_preview { Progress { words, done: None, ..progress } } else { progress });
    }
    let delay = PROGRESS_DELAY;
    if let Some(job) = jobs.reading {
        return Some(Progress { job, delay, words: "reading".to_owned(), done: None, cancel: None });
    }
    if let Some(job) = jobs.export {
        let done = job.files.map(|(done, total)| done as f32 / total.max(1) as f32);
        let tip = "Stop writing; nothing is left half written.";
        let cancel = (!jobs.cancels_export).then_some(("Cancel the export", tip, JobCommand::CancelExport));
        let words = if jobs.cancels_export { "canceling" } else { "writing" };
        return Some(Progress { job, delay, words: words.to_owned(), done, cancel });
    }
    let tip = "Stop recording the decisions for the timeline; the result stays (Esc).";
    let cancel = ("Cancel the recording", tip, JobCommand::CancelAnalysis);
    jobs.recording.map(|job| staged(job, RECORDING_DELAY, "recording", cancel))
}

/// The progress of work that goes through the stages. `verb`: what is done, in a word.
fn staged(
    job: Job,
    delay: Duration,
    verb: &str,
    cancel: (&'static str, &'static str, JobCommand),
) -> Progress {
    let words = job.stage.map_or_else(|| "waiting".to_owned(), |stage| format!("{verb}: {}", stage.name()));
    let done = job.stage.map(|stage| stage as usize as f32 / Stage::ALL.len() as f32);
    Progress { job, delay, words, done, cancel: Some(cancel) }
}

/// Shows the progress of work that takes longer than a moment, or what is not analyzed.
fn progress(ui: &mut Ui, cx: &mut PanelContext) {
    let has_preview =
        cx.state.shown_preview().is_some_and(|(preview, _)| preview.shown.generation >= cx.state.generation);
    let Some(Progress { job, delay, words, done, cancel }) = progress_of(&cx.state.jobs, has_preview) else {
        if cx.state.lacks_result() {
            lacking_result::show_status(ui, cx);
        }
        return;
    };
    let elapsed = job.since.elapsed();
    if let Some(rest) = delay.checked_sub(elapsed) {
        ui.ctx().request_repaint_after(rest);
        return;
    }
    if let Some((name, tip, command)) = cancel {
        let button =
            ui.add(egui::Button::new(RichText::new("Cancel").size(SMALL_PT)).small()).on_hover_text(tip);
        button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
        if button.clicked() {
            cx.send(command);
        }
    }
    // The command is applied after the frame: the frame in which it was given says so already.
    let is_canceled =
        cx.commands.iter().any(|command| matches!(command, Command::Job(JobCommand::CancelAnalysis)));
    let words = if is_canceled { "canceling".to_owned() } else { words };
    // A bar without a measure would look like work that has ended.
    if let Some(done) = done {
        let bar = egui::ProgressBar::new(done).desired_width(72.0).desired_height(6.0);
        ui.add(bar.fill(cx.palette.accent));
    }
    ui.label(RichText::new(words).size(SMALL_PT).color(cx.palette.accent));
    working_sign::show(ui, cx.palette.accent, elapsed);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_that_do_not_fit_are_named_before_the_coverage() {
        assert_eq!(regions_and_coverage(7, 6, 0.991), "7 regions, 6 do not fit, 99.1 % of lit pixels");
        assert_eq!(regions_and_coverage(7, 1, 1.0), "7 regions, 1 does not fit, 100.0 % of lit pixels");
        assert_eq!(regions_and_coverage(1, 0, 0.5), "1 region, 50.0 % of lit pixels");
        let texts = [47434.9, 1234.0, 171.2, 32.71].map(duration_text);
        assert_eq!(texts, ["47 s", "1.2 s", "171 ms", "32.7 ms"]);
    }
}
