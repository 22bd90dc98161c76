//! Hand-made traces of tiny pictures, in which every number is known.

use super::*;
use crate::color::{Line, Vec3};
use crate::photo::MaskLimits;
use crate::raster::{PixelIndex, Raster};
use crate::reflection::{Components, DichromaticPlane, Slice, SliceBound};
use crate::trace::{
    FitFigures, FitLimits, GrowthBegan, HypothesisChosen, HypothesisPassedOver, LineRefitted, MasksMade,
    Measure, Pass, PassBegan, PixelKind, Recorder, Renumbered, SeedsPlaced, SliceMade, StageBegan,
    TraceRecorder, VectorsFitted, WindowsLaid,
};
use std::sync::Arc;

const LIMITS: MaskLimits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 1 };
const RADIUS: f64 = 10.0;

/// A row of pixels, and its trace.
struct Strip {
    image: LinearImage,
    masks: Masks,
    stage_traces: Vec<Arc<super::super::StageTrace>>,
}

impl Strip {
    fn new(colors: &[[f32; 3]]) -> Self {
        let image =
            LinearImage::new(Raster::from_vec(colors.len(), 1, colors.to_vec()).unwrap(), Some(255.0));
        let masks = Masks::new(&image, &LIMITS);
        let strip = Self { masks, image, stage_traces: Vec::new() };
        let made = MasksMade { limits: LIMITS, dark: 0, distorted: 0, sigma: None };
        strip.stage(Stage::Masks, |recorder| recorder.record(made.clone())).stage(
            Stage::Classify,
            |recorder| {
                recorder.record(WindowsLaid {
                    size_px: 2,
                    columns: colors.len().div_ceil(2) as u32,
                    rows: 1,
                    least_pixels: 2,
                    camera_noise: 2.5,
                    tail_test: true,
                });
            },
        )
    }

    fn stage(mut self, stage: Stage, record: impl FnOnce(&mut TraceRecorder)) -> Self {
        let mut recorder = TraceRecorder::default();
        recorder.record(StageBegan { stage });
        record(&mut recorder);
        self.stage_traces.extend(recorder.finish(stage).map(Arc::new));
        self
    }

    /// What happened to a pixel after the masks were made.
    fn history(&self, pixel: usize) -> Vec<HistoryKind> {
        let trace = Trace::new(self.image.width(), 1, self.stage_traces.clone());
        let history = pixel_history(&trace, &self.image, &self.masks, PixelIndex::from_index(pixel));
        assert!(history.is_sorted_by_key(|entry| entry.step));
        for entry in &history {
            assert_eq!(trace.stage_at(entry.step), Some(entry.stage), "{entry:?}");
        }
        let what = history.into_iter().map(|entry| entry.what);
        what.filter(|what| !matches!(what, HistoryKind::Masked(_))).collect()
    }
}

fn hypothesis(number: u16) -> HypothesisId {
    HypothesisId::from_label(number).unwrap()
}

/// Records a claim; 0 is no hypothesis.
fn claim(recorder: &mut TraceRecorder, pixel: u32, before: u16, after: u16) {
    let [before, after] = [before, after].map(HypothesisId::from_label);
    recorder.claim(PixelIndex::new(pixel), before, after);
}

fn red() -> Line {
    Line::new(Vec3::x() * 100.0, Vec3::x())
}

fn chosen(recorder: &mut TraceRecorder, number: u16, line: Line) {
    let hypothesis = hypothesis(number);
    let chosen = HypothesisChosen { hypothesis, area: 99, rank: 0, pixels: 4, line, radius: RADIUS };
    recorder.record(chosen);
}

fn grows(recorder: &mut TraceRecorder, number: u16, claims: &[(u32, u16)]) {
    recorder.record(GrowthBegan { hypothesis: hypothesis(number), limit: RADIUS as f32 });
    for &(pixel, before) in claims {
        claim(recorder, pixel, before, number);
    }
}

#[test]
fn a_pixel_beside_a_cylinder_is_refused_by_its_distance_from_the_axis() {
    let strip = Strip::new(&[[100.0, 0.0, 0.0], [120.0, 3.0, 4.0], [120.0, 0.0, 12.4], [90.0, 0.0, 0.0]]);
    let strip = strip.stage(Stage::Linear, |recorder| {
        chosen(recorder, 1, red());
        recorder.record(SeedsPlaced { hypothesis: hypothesis(1), pixels: 1 });
        claim(recorder, 0, 0, 1);
        grows(recorder, 1, &[(1, 0)]);
    });
    let seeded = HistoryKind::Seeded {
        hypothesis: hypothesis(1),
        reach: Reach::Axis { distance: 0.0, radius: RADIUS },
    };
    assert_eq!(strip.history(0), [seeded]);
    let reach = Reach::Axis { distance: 5.0, radius: RADIUS };
    assert_eq!(
        strip.history(1),
        [HistoryKind::Claimed {
            hypothesis: hypothesis(1),
            from: HypothesisId::from_label(0),
            reach,
            contest: None
        }]
    );
    let barrier = Barrier::Cylinder { distance: 12.4, radius: RADIUS };
    assert_eq!(strip.history(2), [HistoryKind::Refused { hypothesis: hypothesis(1), barrier }]);
    // Growth never came here.
    assert_eq!(strip.history(3), []);
}

