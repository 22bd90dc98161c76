//! The output of each stage as a picture.

use super::palette::Palette;
use crate::analysis::Analysis;
use crate::raster::{LabelMap, Raster, UNASSIGNED};
use crate::trace::Class;
use std::collections::BTreeMap;

const BLACK: [u8; 3] = [0; 3];

/// The classes of the windows in the paper's colors: point yellow, line red, plane green, volume blue, no class black.
pub(super) fn classification(analysis: &Analysis) -> Raster<[u8; 3]> {
    let (width, height) = (analysis.areas.width(), analysis.areas.height());
    let windows = &analysis.windows;
    let mut picture = Raster::filled(width, height, BLACK);
    for (index, pixel) in picture.as_mut_slice().iter_mut().enumerate() {
        let window = windows.classes.get(index % width / windows.size_px, index / width / windows.size_px);
        *pixel = match window.copied().flatten() {
            Some(Class::Point) => [255, 255, 0],
            Some(Class::Line) => [255, 0, 0],
            Some(Class::Plane) => [0, 255, 0],
            Some(Class::Volume) => [0, 0, 255],
            None => BLACK,
        };
    }
    picture
}

/// Labels in colors that differ between neighbors, as 8-bit sRGB; 0 is black.
pub fn colored<T: Copy + Into<u32>>(labels: &Raster<T>) -> Raster<[u8; 3]> {
    let palette = Palette::new();
    let colors = palette.assign(&neighbors(labels));
    labels.map(|&label| match label.into() {
        0 => BLACK,
        label => palette.color(colors[label as usize]),
    })
}

/// `labels` with the numbers of `finals`, the labels of the result: each label becomes the final label that covers most of its
/// pixels, so that a region has one color in the pictures of all stages. Labels that no final label covers get new numbers.
pub(super) fn aligned(labels: &LabelMap, finals: &LabelMap) -> Raster<u32> {
    let mut shared: BTreeMap<(u16, u16), usize> = BTreeMap::new();
    for (&label, &last) in labels.as_slice().iter().zip(finals.as_slice()) {
        if label != UNASSIGNED {
            *shared.entry((label, last)).or_default() += 1;
        }
    }
    let mut next = finals.as_slice().iter().copied().max().map_or(1, |last| u32::from(last) + 1);
    let mut numbers: BTreeMap<u16, u32> = BTreeMap::new();
    for &(label, _) in shared.keys() {
        if numbers.contains_key(&label) {
            continue;
        }
        let covers = shared.range((label, 1)..=(label, u16::MAX));
        let most = covers.max_by_key(|&(&(_, last), &pixels)| (pixels, std::cmp::Reverse(last)));
        let number = most.map_or(next, |(&(_, last), _)| u32::from(last));
        next += u32::from(most.is_none());
        numbers.insert(label, number);
    }
    labels.map(|label| numbers.get(label).copied().unwrap_or(0))
}

/// Labels in the colors of the final labels `finals`, see [`aligned`].
pub(super) fn colored_like(labels: &LabelMap, finals: &LabelMap) -> Raster<[u8; 3]> {
    let palette = Palette::new();
    let aligned = aligned(labels, finals);
    let mut touching = neighbors(finals);
    let largest = aligned.as_slice().iter().copied().max().unwrap_or(0) as usize;
    touching.resize(touching.len().max(largest + 1), Vec::new());
    let colors = palette.assign(&touching);
    aligned.map(|&label| if label == 0 { BLACK } else { palette.color(colors[label as usize]) })
}

/// The labels adjacent to each label (4-neighborhood), ascending; 0 has none.
fn neighbors<T: Copy + Into<u32>>(labels: &Raster<T>) -> Vec<Vec<u32>> {
    let at = |index: usize| -> u32 { labels[index].into() };
    let mut pairs = Vec::new();
    let mut largest = 0;
    for index in 0..labels.len() {
        let here = at(index);
        largest = largest.max(here);
        let right = ((index + 1) % labels.width() != 0).then_some(index + 1);
        let below = (index + labels.width() < labels.len()).then_some(index + labels.width());
        for there in [right, below].into_iter().flatten().map(at) {
            if here != there && here != 0 && there != 0 && pairs.last() != Some(&(here, there)) {
                pairs.push((here, there));
            }
        }
    }
    let mut touching = vec![Vec::new(); largest as usize + 1];
    for (a, b) in pairs {
        touching[a as usize].push(b);
        touching[b as usize].push(a);
    }
    for list in &mut touching {
        list.sort_unstable();
        list.dedup();
    }
    touching
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_at_opposite_borders_of_the_picture_are_not_adjacent() {
        let labels = Raster::from_vec(3, 3, vec![1u16, 1, 2, 0, 3, 2, 4, 0, 2]).unwrap();
        assert_eq!(neighbors(&labels), [vec![], vec![2, 3], vec![1, 3], vec![1, 2], vec![]]);
    }

    #[test]
    fn a_region_keeps_its_final_number_through_all_stages() {
        let finals = LabelMap::from_vec(6, 1, vec![2, 2, 1, 1, 0, 0]).unwrap();
        let labels = LabelMap::from_vec(6, 1, vec![7, 7, 7, 3, 5, 0]).unwrap();
        assert_eq!(aligned(&labels, &finals).as_slice(), [2, 2, 2, 1, 3, 0]);
        assert_eq!(colored_like(&labels, &finals)[0], colored(&finals)[0]);
    }

    #[test]
    fn unassigned_is_black_and_nothing_else_is() {
        let labels = Raster::from_vec(3, 1, vec![0u16, 1, 2]).unwrap();
        let picture = colored(&labels);
        assert_eq!(picture[0], BLACK);
        assert!(picture[1] != BLACK && picture[2] != BLACK && picture[1] != picture[2]);
    }
}
