use crate::app::{Application, Command, DebugCommand, Edit, Executor, JobCommand};
use crate::params::Method;
use crate::photo::Masks;
use crate::raster::{HypothesisId, Raster};
use crate::trace::Replay;
use crate::trace::{CandidateSource, MergeTried, Trace, WindowClassified};
use crate::trace::{Event, Stage, Step, Topic};
use crate::view::{
    Instant, InstantView, Meaning, RegionsView, Status, candidate_pixels, cursor_place, cursor_shapes,
    growth_pixels, hypothesis_rows, measured_and_ignored, pixels_of_region, step_pixels, test_at_cursor,
    window_counts,
};
use crate::view::{Layer, Look, Origin, Role};
use crate::view::{paint, paint_instant};
use std::sync::Arc;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

fn application() -> Application {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    application
}

fn trace(application: &Application) -> Arc<Trace> {
    Arc::clone(application.state().debugger.trace().unwrap())
}

fn seek(application: &mut Application, n: usize) {
    application.apply(Command::Debug(DebugCommand::Seek(n)));
}

fn colors(application: &Application) -> &Raster<[f32; 3]> {
    &application.state().picture.as_ref().unwrap().photo.image.pixels
}

fn masks(application: &Application) -> &Masks {
    &application.state().newest.as_ref().unwrap().analysis.masks
}

fn instant(application: &Application) -> Instant {
    let (state, replay) = (application.state(), application.state().followed().unwrap());
    let working = &state.newest.as_ref().unwrap().analysis.working;
    Instant::of(replay, &state.debugger.names, state.debugger.chosen, working)
}

fn regions(instant: Instant) -> RegionsView {
    match instant.view {
        InstantView::Regions(regions) => regions,
        other => panic!("regions are shown: {other:?}"),
    }
}

fn events<'a>(trace: &'a Trace, wanted: impl Fn(&Event) -> bool + 'a) -> impl Iterator<Item = usize> + 'a {
    trace.events().filter(move |(_, event)| wanted(event)).map(|(n, _)| n + 1)
}

#[test]
fn the_cursor_is_followed_before_the_end_if_the_setting_is_on() {
    let mut application = application();
    assert!(application.state().followed().is_none(), "at the end the result is shown");
    seek(&mut application, 10);
    assert_eq!(application.state().followed().map(Replay::at), Some(10));
    let settings = crate::app::DebugSettings { follow: false, ..application.state().view.debug.clone() };
    application.apply(Command::Debug(DebugCommand::Settings(settings)));
    assert!(application.state().followed().is_none());
}

#[test]
fn after_the_linear_stage_the_instant_is_the_linear_layer() {
    let mut application = application();
    let end = trace(&application).steps_of(Stage::Linear).end;
    seek(&mut application, end);
    let view = regions(RegionsView::unfocused(instant(&application)));
    let shown = Arc::clone(application.state().newest.as_ref().unwrap());
    assert_eq!(&view.labels, shown.linear_labels());
    let picture = application.state().picture.as_ref().unwrap();
    let look = Look { opacity: 1.0, ..Look::default() };
    let layer = paint(Layer::Linear, picture, Some(&shown), None, &look);
    let (width, height) = picture.size();
    let view = Instant { view: InstantView::Regions(view), pixel: None, window: None };
    let painted = paint_instant(&view, width, height, &look);
    let mut compared = 0;
    for (pixel, (now, then)) in painted.as_slice().iter().zip(layer.as_slice()).enumerate() {
        let hypothesis = HypothesisId::from_label(shown.linear_labels()[pixel]);
        if hypothesis.and_then(|id| application.state().debugger.names.region_of(id)).is_some() {
            assert_eq!(now, then, "pixel {pixel}");
            compared += 1;
        }
    }
    assert!(compared > 1000);
}

impl RegionsView {
    /// Without what only the step at the cursor adds.
    fn unfocused(mut instant: Instant) -> Instant {
        if let InstantView::Regions(view) = &mut instant.view {
            (view.focus, view.newest, view.beside) = (None, Vec::new(), Vec::new());
        }
        instant
    }
}

