//! The record of the local split, for pixels that no region explains (beyond section 6).
//!
//! The figures that decided about a pixel are kept beside the events, 20 bytes for each pixel of a rectangle; the limits are computed
//! again. Clipped blobs are recorded one by one, up to the largest number.

use super::HighlightTerms;
use crate::raster::{Mask, PixelIndex, Raster, Roi};

/// The figures that decided about one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalPoint {
    /// Logarithms of κ and of the median of a/c, in steps from the lowest; 0: there is no κ.
    ratios: [u16; 2],
    /// The observations in steps of [`Self::TERM_STEP`].
    terms: [i8; 4],
    /// The averaged log odds in steps of [`Self::ODDS_STEP`].
    odds: i16,
    /// The clipped blob of the pixel: its number, 0 for none; with the flags [`Self::OUTSIDE`] and [`Self::SECOND_LAMP`].
    blob: u16,
    /// Angle by which the chromaticity of body reflection was changed, in steps of [`Self::TURN_STEP_DEG`].
    turn: u16,
    /// Amount of surface reflection that was found, counts of J.
    pub amount: f32,
}

/// What a pixel was judged by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalFigures {
    /// κ and the median of a/c around the pixel, or of its region; none where no pixel of the picture has the hue of this one.
    pub ratios: Option<[f32; 2]>,
    /// The observations, log odds.
    pub terms: HighlightTerms,
    /// Log odds of a highlight, averaged, without those of the picture.
    pub odds: f32,
    /// Amount of surface reflection, counts of J.
    pub amount: f32,
    /// Angle by which the chromaticity of body reflection was changed towards that of the pixels around, degrees.
    pub turn_deg: f32,
}

impl LocalPoint {
    /// Largest number of a blob.
    pub const MOST_BLOBS: u16 = Self::SECOND_LAMP - 1;
    /// Least and largest κ.
    pub const RATIOS: (f32, f32) = (0.4, 12.0);
    /// Set for a lit pixel that no region explains.
    const OUTSIDE: u16 = 1 << 15;
    /// Set for a pixel that the second lamp lights.
    const SECOND_LAMP: u16 = 1 << 14;
    /// Number of steps of the ratios.
    const RATIO_STEPS: f32 = 65534.0;
    /// Log odds of one step of an observation: the range is −7.9…7.9.
    const TERM_STEP: f32 = 1.0 / 16.0;
    /// Log odds of one step of the averaged log odds: the range is −32…32.
    const ODDS_STEP: f32 = 1.0 / 1024.0;
    /// Angle of one step of the change of chromaticity, degrees.
    const TURN_STEP_DEG: f32 = 0.01;

    /// The figures of a pixel. `outside`: whether the pixel is lit and no region explains it.
    pub fn new(outside: bool, figures: &LocalFigures) -> Self {
        let (low, high) = Self::RATIOS;
        let place = |ratio: f32| (ratio / low).ln() / (high / low).ln() * Self::RATIO_STEPS;
        let HighlightTerms { chroma, independence, brightness, edges } = figures.terms;
        // A cast of a float saturates.
        let term = |log_odds: f32| (log_odds / Self::TERM_STEP).round() as i8;
        Self {
            ratios: figures.ratios.map_or([0; 2], |ratios| {
                ratios.map(|ratio| 1 + place(ratio).clamp(0.0, Self::RATIO_STEPS).round() as u16)
            }),
            terms: [chroma, independence, brightness, edges].map(term),
            odds: (figures.odds / Self::ODDS_STEP).round() as i16,
            blob: if outside { Self::OUTSIDE } else { 0 },
            turn: Self::turn_steps(figures.turn_deg),
            amount: figures.amount,
        }
    }

    /// Whether the pixel is lit and no region explains it.
    pub fn outside(&self) -> bool {
        self.blob & Self::OUTSIDE != 0
    }

    /// Number of the clipped blob that the pixel belongs to; 0 for none.
    pub fn blob(&self) -> u16 {
        self.blob & Self::MOST_BLOBS
    }

    /// Whether the second lamp lights the pixel.
    pub fn has_second_lamp(&self) -> bool {
        self.blob & Self::SECOND_LAMP != 0
    }

    /// Makes the second lamp light the pixel, or not.
    pub fn set_second_lamp(&mut self, second: bool) {
        self.blob = (self.blob & !Self::SECOND_LAMP) | if second { Self::SECOND_LAMP } else { 0 };
    }

    /// Makes the pixel a part of a clipped blob, by the number of the blob.
    pub fn set_blob(&mut self, number: u16) {
        self.blob = (self.blob & !Self::MOST_BLOBS) | number.min(Self::MOST_BLOBS);
    }

    /// Records the angle by which the chromaticity of body reflection was changed, degrees.
    pub fn set_turn(&mut self, turn_deg: f32) {
        self.turn = Self::turn_steps(turn_deg);
    }

