//! Sentences say value against threshold.

use super::*;
use crate::raster::{Blocks, PixelIndex, RegionId};
use crate::reflection::{SliceBound, SliceMiss};
use crate::segment::{PixelPlace, PlaceRule};
use crate::trace::{
    Barrier, CandidateSource, Dropped, Event, HistoryEntry, HistoryKind, MaskVerdict, Measured, PassedOver,
    PixelKind, Reach, Release, Stage,
};

fn names() -> Names {
    Names {
        pixel_blocks: Blocks::new(1, 10, 10),
        regions: [2, 0, 1].map(RegionId::from_label).to_vec(),
        ..Names::default()
    }
}

fn hypothesis(number: u16) -> HypothesisId {
    HypothesisId::from_label(number).unwrap()
}

const PIXEL: PixelIndex = PixelIndex::new(23);

fn say(what: HistoryKind) -> String {
    names().history_entry(&HistoryEntry { step: 0, stage: Stage::Linear, what })
}

#[test]
fn a_region_has_the_number_of_its_birth_and_in_the_result_another() {
    assert_eq!(names().hypothesis(hypothesis(1)), "hypothesis 1 (region 2)");
    assert_eq!(names().hypothesis(hypothesis(2)), "hypothesis 2");
    assert_eq!(names().hypothesis(hypothesis(9)), "hypothesis 9");
    assert_eq!(names().hypotheses(&[1, 2, 3].map(hypothesis)), "hypotheses 1, 2 and 3");
    assert_eq!(names().hypotheses(&[hypothesis(3)]), "hypothesis 3 (region 1)");
    assert_eq!(names().pixel(PIXEL), "(3, 2)");
}

#[test]
fn refusals_say_how_far_outside() {
    let refused = |barrier| say(HistoryKind::Refused { hypothesis: hypothesis(1), barrier });
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
    let bands = Barrier::OtherBands { distance: 120.04, limit: 33.0 };
    assert_eq!(
        refused(bands),
        format!(
            "{who}its bands that do not clip are 120.0 counts from any body and surface reflection of it, at most 33.0"
        )
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
        say(HistoryKind::Claimed {
            hypothesis: hypothesis(3),
            from: HypothesisId::from_label(2),
            reach,
            contest
        }),
        "hypothesis 3 (region 1) takes it from hypothesis 2: 3.2 counts from its axis against 6.5, radius 10.0"
    );
    let contest = Contest { measure: Measure::Plane, challenger: 6.0, holder: 2.0 };
    assert_eq!(
        say(HistoryKind::Kept { holder: hypothesis(3), challenger: hypothesis(2), contest }),
        "hypothesis 3 (region 1) keeps it: 2.0 counts from its plane, 6.0 from that of hypothesis 2"
    );
    assert_eq!(
        say(HistoryKind::Released {
            hypothesis: hypothesis(2),
            why: Release::Refit { distance: 11.0, radius: 10.0 }
        }),
        "hypothesis 2 gives it up: 11.0 counts from its refitted axis, radius 10.0"
    );
    assert_eq!(
        say(HistoryKind::AreaPassedOver { pixels: 320, least: 500, reason: PassedOver::TooSmall }),
        "its area starts no hypothesis: 320 unclaimed pixels, it needs 500"
    );
    assert_eq!(
        say(HistoryKind::Masked(MaskVerdict::Clipped { largest: [251.0, 240.0] })),
        "clipped: largest band 251.0 counts, threshold 240.0"
    );
}

#[test]
fn a_failed_skewed_t_names_the_test_and_its_limit() {
    use crate::color::{Line, Vec3};
    use crate::trace::{CandidateTested, CandidateVerdict};
    let line = Line::new(Vec3::x() * 50.0, Vec3::x());
    let test = CandidateTested {
        hypothesis: hypothesis(1),
        candidate: CandidateSource::Hypothesis(hypothesis(3)),
        pixels: 120,
        matte: line,
        matte_length: 160.0,
        line,
        meeting: [Vec3::zeros(); 2],
        gap: Measured::new(12.0, 8.0),
        position_percent: 31.0,
        position_limits: [50.0, 115.0],
        angle_deg: Measured::new(40.0, 10.0),
        verdict: CandidateVerdict {
            lines_meet: false,
            upper_half: false,
            not_parallel: true,
            by_gershon: false,
            is_marked: false,
            positive: true,
            beyond: true,
        },
        weight: 0.0,
        with_distorted: false,
    };
    let said = names().event(&Event::CandidateTested(Box::new(test)));
    assert!(said.contains("no skewed T: 12.0 counts apart, at most 8.0"), "{said}");
    assert!(said.contains("not in the upper half: at 31 %, 50 to 115 % are allowed"), "{said}");
}