#[test]
fn windows_appear_one_by_one_and_a_pair_that_is_joined_is_one() {
    let mut application = application();
    let trace = trace(&application);
    seek(&mut application, 0);
    assert_eq!(instant(&application).view, InstantView::Nothing);
    let classified: Vec<usize> =
        events(&trace, |event| matches!(event, Event::WindowClassified(_))).collect();
    seek(&mut application, classified[4]);
    let five = instant(&application);
    let InstantView::Windows(windows) = &five.view else { panic!("{five:?}") };
    let last = match trace.event(classified[4] - 1) {
        Some(Event::WindowClassified(WindowClassified { window, .. })) => *window as usize,
        other => panic!("a window is classified: {other:?}"),
    };
    let [left, top] = [last % windows.columns, last / windows.columns].map(|k| k * windows.size_px);
    assert_eq!(five.window, Some([left, top, windows.size_px]));
    assert!(windows.classes[last + 1..].iter().all(Option::is_none));
    let counts = window_counts(application.state().followed().unwrap()).unwrap();
    assert_eq!(counts.classes.iter().sum::<usize>() + counts.unclassed, 5);
    assert_eq!(5 + counts.empty + counts.waiting, counts.windows);
    assert_eq!(counts.waiting, counts.windows - last - 1);
    let joined =
        |event: &Event| matches!(event, Event::MergeTried(MergeTried { class, union, .. }) if class == union);
    let refused =
        |event: &Event| matches!(event, Event::MergeTried(MergeTried { class, union, .. }) if class != union);
    for (n, parts) in [(events(&trace, joined).next(), 1), (events(&trace, refused).next(), 2)] {
        seek(&mut application, n.unwrap());
        let InstantView::Windows(windows) = instant(&application).view else { panic!("windows at {n:?}") };
        assert_eq!(windows.tried.len(), parts);
    }
}

#[test]
fn claimed_pixels_lie_inside_the_bounds_and_refused_pixels_outside() {
    let mut application = application();
    let trace = trace(&application);
    let grows = |topic: Topic| matches!(topic, Topic::Hypothesis(_) | Topic::Slice(_));
    let mut outside = 0;
    for block in trace.blocks().filter(|block| grows(block.topic) && block.steps.len() > 60) {
        seek(&mut application, block.steps.start + block.steps.len() * 3 / 5);
        let replay = application.state().followed().unwrap();
        let growth = growth_pixels(replay, colors(&application), masks(&application)).unwrap();
        let hypothesis = block.topic.hypothesis();
        assert_eq!(growth.hypothesis, hypothesis);
        let is_of_hypothesis = |pixel: &u32| replay.labels()[*pixel as usize] == hypothesis.get();
        assert!(growth.claimed.iter().chain(&growth.newest).all(is_of_hypothesis));
        assert!(!growth.outside.iter().chain(&growth.kept_out).any(is_of_hypothesis));
        if let (Topic::Hypothesis(_), Some(known)) = (block.topic, replay.hypothesis(hypothesis)) {
            let away = |pixel: u32| {
                let color = crate::color::vec3(colors(&application)[pixel as usize]);
                known.line().unwrap().distance(&color)
            };
            assert!(growth.outside.iter().all(|&pixel| away(pixel) > known.radius - 1e-3));
        }
        outside += growth.outside.len();
        let shown = regions(instant(&application));
        assert_eq!((shown.focus, shown.newest.len()), (Some(hypothesis), growth.newest.len()));
    }
    assert!(outside > 0);
}

#[test]
fn the_newest_ring_is_reached_from_the_one_before() {
    let mut application = application();
    let trace = trace(&application);
    let block = trace.blocks().find(|block| matches!(block.topic, Topic::Hypothesis(_))).unwrap();
    let mut rings = 0;
    let mut before: Vec<u32> = Vec::new();
    let began = trace
        .steps_in(block.steps.clone())
        .find(|(_, step)| matches!(step, Step::Event(Event::GrowthBegan(_))))
        .map(|(n, _)| n)
        .unwrap();
    // All of the first growth: the first ring alone may take hundreds of pixels.
    let mut later = trace.steps_in(began + 1..block.steps.end);
    let end = later.find(|(_, step)| matches!(step, Step::Event(_))).map_or(block.steps.end, |(n, _)| n);
    for n in began + 2..end {
        seek(&mut application, n);
        let newest =
            growth_pixels(application.state().followed().unwrap(), colors(&application), masks(&application))
                .unwrap()
                .newest;
        if newest.len() <= before.len() && !before.is_empty() && newest.first() != before.first() {
            rings += 1;
            assert_eq!(newest.len(), 1, "a ring begins with a single pixel");
        }
        before = newest;
    }
    assert!(rings > 0);
}

