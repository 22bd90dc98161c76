//! The reason why body and surface reflection of one region do not explain a pixel (sections 5.6 and 7.5).
//!
//! The paper names the effects that the model does not explain: shadows and dark colors, inter-reflection, pixels that mix two
//! objects, clipped pixels, and gray objects, whose matte line has the direction of the light. Section 7.5 adds printed textures.

use super::RegionReflection;
use crate::color::{Vec3, axis_angle_deg};
use crate::photo::Masks;
use crate::raster::{LabelMap, Mask, Raster, RegionId, UNASSIGNED};
use crate::segment::RegionVerdict;
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Distance from the plane above which noise does not explain a pixel, standard deviations of noise and coding.
const FAR_OFF: f32 = 3.0;
/// Angle to the light's color below which a body vector counts as the light's color, degrees.
const COLLINEAR_DEG: f64 = 3.0;

/// The reason why one region's skewed T does not explain a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Reason {
    /// The skewed T of the pixel's region explains the pixel.
    #[default]
    Explained,
    /// The pixel is too dark to be analyzed: shadow or background.
    Shadow,
    /// The pixel is lit, but on no matte line that was found.
    NoMatteLine,
    /// The pixel lies between two regions, or between a region and the dark, and mixes their colors.
    MixedBoundary,
    /// The pixel or its region lies off the dichromatic plane: inter-reflection, or more than one material.
    InterReflection,
    /// Body and surface reflection of the pixel's region vary against each other, or what its plane takes for surface reflection looks
    /// like no highlight: a print, a grain, a second color.
    Texture,
    /// The pixel's region is only a part of an object: its surface reflection ends where the photograph has no edge.
    PartOfObject,
    /// The pixel is the clipped highlight of another object than the object of its region.
    OtherObject,
    /// The body reflection of the pixel's region has the light's color, as far as the light is known: gray, white and metal.
    Collinear,
    /// Every band is clipped, in a region that holds.
    ClippedAllBands,
    /// The pixel is that of an object that clips, or of its edge, and of no highlight.
    ClippedObject,
    /// The pixel lies outside the area that the analysis is restricted to.
    OutsideArea,
    /// The file holds no usable value of the pixel.
    NoValue,
}

impl Reason {
    /// All reasons, in the order of their definition.
    pub const ALL: [Self; 13] = [
        Self::Explained,
        Self::Shadow,
        Self::NoMatteLine,
        Self::MixedBoundary,
        Self::InterReflection,
        Self::Texture,
        Self::PartOfObject,
        Self::OtherObject,
        Self::Collinear,
        Self::ClippedAllBands,
        Self::ClippedObject,
        Self::OutsideArea,
        Self::NoValue,
    ];

    /// Name of the reason in reports and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::Shadow => "shadow",
            Self::NoMatteLine => "no_matte_line",
            Self::MixedBoundary => "mixed_boundary",
            Self::InterReflection => "inter_reflection",
            Self::Texture => "texture",
            Self::PartOfObject => "part_of_object",
            Self::OtherObject => "other_object",
            Self::Collinear => "collinear",
            Self::ClippedAllBands => "clipped_all_bands",
            Self::ClippedObject => "clipped_object",
            Self::OutsideArea => "outside_area",
            Self::NoValue => "no_value",
        }
    }
}

