//! Who listens to the decisions while they are made.

use super::{Contest, Event, LocalRecord, PixelKind, Stage, StageTrace};
use crate::raster::{HypothesisId, PixelIndex, Raster};

/// Takes one stage's decisions in their order. Stages are generic over it, so that [`NoopRecorder`] costs nothing.
pub trait Recorder: Default {
    /// Whether anything is kept: what is recorded is put together only then.
    const KEEPS: bool;

    /// A decision.
    fn record(&mut self, event: impl Into<Event>);

    /// A pixel changed hands.
    fn claim(&mut self, pixel: PixelIndex, before: Option<HypothesisId>, after: Option<HypothesisId>);

    /// `challenger` wanted a pixel that `holder` has; a claim of it follows where that was granted.
    fn contest(
        &mut self,
        pixel: PixelIndex,
        holder: HypothesisId,
        challenger: HypothesisId,
        granted: bool,
        contest: Contest,
    );

    /// Every pixel's final role was decided.
    fn labels(&mut self, kinds: &Raster<PixelKind>);

    /// What pixels were judged by where the model does not hold.
    fn local(&mut self, record: LocalRecord);

    /// The record of what was heard; none where nothing was kept.
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

/// Keeps everything, compactly.
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
        self.0.set_labels(kinds.clone());
    }

    fn local(&mut self, record: LocalRecord) {
        self.0.set_local(record);
    }

    fn finish(self, stage: Stage) -> Option<StageTrace> {
        Some(self.0.finished(stage))
    }
}
