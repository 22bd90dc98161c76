//! Carries out the effects of commands and reports, on threads or inline.

use super::analysis_worker::{self, AnalysisWorker, LatestRequest, Tracing};
use super::export_input::ExportInput;
use super::exports::write_export;
use super::folders::with_photographs_of_folders;
use super::panics::catch_panic;
use super::reduce::reduce_report;
use super::report::{Report, Work, WrittenWorkspace};
use super::{
    AnalysisRequest, Command, Effect, ExportKind, Job, State, WhatIfProgress, WhatIfRequest, jobs, read,
    reduce, rescue,
};
use crate::analysis::{Session, WhatIfObserver, what_if};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// The place where background work is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Executor {
    /// On named threads; the caller does not wait.
    Threads,
    /// Inside [`Application::apply`], which returns when all work has ended; for tests and pictures.
    Inline,
}

/// A state and the workers that carry out its effects.
pub struct Application {
    state: State,
    outbox: Sender<Report>,
    inbox: Receiver<Report>,
    wake: Arc<dyn Fn() + Send + Sync>,
    workers: Workers,
    stop_writing: Arc<jobs::Stop>,
    stop_what_if: Arc<jobs::Stop>,
}

/// The analysis worker.
enum Workers {
    Inline(Box<AnalysisWorker>),
    Threads { latest_request: Arc<LatestRequest>, worker: Option<JoinHandle<()>> },
}

impl Application {
    /// An application in which nothing is open. `wake` is called, on any thread, when a report waits for [`Application::poll`].
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn new(executor: Executor, wake: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        Self::with_state(executor, State::default(), wake)
    }