#[test]
fn a_test_is_about_both_clusters_and_the_ignored_pixels() {
    let mut application = application();
    let trace = trace(&application);
    let accepted = |event: &Event| matches!(event, Event::CandidateTested(test) if test.verdict.accepted());
    let n = events(&trace, accepted).next().expect("the scene has highlights");
    seek(&mut application, n);
    let replay = application.state().followed().unwrap();
    let test = test_at_cursor(replay).unwrap();
    let own = pixels_of_region(replay, test.hypothesis);
    let (measured, ignored) = measured_and_ignored(test, &own, colors(&application));
    assert_eq!(measured.len() + ignored.len(), own.len());
    let along =
        |pixel: &u32| crate::color::vec3(colors(&application)[*pixel as usize]).dot(&test.matte.direction);
    let longer = measured.iter().filter(|pixel| along(pixel) > test.matte_length + 1.0).count();
    assert!(longer * 100 <= measured.len(), "the matte line ends where its brightest pixels do");
    let groups = step_pixels(replay, None, colors(&application), masks(&application), 50);
    assert!(groups.iter().all(|(_, pixels)| pixels.len() <= 50));
    assert!(groups.iter().any(|(role, _)| *role == Role::Meaning(Meaning::Taken)));
    if !matches!(test.candidate, CandidateSource::Absorbed(_)) {
        assert!(groups.iter().any(|(role, _)| *role == Role::Meaning(Meaning::Candidate)));
        assert_eq!(candidate_pixels(replay, test, masks(&application)).len(), test.pixels as usize);
    }
    let chosen = |event: &Event| matches!(event, Event::CandidateChosen(_));
    let n = events(&trace, chosen).next().unwrap();
    seek(&mut application, n);
    assert!(test_at_cursor(application.state().followed().unwrap()).unwrap().verdict.accepted());
}

#[test]
fn rows_show_the_status_of_each_hypothesis_at_the_cursor() {
    let mut application = application();
    let trace = trace(&application);
    let block =
        trace.blocks().find(|block| block.topic == Topic::Hypothesis(HypothesisId::from_index(1))).unwrap();
    seek(&mut application, block.steps.end - 1);
    let (state, replay) = (application.state(), application.state().followed().unwrap());
    let rows = hypothesis_rows(replay, &state.debugger.names);
    assert_eq!(rows.iter().map(|row| row.hypothesis.get()).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(rows[1].status, Status::AtWork);
    assert_eq!(rows[1].pixels, replay.size(HypothesisId::from_index(1)));
    let length: f64 = rows[0].direction.unwrap().iter().map(|v| v * v).sum();
    assert!((length - 1.0).abs() < 1e-9 && rows[0].radius > 0.0);
    let words = [
        (Status::AtWork, "growing now"),
        (Status::Stands, "complete"),
        (Status::Absorbed(HypothesisId::from_index(2)), "absorbed by 3"),
        (Status::Merged(HypothesisId::from_index(3)), "merged into 4"),
        (Status::Barren, "barren"),
        (Status::Dropped, "dropped"),
    ];
    for (status, text) in words {
        assert_eq!(status.text(), text);
    }
    let last = trace.len() - 1;
    seek(&mut application, last);
    let (state, replay) = (application.state(), application.state().followed().unwrap());
    for row in hypothesis_rows(replay, &state.debugger.names) {
        let over = !matches!(row.status, Status::Stands | Status::AtWork);
        assert!(over || row.region.is_some(), "what stands to the end has a number: {row:?}");
    }
}

#[test]
fn the_place_of_the_cursor_is_named() {
    let mut application = application();
    let trace = trace(&application);
    seek(&mut application, 0);
    assert_eq!(cursor_place(application.state().followed().unwrap()), "before the first step");
    let block =
        trace.blocks().find(|block| block.topic == Topic::Hypothesis(HypothesisId::from_index(1))).unwrap();
    seek(&mut application, block.steps.start + 1);
    assert_eq!(cursor_place(application.state().followed().unwrap()), "linear \u{b7} hypothesis 2");
    seek(&mut application, trace.steps_of(Stage::Merge).start + 1);
    assert_eq!(cursor_place(application.state().followed().unwrap()), "merge");
}

#[test]
fn the_average_of_the_paper_shows_each_highlight_direction_and_the_light() {
    let mut application = application();
    application.apply(Edit::SetMethod(Method::Paper));
    let trace = trace(&application);
    let n = events(&trace, |event| matches!(event, Event::HighlightsAveraged(_))).next().unwrap();
    let Some(Event::HighlightsAveraged(averaged)) = trace.event(n - 1) else { panic!("the event") };
    seek(&mut application, n);
    let shown = Arc::clone(application.state().newest.as_ref().unwrap());
    let shapes = cursor_shapes(application.state().followed().unwrap(), None, &shown);
    let of = |(hypothesis, _): &(HypothesisId, _)| *hypothesis;
    let expected: Vec<HypothesisId> = averaged.contributions.iter().map(|one| one.hypothesis).collect();
    assert_eq!(shapes.averaged.iter().map(of).collect::<Vec<_>>(), expected);
    assert!(shapes.light.is_some() && expected.len() > 1);
    seek(&mut application, n + 1);
    let after = cursor_shapes(application.state().followed().unwrap(), None, &shown);
    assert!(after.averaged.is_empty() && after.light == shapes.light);
}
