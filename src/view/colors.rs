//! Colors of regions that stay with the objects while parameters move.

use super::snapshot::overlaps;
use crate::analysis::Analysis;
use crate::export::Palette;
use crate::raster::{LabelMap, RegionId, UNASSIGNED};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// Least share of the smaller region's pixels that two regions share, if one region continues the other.
const SHARED: f64 = 0.2;

/// A color for each region: the color of the earlier region that the region continues, otherwise a color that differs from
/// those of its neighbors.
pub(crate) fn region_colors(analysis: &Analysis, before: Option<(&LabelMap, &[[u8; 3]])>) -> Vec<[u8; 3]> {
    colors(&analysis.finals.labels, &neighbors_by_region(analysis), before)
}

/// The colors `first` for the first regions, and for each further region a color that differs from those of its neighbors.
pub(crate) fn colors_with_further_regions(analysis: &Analysis, first: &[[u8; 3]]) -> Vec<[u8; 3]> {
    further_colors(&neighbors_by_region(analysis), first)
}

/// The neighbors of each region, by [`RegionId::index`].
fn neighbors_by_region(analysis: &Analysis) -> Vec<&[RegionId]> {
    analysis.intrinsic.regions.iter().map(|region| region.neighbors.as_slice()).collect()
}

/// The colors `first`, and a color for each further region. `neighbors` and the colors are lists by [`RegionId::index`].
fn further_colors(neighbors: &[&[RegionId]], first: &[[u8; 3]]) -> Vec<[u8; 3]> {
    let palette = Palette::new();
    let kept = std::iter::once(None).chain(first.iter().map(|&color| palette.index_of(color)));
    let kept: Vec<Option<u8>> = kept.collect();
    assigned(&palette, neighbors, &kept)
}

/// Colors for `count` hypotheses that became no region, in a fixed order: colors that no region has, as long as there are any.
pub(crate) fn colors_of_dropped(taken: &[[u8; 3]], count: usize) -> Vec<[u8; 3]> {
    let palette = Palette::new();
    let all = palette.colors();
    let free: Vec<[u8; 3]> = all.iter().copied().filter(|color| !taken.contains(color)).collect();
    let from = if free.is_empty() { all } else { &free };
    from.iter().copied().cycle().take(count).collect()
}

/// The colors of the regions. `neighbors`, the former colors and the returned colors are lists by [`RegionId::index`].
fn colors(
    labels: &LabelMap,
    neighbors: &[&[RegionId]],
    before: Option<(&LabelMap, &[[u8; 3]])>,
) -> Vec<[u8; 3]> {
    let palette = Palette::new();
    let mut kept = vec![None; neighbors.len() + 1];
    if let Some((earlier, colors)) = before {
        for (now, old) in continued_regions(earlier, labels) {
            let color = colors.get(usize::from(old) - 1).and_then(|&color| palette.index_of(color));
            if let Some(slot) = kept.get_mut(usize::from(now)) {
                *slot = color;
            }
        }
    }
    // Two regions of one color would look like one region: the smaller, which has the higher number, gets another color. Of more
    // regions than colors, only adjacent ones differ.
    let differ = neighbors.len() <= palette.colors().len();
    for now in 1..kept.len() {
        let touches = |other: usize| neighbors[now - 1].iter().any(|id| usize::from(id.get()) == other);
        if kept[now].is_some() && (1..now).any(|other| kept[other] == kept[now] && (differ || touches(other)))
        {
            kept[now] = None;
        }
    }
    assigned(&palette, neighbors, &kept)
}

/// The colors of the regions, which differ from those of their neighbors. `neighbors`: by [`RegionId::index`]; `kept`: the indices of
/// colors in the palette that regions keep, by label.
fn assigned(palette: &Palette, neighbors: &[&[RegionId]], kept: &[Option<u8>]) -> Vec<[u8; 3]> {
    let mut touching = vec![Vec::new()];
    touching.extend(neighbors.iter().map(|list| list.iter().map(|id| u32::from(id.get())).collect()));
    palette.assign_keeping(&touching, kept)[1..].iter().map(|&index| palette.color(index)).collect()
}

