//! The pixels of a region whose colors lie inside an outline in the plane view.

use super::{RegionPlane, ResultSnapshot};
use crate::raster::{Mask, Raster};
use rayon::prelude::*;

/// The pixels of the region of `plane` whose places `encloses` accepts, oblique counts (see [`RegionPlane::oblique`]); none where the
/// plane is of no region of the result.
pub fn plane_mask(
    shown: &ResultSnapshot,
    plane: &RegionPlane,
    encloses: impl Fn([f32; 2]) -> bool + Sync,
) -> Option<Mask> {
    let region = plane.region?.get();
    let (labels, colors) = (shown.labels(), &shown.picture.photo.image.pixels);
    if labels.len() != colors.len() {
        return None;
    }
    let inside = |pixel: usize| {
        labels[pixel] == region && {
            let amounts = plane.amounts(colors[pixel]);
            encloses(plane.oblique(amounts.body, amounts.surface))
        }
    };
    let marked: Vec<bool> = (0..labels.len()).into_par_iter().with_min_len(1 << 12).map(inside).collect();
    Raster::from_vec(labels.width(), labels.height(), marked)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::RegionId;
    use crate::view::region_plane;
    use crate::view::testing::tiny;

    #[test]
    fn an_outline_around_everything_marks_the_region_and_a_half_marks_less() {
        let shown = tiny();
        let region = RegionId::from_index(0);
        let plane = region_plane(&shown, region).unwrap();
        let count = |mask: Mask| mask.count();
        let all = count(plane_mask(&shown, &plane, |_| true).unwrap());
        assert_eq!(all, shown.analysis.intrinsic.regions[0].pixels);
        let middle = 0.5 * plane.matte_length;
        let bright = count(plane_mask(&shown, &plane, |[x, _]| x > middle).unwrap());
        assert!(bright > 0 && bright < all, "{bright} of {all}");
    }
}
