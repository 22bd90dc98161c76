//! Names of hypotheses, regions and pixels in sentences, and the format of numbers.

use crate::raster::{Blocks, HypothesisId, PixelIndex, RegionId};
use crate::trace::{SecondLookRecord, Trace, regions_of};
use serde_json::Value;

/// Names of hypotheses and pixels in sentences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// The blocks of the photograph that are the pixels of the trace.
    pub(super) pixel_blocks: Blocks,
    /// Column and row of the photograph where the picture of the trace begins, pixels.
    pub(super) corner: [usize; 2],
    /// Region of each hypothesis, by [`HypothesisId::index`].
    pub(super) regions: Vec<Option<RegionId>>,
    /// Number in the result of each region of a finer picture, by [`RegionId::index`]; none where the regions of the trace are those of the
    /// result.
    pub(super) numbers_in_result: Option<Vec<Option<RegionId>>>,
}

impl Names {
    /// The names in a trace. A hypothesis that became a region is named by both its numbers.
    pub fn of(trace: &Trace) -> Self {
        let regions = regions_of(trace).unwrap_or_default().to_vec();
        Self { pixel_blocks: trace.pixel_blocks(), regions, ..Self::default() }
    }

    /// The names in the record of a finer picture of the second look: pixels and regions are those of the photograph.
    pub fn of_second_look(record: &SecondLookRecord) -> Self {
        let numbers_in_result = Some(record.regions.clone());
        Self { corner: record.corner(), numbers_in_result, ..Self::of(&record.trace) }
    }

    /// `region 3`: the number of a region. A region of a finer picture that is not in the result is called so.
    pub fn region(&self, region: RegionId) -> String {
        match &self.numbers_in_result {
            None => format!("region {region}"),
            Some(numbers) => match numbers.get(region.index()).copied().flatten() {
                Some(number) => format!("region {number}"),
                None => format!("region {region} of the finer picture"),
            },
        }
    }

    /// `hypothesis 7 (region 3)`: the number of a hypothesis, and the number of the region that the hypothesis became.
    pub fn hypothesis(&self, hypothesis: HypothesisId) -> String {
        match self.region_of(hypothesis) {
            Some(region) => format!("hypothesis {hypothesis} ({})", self.region(region)),
            None => format!("hypothesis {hypothesis}"),
        }
    }

    /// The region that a hypothesis became; none for a hypothesis that is in no region.
    pub fn region_of(&self, hypothesis: HypothesisId) -> Option<RegionId> {
        self.regions.get(hypothesis.index()).copied().flatten()
    }

    /// Several hypotheses: `hypotheses 1, 2 and 5`.
    pub(super) fn hypotheses(&self, hypotheses: &[HypothesisId]) -> String {
        let [only] = hypotheses else {
            let numbers: Vec<String> = hypotheses.iter().map(HypothesisId::to_string).collect();
            let Some((last, others)) = numbers.split_last() else { return "no hypothesis".to_owned() };
            return format!("hypotheses {} and {last}", others.join(", "));
        };
        self.hypothesis(*only)
    }

    /// `(12, 7)`: column and row of a pixel.
    pub fn pixel(&self, pixel: PixelIndex) -> String {
        let [x, y] = self.position(pixel);
        format!("({x}, {y})")
    }

    /// Column and row in the photograph of a pixel of the trace; where such a pixel has several pixels of the photograph, of the one in the
    /// middle.
    pub fn position(&self, pixel: PixelIndex) -> [usize; 2] {
        let [width, _] = self.pixel_blocks.picture();
        let [x, y] = PixelIndex::from_index(self.pixel_blocks.middle(pixel.index())).position(width);
        [self.corner[0] + x, self.corner[1] + y]
    }
}

/// A direction with two decimals.
pub(super) fn direction(vector: [f64; 3]) -> String {
    let [r, g, b] = vector;
    format!("({r:.2}, {g:.2}, {b:.2})")
}

/// A number with its sign.
pub(super) fn signed(number: impl Into<f64>, decimals: usize) -> String {
    typographic(&format!("{:+.decimals$}", number.into()))
}

/// A number in text with a minus sign in the place of a hyphen.
pub(super) fn typographic(number: &str) -> String {
    number.replace('-', "\u{2212}")
}

/// A percentage that is 100 only for all and 0 only for none.
pub(super) fn percent(share: f64) -> String {
    format!("{:.0} %", if share < 1.0 { (share * 100.0).min(99.0) } else { 100.0 })
}

/// A percentage with one decimal.
pub(super) fn tenths(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// `the largest`, `the 2nd`: the place of an area by size; `rank` counts from 0.
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

/// A number with as few digits as identify it; `null` where the number is not finite.
pub(super) fn short(number: f32) -> Value {
    if !number.is_finite() {
        return Value::Null;
    }
    // From the decimal digits of the number: converted to a double, it would have digits without meaning.
    number.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}
