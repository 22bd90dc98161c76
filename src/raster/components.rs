//! Connected components of pixels, and the border of a component.
//!
//! The order is fixed, as sums of floating-point numbers over a component depend on it: a component begins with the pixel that
//! the search starts from and goes on breadth first; the neighbors of each pixel are visited in row-major order.

use super::grid::{LabelMap, Mask, Raster, UNASSIGNED};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Least number of pixels that one task of [`pixels_where`] looks at.
const PIXELS_PER_TASK: usize = 1 << 14;

/// Which pixels are neighbors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Connectivity {
    /// Pixels that share a side.
    Four,
    /// Pixels that share a side or a corner.
    Eight,
}

/// Finds the components of a picture one after the other and returns each of them once.
#[derive(Clone, Debug)]
pub struct ComponentSearch {
    connectivity: Connectivity,
    /// Pixels of the components that were found.
    visited: Mask,
    /// Pixels of the component that was found last.
    component: Vec<usize>,
}

impl ComponentSearch {
    /// A search in a picture of `width × height` pixels.
    pub fn new(width: usize, height: usize, connectivity: Connectivity) -> Self {
        Self { connectivity, visited: Raster::filled(width, height, false), component: Vec::new() }
    }

    /// The component of `start` among the pixels for which `member` is true; `start` is its first pixel. None if `start` is no
    /// member, or belongs to a component that was found before. `member` has to be the same in all calls for pixels of
    /// components that were not found yet.
    pub fn component_at(&mut self, start: usize, member: impl Fn(usize) -> bool) -> Option<&[usize]> {
        if self.visited[start] || !member(start) {
            return None;
        }
        let Self { connectivity, visited, component, .. } = self;
        component.clear();
        component.push(start);
        visited[start] = true;
        let mut next = 0;
        while let Some(&pixel) = component.get(next) {
            next += 1;
            for_each_near(visited, *connectivity, pixel, |visited, near| {
                if !visited[near] && member(near) {
                    visited[near] = true;
                    component.push(near);
                }
            });
        }
        Some(component)
    }
}

/// The pixels of a picture of so many pixels for which `is_member` is true, in ascending order, computed in parallel: from these alone a search
/// of components begins.
pub fn pixels_where(pixels: usize, is_member: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
    let chosen = (0..pixels).into_par_iter().with_min_len(PIXELS_PER_TASK);
    chosen.filter(|&pixel| is_member(pixel)).collect()
}

/// Calls `visit` with the mask and each neighbor of a pixel, in row-major order. With [`Connectivity::Eight`] the pixel
/// itself is among them.
#[inline]
fn for_each_near(
    mask: &mut Mask,
    connectivity: Connectivity,
    pixel: usize,
    mut visit: impl FnMut(&mut Mask, usize),
) {
    match connectivity {
        Connectivity::Four => {
            let mut near = [pixel; 4];
            let mut count = 0;
            mask.for_each_neighbor(pixel, |neighbor| {
                near[count] = neighbor;
                count += 1;
            });
            near[..count].iter().for_each(|&neighbor| visit(mask, neighbor));
        }
        Connectivity::Eight => mask.around(pixel).for_each(|neighbor| visit(mask, neighbor)),
    }
}

/// All components of a mask, as a number per pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// Component of each pixel, from 0 in the row-major order of their first pixels; [`Components::NONE`] where the mask is
    /// not set.
    pub of: Raster<u32>,
    /// Number of pixels of each component.
    pub sizes: Vec<usize>,
}

impl Components {
    /// The number of pixels that belong to no component.
    pub const NONE: u32 = u32::MAX;