    /// As [`Application::new`], but with everything that `state` holds. The worker has no cached stages of it: the first
    /// analysis that a command asks for runs them all.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn with_state(
        executor: Executor,
        state: State,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let (outbox, inbox) = mpsc::channel();
        let wake: Arc<dyn Fn() + Send + Sync> = Arc::new(wake);
        let workers = match executor {
            Executor::Inline => Workers::Inline(Box::default()),
            Executor::Threads => {
                let latest_request = Arc::new(LatestRequest::default());
                let (requests, report, wake_window) =
                    (Arc::clone(&latest_request), outbox.clone(), Arc::clone(&wake));
                let worker = thread::Builder::new()
                    .name("analysis".to_owned())
                    .spawn(move || analysis_worker::work(&requests, &report, &*wake_window))?;
                Workers::Threads { latest_request, worker: Some(worker) }
            }
        };
        Ok(Self {
            state,
            outbox,
            inbox,
            wake,
            workers,
            stop_writing: Arc::default(),
            stop_what_if: Arc::default(),
        })
    }

    /// The state that panels show.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Applies a command and starts the effects.
    pub fn apply(&mut self, command: impl Into<Command>) {
        for effect in reduce(&mut self.state, command) {
            self.carry_out(effect);
        }
        if matches!(self.workers, Workers::Inline(_)) {
            self.poll();
        }
    }

    /// Applies the reports that workers have sent.
    pub fn poll(&mut self) {
        while let Ok(report) = self.inbox.try_recv() {
            self.take_report(report);
        }
    }

    /// Applies a report of a worker and starts the effects.
    pub(super) fn take_report(&mut self, report: Report) {
        for effect in reduce_report(&mut self.state, report) {
            self.carry_out(effect);
        }
    }

    /// Restores the settings of an earlier session.
    pub fn restore_settings(&mut self, view: super::ViewSettings, recent: Vec<std::path::PathBuf>) {
        // A relative path of an earlier version names nothing in another working directory.
        let recent = recent.into_iter().filter(|path| path.is_absolute()).collect();
        (self.state.view, self.state.recent) = (view, recent);
    }

    /// Writes the workspace beside the photograph before the program ends by a panic, and returns its path.
    ///
    /// # Errors
    /// A sentence that says why the workspace was not written.
    pub fn rescue_workspace(&self) -> Result<std::path::PathBuf, String> {
        rescue::write_workspace(&ExportInput::of(&self.state))
    }

    /// Starts or stops the work of an effect.
    fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Analyze => self.analyze(self.tracing()),
            Effect::Trace => self.analyze(Tracing::AtOnce),
            Effect::CancelAnalysis => {
                if let Workers::Threads { latest_request, .. } = &self.workers {
                    latest_request.cancel(self.state.generation);
                }
            }
            Effect::Read(origin, options) => {
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::Photograph, move || match read::picture(origin, options) {
                    Ok(picture) => Report::Opened(Arc::new(picture)),
                    Err(reason) => Report::OpenFailed(reason),
                });
            }
            Effect::ReadTogether(files) => {
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::Photograph, move || read::photographs(files));
            }
            Effect::FindInFolders(origins) => {
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::Folder, move || {
                    let (files, notes) = with_photographs_of_folders(origins);
                    Report::FoundInFolders(files, notes)
                });
            }
            Effect::ReadElsewhere { kind, path, shows } => {
                let Some(picture) = self.state.picture.clone() else { return };
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::File, move || read::elsewhere(kind, &path, picture, shows));
            }
            Effect::ReadParams(path) => {
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::File, move || read::params(&path));
            }
            Effect::ReadWorkspace { path, elsewhere } => {
                self.state.jobs.reading = Some(Job::now());
                self.run("reader", Work::File, move || read::workspace(&path, elsewhere));
            }
            Effect::Write(export) => {
                self.state.jobs.export = Some(Job::now());
                let input = ExportInput::of(&self.state);
                self.stop_writing = Arc::default();
                let stop = Arc::clone(&self.stop_writing);
                let (outbox, wake) = (self.outbox.clone(), Arc::clone(&self.wake));
                let send = move |done, total| {
                    let _ = outbox.send(Report::Exporting { done, total });
                    wake();
                };
                let write = move || {
                    let outcome = write_export(&export, &input, &stop, &send);
                    let picture = input.picture.filter(|_| export.kind == ExportKind::Workspace);
                    let written = |picture| {
                        Box::new(WrittenWorkspace { path: export.path, picture, document: input.document })
                    };
                    let workspace = picture.map(written);
                    Report::Exported { outcome, workspace }
                };
                self.run("writer", Work::Export, write);
            }
            Effect::StopWriting => self.stop_writing.stop(),
            Effect::FindWhatIf(request) => self.find_what_if(request),
            Effect::StopWhatIf => self.stop_what_if.stop(),
            Effect::Rescue => {
                let input = ExportInput::of(&self.state);
                self.run("rescue", Work::Rescue, move || Report::Rescued(rescue::write_workspace(&input)));
            }
        }
    }

    /// The time at which decisions are recorded: with the result while the cursor stands before the end of the trace, otherwise
    /// when no slider moves.
    fn tracing(&self) -> Tracing {
        match (self.state.view.debug.open, self.state.debugger.stopped().is_some(), &self.workers) {
            (false, ..) => Tracing::Never,
            (true, false, Workers::Threads { .. }) => Tracing::AtRest,
            (true, ..) => Tracing::AtOnce,
        }
    }

    /// Submits a request for the present document, or analyzes inline.
    fn analyze(&mut self, tracing: Tracing) {
        let Some(picture) = &self.state.picture else { return };
        let request = AnalysisRequest {
            generation: self.state.generation,
            picture: Arc::clone(picture),
            params: self.state.document.params,
            area: self.state.document.area.clone(),
            tracing,
        };
        // A series of requests is one job with one beginning, so that the spinner shows the whole wait of a slider's drag.
        let job = self.state.jobs.analysis.unwrap_or_else(Job::now);
        self.state.jobs.analysis = Some(Job { stage: None, ..job });
        self.state.jobs.recording = None;
        match &mut self.workers {
            Workers::Threads { latest_request, .. } => latest_request.submit(request),
            Workers::Inline(analysis_worker) => {
                let outbox = Mutex::new(self.outbox.clone());
                let send = |report| {
                    let _ = outbox.lock().unwrap_or_else(PoisonError::into_inner).send(report);
                };
                let run = catch_panic(|| {
                    if let Some(shown) = analysis_worker.analyze(&request, &send, &|| None) {
                        shown.measure();
                        send(Report::Analyzed(Arc::clone(&shown)));
                        analysis_worker.trace(&request, &shown, &send, &|| false);
                    }
                });
                if let Err(reason) = run {
                    // The stages of the session may be incomplete.
                    **analysis_worker = AnalysisWorker::default();
                    send(Report::Panicked { work: Work::Analysis, reason });
                }
            }
        }
    }

    /// Runs a what-if job in a session of its own: the analysis worker's session keeps the stages of the result shown.
    fn find_what_if(&mut self, request: WhatIfRequest) {
        let Some(picture) = self.state.picture.clone() else { return };
        let (params, area) = (self.state.document.params, self.state.document.area.clone());
        self.stop_what_if = Arc::default();
        let (outbox, wake) = (self.outbox.clone(), Arc::clone(&self.wake));
        let mut observer = ProgressReporter { request, stop: Arc::clone(&self.stop_what_if), outbox, wake };
        self.run("what if", Work::WhatIf, move || {
            let mut session = Session::new(Arc::clone(&picture.photo.image));
            // An area of another picture restricts nothing.
            let _ = session.restrict(area);
            let found = what_if(&mut session, &params, request.pixel, &mut observer);
            Report::WhatIf(request, found.map_or(WhatIfProgress::Stopped, WhatIfProgress::Found))
        });
    }

    /// Runs `job` on a thread or inline; its report, or the report of its panic, arrives by the inbox.
    fn run(&self, name: &str, work: Work, job: impl FnOnce() -> Report + Send + 'static) {
        let (outbox, wake) = (self.outbox.clone(), Arc::clone(&self.wake));
        let run = move || {
            let report = catch_panic(job).unwrap_or_else(|reason| Report::Panicked { work, reason });
            let _ = outbox.send(report);
            wake();
        };
        if matches!(self.workers, Workers::Inline(_)) {
            run();
        } else if let Err(error) = thread::Builder::new().name(name.to_owned()).spawn(run) {
            let reason = format!("the system gives no thread to work on: {error}; close other programs");
            let _ = self.outbox.send(Report::Failed(reason));
        }
    }
}

