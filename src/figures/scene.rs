//! What the figures are made from: a photograph, its analysis, and what is known of it from elsewhere.

use crate::analysis::Analysis;
use crate::color::linear_from_srgb;
use crate::describe::Report;
use crate::intrinsic::PixelKind;
use crate::params::{Method, Params, PhoenixParameter, PhoenixSettings};
use crate::photo::{Photo, ReadOptions};
use crate::raster::{LabelMap, Mask, UNASSIGNED};
use crate::truth::GroundTruth;
use crate::view::{
    Histogram, Layer, Look, Origin, Picture, ProfileLine, ResultSnapshot, profile_ends, region_colors,
};
use std::sync::Arc;

/// Code of the brightest usual color where the exposure of a picture is changed, share of white.
const BRIGHTEST_SHARE: f64 = 0.9;
/// Share of the pixels that may be brighter than white without a change of the exposure.
const BRIGHTER_SHARE: f64 = 0.01;
/// Most pixels from which the exposure is estimated, evenly chosen.
const EXPOSURE_SAMPLES: usize = 1_000_000;

/// A photograph and its analysis, to be given to [`Scene::of_photograph`].
pub struct AnalyzedPhotograph {
    /// The photograph.
    pub photo: Photo,
    /// SHA-256 of the photograph's file, hexadecimal.
    pub sha256: String,
    /// The parameters of the analysis.
    pub params: Params,
    /// The analysis.
    pub analysis: Analysis,
    /// The area that the analysis was restricted to; none: the whole picture.
    pub area: Option<Arc<Mask>>,
    /// The ground truth of the photograph's size, where there is one.
    pub truth: Option<GroundTruth>,
}

/// An independent measurement of the light's color.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Unit vector.
    pub direction: [f64; 3],
    /// How the light was measured, words that follow "from".
    pub source: String,
}

/// A segmentation of the photograph by another method; without another one it is that of Phoenix.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherSegmentation {
    /// The method's name.
    pub name: String,
    /// How the method was run, a sentence.
    pub about: String,
    /// Region of each pixel of the photograph, 0 for none.
    pub labels: LabelMap,
}

/// A photograph, its analysis, and what is known of it from elsewhere.
pub struct Scene {
    pub(super) shown: Arc<ResultSnapshot>,
    pub(super) report: Report,
    /// The name of the photograph in captions.
    name: String,
    /// Exposure of the pictures of light.
    pub(super) look: Look,
    /// The ends of the profile's line, pixels.
    pub(super) line: [[f32; 2]; 2],
    pub(super) measured: Option<Measured>,
    pub(super) other: Option<OtherSegmentation>,
    pub(super) counts: Counts,
}

/// Why a scene cannot be shown as asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The row is outside of the photograph.
    #[error("there is no row {row}: the photograph has {rows} rows, counted from 0")]
    Row {
        /// The row.
        row: usize,
        /// Rows of the photograph.
        rows: usize,
    },
    /// The patch reaches beyond the photograph.
    #[error("the white patch of {} \u{d7} {} pixels at ({}, {}) reaches beyond the photograph, which has {} columns and {} rows",
        size[0], size[1], corner[0], corner[1], photograph.0, photograph.1)]
    PatchOutside {
        /// Column and row of the patch's first pixel.
        corner: [usize; 2],
        /// Columns and rows of the patch.
        size: [usize; 2],
        /// Columns and rows of the photograph.
        photograph: (usize, usize),
    },
    /// The patch has no usable pixel.
    #[error("the white patch at ({0}, {1}) holds no pixel that is neither dark nor clipped")]
    Patch(usize, usize),
    /// The other segmentation has another size than the photograph.
    #[error("the other segmentation has {} \u{d7} {} pixels, the photograph {} \u{d7} {}", found.0, found.1, photograph.0, photograph.1)]
    OtherSize {
        /// Columns and rows of the segmentation.
        found: (usize, usize),
        /// Columns and rows of the photograph.
        photograph: (usize, usize),
    },
}

impl Scene {
    /// The scene of an analysis; `report` is the analysis's report.
    pub fn of_photograph(input: AnalyzedPhotograph, report: Report) -> Self {
        let AnalyzedPhotograph { photo, sha256, params, analysis, area, truth } = input;
        let name = report.image.file.clone();
        let histogram = Histogram::of(&photo.image);
        let picture = Arc::new(Picture {
            origin: Origin::Bytes { name, bytes: Arc::from([]) },
            reading: ReadOptions::default(),
            photo,
            sha256,
            read_ms: 0.0,
            histogram,
            truth,
        });
        let region_colors = region_colors(&analysis, None);
        let shown = ResultSnapshot::new(picture, params, analysis, region_colors);
        let shown = ResultSnapshot { area, ..shown };
        Self::of_snapshot(Arc::new(shown), report)
    }

