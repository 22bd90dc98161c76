//! The record of the local split, for pixels that no region explains (beyond section 6).
//!
//! Blobs are recorded one by one, up to the largest number; blobs with too few pixels are only counted. The figures that decided
//! about a pixel are kept beside the events, 8 bytes for each pixel of a rectangle; the limits are computed again.

use crate::raster::{Mask, Raster, Roi};

/// The figures that decided about one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LocalPoint {
    /// Logarithms of κ and of its median, in steps from the lowest; 0: there is no κ.
    ratios: [u16; 2],
    /// Texture in steps, with the flag [`Self::OUTSIDE`].
    texture: u16,
    /// The blob of the pixel: its number, 0 for none, [`LocalPoint::SMALL`].
    pub blob: u16,
}

impl LocalPoint {
    /// In place of a number: a blob that is only counted.
    pub const SMALL: u16 = u16::MAX;
    /// Largest number of a blob.
    pub const MOST_BLOBS: u16 = u16::MAX - 1;
    /// Least and largest κ.
    pub const RATIOS: (f32, f32) = (0.4, 12.0);
    /// Set for a lit pixel that no region explains.
    const OUTSIDE: u16 = 1 << 15;
    /// Number of steps of the ratios, and of texture.
    const RATIO_STEPS: f32 = 65534.0;
    const TEXTURE_STEPS: f32 = 32767.0;

    /// The figures of a pixel: κ and its median, where there are any, and texture.
    pub fn new(outside: bool, ratios: Option<[f32; 2]>, texture: f32) -> Self {
        let (low, high) = Self::RATIOS;
        let place = |ratio: f32| (ratio / low).ln() / (high / low).ln() * Self::RATIO_STEPS;
        // A cast of a float saturates.
        let texture = (texture.clamp(0.0, 1.0) * Self::TEXTURE_STEPS).round() as u16;
        Self {
            ratios: ratios.map_or([0; 2], |ratios| {
                ratios.map(|ratio| 1 + place(ratio).clamp(0.0, Self::RATIO_STEPS).round() as u16)
            }),
            texture: if outside { texture | Self::OUTSIDE } else { texture },
            blob: 0,
        }
    }

    /// Whether the pixel is lit and no region explains it.
    pub fn outside(&self) -> bool {
        self.texture & Self::OUTSIDE != 0
    }

    /// κ, the ratio of mean to chromatic part of the body reflection around the pixel, and the median of κ there; none where no
    /// pixel around has the hue of this one.
    pub fn ratios(&self) -> Option<[f32; 2]> {
        let (low, high) = Self::RATIOS;
        let ratio = |place: u16| low * (f32::from(place - 1) / Self::RATIO_STEPS * (high / low).ln()).exp();
        (self.ratios[0] > 0 && self.ratios[1] > 0).then(|| self.ratios.map(ratio))
    }

    /// Anticorrelation of surface and body reflection around the pixel, 0…1.
    pub fn texture(&self) -> f32 {
        f32::from(self.texture & !Self::OUTSIDE) / Self::TEXTURE_STEPS
    }
}

/// The record of the pixels of the local split.
#[derive(Clone, Debug, PartialEq)]
pub enum LocalRecord {
    /// The figures of the pixels of a rectangle; regions explain all other lit pixels.
    Points(LocalPoints),
    /// No pixel was judged: the mask of the lit pixels that no region explains.
    Outside(Mask),
}

/// The figures of the pixels of a rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalPoints {
    /// The rectangle.
    pub roi: Roi,
    /// The figures of each pixel.
    pub of: Raster<LocalPoint>,
}

impl LocalRecord {
    /// Whether a pixel is lit and no region explains it.
    pub fn outside(&self, pixel: usize) -> bool {
        match self {
            Self::Points(_) => self.point(pixel).is_some_and(LocalPoint::outside),
            Self::Outside(mask) => mask.as_slice().get(pixel).is_some_and(|outside| *outside),
        }
    }

    /// The figures of a pixel; none for a pixel that was not judged.
    pub fn point(&self, pixel: usize) -> Option<&LocalPoint> {
        let Self::Points(LocalPoints { roi, of }) = self else { return None };
        of.as_slice().get(roi.index(pixel)?)
    }

    /// The pixels of the blob with a number, ascending.
    pub fn blob(&self, blob: u16) -> Vec<u32> {
        let Self::Points(LocalPoints { roi, of }) = self else { return Vec::new() };
        let own = of.as_slice().iter().enumerate().filter(|(_, point)| blob != 0 && point.blob == blob);
        own.map(|(index, _)| roi.pixel(index) as u32).collect()
    }

    /// Memory of the record, bytes.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Points(points) => points.of.len() * size_of::<LocalPoint>(),
            Self::Outside(mask) => mask.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{LocalLimits, TextureFade};

    #[test]
    fn a_point_keeps_its_figures_as_exactly_as_they_are_told() {
        for ratio in [0.4f32, 1.234, 7.7, 12.0] {
            let point = LocalPoint::new(true, Some([ratio, 1.01 * ratio.min(11.0)]), 0.1234);
            let [kept, median] = point.ratios().unwrap();
            assert!((kept / ratio - 1.0).abs() < 1e-4, "{kept}");
            assert!((median / (1.01 * ratio.min(11.0)) - 1.0).abs() < 1e-4, "{median}");
            assert!((point.texture() - 0.1234).abs() < 1e-4 && point.outside());
        }
        let none = LocalPoint::new(false, None, 1.0);
        assert_eq!((none.ratios(), none.outside(), none.texture()), (None, false, 1.0));
        assert_eq!((LocalPoint::default().ratios(), LocalPoint::default().outside()), (None, false));
        assert_eq!(size_of::<LocalPoint>(), 8);
    }

    #[test]
    fn a_blob_is_found_by_its_number() {
        let roi = Roi::around((4, 3), 0, |pixel| [5, 6, 9, 10].contains(&pixel)).unwrap();
        let mut of = Raster::filled(2, 2, LocalPoint::new(true, None, 0.0));
        (of[1].blob, of[2].blob) = (7, 7);
        let record = LocalRecord::Points(LocalPoints { roi, of });
        assert_eq!(record.blob(7), [6, 9]);
        assert!(record.blob(0).is_empty());
        assert_eq!(record.point(6).map(|point| point.blob), Some(7));
        assert_eq!((record.point(0), record.point(11)), (None, None));
        assert!(record.outside(5) && !record.outside(0) && !record.outside(99));
        assert_eq!(record.bytes(), 4 * 8);
    }

    #[test]
    fn weight_falls_from_all_to_nothing_between_its_limits() {
        let limits =
            LocalLimits { texture: TextureFade { start: 0.1, width: 0.2 }, ..LocalLimits::default() };
        let weights = [0.0, 0.1, 0.2, 0.3, 1.0].map(|texture| limits.weight(texture));
        assert!(
            weights.iter().zip([1.0, 1.0, 0.5, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-6),
            "{weights:?}"
        );
    }
}
