//! The observers of the analysis worker: of the run that makes a result, and of the run that records the decisions of a result.

use super::{Interruption, region_colors, result_snapshot};
use crate::analysis::{Analysis, Observer, Stage, StageOutput};
use crate::app::report::Report;
use crate::app::{AnalysisRequest, Preview};
use crate::raster::Blocks;
use crate::view::ResultSnapshot;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// A run that takes longer than this time shows each stage at the stage's end.
const SHOW_STAGES_AFTER: Duration = Duration::from_millis(60);

/// Measures the time of each stage, reports the stages, and stops for a newer request.
pub(super) struct RunObserver<'a> {
    pub(super) request: &'a AnalysisRequest,
    pub(super) began_at: Instant,
    pub(super) stage_began_at: Option<Instant>,
    pub(super) took_ms: [Option<f64>; Stage::ALL.len()],
    /// The last result with the stages that have been computed anew.
    pub(super) partial: Option<Analysis>,
    pub(super) last_result: Option<&'a ResultSnapshot>,
    /// Whether the run has shown no stage yet. Such a run goes on although a newer request waits: otherwise a slider in
    /// steady motion over a large picture would never show a result.
    pub(super) must_show: bool,
    /// The result for the working picture of the run before.
    pub(super) last_preview: Option<&'a Preview>,
    /// The result for the working picture of this run; none where the working picture is the photograph.
    pub(super) preview: Option<Preview>,
    pub(super) send: &'a (dyn Fn(Report) + Sync),
    pub(super) interrupted: &'a (dyn Fn() -> Option<Interruption> + Sync),
}

impl Observer for RunObserver<'_> {
    fn started(&mut self, stage: Stage) {
        self.stage_began_at = Some(Instant::now());
        (self.send)(Report::Progress { generation: self.request.generation, stage });
    }

    fn finished(&mut self, stage: Stage, reused: bool) {
        let took = self.stage_began_at.take().map(|began_at| began_at.elapsed().as_secs_f64() * 1e3);
        self.took_ms[stage as usize] = took.filter(|_| !reused);
    }

    fn working_made(&mut self, analysis: &Analysis, blocks: &Blocks) {
        let last = self.last_preview.map(|last| &*last.shown);
        let region_colors = region_colors(analysis, last);
        let shown = result_snapshot(self.request, analysis.clone(), self.took_ms, region_colors);
        let preview = Preview { shown: Arc::new(shown), blocks: *blocks };
        self.preview = Some(preview.clone());
        (self.send)(Report::Preview(preview));
        self.must_show = false;
    }

    fn made(&mut self, output: StageOutput) {
        let stage = output.stage();
        if self.preview.is_some() {
            // The result for the working picture is shown until the whole result is there.
            return;
        }
        let Some(partial) = &mut self.partial else { return };
        match output {
            StageOutput::Masks { masks, used } => (partial.masks, partial.used) = (masks, used),
            StageOutput::Windows(windows) => partial.windows = windows,
            StageOutput::Areas(areas) => partial.areas = areas,
            StageOutput::Matte(matte) => partial.matte = matte,
            StageOutput::Planar(planar) => partial.planar = planar,
            // Labels and the facts of the regions change together, at the end.
            StageOutput::Finals(_) | StageOutput::Intrinsic(_) => return,
        }
        let anew = self.took_ms[stage as usize].is_some();
        let Some(last_result) =
            self.last_result.filter(|_| anew && self.began_at.elapsed() > SHOW_STAGES_AFTER)
        else {
            return;
        };
        let next = Stage::ALL.iter().copied().find(|&later| later > stage);
        (self.send)(Report::Analyzed(Arc::new(ResultSnapshot {
            generation: self.request.generation,
            picture: Arc::clone(&self.request.picture),
            params: self.request.params,
            area: self.request.area.clone(),
            analysis: partial.clone(),
            stale_from: next,
            coverage: last_result.coverage,
            region_colors: last_result.region_colors.clone(),
            took_ms: self.took_ms,
            trace: OnceLock::new(),
            accuracy: OnceLock::new(),
            phoenix: OnceLock::new(),
            reasons: OnceLock::new(),
        })));
        self.must_show = false;
    }

    fn cancelled(&self) -> bool {
        match (self.interrupted)() {
            Some(Interruption::Stop) => true,
            Some(Interruption::Newer) => !self.must_show,
            None => false,
        }
    }
}

/// Reports the stages of a run that records the decisions of a result, and stops the run when the recording is interrupted.
pub(super) struct RecordingObserver<'a> {
    /// Number of the result.
    pub(super) generation: u64,
    pub(super) send: &'a (dyn Fn(Report) + Sync),
    pub(super) interrupted: &'a (dyn Fn() -> bool + Sync),
}

impl Observer for RecordingObserver<'_> {
    fn started(&mut self, stage: Stage) {
        (self.send)(Report::Recording { generation: self.generation, stage });
    }

    fn cancelled(&self) -> bool {
        (self.interrupted)()
    }
}
