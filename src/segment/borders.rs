//! Which regions lie next to one another.

use crate::raster::{HypothesisId, LabelMap, UNASSIGNED};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Number of rows that one task of [`near_pairs`] looks at.
const BAND_ROWS: usize = 64;

/// Pairs of hypotheses (smaller number first) of which two pixels lie at most `reach_px` apart along a row or a column.
pub fn near_hypotheses(labels: &LabelMap, reach_px: usize) -> BTreeSet<(HypothesisId, HypothesisId)> {
    let pairs = near_pairs(labels, reach_px).into_iter();
    pairs.filter_map(|(a, b)| Some((HypothesisId::from_label(a)?, HypothesisId::from_label(b)?))).collect()
}

/// Pairs of labels (smaller number first) of which two pixels lie at most `reach_px` apart along a row or a column.
pub fn near_pairs(labels: &LabelMap, reach_px: usize) -> BTreeSet<(u16, u16)> {
    let bands = (0..labels.height()).into_par_iter().step_by(BAND_ROWS);
    bands.flat_map_iter(|top| near_pairs_of_band(labels, reach_px, top)).collect()
}

/// The pairs of which the pixel above or on the left lies in the [`BAND_ROWS`] rows from `top` on.
fn near_pairs_of_band(labels: &LabelMap, reach_px: usize, top: usize) -> BTreeSet<(u16, u16)> {
    let (width, height) = (labels.width(), labels.height());
    let data = labels.as_slice();
    let mut pairs = BTreeSet::new();
    let mut last = (UNASSIGNED, UNASSIGNED);
    // Looks along a row (stride 1) or a column (stride `width`) of which `left` pixels follow.
    let mut look = |pixel: usize, stride: usize, left: usize| {
        let own = data[pixel];
        for step in 1..=reach_px.min(left) {
            let other = data[pixel + step * stride];
            if other == own {
                return;
            }
            if other != UNASSIGNED {
                let pair = (own.min(other), own.max(other));
                if pair != last {
                    last = pair;
                    pairs.insert(pair);
                }
                return;
            }
        }
    };
    for y in top..height.min(top + BAND_ROWS) {
        let row = labels.row(y);
        for (x, pair) in row.windows(2).enumerate() {
            if pair[0] != pair[1] && pair[0] != UNASSIGNED {
                look(y * width + x, 1, width - 1 - x);
            }
        }
        if y + 1 < height {
            for (x, (&own, &below)) in row.iter().zip(labels.row(y + 1)).enumerate() {
                if own != below && own != UNASSIGNED {
                    look(y * width + x, width, height - 1 - y);
                }
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_are_near_across_a_gap_but_not_through_a_third() {
        let labels = LabelMap::from_vec(7, 2, vec![1, 0, 0, 2, 3, 3, 1, 0, 0, 0, 0, 0, 0, 4]).unwrap();
        let pairs = |reach| near_pairs(&labels, reach).into_iter().collect::<Vec<_>>();
        assert_eq!(pairs(1), [(1, 3), (1, 4), (2, 3)]);
        assert_eq!(pairs(3), [(1, 2), (1, 3), (1, 4), (2, 3)]);
    }
}
