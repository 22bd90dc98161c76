//! The three objects of an event's line.

use super::super::Names;
use super::{local, short};
use crate::color::{Line, Vec3};
use crate::trace::{
    BranchesSought, CandidateSource, CandidateTest, Event, Pass, PassedOver, SliceMade, VectorsFitted,
};
use serde_json::{Value, json};

/// What an event is about, what was measured, what it was held against.
pub(super) fn parts(names: &Names, event: &Event) -> (Value, Value, Value) {
    let none = || json!({});
    match event {
        Event::StageBegan { .. } => (none(), none(), none()),
        Event::PassBegan { pass: Pass::SecondLook(size) } => {
            (none(), json!({"pass": Pass::SecondLook(*size).name(), "window_size": size}), none())
        }
        Event::PassBegan { pass } => (none(), json!({"pass": pass.name()}), none()),
        Event::MasksMade(made) => (
            none(),
            json!({"dark": made.dark, "distorted": made.distorted, "sigma": made.sigma}),
            json!({
                "min_intensity": made.limits.min_intensity,
                "clip_threshold": made.limits.clip_threshold,
                "bloom_density": made.limits.bloom_density,
            }),
        ),
        Event::WindowsLaid(_) | Event::WindowClassified { .. } | Event::MergeTried { .. } => windows(event),
        Event::HypothesisChosen(_)
        | Event::HypothesisPassedOver { .. }
        | Event::SeedsPlaced { .. }
        | Event::GrowthBegan { .. }
        | Event::LineRefitted(_) => hypothesis(event),
        Event::CandidateTested(test) => tested(test),
        Event::CandidateChosen(chosen) => (
            json!({"region": chosen.region, "candidate": candidate(chosen.candidate)}),
            json!({"meeting_point": vector(&chosen.meeting_point), "direction": vector(&chosen.direction)}),
            none(),
        ),
        Event::IlluminantEstimated(estimated) => {
            let contribution = |c: &crate::trace::Contribution| json!({"region": c.region, "residual_deg": c.residual_deg, "weight": c.weight});
            let contributions: Vec<Value> = estimated.contributions.iter().map(contribution).collect();
            (
                none(),
                json!({
                    "given": false,
                    "direction": estimated.direction,
                    "contributions": contributions,
                    "outshone": estimated.outshone.map(local::outshone),
                }),
                none(),
            )
        }
        Event::IlluminantGiven { direction } => {
            (none(), json!({"given": true, "direction": direction}), none())
        }
        Event::VotesCast(votes) => local::votes(votes),
        Event::LightChosen(chosen) => local::chosen(chosen),
        Event::AmbientSought(ambient) => local::ambient(ambient),
        Event::Local(decision) => local::local(names, decision),
        Event::SliceMade(made) => slice(made),
        Event::BranchesSought(sought) => branches(sought),
        Event::VectorsFitted(fitted) => vectors(fitted),
        other => change(names, other),
    }
}

/// The same of windows and the areas that they merge into.
fn windows(event: &Event) -> (Value, Value, Value) {
    let none = || json!({});
    match event {
        Event::WindowsLaid(laid) => (
            none(),
            json!({"window_size": laid.size_px, "columns": laid.columns, "rows": laid.rows, "tail_test": laid.tail_test}),
            json!({"least_pixels": laid.least_pixels, "camera_noise": laid.camera_noise}),
        ),
        Event::WindowClassified {
            window,
            pixels,
            eigenvalues,
            chi_square: [statistic, threshold],
            class,
        } => (
            json!({"window": window}),
            json!({
                "pixels": pixels,
                "eigenvalues": eigenvalues.map(short),
                "chi_square": short(*statistic),
                "class": class.map(crate::trace::Class::name),
            }),
            json!({"chi_square": short(*threshold)}),
        ),
        Event::MergeTried {
            into,
            from,
            pixels,
            eigenvalues,
            chi_square: [statistic, threshold],
            class,
            union,
        } => (
            json!({"into": into, "area": from}),
            json!({
                "pixels": pixels,
                "eigenvalues": eigenvalues.map(short),
                "chi_square": short(*statistic),
                "union": union.name(),
                "kept": class == union,
            }),
            json!({"class": class.name(), "chi_square": short(*threshold)}),
        ),
        _ => (none(), none(), none()),
    }
}

fn hypothesis(event: &Event) -> (Value, Value, Value) {
    match event {
        Event::HypothesisChosen(chosen) => (
            json!({"region": chosen.region, "area": chosen.area}),
            json!({"rank": chosen.rank, "pixels": chosen.pixels, "line": line(&chosen.line)}),
            json!({"radius": chosen.radius}),
        ),
        Event::HypothesisPassedOver { area, pixels, least, reason } => (
            json!({"area": area}),
            json!({"pixels": pixels, "reason": passed_over(*reason)}),
            json!({"least": least}),
        ),
        Event::SeedsPlaced { region, pixels } => {
            (json!({"region": region}), json!({"pixels": pixels}), json!({}))
        }
        Event::GrowthBegan { region, limit } => {
            (json!({"region": region}), json!({}), json!({"limit": short(*limit)}))
        }
        Event::LineRefitted(refitted) => {
            (json!({"region": refitted.region}), json!({"line": line(&refitted.line)}), json!({}))
        }
        _ => (json!({}), json!({}), json!({})),
    }
}

