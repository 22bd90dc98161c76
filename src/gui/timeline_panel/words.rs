//! The step at the cursor in a few words.

use crate::trace::{Event, Step, Trace};

/// What pixels are called.
#[derive(Clone, Debug, Default)]
pub struct Names {
    width: usize,
}

impl Names {
    /// The names in a trace.
    pub fn of(trace: &Trace) -> Self {
        Self { width: trace.width() }
    }

    /// What happened at a step.
    pub fn step(&self, step: &Step) -> String {
        match step {
            Step::Event(event) => told(event),
            Step::Claim { pixel, before: 0, after, .. } => {
                format!("hypothesis {after} takes pixel {}", self.pixel(*pixel))
            }
            Step::Claim { pixel, before, after: 0, .. } => {
                format!("hypothesis {before} gives up pixel {}", self.pixel(*pixel))
            }
            Step::Claim { pixel, before, after, .. } => {
                format!("pixel {} goes from hypothesis {before} to {after}", self.pixel(*pixel))
            }
            Step::Refusal { pixel, holder, challenger, .. } => {
                format!("hypothesis {holder} keeps pixel {} from {challenger}", self.pixel(*pixel))
            }
            Step::Label { pixel, kind } => format!("pixel {} is {}", self.pixel(*pixel), kind.name()),
        }
    }

    fn pixel(&self, pixel: u32) -> String {
        let width = self.width.max(1);
        format!("({}, {})", pixel as usize % width, pixel as usize / width)
    }
}

fn told(event: &Event) -> String {
    match event {
        Event::StageBegan { stage } => format!("{} begins", stage.name()),
        Event::PassBegan { pass } => format!("{} begins", pass.name()),
        Event::HypothesisChosen(chosen) => format!(
            "hypothesis {}: area {}, {} px, radius {:.1} counts",
            chosen.region,
            chosen.rank + 1,
            chosen.pixels,
            chosen.radius
        ),
        other => match other.regions()[0] {
            Some(region) => format!("hypothesis {region}: {}", other.kind().name()),
            None => other.kind().name().to_owned(),
        },
    }
}
