//! One run: masks → classify → merge → linear → planar → clipping → split.
//!
//! A [`Session`] keeps the output of each stage beside what it was made from, so that a changed parameter reruns only what
//! it makes stale. The command line and the window both stand on it. An [`Observer`] hears of progress, keeps the clock and
//! may cancel; [`Session::run_traced`] keeps the record of every decision beside each output.

mod output;
mod resolve;
mod stages;
mod stale;
mod what_if;

pub use crate::params::Stage;
pub use crate::segment::Illuminant;
pub use output::StageOutput;
pub use what_if::{Direction, Fate, Home, WhatIf, WhatIfObserver, what_if};

use crate::intrinsic::Intrinsic;
use crate::params::{Params, UsedParams};
use crate::photo::{LinearImage, Masks};
use crate::raster::{Mask, Raster};
use crate::segment::{FinalRegions, MatteRegions, PlanarRegions, Windows};
use crate::trace::{NoopRecorder, Trace, TraceRecorder};
use stages::{Stages, Subject};
use std::sync::Arc;

/// Watches a run, and may stop it.
pub trait Observer: Sync {
    /// A stage begins.
    fn started(&mut self, _stage: Stage) {}
    /// A stage has ended; `reused` when its earlier output still stood.
    fn finished(&mut self, _stage: Stage, _reused: bool) {}
    /// What a stage has found, right after it ended and while later ones are still to come; reused outputs too.
    fn made(&mut self, _output: StageOutput) {}
    /// Asked before each stage, once a hypothesis, and within long loops about every millisecond, from any thread; a run
    /// stops soon after it turns true.
    fn cancelled(&self) -> bool {
        false
    }
}

/// An observer that ignores everything.
impl Observer for () {}

/// The whole result of a run. Outputs of stages are shared with the session, not copied.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// The numbers that the run used.
    pub used: UsedParams,
    /// Which pixels were believed.
    pub masks: Arc<Masks>,
    /// The windows with their moments and classes.
    pub windows: Arc<Windows>,
    /// Merged area of each pixel, from 1; 0 where its window has no class.
    pub areas: Arc<Raster<u32>>,
    /// Regions after the linear stage, numbered in the order of their hypotheses, and these with their lines.
    pub matte: Arc<MatteRegions>,
    /// Regions after the planar stage, numbered likewise, and their skewed Ts.
    pub planar: Arc<PlanarRegions>,
    /// The final regions, numbered by decreasing size, and their skewed Ts.
    pub finals: Arc<FinalRegions>,
    /// The color of the light, where there was evidence of it.
    pub illuminant: Option<Illuminant>,
    /// The intrinsic images and the regions' reflection vectors.
    pub intrinsic: Arc<Intrinsic>,
    /// Warnings, a sentence each.
    pub warnings: Vec<String>,
}

/// An area of another shape than the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the area has {} \u{d7} {} pixels, the photograph {} \u{d7} {}", area.0, area.1, image.0, image.1)]
pub struct OtherShape {
    /// Width and height of the area, pixels.
    pub area: (usize, usize),
    /// Width and height of the image, pixels.
    pub image: (usize, usize),
}

/// The run was stopped by its observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the analysis was cancelled")]
pub struct Cancelled;

/// One image and the outputs of earlier runs over it.
pub struct Session {
    image: Arc<LinearImage>,
    area: Option<Arc<Mask>>,
    stages: Stages,
}

impl Session {
    /// A session in which nothing has run yet.
    pub fn new(image: Arc<LinearImage>) -> Self {
        Self { image, area: None, stages: Stages::default() }
    }

    /// Restricts the runs to come to the pixels that `area` holds, or lifts the restriction. What lies outside is left out
    /// like pixels without a value: it is in no window and in no region.
    ///
    /// # Errors
    /// An area of another shape than the image; then nothing changes.
    pub fn restrict(&mut self, area: Option<Arc<Mask>>) -> Result<(), OtherShape> {
        let image = (self.image.width(), self.image.height());
        let shape = area.as_ref().map_or(image, |area| (area.width(), area.height()));
        if shape != image {
            return Err(OtherShape { area: shape, image });
        }
        self.area = area;
        Ok(())
    }

    /// Runs the stages that `params` makes stale, and hands out the whole result.
    ///
    /// # Errors
    /// [`Cancelled`] when the observer asks for it; what had finished by then is kept.
    pub fn run(&mut self, params: &Params, observer: &mut impl Observer) -> Result<Analysis, Cancelled> {
        self.stages.run::<NoopRecorder>(&self.subject(), params, observer)
    }

    /// As [`Session::run`], with the record of every decision. Stages that have a record from an earlier run are not run
    /// again. Stages that have an output without a record are run again, and give the same output.
    ///
    /// # Errors
    /// [`Cancelled`] when the observer asks for it; what had finished by then is kept.
    pub fn run_traced(
        &mut self,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<(Analysis, Trace), Cancelled> {
        let analysis = self.stages.run::<TraceRecorder>(&self.subject(), params, observer)?;
        let trace = self.stages.trace(self.image.width(), self.image.height()).ok_or(Cancelled)?;
        Ok((analysis, trace))
    }

    fn subject(&self) -> Subject {
        Subject { image: Arc::clone(&self.image), area: self.area.clone() }
    }
}
