//! Painted layers and marks, and their textures. A layer is painted when its inputs changed; visible tiles are uploaded.

#[cfg(test)]
mod tests;

use super::geometry::{Placement, level_for};
use super::paint_request::{PaintRequest, TextureKey};
use super::tiles::{TILE, Tile, copies_of_marks, texture_options};
use crate::gui::task::Task;
use crate::raster::Raster;
use crate::view::pyramid;
use egui::{Color32, Context, Mesh, Painter, Rect, Shape, TextureHandle};
use std::collections::HashMap;
use std::time::Duration;

/// Number of pixels above which a picture is painted on a thread, so that no frame waits for the picture.
pub const LARGE_PX: usize = 1 << 20;
/// Largest number of textures.
const MOST_TEXTURES: usize = 8;
/// Largest number of pixels of all textures together.
const MOST_PX: usize = 40 << 20;

/// The place in the image view that a texture is shown at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The first layer.
    Layer,
    /// The second layer.
    SecondLayer,
    /// The marks, over both layers.
    Marks,
    /// The instant at the debugger's cursor, over the photograph.
    Instant,
    /// The outline of the selected region in a preview.
    PreviewOutline,
}

/// The textures that are kept.
pub struct TextureCache {
    textures: Vec<LayerTexture>,
    /// The texture that each slot showed last, which stays until the requested texture is painted.
    shown_last: [Option<TextureKey>; 5],
    painting: Option<Task<LayerTexture>>,
    /// The texture that `painting` makes.
    painting_key: Option<TextureKey>,
    /// The texture whose painting ended by a panic, and which is not tried again.
    failed_key: Option<TextureKey>,
    /// The texture that was painted last on a thread, until a slot shows it. Another slot may be asked first: dropped then, the texture
    /// would be painted again and again, and never shown.
    painted_key: Option<TextureKey>,
    /// Largest number of pixels of all textures together, unless those in use have more.
    most_px: usize,
    uses: u64,
}

impl Default for TextureCache {
    fn default() -> Self {
        Self {
            textures: Vec::new(),
            shown_last: [const { None }; 5],
            painting: None,
            painting_key: None,
            failed_key: None,
            painted_key: None,
            most_px: MOST_PX,
            uses: 0,
        }
    }
}

impl TextureCache {
    /// The texture of a request, or an older one of the same photograph while the requested one is being painted.
    pub fn get(&mut self, ctx: &Context, slot: Slot, request: &PaintRequest) -> Option<&mut LayerTexture> {
        self.take_painted();
        self.uses += 1;
        let key = request.key();
        if !self.textures.iter().any(|texture| texture.key == key) {
            if request.texels() <= LARGE_PX {
                let texture = LayerTexture::painted(request);
                self.add_texture(texture);
            } else if self.painting.is_none() && self.failed_key.as_ref() != Some(&key) {
                self.paint_in_background(ctx, request);
            }
            // The painter requests a repaint when it has ended; off screen that request has no effect, so look again.
            ctx.request_repaint_after(Duration::from_millis(30));
        }
        let shown_last = &mut self.shown_last[slot as usize];
        if self.textures.iter().any(|texture| texture.key == key) {
            self.painted_key.take_if(|painted| *painted == key);
            *shown_last = Some(key);
        }
        let wanted = shown_last.clone().filter(|shown_last| shown_last.is_of_photograph(request))?;
        self.drop_oldest();
        let texture = self.textures.iter_mut().find(|texture| texture.key == wanted)?;
        texture.last_use = self.uses;
        Some(texture)
    }

    /// Keeps the texture that the painter has finished.
    fn take_painted(&mut self) {
        let painted = Task::take(&mut self.painting);
        if self.painting.is_none() && self.painting_key.is_some() {
            let key = self.painting_key.take();
            self.failed_key = key.filter(|_| painted.is_none());
        }
        if let Some(mut texture) = painted {
            texture.last_use = self.uses;
            self.painted_key = Some(texture.key.clone());
            self.add_texture(texture);
        }
    }

    /// Keeps a new texture. One of an instant reuses the tiles of the instant before: they change many times a second.
    fn add_texture(&mut self, mut texture: LayerTexture) {
        if texture.key.is_of_instant() {
            for old in self.textures.extract_if(.., |old| old.key.is_of_instant()) {
                texture.spare.extend(old.spare);
                texture.spare.extend(old.tiles);
            }
        }
        self.textures.push(texture);
    }

    /// Whether a texture is being painted in the background.
    pub fn is_painting(&self) -> bool {
        self.painting.is_some()
    }

