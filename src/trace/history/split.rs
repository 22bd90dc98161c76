//! How a pixel was split (section 6), and the figures that decided about a pixel that no region explains.

use crate::raster::RegionId;
use crate::reflection::Components;
use crate::trace::{FitFigures, FitLimits, HighlightTerms, LocalLimits, PixelKind, RestoredBand};

/// How a pixel was split.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SplitStory {
    /// The region.
    pub region: RegionId,
    /// Kind of the pixel.
    pub kind: PixelKind,
    /// Distances from the matte and from the highlight line, counts; the nearer decides. None without a highlight line, and
    /// where the color is distorted.
    pub lines: Option<[f32; 2]>,
    /// The amounts m_b, m_s and ε (equation 13), counts. None for a distorted color, which was restored, and for a region
    /// that is not split.
    pub amounts: Option<Components>,
    /// Whether the region is not split, so that the body reflection of the pixel is its color (reading
    /// `unsplit_without_highlight`).
    pub unsplit: bool,
    /// Distance from the body line of surface reflection that was taken for none, as the distance is less than
    /// [`SplitStory::least_offset`], counts; none where no surface reflection was removed.
    pub cut: Option<f32>,
    /// Why only a part of the surface reflection stays; none where all of it stays.
    pub border: Option<BorderLimit>,
    /// Least distance from the body line of a color with surface reflection, counts.
    pub least_offset: f32,
    /// The ambient light that was subtracted before (7.5), counts; zeros where nothing was subtracted.
    pub ambient: [f64; 3],
    /// Why the plane of the region is not used for the pixel; none where it is used. Without the plane the amounts are not those of
    /// the result.
    pub unfit: Option<Unfit>,
}

/// The part of the surface reflection that a pixel near another region keeps (refinement `border_mixtures`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BorderLimit {
    /// Share of the surface reflection that stays, 0…1; the rest is body reflection.
    pub kept: f32,
    /// How far a border mixes colors, pixels.
    pub reach_px: u32,
}

/// Why the plane of a region is not used for a pixel, and the surface reflection of the pixel instead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Unfit {
    /// The figures by which the region was judged.
    pub fit: FitFigures,
    /// The limits of the figures.
    pub limits: FitLimits,
    /// Whether the region has a plane.
    pub has_plane: bool,
    /// Whether the skewed T explains the region as a whole: then the T is not used for this part of the region only.
    pub model_fits: bool,
    /// Amount of surface reflection m_s by the surroundings of the pixel, counts; none where the pixel was filled from the pixels
    /// around it.
    pub surface: Option<f32>,
}

/// The figures by which a pixel that no region explains was judged. Counts are those of J = I / (√3 s), s the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LocalStory {
    /// a: the mean of J, counts.
    pub mean: f32,
    /// c: the length of the chromatic part of J, counts.
    pub chroma: f32,
    /// The band that was restored by the hue around, because it alone is clipped: a and c contain it. None where no band was restored.
    pub restored: Option<RestoredBand>,
    /// κ: the ratio a/c of the body around the pixel, or of its region where that is clearly paler, and the median of a/c there; none
    /// where no pixel around has the hue of this one.
    pub ratios: Option<[f32; 2]>,
    /// κc: the part of a that the saturation accounts for, counts.
    pub body: f32,
    /// ms = a − κc: the part of a in excess of the saturation, counts.
    pub excess: f32,
    /// Noise of ms, counts: smaller values are not significant.
    pub noise: f32,
    /// Variation of the hue around the pixel, counts: larger values of ms are strong.
    pub variation: f32,
    /// The observations that speak for and against a highlight, log odds; none where highlights are not told from print.
    pub terms: Option<HighlightTerms>,
    /// Log odds of a highlight: the observations of the pixels around, averaged, and the odds of the picture.
    pub odds: f32,
    /// The part of `odds` that is the same for the whole picture.
    pub picture_odds: f32,
    /// The share of ms that counts, 0…1.
    pub weight: f32,
    /// The limits.
    pub limits: LocalLimits,
    /// Amount of surface reflection m_s that was found, after it was made to follow the edges of the picture, counts.
    pub surface: f32,
    /// Angle by which the chromaticity of its body reflection was changed towards that of the pixels around, degrees.
    pub turn_deg: f32,
    /// Why the pixel itself has surface reflection, or why it has none.
    pub fate: LocalFate,
}

/// The outcome of the local split for a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LocalFate {
    /// The pixel is clipped: only the pixels around its blob can decide.
    Clipped,
    /// The pixel is too dark or too gray to have a hue.
    Gray,
    /// No pixel around has the hue of this one.
    Alone,
    /// The excess is no larger than the noise.
    Faint,
    /// The observations speak for white print.
    Print,
    /// The hue is so pale that κ is not reliable.
    Pale,
    /// The excess is no larger than the variation of the hue, and highlights are not told from print.
    Weak,
    /// The excess, or a part of it, is surface reflection.
    Taken,
}
