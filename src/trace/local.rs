//! Where the model does not hold: what the local split decided there (beyond section 6).
//!
//! Blobs are recorded one by one, as far as their numbers go; smaller ones than may count are only counted. What each pixel was
//! judged by is kept beside the events, 8 bytes for a pixel of the window that was looked at; its limits are computed again.

use crate::raster::{Mask, Raster, Roi};

/// A step of the local split.
#[derive(Clone, Debug, PartialEq)]
pub enum LocalDecision {
    /// It begins, or why it does not.
    Began(Box<LocalBegan>),
    /// Candidate highlights were found that do not lie in what holds; those large enough follow.
    Blobs {
        /// How many in all.
        found: u32,
        /// Those of too few pixels, and the pixels in them.
        small: u32,
        /// See there.
        small_pixels: u32,
        /// Fewest pixels of one that may count.
        least: u32,
    },
    /// A candidate highlight was judged (hysteresis).
    Blob(BlobJudged),
    /// Are there highlights at all, under this light?
    Plausibility(Box<PlausibilityTested>),
    /// A blob of clipped pixels was filled from what is around it, or not.
    Repair(RepairTried),
}

impl LocalDecision {
    /// The number of the blob that it is about, where it is about one.
    pub fn blob(&self) -> Option<u16> {
        match self {
            Self::Blob(judged) => Some(judged.blob),
            Self::Repair(tried) => Some(tried.blob),
            _ => None,
        }
    }
}

/// What [`LocalDecision::Began`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalBegan {
    /// Whether it begins.
    pub start: LocalStart,
    /// Lit pixels outside of what holds.
    pub pixels: u32,
    /// All lit pixels.
    pub lit: u32,
    /// Fewest outside that are worth it.
    pub least: u32,
    /// The light, unit.
    pub light: Option<[f64; 3]>,
    /// Where colors are measured from: black, or the ambient light, counts.
    pub origin: [f64; 3],
    /// What pixels are held against.
    pub limits: LocalLimits,
    /// Whether texture is asked for.
    pub texture_test: bool,
    /// Whether whole blobs count, or single pixels.
    pub hysteresis: bool,
    /// Whether clipped pixels are filled.
    pub clip_repair: bool,
}

/// Whether pixels are split by their surroundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LocalStart {
    /// They are.
    Begins,
    /// It is switched off.
    Off,
    /// Too few lie outside of what holds.
    Few,
    /// The light is not known, or has nothing of one band.
    NoLight,
}

/// What pixels of the local split are held against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalLimits {
    /// Least mean of J = I / (√3 s) that has a hue, counts.
    pub mean: f32,
    /// Least chromatic part of J that has a hue, counts.
    pub chroma: f32,
    /// Texture up to which all of a pixel's surface reflection counts, and from which on none does.
    pub texture: [f32; 2],
    /// Texture below which a pixel can be of a strong core.
    pub core_texture: f32,
    /// Standard deviation of a band's noise, counts.
    pub sigma: f32,
}

impl LocalLimits {
    /// The share of its surface reflection that counts, 0…1, by texture.
    pub fn weight(&self, texture: f32) -> f32 {
        let [all, none] = self.texture;
        1.0 - ((texture - all) / (none - all)).clamp(0.0, 1.0)
    }
}

/// What [`LocalDecision::Blob`] says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlobJudged {
    /// Its number, from 1; repaired blobs go on counting.
    pub blob: u16,
    /// Its first pixel.
    pub pixel: u32,
    /// Its pixels, clipped ones apart.
    pub pixels: u32,
    /// Clipped pixels that hang together with it.
    pub clipped: u32,
    /// Pixels above the variation of their hue.
    pub strong: u32,
    /// Those of them that do not look like texture.
    pub calm: u32,
    /// Those of them that a square of 3 × 3 fits into: the core.
    pub core: u32,
    /// Whether it is a highlight: it has a core, or clipped pixels.
    pub kept: bool,
}

/// What [`LocalDecision::Plausibility`] says. What was not measured is none: the first doubt ends it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlausibilityTested {
    /// Share of the votes for the light, 0…1; none where regions that hold vouch for it, or it was given, or no votes are asked for.
    pub share: Option<f64>,
    /// Share of all light there that would be surface reflection, 0…1.
    pub surface: Option<f64>,
    /// Share of the strong highlight pixels that outshine the body under them, 0…1, and how many strong ones there are.
    pub outshining: Option<(f64, u32)>,
    /// Up to where each may go; of the share, from where on.
    pub limits: PlausibilityLimits,
    /// Why nothing is split; none: highlights are believed.
    pub reject_reason: Option<RejectReason>,
}

/// See [`PlausibilityTested`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlausibilityLimits {
    /// Least share of the votes, 0…1.
    pub share: f64,
    /// Largest share of surface reflection, 0…1.
    pub surface: f64,
    /// Largest share of what outshines the body, 0…1.
    pub outshining: f64,
}

/// Why no highlight is believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RejectReason {
    /// Small highlights do not speak for the light.
    NoVote,
    /// Too much would be surface reflection.
    TooMuch,
    /// Highlights outshine the body: they are white things.
    Outshining,
}

