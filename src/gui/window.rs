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
        .map_err(|error| WindowError(error.to_string()))
}
