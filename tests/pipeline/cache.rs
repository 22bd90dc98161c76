//! A changed parameter reruns what it makes stale and nothing else, and the result is a fresh session's.

use crate::common::{analyze, fingerprint};
use crate::synthetic::Scene;
use dichroscope::analysis::{Cancelled, Observer, Session, Stage};
use dichroscope::photo::LinearImage;
use dichroscope::segment::{Params, Refine, Setting};
use std::sync::Arc;

/// Notes which stages ran anew, and stops after some.
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
    let cases: [(&str, Params, &[Stage]); 10] = [
        ("nothing", base, &[]),
        ("split", off(|r| r.restore_prior = false), &[Split]),
        ("components", off(|r| r.split_components = false), &[Clipping, Split]),
        ("slice", Params { slice_width: value(2.0), ..base }, &[Planar, Clipping, Split]),
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

#[test]
fn what_a_cancelled_run_had_finished_is_kept() {
    let mut session = Session::new(Arc::new(balls()));
    let mut first = Journal { stop_after: Some(3), ..Journal::default() };
    session.run(&Params::default(), &mut first).unwrap_err();
    let mut second = Journal::default();
    session.run(&Params::default(), &mut second).unwrap();
    assert_eq!((first.ran, second.ran), (Stage::ALL[..3].to_vec(), Stage::ALL[3..].to_vec()));
}
