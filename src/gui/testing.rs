//! The application in a harness, with a real graphics device where there is one.

use super::App;
use crate::app::{Command, Executor};
use crate::truth::sample;
use crate::view::Origin;
use egui_kittest::Harness;
use egui_kittest::wgpu::WgpuTestRenderer;
use egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};

/// A graphics device and a harness of 1440 × 900 points around an application; none, with the reason printed, where no
/// adapter is found, unless `DICHROSCOPE_REQUIRE_GPU` is set.
pub fn harness() -> Option<(Harness<'static, App>, RenderState)> {
    let gpu = match render_state() {
        Ok(gpu) => gpu,
        Err(reason) => {
            assert!(std::env::var_os("DICHROSCOPE_REQUIRE_GPU").is_none(), "a GPU is required: {reason}");
            eprintln!("SKIP: no graphics adapter ({reason})");
            return None;
        }
    };
    let renderer = WgpuTestRenderer::from_render_state(gpu.clone());
    let of_app = gpu.clone();
    let harness = Harness::builder()
        .with_size([1440.0, 900.0])
        .with_pixels_per_point(1.0)
        .with_max_steps(16)
        .with_render_cursor(false)
        .renderer(renderer)
        .build_eframe(move |cc| {
            App::new(&cc.egui_ctx, Some(of_app.clone()), Executor::Inline).expect("inline needs no thread")
        });
    Some((harness, gpu))
}

/// Opens the sample scene and shows it.
pub fn open_sample(harness: &mut Harness<App>) {
    harness.state_mut().apply(Command::Open(Origin::Sample(sample::NAME.to_owned())));
    harness.run_steps(3);
    assert!(harness.state().state().newest.is_some(), "the sample is analyzed");
}

/// Vulkan alone: another interface gives slightly different pictures.
fn render_state() -> Result<RenderState, String> {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::VULKAN;
    let config =
        WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..WgpuConfiguration::default() };
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(RenderState::create(&config, &instance, None, RendererOptions::PREDICTABLE))
        .map_err(|error| error.to_string())
}
