//! The measures that scores are made of.

use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED};
use std::collections::BTreeMap;

/// Number of pixels with each pair of labels.
pub(super) type Contingency = BTreeMap<(u16, u16), u64>;

/// Counts pairs of labels.
pub(super) fn contingency(pairs: impl IntoIterator<Item = (u16, u16)>) -> Contingency {
    let mut table = Contingency::new();
    for pair in pairs {
        *table.entry(pair).or_insert(0) += 1;
    }
    table
}

/// Adjusted Rand index (Hubert & Arabie 1985) of two labelings, given as the pairs of labels of all pixels.
///
/// 1 for partitions that agree, whatever their labels; about 0 for independent partitions; 1 where both labelings have one class
/// only, or one class per pixel.
pub fn adjusted_rand_index(pairs: impl IntoIterator<Item = (u16, u16)>) -> f64 {
    rand_index_of(&contingency(pairs))
}

/// The adjusted Rand index of a table of pairs, see [`adjusted_rand_index`].
pub(super) fn rand_index_of(table: &Contingency) -> f64 {
    let choose_2 = |n: u64| n as f64 * (n as f64 - 1.0) / 2.0;
    let pairs_within = |sizes: BTreeMap<u16, u64>| sizes.into_values().map(choose_2).sum::<f64>();
    let all = choose_2(table.values().sum());
    let both: f64 = table.values().copied().map(choose_2).sum();
    let first = pairs_within(marginal(table, |pair| pair.0));
    let second = pairs_within(marginal(table, |pair| pair.1));
    let (expected, most) = (first * second / all.max(1.0), f64::midpoint(first, second));
    // Both are equal exactly when both labelings are one single class, or all classes are single pixels.
    if most > expected { (both - expected) / (most - expected) } else { 1.0 }
}

/// Number of pixels of each label on one side of the table.
pub(super) fn marginal(table: &Contingency, side: impl Fn(&(u16, u16)) -> u16) -> BTreeMap<u16, u64> {
    let mut sizes = BTreeMap::new();
    for (pair, count) in table {
        *sizes.entry(side(pair)).or_insert(0) += count;
    }
    sizes
}

/// Peak signal-to-noise ratio on the 0–255 scale, decibels; none without values. At most 138 dB.
pub fn psnr_db(differences: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (n, sum) = differences.into_iter().fold((0usize, 0.0), |(n, sum), d| (n + 1, sum + d * d));
    (n > 0).then(|| 10.0 * (255.0f64.powi(2) / (sum / n as f64).max(1e-9)).log10())
}

/// Angle between two lines through black, degrees from 0 to 90; NaN for a vector without length.
pub fn angle_deg(u: [f64; 3], v: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    (dot(u, v).abs() / dot(u, u).sqrt() / dot(v, v).sqrt()).clamp(-1.0, 1.0).acos().to_degrees()
}