    /// The components of the set pixels.
    pub fn of_mask(mask: &Mask, connectivity: Connectivity) -> Self {
        let mut search = ComponentSearch::new(mask.width(), mask.height(), connectivity);
        let mut of = mask.map(|_| Self::NONE);
        let mut sizes = Vec::new();
        for start in pixels_where(mask.len(), |pixel| mask[pixel]) {
            if let Some(component) = search.component_at(start, |pixel| mask[pixel]) {
                for &pixel in component {
                    of[pixel] = sizes.len() as u32;
                }
                sizes.push(component.len());
            }
        }
        Self { of, sizes }
    }
}

/// The border of a component: the sides of its pixels, counted by the label of the pixel on the other side.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Border {
    sides: BTreeMap<u16, usize>,
    /// Whether the component reaches the edge of the picture.
    pub at_edge: bool,
}

impl Border {
    /// Counts the sides of `component` that face a pixel for which `outside` is true.
    pub fn of(labels: &LabelMap, component: &[usize], outside: impl Fn(usize) -> bool) -> Self {
        let (width, height) = (labels.width(), labels.height());
        let mut border = Self::default();
        for &pixel in component {
            let (x, y) = (pixel % width, pixel / width);
            border.at_edge |= x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            labels.for_each_neighbor(pixel, |near| {
                if outside(near) {
                    *border.sides.entry(labels[near]).or_default() += 1;
                }
            });
        }
        border
    }

    /// Sides that face pixels with this label.
    pub fn sides(&self, label: u16) -> usize {
        self.sides.get(&label).copied().unwrap_or(0)
    }

    /// Sides that face pixels of any region.
    pub fn assigned_sides(&self) -> usize {
        self.sides.iter().filter(|(label, _)| **label != UNASSIGNED).map(|(_, sides)| sides).sum()
    }

    /// The region that most sides face, the one with the smaller number if two are equal, and its share of the sides that face
    /// regions, 0…1; none without such a side.
    pub fn main_region(&self) -> Option<(u16, f64)> {
        let assigned = self.sides.iter().filter(|(label, _)| **label != UNASSIGNED);
        let (&region, &most) = assigned.max_by_key(|&(&label, &sides)| (sides, u16::MAX - label))?;
        Some((region, most as f64 / self.assigned_sides() as f64))
    }

