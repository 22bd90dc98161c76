//! How a pixel was split (section 6), and by what where no region explains it.

use crate::raster::RegionId;
use crate::reflection::Components;
use crate::trace::{FitLimits, LocalLimits, PixelKind};

/// How a pixel was split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitStory {
    /// The region.
    pub region: RegionId,
    /// What it is to its region.
    pub kind: PixelKind,
    /// Distances from the matte and from the highlight line, counts; the nearer decides. None without a highlight line, and
    /// where the color is not believed.
    pub lines: Option<[f32; 2]>,
    /// Its amounts m_b, m_s and ε (equation 13), counts. None where the color is not believed: it was restored.
    pub amounts: Option<Components>,
    /// Surface reflection that was taken for none, as it lies less than [`SplitStory::least_offset`] off the body line,
    /// counts across that line.
    pub cut: Option<f32>,
    /// See there, counts.
    pub least_offset: f32,
    /// The ambient light that was subtracted from it before (7.5), counts; zeros where there was none.
    pub ambient: [f64; 3],
    /// Why its region's plane is not used for it, where it is not: then the amounts are not the pixel's.
    pub unfit: Option<Unfit>,
}

/// Why a region's plane is not used for a pixel, and what it has instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unfit {
    /// Root mean square distance of the region's pixels from its plane (from its line without one), counts; correlation and slope of
    /// its texture.
    pub fit: [f64; 3],
    /// Up to where these may go.
    pub limits: FitLimits,
    /// Whether it has a plane.
    pub has_plane: bool,
    /// Whether the skewed T explains the region as a whole: then the T is not used for this part of the region only.
    pub model_fits: bool,
    /// Amount of surface reflection m_s that its surroundings tell of, counts; none where it was filled from around it.
    pub surface: Option<f32>,
}

/// What a pixel was judged by that no region explains. Counts are those of J = I / (√3 s), s the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalStory {
    /// a: the mean of J, counts.
    pub mean: f32,
    /// c: the length of its chromatic part, counts.
    pub chroma: f32,
    /// κ: what a/c the body has around it, and the median there; none where nothing around it has its hue.
    pub ratios: Option<[f32; 2]>,
    /// κc: what its saturation accounts for, counts.
    pub body: f32,
    /// ms = a − κc: what is too bright for its saturation, counts.
    pub excess: f32,
    /// Noise of ms, counts: so much may be nothing.
    pub noise: f32,
    /// Variation of its hue around it, counts: what exceeds it is strong.
    pub variation: f32,
    /// How much surface and body reflection vary against each other around it, 0…1.
    pub texture: f32,
    /// The share of ms that counts, 0…1, by texture.
    pub weight: f32,
    /// What it was held against.
    pub limits: LocalLimits,
    /// Fewest pixels of a blob that may be a highlight.
    pub least_px: u32,
    /// What was made of it.
    pub fate: LocalFate,
    /// Whether no highlight of the picture is believed.
    pub doubted: bool,
}

impl LocalStory {
    /// Amount of surface reflection m_s that it has if highlights are believed, counts.
    pub fn surface(&self) -> f32 {
        if self.fate == LocalFate::Taken { 3f32.sqrt() * self.weight * self.excess } else { 0.0 }
    }
}

/// What the local split made of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LocalFate {
    /// It is clipped: only what surrounds it can tell.
    Clipped,
    /// It is too dark or too gray to have a hue.
    Gray,
    /// Nothing around it has its hue.
    Alone,
    /// It is no paler than noise explains.
    Faint,
    /// It looks like texture.
    Texture,
    /// No square of 3 × 3 pixels like it holds it.
    Thin,
    /// Its blob has too few pixels.
    Small,
    /// Its blob is no highlight.
    NoHighlight,
    /// It is no paler than its hue varies, and blobs are not asked for.
    Weak,
    /// It is surface reflection.
    Taken,
}