#[test]
fn rounds_of_one_stage_are_one_line_in_which_the_last_stands_for_all() {
    let refused = |step, stage, number, distance| HistoryEntry {
        step,
        stage,
        what: HistoryKind::Refused {
            hypothesis: hypothesis(number),
            barrier: Barrier::Cylinder { distance, radius: 8.0 },
        },
    };
    let happened = |step, what| HistoryEntry { step, stage: Stage::Planar, what };
    let reach = Reach::Plane { distance: 1.0, half_width: 8.0 };
    let taken = |step| {
        happened(
            step,
            HistoryKind::Claimed {
                hypothesis: hypothesis(1),
                from: HypothesisId::from_label(0),
                reach,
                contest: None,
            },
        )
    };
    let history = [
        refused(1, Stage::Linear, 1, 9.0),
        refused(2, Stage::Linear, 2, 12.0),
        refused(3, Stage::Linear, 1, 8.5),
        refused(4, Stage::Planar, 2, 8.4),
        taken(5),
        happened(6, HistoryKind::Reset { from: hypothesis(1), to: HypothesisId::from_label(0) }),
        taken(7),
        happened(8, HistoryKind::Numbered { hypothesis: hypothesis(1), region: RegionId::from_label(1) }),
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
            Step::Claim {
                pixel: PIXEL,
                before: HypothesisId::from_label(0),
                after: HypothesisId::from_label(1),
                contest: None,
            },
            "hypothesis 1 (region 2) takes pixel (3, 2)",
        ),
        (
            Step::Claim {
                pixel: PIXEL,
                before: HypothesisId::from_label(2),
                after: HypothesisId::from_label(0),
                contest: None,
            },
            "hypothesis 2 gives up pixel (3, 2)",
        ),
        (
            Step::Claim {
                pixel: PIXEL,
                before: HypothesisId::from_label(2),
                after: HypothesisId::from_label(1),
                contest: Some(contest),
            },
            "hypothesis 1 (region 2) takes pixel (3, 2) from hypothesis 2: it has 14 of the 20 assigned pixels around it",
        ),
        (Step::Label { pixel: PIXEL, kind: PixelKind::Matte }, "pixel (3, 2) is matte"),
        (
            Step::Event(&Event::Dropped(Dropped { hypothesis: hypothesis(2), pixels: 1 })),
            "hypothesis 2 is dropped, too small: 1 pixel",
        ),
    ];
    for (step, sentence) in steps {
        assert_eq!(names().step(&step), sentence);
    }
}

#[test]
fn every_verdict_on_a_blob_is_another_sentence_with_its_figures() {
    use crate::trace::{RepairTried, RepairVerdict};
    let tried = RepairTried {
        blob: 2,
        pixel: PIXEL,
        pixels: 12,
        ring: Measured::new(0.62, 0.4),
        inner: 40.0,
        outer: 20.0,
        spread: Measured::new(0.7, 0.5),
        around: Measured::new(5.0, 6.0),
        verdict: RepairVerdict::Filled,
    };
    let verdicts = [
        (
            RepairVerdict::Filled,
            "62 % of its ring of 2 px are highlight (at least 40 %), 40.0 counts next to it, 20.0",
        ),
        (RepairVerdict::TooLarge, "as large as a window"),
        (RepairVerdict::NoRing, "no ring of unclipped pixels"),
        (RepairVerdict::NoHighlight, "62 % of its ring of 2 px are highlight, at least 40 % are needed"),
        (RepairVerdict::Uneven, "varies by 70 % of its mean (at most 50 %)"),
        (RepairVerdict::TooSmall, "5 highlight pixels lie around it, at least 6 are needed"),
        (RepairVerdict::NoRise, "does not rise towards it, 40.0 counts"),
    ];
    for (verdict, part) in verdicts {
        let said = names().event(&Event::RepairTried(Box::new(RepairTried { verdict, ..tried })));
        assert!(
            said.starts_with("the blob of 12 clipped pixels at (3, 2) is ") && said.contains(part),
            "{said}"
        );
    }
}