/// Events that change what regions there are.
fn change(names: &Names, event: &Event) -> (Value, Value, Value) {
    match event {
        Event::Absorbed { region, by, feet: [highlight, object], gap } => (
            json!({"region": region, "by": by}),
            json!({"foot": highlight, "gap": gap}),
            json!({"object_foot": object}),
        ),
        Event::RegionsMerged { region, into, angle_deg, rms } => {
            (json!({"region": region, "into": into}), json!({"angle_deg": angle_deg, "rms": rms}), json!({}))
        }
        Event::HoleFilled { region, pixel, pixels, border_share } => {
            let (x, y) = names.place(*pixel);
            (
                json!({"region": region, "pixel": [x, y]}),
                json!({"pixels": pixels, "border_share": border_share}),
                json!({}),
            )
        }
        Event::Dropped { region, pixels } => {
            (json!({"region": region}), json!({"pixels": pixels}), json!({}))
        }
        Event::ComponentSplit { region, part, pixels } => {
            (json!({"region": region, "part": part}), json!({"pixels": pixels}), json!({}))
        }
        Event::Renumbered { finals } => (json!({}), json!({"regions": finals}), json!({})),
        _ => (json!({}), json!({}), json!({})),
    }
}

fn tested(test: &CandidateTest) -> (Value, Value, Value) {
    let verdict = test.verdict;
    (
        json!({"region": test.region, "candidate": candidate(test.candidate)}),
        json!({
            "pixels": test.pixels,
            "gap": test.gap[0],
            "position_percent": test.position_percent,
            "direction": vector(&test.line.direction),
            "passed": {
                "lines_meet": verdict.lines_meet,
                "upper_half": verdict.upper_half,
                "positive": verdict.positive,
                "beyond": verdict.beyond,
            },
            "weight": test.weight,
        }),
        json!({"gap": test.gap[1], "position_percent": test.position_limits}),
    )
}

fn slice(made: &SliceMade) -> (Value, Value, Value) {
    (
        json!({"region": made.region}),
        json!({
            "angle_deg": made.plane.angle_deg(),
            "normal": vector(&made.plane.normal),
            "matte_length": made.matte_length,
            "start": vector(&made.start),
        }),
        json!({"half_width": made.half_width}),
    )
}

fn branches(sought: &BranchesSought) -> (Value, Value, Value) {
    let core = |core: &crate::trace::HighlightCore| {
        json!({
            "body": short(core.body),
            "deviation": short(core.deviation),
            "surface": short(core.surface),
            "pixels": core.pixels,
            "span": core.span_px,
            "branch": core.branch + 1,
        })
    };
    let cores: Vec<Value> = sought.cores.iter().map(core).collect();
    let of_gaps = |which: usize| sought.gaps.iter().map(|gap| short(gap[which])).collect::<Vec<_>>();
    (
        json!({"final": sought.region}),
        json!({"branches": sought.branches(), "cores": cores, "differences": of_gaps(0)}),
        json!({"differences": of_gaps(1)}),
    )
}

fn vectors(fitted: &VectorsFitted) -> (Value, Value, Value) {
    (
        json!({"final": fitted.region}),
        json!({
            "body": vector(&fitted.body),
            "surface": fitted.surface.as_ref().map(vector),
            "matte": line(&fitted.matte),
            "start": vector(&fitted.start),
            "starts": fitted.starts.iter().map(vector).collect::<Vec<_>>(),
            "fit_rms_counts": fitted.rms_counts,
            "texture": fitted.texture,
            "texture_slope": fitted.texture_slope,
            "holds": fitted.holds,
        }),
        json!({
            "least_offset": short(fitted.least_offset),
            "fit_rms_counts": fitted.limits.rms_counts,
            "texture": fitted.limits.texture,
            "texture_slope": fitted.limits.texture_slope,
        }),
    )
}

fn line(line: &Line) -> Value {
    json!({"mean": vector(&line.mean), "direction": vector(&line.direction)})
}

fn vector(vector: &Vec3) -> [f64; 3] {
    (*vector).into()
}

fn candidate(source: CandidateSource) -> Value {
    match source {
        CandidateSource::Leftover(area) => json!({"leftover_of_area": area}),
        CandidateSource::Region(region) => json!({"region": region}),
        CandidateSource::Absorbed(region) => json!({"absorbed": region}),
    }
}

fn passed_over(reason: PassedOver) -> &'static str {
    match reason {
        PassedOver::TooSmall => "too_small",
        PassedOver::Consumed => "consumed",
        PassedOver::FarFromBlack => "far_from_black",
        PassedOver::NoExtent => "no_extent",
        PassedOver::Barren => "barren",
        PassedOver::NoNumberLeft => "no_number_left",
    }
}
