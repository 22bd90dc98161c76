//! The three objects of the lines about what light is used, and about where the model does not hold.

use super::super::Names;
use super::short;
use crate::trace::{
    Ambient, LightChosen, LocalBegan, LocalDecision, LocalStart, PlausibilityTested, RejectReason,
    RepairTried, TwoLightTest, VoteResult, VotesCast,
};
use serde_json::{Value, json};

pub(super) fn votes(votes: &VotesCast) -> (Value, Value, Value) {
    (
        json!({}),
        json!({"elected": votes.elected.as_ref().map(elected)}),
        json!({"voters": votes.least_voters}),
    )
}

fn elected(elected: &VoteResult) -> Value {
    json!({
        "direction": elected.direction,
        "voters": elected.voters,
        "blobs": elected.blobs,
        "share": elected.share,
        "offsets_deg": elected.offsets_deg,
    })
}

pub(super) fn chosen(chosen: &LightChosen) -> (Value, Value, Value) {
    let limits = chosen.limits;
    let planes =
        chosen.planes.map(|(direction, objects)| json!({"direction": direction, "objects": objects}));
    (
        json!({}),
        json!({
            "basis": chosen.basis.name(),
            "direction": chosen.direction,
            "support": chosen.support,
            "planes": planes,
            "votes": chosen.votes.as_ref().map(elected),
        }),
        json!({
            "support": limits.support,
            "hardly_supported": limits.hardly,
            "share": limits.share,
            "offsets_deg": limits.offsets_deg,
        }),
    )
}

pub(super) fn local(names: &Names, decision: &LocalDecision) -> (Value, Value, Value) {
    match decision {
        LocalDecision::Began(started) => began(started),
        LocalDecision::Blobs { found, small, small_pixels, least } => (
            json!({}),
            json!({"found": found, "small": small, "small_pixels": small_pixels}),
            json!({"pixels": least}),
        ),
        LocalDecision::Blob(judged) => (
            json!({"blob": judged.blob, "pixel": place(names, judged.pixel)}),
            json!({
                "pixels": judged.pixels,
                "clipped": judged.clipped,
                "strong": judged.strong,
                "calm": judged.calm,
                "core": judged.core,
                "kept": judged.kept,
            }),
            json!({}),
        ),
        LocalDecision::Plausibility(tested) => plausibility(tested),
        LocalDecision::Repair(tried) => repair(names, tried),
    }
}

fn began(began: &LocalBegan) -> (Value, Value, Value) {
    let start = match began.start {
        LocalStart::Begins => "begins",
        LocalStart::Off => "off",
        LocalStart::Few => "few",
        LocalStart::NoLight => "no_light",
    };
    let limits = began.limits;
    (
        json!({}),
        json!({
            "start": start,
            "pixels": began.pixels,
            "lit": began.lit,
            "light": began.light,
            "origin": began.origin,
            "texture_test": began.texture_test,
            "hysteresis": began.hysteresis,
            "clip_repair": began.clip_repair,
        }),
        json!({
            "pixels": began.least,
            "mean": short(limits.mean),
            "chroma": short(limits.chroma),
            "texture": limits.texture.map(short),
            "core_texture": short(limits.core_texture),
        }),
    )
}

fn plausibility(tested: &PlausibilityTested) -> (Value, Value, Value) {
    let limits = tested.limits;
    (
        json!({}),
        json!({
            "share": tested.share,
            "surface": tested.surface,
            "outshining": tested.outshining.map(|(share, _)| share),
            "strong": tested.outshining.map(|(_, strong)| strong),
            "doubt": tested.reject_reason.map(RejectReason::name),
        }),
        json!({
            "share": limits.share,
            "surface": limits.surface,
            "outshining": limits.outshining,
        }),
    )
}

fn repair(names: &Names, tried: &RepairTried) -> (Value, Value, Value) {
    let ([share, least], [inner, outer]) = (tried.ring, tried.rise);
    (
        json!({"blob": tried.blob, "pixel": place(names, tried.pixel)}),
        json!({
            "pixels": tried.pixels,
            "ring": short(share),
            "inner": short(inner),
            "outer": short(outer),
            "verdict": tried.verdict.name(),
        }),
        json!({"ring": short(least)}),
    )
}

/// How well two lights explain the outshone pixels.
pub(super) fn outshone(outshone: TwoLightTest) -> Value {
    json!({
        "pixels": outshone.pixels,
        "by_all": outshone.by_all,
        "by_highlights": outshone.by_highlights,
        "limits": outshone.limits,
        "taken": outshone.taken,
    })
}

/// What the matte lines tell of ambient light.
pub(super) fn ambient(ambient: &Ambient) -> (Value, Value, Value) {
    let meeting = ambient.meeting;
    (
        json!({}),
        json!({
            "subtracted": ambient.subtracted,
            "verdict": ambient.verdict.name(),
            "meeting": meeting.map(|meeting| meeting.counts),
            "sd_counts": meeting.map(|meeting| meeting.sd_counts),
            "lines": meeting.map(|meeting| meeting.lines),
            "miss_counts": meeting.map(|meeting| meeting.miss_counts),
            "chi_square": meeting.map(|meeting| meeting.chi_square),
        }),
        json!({}),
    )
}

fn place(names: &Names, pixel: u32) -> [usize; 2] {
    let (x, y) = names.place(pixel);
    [x, y]
}