    /// The scene of a result that the window shows, whose pixels are those of the photograph; `report` is the result's report.
    pub fn of_snapshot(shown: Arc<ResultSnapshot>, report: Report) -> Self {
        let measured = shown.picture.truth.as_ref().and_then(|truth| {
            let direction = unit(truth.illuminant)?;
            Some(Measured { direction, source: "the ground truth".to_owned() })
        });
        let counts = Counts::of(&shown.analysis);
        let row = profile_row(&shown.analysis);
        let look = Look { exposure_ev: exposure_ev(&shown.picture), ..Look::default() };
        let line = row_ends(&shown.picture, row);
        let other = phoenix(&shown);
        Self { shown, name: report.image.file.clone(), report, look, line, measured, other, counts }
    }

    /// The same with another name than that of the file, as where several files have one name.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// The same with the profile along a row of the photograph, counted from 0.
    ///
    /// # Errors
    /// [`SceneError::Row`] for a row outside of the photograph.
    pub fn with_row(mut self, row: usize) -> Result<Self, SceneError> {
        let rows = self.shown.picture.size().1;
        if row >= rows {
            return Err(SceneError::Row { row, rows });
        }
        self.line = row_ends(&self.shown.picture, row);
        Ok(self)
    }

    /// The same with the profile along a line, whose ends are points of the photograph, pixels.
    #[must_use]
    pub fn with_line(mut self, line: [[f32; 2]; 2]) -> Self {
        self.line = line;
        self
    }

    /// The same with the light measured on a patch that is white or gray: the mean color of the patch's pixels that are neither dark
    /// nor clipped. `corner` is the column and row of the patch's first pixel, `size` its columns and rows.
    ///
    /// # Errors
    /// [`SceneError::PatchOutside`] for a patch that is not wholly in the photograph, [`SceneError::Patch`] for one without such a pixel.
    pub fn with_white_patch(mut self, corner: [usize; 2], size: [usize; 2]) -> Result<Self, SceneError> {
        let (width, height) = self.shown.picture.size();
        let [x, y] = corner;
        let (right, bottom) = (x.saturating_add(size[0]), y.saturating_add(size[1]));
        if right > width || bottom > height {
            return Err(SceneError::PatchOutside { corner, size, photograph: (width, height) });
        }
        let mut sum = [0f64; 3];
        for row in y..bottom {
            for column in x..right {
                let pixel = row * width + column;
                if self.shown.analysis.masks.usable(pixel) {
                    let color = self.shown.picture.photo.image.pixels[pixel];
                    sum = std::array::from_fn(|band| sum[band] + f64::from(color[band]));
                }
            }
        }
        let direction = unit(sum).ok_or(SceneError::Patch(x, y))?;
        let source = format!("a white patch of {} \u{d7} {} pixels at ({x}, {y})", size[0], size[1]);
        self.measured = Some(Measured { direction, source });
        Ok(self)
    }

    /// The same with a segmentation by another method, which is shown beside the own one.
    ///
    /// # Errors
    /// [`SceneError::OtherSize`] for a segmentation of another size than the photograph.
    pub fn with_other(mut self, other: OtherSegmentation) -> Result<Self, SceneError> {
        let found = (other.labels.width(), other.labels.height());
        let photograph = self.shown.picture.size();
        if found != photograph {
            return Err(SceneError::OtherSize { found, photograph });
        }
        self.other = Some(other);
        Ok(self)
    }

    /// The name of the photograph.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Why a stage of the dichromatic model is not shown, where the regions were found by a system that the paper is held against.
    pub(super) fn lacks_stage(&self) -> Option<String> {
        let what = match self.shown.params.method {
            Method::Refined | Method::Paper | Method::ByHand => return None,
            Method::Phoenix => "Phoenix finds regions by the histograms of color features",
            Method::TopDown => "the top-down method finds regions by the histogram of the whole picture",
        };
        Some(format!("Not shown: {what}, without this stage."))
    }

    /// A layer of the result, at the size of the photograph.
    pub(super) fn painted(&self, layer: Layer) -> crate::raster::Raster<[u8; 4]> {
        // The exposure is the gain of the noise image too, whose scale is the slice.
        let look = if layer == Layer::Noise { Look::default() } else { self.look };
        crate::view::paint(layer, &self.shown.picture, Some(&self.shown), None, &look)
    }

    /// The change of exposure as a sentence for captions; empty where there is none.
    pub(super) fn exposure_sentence(&self) -> String {
        let ev = self.look.exposure_ev;
        if ev.abs() < 0.05 {
            return String::new();
        }
        let (stops, what) = (ev.abs(), if ev < 0.0 { "darker" } else { "brighter" });
        format!("The picture is shown {stops:.1} stops {what} than the file. ")
    }
}

