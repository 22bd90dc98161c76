//! One run: masks → classify → merge → linear → planar → clipping → split.
//!
//! A [`Session`] keeps the output of each stage together with the key that the output was made from, so that a changed
//! parameter reruns only the stages that the parameter makes stale. The command line and the window both use it. An
//! [`Observer`] receives the progress, can measure times and may cancel; [`Session::run_traced`] also keeps the record of every
//! decision.

mod contrast;
mod full_resolution;
mod output;
mod photograph;
mod prepared;
mod resolve;
mod second_look;
mod slot;
mod stages;
mod stale;
mod subject;
mod votes_slot;
mod warnings;
mod what_if;
mod windows;
mod working_outputs;

pub use crate::params::Stage;
pub use crate::segment::Illuminant;
pub use contrast::ContrastFinding;
pub use output::StageOutput;
pub use resolve::NoiseFindings;
pub use second_look::SecondLookFindings;
pub use warnings::RunWarning;
pub use what_if::{Direction, Fate, Home, WhatIf, WhatIfObserver, what_if};

use crate::intrinsic::Intrinsic;
use crate::params::{Params, UsedParams};
use crate::photo::{LinearImage, Masks, WorkingPicture};
use crate::raster::{Blocks, Mask, PixelIndex, Raster};
use crate::segment::{FinalRegions, MatteRegions, PixelPlace, PlaceRule, PlanarRegions, Windows};
use crate::trace::{HistoryEntry, NoopRecorder, Trace, TraceRecorder, pixel_history};
use stages::Stages;
use std::sync::Arc;
use subject::Subject;

/// Receives the progress of a run, and may stop the run.
pub trait Observer: Sync {
    /// A stage begins.
    fn started(&mut self, _stage: Stage) {}
    /// A stage has ended; `reused`: its earlier output was still valid.
    fn finished(&mut self, _stage: Stage, _reused: bool) {}
    /// Receives the output of a stage right after the stage ended, before later stages begin; reused outputs too.
    fn made(&mut self, _output: StageOutput) {}
    /// Receives the analysis of the working picture, where its pixels are larger than those of the photograph, before the pass at full
    /// resolution. Everything in it is in working pixels, which are the `blocks` of the photograph, and it has no warnings. Where there is such a pass, the stages' outputs from
    /// the windows on come after this function.
    fn working_made(&mut self, _analysis: &Analysis, _blocks: &Blocks) {}
    /// Whether to stop the run. The function is called before each stage, once per hypothesis, and within long loops about
    /// every millisecond, from any thread. The run stops soon after the function returns true.
    fn cancelled(&self) -> bool {
        false
    }
}

/// An observer that observes nothing and never cancels.
impl Observer for () {}

/// The whole result of a run. Outputs of stages are shared with the session, not copied.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// The parameters that the run used, with values for those that were `auto`.
    pub used: UsedParams,
    /// The masks: dark, clipped, bloomed and invalid pixels, and pixels outside the area.
    pub masks: Arc<Masks>,
    /// The picture in which regions and light were found: the photograph, or its means over blocks. Everything else here is in
    /// pixels of the photograph; what was found in a larger block is repeated in all of its pixels.
    pub working: Arc<WorkingPicture>,
    /// The windows with their classes, and with the moments of their working pixels.
    pub windows: Arc<Windows>,
    /// Merged area of each pixel, from 1; 0 where its window has no class.
    pub areas: Arc<Raster<u32>>,
    /// Regions after the linear stage, numbered in the order of their linear hypotheses, and the hypotheses.
    pub matte: Arc<MatteRegions>,
    /// Regions after the planar stage, with the same numbers, and their planar hypotheses (skewed Ts).
    pub planar: Arc<PlanarRegions>,
    /// The final regions, numbered by decreasing size, and their planar hypotheses (skewed Ts). The regions of the second look come after
    /// the others.
    pub finals: Arc<FinalRegions>,
    /// The final regions as labels of the working picture, before each pixel of the photograph took a region.
    pub working_finals: Arc<FinalRegions>,
    /// The second look at what the working picture leaves unexplained; `None` where nothing was found, or nothing sought.
    pub second_look: Option<SecondLookFindings>,
    /// The color of the light; `None` without evidence of the light.
    pub illuminant: Option<Illuminant>,
    /// The intrinsic images and the regions' reflection vectors.
    pub intrinsic: Arc<Intrinsic>,
    /// The errors of the image's values: measured noise, and the error of the file's way of storing values.
    pub noise: Arc<NoiseFindings>,
    /// Warnings about the whole run.
    pub warnings: Vec<RunWarning>,
}

