//! The regression around one highlight: how much the coordinates along the matte line and above the plane change with the
//! offset from the matte line, beyond a smooth function of the position.

use nalgebra::{SMatrix, SVector};

/// Numbers of regressors: the terms of a polynomial in two variables of degree 4, 3 or 2, and the offset.
pub const QUARTIC: usize = 16;
pub const CUBIC: usize = 11;
pub const QUADRATIC: usize = 7;
/// Fewest samples per regressor.
const LEAST_SAMPLES_PER_REGRESSOR: usize = 4;
/// Largest number of fits, each without the pixels that the fit before left out.
const MOST_FITS: usize = 5;
/// Change of cotθ below which another fit changes nothing.
const SETTLED_COTANGENT: f64 = 1e-4;
/// Standard deviation of a normal distribution per median of the absolute values.
const SIGMA_PER_MEDIAN: f64 = 1.4826;
/// Pixels with a residual of more than this many times the residuals' scale are left out.
const CUT: f64 = 3.5;
/// Largest share of the noise in the variance of the offsets; beyond it the regression fails.
const MAX_NOISE_SHARE: f64 = 0.5;
/// Relative standard error of the noise variance that is subtracted.
const NOISE_ERROR: f64 = 0.04;

/// A pixel: its position in the picture, and the coordinates of its color in the dichromatic plane.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Column, pixels.
    pub x: f64,
    /// Row, pixels.
    pub y: f64,
    /// Coordinate along the matte line, from black, counts.
    pub along: f64,
    /// Coordinate in the plane, across the matte line, counts.
    pub offset: f64,
    /// Distance from the plane, with sign, counts.
    pub height: f64,
}

/// Change of two coordinates per offset under one highlight, each with its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// Along the matte line: cotθ, and its variance.
    pub along: (f64, f64),
    /// Above the plane: the tangent of the angle between the plane and the highlight, and its variance.
    pub height: (f64, f64),
}

