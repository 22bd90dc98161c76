//! The decisions about pixels that a person has marked (section 6, first paragraph).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, line, nothing};
use crate::describe::names::direction;
use crate::describe::{Names, counted};
use crate::trace::{MarkedCluster, MarkedLineFitted, MarkedPixelsTaken};
use serde_json::json;

impl Describe for MarkedLineFitted {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, cluster, round, pixels, line, rms_counts, .. } = self;
        format!(
            "round {round}: the {} line of {} is fitted to {}: direction {}, which lie {rms_counts:.2} counts from the line (rms)",
            cluster.name(),
            names.hypothesis(*hypothesis),
            counted(*pixels, "marked pixel"),
            direction(line.direction.into())
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis}),
            json!({
                "cluster": self.cluster.name(),
                "round": self.round,
                "pixels": self.pixels,
                "line": line(&self.line),
                "rms": self.rms_counts,
            }),
            json!({"radius": self.radius}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            hypothesis: hypothesis(1),
            cluster: MarkedCluster::Matte,
            round: 2,
            pixels: 640,
            line: super::linear::example_line(),
            rms_counts: 1.25,
            radius: 10.0,
        }
    }
}

impl Describe for MarkedPixelsTaken {
    fn sentence(&self, names: &Names) -> String {
        let what = match self.cluster {
            MarkedCluster::Matte => "nearer to the matte line",
            MarkedCluster::Highlight => "not nearer to the matte line",
            MarkedCluster::Distorted => "clipped or bloomed",
        };
        format!(
            "{} takes {}, {what}",
            names.hypothesis(self.hypothesis),
            counted(self.pixels, "marked pixel")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis}),
            json!({"cluster": self.cluster.name(), "pixels": self.pixels}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), cluster: MarkedCluster::Matte, pixels: 640 }
    }
}
