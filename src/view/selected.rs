//! The selection as a mask, a table and points, for other programs.

use super::layers::Curve;
use super::marking::mask_of;
use super::{Picture, ResultSnapshot, Selection};
use crate::raster::Mask;
use std::fmt::Write;

/// The marked pixels; where none are marked, the pixels of the selected item; none where nothing is selected.
pub(crate) fn selected_pixels(
    selection: &Selection,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
) -> Option<Mask> {
    if let Some(marked) = &selection.marked {
        return Some(Mask::clone(marked)).filter(|mask| (mask.width(), mask.height()) == picture.size());
    }
    mask_of(selection.item?, shown?)
}

/// A mask as a gray picture: 255 inside, 0 outside.
pub(crate) fn mask_png(mask: &Mask) -> Vec<u8> {
    crate::export::png_of_gray(&mask.map(|&on| if on { 255 } else { 0 }))
}

/// The pixels of a mask as comma separated values with a line of headings: column, row, linear counts, region and kind.
pub(crate) fn csv(mask: &Mask, picture: &Picture, shown: Option<&ResultSnapshot>) -> String {
    let mut text = String::from("x,y,r_counts,g_counts,b_counts,region,kind\n");
    let width = mask.width();
    for pixel in (0..mask.len()).filter(|&pixel| mask[pixel]) {
        let [r, g, b] = picture.photo.image.pixels[pixel];
        let (region, kind) = shown.map_or((0, "unassigned"), |shown| {
            (shown.labels()[pixel], shown.analysis.intrinsic.kinds[pixel].name())
        });
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{},{r},{g},{b},{region},{kind}", pixel % width, pixel / width);
    }
    text
}

/// The pixels of a mask as points in the color cube: x, y, z are linear red, green and blue in counts, and each point has
/// its sRGB color (PLY 1.0, binary, little-endian).
pub(crate) fn ply(mask: &Mask, picture: &Picture) -> Vec<u8> {
    let count = mask.count();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment x y z: linear red, green and blue in counts, 255 = full scale\n\
         element vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    )
    .into_bytes();
    let curve = Curve::new(0.0, picture.photo.image.contrast, 1.0);
    for pixel in (0..mask.len()).filter(|&pixel| mask[pixel]) {
        let counts = picture.photo.image.pixels[pixel];
        bytes.extend(counts.iter().flat_map(|counts| counts.to_le_bytes()));
        bytes.extend(counts.map(|counts| curve.code(counts)));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{PixelIndex, Raster, RegionId};
    use crate::view::Item;
    use crate::view::testing::{divided, gray, picture};
    use std::sync::Arc;

    const ROWS: [&str; 2] = ["122", "1.2"];

    #[test]
    fn marked_pixels_count_before_the_selected_item() {
        let picture = gray(&ROWS, 50);
        let shown = divided(&picture, &ROWS);
        let of = |item, marked: Option<&Mask>| {
            let selection = Selection { item, marked: marked.cloned().map(Arc::new), ..Selection::default() };
            selected_pixels(&selection, &picture, Some(&shown)).map(Raster::into_vec)
        };
        let (t, f) = (true, false);
        assert_eq!(of(Some(Item::Region(RegionId::from_index(2 - 1))), None), Some(vec![f, t, t, f, f, t]));
        assert_eq!(of(Some(Item::Pixel(PixelIndex::new(4))), None), Some(vec![f, f, f, f, t, f]));
        assert_eq!(of(Some(Item::Window(0)), None), Some(vec![t; 6]));
        assert_eq!(of(picture.histogram.bin_of(0).map(Item::Bin), None), Some(vec![t; 6]));
        for nothing in [
            Item::Region(RegionId::from_index(9 - 1)),
            Item::Pixel(PixelIndex::new(99)),
            Item::Bin(99),
            Item::Window(99),
        ] {
            assert_eq!(of(Some(nothing), None), None, "{nothing:?}");
        }
        let marked = Raster::from_vec(3, 2, vec![t, f, f, f, f, f]).unwrap();
        assert_eq!(
            of(Some(Item::Region(RegionId::from_index(2 - 1))), Some(&marked)),
            Some(marked.into_vec())
        );
    }

    #[test]
    fn tables_and_points_hold_the_pixels_in_order() {
        let picture =
            picture(3, &[[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12], [13, 14, 15], [255, 54, 0]]);
        let mask = Raster::from_vec(3, 2, vec![false, true, false, false, false, true]).unwrap();
        assert_eq!(
            csv(&mask, &picture, Some(&divided(&picture, &ROWS))),
            "x,y,r_counts,g_counts,b_counts,region,kind\n1,0,4,5,6,2,unassigned\n2,1,255,54,0,2,unassigned\n"
        );
        let ply = ply(&mask, &picture);
        let end = ply.windows(11).position(|text| text == b"end_header\n").unwrap() + 11;
        assert!(ply.starts_with(b"ply\nformat binary_little_endian 1.0\n"));
        let header = String::from_utf8(ply[..end].to_vec()).unwrap();
        assert!(header.contains("element vertex 2\n"), "{header}");
        assert_eq!(ply.len() - end, 2 * 15);
        let last = &ply[end + 15..];
        assert_eq!(last[..4], 255f32.to_le_bytes());
        assert_eq!(last[12..], [255, 127, 0]);
    }
}