/// Both slopes by a regression with `N` regressors over a highlight and its surroundings. The difference from a regression with
/// `M` regressors counts as an error. `sigma`: noise of a band, counts. `None` with too few samples, or where the offsets are
/// mostly noise.
pub fn regress<const N: usize, const M: usize>(samples: &[Sample], sigma: f64) -> Option<Slopes> {
    if samples.len() < LEAST_SAMPLES_PER_REGRESSOR * N {
        return None;
    }
    let samples = centered(samples);
    let mut sums = Sums::default();
    for sample in &samples {
        sums.add(sample, 1.0);
    }
    let mut taken = vec![true; samples.len()];
    let mut residuals = vec![[0.0; 2]; samples.len()];
    let mut answer: Option<Slopes> = None;
    for _ in 0..MOST_FITS {
        let fit = sums.solve::<N>(sigma)?;
        let check = sums.solve::<M>(sigma)?;
        for (residual, sample) in residuals.iter_mut().zip(&samples) {
            *residual = fit.residuals(sample);
        }
        let slopes = [fit.along, fit.height].map(|coefficients| coefficients[N - 1]);
        let checks = [check.along, check.height].map(|coefficients| coefficients[M - 1]);
        let scales: [f64; 2] = std::array::from_fn(|i| {
            let median = median(residuals.iter().map(|residual| residual[i]));
            (SIGMA_PER_MEDIAN * median).max(sigma * (1.0 + slopes[i].powi(2)).sqrt())
        });
        let settled = answer.is_some_and(|before| (before.along.0 - slopes[0]).abs() < SETTLED_COTANGENT);
        let [along, height] = std::array::from_fn(|i| {
            let of_model = (slopes[i] - checks[i]).powi(2);
            let of_noise = (NOISE_ERROR * fit.noise / fit.information * slopes[i]).powi(2);
            (slopes[i], scales[i].powi(2) / fit.information + of_model + of_noise)
        });
        answer = Some(Slopes { along, height });
        if settled {
            break;
        }
        // Few pixels are added or removed per iteration, so the sums are corrected and not computed anew.
        for ((sample, residual), taken) in samples.iter().zip(&residuals).zip(&mut taken) {
            let take = (0..2).all(|i| residual[i] < CUT * scales[i]);
            if take != *taken {
                *taken = take;
                sums.add(sample, if take { 1.0 } else { -1.0 });
            }
        }
    }
    answer
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The samples with positions from −1 to 1 about their mean, which keeps the normal equations well conditioned.
fn centered(samples: &[Sample]) -> Vec<Sample> {
    let n = samples.len() as f64;
    let center = samples.iter().fold((0.0, 0.0), |c, s| (c.0 + s.x / n, c.1 + s.y / n));
    let from_center = |s: &Sample| (s.x - center.0, s.y - center.1);
    let spread = samples.iter().map(from_center).map(|(x, y)| x.abs().max(y.abs())).fold(1.0, f64::max);
    let scaled = |s: &Sample| Sample { x: (s.x - center.0) / spread, y: (s.y - center.1) / spread, ..*s };
    samples.iter().map(scaled).collect()
}

/// Number of terms of a polynomial of degree 4 in x and y, and of a polynomial of degree 8 (the products of two such terms).
const TERMS: usize = QUARTIC - 1;
const PRODUCTS: usize = 45;

/// Exponent of y and degree of each term, by ascending degree.
const fn exponents() -> [(usize, usize); TERMS] {
    let mut list = [(0, 0); TERMS];
    let (mut at, mut degree) = (0, 0);
    while degree <= 4 {
        let mut of_y = 0;
        while of_y <= degree {
            list[at] = (of_y, degree);
            at += 1;
            of_y += 1;
        }
        degree += 1;
    }
    list
}

const EXPONENTS: [(usize, usize); TERMS] = exponents();

/// The first `K` terms of a polynomial in x and y, by ascending degree: 1, x, y, x², xy, y², …
fn monomials<const K: usize>(x: f64, y: f64) -> [f64; K] {
    let mut terms = [1.0; K];
    let (mut at, mut degree) = (1, 1);
    while at < K {
        let before = at - degree;
        for of_y in 0..=degree {
            terms[at + of_y] = if of_y == 0 { terms[before] * x } else { terms[before + of_y - 1] * y };
        }
        at += degree + 1;
        degree += 1;
    }
    terms
}

/// The sums over the samples from which the normal equations are built. Products of two terms of a polynomial are themselves
/// terms of a polynomial, so that 45 sums suffice for 120 entries of the matrix.
struct Sums {
    /// Σ of the terms up to degree 8.
    terms: [f64; PRODUCTS],
    /// Σ offset · term, and Σ offset².
    offset: [f64; TERMS],
    offset_square: f64,
    /// Σ along · term, and Σ along · offset.
    along: [f64; TERMS],
    along_offset: f64,
    /// Σ height · term, and Σ height · offset.
    height: [f64; TERMS],
    height_offset: f64,
}

impl Default for Sums {
    fn default() -> Self {
        let terms = [0.0; PRODUCTS];
        let none = [0.0; TERMS];
        Self {
            terms,
            offset: none,
            offset_square: 0.0,
            along: none,
            along_offset: 0.0,
            height: none,
            height_offset: 0.0,
        }
    }
}

/// Solution of the normal equations: coefficients of the first `N` − 1 polynomial terms and of the offset (the last one).
struct Solution<const N: usize> {
    /// Coefficients for the coordinate along the matte line.
    along: SVector<f64, N>,
    /// Coefficients for the height above the plane.
    height: SVector<f64, N>,
    /// Sum of squares of the offset beyond the polynomial, without its noise, counts².
    information: f64,
    /// Sum of squares of the offset's noise, counts².
    noise: f64,
}

impl<const N: usize> Solution<N> {
    /// Absolute residuals of a sample along the matte line and above the plane, counts.
    fn residuals(&self, sample: &Sample) -> [f64; 2] {
        let terms = monomials::<TERMS>(sample.x, sample.y);
        [(&self.along, sample.along), (&self.height, sample.height)].map(|(coefficients, value)| {
            let smooth: f64 = terms[..N - 1].iter().zip(coefficients.iter()).map(|(t, c)| t * c).sum();
            (value - smooth - coefficients[N - 1] * sample.offset).abs()
        })
    }
}

impl Sums {
    /// Adds a sample `count` times; −1 removes it.
    fn add(&mut self, sample: &Sample, count: f64) {
        let terms = monomials::<PRODUCTS>(sample.x, sample.y);
        let [offset, along, height] = [sample.offset, sample.along, sample.height].map(|value| count * value);
        for (sum, term) in self.terms.iter_mut().zip(&terms) {
            *sum += count * term;
        }
        for (sum, term) in self.offset.iter_mut().zip(&terms) {
            *sum += offset * term;
        }
        for (sum, term) in self.along.iter_mut().zip(&terms) {
            *sum += along * term;
        }
        for (sum, term) in self.height.iter_mut().zip(&terms) {
            *sum += height * term;
        }
        self.offset_square += offset * sample.offset;
        self.along_offset += along * sample.offset;
        self.height_offset += height * sample.offset;
    }

    /// An entry of the normal matrix with `n` regressors, the offset last.
    fn entry(&self, n: usize, i: usize, j: usize) -> f64 {
        match (i + 1 == n, j + 1 == n) {
            (true, true) => self.offset_square,
            (true, false) => self.offset[j],
            (false, true) => self.offset[i],
            (false, false) => {
                let degree = EXPONENTS[i].1 + EXPONENTS[j].1;
                self.terms[degree * (degree + 1) / 2 + EXPONENTS[i].0 + EXPONENTS[j].0]
            }
        }
    }

    /// Least squares with the first `N` − 1 terms and the offset, corrected for the offset's noise: nσ² is subtracted from the
    /// offset's sum of squares.
    ///
    /// The information is the Schur complement of the corrected normal matrix: what remains of the offset's sum of squares
    /// beyond the polynomial. `None` where the matrix is not positive definite or the offset is mostly noise.
    fn solve<const N: usize>(&self, sigma: f64) -> Option<Solution<N>> {
        let mut normal = SMatrix::<f64, N, N>::from_fn(|i, j| self.entry(N, i, j));
        let right = |terms: &[f64; TERMS], offset: f64| {
            SVector::<f64, N>::from_fn(|i, _| if i + 1 == N { offset } else { terms[i] })
        };
        let noise = sigma * sigma * self.terms[0];
        normal[(N - 1, N - 1)] -= noise;
        let factor = normal.cholesky()?;
        let mut last = SVector::<f64, N>::zeros();
        last[N - 1] = 1.0;
        let information = 1.0 / factor.solve(&last)[N - 1];
        if noise > MAX_NOISE_SHARE * (information + noise) {
            return None;
        }
        let along = factor.solve(&right(&self.along, self.along_offset));
        let height = factor.solve(&right(&self.height, self.height_offset));
        Some(Solution { along, height, information, noise })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_highlight_on_a_curved_body_gives_its_angle() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                let body = 150.0 + 2.0 * x - 0.05 * (x - 10.0).powi(2) - 0.03 * y * y + 0.001 * x * y * y;
                let offset = 60.0 * (-((x - 15.0).powi(2) + (y - 14.0).powi(2)) / 30.0).exp();
                // A second light, faint and wide, moves the matte pixels off the plane; the highlight has a slope of 0.2.
                let faint = 3.0 + 0.1 * x - 0.002 * x * y;
                Sample {
                    x,
                    y,
                    along: body + 1.7 * offset,
                    offset: offset + faint,
                    height: 0.2 * offset - faint,
                }
            })
            .collect();
        let Slopes { along, height } = regress::<QUARTIC, CUBIC>(&samples, 0.01).unwrap();
        assert!((along.0 - 1.7).abs() < 1e-3 && along.1 < 1e-4, "{along:?}");
        assert!((height.0 - 0.2).abs() < 1e-3 && height.1 < 1e-4, "{height:?}");
    }

    #[test]
    fn offsets_that_are_noise_give_no_slope() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                Sample { x, y, along: 100.0 + x, offset: f64::from(i * 7919 % 11) / 11.0, height: 0.0 }
            })
            .collect();
        assert!(regress::<QUARTIC, CUBIC>(&samples, 1.25).is_none());
    }
}
