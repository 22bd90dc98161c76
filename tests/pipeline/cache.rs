//! A changed parameter reruns the stages that it makes stale and no others, and the result equals that of a new
//! session.

use crate::common::{analyze, fingerprint};
use crate::synthetic::Scene;
use dichroscope::analysis::{Analysis, Cancelled, Observer, Session, Stage, StageOutput};
use dichroscope::params::{IlluminantSetting, Params, Refine, Setting};
use dichroscope::photo::LinearImage;
use dichroscope::raster::Blocks;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// An observer that records which stages ran, and cancels after `stop_after` stages.
#[derive(Default)]
struct Journal {
    started: usize,
    finished: usize,
    ran: Vec<Stage>,
    stop_after: Option<usize>,
}

impl Observer for Journal {
    fn started(&mut self, _stage: Stage) {
        self.started += 1;
    }

    fn finished(&mut self, stage: Stage, reused: bool) {
        self.finished += 1;
        if !reused {
            self.ran.push(stage);
        }
    }

    fn cancelled(&self) -> bool {
        self.stop_after == Some(self.finished)
    }
}

fn balls() -> LinearImage {
    Scene::grid_of_balls([160, 80], 2, 1, 17).render().image
}

fn value(number: f64) -> Setting {
    Setting::Value(number)
}

#[test]
fn a_changed_parameter_reruns_from_the_first_stage_that_looks_at_it() {
    use Stage::{Classify, Clipping, Linear, Masks, Merge, Planar, Split};
    let base = Params::default();
    let off = |change: fn(&mut Refine)| {
        let mut refine = Refine::default();
        change(&mut refine);
        Params { refine, ..base }
    };
    let cases: [(&str, Params, &[Stage]); 11] = [
        ("nothing", base, &[]),
        ("split", off(|r| r.restore_prior = false), &[Split]),
        ("components", off(|r| r.split_components = false), &[Clipping, Split]),
        ("slice", Params { slice_width: value(2.0), ..base }, &[Planar, Clipping, Split]),
        (
            "light",
            Params { illuminant: IlluminantSetting::Given([1.0, 0.9, 0.8]), ..base },
            &[Planar, Clipping, Split],
        ),
        ("bounds", off(|r| r.slice_bounds = false), &[Planar, Clipping, Split]),
        ("area", Params { min_area: value(300.0), ..base }, &[Linear, Planar, Clipping, Split]),
        ("cylinder", Params { cylinder_width: value(3.0), ..base }, &[Linear, Planar, Clipping, Split]),
        ("window", Params { window_size: value(8.0), ..base }, &Stage::ALL[1..]),
        ("tail", off(|r| r.tail_test = false), &[Classify, Merge, Linear, Planar, Clipping, Split]),
        (
            "intensity",
            Params { min_intensity: value(40.0), ..base },
            &[Masks, Classify, Merge, Linear, Planar, Clipping, Split],
        ),
    ];
    let image = balls();
    for (name, params, expected) in cases {
        let mut session = Session::new(Arc::new(image.clone()));
        session.run(&base, &mut ()).unwrap();
        let mut journal = Journal::default();
        let analysis = session.run(&params, &mut journal).unwrap();
        assert_eq!(journal.ran, expected, "{name}");
        assert_eq!((journal.started, journal.finished), (7, 7), "{name}");
        assert!(
            fingerprint(&analysis) == fingerprint(&analyze(&image, &params)),
            "{name}: not a fresh result"
        );
    }
}

/// An observer that keeps the output of each stage.
#[derive(Default)]
struct Collector(Vec<StageOutput>);

impl Observer for Collector {
    fn made(&mut self, output: StageOutput) {
        self.0.push(output);
    }
}

#[test]
fn every_stage_hands_out_what_the_result_holds_new_or_reused() {
    let mut session = Session::new(Arc::new(balls()));
    for _ in 0..2 {
        let mut collector = Collector::default();
        let analysis = session.run(&Params::default(), &mut collector).unwrap();
        let stages: Vec<Stage> = collector.0.iter().map(StageOutput::stage).collect();
        assert_eq!(stages, Stage::ALL);
        for output in &collector.0 {
            let shared = match output {
                StageOutput::Masks { masks, used } => {
                    *used == analysis.used && Arc::ptr_eq(masks, &analysis.masks)
                }
                StageOutput::Windows(windows) => Arc::ptr_eq(windows, &analysis.windows),
                StageOutput::Areas(areas) => Arc::ptr_eq(areas, &analysis.areas),
                StageOutput::Matte(matte) => Arc::ptr_eq(matte, &analysis.matte),
                StageOutput::Planar(planar) => Arc::ptr_eq(planar, &analysis.planar),
                StageOutput::Finals(finals) => Arc::ptr_eq(finals, &analysis.finals),
                StageOutput::Intrinsic(intrinsic) => Arc::ptr_eq(intrinsic, &analysis.intrinsic),
            };
            assert!(shared, "{:?} is not the result's own", output.stage());
        }
    }
}

