//! The recipients of decisions while they are made.

use super::{Contest, Event, LocalRecord, PixelKind, Stage, StageTrace};
use crate::raster::{HypothesisId, PixelIndex, Raster};

/// Takes the decisions of one stage in their order. Stages are generic over the recorder, so that [`NoopRecorder`] costs
/// nothing.
pub trait Recorder: Default {
    /// Whether the recorder keeps anything. Stages make events only then.
    const KEEPS: bool;

    /// Takes a decision.
    fn record(&mut self, event: impl Into<Event>);

    /// Takes a change of a pixel's owner.
    fn claim(&mut self, pixel: PixelIndex, before: Option<HypothesisId>, after: Option<HypothesisId>);

    /// Takes a contest: `challenger` wanted a pixel that `holder` has. Where the pixel is granted, a claim follows.
    fn contest(
        &mut self,
        pixel: PixelIndex,
        holder: HypothesisId,
        challenger: HypothesisId,
        granted: bool,
        contest: Contest,
    );

    /// Takes the kinds of all pixels.
    fn labels(&mut self, kinds: &Raster<PixelKind>);

    /// Takes the record of the local split.
    fn local(&mut self, record: LocalRecord);

    /// The record of the stage; none where nothing was kept.
    fn finish(self, stage: Stage) -> Option<StageTrace>;
}

/// Keeps nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoopRecorder;

impl Recorder for NoopRecorder {
    const KEEPS: bool = false;

    #[inline]
    fn record(&mut self, _event: impl Into<Event>) {}

    #[inline]
    fn claim(&mut self, _pixel: PixelIndex, _before: Option<HypothesisId>, _after: Option<HypothesisId>) {}

    #[inline]
    fn contest(
        &mut self,
        _pixel: PixelIndex,
        _holder: HypothesisId,
        _challenger: HypothesisId,
        _granted: bool,
        _contest: Contest,
    ) {
    }

    #[inline]
    fn labels(&mut self, _kinds: &Raster<PixelKind>) {}

    #[inline]
    fn local(&mut self, _record: LocalRecord) {}

    fn finish(self, _stage: Stage) -> Option<StageTrace> {
        None
    }
}

/// Keeps all decisions, compactly.
#[derive(Clone, Debug, Default)]
pub struct TraceRecorder(StageTrace);

impl Recorder for TraceRecorder {
    const KEEPS: bool = true;

    fn record(&mut self, event: impl Into<Event>) {
        self.0.push_event(event.into());
    }

    #[inline]
    fn claim(&mut self, pixel: PixelIndex, before: Option<HypothesisId>, after: Option<HypothesisId>) {
        self.0.push_claim(pixel, before, after);
    }

    #[inline]
    fn contest(
        &mut self,
        pixel: PixelIndex,
        holder: HypothesisId,
        challenger: HypothesisId,
        granted: bool,
        contest: Contest,
    ) {
        self.0.push_contest(pixel, holder, challenger, granted, contest);
    }

    fn labels(&mut self, kinds: &Raster<PixelKind>) {
        self.0.set_kinds(kinds.clone());
    }

    fn local(&mut self, record: LocalRecord) {
        self.0.set_local(record);
    }

    fn finish(self, stage: Stage) -> Option<StageTrace> {
        Some(self.0.finished(stage))
    }
}