/// Reports the progress of a what-if job, and stops the job when `stop` is set.
struct ProgressReporter {
    request: WhatIfRequest,
    stop: Arc<jobs::Stop>,
    outbox: Sender<Report>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl WhatIfObserver for ProgressReporter {
    fn progress(&mut self, done: usize, of: usize) {
        let _ = self.outbox.send(Report::WhatIf(self.request, WhatIfProgress::Progress(done, of)));
        (self.wake)();
    }

    fn cancelled(&self) -> bool {
        self.stop.stopped()
    }
}

impl Drop for Application {
    fn drop(&mut self) {
        self.stop_writing.stop();
        self.stop_what_if.stop();
        if let Workers::Threads { latest_request, worker } = &mut self.workers {
            latest_request.close();
            if let Some(worker) = worker.take() {
                let _ = worker.join();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::{JobCommand, Severity};
    use crate::view::Origin;
    use std::panic::resume_unwind;

    const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

    #[test]
    fn a_panic_of_each_worker_ends_its_work_with_a_notice_and_saves_the_workspace() {
        let root = tempfile::tempdir().unwrap();
        let photo = root.path().join("cups.png");
        std::fs::copy(TINY, &photo).unwrap();
        let mut application = Application::new(Executor::Inline, || ()).unwrap();
        application.apply(JobCommand::Open(Origin::File(photo)));
        for work in [Work::Photograph, Work::Folder, Work::File, Work::Analysis, Work::Export, Work::WhatIf] {
            let state = &mut application.state;
            state.notices.clear();
            (state.jobs.reading, state.jobs.analysis) = (Some(Job::now()), Some(Job::now()));
            state.jobs.export = Some(Job::now());
            application.run("test", work, || resume_unwind(Box::new("an odd number")));
            application.poll();
            let state = application.state();
            let jobs = [state.jobs.reading, state.jobs.analysis, state.jobs.export];
            let ended = match work {
                Work::Photograph | Work::Folder | Work::File => jobs[0].is_none(),
                Work::Analysis => jobs[1].is_none(),
                Work::Export => jobs[2].is_none(),
                _ => true,
            };
            assert!(ended, "{work:?}");
            let error = state.notices.iter().find(|notice| notice.severity == Severity::Error).unwrap();
            assert!(error.text.contains("an odd number") && error.text.contains(work.name()), "{error:?}");
            let saved = root.path().join("cups-rescued.dichroscope");
            assert!(state.notices.iter().any(|notice| notice.text.contains(&saved.display().to_string())));
            crate::app::Workspace::load(&saved).unwrap();
            std::fs::remove_file(saved).unwrap();
        }
    }

    #[test]
    fn the_analysis_goes_on_after_a_panic_of_a_thread() {
        let (send, receive) = mpsc::channel();
        let wake = move || {
            let _ = send.send(());
        };
        let mut application = Application::new(Executor::Threads, wake).unwrap();
        application.run("test", Work::Photograph, || resume_unwind(Box::new("broken decoder")));
        receive.recv().unwrap();
        application.poll();
        assert!(application.state().notices[0].text.contains("broken decoder"));
        application.apply(JobCommand::Open(Origin::File(TINY.into())));
        while !application.state().is_current() {
            receive.recv_timeout(std::time::Duration::from_mins(1)).unwrap();
            application.poll();
        }
    }
}
