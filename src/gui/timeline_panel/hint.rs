//! The tooltip of the track.

use crate::describe::Names;
use crate::gui::widgets::grouped;
use crate::trace::{Topic, Trace};
use crate::view::RegionNames;

/// Lines of text about a step: stage and pass, block, and the decision.
pub fn lines(trace: &Trace, regions: &RegionNames, names: &Names, step: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let stage = trace.stage_at(step).map_or("", |stage| stage.name());
    lines.push(match trace.pass_at(step) {
        Some(pass) => format!("{stage} \u{203a} {}", pass.pass.name()),
        None => stage.to_owned(),
    });
    if let Some(block) = trace.block_at(step) {
        let decisions = trace.decisions_in(block.steps.clone());
        let claims = block.steps.len().saturating_sub(decisions);
        let number = regions.final_number(block.topic.region());
        let region = if number > 0 { format!(", in the result region {number}") } else { String::new() };
        let claims = if claims > 0 { format!(": {} claims", grouped(claims)) } else { String::new() };
        lines.push(format!("{}{region}{claims}", topic(block.topic)));
    }
    if let Some(taken) = trace.step(step) {
        lines.push(format!("step {}: {}", grouped(step + 1), names.step(&taken)));
    }
    lines
}

fn topic(topic: Topic) -> String {
    match topic {
        Topic::Hypothesis(region) => format!("hypothesis {region}"),
        Topic::Absorption(region) => format!("hypothesis {region} is absorbed"),
        Topic::Candidates(region) => format!("highlight candidates of hypothesis {region}"),
        Topic::Slice(region) => format!("slice of hypothesis {region}"),
        Topic::Brightness(region) => format!("hypothesis {region} grows by brightness"),
        Topic::Hole(region) => format!("a hole of hypothesis {region}"),
        Topic::Part(region) => format!("a part becomes hypothesis {region}"),
    }
}