/// Pixels more than `steps` 4-neighbor steps inside an object: each object's mask eroded `steps` times by a
/// cross, with nothing beyond the border.
///
/// Labels for which `is_object` is true are objects.
pub(super) fn erode_labels(labels: &LabelMap, steps: usize, is_object: impl Fn(u16) -> bool) -> Mask {
    let mut inside = labels.map(|&id| id != UNASSIGNED && is_object(id));
    for _ in 0..steps {
        let mut next = Raster::filled(labels.width(), labels.height(), false);
        for pixel in (0..labels.len()).filter(|&pixel| inside[pixel]) {
            let mut alike = 0;
            labels
                .for_each_neighbor(pixel, |q| alike += usize::from(inside[q] && labels[q] == labels[pixel]));
            next[pixel] = alike == 4;
        }
        inside = next;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
    }

    #[test]
    fn labelings_that_agree_score_one_whatever_their_labels() {
        close(adjusted_rand_index([(1, 7), (1, 7), (2, 3), (2, 3), (5, 1)]), 1.0);
        close(adjusted_rand_index([(1, 1); 4]), 1.0);
        close(adjusted_rand_index([]), 1.0);
    }

    #[test]
    fn independent_labelings_score_about_nothing() {
        // Every pair of labels occurs equally often: the index is slightly negative and tends to 0 with more pixels.
        let combinations = |n: usize| (0..4 * n).map(|i| ((i % 2) as u16, (i / 2 % 2) as u16));
        close(adjusted_rand_index(combinations(1)), -0.5);
        close(adjusted_rand_index(combinations(100)), -1.0 / 398.0);
    }

    #[test]
    fn unequal_labelings_follow_the_formula() {
        // {a a a} {b b b} against {x x} {y y y y}, sharing 2, 1 and 3 pixels.
        let pairs = [(1, 1), (1, 1), (1, 2), (2, 2), (2, 2), (2, 2)];
        let (both, first, second, all) = (1.0 + 3.0, 3.0 + 3.0, 1.0 + 6.0, 15.0);
        let expected = first * second / all;
        close(adjusted_rand_index(pairs), (both - expected) / (f64::midpoint(first, second) - expected));
    }

    #[test]
    fn psnr_of_a_known_offset() {
        close(psnr_db([1.0, -1.0, 1.0]).unwrap(), 20.0 * 255f64.log10());
        close(psnr_db([25.5; 7]).unwrap(), 20.0);
        assert_eq!(psnr_db([]), None);
        assert!(psnr_db([0.0]).unwrap() > 130.0);
    }

    #[test]
    fn angles_are_between_lines_and_not_between_directions() {
        close(angle_deg([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]), 90.0);
        close(angle_deg([1.0, 1.0, 0.0], [-3.0, -3.0, 0.0]), 0.0);
        close(angle_deg([1.0, 0.0, 0.0], [1.0, 1.0, 0.0]), 45.0);
        assert!(angle_deg([0.0; 3], [1.0, 0.0, 0.0]).is_nan());
    }

    /// Compares the erosion of labels with the expected result; both are drawn as digits, `.` = 0.
    #[track_caller]
    fn check_erosion(steps: usize, before: &[&str], after: &[&str]) {
        let labels: Vec<u16> =
            before.iter().flat_map(|r| r.chars().map(|c| c.to_digit(10).unwrap_or(0) as u16)).collect();
        let labels = Raster::from_vec(before[0].len(), before.len(), labels).unwrap();
        let kept = erode_labels(&labels, steps, |_| true);
        let drawn: Vec<String> = (0..labels.height())
            .map(|y| {
                labels
                    .row(y)
                    .iter()
                    .zip(kept.row(y))
                    .map(|(&l, &k)| if k { (b'0' + l as u8) as char } else { '.' })
            })
            .map(Iterator::collect)
            .collect();
        assert_eq!(drawn, after);
    }

    #[test]
    fn erosion_takes_a_diamond_and_the_border_is_outside() {
        check_erosion(1, &["111", "111", "111"], &["...", ".1.", "..."]);
        check_erosion(2, &["1111", "1111", "1111", "1111"], &["....", "....", "....", "...."]);
        let full = ["1111111"; 7];
        let left = [".......", ".......", "..111..", "..111..", "..111..", ".......", "......."];
        check_erosion(2, &full, &left);
    }

    #[test]
    fn a_hole_removes_the_pixels_within_two_steps() {
        let before = ["1111111", "1111111", "111.111", "1111111", "1111111", "1111111", "1111111"];
        let after = [".......", ".......", ".......", ".......", "..1.1..", ".......", "......."];
        check_erosion(2, &before, &after);
    }

    #[test]
    fn touching_objects_erode_each_other() {
        check_erosion(1, &["111222", "111222", "111222"], &["......", ".1..2.", "......"]);
        check_erosion(1, &["1111", "1221", "1221", "1111"], &["....", "....", "....", "...."]);
    }
}
