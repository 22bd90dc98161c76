//! The tooltip of the track.

use crate::describe::Names;
use crate::describe::grouped;
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
        let region = regions.region_of(block.topic.hypothesis());
        let region = region.map_or_else(String::new, |region| format!(", in the result region {region}"));
        let claims = if claims > 0 { format!(": {} claims", grouped(claims)) } else { String::new() };
        lines.push(format!("{}{region}{claims}", topic(block.topic)));
    }
    if let Some(step_at_pointer) = trace.step(step) {
        lines.push(format!("step {}: {}", grouped(step + 1), names.step(&step_at_pointer)));
    }
    lines
}

/// The subject of a block, as text.
fn topic(topic: Topic) -> String {
    match topic {
        Topic::Hypothesis(id) => format!("hypothesis {id}"),
        Topic::Absorption(id) => format!("hypothesis {id} is absorbed"),
        Topic::Candidates(id) => format!("highlight candidates of hypothesis {id}"),
        Topic::Slice(id) => format!("slice of hypothesis {id}"),
        Topic::Brightness(id) => format!("hypothesis {id} grows by brightness"),
        Topic::Hole(id) => format!("a hole of hypothesis {id}"),
        Topic::Part(id) => format!("a part becomes hypothesis {id}"),
    }
}
