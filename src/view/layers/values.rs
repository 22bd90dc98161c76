//! The numbers of a layer as a picture of floats, for other programs.

use super::{Against, Layer, LayerPixels, Look, paint_against};
use crate::color::linear_from_srgb;
use crate::export::FloatPicture;
use crate::raster::Raster;
use crate::view::{Picture, ResultSnapshot};
use rayon::prelude::*;

/// The numbers of a layer: linear light of the photograph, of body and surface reflection, ε and confidence, 1.0 of the file for full
/// scale or for certainty; the labels of another program; of a layer of colors, the painted colors as linear light. `look` is how colors are painted.
pub(crate) fn layer_floats(
    layer: Layer,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    against: Against,
    look: &Look,
) -> FloatPicture {
    if layer == Layer::Input {
        return FloatPicture::Rgb(picture.photo.image.pixels.clone());
    }
    let intrinsic = shown.map(|shown| &shown.analysis.intrinsic);
    let of = |intrinsic| LayerPixels { intrinsic, elsewhere: against.elsewhere };
    let first =
        intrinsic.filter(|found| !found.noise.is_empty()).and_then(|found| layer.numbers(of(found), 0));
    if let (Some(intrinsic), Some(first)) = (intrinsic, first) {
        let (width, height) = (intrinsic.noise.width(), intrinsic.noise.height());
        let numbers = |pixel: usize| layer.numbers(of(intrinsic), pixel).unwrap_or_default();
        // A share or a label is written as it is, and not divided by full scale.
        let factor = if matches!(layer, Layer::Confidence | Layer::OtherRegions) { 255.0 } else { 1.0 };
        if first.len() == 3 {
            let color = |pixel| std::array::from_fn(|band| numbers(pixel).get(band).copied().unwrap_or(0.0));
            let colors = (0..width * height).into_par_iter().map(color).collect();
            if let Some(colors) = Raster::from_vec(width, height, colors) {
                return FloatPicture::Rgb(colors);
            }
        } else {
            let value = |pixel| factor * numbers(pixel).first().copied().unwrap_or(0.0);
            let values = (0..width * height).into_par_iter().map(value).collect();
            if let Some(values) = Raster::from_vec(width, height, values) {
                return FloatPicture::Single(values);
            }
        }
    }
    let painted = paint_against(layer, picture, shown, against, look);
    let linear = |code: u8| (255.0 * linear_from_srgb(f64::from(code) / 255.0)) as f32;
    FloatPicture::Rgb(painted.map(|&[r, g, b, _]| [r, g, b].map(linear)))
}
