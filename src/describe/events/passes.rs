//! The beginnings of stages and passes.

use super::{Describe, LineObjects, nothing};
use crate::describe::Names;
use crate::trace::{Pass, PassBegan, StageBegan};
use serde_json::json;

/// The pass in smaller windows in trace lines: the name of its refinement, on which scripts depend.
const SMALLER_WINDOWS: &str = "second look";

impl Describe for StageBegan {
    fn sentence(&self, _names: &Names) -> String {
        format!("stage {} begins", self.stage.name())
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(nothing(), nothing(), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { stage: crate::trace::Stage::Linear }
    }
}

impl Describe for PassBegan {
    fn sentence(&self, _names: &Names) -> String {
        match self.pass {
            Pass::SmallerWindows(size) => format!("{} of {size} px", self.pass.name()),
            _ => self.pass.name().to_owned(),
        }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let values = match self.pass {
            Pass::SmallerWindows(size) => json!({"pass": SMALLER_WINDOWS, "window_size": size}),
            _ => json!({"pass": self.pass.name()}),
        };
        LineObjects::new(nothing(), values, nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { pass: Pass::SmallerWindows(6) }
    }
}
