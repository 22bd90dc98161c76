//! What hypotheses, regions and pixels are called in sentences, and how numbers are written there.

use crate::trace::{Trace, final_numbers};
use serde_json::Value;

/// What regions and pixels are called in sentences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    pub(super) width: usize,
    pub(super) finals: Vec<u16>,
}

impl Names {
    /// The names in a trace. A region that is in the result is called by both its numbers.
    pub fn of(trace: &Trace) -> Self {
        let finals = final_numbers(trace).map_or_else(Vec::new, <[u16]>::to_vec);
        Self { width: trace.width(), finals }
    }

    /// `hypothesis 7 (region 3)`: its number of birth, and its number in the result where it is in it.
    pub fn region(&self, region: u16) -> String {
        match self.number(region) {
            Some(number) => format!("hypothesis {region} (region {number})"),
            None => format!("hypothesis {region}"),
        }
    }

    /// Its number in the result; none for one that is not in it.
    pub fn number(&self, region: u16) -> Option<u16> {
        let index = usize::from(region).checked_sub(1)?;
        self.finals.get(index).copied().filter(|&number| number > 0)
    }

    /// Several regions: `hypotheses 1, 2 and 5`.
    pub(super) fn regions(&self, regions: &[u16]) -> String {
        let [only] = regions else {
            let numbers: Vec<String> = regions.iter().map(u16::to_string).collect();
            let Some((last, others)) = numbers.split_last() else { return "no hypothesis".to_owned() };
            return format!("hypotheses {} and {last}", others.join(", "));
        };
        self.region(*only)
    }

    /// `(12, 7)`: column and row.
    pub fn pixel(&self, pixel: u32) -> String {
        let (x, y) = self.place(pixel);
        format!("({x}, {y})")
    }

    /// Column and row of a pixel.
    pub fn place(&self, pixel: u32) -> (usize, usize) {
        let width = self.width.max(1);
        (pixel as usize % width, pixel as usize / width)
    }
}

/// `1 pixel`, `12 pixels`.
pub(super) fn count(n: impl Into<u64>, what: &str) -> String {
    let n = n.into();
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// A direction with two decimals.
pub(super) fn direction(vector: [f64; 3]) -> String {
    let [r, g, b] = vector;
    format!("({r:.2}, {g:.2}, {b:.2})")
}

/// A percentage that is 100 only for all and 0 only for none.
pub(super) fn percent(share: f64) -> String {
    format!("{:.0} %", if share < 1.0 { (share * 100.0).min(99.0) } else { 100.0 })
}

/// A percentage with one decimal.
pub(super) fn tenths(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// `the largest`, `the 2nd`, of areas that were looked at before.
pub(super) fn ordinal(rank: u32) -> String {
    let n = rank.saturating_add(1);
    let ending = match (n % 10, n % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    if rank == 0 { "the largest".to_owned() } else { format!("the {n}{ending}") }
}

/// A number as short as it can be read back; `null` where it is none.
pub(super) fn short(number: f32) -> Value {
    if !number.is_finite() {
        return Value::Null;
    }
    // By way of its digits: as a double it would carry digits that were never measured.
    number.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}