    /// An angle in steps of [`Self::TURN_STEP_DEG`]. A cast of a float saturates.
    fn turn_steps(turn_deg: f32) -> u16 {
        (turn_deg / Self::TURN_STEP_DEG).round() as u16
    }

    /// The figures, as exactly as they were kept.
    pub fn figures(&self) -> LocalFigures {
        let (low, high) = Self::RATIOS;
        let ratio = |place: u16| low * (f32::from(place - 1) / Self::RATIO_STEPS * (high / low).ln()).exp();
        let [chroma, independence, brightness, edges] =
            self.terms.map(|steps| f32::from(steps) * Self::TERM_STEP);
        LocalFigures {
            ratios: (self.ratios[0] > 0 && self.ratios[1] > 0).then(|| self.ratios.map(ratio)),
            terms: HighlightTerms { chroma, independence, brightness, edges },
            odds: f32::from(self.odds) * Self::ODDS_STEP,
            amount: self.amount,
            turn_deg: f32::from(self.turn) * Self::TURN_STEP_DEG,
        }
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

/// A band that was restored by the hue around, because it alone is clipped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestoredBand {
    /// The pixel.
    pub pixel: PixelIndex,
    /// The band, 0 to 2.
    pub band: u8,
    /// The value, counts above the ambient light.
    pub value: f32,
}

/// The figures of the pixels of a rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalPoints {
    /// The rectangle.
    pub roi: Roi,
    /// The figures of each pixel.
    pub of: Raster<LocalPoint>,
    /// The bands that were restored by hue, by pixel.
    pub restored: Vec<RestoredBand>,
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
        let Self::Points(LocalPoints { roi, of, .. }) = self else { return None };
        of.as_slice().get(roi.index(pixel)?)
    }

    /// The band of a pixel that was restored by hue; none where none was.
    pub fn restored(&self, pixel: usize) -> Option<&RestoredBand> {
        let Self::Points(LocalPoints { restored, .. }) = self else { return None };
        let found = restored.binary_search_by_key(&PixelIndex::from_index(pixel), |band| band.pixel);
        found.ok().map(|index| &restored[index])
    }

    /// The pixels of the blob with a number, ascending.
    pub fn blob(&self, blob: u16) -> Vec<u32> {
        let Self::Points(LocalPoints { roi, of, .. }) = self else { return Vec::new() };
        let own = of.as_slice().iter().enumerate().filter(|(_, point)| blob != 0 && point.blob() == blob);
        own.map(|(index, _)| roi.pixel(index) as u32).collect()
    }

    /// Memory of the record, bytes.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Points(points) => {
                points.of.len() * size_of::<LocalPoint>() + points.restored.len() * size_of::<RestoredBand>()
            }
            Self::Outside(mask) => mask.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_keeps_its_figures_as_exactly_as_they_are_told() {
        for ratio in [0.4f32, 1.234, 7.7, 12.0] {
            let median = 1.01 * ratio.min(11.0);
            let terms = HighlightTerms { chroma: -1.5, independence: 3.2, brightness: 0.0, edges: 2.97 };
            let figures = LocalFigures {
                ratios: Some([ratio, median]),
                terms,
                odds: -4.321,
                amount: 12.5,
                turn_deg: 2.346,
            };
            let point = LocalPoint::new(true, &figures);
            let kept = point.figures();
            let ratios = kept.ratios.unwrap();
            assert!((ratios[0] / ratio - 1.0).abs() < 1e-4 && (ratios[1] / median - 1.0).abs() < 1e-4);
            assert!((kept.odds + 4.321).abs() < 1e-3 && (kept.terms.sum() - terms.sum()).abs() < 0.1);
            assert!(
                point.outside() && (kept.amount - 12.5).abs() < 1e-6 && (kept.turn_deg - 2.346).abs() < 0.006
            );
        }
        let none = LocalPoint::new(false, &LocalFigures::default());
        assert_eq!((none.figures(), none.outside(), none.blob()), (LocalFigures::default(), false, 0));
        assert_eq!(LocalPoint::default(), none);
        assert_eq!(size_of::<LocalPoint>(), 20);
    }

    #[test]
    fn a_blob_is_found_by_its_number() {
        let roi = Roi::around((4, 3), 0, |pixel| [5, 6, 9, 10].contains(&pixel)).unwrap();
        let mut of = Raster::filled(2, 2, LocalPoint::new(true, &LocalFigures::default()));
        of[1].set_blob(7);
        of[2].set_blob(7);
        let record = LocalRecord::Points(LocalPoints { roi, of, restored: Vec::new() });
        assert_eq!(record.blob(7), [6, 9]);
        assert!(record.blob(0).is_empty());
        assert_eq!(record.point(6).map(LocalPoint::blob), Some(7));
        assert_eq!((record.point(0), record.point(11)), (None, None));
        assert!(record.outside(5) && record.outside(6) && !record.outside(0) && !record.outside(99));
        assert_eq!(record.bytes(), 4 * 20);
    }
}