impl Analysis {
    /// Everything that was decided about the working pixel that contains a pixel of the photograph, oldest first. `trace` is the record
    /// of this run.
    pub fn pixel_history(&self, trace: &Trace, pixel: PixelIndex) -> Vec<HistoryEntry> {
        if pixel.index() >= self.finals.labels.len() {
            return Vec::new();
        }
        pixel_history(trace, &self.working.image, &self.working.masks, self.working_pixel(pixel))
    }

    /// The pixel of the working picture that contains a pixel of the photograph.
    pub fn working_pixel(&self, pixel: PixelIndex) -> PixelIndex {
        PixelIndex::from_index(self.working.blocks.block_of(pixel.index()))
    }

    /// By what a pixel of the photograph took its region; none where the working picture is the photograph, and outside of the
    /// photograph.
    pub fn pixel_place(&self, pixel: PixelIndex) -> Option<PixelPlace> {
        let (labels, blocks) = (&self.finals.labels, &self.working.blocks);
        let has_place = blocks.side() > 1 && pixel.index() < labels.len();
        let working = &*self.working_finals;
        has_place.then(|| {
            let place = PixelPlace::of(pixel.index(), &self.masks, labels, &working.labels, blocks);
            let is_of_second_look =
                place.region.is_some_and(|region| region.index() >= working.hypotheses.len());
            let second_look = self.second_look.filter(|_| is_of_second_look);
            let rule = second_look.map_or(place.rule, |found| PlaceRule::SecondLook { side: found.side });
            PixelPlace { rule, ..place }
        })
    }
}

/// The error of [`Session::restrict`]: the area has another shape than the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the area has {} \u{d7} {} pixels, the photograph {} \u{d7} {}", area.0, area.1, image.0, image.1)]
pub struct OtherShape {
    /// Width and height of the area, pixels.
    pub area: (usize, usize),
    /// Width and height of the image, pixels.
    pub image: (usize, usize),
}

/// The error of a run that the observer has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the analysis was cancelled")]
pub struct Cancelled;

/// One image, and the outputs of earlier runs on this image.
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

    /// Restricts later runs to the pixels for which `area` is true; `None` lifts the restriction. Pixels outside are left out
    /// like pixels without a value: they belong to no window and to no region.
    ///
    /// # Errors
    /// [`OtherShape`] for an area of another shape than the image; then nothing changes.
    pub fn restrict(&mut self, area: Option<Arc<Mask>>) -> Result<(), OtherShape> {
        let image = (self.image.width(), self.image.height());
        let shape = area.as_ref().map_or(image, |area| (area.width(), area.height()));
        if shape != image {
            return Err(OtherShape { area: shape, image });
        }
        self.area = area;
        Ok(())
    }

    /// Runs the stages that `params` makes stale, and returns the whole result.
    ///
    /// # Errors
    /// [`Cancelled`] when the observer cancels; the outputs of finished stages are kept.
    pub fn run(&mut self, params: &Params, observer: &mut impl Observer) -> Result<Analysis, Cancelled> {
        self.stages.run::<NoopRecorder>(&self.subject(), params, observer)
    }

    /// Like [`Session::run`], with the record of every decision. A stage with a record from an earlier run does not run again.
    /// A stage with an output but without a record runs again, and gives the same output.
    ///
    /// # Errors
    /// [`Cancelled`] when the observer cancels; the outputs of finished stages are kept.
    pub fn run_traced(
        &mut self,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<(Analysis, Trace), Cancelled> {
        let analysis = self.stages.run::<TraceRecorder>(&self.subject(), params, observer)?;
        let trace = self.stages.trace().ok_or(Cancelled)?;
        Ok((analysis, trace))
    }

    fn subject(&self) -> Subject {
        Subject { image: Arc::clone(&self.image), area: self.area.clone() }
    }
}