/// Pairs of a region and the earlier region that the region continues, the largest overlaps first. An earlier region is
/// continued by one region at most.
fn continued_regions(before: &LabelMap, after: &LabelMap) -> Vec<(u16, u16)> {
    if (before.width(), before.height()) != (after.width(), after.height()) {
        return Vec::new();
    }
    let overlaps = overlaps(before, after);
    let (mut old_sizes, mut new_sizes) = (BTreeMap::new(), BTreeMap::new());
    let shared = |old: usize| overlaps[old].iter().map(move |&(new, pixels)| (old as u16, new, pixels));
    for (old, new, pixels) in (0..overlaps.len()).flat_map(shared) {
        *old_sizes.entry(old).or_insert(0) += pixels;
        *new_sizes.entry(new).or_insert(0) += pixels;
    }
    let mut pairs: Vec<(usize, u16, u16)> = (0..overlaps.len())
        .flat_map(shared)
        .filter(|&(old, new, pixels)| {
            let smaller: usize = old_sizes[&old].min(new_sizes[&new]);
            old != UNASSIGNED && new != UNASSIGNED && pixels as f64 >= SHARED * smaller as f64
        })
        .map(|(old, new, pixels)| (pixels, old, new))
        .collect();
    pairs.sort_unstable_by_key(|&(pixels, old, new)| (Reverse(pixels), old, new));
    let mut continued: Vec<(u16, u16)> = Vec::new();
    for (_, old, new) in pairs {
        if old_sizes.contains_key(&old) && new_sizes.contains_key(&new) {
            continued.push((new, old));
            old_sizes.remove(&old);
            new_sizes.remove(&new);
        }
    }
    continued
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use crate::segment::neighbors;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    fn labels(rows: &[&str]) -> LabelMap {
        let label = |c: char| c.to_digit(10).unwrap_or(0) as u16;
        let data = rows.iter().flat_map(|row| row.chars()).map(label).collect();
        Raster::from_vec(rows[0].len(), rows.len(), data).unwrap()
    }

    fn colored(map: &LabelMap, before: Option<(&LabelMap, &[[u8; 3]])>) -> Vec<[u8; 3]> {
        let regions = usize::from(map.as_slice().iter().copied().max().unwrap_or(0));
        let lists = neighbors(map, regions);
        colors(map, &lists.iter().map(Vec::as_slice).collect::<Vec<_>>(), before)
    }

    #[test]
    fn regions_keep_their_colors_when_numbers_and_outlines_change() {
        let first = labels(&["1111..", "1122..", "1122.3", "....33"]);
        let colors = colored(&first, None);
        // 2 has grown and is now the largest; 3 has shrunk; 4 is new.
        let second = labels(&["2221..", "2111..", "2111.3", "44...."]);
        let again = colored(&second, Some((&first, &colors)));
        assert_eq!(again[..3], [colors[1], colors[0], colors[2]]);
        assert!(!colors.contains(&again[3]));
    }

    #[test]
    fn of_two_parts_the_larger_keeps_the_color_and_of_two_joined_the_larger_gives_it() {
        let whole = labels(&["111111..22"]);
        let parts = labels(&["1111.2..33"]);
        let colors = colored(&whole, None);
        let parted = colored(&parts, Some((&whole, &colors)));
        assert_eq!((parted[0], parted[2]), (colors[0], colors[1]));
        assert!(!colors.contains(&parted[1]));
        assert_eq!(colored(&whole, Some((&parts, &parted))), colors);
    }

    #[test]
    fn further_regions_differ_from_their_neighbors_and_the_first_keep_their_colors() {
        let map = labels(&["1133", "2244"]);
        let lists = neighbors(&map, 4);
        let lists: Vec<&[RegionId]> = lists.iter().map(Vec::as_slice).collect();
        let first = [Palette::new().color(5), Palette::new().color(9)];
        let colors = further_colors(&lists, &first);
        assert_eq!((colors.len(), &colors[..2]), (4, first.as_slice()));
        assert_eq!(colors.iter().collect::<BTreeSet<_>>().len(), 4);
    }

    #[test]
    fn a_small_overlap_passes_no_color_on() {
        let first = labels(&["1111111111.........."]);
        let second = labels(&[".........11111111111"]);
        assert!(continued_regions(&first, &second).is_empty());
        assert!(continued_regions(&first, &labels(&["11", "11"])).is_empty(), "another picture");
    }

    /// Rectangles that do not overlap, one in each cell of a 6 × 4 grid, numbered by `order`, with margins.
    fn rectangles(order: &[usize], margins: &[[usize; 4]]) -> LabelMap {
        let mut map = LabelMap::filled(60, 40, UNASSIGNED);
        for (cell, (&id, margin)) in order.iter().zip(margins).enumerate() {
            let (left, top) = (cell % 6 * 10, cell / 6 * 10);
            for y in top + margin[0]..top + 10 - margin[1] {
                map.as_mut_slice()[y * 60 + left + margin[2]..y * 60 + left + 10 - margin[3]]
                    .fill(id as u16 + 1);
            }
        }
        map
    }

    fn margins() -> impl Strategy<Value = Vec<[usize; 4]>> {
        prop::collection::vec(prop::array::uniform4(0usize..3), 24)
    }

    proptest! {
        #[test]
        fn permuting_numbers_and_moving_outlines_changes_no_color(
            from in Just((0..24usize).collect::<Vec<_>>()).prop_shuffle(),
            to in Just((0..24usize).collect::<Vec<_>>()).prop_shuffle(),
            before in margins(), after in margins(),
        ) {
            let (first, second) = (rectangles(&from, &before), rectangles(&to, &after));
            let colors = colored(&first, None);
            // Only as many regions as colors, so that no two of one color can come to touch.
            prop_assume!(colors.iter().collect::<BTreeSet<_>>().len() == 24);
            let again = colored(&second, Some((&first, &colors)));
            for cell in 0..24 {
                prop_assert_eq!(again[to[cell]], colors[from[cell]]);
            }
        }
    }

    #[test]
    fn of_two_regions_of_one_color_the_smaller_takes_another_color() {
        let apart = labels(&["111111..22"]);
        let touching = labels(&["11111112.2"]);
        let alike = [Palette::new().color(3); 2];
        for map in [&apart, &touching] {
            let now = colored(map, Some((&apart, &alike)));
            assert!(now[0] == alike[0] && now[1] != alike[1]);
        }
    }
}
