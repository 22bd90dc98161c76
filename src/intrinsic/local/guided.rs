//! Rule `guided_amount`: the amount of surface reflection follows the picture's own edges, and no others.
//!
//! A guided filter (He, Sun & Tang 2010): around each pixel the amount is a linear function of a, the mean of J: p·a +
//! q with 0 ≤ p ≤ 1, fitted by least squares under a Gaussian of 2.5 px; p and q are then averaged under the same
//! Gaussian. So the body reflection has no edge that the photograph does not have, and no amount exceeds a. Where the
//! picture is a working picture, the lines of its pixels give the amounts of the photograph's pixels (the fast guided
//! filter, He & Sun 2015).

use super::desaturation_map::DesaturationMap;
use crate::raster::{Raster, Roi, blur};

/// Width of the Gaussian, pixels.
const GAUSSIAN_PX: f64 = 2.5;
/// The ε of the guided filter, which is added to the variance of a; variances of the noise of a band.
const REGULARIZATION: f32 = 4.0;
/// Slope and offset (counts of J) below which an amount is none: less than a file of 16 bits can hold. Far from highlights running means
/// leave such remains.
const NEGLIGIBLE: AmountLine = AmountLine { slope: 1e-5, offset: 1e-3 };
/// Share of usable pixels in the window below which there is no line.
const LEAST_SHARE: f32 = 1e-4;

/// The amount of surface reflection around a pixel as a linear function of a, counts of J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AmountLine {
    /// p: amount per count of a, 0…1.
    pub slope: f32,
    /// q: amount at a = 0, counts of J.
    pub offset: f32,
}

impl AmountLine {
    /// Whether the amount of every color is 0.
    pub fn is_none(self) -> bool {
        self.slope <= 0.0 && self.offset <= 0.0
    }

    /// This line, or the line without any amount where this one gives hardly any.
    fn without_remains(self) -> Self {
        let is_negligible = self.slope < NEGLIGIBLE.slope && self.offset.abs() < NEGLIGIBLE.offset;
        if is_negligible { Self::default() } else { self }
    }

    /// The amount of a color whose mean is `a`, counts of J.
    #[inline]
    pub fn amount(self, a: f32) -> f32 {
        (self.slope * a + self.offset).clamp(0.0, a.max(0.0))
    }
}

/// The lines of a window.
pub struct AmountLines {
    /// The window.
    pub roi: Roi,
    /// The line of each pixel; none far from usable pixels.
    of: Raster<Option<AmountLine>>,
}

impl AmountLines {
    /// The lines of `amounts`, counts of J, by the usable pixels. `sigma`: standard deviation of the noise of a band, counts.
    pub fn guided(map: &DesaturationMap, amounts: &Raster<f32>, sigma: f32) -> Self {
        let sums = blur(
            &map.raster(|index| {
                let (weight, a, amount) = (map.usable[index], map.colors[index].mean, amounts[index]);
                [weight, weight * a, weight * amount, weight * a * amount, weight * a * a]
            }),
            GAUSSIAN_PX,
        );
        let fitted = map.raster(|index| {
            let [weight, a, amount, both, square] = sums[index];
            if weight < LEAST_SHARE {
                return [0.0; 3];
            }
            let (a, amount) = (a / weight, amount / weight);
            let covariance = both / weight - a * amount;
            let variance = (square / weight - a * a).max(0.0) + REGULARIZATION * sigma * sigma;
            let slope = (covariance / variance.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            [1.0, slope, amount - slope * a]
        });
        let smooth = blur(&fitted, GAUSSIAN_PX);
        let of = map.raster(|index| {
            let [weight, slope, offset] = smooth[index];
            let line = || AmountLine { slope: slope / weight, offset: offset / weight };
            (weight > LEAST_SHARE).then(|| line().without_remains())
        });
        Self { roi: map.roi, of }
    }

    /// Lines that give each pixel of the window the amount that it has, whatever its color.
    pub fn constant(map: &DesaturationMap, amounts: &Raster<f32>) -> Self {
        let of = map.raster(|index| Some(AmountLine { slope: 0.0, offset: amounts[index] }));
        Self { roi: map.roi, of }
    }

    /// The lines that give each pixel of the window the share `kept` of its amount, 0…1.
    pub fn faded(mut self, kept: &Raster<f32>) -> Self {
        for (line, &share) in self.of.as_mut_slice().iter_mut().zip(kept.as_slice()) {
            let scaled =
                |line: AmountLine| AmountLine { slope: line.slope * share, offset: line.offset * share };
            *line = line.map(scaled);
        }
        self
    }

    /// The line of the pixel at `index` of the window.
    pub fn line(&self, index: usize) -> Option<AmountLine> {
        self.of.as_slice().get(index).copied().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_amount_is_not_negative_and_at_most_the_mean_of_the_color() {
        let line = AmountLine { slope: 0.5, offset: -10.0 };
        let is = |line: AmountLine, a: f32, amount: f32| (line.amount(a) - amount).abs() < 1e-6;
        assert!(is(line, 10.0, 0.0) && is(line, 40.0, 10.0) && is(line, -3.0, 0.0));
        assert!(is(AmountLine { slope: 1.0, offset: 5.0 }, 20.0, 20.0));
    }

    #[test]
    fn faded_lines_give_each_color_the_share_that_its_pixel_keeps() {
        let roi = Roi::around((3, 1), 0, |_| true).unwrap();
        let line = Some(AmountLine { slope: 0.5, offset: -10.0 });
        let lines = AmountLines { roi, of: Raster::from_vec(3, 1, vec![line, line, None]).unwrap() };
        let faded = lines.faded(&Raster::from_vec(3, 1, vec![0.25, 0.0, 1.0]).unwrap());
        let amount = |index: usize| faded.line(index).map(|line| line.amount(100.0));
        assert_eq!((amount(0), amount(1), amount(2)), (Some(10.0), Some(0.0), None));
    }

    #[test]
    fn the_remains_of_running_means_are_no_amount() {
        let cleaned = |slope: f32, offset: f32| AmountLine { slope, offset }.without_remains();
        assert!(cleaned(1e-7, -1e-6).is_none() && cleaned(0.0, 0.0).is_none());
        assert_eq!(cleaned(0.5, -40.0), AmountLine { slope: 0.5, offset: -40.0 });
        assert!(!cleaned(0.5, -40.0).is_none() && !cleaned(0.0, 0.01).is_none());
    }
}
