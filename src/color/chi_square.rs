//! Thresholds of the χ² test whether the variance of a window exceeds the variance of the camera noise (section 5.2.1).

use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::collections::BTreeMap;

/// Largest number of degrees of freedom for which the exact quantile is computed. Above, the Wilson–Hilferty approximation is used: its
/// relative error is below 2e-4, which does not matter for a test at 5 %, and the approximation is about a thousand times faster
/// than the exact quantile.
const MAX_EXACT_FREEDOM: usize = 30;

/// Upper quantiles of χ² at one significance level; each exact quantile is computed once.
#[derive(Clone, Debug)]
pub struct ChiSquareThresholds {
    /// Significance level.
    level: f64,
    /// Upper quantile of the standard normal distribution at the level.
    normal_quantile: f64,
    /// Exact quantiles by degrees of freedom.
    exact: BTreeMap<usize, f64>,
}

impl ChiSquareThresholds {
    /// Thresholds at the significance level `level` (0 < level < 1): the probability that a true null hypothesis is rejected.
    pub fn new(level: f64) -> Self {
        let normal = statrs::distribution::Normal::standard();
        Self { level, normal_quantile: normal.inverse_cdf(1.0 - level), exact: BTreeMap::new() }
    }

    /// The value that χ² with `freedom` degrees of freedom exceeds with the probability of the significance level. No degree of freedom counts as one.
    pub fn threshold(&mut self, freedom: usize) -> f64 {
        let n = freedom.max(1) as f64;
        if freedom > MAX_EXACT_FREEDOM {
            let h = 2.0 / (9.0 * n);
            return n * (1.0 - h + self.normal_quantile * h.sqrt()).powi(3);
        }
        let level = self.level;
        *self.exact.entry(freedom.max(1)).or_insert_with(|| {
            ChiSquared::new(n).map_or(f64::INFINITY, |distribution| distribution.inverse_cdf(1.0 - level))
        })
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_those_of_the_tables() {
        let mut test = ChiSquareThresholds::new(0.05);
        assert!((test.threshold(1) - 3.841).abs() < 1e-3);
        assert!((test.threshold(30) - 43.773).abs() < 1e-3);
        assert!((test.threshold(99) - 123.225).abs() < 1e-2);
        assert_eq!(test.threshold(0), test.threshold(1));
    }

    #[test]
    fn the_approximation_is_near_the_exact_value() {
        let mut test = ChiSquareThresholds::new(0.05);
        for freedom in [MAX_EXACT_FREEDOM + 1, 99, 5000, 200_000] {
            let exact = ChiSquared::new(freedom as f64).unwrap().inverse_cdf(0.95);
            assert!((test.threshold(freedom) / exact - 1.0).abs() < 2e-4, "{freedom}");
        }
    }
}
