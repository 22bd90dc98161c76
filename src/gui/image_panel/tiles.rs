//! Large pictures cut into tiles, one texture each, and smaller copies of overlays.

use crate::raster::Raster;
use egui::{Color32, ColorImage, Rect, TextureFilter, TextureOptions, pos2};

/// Side of a tile without its border, texels.
pub const TILE: usize = 1024;

/// Texture filtering: sharp pixels when enlarged, smooth when reduced.
pub fn texture_options() -> TextureOptions {
    TextureOptions {
        magnification: TextureFilter::Nearest,
        minification: TextureFilter::Linear,
        ..TextureOptions::default()
    }
}

/// A part of a picture. The uploaded texture has a border of one texel where the picture continues, because smoothing
/// at the edge reads the neighboring texel.
pub struct Tile {
    /// The drawn part, texels of the picture.
    pub inner: Rect,
    /// The uploaded part with the border, texels of the picture.
    pub outer: Rect,
}

impl Tile {
    /// The tile at a column and row of tiles; `None` outside of the picture.
    pub fn of(texels: &Raster<[u8; 4]>, column: usize, row: usize) -> Option<Self> {
        let (left, top) = (column * TILE, row * TILE);
        let (right, bottom) = ((left + TILE).min(texels.width()), (top + TILE).min(texels.height()));
        let rect = |left, top, right, bottom| {
            Rect::from_min_max(pos2(left as f32, top as f32), pos2(right as f32, bottom as f32))
        };
        (left < right && top < bottom).then(|| Self {
            inner: rect(left, top, right, bottom),
            outer: rect(
                left.saturating_sub(1),
                top.saturating_sub(1),
                (right + 1).min(texels.width()),
                (bottom + 1).min(texels.height()),
            ),
        })
    }

    /// The texels to upload.
    pub fn image(&self, texels: &Raster<[u8; 4]>) -> ColorImage {
        let columns = self.outer.min.x as usize..self.outer.max.x as usize;
        let rows = self.outer.min.y as usize..self.outer.max.y as usize;
        // Neighboring texels of overlays are mostly equal, so the last conversion is kept.
        let mut last = ([0u8; 4], Color32::TRANSPARENT);
        let mut color = |&texel: &[u8; 4]| {
            if texel != last.0 {
                let [r, g, b, a] = texel;
                last = (texel, Color32::from_rgba_unmultiplied(r, g, b, a));
            }
            last.1
        };
        let size = [columns.len(), rows.len()];
        let mut pixels = Vec::with_capacity(columns.len() * rows.len());
        let mut add = |y: usize| pixels.extend(texels.row(y)[columns.clone()].iter().map(&mut color));
        rows.for_each(&mut add);
        ColorImage::new(size, pixels)
    }
}

/// Smaller copies, each half as large as the one before, which keep thin outlines: a texel is the most opaque of 2 ×
/// 2. The
/// last copy has at least 33 texels on its longer side.
pub fn copies_of_marks(marks: &Raster<[u8; 4]>) -> Vec<Raster<[u8; 4]>> {
    let mut levels: Vec<Raster<[u8; 4]>> = Vec::new();
    loop {
        let last = levels.last().unwrap_or(marks);
        let (width, height) = (last.width().div_ceil(2), last.height().div_ceil(2));
        if last.width().max(last.height()) <= 64 {
            return levels;
        }
        let most_opaque = |at: usize| {
            let (x, y) = (at % width * 2, at / width * 2);
            let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            four.iter().filter_map(|&(x, y)| last.get(x, y)).max_by_key(|texel| texel[3]).copied()
        };
        let data = (0..width * height).map(|at| most_opaque(at).unwrap_or_default()).collect();
        levels.push(Raster::from_vec(width, height, data).unwrap_or_default());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_overlap_by_a_texel_where_the_picture_goes_on() {
        let texels = Raster::filled(TILE + 10, 5, [0; 4]);
        let first = Tile::of(&texels, 0, 0).unwrap();
        let second = Tile::of(&texels, 1, 0).unwrap();
        assert_eq!((first.inner.max.x, first.outer.max.x), (1024.0, 1025.0));
        assert_eq!((second.outer.min.x, second.outer.max.x), (1023.0, 1034.0));
        assert_eq!(second.image(&texels).size, [11, 5]);
        assert!(Tile::of(&texels, 2, 0).is_none());
    }

    #[test]
    fn a_thin_outline_survives_in_smaller_copies() {
        let mut marks = Raster::filled(200, 100, [0u8; 4]);
        marks[37 * 200 + 133] = [9, 9, 9, 255];
        let levels = copies_of_marks(&marks);
        assert_eq!(levels.len(), 2);
        assert_eq!(*levels[1].get(33, 9).unwrap(), [9, 9, 9, 255]);
    }
}
