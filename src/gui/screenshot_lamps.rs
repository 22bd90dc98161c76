//! Three cups under three lamps by the paper's method, each as four quarters: photograph, segmentation, body and surface reflection
//! (color figures 12 to 14).

use super::App;
use crate::app::{Edit, JobCommand};
use crate::params::Preset;
use crate::raster::Raster;
use crate::truth::sample::THREE_LAMPS;
use crate::view::{Layer, Look, Origin, ResultSnapshot, paint};

/// The layers of the quarters, row by row.
const QUARTERS: [Layer; 4] = [Layer::Input, Layer::Regions, Layer::Body, Layer::Surface];
/// Pixels of the photograph along a side of a pixel of the picture.
const BLOCK: usize = 2;
/// Distance between the quarters, pixels.
const GAP: usize = 6;

/// A picture of the gallery.
pub struct LampPicture {
    /// The name of the file without extension.
    pub name: &'static str,
    /// Columns and rows.
    pub size: [u32; 2],
    /// sRGB and alpha, row-major.
    pub rgba: Vec<u8>,
}

/// The pictures of the three lamps, each with its column of table 6.
pub fn lamp_pictures(app: &mut App) -> Vec<LampPicture> {
    let presets = [Preset::CupsYellow, Preset::CupsWhite, Preset::CupsPink];
    let names = ["figure-12-yellow-light", "figure-13-white-light", "figure-14-pink-light"];
    let mut pictures = Vec::new();
    for ((&scene, preset), name) in THREE_LAMPS.scenes.iter().zip(presets).zip(names) {
        app.apply(JobCommand::Open(Origin::Sample(scene.to_owned())));
        app.apply(Edit::SetParams(Box::new(preset.params())));
        if let Some(shown) = app.state().shown() {
            let picture = quarters(shown);
            let size = [picture.width() as u32, picture.height() as u32];
            pictures.push(LampPicture { name, size, rgba: picture.as_slice().as_flattened().to_vec() });
        }
    }
    pictures
}

/// The four quarters of a result, reduced.
fn quarters(shown: &ResultSnapshot) -> Raster<[u8; 4]> {
    let layers = QUARTERS.map(|layer| paint(layer, &shown.picture, Some(shown), None, &Look::default()));
    let (columns, rows) = (layers[0].width() / BLOCK, layers[0].height() / BLOCK);
    let (width, height) = (2 * columns + GAP, 2 * rows + GAP);
    let mut picture = Raster::filled(width, height, [255u8; 4]);
    for (i, layer) in layers.iter().enumerate() {
        let [left, top] = [i % 2 * (columns + GAP), i / 2 * (rows + GAP)];
        for y in 0..rows {
            for x in 0..columns {
                picture.as_mut_slice()[(top + y) * width + left + x] = mean(layer, x * BLOCK, y * BLOCK);
            }
        }
    }
    picture
}

/// The mean of a block of pixels.
fn mean(picture: &Raster<[u8; 4]>, left: usize, top: usize) -> [u8; 4] {
    let mut sum = [0usize; 4];
    for y in top..top + BLOCK {
        for pixel in &picture.row(y)[left..left + BLOCK] {
            sum = std::array::from_fn(|band| sum[band] + usize::from(pixel[band]));
        }
    }
    sum.map(|sum| (sum / (BLOCK * BLOCK)) as u8)
}
