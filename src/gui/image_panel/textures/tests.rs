//! Tests of the textures that are kept.

use super::{LayerTexture, Slot, TextureCache};
use crate::app::State;
use crate::gui::image_panel::paint_request::PaintRequest;
use crate::gui::task::Task;
use crate::raster::RegionId;
use crate::view::testing::tiny;
use crate::view::{Item, Layer};
use egui::Context;
use std::sync::Arc;

#[test]
fn a_texture_painted_on_a_thread_stays_until_its_slot_is_asked_even_beyond_the_limit() {
    let ctx = Context::default();
    let shown = tiny();
    let mut state = State::default();
    (state.picture, state.newest) = (Some(Arc::clone(&shown.picture)), Some(shown));
    let settings = state.view.image.clone();
    let layers =
        [Layer::Input, Layer::Body].map(|layer| PaintRequest::layer(&state, layer, &settings).unwrap());
    let mut marks_of = |index| {
        state.document.selection.item = Some(Item::Region(RegionId::from_index(index)));
        PaintRequest::marks(&state).unwrap()
    };
    let (before, after) = (marks_of(0), marks_of(1));
    let pixels = before.texels();
    // Room for both layers and the marks, as for a photograph of 12 megapixels, and not for the next marks beside them.
    let mut cache = TextureCache { most_px: 3 * pixels, ..TextureCache::default() };
    let slots = [Slot::Layer, Slot::SecondLayer];
    for (slot, request) in slots.into_iter().zip(&layers) {
        assert!(cache.get(&ctx, slot, request).is_some());
    }
    assert!(cache.get(&ctx, Slot::Marks, &before).is_some());
    let request = after.clone();
    cache.painting_key = Some(after.key());
    cache.painting = Task::start(&ctx, "painter", move || LayerTexture::painted(&request));
    while cache.is_painting() {
        cache.get(&ctx, Slot::Layer, &layers[0]);
    }
    cache.get(&ctx, Slot::SecondLayer, &layers[1]);
    let is_kept = |cache: &TextureCache, request: &PaintRequest| {
        cache.textures.iter().any(|texture| texture.key == request.key())
    };
    assert!(is_kept(&cache, &after), "the marks that nobody has asked for yet");
    assert!(cache.get(&ctx, Slot::Marks, &after).is_some_and(|texture| texture.key == after.key()));
    cache.get(&ctx, Slot::Layer, &layers[0]);
    assert!(is_kept(&cache, &after) && !is_kept(&cache, &before), "the limit holds again");
}
