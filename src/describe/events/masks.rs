//! The masks (section 4).

use super::{Describe, LineObjects, nothing};
use crate::describe::names::{percent, short};
use crate::describe::{Names, counted, grouped};
use crate::photo::ClippedAreaVerdict;
use crate::trace::{ClippedAreaJudged, MasksMade};
use serde_json::json;

impl Describe for MasksMade {
    fn sentence(&self, _names: &Names) -> String {
        let Self { dark, distorted, sigma, .. } = self;
        let noise = sigma.map_or_else(String::new, |sigma| format!(", noise \u{3c3} {sigma:.2} counts"));
        let distorted = grouped(*distorted);
        format!("{} dark, {distorted} clipped or bloomed{noise}", counted(*dark, "pixel"))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"dark": self.dark, "distorted": self.distorted, "sigma": self.sigma}),
            json!({
                "min_intensity": self.limits.min_intensity,
                "clip_threshold": self.limits.clip_threshold,
                "bloom_density": self.limits.bloom_density,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let limits =
            crate::photo::MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 1 };
        Self { limits, dark: 7, distorted: 3, sigma: Some(1.25) }
    }
}

impl Describe for ClippedAreaJudged {
    fn sentence(&self, names: &Names) -> String {
        let (clipped, place) = (counted(self.clipped, "clipped pixel"), names.pixel(self.pixel));
        let verdict = match self.verdict {
            ClippedAreaVerdict::MayBeHighlight => "may be a highlight",
            ClippedAreaVerdict::Few => {
                "may be the highlight of a facet, or hidden in part: its edge is abrupt, but few clipped pixels of the picture have such an edge"
            }
            ClippedAreaVerdict::Object => "is an object that clips, and no highlight: its edge is abrupt",
        };
        let [left, limit] = [self.left.value, self.left.limit].map(percent);
        format!(
            "the area of {clipped} at {place} {verdict}; {left} of the surface reflection would be left one pixel farther out (abrupt: below {limit})"
        )
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        let verdict = match self.verdict {
            ClippedAreaVerdict::MayBeHighlight => "may_be_highlight",
            ClippedAreaVerdict::Few => "few",
            ClippedAreaVerdict::Object => "object",
        };
        LineObjects::new(
            json!({"pixel": names.position(self.pixel)}),
            json!({"pixels": self.clipped, "left": short(self.left.value as f32), "verdict": verdict}),
            json!({"left": short(self.left.limit as f32)}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let pixels = [5, 6, 7].map(crate::raster::PixelIndex::new).to_vec();
        Self {
            pixel: pixels[0],
            clipped: 2,
            left: crate::trace::Measured::new(0.05, 0.2),
            verdict: ClippedAreaVerdict::Object,
            pixels,
        }
    }
}
