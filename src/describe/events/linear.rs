//! Linear hypotheses (section 5.3).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, line, nothing};
use crate::describe::names::{direction, ordinal, short};
use crate::describe::{Names, counted, grouped};
use crate::trace::{
    Absorbed, GrowthBegan, HypothesisChosen, HypothesisPassedOver, LineRefitted, PassedOver, RegionsMerged,
    SeedsPlaced,
};
use serde_json::json;

impl Describe for HypothesisChosen {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, area, rank, pixels, line, radius } = self;
        format!(
            "{} starts from area {area}, {} in size: {}, direction {}, radius {radius:.1} counts",
            names.hypothesis(*hypothesis),
            ordinal(*rank),
            counted(*pixels, "unclaimed pixel"),
            direction(line.direction.into())
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "area": self.area}),
            json!({"rank": self.rank, "pixels": self.pixels, "line": line(&self.line)}),
            json!({"radius": self.radius}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), area: 4, rank: 0, pixels: 900, line: example_line(), radius: 8.0 }
    }
}

impl Describe for HypothesisPassedOver {
    fn sentence(&self, _names: &Names) -> String {
        let Self { area, pixels, least, reason } = self;
        format!("area {area} is passed over: {}", passed_over(*reason, *pixels, *least))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let reason = match self.reason {
            PassedOver::TooSmall => "too_small",
            PassedOver::Consumed => "consumed",
            PassedOver::FarFromBlack => "far_from_black",
            PassedOver::NoExtent => "no_extent",
            PassedOver::Barren => "barren",
            PassedOver::NoNumberLeft => "no_number_left",
        };
        LineObjects::new(
            json!({"area": self.area}),
            json!({"pixels": self.pixels, "reason": reason}),
            json!({"least": self.least}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { area: 3, pixels: 12, least: 500, reason: PassedOver::Consumed }
    }
}

impl Describe for SeedsPlaced {
    fn sentence(&self, names: &Names) -> String {
        format!("{} starts from {}", names.hypothesis(self.hypothesis), counted(self.pixels, "pixel"))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(json!({"region": self.hypothesis}), json!({"pixels": self.pixels}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), pixels: 640 }
    }
}

impl Describe for GrowthBegan {
    fn sentence(&self, names: &Names) -> String {
        format!("{} grows, limit {:.1} counts", names.hypothesis(self.hypothesis), self.limit)
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(json!({"region": self.hypothesis}), nothing(), json!({"limit": short(self.limit)}))
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), limit: 8.0 }
    }
}

impl Describe for LineRefitted {
    fn sentence(&self, names: &Names) -> String {
        let line = direction(self.line.direction.into());
        format!("the line of {} is fitted again: direction {line}", names.hypothesis(self.hypothesis))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(json!({"region": self.hypothesis}), json!({"line": line(&self.line)}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), line: example_line() }
    }
}

impl Describe for Absorbed {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, by, highlight_foot, object_foot, gap } = self;
        format!(
            "{} is the broad highlight of {}: its line misses black by {highlight_foot:.1} counts, the object's by \
             {object_foot:.1}; the lines pass {gap:.1} counts from one another",
            names.hypothesis(*hypothesis),
            names.hypothesis(*by)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "by": self.by}),
            json!({"foot": self.highlight_foot, "gap": self.gap}),
            json!({"object_foot": self.object_foot}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            hypothesis: hypothesis(2),
            by: hypothesis(1),
            highlight_foot: 40.0,
            object_foot: 1.5,
            gap: 2.5,
        }
    }
}

impl Describe for RegionsMerged {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, into, angle_deg, rms } = self;
        format!(
            "{} joins {}: their lines differ by {angle_deg:.1}\u{b0} and its pixels lie {rms:.1} counts from the \
             other's (rms)",
            names.hypothesis(*hypothesis),
            names.hypothesis(*into)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "into": self.into}),
            json!({"angle_deg": self.angle_deg, "rms": self.rms}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(2), into: hypothesis(1), angle_deg: 0.5, rms: 1.25 }
    }
}

/// Why an area did not start a hypothesis, or the hypothesis that it started was taken back.
pub(in crate::describe) fn passed_over(reason: PassedOver, pixels: u32, least: u32) -> String {
    match reason {
        PassedOver::TooSmall => {
            format!("{}, it needs {}", counted(pixels, "unclaimed pixel"), grouped(least))
        }
        PassedOver::Consumed => {
            format!("{} of its pixels are still free, and it needs {}", grouped(pixels), grouped(least))
        }
        PassedOver::FarFromBlack => "its line passes black outside the cylinder's radius".to_owned(),
        PassedOver::NoExtent => "its colors have no extent to fit a line to".to_owned(),
        PassedOver::Barren => format!("growing from it claimed fewer than {}", counted(least, "pixel")),
        PassedOver::NoNumberLeft => "there is no number left for another region".to_owned(),
    }
}

/// A line through black.
#[cfg(test)]
pub(super) fn example_line() -> crate::color::Line {
    use crate::color::Vec3;
    crate::color::Line { mean: Vec3::new(60.0, 0.0, 80.0), direction: Vec3::new(0.6, 0.0, 0.8) }
}
