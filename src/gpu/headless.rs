//! A graphics device without a window: for picture files, `screenshot` and tests.

use thiserror::Error;

/// A device to draw with, and where it comes from.
#[derive(Debug)]
pub struct Headless {
    /// The graphics interface.
    pub instance: wgpu::Instance,
    /// The graphics card, or the software that stands in for one.
    pub adapter: wgpu::Adapter,
    /// What makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// Where work is submitted.
    pub queue: wgpu::Queue,
}

/// Nothing here can draw.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no graphics device can draw the color space ({0}); install the graphics card's Vulkan driver or, without a card, \
     Mesa's software one (Debian and Ubuntu: apt install libvulkan1 mesa-vulkan-drivers)"
)]
pub struct NoAdapter(String);

impl Headless {
    /// Vulkan where there is one, then whatever else the system has.
    ///
    /// One interface at a time: asked for all at once, the same machine may answer with OpenGL, whose pictures differ
    /// slightly.
    ///
    /// # Errors
    /// When no adapter is found or the one found refuses to work.
    pub fn new() -> Result<Self, NoAdapter> {
        Self::on(wgpu::Backends::VULKAN).or_else(|vulkan| {
            let others = wgpu::Backends::all() - wgpu::Backends::VULKAN;
            Self::on(others).map_err(|other| NoAdapter(format!("Vulkan: {vulkan}; others: {other}")))
        })
    }

    /// What draws, in words: "llvmpipe (LLVM 15.0.6, 256 bits), Vulkan".
    pub fn description(&self) -> String {
        let info = self.adapter.get_info();
        format!("{}, {:?}", info.name, info.backend)
    }

    fn on(backends: wgpu::Backends) -> Result<Self, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..wgpu::RequestAdapterOptions::default()
        };
        let adapter =
            pollster::block_on(instance.request_adapter(&options)).map_err(|_| "no adapter".to_owned())?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("dichroscope"),
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        }))
        .map_err(|e| e.to_string())?;
        Ok(Self { instance, adapter, device, queue })
    }
}
