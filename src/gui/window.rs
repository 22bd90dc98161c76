//! The window on the desktop.

use super::App;
use crate::app::{Command, Executor, Settings, Severity};
use crate::truth::sample;
use crate::view::Origin;
use egui_wgpu::{RenderState, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
#[error("no window can be opened here ({0}); `dichroscope analyze PHOTO --out DIR` needs none")]
pub struct WindowError(String);

/// Opens the window on `photograph`, or on the sample scene, and returns when it is closed.
///
/// A graphics device that is lost (a driver that restarts, a card that is unplugged) is replaced: the window closes and
/// opens again with everything that was in it.
///
/// # Errors
/// Where there is no display or no graphics adapter.
pub fn open(photograph: Option<PathBuf>) -> Result<(), WindowError> {
    let mut origin = Some(photograph.map_or_else(|| Origin::Sample(sample::NAME.to_owned()), Origin::File));
    let passage: Passage = Arc::default();
    loop {
        let (origin, arrived) = (origin.take(), Arc::clone(&passage));
        let create = move |cc: &eframe::CreationContext<'_>| {
            let app = lock(&arrived).take();
            let app = match (app, origin) {
                (Some(mut app), _) => {
                    app.move_to(&cc.egui_ctx, cc.wgpu_render_state.clone());
                    app
                }
                (None, origin) => begin(cc, origin)?,
            };
            let lost =
                cc.wgpu_render_state.as_ref().map_or_else(Arc::default, |gpu| watch(gpu, &cc.egui_ctx));
            Ok(Box::new(Tenant { app: Some(app), lost, passage: arrived }) as Box<dyn eframe::App>)
        };
        let ended = eframe::run_native("dichroscope", options(), Box::new(create));
        if lock(&passage).is_none() {
            return ended.map_err(|error| WindowError(reason(&error.to_string()).to_owned()));
        }
    }
}

/// Where the application waits between a window whose device was lost and the next.
type Passage = Arc<Mutex<Option<App>>>;

fn lock(passage: &Passage) -> std::sync::MutexGuard<'_, Option<App>> {
    passage.lock().unwrap_or_else(PoisonError::into_inner)
}

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

/// The window's icon: a skewed T in a color cube; the toolkit's own where the picture cannot be decoded.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
}

/// The application of the first window, as it was left the last time.
fn begin(cc: &eframe::CreationContext<'_>, origin: Option<Origin>) -> std::io::Result<App> {
    let mut app = App::new(&cc.egui_ctx, cc.wgpu_render_state.clone(), Executor::Threads)?;
    if let Some(path) = Settings::path() {
        let (settings, warning) = Settings::load(&path);
        app.remember(settings);
        if let Some(text) = warning {
            app.apply(Command::Notify(Severity::Warning, text));
        }
    }
    if let Some(origin) = origin {
        app.apply(Command::Open(origin));
    }
    Ok(app)
}

/// Set when the device is lost.
fn watch(gpu: &RenderState, ctx: &egui::Context) -> Arc<AtomicBool> {
    let lost = Arc::new(AtomicBool::new(false));
    let (flag, ctx) = (Arc::clone(&lost), ctx.clone());
    gpu.device.set_device_lost_callback(move |_, message| {
        tracing::warn!("the graphics device was lost: {message}");
        flag.store(true, Ordering::Relaxed);
        ctx.request_repaint();
    });
    lost
}

/// The application in one window.
struct Tenant {
    app: Option<App>,
    lost: Arc<AtomicBool>,
    passage: Passage,
}

impl eframe::App for Tenant {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        if let Some(gpu) = frame.wgpu_render_state() {
            // A device tells of its loss only when it is asked.
            let _ = gpu.device.poll(wgpu::PollType::Poll);
        }
        // Nothing is drawn with a device that is gone: egui's painter would panic.
        if self.lost.load(Ordering::Relaxed) {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
        } else if let Some(app) = &mut self.app {
            app.show(ui);
        }
    }

    fn on_exit(&mut self) {
        let Some(app) = self.app.take() else { return };
        if self.lost.load(Ordering::Relaxed) {
            *lock(&self.passage) = Some(app);
        } else if let Some(path) = Settings::path()
            && let Err(reason) = Settings::of(app.state()).save(&path)
        {
            tracing::warn!("{reason}");
        }
    }
}

/// What a message says, without the place in somebody's source that it begins with and the full stop that it ends with.
fn reason(message: &str) -> &str {
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
    fn a_reason_tells_no_places_in_sources() {
        let winit = "winit EventLoopError: os error at /home/a/linux/mod.rs:765: neither DISPLAY nor WAYLAND_DISPLAY is set.";
        assert_eq!(reason(winit), "neither DISPLAY nor WAYLAND_DISPLAY is set");
        assert_eq!(reason("no adapter: out of memory"), "no adapter: out of memory");
    }
}