#[test]
fn dark_and_clipped_pixels_wait_and_the_regions_beside_them_are_listed_once() {
    let strip = Strip::new(&[[100.0, 0.0, 0.0], [9.0, 0.0, 0.0], [100.0, 0.0, 0.0]]);
    let strip = strip.stage(Stage::Linear, |recorder| {
        for (number, seed) in [(1, 0), (2, 2)] {
            let hypothesis = hypothesis(number);
            chosen(recorder, number, red());
            recorder.record(SeedsPlaced { hypothesis, pixels: 1 });
            claim(recorder, seed, 0, number);
            grows(recorder, number, &[]);
            recorder.record(LineRefitted { hypothesis, line: red() });
            grows(recorder, number, &[]);
        }
    });
    assert_eq!(
        strip.history(1),
        [HistoryKind::Unclaimable { hypotheses: vec![hypothesis(1), hypothesis(2)] }]
    );
    let trace = Trace::new(3, 1, strip.stage_traces.clone());
    let first = &pixel_history(&trace, &strip.image, &strip.masks, PixelIndex::new(1))[0];
    let brightness = [9.0, LIMITS.min_intensity];
    assert_eq!(first.what, HistoryKind::Masked(MaskVerdict::Dark { brightness }));
}

#[test]
fn conflicts_carry_both_distances_and_a_refit_lets_go() {
    let strip = Strip::new(&[[100.0, 0.0, 0.0], [100.0, 6.0, 0.0], [100.0, 9.0, 0.0]]);
    let shifted = Line::new(Vec3::new(100.0, 9.0, 0.0), Vec3::x());
    let away = Line::new(Vec3::new(100.0, -30.0, 0.0), Vec3::x());
    let lost = Contest { measure: Measure::Axis, challenger: 6.0, holder: 3.0 };
    let won = Contest { measure: Measure::Axis, challenger: 0.0, holder: 6.0 };
    let strip = strip.stage(Stage::Linear, |recorder| {
        chosen(recorder, 1, red());
        recorder.record(SeedsPlaced { hypothesis: hypothesis(1), pixels: 1 });
        claim(recorder, 0, 0, 1);
        grows(recorder, 1, &[(1, 0)]);
        chosen(recorder, 2, shifted);
        recorder.record(SeedsPlaced { hypothesis: hypothesis(2), pixels: 1 });
        claim(recorder, 2, 0, 2);
        recorder.record(GrowthBegan { hypothesis: hypothesis(2), limit: RADIUS as f32 });
        // The same refusal from two sides is one.
        recorder.contest(PixelIndex::new(1), hypothesis(1), hypothesis(2), false, lost);
        recorder.contest(PixelIndex::new(1), hypothesis(1), hypothesis(2), false, lost);
        chosen(recorder, 3, Line::new(Vec3::new(100.0, 6.0, 0.0), Vec3::x()));
        recorder.record(GrowthBegan { hypothesis: hypothesis(3), limit: RADIUS as f32 });
        recorder.contest(PixelIndex::new(1), hypothesis(1), hypothesis(3), true, won);
        claim(recorder, 1, 1, 3);
        recorder.record(LineRefitted { hypothesis: hypothesis(3), line: away });
        claim(recorder, 1, 3, 0);
    });
    let own = Reach::Axis { distance: 6.0, radius: RADIUS };
    let third = Reach::Axis { distance: 0.0, radius: RADIUS };
    assert_eq!(
        strip.history(1),
        [
            HistoryKind::Claimed {
                hypothesis: hypothesis(1),
                from: HypothesisId::from_label(0),
                reach: own,
                contest: None
            },
            HistoryKind::Kept { holder: hypothesis(1), challenger: hypothesis(2), contest: lost },
            HistoryKind::Claimed {
                hypothesis: hypothesis(3),
                from: HypothesisId::from_label(1),
                reach: third,
                contest: Some(won)
            },
            HistoryKind::Released {
                hypothesis: hypothesis(3),
                why: Release::Refit { distance: 36.0, radius: RADIUS }
            },
        ]
    );
}

