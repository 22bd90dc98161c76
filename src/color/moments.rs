//! Number, sum and sum of outer products of the colors of a cluster. Mean and covariance follow from them, and the moments of
//! two clusters merge in O(1).

use super::Vec3;
use nalgebra::Matrix3;

/// Zeroth to second moments of a color cluster.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Number of pixels, or the sum of their weights.
    pub n: f64,
    /// Σ C.
    pub sum: [f64; 3],
    /// Σ C·Cᵀ: RR, RG, RB, GG, GB, BB.
    pub outer: [f64; 6],
}

impl Moments {
    /// Adds one pixel.
    #[inline]
    pub fn add(&mut self, color: [f32; 3]) {
        self.add_weighted(color, 1.0);
    }

    /// Adds one pixel with a weight.
    #[inline]
    pub fn add_weighted(&mut self, color: [f32; 3], weight: f64) {
        let [r, g, b] = color.map(f64::from);
        let (wr, wg, wb) = (weight * r, weight * g, weight * b);
        self.n += weight;
        self.sum[0] += wr;
        self.sum[1] += wg;
        self.sum[2] += wb;
        self.outer[0] += wr * r;
        self.outer[1] += wr * g;
        self.outer[2] += wr * b;
        self.outer[3] += wg * g;
        self.outer[4] += wg * b;
        self.outer[5] += wb * b;
    }

    /// The moments of both clusters together.
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        Self {
            n: self.n + other.n,
            sum: std::array::from_fn(|i| self.sum[i] + other.sum[i]),
            outer: std::array::from_fn(|i| self.outer[i] + other.outer[i]),
        }
    }

    /// Mean color; black for an empty cluster.
    pub fn mean(&self) -> Vec3 {
        if self.n > 0.0 { Vec3::from(self.sum) / self.n } else { Vec3::zeros() }
    }

    /// Sample covariance (divided by n − 1), counts²; zero for n ≤ 1.
    pub fn covariance(&self) -> Matrix3<f64> {
        if self.n <= 1.0 {
            return Matrix3::zeros();
        }
        let m = self.mean();
        let entry = |k: usize, i: usize, j: usize| (self.outer[k] - self.n * m[i] * m[j]) / (self.n - 1.0);
        let (rr, rg, rb) = (entry(0, 0, 0), entry(1, 0, 1), entry(2, 0, 2));
        let (gg, gb, bb) = (entry(3, 1, 1), entry(4, 1, 2), entry(5, 2, 2));
        Matrix3::new(rr, rg, rb, rg, gg, gb, rb, gb, bb)
    }
}

impl FromIterator<[f32; 3]> for Moments {
    fn from_iter<I: IntoIterator<Item = [f32; 3]>>(colors: I) -> Self {
        let mut moments = Self::default();
        for color in colors {
            moments.add(color);
        }
        moments
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn mean_and_covariance_of_a_known_cluster() {
        let moments: Moments = [[1.0, 0.0, 5.0], [3.0, 4.0, 5.0]].into_iter().collect();
        assert_eq!(moments.mean(), Vec3::new(2.0, 2.0, 5.0));
        let covariance = moments.covariance();
        assert_eq!(covariance[(0, 0)], 2.0);
        assert_eq!(covariance[(0, 1)], 4.0);
        assert_eq!(covariance[(1, 1)], 8.0);
        assert_eq!(covariance[(2, 2)], 0.0);
        assert_eq!(Moments::default().covariance(), Matrix3::zeros());
    }

    proptest! {
        #[test]
        fn merging_is_adding_all_pixels(
            colors in prop::collection::vec(prop::array::uniform3(0f32..255.0), 2..40),
            cut in 0usize..40,
        ) {
            let cut = cut.min(colors.len());
            let whole: Moments = colors.iter().copied().collect();
            let left: Moments = colors[..cut].iter().copied().collect();
            let right: Moments = colors[cut..].iter().copied().collect();
            let difference = left.merged(&right).covariance() - whole.covariance();
            prop_assert!(difference.abs().max() < 1e-6);
        }
    }
}
