//! In how many directions does a cluster vary beyond the noise? (section 5.2.1)
//!
//! The paper tests each eigenvalue alone: (N−1)·λ/σ0² against χ²(N−1). The largest eigenvalue of pure noise exceeds σ²
//! systematically, but as σ0 = 2σ there is a fourfold margin.
//!
//! Refined (`tail_test`): the statistic (N−1)·Σ_{i>k} λ_i / (0.7σ0)² ~ χ²((3−k)(N−1−k)) of *all* variances beyond the k-th
//! says whether k directions are enough. With σ 3 and σ0 = 2.5 the paper's test loses half of the coverage.

use super::ChiSquareTest;

/// Share of the noise variance against which tails are tested: (0.7σ0)² = (1.4σ)².
const TAIL_SCALE: f64 = 0.7;
/// Significance level of every χ² test; the results hardly depend on it.
const LEVEL: f64 = 0.05;

/// How clusters are told apart from noise.
#[derive(Clone, Debug)]
pub struct ClusterTest {
    chi_square: ChiSquareTest,
    camera_noise: f64,
    tail_test: bool,
}

/// One χ² test of a cluster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// What was asked, counted from 0: whether the variance beyond this many directions is noise (tail test), or whether
    /// the variance along the direction of this index is (the paper's).
    pub directions: usize,
    /// Variance tested times N − 1, counts².
    pub spread: f64,
    /// What noise may show at most, counts².
    pub limit: f64,
    /// Variance of the noise that it is held against, counts².
    pub noise: f64,
}

impl Trial {
    /// Whether the variance is no more than noise.
    pub fn is_noise(&self) -> bool {
        self.spread <= self.limit
    }

    /// The statistic, to be held against [`Trial::threshold`].
    pub fn statistic(&self) -> f64 {
        self.spread / self.noise
    }

    /// The upper quantile of χ² that the statistic is held against.
    pub fn threshold(&self) -> f64 {
        self.limit / self.noise
    }
}

impl ClusterTest {
    /// A test for camera noise σ0 (counts), the paper's or the tail test.
    pub fn new(camera_noise: f64, tail_test: bool) -> Self {
        Self { chi_square: ChiSquareTest::new(LEVEL), camera_noise, tail_test }
    }

    /// Camera noise σ0, counts.
    pub fn camera_noise(&self) -> f64 {
        self.camera_noise
    }

    /// Whether it is the tail test.
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

    /// The tests that [`ClusterTest::directions`] makes on the way to its answer, in their order.
    pub fn trials(&mut self, n: f64, eigenvalues: [f64; 3]) -> Vec<Trial> {
        let mut trials = Vec::new();
        for directions in 0..3 {
            let trial = self.trial(directions, n, eigenvalues);
            trials.push(trial);
            // Enough directions are enough; of ordered variances none is larger than the first that is noise.
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
        fn the_trials_lead_to_the_answer(
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
