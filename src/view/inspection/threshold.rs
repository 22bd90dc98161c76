//! A measured value beside its limits, and the place of both on a bar.

use crate::describe::grouped_decimals;
use crate::trace::Measured;

/// The limits of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// The largest value that passes.
    AtMost(f64),
    /// The least value that passes.
    AtLeast(f64),
    /// The least and the largest value that pass.
    Within([f64; 2]),
}

/// A value beside its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThresholdTest {
    /// What was measured.
    pub name: &'static str,
    /// The measured value.
    pub value: f64,
    /// The limits of the value.
    pub limits: Limits,
    /// Unit of value and limits; empty for none.
    pub unit: &'static str,
    /// Whether the value passed.
    pub passed: bool,
    /// What is measured and why, with the section.
    pub tip: &'static str,
}

impl ThresholdTest {
    /// A value that passes up to a limit.
    pub fn at_most(
        name: &'static str,
        measured: Measured<f64>,
        unit: &'static str,
        tip: &'static str,
    ) -> Self {
        let Measured { value, limit } = measured;
        Self { name, value, limits: Limits::AtMost(limit), unit, passed: value <= limit, tip }
    }

    /// A value that passes from a limit on.
    pub fn at_least(
        name: &'static str,
        measured: Measured<f64>,
        unit: &'static str,
        tip: &'static str,
    ) -> Self {
        let Measured { value, limit } = measured;
        Self { name, value, limits: Limits::AtLeast(limit), unit, passed: value >= limit, tip }
    }

    /// The test as text: `gap 4.0 ≤ 10.0 counts`.
    pub fn text(&self) -> String {
        let Self { name, value, limits, unit, passed, .. } = *self;
        let number = |value: f64| number(value, self.decimals());
        let value_text = number(value);
        let relation = match (limits, passed) {
            (Limits::AtMost(limit), true) => format!("\u{2264} {}", number(limit)),
            (Limits::AtMost(limit), false) => format!("> {}", number(limit)),
            (Limits::AtLeast(limit), true) => format!("\u{2265} {}", number(limit)),
            (Limits::AtLeast(limit), false) => format!("< {}", number(limit)),
            (Limits::Within([low, high]), passed) => {
                let word = if passed { "within" } else { "outside" };
                format!("{word} {}\u{2013}{}", number(low), number(high))
            }
        };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        format!("{name} {value_text} {relation}{unit}")
    }

    /// Number of decimals by which value and limits can be told apart.
    fn decimals(&self) -> usize {
        let limit = match self.limits {
            Limits::AtMost(limit) | Limits::AtLeast(limit) => limit.abs(),
            Limits::Within([_, high]) => high.abs(),
        };
        if matches!(self.unit, "px" | "%") || limit >= 1000.0 {
            0
        } else if limit >= 5.0 {
            1
        } else {
            2
        }
    }

    /// The least and the largest value of a bar on which value and limits are drawn. A value far beyond its limits lies at an end of
    /// the bar.
    pub fn range(&self) -> [f64; 2] {
        let (low, high) = match self.limits {
            Limits::AtMost(limit) | Limits::AtLeast(limit) => (0f64.min(1.6 * limit), 1.6 * limit),
            Limits::Within([low, high]) => (0f64.min(low), 1.25 * high),
        };
        let high = if high.is_finite() && high > low { high } else { low + 1.0 };
        let span = high - low;
        let low = if self.value < low { low - 0.25 * span } else { low };
        let high = if self.value > high { high + span } else { high };
        [low, high]
    }

    /// The place of a value on the bar, 0…1.
    pub fn share(&self, value: f64) -> f32 {
        let [low, high] = self.range();
        let share = (value - low) / (high - low);
        if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) as f32 }
    }
}

/// A number with a typographic minus sign.
fn number(value: f64, decimals: usize) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "\u{221e}".to_owned() } else { "\u{2212}\u{221e}".to_owned() };
    }
    let text = grouped_decimals(value.abs(), decimals);
    let is_zero = text.chars().all(|letter| matches!(letter, '0' | '.'));
    if value < 0.0 && !is_zero { format!("\u{2212}{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_most(value: f64, limit: f64) -> ThresholdTest {
        ThresholdTest::at_most("gap", Measured::new(value, limit), "counts", "")
    }

    #[test]
    fn a_test_says_value_and_limit() {
        assert_eq!(at_most(4.0, 10.0).text(), "gap 4.0 \u{2264} 10.0 counts");
        assert_eq!(at_most(12.34, 10.0).text(), "gap 12.3 > 10.0 counts");
        let share = ThresholdTest::at_least("share", Measured::new(0.4, 0.5), "", "");
        assert_eq!(share.text(), "share 0.40 < 0.50");
        let place = ThresholdTest { limits: Limits::Within([50.0, 120.0]), unit: "%", ..at_most(75.0, 0.0) };
        assert_eq!(ThresholdTest { passed: true, ..place }.text(), "gap 75 within 50\u{2013}120 %");
    }

    #[test]
    fn value_and_limit_lie_on_the_bar_whatever_they_are() {
        for value in [0.0, 4.0, 1e9, -3.0, f64::NAN, f64::INFINITY] {
            for limit in [10.0, 0.0, -2.0, f64::INFINITY, f64::NAN] {
                let test = at_most(value, limit);
                for at in [value, limit] {
                    let share = test.share(at);
                    assert!((0.0..=1.0).contains(&share), "{value} {limit} {share}");
                }
            }
        }
        let passed = at_most(4.0, 10.0);
        assert!(passed.share(4.0) < passed.share(10.0) && passed.share(10.0) < 1.0);
        let failed = at_most(400.0, 10.0);
        assert!(failed.share(400.0) > failed.share(10.0) && failed.share(10.0) > 0.2);
    }
}