impl RejectReason {
    /// Its name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoVote => "no_vote",
            Self::TooMuch => "too_much",
            Self::Outshining => "outshining",
        }
    }
}

/// What [`LocalDecision::Repair`] says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepairTried {
    /// Its number, after those of the candidate highlights.
    pub blob: u16,
    /// Its first pixel.
    pub pixel: u32,
    /// Its pixels.
    pub pixels: u32,
    /// Share of the ring of 2 px around it that is highlight, 0…1, and the least that is filled.
    pub ring: [f32; 2],
    /// Mean surface reflection of the ring's inner pixels and of its outer ones, counts a band.
    pub rise: [f32; 2],
    /// What came of it.
    pub verdict: RepairVerdict,
}

/// Whether a clipped blob is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RepairVerdict {
    /// It is.
    Filled,
    /// It is as large as windows and skies.
    TooLarge,
    /// There is no ring of unclipped pixels around it.
    NoRing,
    /// Too little of the ring is highlight.
    NoHighlight,
    /// The highlight does not rise towards it.
    NoRise,
}

impl RepairVerdict {
    /// Its name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Filled => "filled",
            Self::TooLarge => "too_large",
            Self::NoRing => "no_ring",
            Self::NoHighlight => "no_highlight",
            Self::NoRise => "no_rise",
        }
    }
}

/// What one pixel was judged by, compactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LocalPoint {
    /// Logarithms of κ and its median, in steps from the lowest; 0: there are none.
    ratios: [u16; 2],
    /// Texture in steps, and [`Self::OUTSIDE`].
    texture: u16,
    /// The blob that it is of: a number, 0 for none, [`LocalPoint::SMALL`].
    pub blob: u16,
}

impl LocalPoint {
    /// In place of a number: one of the blobs that are only counted.
    pub const SMALL: u16 = u16::MAX;
    /// Most blobs that have a number.
    pub const MOST_BLOBS: u16 = u16::MAX - 1;
    /// Between which ratios κ lies.
    pub const RATIOS: (f32, f32) = (0.4, 12.0);
    /// Set where a lit pixel lies outside of what holds.
    const OUTSIDE: u16 = 1 << 15;
    /// Steps of the ratios, and of texture.
    const RATIO_STEPS: f32 = 65534.0;
    const TEXTURE_STEPS: f32 = 32767.0;

    /// Of a pixel, by κ and its median where there are any, and texture.
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

    /// Whether it is a lit pixel outside of what holds.
    pub fn outside(&self) -> bool {
        self.texture & Self::OUTSIDE != 0
    }

    /// κ: the ratio of mean to chromatic part that body reflection has around it, and the median there; none where nothing
    /// around it has its hue.
    pub fn ratios(&self) -> Option<[f32; 2]> {
        let (low, high) = Self::RATIOS;
        let ratio = |place: u16| low * (f32::from(place - 1) / Self::RATIO_STEPS * (high / low).ln()).exp();
        (self.ratios[0] > 0 && self.ratios[1] > 0).then(|| self.ratios.map(ratio))
    }

    /// How much surface and body reflection vary against each other around it, 0…1.
    pub fn texture(&self) -> f32 {
        f32::from(self.texture & !Self::OUTSIDE) / Self::TEXTURE_STEPS
    }
}

/// What the local split kept of its pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum LocalRecord {
    /// What the pixels of a window were judged by; no other one lies outside of what holds.
    Points(LocalPoints),
    /// Nothing was judged: only which lit pixels of the picture lie outside of what holds.
    Outside(Mask),
}

/// The pixels of a window.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalPoints {
    /// Which.
    pub roi: Roi,
    /// One of each.
    pub of: Raster<LocalPoint>,
}

impl LocalRecord {
    /// Whether a pixel is lit and lies outside of what holds.
    pub fn outside(&self, pixel: usize) -> bool {
        match self {
            Self::Points(_) => self.point(pixel).is_some_and(LocalPoint::outside),
            Self::Outside(mask) => mask.as_slice().get(pixel).is_some_and(|outside| *outside),
        }
    }

    /// What a pixel was judged by; none for one that was not looked at.
    pub fn point(&self, pixel: usize) -> Option<&LocalPoint> {
        let Self::Points(LocalPoints { roi, of }) = self else { return None };
        of.as_slice().get(roi.index(pixel)?)
    }

    /// The pixels of a blob by its number, ascending.
    pub fn blob(&self, blob: u16) -> Vec<u32> {
        let Self::Points(LocalPoints { roi, of }) = self else { return Vec::new() };
        let own = of.as_slice().iter().enumerate().filter(|(_, point)| blob != 0 && point.blob == blob);
        own.map(|(index, _)| roi.pixel(index) as u32).collect()
    }

    /// Memory that it takes, bytes.
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
        let limits = LocalLimits { texture: [0.1, 0.3], ..LocalLimits::default() };
        let weights = [0.0, 0.1, 0.2, 0.3, 1.0].map(|texture| limits.weight(texture));
        assert!(
            weights.iter().zip([1.0, 1.0, 0.5, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-6),
            "{weights:?}"
        );
    }
}
