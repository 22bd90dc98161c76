//! Patches of a region whose colors its plane cannot explain (refinement `far_colors`; section 5.5).
//!
//! The clipping stage gives a region what is bright beside its highlights and what it surrounds (section 5.5), because the color of a
//! clipped or bloomed pixel tells nothing. The same rule takes small objects in front of a wall, whose colors are believed. Split by
//! the plane of the wall such a pixel has a large ε, or a negative amount of body or surface reflection. A pixel is far where it is neither
//! clipped nor bloomed and its color is farther than [`FAR_SIGMAS`] standard deviations of the region's fit from the plane, or from the matte or the
//! highlight line on their outer sides. Where compression or demosaicing mixes the colors at a border,
//! the far pixels within narrow strips are left out: a patch then is the far pixels with nothing but far pixels around, and the far pixels
//! beside them.

use super::region_plan::RegionPlan;
use crate::raster::{LabelMap, Mask, RegionId, dilate, erode};
use crate::reflection::ReflectionTransform;
use crate::segment::AnalysisInput;
use rayon::prelude::*;

/// Distance from which on a color is far, standard deviations of the region's fit.
const FAR_SIGMAS: f32 = 8.0;

/// The colors that lie far from the plane of one region.
#[derive(Clone, Copy)]
struct FarColors {
    transform: ReflectionTransform,
    /// Distance from which on a color is far, counts.
    limit_counts: f32,
}

impl FarColors {
    /// None where the region has no plane.
    fn of(plan: &RegionPlan) -> Option<Self> {
        let limit_counts = FAR_SIGMAS * plan.fit.sigma_counts as f32;
        plan.transform().map(|&transform| Self { transform, limit_counts })
    }

    /// Whether a color, counts above the ambient light, is far.
    fn contains(&self, color: [f32; 3]) -> bool {
        self.transform.misfit_counts(color) > self.limit_counts
    }
}

/// Takes the patches of far colors out of `explained_mask`. `plans`: how each region is split, by [`RegionId::index`].
pub(super) fn remove_far_colors(
    input: &AnalysisInput,
    labels: &LabelMap,
    plans: &[RegionPlan],
    explained_mask: &mut Mask,
) {
    if input.refine.far_colors && !input.is_marked() {
        let of_regions: Vec<Option<FarColors>> = plans.iter().map(FarColors::of).collect();
        remove_patches(input, labels, &of_regions, explained_mask);
    }
}

/// Takes the patches out of `explained_mask`. `of_regions`: the far colors of each region, by [`RegionId::index`].
fn remove_patches(
    input: &AnalysisInput,
    labels: &LabelMap,
    of_regions: &[Option<FarColors>],
    explained_mask: &mut Mask,
) {
    let width = labels.width();
    let mut far = Mask::filled(width, labels.height(), false);
    far.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, is_far) in row.iter_mut().enumerate() {
            let pixel = y * width + x;
            let Some(id) = RegionId::from_label(labels[pixel]) else { continue };
            let is_believed = explained_mask[pixel] && !input.masks.distorted(pixel);
            *is_far = is_believed
                && of_regions[id.index()].is_some_and(|colors| colors.contains(input.pixels[pixel]));
        }
    });
    if !far.as_slice().contains(&true) {
        return;
    }
    let strip_px = input.mixing_reach_px().saturating_sub(1);
    let patches = dilate(&erode(&far, strip_px), strip_px);
    for (pixel, is_explained) in explained_mask.as_mut_slice().iter_mut().enumerate() {
        *is_explained &= !(far[pixel] && patches[pixel]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::segment::testing::Drawing;

    /// The explained pixels of a region of matte pixels (m), highlights (h), pixels of another object (o), and clipped ones (w); a point is
    /// a pixel that is not explained. `extended`: whether the errors of neighboring pixels are alike.
    fn explained(rows: &[&str], extended: bool) -> Vec<String> {
        let (body, surface) = (Vec3::new(0.9, 0.3, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let drawing = Drawing::new(rows, |c| match c {
            'm' => body * 120.0,
            'h' => body * 120.0 + surface * 60.0,
            'w' => Vec3::repeat(255.0),
            _ => Vec3::new(40.0, 60.0, 150.0),
        });
        let input = drawing.input().with_coding(None, extended);
        let (width, height) = (rows[0].len(), rows.len());
        let map = LabelMap::filled(width, height, 1);
        let colors =
            FarColors { transform: ReflectionTransform::new(&body, &surface).unwrap(), limit_counts: 10.0 };
        let mut mask = Mask::filled(width, height, true);
        remove_patches(&input, &map, &[Some(colors)], &mut mask);
        let letter = |&is_explained: &bool| if is_explained { 'x' } else { '.' };
        mask.as_slice().chunks(width).map(|row| row.iter().map(letter).collect()).collect()
    }

    #[test]
    fn another_object_is_not_explained_and_highlights_and_clipped_pixels_are() {
        assert_eq!(explained(&["mmmoo", "mhwoo", "mmmmo"], false), ["xxx..", "xxx..", "xxxx."]);
    }

    #[test]
    fn a_narrow_strip_is_the_mixed_colors_of_a_border_where_the_errors_of_neighbors_are_alike() {
        let rows = ["mommmmmm", "mommoooo", "mommoooo", "mommoooo", "mommmmmm"];
        let kept = ["xxxxxxxx", "xxxx....", "xxxx....", "xxxx....", "xxxxxxxx"];
        assert_eq!(explained(&rows, true), kept);
        assert!(explained(&rows, false).iter().all(|row| row.starts_with("x.x")));
    }
}
