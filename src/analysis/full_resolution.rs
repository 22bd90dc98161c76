//! The outputs of the stages in pixels of the photograph, where the working picture has larger pixels.

use super::photograph::Photograph;
use super::second_look::{SecondLook, second_look};
use super::working_outputs::WorkingOutputs;
use super::{Analysis, Cancelled, Observer, StageOutput};
use crate::baseline::marked_labels;
use crate::intrinsic::{Detail, Intrinsic, split_photograph};
use crate::params::Baseline;
use crate::raster::{LabelMap, Raster};
use crate::segment::{FinalRegions, MatteRegions, PlanarRegions, Windows, full_resolution_labels};
use crate::trace::{Recorder, SecondLookRecord};
use std::sync::Arc;

/// The last outputs in pixels of the photograph.
#[derive(Default)]
pub(super) struct FullResolution {
    windows: Enlarged<Windows>,
    areas: Enlarged<Raster<u32>>,
    matte: Enlarged<MatteRegions>,
    planar: Enlarged<PlanarRegions>,
    labels: Enlarged<LabelMap>,
    finals: Enlarged<FinalRegions>,
    second_look: Enlarged<SecondLook>,
    intrinsic: Enlarged<Intrinsic>,
}

impl FullResolution {
    /// Replaces the outputs of an `analysis` of the working picture by those in pixels of the photograph. The observer receives the
    /// outputs but the last. Returns whether the earlier split of the photograph was still valid.
    pub(super) fn enlarge<R: Recorder, O: Observer>(
        &mut self,
        photograph: &Photograph,
        working: &WorkingOutputs,
        observer: &mut O,
        analysis: &mut Analysis,
    ) -> Result<bool, Cancelled> {
        let Photograph { prepared, input, rules, .. } = photograph;
        let blocks = &prepared.working.blocks;
        analysis.masks = Arc::clone(&prepared.masks);
        analysis.working = Arc::clone(&prepared.working);
        analysis.windows = self.windows.get(working.windows.number, observer, || {
            let made = &working.windows.value;
            Windows { size_px: made.size_px * blocks.side(), ..Windows::clone(made) }
        })?;
        observer.made(StageOutput::Windows(Arc::clone(&analysis.windows)));
        analysis.areas =
            self.areas.get(working.merged.number, observer, || blocks.enlarged(&working.merged.value.map))?;
        observer.made(StageOutput::Areas(Arc::clone(&analysis.areas)));
        analysis.matte = self.matte.get(working.matte.number, observer, || {
            let made = &*working.matte.value;
            MatteRegions { labels: blocks.enlarged(&made.labels), ..made.clone() }
        })?;
        observer.made(StageOutput::Matte(Arc::clone(&analysis.matte)));
        analysis.planar = self.planar.get(working.planar.number, observer, || {
            let made = &*working.planar.value;
            let second_lamp_mask = made.second_lamp_mask.as_ref().map(|mask| Arc::new(blocks.enlarged(mask)));
            PlanarRegions { labels: blocks.enlarged(&made.labels), second_lamp_mask, ..made.clone() }
        })?;
        observer.made(StageOutput::Planar(Arc::clone(&analysis.planar)));
        let working_regions = &*working.finals.value;
        let stopping: &_ = observer;
        let labels = self.labels.get(working.finals.number, stopping, || {
            let stop = || stopping.cancelled();
            match rules.baseline {
                None => full_resolution_labels(&input.stopped_by(&stop), working_regions, blocks),
                // Exactly the marked pixels, wherever the blocks end.
                Some(Baseline::ByHand) => {
                    marked_labels(&prepared.masks, !working_regions.hypotheses.is_empty())
                }
                Some(_) => blocks.enlarged(&working_regions.labels),
            }
        })?;
        let is_enough = |found: &SecondLook| !R::KEEPS || found.is_recorded;
        let found = self.second_look.get_if(is_enough, working.split.number, stopping, || {
            let stop = || stopping.cancelled();
            let photograph = Photograph { input: input.stopped_by(&stop), ..*photograph };
            second_look::<R>(&photograph, working, &labels)
        })?;
        analysis.finals = self.finals.get(working.split.number, stopping, || {
            let second_lamp_mask = analysis.planar.second_lamp_mask.clone();
            found.added_to(FinalRegions {
                labels: LabelMap::clone(&labels),
                second_lamp_mask,
                ..working_regions.clone()
            })
        })?;
        analysis.second_look = found.findings();
        observer.made(StageOutput::Finals(Arc::clone(&analysis.finals)));
        let reused = self.intrinsic.is_made_from(working.split.number);
        let stopping: &_ = observer;
        analysis.intrinsic = self.intrinsic.get(working.split.number, stopping, || {
            let stop = || stopping.cancelled();
            let detail = Detail {
                input: input.stopped_by(&stop),
                labels: &analysis.finals.labels,
                blocks: *blocks,
                working_regions,
                second_look: analysis.second_look.is_some().then_some(&found.plans),
            };
            split_photograph(&detail, &working.split.value)
        })?;
        Ok(reused)
    }
}

impl FullResolution {
    /// The records of the last second look; empty without a record.
    pub(super) fn second_look_records(&self) -> Arc<[SecondLookRecord]> {
        self.second_look.0.as_ref().map_or_else(Arc::default, |(_, found)| Arc::clone(&found.records))
    }
}

/// The last output in pixels of the photograph, and the number of the output in working pixels that it was made from.
struct Enlarged<T>(Option<(u64, Arc<T>)>);

impl<T> Default for Enlarged<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T> Enlarged<T> {
    fn is_made_from(&self, number: u64) -> bool {
        self.0.as_ref().is_some_and(|(made_from, _)| *made_from == number)
    }

    /// The last output, or a new one if it was made from another than `number`. The result of a cancelled `make` is discarded.
    fn get(
        &mut self,
        number: u64,
        observer: &impl Observer,
        make: impl FnOnce() -> T,
    ) -> Result<Arc<T>, Cancelled> {
        self.get_if(|_| true, number, observer, make)
    }

    /// Like [`Self::get`], where also `is_enough` must be true of the last output.
    fn get_if(
        &mut self,
        is_enough: impl Fn(&T) -> bool,
        number: u64,
        observer: &impl Observer,
        make: impl FnOnce() -> T,
    ) -> Result<Arc<T>, Cancelled> {
        let is_valid = |(made_from, made): &&(u64, Arc<T>)| *made_from == number && is_enough(made);
        if let Some((_, made)) = self.0.as_ref().filter(is_valid) {
            return Ok(Arc::clone(made));
        }
        let made = Arc::new(make());
        if observer.cancelled() {
            return Err(Cancelled);
        }
        self.0 = Some((number, Arc::clone(&made)));
        Ok(made)
    }
}