    /// Starts to paint a request on a thread.
    fn paint_in_background(&mut self, ctx: &Context, request: &PaintRequest) {
        let (request, key) = (request.clone(), request.key());
        let paint = move || {
            let mut texture = LayerTexture::painted(&request);
            texture.make_copies();
            texture
        };
        self.painting_key = Some(key);
        self.painting = Task::start(ctx, "painter", paint);
    }

    /// Drops textures of results that are gone, and then the oldest ones beyond the limits.
    fn drop_oldest(&mut self) {
        let (shown_last, painted) = (&self.shown_last, &self.painted_key);
        let in_use = |texture: &LayerTexture| {
            shown_last.iter().chain([painted]).flatten().any(|key| *key == texture.key)
        };
        self.textures.retain(|texture| in_use(texture) || !texture.key.is_outdated());
        loop {
            let pixels: usize = self.textures.iter().map(|texture| texture.levels[0].len()).sum();
            if self.textures.len() <= MOST_TEXTURES && pixels <= self.most_px {
                return;
            }
            let free = self.textures.iter().enumerate().filter(|(_, texture)| !in_use(texture));
            let Some((oldest, _)) = free.min_by_key(|(_, texture)| texture.last_use) else { return };
            self.textures.swap_remove(oldest);
        }
    }
}

/// A painted picture, smaller copies of it, and textures of the parts that were visible.
pub struct LayerTexture {
    key: TextureKey,
    /// Side of a texel of the painted picture, pixels of the photograph.
    texel_px: usize,
    levels: Vec<Raster<[u8; 4]>>,
    tiles: HashMap<[usize; 3], TextureHandle>,
    /// Textures of the same size with an older picture.
    spare: HashMap<[usize; 3], TextureHandle>,
    last_use: u64,
}

impl LayerTexture {
    fn painted(request: &PaintRequest) -> Self {
        Self {
            key: request.key(),
            texel_px: request.texel_px(),
            levels: vec![request.paint()],
            tiles: HashMap::new(),
            spare: HashMap::new(),
            last_use: 0,
        }
    }

    /// The color shown for a pixel; transparent where a texel has several pixels.
    pub fn color(&self, pixel: usize) -> [u8; 4] {
        if self.texel_px > 1 {
            return [0; 4];
        }
        self.levels[0].as_slice().get(pixel).copied().unwrap_or_default()
    }

    /// Makes the smaller copies, unless they are there.
    fn make_copies(&mut self) {
        if self.levels.len() == 1 {
            let copies = if self.key.is_of_marks() {
                copies_of_marks(&self.levels[0])
            } else {
                pyramid(&self.levels[0])
            };
            self.levels.extend(copies);
        }
    }

    /// Draws the visible part, multiplied by `tint`.
    pub fn draw(&mut self, painter: &Painter, place: &Placement, tint: Color32) {
        let mut scale = place.zoom * painter.ctx().pixels_per_point() * self.texel_px as f32;
        if self.key.is_of_marks() {
            // A thin line must not fall between screen pixels, nor become a thick one: about one texel each.
            scale *= 0.7;
        }
        if level_for(scale, usize::MAX) > 0 {
            self.make_copies();
        }
        let level = level_for(scale, self.levels.len());
        let texels = &self.levels[level];
        let pixels_per_texel = self.texel_px << level;
        let [columns, rows] = place.visible().map(|visible_range| {
            let tile = TILE * pixels_per_texel;
            visible_range.start / tile..visible_range.end.div_ceil(tile)
        });
        for row in rows {
            for column in columns.clone() {
                let Some(tile) = Tile::of(texels, column, row) else { continue };
                let place_of_tile = [level, column, row];
                let texture = self.tiles.entry(place_of_tile).or_insert_with(|| {
                    let image = tile.image(texels);
                    if let Some(mut spare) = self.spare.remove(&place_of_tile) {
                        spare.set(image, texture_options());
                        return spare;
                    }
                    painter.ctx().load_texture("picture", image, texture_options())
                });
                let pixels_per_texel = pixels_per_texel as f32;
                let part = Rect::from_min_max(
                    tile.inner.min * pixels_per_texel,
                    (tile.inner.max * pixels_per_texel).min(place.size.to_pos2()),
                );
                let uv = |texel: egui::Pos2| ((texel - tile.outer.min) / tile.outer.size()).to_pos2();
                let uv = Rect::from_min_max(uv(part.min / pixels_per_texel), uv(part.max / pixels_per_texel));
                let mut mesh = Mesh::with_texture(texture.id());
                mesh.add_rect_with_uv(place.screen_rect_of(part), uv, tint);
                painter.add(Shape::mesh(mesh));
            }
        }
    }
}
