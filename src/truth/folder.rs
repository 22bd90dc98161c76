//! Reading the files of a ground truth folder.

use super::TruthError;
use super::pictures::{decode_labels, decode_rgb_exr, expect_size, read_file};
use crate::raster::{LabelMap, Raster};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The ground truth of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundTruth {
    /// Object at each pixel, 0 = background.
    pub labels: LabelMap,
    /// Body reflection without noise or clipping, counts.
    pub body: Raster<[f32; 3]>,
    /// Surface reflection without noise or clipping, counts.
    pub surface: Raster<[f32; 3]>,
    /// Color of the light, of any length.
    pub illuminant: [f64; 3],
    /// The objects by ascending id.
    pub objects: Vec<TruthObject>,
}

/// One object of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct TruthObject {
    /// The object's value in the labels.
    pub id: u16,
    /// The object's body reflection vector, of any length; none for a metal.
    #[serde(default)]
    pub body_vector: Option<[f64; 3]>,
}

/// The bytes of a truth folder's files.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TruthFiles<'a> {
    /// `body.exr`
    pub(crate) body: &'a [u8],
    /// `surface.exr`
    pub(crate) surface: &'a [u8],
    /// `labels.png`
    pub(crate) labels: &'a [u8],
    /// `truth.json`
    pub(crate) json: &'a [u8],
}

#[derive(Deserialize)]
struct TruthJson {
    illumination_vector: [f64; 3],
    objects: Vec<TruthObject>,
}

const BODY: &str = "body.exr";
const SURFACE: &str = "surface.exr";
const LABELS: &str = "labels.png";
const JSON: &str = "truth.json";

impl GroundTruth {
    /// Reads a truth folder.
    ///
    /// # Errors
    /// When a file is missing, cannot be decoded, or differs in size from the labels.
    pub fn read(folder: &Path) -> Result<Self, TruthError> {
        let bytes = |name| read_file(&folder.join(name));
        let (json, labels, body, surface) = (bytes(JSON)?, bytes(LABELS)?, bytes(BODY)?, bytes(SURFACE)?);
        let files = TruthFiles { body: &body, surface: &surface, labels: &labels, json: &json };
        Self::decode(&files, folder)
    }

    /// Decodes the files of a truth folder; errors name each file as a path in `folder`.
    ///
    /// # Errors
    /// When a file cannot be decoded or differs in size from the labels.
    pub(crate) fn decode(files: &TruthFiles, folder: &Path) -> Result<Self, TruthError> {
        let TruthJson { illumination_vector, mut objects } = serde_json::from_slice(files.json)
            .map_err(|source| TruthError::Json { path: folder.join(JSON), source })?;
        objects.sort_by_key(|object| object.id);
        let labels = decode_labels(files.labels, &folder.join(LABELS))?;
        let picture = |bytes, name| {
            let picture = decode_rgb_exr(bytes, &folder.join(name))?;
            expect_size(&picture, &labels, &folder.join(name))?;
            Ok(picture)
        };
        Ok(Self {
            body: picture(files.body, BODY)?,
            surface: picture(files.surface, SURFACE)?,
            labels,
            illuminant: illumination_vector,
            objects,
        })
    }

    /// The file of the labels in a truth folder.
    pub fn labels_path(folder: &Path) -> PathBuf {
        folder.join(LABELS)
    }

    /// The body reflection vector of an object; none for an unknown object and for a metal.
    pub fn body_vector(&self, id: u16) -> Option<[f64; 3]> {
        let index = self.objects.binary_search_by_key(&id, |object| object.id).ok()?;
        self.objects[index].body_vector
    }
}

/// The truth folder for one result: `root` itself if it is a truth folder, else the first truth folder among `names` in `root`.
pub fn find_truth<'a>(root: &Path, names: impl IntoIterator<Item = &'a Path>) -> Option<PathBuf> {
    let is_truth = |folder: &Path| folder.join(JSON).is_file();
    if is_truth(root) {
        return Some(root.to_owned());
    }
    names.into_iter().map(|name| root.join(name)).find(|folder| is_truth(folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tiny() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny")
    }

    #[test]
    fn all_files_of_a_truth_folder_are_read() {
        let truth = GroundTruth::read(&tiny()).unwrap();
        assert_eq!((truth.labels.width(), truth.labels.height()), (truth.body.width(), truth.body.height()));
        let body = truth.body_vector(truth.objects[0].id).unwrap();
        assert!((body.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-3);
        assert_eq!(truth.body_vector(999), None);
        let brightest = truth.body.as_slice().iter().flatten().fold(0.0f32, |a, &b| a.max(b));
        assert!((50.0..600.0).contains(&brightest), "in counts, not in units of full scale: {brightest}");
    }

    #[test]
    fn a_missing_or_foreign_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let missing = GroundTruth::read(folder.path()).unwrap_err().to_string();
        assert!(missing.ends_with("truth.json"), "{missing}");
        for name in [JSON, LABELS, BODY, SURFACE] {
            std::fs::copy(tiny().join(name), folder.path().join(name)).unwrap();
        }
        std::fs::write(folder.path().join(BODY), b"no picture").unwrap();
        let message = GroundTruth::read(folder.path()).unwrap_err().to_string();
        assert!(message.starts_with("cannot decode") && message.ends_with("body.exr"), "{message}");
        std::fs::write(folder.path().join(JSON), b"{}").unwrap();
        let message = GroundTruth::read(folder.path()).unwrap_err().to_string();
        assert!(message.ends_with("truth.json does not describe a ground truth"), "{message}");
    }

    #[test]
    fn a_picture_of_another_size_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        for name in [JSON, BODY, SURFACE] {
            std::fs::copy(tiny().join(name), folder.path().join(name)).unwrap();
        }
        image::GrayImage::new(2, 3).save(folder.path().join(LABELS)).unwrap();
        let message = GroundTruth::read(folder.path()).unwrap_err().to_string();
        assert!(message.ends_with("the labels are 2\u{d7}3"), "{message}");
    }

    #[test]
    fn a_root_is_searched_in_the_order_of_the_names() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("b")).unwrap();
        std::fs::write(root.path().join("b/truth.json"), "{}").unwrap();
        let names = ["a", "b"].map(Path::new);
        assert_eq!(find_truth(root.path(), names), Some(root.path().join("b")));
        assert_eq!(find_truth(root.path(), names[..1].iter().copied()), None);
        assert_eq!(find_truth(&tiny(), names), Some(tiny()));
    }
}
