//! The beginnings of stages and passes.

use super::{Describe, LineObjects, nothing};
use crate::describe::Names;
use crate::trace::{Pass, PassBegan, StageBegan};
use serde_json::json;

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
            Pass::SecondLook(size) => format!("{} in windows of {size} px", self.pass.name()),
            _ => self.pass.name().to_owned(),
        }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let values = match self.pass {
            Pass::SecondLook(size) => json!({"pass": self.pass.name(), "window_size": size}),
            _ => json!({"pass": self.pass.name()}),
        };
        LineObjects::new(nothing(), values, nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { pass: Pass::SecondLook(6) }
    }
}