    /// Whether regions surround the component on all sides.
    pub fn is_closed(&self) -> bool {
        !self.at_edge && self.sides(UNASSIGNED) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(rows: &[&str]) -> Raster<u8> {
        let data = rows.iter().flat_map(|row| row.bytes()).collect();
        Raster::from_vec(rows[0].len(), rows.len(), data).unwrap()
    }

    /// The components of `#`, a letter each in the order in which they are found, as rows of text.
    fn lettered(rows: &[&str], connectivity: Connectivity) -> Vec<String> {
        let found = Components::of_mask(&grid(rows).map(|&byte| byte == b'#'), connectivity);
        let letter = |&of: &u32| if of == Components::NONE { '.' } else { char::from(b'a' + of as u8) };
        (0..rows.len()).map(|y| found.of.row(y).iter().map(letter).collect()).collect()
    }

    #[test]
    fn pixels_that_share_a_corner_are_connected_with_eight_neighbors_only() {
        let rows = ["##..#", "..#.#", "#...#", "##.#."];
        assert_eq!(lettered(&rows, Connectivity::Four), ["aa..b", "..c.b", "d...b", "dd.e."]);
        assert_eq!(lettered(&rows, Connectivity::Eight), ["aa..b", "..a.b", "c...b", "cc.b."]);
    }

    #[test]
    fn a_component_goes_on_breadth_first_from_its_start() {
        let cross = grid(&[".#.", "###", ".#."]);
        let search = |connectivity, start| {
            let mut search = ComponentSearch::new(3, 3, connectivity);
            let found = search.component_at(start, |pixel| cross[pixel] == b'#').map(<[usize]>::to_vec);
            let again = search.component_at(start, |pixel| cross[pixel] == b'#').is_none();
            (found, again)
        };
        assert_eq!(search(Connectivity::Four, 4), (Some(vec![4, 1, 3, 5, 7]), true));
        assert_eq!(search(Connectivity::Four, 1), (Some(vec![1, 4, 3, 5, 7]), true));
        assert_eq!(search(Connectivity::Eight, 1), (Some(vec![1, 3, 4, 5, 7]), true));
        assert_eq!(search(Connectivity::Four, 0), (None, true));
    }

    #[test]
    fn a_border_is_counted_by_sides() {
        let labels = grid(&["11112", "1..22", "11.12", "11111"]).map(|&byte| match byte {
            b'.' => UNASSIGNED,
            digit => u16::from(digit - b'0'),
        });
        let unassigned = |pixel: usize| labels[pixel] == UNASSIGNED;
        let mut search = ComponentSearch::new(5, 4, Connectivity::Four);
        let hole = search.component_at(6, unassigned).unwrap();
        let border = Border::of(&labels, hole, |pixel| !unassigned(pixel));
        assert_eq!((border.sides(1), border.sides(2), border.assigned_sides()), (7, 1, 8));
        assert_eq!(border.main_region(), Some((1, 7.0 / 8.0)));
        assert!(border.is_closed());
        let part = Border::of(&labels, &hole[..1], |pixel| pixel != 6);
        assert_eq!((part.sides(UNASSIGNED), part.is_closed()), (1, false));
        assert!(!Border::of(&labels, &[4], |_| false).is_closed(), "the edge of the picture");
        assert_eq!(Border::of(&labels, &[4], |_| false).main_region(), None);
        assert_eq!(Border::of(&labels, &[8], |_| true).main_region(), Some((1, 2.0 / 3.0)));
        let equal = Border::of(&labels, &[13], |pixel| pixel == 8 || pixel == 18);
        assert_eq!(equal.main_region(), Some((1, 0.5)), "the smaller number");
    }

    /// The least index among the pixels that are connected, by passing it on until nothing changes.
    fn naive(mask: &Mask, connectivity: Connectivity) -> Vec<Option<usize>> {
        let (width, height) = (mask.width(), mask.height());
        let mut least: Vec<Option<usize>> = (0..mask.len()).map(|i| mask[i].then_some(i)).collect();
        let near = |a: usize, b: usize| {
            let (dx, dy) = ((a % width).abs_diff(b % width), (a / width).abs_diff(b / width));
            dx.max(dy) == 1 && (connectivity == Connectivity::Eight || dx + dy == 1)
        };
        for _ in 0..width * height {
            for a in 0..mask.len() {
                for b in (0..mask.len()).filter(|&b| near(a, b)) {
                    if let (Some(own), Some(other)) = (least[a], least[b]) {
                        least[a] = Some(own.min(other));
                    }
                }
            }
        }
        least
    }

    proptest! {
        #[test]
        fn components_are_those_of_a_naive_search(
            (width, data) in (1usize..7).prop_flat_map(|width| {
                (Just(width), prop::collection::vec(any::<bool>(), width..=6 * width))
            }),
            eight in any::<bool>(),
        ) {
            let height = data.len() / width;
            let mask = Mask::from_vec(width, height, data[..width * height].to_vec()).unwrap();
            let connectivity = if eight { Connectivity::Eight } else { Connectivity::Four };
            let found = Components::of_mask(&mask, connectivity);
            let expected = naive(&mask, connectivity);
            let mut firsts = Vec::new();
            for pixel in 0..mask.len() {
                let Some(first) = expected[pixel] else {
                    prop_assert_eq!(found.of[pixel], Components::NONE);
                    continue;
                };
                if first == pixel {
                    firsts.push(pixel);
                }
                prop_assert_eq!(firsts[found.of[pixel] as usize], first);
            }
            let size = |first: &usize| expected.iter().filter(|least| **least == Some(*first)).count();
            prop_assert_eq!(found.sizes, firsts.iter().map(size).collect::<Vec<_>>());
        }
    }
}
