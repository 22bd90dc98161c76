//! The number of directions in which a cluster of colors varies beyond the noise (section 5.2.1).
//!
//! The paper tests each eigenvalue alone: (N−1)·λ/σ0² against χ²(N−1). The largest eigenvalue of pure noise exceeds σ²
//! systematically, but σ0 = 2σ leaves a fourfold margin.
//!
//! Refined (`tail_test`): k directions explain the cluster if the statistic (N−1)·Σ_{i>k} λ_i / (0.7σ0)² ~ χ²((3−k)(N−1−k)) of
//! *all* variances beyond the k-th is not significant. With σ = 3 and σ0 = 2.5 the paper's test loses half of the coverage.

use super::ChiSquareThresholds;

/// Standard deviation that tails are compared with, as a share of σ0: (0.7σ0)² = (1.4σ)².
const TAIL_SCALE: f64 = 0.7;
/// Significance level of every χ² test; the results hardly depend on it.
const LEVEL: f64 = 0.05;

/// The test of clusters for variation beyond the noise.
#[derive(Clone, Debug)]
pub struct ClusterTest {
    chi_square: ChiSquareThresholds,
    camera_noise: f64,
    tail_test: bool,
}

/// One χ² test of a cluster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Tail test: the sum of the variances beyond this number of directions is tested. The paper's test: the variance along
    /// the direction of this index, from 0, is tested.
    pub directions: usize,
    /// Tested variance times N − 1, counts².
    pub spread: f64,
    /// Largest spread that the noise explains, counts².
    pub limit: f64,
    /// Variance of the noise that the tested variance is compared with, counts².
    pub noise: f64,
}

impl Trial {
    /// Whether the noise explains the tested variance.
    pub fn is_noise(&self) -> bool {
        self.spread <= self.limit
    }

    /// The χ² statistic, to be compared with [`Trial::threshold`].
    pub fn statistic(&self) -> f64 {
        self.spread / self.noise
    }

    /// The upper quantile of χ² that the statistic is compared with.
    pub fn threshold(&self) -> f64 {
        self.limit / self.noise
    }
}

impl ClusterTest {
    /// A test for camera noise σ0 (counts): the tail test, or else the paper's test.
    pub fn new(camera_noise: f64, tail_test: bool) -> Self {
        Self { chi_square: ChiSquareThresholds::new(LEVEL), camera_noise, tail_test }
    }

    /// Camera noise σ0, counts.
    pub fn camera_noise(&self) -> f64 {
        self.camera_noise
    }

    /// Whether this is the tail test and not the paper's test.
    pub fn is_tail_test(&self) -> bool {
        self.tail_test
    }

    /// Number of directions, 0…3, in which `n` colors of these variances (counts², largest first) vary beyond the noise.
    pub fn directions(&mut self, n: f64, eigenvalues: [f64; 3]) -> usize {
        if self.tail_test {
            (0..3).find(|&k| self.trial(k, n, eigenvalues).is_noise()).unwrap_or(3)
        } else {
            (0..3).filter(|&k| !self.trial(k, n, eigenvalues).is_noise()).count()
        }
    }

    /// The tests by which [`ClusterTest::directions`] finds its result, in their order.
    pub fn trials(&mut self, n: f64, eigenvalues: [f64; 3]) -> Vec<Trial> {
        let mut trials = Vec::new();
        for directions in 0..3 {
            let trial = self.trial(directions, n, eigenvalues);
            trials.push(trial);
            // Variances are in descending order: all later ones are noise too.
            if trial.is_noise() {
                break;
            }
        }
        trials
    }

    fn trial(&mut self, directions: usize, n: f64, eigenvalues: [f64; 3]) -> Trial {
        let freedom = (n - 1.0).max(0.0);
        let (tested, noise, degrees): (f64, f64, usize) = if self.tail_test {
            let degrees = (3 - directions) * (freedom as usize).saturating_sub(directions);
            (eigenvalues[directions..].iter().sum(), (TAIL_SCALE * self.camera_noise).powi(2), degrees)
        } else {
            (eigenvalues[directions], self.camera_noise.powi(2), freedom as usize)
        };
        let limit = noise * self.chi_square.threshold(degrees);
        Trial { directions, spread: freedom * tested, limit, noise }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_papers_test_looks_at_one_variance_and_the_tail_test_at_all_that_are_left() {
        // 100 colors: χ²(99) at 5 % is 123.2, χ²(2·98) is 229.7.
        let paper = ClusterTest::new(2.0, false).trials(100.0, [40.0, 1.0, 1.0]);
        assert_eq!(paper.iter().map(Trial::is_noise).collect::<Vec<_>>(), [false, true]);
        assert!((paper[0].statistic() - 99.0 * 40.0 / 4.0).abs() < 1e-9);
        assert!((paper[0].threshold() - 123.2).abs() < 0.1, "{}", paper[0].threshold());
        let tail = ClusterTest::new(2.0, true).trials(100.0, [40.0, 1.0, 1.0]);
        assert_eq!(tail.iter().map(Trial::is_noise).collect::<Vec<_>>(), [false, true]);
        assert!((tail[1].statistic() - 99.0 * 2.0 / 1.96).abs() < 1e-9);
        assert!((tail[1].threshold() - 229.7).abs() < 0.3, "{}", tail[1].threshold());
    }

    proptest! {
        #[test]
        fn the_trials_give_the_number_of_directions(
            n in 2u32..4000, noise in 0.5f64..8.0, tail_test: bool,
            mut variances in prop::array::uniform3(0f64..60.0),
        ) {
            variances.sort_by(|a, b| b.total_cmp(a));
            let mut test = ClusterTest::new(noise, tail_test);
            let trials = test.trials(f64::from(n), variances);
            let beyond = trials.iter().filter(|trial| !trial.is_noise()).count();
            prop_assert_eq!(beyond, test.directions(f64::from(n), variances));
        }
    }
}
