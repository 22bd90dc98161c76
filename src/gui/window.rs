//! The application's window on the desktop.

use super::App;
use crate::app::{Executor, JobCommand, Settings, Severity, ViewCommand, catch_panic, is_workspace};
use crate::truth::sample;
use crate::view::{Arrangement, ElsewherePaths, ImageSettings, Origin};
use egui_wgpu::{RenderState, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The reason why no window could be opened.
#[derive(Debug, thiserror::Error)]
#[error("no window can be opened here ({0}); `dichroscope analyze PHOTO --out DIR` needs none")]
pub struct WindowError(String);

/// Opens the window on `files` (photographs, of which the first is shown, folders of photographs, or a workspace), or on the sample scene, and returns when it
/// is closed. `elsewhere` holds pictures that another program made of the only photograph; a workspace has its own.
///
/// When the graphics device is lost (a driver restarts, a card is unplugged), the window closes, and another window
/// with a new device opens with the same application in it. The same happens after a panic outside of the panels.
///
/// # Errors
/// When there is no display or no graphics adapter, and when panics repeat.
pub fn open(files: Vec<PathBuf>, elsewhere: ElsewherePaths) -> Result<(), WindowError> {
    let mut first_job = Some(first_job(files, elsewhere));
    let handover: Handover = Arc::default();
    let mut panics = 0;
    loop {
        let (job, handed_over) = (first_job.take(), Arc::clone(&handover));
        let create = move |cc: &eframe::CreationContext<'_>| {
            let app = lock(&handed_over).take();
            let app = match (app, job) {
                (Some(mut app), _) => {
                    app.move_to(&cc.egui_ctx, cc.wgpu_render_state.clone());
                    app
                }
                (None, job) => first_app(cc, job)?,
            };
            let lost = cc
                .wgpu_render_state
                .as_ref()
                .map_or_else(Arc::default, |gpu| device_lost_flag(gpu, &cc.egui_ctx));
            let device_error = cc.wgpu_render_state.as_ref().map_or_else(Arc::default, device_error);
            let window = WindowApp { app: Some(app), lost, device_error, handover: handed_over };
            Ok(Box::new(window) as Box<dyn eframe::App>)
        };
        let run = || eframe::run_native("dichroscope", options(), Box::new(create));
        match catch_panic(run) {
            // A lost device leaves the application in the handover: another window opens.
            Ok(Ok(())) if lock(&handover).is_some() => {}
            Ok(result) => {
                return result.map_err(|error| WindowError(short_reason(&error.to_string()).to_owned()));
            }
            Err(reason) => {
                panics += 1;
                reopen_after_panic(&handover, &reason, panics)?;
            }
        }
    }
}

/// The first job of the window: opens a workspace, photographs, the photographs in folders, or the sample scene where no file is given.
fn first_job(files: Vec<PathBuf>, elsewhere: ElsewherePaths) -> JobCommand {
    if files.iter().any(|path| path.is_dir()) {
        return JobCommand::OpenFolders(files.into_iter().map(Origin::File).collect());
    }
    match <[PathBuf; 1]>::try_from(files) {
        Ok([path]) if is_workspace(&path) => JobCommand::OpenWorkspace(path),
        Ok([path]) => JobCommand::OpenBeside(Origin::File(path), elsewhere),
        Err(none) if none.is_empty() => {
            JobCommand::OpenBeside(Origin::Sample(sample::NAME.to_owned()), elsewhere)
        }
        Err(several) => JobCommand::OpenFilesFirstShown(several.into_iter().map(Origin::File).collect()),
    }
}

/// Largest number of panics after which another window is opened.
const MOST_PANICS: usize = 3;

/// Prepares the application for another window after a panic outside of the panels, and saves the workspace.
///
/// # Errors
/// When the application was lost with the window, or the panics repeat.
fn reopen_after_panic(handover: &Handover, reason: &str, panics: usize) -> Result<(), WindowError> {
    let mut handed_over = lock(handover);
    let failed = |saved: &str| {
        WindowError(format!("the window was ended by an error of the program: {reason}{saved}"))
    };
    let Some(app) = handed_over.as_mut() else { return Err(failed("")) };
    if panics > MOST_PANICS {
        let saved = app.rescue_workspace().map_or_else(
            |_| String::new(),
            |path| format!("; the workspace was saved to {}", path.display()),
        );
        return Err(failed(&saved));
    }
    let text = format!(
        "the window was ended by an error of the program ({reason}) and opened again; please report the error, and go on"
    );
    app.apply(JobCommand::Rescue(text));
    Ok(())
}

/// Holds the application after a window with a lost device has closed, until the next window opens.
type Handover = Arc<Mutex<Option<App>>>;

/// The application that waits for the next window.
fn lock(handover: &Handover) -> std::sync::MutexGuard<'_, Option<App>> {
    handover.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The options of the desktop window.
fn options() -> eframe::NativeOptions {
    let viewport = egui::ViewportBuilder::default()
        .with_title("Dichroscope")
        .with_app_id("dichroscope")
        .with_icon(icon())
        .with_inner_size([1440.0, 900.0])
        .with_min_inner_size([640.0, 400.0])
        .with_drag_and_drop(true);
    eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration {
            wgpu_setup: WgpuSetup::CreateNew(wgpu_setup()),
            ..WgpuConfiguration::default()
        },
        ..eframe::NativeOptions::default()
    }
}

