//! Body reflection, surface reflection and noise of one pixel: as measured, and as the result has them.

use super::ResultSnapshot;
use super::vector::dot;
use crate::raster::PixelIndex;
use crate::reflection::{Components, ReflectionTransform};

/// Amounts of body reflection, surface reflection and noise of a pixel, counts (equation 13).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amounts {
    /// m_b, counts.
    pub body: f32,
    /// m_s, counts; none where the pixel's region has no dichromatic plane.
    pub surface: Option<f32>,
    /// ε, distance from the dichromatic plane, counts.
    pub noise: f32,
}

/// The amounts of a pixel twice, because the result has no surface reflection below the noise (section 6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelAmounts {
    /// The amounts of the color as measured, by the transform of the pixel's region; none where body and surface reflection have
    /// no transform.
    pub measured: Option<Amounts>,
    /// The amounts in the result: after surface reflection below the noise was counted as none.
    pub result: Amounts,
}

/// Difference of measured and resulting amounts from which the two are told apart, counts: half a step of the shown decimals.
const SHOWN_DIFFERENCE: f32 = 0.05;

impl PixelAmounts {
    /// The amounts of a pixel; none in no region.
    pub fn of(shown: &ResultSnapshot, pixel: PixelIndex) -> Option<Self> {
        let intrinsic = &shown.analysis.intrinsic;
        let label = *shown.labels().as_slice().get(pixel.index())?;
        let region = intrinsic.regions.get(usize::from(label).checked_sub(1)?)?;
        let vector = |v: [f64; 3]| v.map(|band| band as f32);
        let result = Amounts {
            // The component along a unit vector is the amount.
            body: dot(intrinsic.body[pixel.index()], vector(region.body)),
            surface: region.surface.map(|surface| dot(intrinsic.surface[pixel.index()], vector(surface))),
            noise: intrinsic.noise[pixel.index()],
        };
        let transform =
            region.surface.and_then(|surface| ReflectionTransform::new(&region.body.into(), &surface.into()));
        let origin = intrinsic.ambient.subtracted.map_or([0.0; 3], vector);
        let color = shown.picture.photo.image.pixels[pixel.index()];
        let measured = transform.map(|transform| {
            let from_origin = std::array::from_fn(|band| color[band] - origin[band]);
            let Components { body, surface, noise } = transform.split(from_origin);
            Amounts { body, surface: Some(surface), noise }
        });
        Some(Self { measured, result })
    }

    /// The measured amounts, where they differ from those of the result by what a person can see in numbers of one decimal.
    pub fn different_measured(&self) -> Option<Amounts> {
        let differs = |a: f32, b: f32| (a - b).abs() >= SHOWN_DIFFERENCE;
        self.measured.filter(|measured| {
            let surface = measured.surface.zip(self.result.surface);
            differs(measured.body, self.result.body) || surface.is_some_and(|(a, b)| differs(a, b))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_that_are_shown_alike_are_no_difference() {
        let amounts = |body: f32, surface: f32| Amounts { body, surface: Some(surface), noise: 0.2 };
        let of = |measured: Amounts, result: Amounts| PixelAmounts { measured: Some(measured), result };
        assert_eq!(of(amounts(10.0, 2.0), amounts(10.01, 2.0)).different_measured(), None);
        let cut = of(amounts(166.6, 4.6), amounts(170.7, 0.0));
        assert_eq!(cut.different_measured(), Some(amounts(166.6, 4.6)));
        assert_eq!(PixelAmounts { measured: None, result: amounts(1.0, 0.0) }.different_measured(), None);
    }
}
