//! The application's window on the desktop.

use super::App;
use crate::app::{Executor, JobCommand, Settings, Severity, ViewCommand};
use crate::truth::sample;
use crate::view::Origin;
use egui_wgpu::{RenderState, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The reason why no window could be opened.
#[derive(Debug, thiserror::Error)]
#[error("no window can be opened here ({0}); `dichroscope analyze PHOTO --out DIR` needs none")]
pub struct WindowError(String);

/// Opens the window on `photograph`, or on the sample scene, and returns when it is closed.
///
/// When the graphics device is lost (a driver restarts, a card is unplugged), the window closes, and another window
/// with a new device opens with the same application in it.
///
/// # Errors
/// When there is no display or no graphics adapter.
pub fn open(photograph: Option<PathBuf>) -> Result<(), WindowError> {
    let mut origin = Some(photograph.map_or_else(|| Origin::Sample(sample::NAME.to_owned()), Origin::File));
    let handover: Handover = Arc::default();
    loop {
        let (origin, handed_over) = (origin.take(), Arc::clone(&handover));
        let create = move |cc: &eframe::CreationContext<'_>| {
            let app = lock(&handed_over).take();
            let app = match (app, origin) {
                (Some(mut app), _) => {
                    app.move_to(&cc.egui_ctx, cc.wgpu_render_state.clone());
                    app
                }
                (None, origin) => first_app(cc, origin)?,
            };
            let lost = cc
                .wgpu_render_state
                .as_ref()
                .map_or_else(Arc::default, |gpu| device_lost_flag(gpu, &cc.egui_ctx));
            Ok(Box::new(WindowApp { app: Some(app), lost, handover: handed_over }) as Box<dyn eframe::App>)
        };
        let result = eframe::run_native("dichroscope", options(), Box::new(create));
        if lock(&handover).is_none() {
            return result.map_err(|error| WindowError(short_reason(&error.to_string()).to_owned()));
        }
    }
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
        .with_min_inner_size([900.0, 560.0])
        .with_drag_and_drop(true);
    eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration {
            wgpu_setup: WgpuSetup::CreateNew(WgpuSetupCreateNew::without_display_handle()),
            ..WgpuConfiguration::default()
        },
        ..eframe::NativeOptions::default()
    }
}

/// The window's icon: a skewed T in a color cube; egui's default icon if the image cannot be decoded.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
}

/// The application of the first window, with the settings stored by the previous run.
fn first_app(cc: &eframe::CreationContext<'_>, origin: Option<Origin>) -> std::io::Result<App> {
    let mut app = App::new(&cc.egui_ctx, cc.wgpu_render_state.clone(), Executor::Threads)?;
    if let Some(path) = Settings::path() {
        let (settings, warning) = Settings::load(&path);
        app.restore_settings(settings);
        if let Some(text) = warning {
            app.apply(ViewCommand::Notify(Severity::Warning, text));
        }
    }
    if let Some(origin) = origin {
        app.apply(JobCommand::Open(origin));
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

/// The contents of one window.
struct WindowApp {
    app: Option<App>,
    lost: Arc<AtomicBool>,
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
    fn an_error_message_has_no_source_location() {
        let winit = "winit EventLoopError: os error at /home/a/linux/mod.rs:765: neither DISPLAY nor WAYLAND_DISPLAY is set.";
        assert_eq!(short_reason(winit), "neither DISPLAY nor WAYLAND_DISPLAY is set");
        assert_eq!(short_reason("no adapter: out of memory"), "no adapter: out of memory");
    }
}
