//! A graphics device without a window, for picture files, `screenshot` and tests.

use thiserror::Error;

/// A graphics device, with the adapter and the instance that the device comes from.
#[derive(Debug)]
pub struct Headless {
    /// The graphics interface.
    pub instance: wgpu::Instance,
    /// The graphics card, or a software renderer.
    pub adapter: wgpu::Adapter,
    /// The device, which makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// The queue to which commands are submitted.
    pub queue: wgpu::Queue,
}

/// No graphics adapter can be used; the text says why.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no graphics device can draw the color space ({0}); install the graphics card's Vulkan driver or, without a card, \
     Mesa's software one (Debian and Ubuntu: apt install libvulkan1 mesa-vulkan-drivers)"
)]
pub struct NoAdapter(String);

impl Headless {
    /// Opens a device by Vulkan, or where there is none, by any other interface of the system.
    ///
    /// The interfaces are requested one after the other, because a request for all interfaces may return OpenGL, whose pictures
    /// differ slightly.
    ///
    /// # Errors
    /// When no adapter is found, or the adapter cannot open a device.
    pub fn new() -> Result<Self, NoAdapter> {
        Self::on(wgpu::Backends::VULKAN).or_else(|vulkan| {
            let others = wgpu::Backends::all() - wgpu::Backends::VULKAN;
            Self::on(others).map_err(|other| NoAdapter(format!("Vulkan: {vulkan}; others: {other}")))
        })
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
