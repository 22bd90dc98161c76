//! Section 6: the split of one undistorted pixel, from its color and its region's [`PixelSplitter`].

use crate::reflection::{AmountRule, HighlightTest};
use crate::trace::PixelKind;

/// How the undistorted pixels of one region are split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PixelSplitter {
    /// Divides a color into amounts of body reflection, surface reflection and noise.
    pub(crate) rule: AmountRule,
    /// Tells highlight pixels from matte pixels; none where every pixel is matte.
    pub(crate) highlight_test: Option<HighlightTest>,
    /// Whether the region is not split: the body reflection of a pixel is its color (reading `unsplit_without_highlight`).
    pub(crate) keeps_color: bool,
}

/// One pixel, split. Colors are counts above the ambient light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SplitPixel {
    /// Body reflection m_b·C_b, counts.
    pub(crate) body: [f32; 3],
    /// Surface reflection m_s·C_s, counts.
    pub(crate) surface: [f32; 3],
    /// Signed distance ε from the dichromatic plane, counts.
    pub(crate) noise: f32,
    /// Whether the pixel is matte or highlight.
    pub(crate) kind: PixelKind,
}

impl PixelSplitter {
    /// Splits the color of an undistorted pixel, counts above the ambient light.
    #[inline]
    pub(crate) fn split(&self, color: [f32; 3]) -> SplitPixel {
        let components = self.rule.amounts(color).components;
        let [body, surface] = self.rule.colors(components);
        let body = if self.keeps_color { color } else { body };
        SplitPixel { body, surface, noise: components.noise, kind: self.kind(color) }
    }

    /// Whether an undistorted pixel of this color is matte or highlight.
    #[inline]
    pub(crate) fn kind(&self, color: [f32; 3]) -> PixelKind {
        if self.highlight_test.as_ref().is_some_and(|test| test.is_highlight(color)) {
            PixelKind::Highlight
        } else {
            PixelKind::Matte
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Cylinder, Line, Vec3, vec3};

    #[test]
    fn a_split_pixel_adds_up_to_its_color_and_is_matte_or_highlight() {
        let (body, surface) = (Vec3::new(0.9, 0.3, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let start = body * 100.0;
        let splitter = PixelSplitter {
            rule: AmountRule::new(&body, Some(&surface), f32::NEG_INFINITY),
            highlight_test: Some(HighlightTest::of_lines(&Line::new(start, body), &[start], &surface)),
            keeps_color: false,
        };
        for (amount, kind) in [(0.0, PixelKind::Matte), (80.0, PixelKind::Highlight)] {
            let color = crate::color::rgb(&(start + surface * amount));
            let split = splitter.split(color);
            assert_eq!(split.kind, kind);
            assert!((vec3(split.body) + vec3(split.surface) - vec3(color)).norm() < 1e-3, "{split:?}");
            assert!(split.noise.abs() < 1e-3);
        }
        let without_a_plane = PixelSplitter {
            rule: AmountRule::new(&body, None, f32::NEG_INFINITY),
            highlight_test: None,
            keeps_color: false,
        };
        let split = without_a_plane.split([90.0, 30.0, 29.0]);
        assert_eq!((split.surface, split.noise, split.kind), ([0.0; 3], 0.0, PixelKind::Matte));
        assert!(split.body[2] < 25.0, "on the line through black: {:?}", split.body);
        let unsplit = PixelSplitter {
            rule: without_a_plane.rule.with_noise_line(Some(Cylinder::new(&Line::new(start, body), 1.0))),
            keeps_color: true,
            ..without_a_plane
        };
        let split = unsplit.split([90.0, 30.0, 29.0]);
        assert_eq!((split.body, split.surface), ([90.0, 30.0, 29.0], [0.0; 3]));
        assert!((split.noise - 8.81).abs() < 0.01, "{} counts from the matte line", split.noise);
    }
}
