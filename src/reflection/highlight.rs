//! Section 6: a pixel is matte or highlight by the nearest line, the matte line or a highlight line.
//!
//! A convex object may show several highlights, each with a line of its own. All highlight lines are parallel to the surface
//! vector (section 7.4, figure 13).

use crate::color::{Line, Vec3, dot, rgb};

/// Largest number of highlight lines of one region.
pub const MOST_BRANCHES: usize = 4;

/// The test whether a pixel is a highlight pixel: it is, if a highlight line is nearer than the matte line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighlightTest {
    mean: [f32; 3],
    direction: [f32; 3],
    starts: [[f32; 3]; MOST_BRANCHES],
    branches: usize,
    surface: [f32; 3],
}

impl HighlightTest {
    /// The test for a matte line and highlight lines, which begin at `starts` (counts) and run along the unit vector `surface`.
    /// Only the first [`MOST_BRANCHES`] starts are used.
    pub fn of_lines(matte: &Line, starts: &[Vec3], surface: &Vec3) -> Self {
        let mut places = [[0.0; 3]; MOST_BRANCHES];
        places.iter_mut().zip(starts).for_each(|(place, start)| *place = rgb(start));
        Self {
            mean: rgb(&matte.mean),
            direction: rgb(&matte.direction),
            starts: places,
            branches: starts.len().min(MOST_BRANCHES),
            surface: rgb(surface),
        }
    }

    /// Whether a color is nearer to a highlight line than to the matte line.
    #[inline]
    pub fn is_highlight(&self, color: [f32; 3]) -> bool {
        self.highlight2(color).1 < self.matte2(color)
    }

    /// Distances of a color from the matte line and from the nearest highlight line, counts.
    pub fn distances(&self, color: [f32; 3]) -> [f32; 2] {
        [self.matte2(color), self.highlight2(color).1].map(|squared| squared.max(0.0).sqrt())
    }

    /// Index of the highlight line that is nearest to a color, in the order of the starts.
    pub fn nearest(&self, color: [f32; 3]) -> usize {
        self.highlight2(color).0
    }

    #[inline]
    fn matte2(&self, color: [f32; 3]) -> f32 {
        let v = from(color, self.mean);
        dot(v, v) - dot(v, self.direction).powi(2)
    }

    /// Index of the nearest highlight line and its squared distance, counts²; infinite without a highlight line.
    #[inline]
    fn highlight2(&self, color: [f32; 3]) -> (usize, f32) {
        let mut nearest = (0, f32::INFINITY);
        for (branch, &start) in self.starts[..self.branches].iter().enumerate() {
            let w = from(color, start);
            let distance2 = dot(w, w) - dot(w, self.surface).max(0.0).powi(2);
            if distance2 < nearest.1 {
                nearest = (branch, distance2);
            }
        }
        nearest
    }
}

#[inline]
fn from(color: [f32; 3], point: [f32; 3]) -> [f32; 3] {
    [color[0] - point[0], color[1] - point[1], color[2] - point[2]]
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn the_highlight_line_begins_at_its_start() {
        let matte = Line::new(Vec3::x() * 50.0, Vec3::x());
        let test = HighlightTest::of_lines(&matte, &[Vec3::x() * 100.0], &Vec3::y());
        assert!(test.is_highlight([100.0, 30.0, 4.0]));
        assert_eq!(test.distances([100.0, 3.0, 4.0]), [5.0, 4.0]);
        // The highlight line ends at its start: the distance is that from the start.
        assert_eq!(test.distances([97.0, -4.0, 0.0]), [4.0, 5.0]);
        assert!(!test.is_highlight([50.0, 10.0, 0.0]));
    }

    #[test]
    fn a_second_highlight_line_adds_its_own_pixels_only() {
        let matte = Line::new(Vec3::x() * 50.0, Vec3::x());
        let (bright, dim) = (Vec3::x() * 100.0, Vec3::x() * 40.0);
        let one = HighlightTest::of_lines(&matte, &[bright], &Vec3::y());
        let two = HighlightTest::of_lines(&matte, &[bright, dim], &Vec3::y());
        for color in [[99.0, 30.0, 4.0], [20.0, 3.0, 0.0], [70.0, 12.0, 1.0]] {
            assert_eq!(one.is_highlight(color), two.is_highlight(color), "{color:?}");
            assert_eq!(one.distances(color)[0], two.distances(color)[0]);
        }
        let under_the_dim_one = [42.0, 30.0, 0.0];
        assert!(!one.is_highlight(under_the_dim_one) && two.is_highlight(under_the_dim_one));
        assert_eq!(two.distances(under_the_dim_one), [30.0, 2.0]);
        assert_eq!((two.nearest(under_the_dim_one), two.nearest([98.0, 30.0, 0.0])), (1, 0));
        let none = HighlightTest::of_lines(&matte, &[], &Vec3::y());
        assert!(!none.is_highlight(under_the_dim_one));
        assert_eq!(
            HighlightTest::of_lines(&matte, &[bright; 9], &Vec3::y()).distances([100.0, 9.0, 0.0]),
            [9.0, 0.0]
        );
    }
}
