//! Ambient light (section 7.5).

use super::{Describe, LineObjects, nothing};
use crate::describe::light_words::ambient_reason;
use crate::describe::{Names, counted, grouped_decimals};
use crate::trace::{Ambient, Meeting};
use serde_json::json;

impl Describe for Ambient {
    fn sentence(&self, _names: &Names) -> String {
        let counts = |counts: [f64; 3]| counts.map(|band| format!("{band:.1}")).join(", ");
        let reason = ambient_reason(self.verdict);
        let Some(meeting) = self.meeting else {
            return match self.subtracted {
                Some(given) => format!("ambient light of {} counts is subtracted: {reason}", counts(given)),
                None => format!("no ambient light is subtracted: {reason}"),
            };
        };
        let what = if self.subtracted.is_some() { "ambient light is" } else { "no ambient light is" };
        let [miss, of_black] = meeting.miss_counts;
        format!(
            "{what} subtracted: {reason}; {} pass {} \u{b1} {} counts by {miss:.1} counts (rms) and black by {of_black:.1}, \
             \u{3c7}\u{b2} {} (significant above {:.1})",
            counted(meeting.lines, "matte line"),
            counts(meeting.counts),
            counts(meeting.sd_counts),
            grouped_decimals(meeting.chi_square, 1),
            Meeting::SIGNIFICANT_CHI_SQUARE
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let meeting = self.meeting;
        LineObjects::new(
            nothing(),
            json!({
                "subtracted": self.subtracted,
                "verdict": self.verdict.name(),
                "meeting": meeting.map(|meeting| meeting.counts),
                "sd_counts": meeting.map(|meeting| meeting.sd_counts),
                "lines": meeting.map(|meeting| meeting.lines),
                "miss_counts": meeting.map(|meeting| meeting.miss_counts),
                "chi_square": meeting.map(|meeting| meeting.chi_square),
            }),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let meeting = crate::trace::Meeting {
            counts: [8.0, 9.0, 10.0],
            sd_counts: [0.5; 3],
            lines: 4,
            miss_counts: [0.5, 9.0],
            chi_square: 40.0,
        };
        let verdict = crate::trace::AmbientVerdict::Subtracted;
        Self { subtracted: Some(meeting.counts), meeting: Some(meeting), verdict }
    }
}
