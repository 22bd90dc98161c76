//! The sample scenes that the program's binary contains: rendered objects with their ground truth.

use super::{GroundTruth, TruthError, TruthFiles};
use std::path::Path;

/// Name of the photograph in the folder of a rendered scene, and of the photograph of each sample scene.
pub const CAMERA_FILE: &str = "camera8.png";

/// A sample scene in the program's binary.
pub struct Sample {
    /// The scene's name.
    pub name: &'static str,
    /// What the scene shows, in a sentence.
    pub about: &'static str,
    /// The scene's photograph, an 8-bit PNG in linear light.
    pub camera: &'static [u8],
    files: TruthFiles<'static>,
}

macro_rules! sample {
    ($name:literal, $about:literal) => {
        Sample {
            name: $name,
            about: $about,
            camera: include_bytes!(concat!("../../assets/", $name, "/camera8.png")),
            files: TruthFiles {
                body: include_bytes!(concat!("../../assets/", $name, "/body.exr")),
                surface: include_bytes!(concat!("../../assets/", $name, "/surface.exr")),
                labels: include_bytes!(concat!("../../assets/", $name, "/labels.png")),
                json: include_bytes!(concat!("../../assets/", $name, "/truth.json")),
            },
        }
    };
}

/// The name of the first sample.
pub const NAME: &str = "plastic8_white";

/// All samples. The program starts with the first one where no photograph is named.
pub static SAMPLES: [Sample; 4] = [
    sample!("plastic8_white", "Eight plastic objects under white light."),
    sample!("cups3_yellow", "Three cups under yellow light."),
    sample!("cups3_white", "Three cups under white light."),
    sample!("cups3_pink", "Three cups under pink light."),
];

/// Sample scenes that are opened together.
pub struct SampleSet {
    /// The name on buttons.
    pub name: &'static str,
    /// What the scenes show together, in a sentence.
    pub about: &'static str,
    /// The names of the scenes; the first is shown first.
    pub scenes: &'static [&'static str],
}

/// The three cups of the paper under its three lamps (color figures 12 to 14).
pub const THREE_LAMPS: SampleSet = SampleSet {
    name: "Three lamps",
    about: "The same three cups under yellow, white and pink light, open together.",
    scenes: &["cups3_yellow", "cups3_white", "cups3_pink"],
};

impl Sample {
    /// The scene called `name`.
    pub fn find(name: &str) -> Option<&'static Self> {
        SAMPLES.iter().find(|sample| sample.name == name)
    }

    /// The scene's ground truth.
    ///
    /// # Errors
    /// When a file cannot be decoded or differs in size from the labels.
    pub fn truth(&self) -> Result<GroundTruth, TruthError> {
        GroundTruth::decode(&self.files, Path::new(self.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_has_a_photograph_and_a_truth_of_one_size() {
        assert_eq!(SAMPLES[0].name, NAME);
        for sample in &SAMPLES {
            assert!(std::ptr::eq(Sample::find(sample.name).unwrap(), sample));
            let photo =
                crate::photo::decode(sample.camera, CAMERA_FILE, &crate::photo::ReadOptions::default());
            let (image, truth) = (photo.unwrap().image, sample.truth().unwrap());
            assert_eq!((truth.body.width(), truth.body.height()), (image.width(), image.height()));
        }
        assert!(Sample::find("nothing").is_none());
        assert!(THREE_LAMPS.scenes.iter().all(|name| Sample::find(name).is_some()));
    }
}
