//! Why a pixel is not explained by body and surface reflection of one region (sections 5.6 and 7.5).
//!
//! The paper names what it leaves unexplained: shadows and dark colors, inter-reflection, pixels that mix two objects, clipped
//! ones, and gray objects whose matte line is the illuminant's. Printed textures are its section 7.5's.

use super::RegionReflection;
use crate::color::{Vec3, axis_angle_deg};
use crate::photo::Masks;
use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED};

use crate::segment::{POOR_FIT, TEXTURE_CORRELATION};
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Distance from the plane that noise does not explain, σ.
const FAR_OFF: f32 = 2.0 * POOR_FIT as f32;
/// A body vector so near to the light's is the light's, degrees.
const COLLINEAR_DEG: f64 = 3.0;

/// What keeps a pixel from being explained.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reason {
    /// Nothing: its region's skewed T holds.
    #[default]
    Explained,
    /// It is too dark to be analyzed: shadow or background.
    Shadow,
    /// It is lit, but on no matte line that was found.
    NoMatteLine,
    /// It lies between regions, or between one and the dark, and mixes their colors.
    MixedBoundary,
    /// It lies off the plane, or its region does: inter-reflection, or more than one material.
    InterReflection,
    /// Body and surface reflection of its region vary against each other: a print, a grain.
    Texture,
    /// It is the clipped highlight of another object than its region's.
    OtherObject,
    /// Its body reflection has the light's color: gray, white and metal.
    Collinear,
    /// Every band is clipped.
    ClippedAllBands,
}

impl Reason {
    /// All of them, in their order.
    pub const ALL: [Self; 9] = [
        Self::Explained,
        Self::Shadow,
        Self::NoMatteLine,
        Self::MixedBoundary,
        Self::InterReflection,
        Self::Texture,
        Self::OtherObject,
        Self::Collinear,
        Self::ClippedAllBands,
    ];

    /// Its name in reports and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::Shadow => "shadow",
            Self::NoMatteLine => "no_matte_line",
            Self::MixedBoundary => "mixed_boundary",
            Self::InterReflection => "inter_reflection",
            Self::Texture => "texture",
            Self::OtherObject => "other_object",
            Self::Collinear => "collinear",
            Self::ClippedAllBands => "clipped_all_bands",
        }
    }
}

/// What reasons are found from.
pub struct ReasonInput<'a> {
    /// Which pixels are believed.
    pub masks: &'a Masks,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// Where regions' planes were used.
    pub explained_mask: &'a Mask,
    /// What each pixel is to its region.
    pub kinds: &'a Raster<PixelKind>,
    /// Distance from the plane, counts.
    pub noise: &'a Raster<f32>,
    /// The regions.
    pub regions: &'a [RegionReflection],
    /// The light, unit.
    pub light: Option<[f64; 3]>,
    /// Standard deviation of a band's noise, counts.
    pub sigma: f32,
}

impl ReasonInput<'_> {
    /// The reason of each pixel.
    pub fn reasons(&self) -> Raster<Reason> {
        let of_region: Vec<Reason> = self.regions.iter().map(|region| self.of_region(region)).collect();
        let width = self.labels.width();
        let mut reasons = Raster::filled(width, self.labels.height(), Reason::Explained);
        reasons.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for (x, reason) in row.iter_mut().enumerate() {
                *reason = self.of_pixel(y * width + x, &of_region);
            }
        });
        reasons
    }

    fn of_region(&self, region: &RegionReflection) -> Reason {
        let collinear =
            |light: [f64; 3]| axis_angle_deg(&Vec3::from(region.body), &Vec3::from(light)) < COLLINEAR_DEG;
        let only_textured = f64::from(self.sigma) * POOR_FIT >= region.fit_rms_counts;
        // A print of several colors lies off its plane as well: what it is says more than what it does.
        if !region.model_fits && (only_textured || region.texture > TEXTURE_CORRELATION) {
            Reason::Texture
        } else if !region.model_fits {
            Reason::InterReflection
        } else if !region.separable && self.light.is_some_and(collinear) {
            Reason::Collinear
        } else {
            Reason::Explained
        }
    }

    fn of_pixel(&self, pixel: usize, of_region: &[Reason]) -> Reason {
        let label = self.labels[pixel];
        if self.masks.dark(pixel) && label == UNASSIGNED {
            return Reason::Shadow;
        }
        if self.kinds[pixel] == PixelKind::Lost {
            return Reason::ClippedAllBands;
        }
        if label == UNASSIGNED {
            return if self.at_a_border(pixel) { Reason::MixedBoundary } else { Reason::NoMatteLine };
        }
        let of_region = of_region.get(usize::from(label) - 1).copied().unwrap_or_default();
        match of_region {
            Reason::Explained | Reason::Collinear if !self.explained_mask[pixel] => Reason::OtherObject,
            Reason::Explained if self.noise[pixel].abs() > FAR_OFF * self.sigma => {
                if self.at_a_border(pixel) { Reason::MixedBoundary } else { Reason::InterReflection }
            }
            other => other,
        }
    }

    /// Whether a neighbor is of a region, and another is not of the same.
    fn at_a_border(&self, pixel: usize) -> bool {
        let mut first = None;
        let (mut assigned, mut differ) = (false, false);
        self.labels.for_each_neighbor(pixel, |near| {
            assigned |= self.labels[near] != UNASSIGNED;
            differ |= *first.get_or_insert(self.labels[near]) != self.labels[near];
        });
        assigned && differ
    }
}

#[cfg(test)]
mod tests {
    use super::Reason::{ClippedAllBands, Explained, MixedBoundary, NoMatteLine, Shadow};
    use super::*;
    use crate::photo::{LinearImage, MaskLimits};

    #[test]
    fn dark_lit_mixed_and_clipped_pixels_are_told_apart() {
        let row = [[5.0; 3], [80.0; 3], [90.0; 3], [255.0; 3], [90.0; 3], [90.0; 3], [90.0; 3]];
        let image = LinearImage::new(Raster::from_vec(7, 1, row.to_vec()).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let mut kinds = Raster::filled(7, 1, PixelKind::Matte);
        kinds[3] = PixelKind::Lost;
        let found = ReasonInput {
            masks: &Masks::new(&image, &limits),
            labels: &LabelMap::from_vec(7, 1, vec![0, 0, 1, 1, 0, 0, 0]).unwrap(),
            explained_mask: &Raster::filled(7, 1, true),
            kinds: &kinds,
            noise: &Raster::filled(7, 1, 0.0),
            regions: &[],
            light: None,
            sigma: 1.25,
        }
        .reasons();
        assert_eq!(
            found.as_slice(),
            [Shadow, MixedBoundary, Explained, ClippedAllBands, MixedBoundary, NoMatteLine, NoMatteLine]
        );
        assert!(Reason::ALL.iter().enumerate().all(|(i, reason)| *reason as usize == i));
    }
}
