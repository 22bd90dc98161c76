//! The scene that the program carries: rendered plastic objects under white light, with their ground truth.

use super::{GroundTruth, TruthError, TruthFiles};
use std::path::Path;

/// Its name.
pub const NAME: &str = "plastic8_white";

/// Its photograph, an 8-bit PNG in linear light.
pub const CAMERA: &[u8] = include_bytes!("../../assets/plastic8_white/camera8.png");

const FILES: TruthFiles = TruthFiles {
    body: include_bytes!("../../assets/plastic8_white/body.exr"),
    surface: include_bytes!("../../assets/plastic8_white/surface.exr"),
    labels: include_bytes!("../../assets/plastic8_white/labels.png"),
    json: include_bytes!("../../assets/plastic8_white/truth.json"),
};

/// Its ground truth.
///
/// # Errors
/// As [`GroundTruth::decode`].
pub fn truth() -> Result<GroundTruth, TruthError> {
    GroundTruth::decode(&FILES, Path::new(NAME))
}
