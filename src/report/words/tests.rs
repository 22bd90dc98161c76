//! Sentences say value against threshold.

use super::*;
use crate::reflection::{SliceBound, SliceMiss};
use crate::trace::{
    Barrier, CandidateSource, Event, Happening, MaskVerdict, PassedOver, PixelKind, Reach, Release, Stage,
    What,
};

fn names() -> Names {
    Names { width: 10, finals: vec![2, 0, 1] }
}

fn say(what: What) -> String {
    names().happening(&Happening { step: 0, stage: Stage::Linear, what })
}

#[test]
fn a_region_has_the_number_of_its_birth_and_in_the_result_another() {
    assert_eq!(names().region(1), "hypothesis 1 (region 2)");
    assert_eq!(names().region(2), "hypothesis 2");
    assert_eq!(names().region(9), "hypothesis 9");
    assert_eq!(names().region(0), "hypothesis 0");
    assert_eq!(names().regions(&[1, 2, 3]), "hypotheses 1, 2 and 3");
    assert_eq!(names().regions(&[3]), "hypothesis 3 (region 1)");
    assert_eq!(names().pixel(23), "(3, 2)");
}

#[test]
fn refusals_say_how_far_outside() {
    let refused = |barrier| say(What::Refused { region: 1, barrier });
    let who = "hypothesis 1 (region 2) grows beside it and refuses it: ";
    let cylinder = Barrier::Cylinder { distance: 12.43, radius: 10.0 };
    assert_eq!(refused(cylinder), format!("{who}12.4 counts from its axis, radius 10.0"));
    let slice = |bound, value, limit| refused(Barrier::Slice(SliceMiss { bound, value, limit }));
    assert_eq!(
        slice(SliceBound::Height, 11.0, 10.0),
        format!("{who}11.0 counts from its plane, half width 10.0")
    );
    assert_eq!(
        slice(SliceBound::Surface, -9.5, -8.0),
        format!("{who}9.5 counts beyond the matte line, away from the light; 8.0 are allowed")
    );
    assert_eq!(
        slice(SliceBound::MatteEnd, 212.0, 190.0),
        format!("{who}body reflection 212.0 counts, past the end of the matte line at 190.0")
    );
}

#[test]
fn claims_conflicts_and_releases_carry_both_numbers() {
    let reach = Reach::Axis { distance: 3.25, radius: 10.0 };
    let contest = Some(Contest { measure: Measure::Axis, challenger: 3.25, holder: 6.5 });
    assert_eq!(
        say(What::Claimed { region: 3, from: 2, reach, contest }),
        "hypothesis 3 (region 1) takes it from hypothesis 2: 3.2 counts from its axis against 6.5, radius 10.0"
    );
    let contest = Contest { measure: Measure::Plane, challenger: 6.0, holder: 2.0 };
    assert_eq!(
        say(What::Kept { holder: 3, challenger: 2, contest }),
        "hypothesis 3 (region 1) keeps it: 2.0 counts from its plane, 6.0 from that of hypothesis 2"
    );
    assert_eq!(
        say(What::Released { region: 2, why: Release::Refit { distance: 11.0, radius: 10.0 } }),
        "hypothesis 2 gives it up: 11.0 counts from its refitted axis, radius 10.0"
    );
    assert_eq!(
        say(What::AreaPassedOver { pixels: 320, least: 500, reason: PassedOver::TooSmall }),
        "its area starts no hypothesis: 320 unclaimed pixels, it needs 500"
    );
    assert_eq!(
        say(What::Masked(MaskVerdict::Clipped { largest: [251.0, 240.0] })),
        "clipped: largest band 251.0 counts, threshold 240.0"
    );
}

#[test]
fn a_failed_skewed_t_names_the_test_and_its_limit() {
    use crate::color::{Line, Vec3};
    use crate::trace::{CandidateTest, CandidateVerdict};
    let line = Line::new(Vec3::x() * 50.0, Vec3::x());
    let test = CandidateTest {
        region: 1,
        candidate: CandidateSource::Region(3),
        pixels: 120,
        matte: line,
        matte_length: 160.0,
        line,
        meeting: [Vec3::zeros(); 2],
        gap: [12.0, 8.0],
        position_percent: 31.0,
        position_limits: [50.0, 115.0],
        verdict: CandidateVerdict { lines_meet: false, upper_half: false, positive: true, beyond: true },
        weight: 0.0,
    };
    let said = names().event(&Event::CandidateTested(Box::new(test)));
    assert!(said.contains("no skewed T: 12.0 counts apart, at most 8.0"), "{said}");
    assert!(said.contains("not in the upper half: at 31 %, 50 to 115 % are allowed"), "{said}");
}

#[test]
fn rounds_of_one_stage_are_one_line_in_which_the_last_stands_for_all() {
    let refused = |step, stage, region, distance| Happening {
        step,
        stage,
        what: What::Refused { region, barrier: Barrier::Cylinder { distance, radius: 8.0 } },
    };
    let happened = |step, what| Happening { step, stage: Stage::Planar, what };
    let reach = Reach::Plane { distance: 1.0, half_width: 8.0 };
    let taken = |step| happened(step, What::Claimed { region: 1, from: 0, reach, contest: None });
    let history = [
        refused(1, Stage::Linear, 1, 9.0),
        refused(2, Stage::Linear, 2, 12.0),
        refused(3, Stage::Linear, 1, 8.5),
        refused(4, Stage::Planar, 2, 8.4),
        taken(5),
        happened(6, What::Reset { from: 1, to: 0 }),
        taken(7),
        happened(8, What::Numbered { region: 1, number: 1 }),
    ];
    let told: Vec<(usize, usize)> =
        condense(&history).into_iter().map(|line| (line.last.step, line.times)).collect();
    assert_eq!(told, [(2, 1), (3, 2), (4, 1), (6, 1), (7, 2), (8, 1)]);
}

#[test]
fn every_step_is_a_sentence() {
    let contest = Contest { measure: Measure::Vote, challenger: 14.0, holder: 20.0 };
    let steps = [
        (
            Step::Claim { pixel: 23, before: 0, after: 1, contest: None },
            "hypothesis 1 (region 2) takes pixel (3, 2)",
        ),
        (Step::Claim { pixel: 23, before: 2, after: 0, contest: None }, "hypothesis 2 gives up pixel (3, 2)"),
        (
            Step::Claim { pixel: 23, before: 2, after: 1, contest: Some(contest) },
            "hypothesis 1 (region 2) takes pixel (3, 2) from hypothesis 2: it has 14 of the 20 assigned pixels around it",
        ),
        (Step::Label { pixel: 23, kind: PixelKind::Matte }, "pixel (3, 2) is matte"),
        (
            Step::Event(&Event::Dropped { region: 2, pixels: 1 }),
            "hypothesis 2 is dropped, too small: 1 pixel",
        ),
    ];
    for (step, sentence) in steps {
        assert_eq!(names().step(&step), sentence);
    }
}
