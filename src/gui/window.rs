//! The window on the desktop.

use super::App;
use crate::truth::sample;
use crate::workbench::{Command, Executor, Origin, Settings, Severity};
use egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::PathBuf;

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
#[error("no window can be opened here ({0}); `dichroscope analyze PHOTO --out DIR` needs none")]
pub struct WindowError(String);

/// Opens the window on `photograph`, or on the sample scene, and returns when it is closed.
///
/// # Errors
/// Where there is no display or no graphics adapter.
pub fn open(photograph: Option<PathBuf>) -> Result<(), WindowError> {
    let origin = photograph.map_or_else(|| Origin::Sample(sample::NAME.to_owned()), Origin::File);
    let viewport = egui::ViewportBuilder::default()
        .with_title("Dichroscope")
        .with_app_id("dichroscope")
        .with_inner_size([1440.0, 900.0])
        .with_min_inner_size([900.0, 560.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration {
            wgpu_setup: WgpuSetup::CreateNew(WgpuSetupCreateNew::without_display_handle()),
            ..WgpuConfiguration::default()
        },
        ..eframe::NativeOptions::default()
    };
    let create = move |cc: &eframe::CreationContext<'_>| {
        let mut app = App::new(&cc.egui_ctx, cc.wgpu_render_state.clone(), Executor::Threads)?;
        if let Some(path) = Settings::path() {
            let (settings, warning) = Settings::load(&path);
            app.remember(settings);
            if let Some(text) = warning {
                app.apply(Command::Notify(Severity::Warning, text));
            }
        }
        app.apply(Command::Open(origin));
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("dichroscope", options, Box::new(create))
        .map_err(|error| WindowError(reason(&error.to_string()).to_owned()))
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
    fn a_reason_tells_no_places_in_sources() {
        let winit = "winit EventLoopError: os error at /home/a/linux/mod.rs:765: neither DISPLAY nor WAYLAND_DISPLAY is set.";
        assert_eq!(reason(winit), "neither DISPLAY nor WAYLAND_DISPLAY is set");
        assert_eq!(reason("no adapter: out of memory"), "no adapter: out of memory");
    }
}