#[test]
fn a_slice_says_on_which_side_a_pixel_lies_and_growth_for_nothing_is_given_back() {
    let strip = Strip::new(&[[100.0, 0.0, 0.0], [100.0, 50.0, 13.0], [30.0, 0.0, 0.0]]);
    let plane = DichromaticPlane::new(&red(), &Vec3::y()).unwrap();
    let strip = strip
        .stage(Stage::Linear, |recorder| {
            chosen(recorder, 1, red());
            recorder.record(SeedsPlaced { hypothesis: hypothesis(1), pixels: 2 });
            claim(recorder, 0, 0, 1);
            chosen(recorder, 2, red());
            recorder.record(SeedsPlaced { hypothesis: hypothesis(2), pixels: 1 });
            claim(recorder, 2, 0, 2);
            recorder.record(GrowthBegan { hypothesis: hypothesis(2), limit: RADIUS as f32 });
            claim(recorder, 2, 2, 0);
            let (area, reason) = (99, PassedOver::Barren);
            recorder.record(HypothesisPassedOver { area, pixels: 4, least: 72, reason });
        })
        .stage(Stage::Planar, |recorder| {
            recorder.record(PassBegan { pass: Pass::Slices });
            recorder.record(SliceMade {
                hypothesis: hypothesis(1),
                plane,
                matte_length: 120.0,
                start: Vec3::x() * 90.0,
                half_width: 8.0,
                slice: Slice::bounded(&plane, 8.0, RADIUS, 120.0),
            });
            recorder.record(GrowthBegan { hypothesis: hypothesis(1), limit: 8.0 });
        });
    let miss = SliceMiss { bound: SliceBound::Height, value: 13.0, limit: 8.0 };
    let past = strip.history(1);
    assert_eq!(
        past.last(),
        Some(&HistoryKind::Refused { hypothesis: hypothesis(1), barrier: Barrier::Slice(miss) })
    );
    let barren =
        HistoryKind::Released { hypothesis: hypothesis(2), why: Release::Barren { pixels: 4, least: 72 } };
    assert_eq!(strip.history(2).last(), Some(&barren));
}

#[test]
fn the_end_is_a_number_a_role_and_amounts() {
    let strip = Strip::new(&[[100.0, 20.0, 3.0], [100.0, 1.0, 0.0]]);
    let strip = strip
        .stage(Stage::Linear, |recorder| {
            chosen(recorder, 1, red());
            recorder.record(SeedsPlaced { hypothesis: hypothesis(1), pixels: 2 });
            claim(recorder, 0, 0, 1);
            claim(recorder, 1, 0, 1);
        })
        .stage(Stage::Clipping, |recorder| {
            recorder.record(Renumbered { regions: [RegionId::from_label(1)].into() });
        })
        .stage(Stage::Split, |recorder| {
            recorder.record(VectorsFitted {
                region: RegionId::from_index(0),
                body: Vec3::x(),
                surface: Some(Vec3::y()),
                matte: red(),
                start: Vec3::x() * 97.0,
                starts: vec![Vec3::x() * 97.0],
                highlight: Some(Vec3::y()),
                least_offset: 2.5,
                figures: FitFigures { rms_counts: 1.0, ..FitFigures::default() },
                limits: FitLimits::default(),
                model_fits: true,
                is_judged: true,
                origin: [0.0; 3],
                unsplit: false,
                noise_line: None,
            });
            let kinds = vec![PixelKind::Highlight, PixelKind::Matte];
            recorder.labels(&Raster::from_vec(2, 1, kinds).unwrap());
        });
    let split = |pixel| match strip.history(pixel).pop() {
        Some(HistoryKind::Split(story)) => *story,
        other => panic!("{other:?}"),
    };
    let highlight = split(0);
    assert_eq!((highlight.region.get(), highlight.kind), (1, PixelKind::Highlight));
    let [matte, on_highlight] = highlight.lines.unwrap();
    assert!((matte - 409f32.sqrt()).abs() < 1e-3 && (on_highlight - 18f32.sqrt()).abs() < 1e-3);
    let amounts = Components { body: 100.0, surface: 20.0, noise: 3.0 };
    assert_eq!((highlight.amounts, highlight.cut), (Some(amounts), None));
    // One count off the body line is noise, not surface reflection.
    let matte = split(1);
    assert_eq!((matte.amounts.map(|a| a.surface), matte.cut), (Some(0.0), Some(1.0)));
    assert_eq!(
        strip.history(0)[1],
        HistoryKind::Numbered { hypothesis: hypothesis(1), region: RegionId::from_label(1) }
    );
}

#[test]
fn nothing_is_told_of_what_is_not_there() {
    let strip = Strip::new(&[[100.0, 0.0, 0.0]]);
    assert_eq!(strip.history(1), []);
    let trace = Trace::new(2, 2, strip.stage_traces.clone());
    assert_eq!(
        pixel_history(&trace, &strip.image, &strip.masks, PixelIndex::new(0)),
        [],
        "of another picture"
    );
    let empty = LinearImage::new(Raster::filled(0, 0, [0.0; 3]), None);
    let trace = Trace::new(0, 0, Vec::new());
    assert_eq!(pixel_history(&trace, &empty, &Masks::new(&empty, &LIMITS), PixelIndex::new(0)), []);
}
