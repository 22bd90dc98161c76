//! Section 6: is a pixel matte or highlight? The nearer of both lines says so.

use crate::color::{Line, Vec3, dot, rgb};

/// Tells highlight from matte pixels: which of the two lines is nearer?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighlightTest {
    mean: [f32; 3],
    direction: [f32; 3],
    start: [f32; 3],
    surface: [f32; 3],
}

impl HighlightTest {
    /// The test of a matte line and a highlight line from `start` (counts) on along the unit vector `surface`.
    pub fn of_lines(matte: &Line, start: &Vec3, surface: &Vec3) -> Self {
        Self {
            mean: rgb(&matte.mean),
            direction: rgb(&matte.direction),
            start: rgb(start),
            surface: rgb(surface),
        }
    }

    /// Whether a colour is nearer to the highlight line.
    #[inline]
    pub fn is_highlight(&self, color: [f32; 3]) -> bool {
        let [matte2, highlight2] = self.distances2(color);
        highlight2 < matte2
    }

    /// Distances of a colour from the matte line and from the highlight line, counts.
    pub fn distances(&self, color: [f32; 3]) -> [f32; 2] {
        self.distances2(color).map(|squared| squared.max(0.0).sqrt())
    }

    #[inline]
    fn distances2(&self, color: [f32; 3]) -> [f32; 2] {
        let from = |point: [f32; 3]| [color[0] - point[0], color[1] - point[1], color[2] - point[2]];
        let v = from(self.mean);
        let matte2 = dot(v, v) - dot(v, self.direction).powi(2);
        let w = from(self.start);
        let highlight2 = dot(w, w) - dot(w, self.surface).max(0.0).powi(2);
        [matte2, highlight2]
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn the_highlight_line_begins_where_it_leaves_the_matte_line() {
        let matte = Line::new(Vec3::x() * 50.0, Vec3::x());
        let test = HighlightTest::of_lines(&matte, &(Vec3::x() * 100.0), &Vec3::y());
        assert!(test.is_highlight([100.0, 30.0, 4.0]));
        assert_eq!(test.distances([100.0, 3.0, 4.0]), [5.0, 4.0]);
        // Behind its start there is no highlight line.
        assert_eq!(test.distances([97.0, -4.0, 0.0]), [4.0, 5.0]);
        assert!(!test.is_highlight([50.0, 10.0, 0.0]));
    }
}
