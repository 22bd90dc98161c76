//! The white patch: the color of a lamp is the mean color of a patch that the lamp lights (section 6).

use crate::app::{Command, Edit, Severity, State, ViewCommand};
use crate::gui::PanelContext;
use crate::raster::Mask;
use crate::view::marking::rectangle;
use egui::{Pos2, Vec2};

/// Side of the patch around a clicked pixel, pixels.
const CLICKED_SIDE_PX: f32 = 5.0;

/// The patch around the pixel at `place_px` in a picture of `size` pixels.
pub fn around(size: (usize, usize), place_px: Pos2) -> Mask {
    let reach_px = Vec2::splat(CLICKED_SIDE_PX / 2.0);
    rectangle(size, (place_px - reach_px).into(), (place_px + reach_px).into())
}

/// Pins the color of the light, or of the second lamp (`is_second`), to the mean of the reliable pixels.
pub fn pin_lamp(cx: &mut PanelContext, mask: &Mask, is_second: bool) {
    let command: Command = match mean_direction(cx.state, mask) {
        Some(direction) if is_second => Edit::PinSecondIlluminant(Some(direction), None).into(),
        Some(direction) => Edit::PinIlluminant(Some(direction), None).into(),
        None => ViewCommand::Notify(
            Severity::Warning,
            "white patch: all its pixels are clipped, black or hold no value; outline a darker part"
                .to_owned(),
        )
        .into(),
    };
    cx.send(command);
}

/// The mean of the undistorted pixels of a mask, as a unit vector; none without such a pixel.
fn mean_direction(state: &State, mask: &Mask) -> Option<[f64; 3]> {
    let image = &state.picture.as_ref()?.photo.image;
    let masks = state.newest.as_ref().map(|shown| &shown.analysis.masks);
    let saturation = image.saturation.unwrap_or(f32::INFINITY);
    let usable = |pixel: usize, color: &[f32; 3]| match masks {
        Some(masks) => !masks.distorted(pixel) && !masks.invalid(pixel),
        None => !image.invalid[pixel] && color.iter().all(|&band| band < saturation),
    };
    let mut sum = [0.0f64; 3];
    for (pixel, color) in image.pixels.as_slice().iter().enumerate() {
        if mask[pixel] && usable(pixel, color) {
            for (sum, &band) in sum.iter_mut().zip(color) {
                *sum += f64::from(band);
            }
        }
    }
    let length = sum.iter().map(|band| band * band).sum::<f64>().sqrt();
    (length > 0.0).then(|| sum.map(|band| band / length))
}
