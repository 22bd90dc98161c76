//! The masks (section 4).

use super::{Describe, LineObjects, nothing};
use crate::describe::{Names, counted, grouped};
use crate::trace::MasksMade;
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
