//! The row-major rectangle of values, and the neighbors of a pixel.

use rayon::prelude::*;

/// Least number of pixels that one task of [`Raster::par_map`] computes.
const PAR_MAP_PIXELS: usize = 1 << 12;

/// One value per pixel, row-major.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Raster<T> {
    width: usize,
    height: usize,
    data: Vec<T>,
}

/// A boolean per pixel.
pub type Mask = Raster<bool>;

/// A region number per pixel; [`UNASSIGNED`] for a pixel of no region.
pub type LabelMap = Raster<u16>;

impl Mask {
    /// Number of pixels that are true.
    pub fn count(&self) -> usize {
        self.as_slice().iter().filter(|&&on| on).count()
    }
}

/// The label of a pixel that belongs to no region.
pub const UNASSIGNED: u16 = 0;

impl<T: Clone> Raster<T> {
    /// A raster of `width × height` copies of `value`.
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self { width, height, data: vec![value; width * height] }
    }
}

impl<T> Raster<T> {
    /// A raster of the values `data`, row after row; `None` unless there are exactly `width × height` values.
    pub fn from_vec(width: usize, height: usize, data: Vec<T>) -> Option<Self> {
        (width.checked_mul(height) == Some(data.len())).then_some(Self { width, height, data })
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.data.len()
    }

    /// Whether the raster has no pixel.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// All values, row after row.
    pub fn as_slice(&self) -> &[T] {
        &self.data
    }

    /// All values, row after row, mutable.
    pub fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.data
    }

    /// The values, row after row, without a copy.
    pub fn into_vec(self) -> Vec<T> {
        self.data
    }

    /// The values of row `y`.
    pub fn row(&self, y: usize) -> &[T] {
        &self.data[y * self.width..(y + 1) * self.width]
    }

    /// The value at column `x`, row `y`, or `None` outside.
    pub fn get(&self, x: usize, y: usize) -> Option<&T> {
        (x < self.width && y < self.height).then(|| &self.data[y * self.width + x])
    }

    /// A raster of the same shape whose values are `f` of the values of this one.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Raster<U> {
        Raster { width: self.width, height: self.height, data: self.data.iter().map(f).collect() }
    }

    /// Like [`Self::map`], computed in parallel.
    pub fn par_map<U: Send>(&self, f: impl Fn(&T) -> U + Sync + Send) -> Raster<U>
    where
        T: Sync,
    {
        let data = self.data.par_iter().with_min_len(PAR_MAP_PIXELS).map(f).collect();
        Raster { width: self.width, height: self.height, data }
    }

    /// Pixel `index` and its 8 neighbors, row-major.
    pub fn around(&self, index: usize) -> impl Iterator<Item = usize> + use<T> {
        let (width, height) = (self.width, self.height);
        let (x, y) = (index % width.max(1), index / width.max(1));
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        (y.saturating_sub(1)..(y + 2).min(height))
            .flat_map(move |v| columns.clone().map(move |u| v * width + u))
    }

    /// Calls `visit` with the indices of the 4-neighbors of pixel `index`, in the order up, left, right, down.
    #[inline]
    pub fn for_each_neighbor(&self, index: usize, visit: impl FnMut(usize)) {
        for_each_neighbor(self.width, self.height, index, visit);
    }
}

impl<T> std::ops::Index<usize> for Raster<T> {
    type Output = T;

    #[inline]
    fn index(&self, index: usize) -> &T {
        &self.data[index]
    }
}

impl<T> std::ops::IndexMut<usize> for Raster<T> {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut T {
        &mut self.data[index]
    }
}

#[inline]
fn for_each_neighbor(width: usize, height: usize, index: usize, mut visit: impl FnMut(usize)) {
    let x = index % width;
    if index >= width {
        visit(index - width);
    }
    if x > 0 {
        visit(index - 1);
    }
    if x + 1 < width {
        visit(index + 1);
    }
    if index + width < width * height {
        visit(index + width);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_raster_needs_exactly_its_pixels() {
        assert!(Raster::from_vec(2, 3, vec![0; 6]).is_some());
        assert!(Raster::from_vec(2, 3, vec![0; 5]).is_none());
        assert!(Raster::<u8>::from_vec(usize::MAX, 2, vec![]).is_none());
    }

    #[test]
    fn neighbors_stay_inside() {
        let raster = Raster::filled(3, 2, 0);
        let of = |index| {
            let mut found = Vec::new();
            raster.for_each_neighbor(index, |n| found.push(n));
            found
        };
        assert_eq!(of(0), [1, 3]);
        assert_eq!(of(1), [0, 2, 4]);
        assert_eq!(of(5), [2, 4]);
        let single = Raster::filled(1, 1, 0);
        single.for_each_neighbor(0, |_| panic!("a single pixel has no neighbor"));
    }
}
