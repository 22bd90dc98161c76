//! The worker that analyzes. A newer request replaces a waiting request and cancels the request under way; a person can cancel both.

mod observers;

use super::Preview;
use super::panics::catch_panic;
use super::report::{Report, Work};
use crate::analysis::{Analysis, Session, Stage};
use crate::params::Params;
use crate::raster::Mask;
use crate::trace::Replay;
use crate::view::{Picture, ResultSnapshot, colors_with_further_regions};
use observers::{RecordingObserver, RunObserver};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A request to analyze a photograph.
#[derive(Clone, Debug)]
pub struct AnalysisRequest {
    /// The request's number; larger is newer.
    pub generation: u64,
    /// The photograph.
    pub picture: Arc<Picture>,
    /// The parameters.
    pub params: Params,
    /// The pixels that the analysis is restricted to; none: all.
    pub area: Option<Arc<Mask>>,
    /// Whether and when the decisions are recorded.
    pub tracing: Tracing,
}

/// The time at which decisions are recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tracing {
    /// Never: the debugger is closed.
    Never,
    /// When no slider moves.
    AtRest,
    /// With the result: the debugger's cursor stands before the end.
    AtOnce,
}

/// The request that waits for the worker. A newer request replaces the waiting request.
#[derive(Default)]
pub(super) struct LatestRequest {
    waiting: Mutex<Waiting>,
    arrived: Condvar,
}

#[derive(Default)]
struct Waiting {
    request: Option<AnalysisRequest>,
    /// Number of the newest request that a person canceled.
    canceled: Option<u64>,
    closed: bool,
}

/// The reason why a run is to end before its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interruption {
    /// A newer request waits.
    Newer,
    /// A person canceled the run, or the worker is to stop.
    Stop,
}

impl LatestRequest {
    /// Submits a request; an earlier request that still waits is dropped.
    pub(super) fn submit(&self, request: AnalysisRequest) {
        let mut waiting = self.lock();
        // Recording anew has the number of the result, which may have been canceled before.
        waiting.canceled = waiting.canceled.filter(|&canceled| canceled < request.generation);
        waiting.request = Some(request);
        drop(waiting);
        self.arrived.notify_one();
    }

    /// Cancels the request with this number, whether it waits or is under way, and all before.
    pub(super) fn cancel(&self, generation: u64) {
        let mut waiting = self.lock();
        waiting.request.take_if(|request| request.generation <= generation);
        waiting.canceled = Some(generation);
    }

    /// Makes the worker stop: [`LatestRequest::take`] returns none from now on.
    pub(super) fn close(&self) {
        self.lock().closed = true;
        self.arrived.notify_one();
    }