/// The setup of the graphics device: egui's own, with textures as large as the adapter can have, so that a window of more than
/// 8192 pixels can be drawn.
fn wgpu_setup() -> WgpuSetupCreateNew {
    let setup = WgpuSetupCreateNew::without_display_handle();
    let egui_descriptor = Arc::clone(&setup.device_descriptor);
    let device_descriptor = move |adapter: &wgpu::Adapter| {
        let mut descriptor = egui_descriptor(adapter);
        let limit = &mut descriptor.required_limits.max_texture_dimension_2d;
        *limit = (*limit).max(adapter.limits().max_texture_dimension_2d);
        descriptor
    };
    WgpuSetupCreateNew { device_descriptor: Arc::new(device_descriptor), ..setup }
}

/// The window's icon: a skewed T in a color cube; egui's default icon if the image cannot be decoded.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
}

/// The application of the first window, with the settings stored by the previous run.
fn first_app(cc: &eframe::CreationContext<'_>, job: Option<JobCommand>) -> std::io::Result<App> {
    let mut app = App::new(&cc.egui_ctx, cc.wgpu_render_state.clone(), Executor::Threads)?;
    if let Some(path) = Settings::path() {
        let is_first_start = !path.exists();
        let (settings, warning) = Settings::load(&path);
        app.restore_settings(settings);
        if is_first_start {
            // The photograph beside the photograph without highlights says what the program is for.
            let image = ImageSettings { arrangement: Arrangement::Wipe(0.5), ..ImageSettings::default() };
            app.apply(ViewCommand::Image(image));
        }
        if let Some(text) = warning {
            app.apply(ViewCommand::Notify(Severity::Warning, text));
        }
    }
    if let Some(job) = job {
        app.apply(job);
    }
    Ok(app)
}

/// A flag that is set when the graphics device is lost.
fn device_lost_flag(gpu: &RenderState, ctx: &egui::Context) -> Arc<AtomicBool> {
    let lost = Arc::new(AtomicBool::new(false));
    let (flag, ctx) = (Arc::clone(&lost), ctx.clone());
    gpu.device.set_device_lost_callback(move |_, message| {
        tracing::warn!("the graphics device was lost: {message}");
        flag.store(true, Ordering::Relaxed);
        ctx.request_repaint();
    });
    lost
}

/// The last error of the graphics device that nobody handled. Without this handler such an error ends the process: a window
/// that is larger than the device's largest texture is such an error.
fn device_error(gpu: &RenderState) -> Arc<Mutex<Option<String>>> {
    let last = Arc::new(Mutex::new(None));
    let slot = Arc::clone(&last);
    gpu.device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        tracing::warn!("the graphics device: {error}");
        *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
    }));
    last
}

/// The contents of one window.
struct WindowApp {
    app: Option<App>,
    lost: Arc<AtomicBool>,
    /// The last error of the graphics device, until a notice shows the error.
    device_error: Arc<Mutex<Option<String>>>,
    handover: Handover,
}

impl eframe::App for WindowApp {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        if let Some(gpu) = frame.wgpu_render_state() {
            // The callback of a lost device is called only while the device is polled.
            let _ = gpu.device.poll(wgpu::PollType::Poll);
        }
        // Nothing is drawn with a lost device: egui's painter would panic.
        if self.lost.load(Ordering::Relaxed) {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
        } else if let Some(app) = &mut self.app {
            if self.device_error.lock().unwrap_or_else(PoisonError::into_inner).take().is_some() {
                // The text of the error is in the log: it is long, and names what only the program knows.
                let text = "the graphics device could not draw this window: make the window smaller";
                app.apply(ViewCommand::Notify(Severity::Error, text.to_owned()));
            }
            app.show(ui);
        }
    }

    fn on_exit(&mut self) {
        let Some(app) = self.app.take() else { return };
        if self.lost.load(Ordering::Relaxed) {
            *lock(&self.handover) = Some(app);
        } else if let Some(path) = Settings::path()
            && let Err(reason) = Settings::of(app.state()).save(&path)
        {
            tracing::warn!("{reason}");
        }
    }
}

impl Drop for WindowApp {
    /// Hands the application over when a panic ends the window.
    fn drop(&mut self) {
        if std::thread::panicking()
            && let Some(app) = self.app.take()
        {
            *lock(&self.handover) = Some(app);
        }
    }
}

/// A message without the source location at its beginning and the full stop at its end.
fn short_reason(message: &str) -> &str {
    let after = message.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    after.map_or(message, |(_, reason)| reason).trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_icon_is_square() {
        let icon = icon();
        assert_eq!((icon.width, icon.height, icon.rgba.len()), (256, 256, 4 * 256 * 256));
    }

    #[test]
    fn a_workspace_is_opened_as_a_workspace_and_anything_else_as_a_photograph() {
        let first_job =
            |files: &[&str]| first_job(files.iter().map(PathBuf::from).collect(), ElsewherePaths::default());
        assert!(matches!(first_job(&["a.dichroscope"]), JobCommand::OpenWorkspace(_)));
        assert!(matches!(first_job(&["a.png"]), JobCommand::OpenBeside(Origin::File(_), _)));
        assert!(matches!(first_job(&[]), JobCommand::OpenBeside(Origin::Sample(_), _)));
        let JobCommand::OpenFilesFirstShown(files) = first_job(&["a.png", "b.png", "c.png"]) else {
            panic!()
        };
        let names: Vec<String> = files.iter().map(Origin::name).collect();
        assert_eq!(names, ["a.png", "b.png", "c.png"]);
    }

    #[test]
    fn an_error_message_has_no_source_location() {
        let winit = "winit EventLoopError: os error at /home/a/linux/mod.rs:765: neither DISPLAY nor WAYLAND_DISPLAY is set.";
        assert_eq!(short_reason(winit), "neither DISPLAY nor WAYLAND_DISPLAY is set");
        assert_eq!(short_reason("no adapter: out of memory"), "no adapter: out of memory");
    }
}