#[test]
fn an_automatic_intensity_follows_the_noise_that_was_given() {
    let image = balls();
    let params =
        |noise| Params { camera_noise: value(noise), min_intensity: Setting::Auto, ..Params::default() };
    let mut session = Session::new(Arc::new(image.clone()));
    for noise in [2.0, 6.0, 2.0] {
        let analysis = session.run(&params(noise), &mut ()).unwrap();
        assert!(fingerprint(&analysis) == fingerprint(&analyze(&image, &params(noise))), "noise {noise}");
    }
}

#[test]
fn a_cancelled_run_leaves_a_session_that_works() {
    let image = balls();
    let (before, after) = (Params::default(), Params { window_size: value(8.0), ..Params::default() });
    for stop_after in 0..Stage::ALL.len() {
        let mut session = Session::new(Arc::new(image.clone()));
        session.run(&before, &mut ()).unwrap();
        let mut journal = Journal { stop_after: Some(stop_after), ..Journal::default() };
        assert_eq!(session.run(&after, &mut journal).unwrap_err(), Cancelled);
        assert_eq!(journal.finished, stop_after);
        for params in [before, after] {
            let analysis = session.run(&params, &mut ()).unwrap();
            let fresh = analyze(&image, &params);
            assert!(fingerprint(&analysis) == fingerprint(&fresh), "after {stop_after} stages");
        }
    }
}

/// An observer that cancels the run at the query after `queries_left` queries.
struct CancelsAfter {
    queries_left: AtomicUsize,
}

impl Observer for CancelsAfter {
    fn cancelled(&self) -> bool {
        self.queries_left.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_err()
    }
}

#[test]
fn a_run_cancelled_within_a_stage_keeps_no_incomplete_output() {
    never_keeps_incomplete_output(&Params::default());
}

#[test]
fn a_run_cancelled_at_full_resolution_keeps_no_incomplete_output() {
    never_keeps_incomplete_output(&Params { scale: value(2.0), ..Params::default() });
}

fn never_keeps_incomplete_output(params: &Params) {
    let image = balls();
    let fresh = fingerprint(&analyze(&image, params));
    let mut cancelled = 0;
    for queries in (0..400).step_by(7) {
        let mut session = Session::new(Arc::new(image.clone()));
        let mut observer = CancelsAfter { queries_left: AtomicUsize::new(queries) };
        match session.run(params, &mut observer) {
            Ok(analysis) => assert!(fingerprint(&analysis) == fresh, "after {queries} queries"),
            Err(Cancelled) => cancelled += 1,
        }
        let analysis = session.run(params, &mut ()).unwrap();
        assert!(fingerprint(&analysis) == fresh, "cancelled after {queries} queries");
    }
    assert!(cancelled > 10, "the observer is queried within stages, not only between stages");
}

/// An observer of the working picture that cancels the run once the analysis of the working picture is there.
#[derive(Default)]
struct OfWorkingPicture {
    made: Option<(Analysis, Blocks)>,
    cancels: bool,
}

impl Observer for OfWorkingPicture {
    fn working_made(&mut self, analysis: &Analysis, blocks: &Blocks) {
        self.made = Some((analysis.clone(), *blocks));
    }

    fn cancelled(&self) -> bool {
        self.cancels && self.made.is_some()
    }
}

#[test]
fn the_analysis_of_the_working_picture_comes_before_full_resolution() {
    let image = balls();
    let params = Params { scale: value(2.0), ..Params::default() };
    let mut session = Session::new(Arc::new(image.clone()));
    let mut observer = OfWorkingPicture { cancels: true, ..OfWorkingPicture::default() };
    assert_eq!(session.run(&params, &mut observer).unwrap_err(), Cancelled);
    let (working, blocks) = observer.made.unwrap();
    assert_eq!(blocks.side(), 2);
    let size = |analysis: &Analysis| {
        let body = &analysis.intrinsic.body;
        assert_eq!(body.len(), analysis.finals.labels.len());
        assert_eq!(body.len(), analysis.areas.len());
        (body.width(), body.height())
    };
    assert_eq!(size(&working), (image.width().div_ceil(2), image.height().div_ceil(2)));
    // The stages are done: only the pass at full resolution is left.
    let mut journal = Journal::default();
    let whole = session.run(&params, &mut journal).unwrap();
    assert_eq!(journal.ran, [Stage::Split]);
    assert_eq!(size(&whole), (image.width(), image.height()));
    assert_eq!(whole.illuminant, working.illuminant);
    assert_eq!(whole.working_finals, working.finals);
    assert!(fingerprint(&whole) == fingerprint(&analyze(&image, &params)));
    // A picture of its own working pixels has no such analysis.
    let mut observer = OfWorkingPicture::default();
    session.run(&Params { scale: value(1.0), ..params }, &mut observer).unwrap();
    assert!(observer.made.is_none());
}

#[test]
fn stages_that_finished_before_a_cancellation_are_kept() {
    let mut session = Session::new(Arc::new(balls()));
    let mut first = Journal { stop_after: Some(3), ..Journal::default() };
    session.run(&Params::default(), &mut first).unwrap_err();
    let mut second = Journal::default();
    session.run(&Params::default(), &mut second).unwrap();
    assert_eq!((first.ran, second.ran), (Stage::ALL[..3].to_vec(), Stage::ALL[3..].to_vec()));
}