    /// Waits for a request; none once [`LatestRequest::close`] was called.
    fn take(&self) -> Option<AnalysisRequest> {
        let mut waiting = self.lock();
        loop {
            if waiting.closed {
                return None;
            }
            if let Some(request) = waiting.request.take() {
                return Some(request);
            }
            waiting = self.arrived.wait(waiting).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether no request comes within `quiet`.
    fn is_quiet_for(&self, quiet: Duration) -> bool {
        let nothing = |waiting: &mut Waiting| !waiting.closed && waiting.request.is_none();
        let waited = self.arrived.wait_timeout_while(self.lock(), quiet, nothing);
        waited.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Why the run of the request with this number is to end; none where it is to go on.
    fn interruption(&self, generation: u64) -> Option<Interruption> {
        let waiting = self.lock();
        if waiting.closed || waiting.canceled.is_some_and(|canceled| generation <= canceled) {
            Some(Interruption::Stop)
        } else {
            waiting.request.as_ref().map(|_| Interruption::Newer)
        }
    }

    /// The waiting request, also after a panic of another thread.
    fn lock(&self) -> std::sync::MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A slider that has not moved for this time is at rest.
const REST_TIME: Duration = Duration::from_millis(200);

/// Analyzes requests until `latest_request` is closed.
pub(super) fn work(latest_request: &LatestRequest, outbox: &Sender<Report>, wake: &(dyn Fn() + Send + Sync)) {
    let mut analysis_worker = AnalysisWorker::default();
    while let Some(request) = latest_request.take() {
        let outbox = Mutex::new(outbox.clone());
        let send = |report| {
            // A closed window has dropped the receiver, and needs no report.
            let _ = outbox.lock().unwrap_or_else(PoisonError::into_inner).send(report);
            wake();
        };
        let run =
            catch_panic(|| analyze_request(&mut analysis_worker, &request, latest_request, &send, wake));
        if let Err(reason) = run {
            // The stages of the session may be incomplete.
            analysis_worker = AnalysisWorker::default();
            send(Report::Panicked { work: Work::Analysis, reason });
        }
    }
}

/// Analyzes one request, records its decisions and measures its scores.
fn analyze_request(
    analysis_worker: &mut AnalysisWorker,
    request: &AnalysisRequest,
    latest_request: &LatestRequest,
    send: &(dyn Fn(Report) + Sync),
    wake: &(dyn Fn() + Send + Sync),
) {
    let interrupted = || latest_request.interruption(request.generation);
    let Some(shown) = analysis_worker.analyze(request, send, &interrupted) else { return };
    send(Report::Analyzed(Arc::clone(&shown)));
    let interrupted = || latest_request.interruption(request.generation).is_some();
    if request.tracing == Tracing::AtOnce {
        analysis_worker.trace(request, &shown, send, &interrupted);
    }
    // Scoring and recording take as long as the analysis: they wait until no slider moves.
    let records = request.tracing == Tracing::AtRest;
    if (records || shown.picture.truth.is_some()) && latest_request.is_quiet_for(REST_TIME) {
        if records {
            analysis_worker.trace(request, &shown, send, &interrupted);
        }
        if shown.picture.truth.is_some() {
            shown.measure();
            wake();
        }
    }
}

/// The session of one photograph, and its last result.
#[derive(Default)]
pub(super) struct AnalysisWorker {
    session: Option<(Arc<Picture>, Session)>,
    last: Option<Arc<ResultSnapshot>>,
    /// The last result for the working picture; none where the working picture is the photograph.
    last_preview: Option<Preview>,
}

impl AnalysisWorker {
    /// Analyzes; none when the request was overtaken or canceled.
    pub(super) fn analyze(
        &mut self,
        request: &AnalysisRequest,
        send: &(dyn Fn(Report) + Sync),
        interrupted: &(dyn Fn() -> Option<Interruption> + Sync),
    ) -> Option<Arc<ResultSnapshot>> {
        let same = |session: &(Arc<Picture>, Session)| Arc::ptr_eq(&session.0, &request.picture);
        if !self.session.as_ref().is_some_and(same) {
            let image = Arc::clone(&request.picture.photo.image);
            self.session = Some((Arc::clone(&request.picture), Session::new(image)));
            (self.last, self.last_preview) = (None, None);
        }
        let (_, session) = self.session.as_mut()?;
        if session.restrict(request.area.clone()).is_err() {
            // The reducer drops the areas of other pictures; an area of another size restricts nothing.
            session.restrict(None).ok()?;
        }
        let mut observer = RunObserver {
            request,
            began_at: Instant::now(),
            stage_began_at: None,
            took_ms: [None; Stage::ALL.len()],
            partial: self.last.as_deref().map(|last| last.analysis.clone()),
            last_result: self.last.as_deref(),
            must_show: self.last.is_some(),
            last_preview: self.last_preview.as_ref(),
            preview: None,
            send,
            interrupted,
        };
        let run = if request.tracing == Tracing::AtOnce {
            let run = session.run_traced(&request.params, &mut observer);
            run.map(|(analysis, trace)| (analysis, Some(Arc::new(trace))))
        } else {
            session.run(&request.params, &mut observer).map(|analysis| (analysis, None))
        };
        let (took_ms, preview) = (observer.took_ms, observer.preview);
        let Ok((analysis, trace)) = run else {
            // The result for the working picture is kept although the pass at full resolution was cancelled.
            self.last_preview = preview.or(self.last_preview.take());
            return None;
        };
        let region_colors = match &preview {
            // The regions of the working picture have the same numbers; those of the second look follow them.
            Some(preview) => colors_with_further_regions(&analysis, &preview.shown.region_colors),
            None => region_colors(&analysis, self.last.as_deref()),
        };
        let shown = Arc::new(result_snapshot(request, analysis, took_ms, region_colors));
        self.last_preview = preview;
        if let Some(trace) = trace {
            shown.trace.get_or_init(|| trace);
        }
        self.last = Some(Arc::clone(&shown));
        Some(shown)
    }

    /// Records the decisions that led to a result, where `request` wants it and it has not been done, and reports the stages meanwhile
    /// and a cursor at the end. An interrupted recording reports no cursor.
    pub(super) fn trace(
        &mut self,
        request: &AnalysisRequest,
        shown: &ResultSnapshot,
        send: &(dyn Fn(Report) + Sync),
        interrupted: &(dyn Fn() -> bool + Sync),
    ) {
        let Some((_, session)) = self.session.as_mut().filter(|_| request.tracing != Tracing::Never) else {
            return;
        };
        if shown.trace.get().is_none() {
            let mut observer = RecordingObserver { generation: request.generation, send, interrupted };
            let Ok((_, trace)) = session.run_traced(&request.params, &mut observer) else { return };
            shown.trace.get_or_init(|| Arc::new(trace));
        }
        let Some(trace) = shown.trace.get() else { return };
        let mut replay = Replay::new(Arc::clone(trace));
        replay.prepare();
        send(Report::Traced { generation: request.generation, replay: Box::new(replay) });
    }
}

/// Colors of the regions of a result; regions that continue regions of `last` keep their colors.
fn region_colors(analysis: &Analysis, last: Option<&ResultSnapshot>) -> Vec<[u8; 3]> {
    let labels = &analysis.finals.labels;
    let same_size = |last: &&ResultSnapshot| {
        (last.labels().width(), last.labels().height()) == (labels.width(), labels.height())
    };
    let before = last.filter(same_size).map(|last| (last.labels(), last.region_colors.as_slice()));
    crate::view::region_colors(analysis, before)
}

/// The snapshot of a complete result.
fn result_snapshot(
    request: &AnalysisRequest,
    analysis: Analysis,
    took_ms: [Option<f64>; Stage::ALL.len()],
    region_colors: Vec<[u8; 3]>,
) -> ResultSnapshot {
    let area = request.area.clone();
    let shown = ResultSnapshot::new(Arc::clone(&request.picture), request.params, analysis, region_colors);
    ResultSnapshot { generation: request.generation, area, took_ms, ..shown }
}

#[cfg(test)]
mod tests;