/// The segmentation by Phoenix, with the settings of the result; none where the result is that of Phoenix.
fn phoenix(shown: &ResultSnapshot) -> Option<OtherSegmentation> {
    if shown.params.method == Method::Phoenix {
        return None;
    }
    let settings = &shown.params.phoenix;
    let changed = PhoenixParameter::ALL.into_iter().filter_map(|parameter| {
        let value = parameter.get(settings);
        let is_changed = value != parameter.get(&PhoenixSettings::default());
        is_changed.then(|| format!(", {} {value}", parameter.name()))
    });
    let about = format!(
        "Phoenix (section 7.2) splits regions at valleys in the histograms of color features, here {}{}.",
        settings.features.to_string().replace(',', ", "),
        changed.collect::<String>()
    );
    Some(OtherSegmentation { name: "Phoenix".to_owned(), about, labels: shown.phoenix_labels().clone() })
}

/// Numbers of pixels, of the photograph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Pixels of the photograph, or of the area that the analysis was restricted to.
    pub pixels: usize,
    pub dark: usize,
    pub clipped: usize,
    pub bloomed: usize,
    /// Pixels that are not dark.
    pub lit: usize,
    /// Lit pixels in regions after the linear, the planar and the clipping stage.
    pub lit_in_regions: [usize; 3],
    pub in_regions: usize,
    /// Pixels nearer to a highlight line, clipped ones included.
    pub highlight: usize,
    /// Clipped and bloomed pixels whose color was restored, and those that are clipped in every band.
    pub restored: usize,
    pub lost: usize,
}

impl Counts {
    fn of(analysis: &Analysis) -> Self {
        let mut counts = Self::default();
        let masks = &analysis.masks;
        let maps = [&analysis.matte.labels, &analysis.planar.labels, &analysis.finals.labels];
        for pixel in (0..analysis.finals.labels.len()).filter(|&pixel| !masks.outside(pixel)) {
            let (dark, clipped) = (masks.dark(pixel), masks.clipped(pixel));
            counts.pixels += 1;
            counts.dark += usize::from(dark);
            counts.clipped += usize::from(clipped);
            counts.bloomed += usize::from(masks.distorted(pixel) && !clipped && masks.has_value(pixel));
            counts.lit += usize::from(!dark);
            for (count, map) in counts.lit_in_regions.iter_mut().zip(maps) {
                *count += usize::from(!dark && map[pixel] != UNASSIGNED);
            }
            counts.in_regions += usize::from(maps[2][pixel] != UNASSIGNED);
            match analysis.intrinsic.kinds[pixel] {
                PixelKind::Highlight => counts.highlight += 1,
                PixelKind::Restored => counts.restored += 1,
                PixelKind::Lost => counts.lost += 1,
                PixelKind::Matte | PixelKind::Unassigned => {}
            }
        }
        counts
    }
}

/// The row with most highlight pixels, of equals the first; the middle row of a photograph without highlights.
fn profile_row(analysis: &Analysis) -> usize {
    let kinds = &analysis.intrinsic.kinds;
    let highlights = |row: usize| {
        let is_highlight =
            |kind: &&PixelKind| matches!(kind, PixelKind::Highlight | PixelKind::Restored | PixelKind::Lost);
        kinds.row(row).iter().filter(is_highlight).count()
    };
    let best = (0..kinds.height()).rev().max_by_key(|&row| highlights(row));
    best.filter(|&row| highlights(row) > 0).unwrap_or(kinds.height() / 2)
}

fn row_ends(picture: &Picture, row: usize) -> [[f32; 2]; 2] {
    let pixel = crate::raster::PixelIndex::from_index(row * picture.size().0);
    profile_ends(ProfileLine::Row, picture, Some(pixel))
}

/// Exposure, stops, at which a photograph is neither too bright nor, where its file does not say what white is, too dark.
fn exposure_ev(picture: &Picture) -> f32 {
    let image = &picture.photo.image;
    let step = image.pixels.len().div_ceil(EXPOSURE_SAMPLES).max(1);
    let largest = |color: &[f32; 3]| color[0].max(color[1]).max(color[2]);
    let mut values: Vec<f32> = image.pixels.as_slice().iter().step_by(step).map(largest).collect();
    if values.is_empty() {
        return 0.0;
    }
    let rank = ((values.len() - 1) as f64 * (1.0 - BRIGHTER_SHARE)) as usize;
    let bright = f64::from(*values.select_nth_unstable_by(rank, f32::total_cmp).1);
    if bright <= 0.0 || (image.saturation.is_some() && bright <= 255.0) {
        return 0.0;
    }
    let wanted = 255.0 * linear_from_srgb(BRIGHTEST_SHARE);
    let ev = (wanted / bright).log2().clamp(-16.0, 16.0);
    // A quarter of a stop cannot be seen.
    if ev.abs() < 0.25 { 0.0 } else { ev as f32 }
}

/// The unit vector along three numbers that are not negative; none for black and for numbers that are not finite.
pub(super) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
    (length > 1e-12 && length.is_finite()).then(|| vector.map(|v| v / length))
}
