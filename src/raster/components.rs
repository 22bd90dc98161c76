//! Connected components of pixels that carry the same value (4-connected).

use super::grid::Raster;

/// A component number per pixel, and the number of pixels of each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// Component of each pixel: 0 where `inside` said no, then 1… in the order of first pixels.
    pub labels: Raster<u32>,
    /// Pixels of component `i` at index `i`; index 0 counts the pixels of none.
    pub sizes: Vec<usize>,
}

/// Labels the 4-connected components of equal values among the pixels for which `inside` holds.
pub fn label_components<T: PartialEq>(values: &Raster<T>, inside: impl Fn(&T) -> bool) -> Components {
    let mut labels = Raster::filled(values.width(), values.height(), 0u32);
    let mut sizes = vec![0usize];
    let mut stack = Vec::new();
    for start in 0..values.len() {
        if !inside(&values[start]) {
            sizes[0] += 1;
            continue;
        }
        if labels[start] != 0 {
            continue;
        }
        let label = sizes.len() as u32;
        let mut size = 0;
        labels[start] = label;
        stack.push(start);
        while let Some(pixel) = stack.pop() {
            size += 1;
            values.for_each_neighbour(pixel, |next| {
                if labels[next] == 0 && inside(&values[next]) && values[next] == values[pixel] {
                    labels[next] = label;
                    stack.push(next);
                }
            });
        }
        sizes.push(size);
    }
    Components { labels, sizes }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_that_touch_by_an_edge_are_one_component() {
        let values = Raster::from_vec(4, 3, vec![1, 1, 0, 2, 0, 1, 0, 2, 1, 0, 2, 0]).unwrap();
        let found = label_components(&values, |&v| v != 0);
        assert_eq!(found.labels.as_slice(), [1, 1, 0, 2, 0, 1, 0, 2, 3, 0, 4, 0]);
        assert_eq!(found.sizes, [5, 3, 2, 1, 1]);
    }
}