#[test]
fn a_light_is_told_with_what_it_rests_on_and_why_the_other_one_is_not_used() {
    use crate::segment::LIGHT_LIMITS;
    use crate::trace::{LightBasis, LightChosen, LightOdds, VoteResult};
    let votes = VoteResult {
        direction: [0.6; 3],
        voters: 300,
        blobs: 9,
        share: 0.06,
        offsets_deg: [4.0, -1.0],
        body_share: 0.0,
    };
    let by_votes = LightChosen {
        basis: LightBasis::Votes,
        direction: Some([0.6; 3]),
        planes: Some(([0.5; 3], 4)),
        votes: Some(votes),
        support: 0.12,
        odds: Some(LightOdds { unusualness: 1.5, intervals: -0.25, shares: 0.1 }),
        limits: LIGHT_LIMITS,
    };
    let alone = LightChosen { odds: None, ..by_votes };
    let weak = Some(VoteResult { share: 0.005, ..votes });
    let odd = Some(VoteResult { offsets_deg: [-25.0, 1.0], ..votes });
    let of_body = Some(VoteResult { offsets_deg: [15.0, 1.0], body_share: 0.125, ..votes });
    let by_planes = LightChosen { basis: LightBasis::Planes, ..by_votes };
    let unknown = LightChosen { basis: LightBasis::Nothing, direction: None, ..alone };
    let told = [
        (
            by_votes,
            "that of the votes: the votes are the better evidence, by the color of both lights +1.50, by their intervals \u{2212}0.25",
        ),
        (by_votes, "log odds of +1.35 for the votes, more than 0.50 are needed; 300 pixels"),
        (
            by_votes,
            "6.0 % of the votes, 4.0\u{b0} to yellow and 1.0\u{b0} to green of white (at most 20\u{b0} and 8\u{b0})",
        ),
        (
            alone,
            "that of the votes: the planes give a light that no lamp has (farther from white than 40\u{b0} and 20\u{b0})",
        ),
        (by_planes, "that of the planes: the votes are not the better evidence"),
        (
            LightChosen { votes: None, odds: None, ..by_planes },
            "that of the planes: too few pixels of small highlights vote",
        ),
        (
            LightChosen { votes: weak, odds: None, ..by_planes },
            "0.5 % of their votes are for one light, at least 2.0 % are needed",
        ),
        (
            LightChosen { votes: of_body, odds: None, ..by_planes },
            "a light of the color of a body, 15.0\u{b0} to yellow and 1.0\u{b0} to magenta of white: 12.5 % of the lit pixels have that \
             color (at most 10.0 % farther than 9\u{b0} from white)",
        ),
        (LightChosen { votes: odd, odds: None, ..by_planes }, "an unusual light, 25.0\u{b0} to blue"),
        (
            LightChosen { votes: odd, ..unknown },
            "no light is known: the planes give a light that no lamp has",
        ),
        (
            LightChosen { votes: None, planes: None, ..unknown },
            "no light is known: no region shows a highlight, and too few",
        ),
    ];
    for (chosen, part) in told {
        let said = names().event(&Event::LightChosen(Box::new(chosen)));
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn the_pass_at_full_resolution_says_what_became_of_the_pixel_and_of_its_working_pixel() {
    let place = |working: u16, region: u16, rule| {
        let [working_region, region] = [working, region].map(RegionId::from_label);
        names().pixel_place(&PixelPlace { side: 3, working_region, region, rule }, false)
    };
    let inside = place(2, 2, PlaceRule::Inside);
    assert!(inside.starts_with("at full resolution the pixel takes region 2: "), "{inside}");
    assert!(inside.ends_with("the mean of 3 \u{d7} 3 pixels"), "{inside}");
    let border = place(2, 1, PlaceRule::Border);
    assert!(
        border.contains("takes region 1: its own color fits") && border.contains("is in region 2"),
        "{border}"
    );
    let none = place(2, 0, PlaceRule::Border);
    assert!(none.contains("is in no region: its own color fits no region around"), "{none}");
    let second_look = place(0, 2, PlaceRule::SecondLook { side: 2 });
    assert!(
        second_look.contains(
            "takes region 2: the second look found it in a picture with blocks of 2 \u{d7} 2 pixels"
        ),
        "{second_look}"
    );
    assert!(place(0, 0, PlaceRule::Dark).contains("it is not lit"));
    assert!(place(1, 1, PlaceRule::Distorted).contains("clipped or bloomed"));
}

#[test]
fn a_working_pixel_lies_where_the_middle_of_its_block_is() {
    let names = Names { pixel_blocks: Blocks::new(3, 10, 7), ..Names::default() };
    assert_eq!(names.pixel(PixelIndex::from_index(5)), "(4, 4)");
    assert_eq!(names.pixel(PixelIndex::from_index(3)), "(9, 1)", "the last block of a row has one column");
}
