//! The textures that are drawn into, and reading textures back to the CPU.

use wgpu::{TextureFormat, TextureUsages};

/// Format of the picture: sRGB bytes without conversion, so that colors are blended like the window's colors.
pub(super) const COLOR_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;
pub(super) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

/// The textures of a picture: color and depth.
pub(super) struct Target {
    pub(super) size_px: [u32; 2],
    color: wgpu::Texture,
    pub(super) color_view: wgpu::TextureView,
    pub(super) depth_view: wgpu::TextureView,
}

impl Target {
    pub(super) fn new(device: &wgpu::Device, size_px: [u32; 2]) -> Self {
        let color_usage =
            TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        let color = texture(device, size_px, COLOR_FORMAT, color_usage);
        let depth = texture(device, size_px, DEPTH_FORMAT, TextureUsages::RENDER_ATTACHMENT);
        Self {
            size_px,
            color_view: color.create_view(&wgpu::TextureViewDescriptor::default()),
            depth_view: depth.create_view(&wgpu::TextureViewDescriptor::default()),
            color,
        }
    }

    /// The picture as rows of premultiplied RGBA without padding. Waits for the device; `None` when the device was lost.
    pub(super) fn read_back(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Vec<u8>> {
        read_texture(device, queue, &self.color)
    }
}

/// The pixels of an RGBA texture with 8 bits per channel and the usage `COPY_SRC`, as rows without padding. Waits for the device;
/// `None` when the device was lost.
pub fn read_texture(device: &wgpu::Device, queue: &wgpu::Queue, texture: &wgpu::Texture) -> Option<Vec<u8>> {
    let (width, height) = (texture.width(), texture.height());
    let row_bytes = 4 * width;
    let padded_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(padded_bytes) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_bytes),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    // A failure of the mapping is found when the mapped range is read.
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let mapped = buffer.get_mapped_range(..).ok()?;
    let rows = mapped.chunks_exact(padded_bytes as usize);
    Some(rows.flat_map(|row| &row[..row_bytes as usize]).copied().collect())
}

/// The largest size with the same aspect ratio whose sides are at most `limit_px` and at least one pixel, and the factor to that
/// size.
pub(super) fn within_limits(size_px: [u32; 2], limit_px: u32) -> ([u32; 2], f32) {
    let longest = size_px[0].max(size_px[1]);
    if longest <= limit_px {
        return (size_px, 1.0);
    }
    let shrink = f64::from(limit_px) / f64::from(longest);
    (size_px.map(|length| ((f64::from(length) * shrink) as u32).clamp(1, limit_px)), shrink as f32)
}

fn texture(
    device: &wgpu::Device,
    [width, height]: [u32; 2],
    format: TextureFormat,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("color space"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

#[cfg(test)]
mod tests {
    use super::within_limits;

    #[test]
    fn sizes_keep_their_shape() {
        assert_eq!(within_limits([800, 600], 8192), ([800, 600], 1.0));
        assert_eq!(within_limits([32_000, 16_000], 8000), ([8000, 4000], 0.25));
        assert_eq!(within_limits([100_000, 1], 8000), ([8000, 1], 0.08));
    }
}
