//! The last output of a stage, which is reused while its key does not change.

use super::{Cancelled, Observer, Stage};
use crate::trace::{Recorder, StageBegan, StageTrace};
use std::sync::Arc;

/// The last output of a stage.
pub(super) struct Slot<K, V> {
    /// The key and the output that was made from it; `None` before the first run.
    made: Option<(K, V)>,
    /// Number of outputs made so far.
    generation: u64,
    /// The record of the stage, if the last run kept one.
    pub(super) stage_trace: Option<Arc<StageTrace>>,
}

impl<K, V> Default for Slot<K, V> {
    fn default() -> Self {
        Self { made: None, generation: 0, stage_trace: None }
    }
}

/// An output and its number.
#[derive(Clone)]
pub(super) struct Numbered<V> {
    pub(super) value: V,
    /// Number of the outputs of the stage when this one was made.
    pub(super) number: u64,
}

impl<K: PartialEq, V: Clone> Slot<K, V> {
    /// The output for `key`: the last output, or a new one made by `make`. The result of a cancelled `make` is discarded. An
    /// output without a record, where `R` keeps one, is made again for the record; the earlier output is returned.
    pub(super) fn get<O: Observer, R: Recorder>(
        &mut self,
        stage: Stage,
        key: K,
        observer: &mut O,
        make: impl FnOnce(&O, &mut R) -> V,
    ) -> Result<Numbered<V>, Cancelled> {
        observer.started(stage);
        let (made, reused) = self.get_silently(stage, key, observer, make)?;
        observer.finished(stage, reused);
        Ok(made)
    }

    /// Like [`Slot::get`], without a word to the observer, and with whether the earlier output was still valid.
    pub(super) fn get_silently<O: Observer, R: Recorder>(
        &mut self,
        stage: Stage,
        key: K,
        observer: &O,
        make: impl FnOnce(&O, &mut R) -> V,
    ) -> Result<(Numbered<V>, bool), Cancelled> {
        if observer.cancelled() {
            return Err(Cancelled);
        }
        let kept =
            self.made.as_ref().filter(|(made_from, _)| *made_from == key).map(|(_, value)| value.clone());
        if let Some(value) = kept.clone().filter(|_| !R::KEEPS || self.stage_trace.is_some()) {
            return Ok((self.numbered(value), true));
        }
        let (value, stage_trace) = recorded(stage, |recorder: &mut R| make(observer, recorder));
        if observer.cancelled() {
            return Err(Cancelled);
        }
        self.stage_trace = stage_trace;
        if let Some(value) = kept {
            return Ok((self.numbered(value), false));
        }
        self.made = Some((key, value.clone()));
        self.generation += 1;
        Ok((self.numbered(value), false))
    }

    /// Number of the outputs so far.
    pub(super) fn generation(&self) -> u64 {
        self.generation
    }

    /// The last output; none before the first run.
    pub(super) fn last(&self) -> Option<&V> {
        self.made.as_ref().map(|(_, value)| value)
    }

    fn numbered(&self, value: V) -> Numbered<V> {
        Numbered { value, number: self.generation }
    }
}

/// Runs a stage. Returns what the stage made, and its record, if `R` keeps one.
pub(super) fn recorded<R: Recorder, T>(
    stage: Stage,
    run: impl FnOnce(&mut R) -> T,
) -> (T, Option<Arc<StageTrace>>) {
    let mut recorder = R::default();
    if R::KEEPS {
        recorder.record(StageBegan { stage });
    }
    let made = run(&mut recorder);
    (made, recorder.finish(stage).map(Arc::new))
}
