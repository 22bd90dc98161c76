//! The regression around one highlight: what it adds along the matte line and above the plane, beyond what is smooth.

use nalgebra::{SMatrix, SVector};

/// Regressors: the terms of a polynomial of two variables of degree 4, 3 or 2, and the offset.
pub const QUARTIC: usize = 16;
pub const CUBIC: usize = 11;
pub const QUADRATIC: usize = 7;
/// Residuals beyond this many times their scale are left out.
const CUT: f64 = 3.5;
/// A highlight whose offsets are noise to more than this share says nothing.
const MAX_NOISE_SHARE: f64 = 0.5;
/// How far off the noise variance that is subtracted may be, as a share of it.
const NOISE_ERROR: f64 = 0.04;

/// A pixel as the regression sees it.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Its place, pixels.
    pub x: f64,
    /// Its row.
    pub y: f64,
    /// Its coordinates in the dichromatic plane, counts.
    pub along: f64,
    /// In the plane, off the matte line.
    pub offset: f64,
    /// Off the plane.
    pub height: f64,
}

/// What one highlight adds along the matte line and above the plane, per offset, each with its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// cotθ.
    pub along: (f64, f64),
    /// The tangent of the angle between the plane and where the highlight lies.
    pub height: (f64, f64),
}

/// Both slopes from one highlight's surroundings, with `N` regressors; how far `M` differ counts as error.
pub fn regress<const N: usize, const M: usize>(samples: &[Sample], sigma: f64) -> Option<Slopes> {
    if samples.len() < 4 * N {
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
    for _ in 0..5 {
        let fit = sums.solve::<N>(sigma)?;
        let check = sums.solve::<M>(sigma)?;
        for (residual, sample) in residuals.iter_mut().zip(&samples) {
            *residual = fit.residuals(sample);
        }
        let slopes = [fit.along, fit.height].map(|coefficients| coefficients[N - 1]);
        let checks = [check.along, check.height].map(|coefficients| coefficients[M - 1]);
        let scales: [f64; 2] = std::array::from_fn(|i| {
            let median = median(residuals.iter().map(|residual| residual[i]));
            (1.4826 * median).max(sigma * (1.0 + slopes[i].powi(2)).sqrt())
        });
        let settled = answer.is_some_and(|before| (before.along.0 - slopes[0]).abs() < 1e-4);
        let [along, height] = std::array::from_fn(|i| {
            let of_model = (slopes[i] - checks[i]).powi(2);
            let of_noise = (NOISE_ERROR * fit.noise / fit.information * slopes[i]).powi(2);
            (slopes[i], scales[i].powi(2) / fit.information + of_model + of_noise)
        });
        answer = Some(Slopes { along, height });
        if settled {
            break;
        }
        // Few pixels come or go, so the sums are kept and corrected.
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

/// Terms of a polynomial of degree 4 in x and y, and of degree 8: of the products of two of those.
const TERMS: usize = QUARTIC - 1;
const PRODUCTS: usize = 45;

/// Exponent of y and degree of each term, degree after degree.
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

/// The first `K` terms of a polynomial in x and y, degree after degree: 1, x, y, x², xy, y², …
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

/// What the normal equations of the samples taken are made of. Products of two terms of a polynomial are terms themselves, so
/// that 45 sums do for 120 entries.
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

/// Coefficients of the first `N` − 1 polynomial terms and of the offset, along the matte line and above the plane; the
/// offset's sum of squares beyond the polynomial, without its noise, and that of its noise.
struct Solution<const N: usize> {
    along: SVector<f64, N>,
    height: SVector<f64, N>,
    information: f64,
    noise: f64,
}

impl<const N: usize> Solution<N> {
    /// How far a sample lies off the fit, along the matte line and above the plane.
    fn residuals(&self, sample: &Sample) -> [f64; 2] {
        let terms = monomials::<TERMS>(sample.x, sample.y);
        [(&self.along, sample.along), (&self.height, sample.height)].map(|(coefficients, value)| {
            let smooth: f64 = terms[..N - 1].iter().zip(coefficients.iter()).map(|(t, c)| t * c).sum();
            (value - smooth - coefficients[N - 1] * sample.offset).abs()
        })
    }
}

impl Sums {
    /// Adds a sample `count` times.
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

    /// Least squares with the first `N` − 1 terms, corrected for the noise of the offset: nσ² is taken from its square.
    ///
    /// What that leaves of the offset beyond the polynomial is the information in it, the Schur complement of the corrected
    /// normal matrix.
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
                // A second light, faint and wide, bends the matte surface off the plane; the highlight lies at a slope of .2.
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
    fn offsets_that_are_noise_say_nothing() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                Sample { x, y, along: 100.0 + x, offset: f64::from(i * 7919 % 11) / 11.0, height: 0.0 }
            })
            .collect();
        assert!(regress::<QUARTIC, CUBIC>(&samples, 1.25).is_none());
    }
}