/// The data from which the reasons are derived.
pub struct ReasonInput<'a> {
    /// The marks of each pixel.
    pub masks: &'a Masks,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The pixels that the skewed T of their region explains.
    pub explained_mask: &'a Mask,
    /// The kind of each pixel.
    pub kinds: &'a Raster<PixelKind>,
    /// Distance from the plane, counts.
    pub noise: &'a Raster<f32>,
    /// The regions.
    pub regions: &'a [RegionReflection],
    /// Color of the light, unit; none where the light is not known.
    pub light: Option<[f64; 3]>,
    /// What noise and coding explain of the distance of a pixel from the plane of each region (σ), counts, by [`RegionId::index`].
    pub pixel_sigmas: &'a [f32],
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

    /// Standard deviation of the distance of a region's pixels from the model, counts.
    fn sigma_of(&self, region: RegionId) -> f32 {
        self.pixel_sigmas.get(region.index()).copied().unwrap_or(f32::INFINITY)
    }

    /// The reason that applies to a region as a whole.
    fn of_region(&self, region: &RegionReflection) -> Reason {
        let collinear =
            |light: [f64; 3]| axis_angle_deg(&Vec3::from(region.body), &Vec3::from(light)) < COLLINEAR_DEG;
        match region.verdict {
            RegionVerdict::ColorOfLight => Reason::Collinear,
            RegionVerdict::NewEdges => Reason::PartOfObject,
            RegionVerdict::Texture | RegionVerdict::NoHighlights => Reason::Texture,
            RegionVerdict::OffPlane => Reason::InterReflection,
            RegionVerdict::Fits if !region.separable && self.light.is_some_and(collinear) => {
                Reason::Collinear
            }
            RegionVerdict::Fits => Reason::Explained,
        }
    }

    /// The reason of one pixel. `of_region`: the reasons of the regions, by [`RegionId::index`].
    fn of_pixel(&self, pixel: usize, of_region: &[Reason]) -> Reason {
        let region = RegionId::from_label(self.labels[pixel]);
        if self.masks.outside(pixel) {
            return Reason::OutsideArea;
        }
        if self.masks.invalid(pixel) {
            return Reason::NoValue;
        }
        if self.masks.in_clipped_object(pixel) && region.is_none() {
            return Reason::ClippedObject;
        }
        if self.masks.dark(pixel) && region.is_none() {
            return Reason::Shadow;
        }
        let Some(region) = region else {
            return if self.at_a_border(pixel) { Reason::MixedBoundary } else { Reason::NoMatteLine };
        };
        let of_region = of_region.get(region.index()).copied().unwrap_or_default();
        match of_region {
            Reason::Explained | Reason::Collinear if !self.explained_mask[pixel] => Reason::OtherObject,
            Reason::Explained if self.kinds[pixel] == PixelKind::Lost => Reason::ClippedAllBands,
            Reason::Explained if self.noise[pixel].abs() > FAR_OFF * self.sigma_of(region) => {
                if self.at_a_border(pixel) { Reason::MixedBoundary } else { Reason::InterReflection }
            }
            other => other,
        }
    }

    /// Whether the pixel's neighbors have different labels and at least one of them is in a region.
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
    use super::Reason::{
        ClippedAllBands, Explained, MixedBoundary, NoMatteLine, NoValue, OutsideArea, Shadow,
    };
    use super::*;
    use crate::photo::{LinearImage, MaskLimits};

    #[test]
    fn dark_lit_mixed_and_clipped_pixels_have_different_reasons() {
        let row = [[5.0; 3], [80.0; 3], [90.0; 3], [255.0; 3], [90.0; 3], [90.0; 3], [90.0; 3]];
        let image = LinearImage::new(Raster::from_vec(7, 1, row.to_vec()).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let mut kinds = Raster::filled(7, 1, PixelKind::Matte);
        kinds[3] = PixelKind::Lost;
        let input = ReasonInput {
            masks: &Masks::new(&image, &limits),
            labels: &LabelMap::from_vec(7, 1, vec![0, 0, 1, 1, 0, 0, 0]).unwrap(),
            explained_mask: &Raster::filled(7, 1, true),
            kinds: &kinds,
            noise: &Raster::filled(7, 1, 0.0),
            regions: &[],
            light: None,
            pixel_sigmas: &[],
        };
        assert_eq!(
            input.reasons().as_slice(),
            [Shadow, MixedBoundary, Explained, ClippedAllBands, MixedBoundary, NoMatteLine, NoMatteLine]
        );
        let of_a_part = input.of_pixel(3, &[Reason::PartOfObject]);
        assert_eq!(of_a_part, Reason::PartOfObject, "the region tells why nothing restores a clipped pixel");
        assert!(Reason::ALL.iter().enumerate().all(|(i, reason)| *reason as usize == i));
    }

    #[test]
    fn what_is_left_out_is_no_shadow() {
        let row = vec![[5.0; 3], [5.0; 3], [f32::NAN; 3], [80.0; 3]];
        let image = LinearImage::new(Raster::from_vec(4, 1, row).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let area = Mask::from_vec(4, 1, vec![true, false, true, false]).unwrap();
        let found = ReasonInput {
            masks: &Masks::new(&image, &limits).within(&area),
            labels: &LabelMap::filled(4, 1, UNASSIGNED),
            explained_mask: &Raster::filled(4, 1, false),
            kinds: &Raster::filled(4, 1, PixelKind::Unassigned),
            noise: &Raster::filled(4, 1, 0.0),
            regions: &[],
            light: None,
            pixel_sigmas: &[],
        }
        .reasons();
        assert_eq!(found.as_slice(), [Shadow, OutsideArea, NoValue, OutsideArea]);
    }
}
