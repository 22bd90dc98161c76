//! Reflection vectors (section 6).

use super::{Describe, LineObjects, line, vector};
use crate::describe::Names;
use crate::describe::names::direction;
use crate::describe::names::short;
use crate::trace::{FitLimits, VectorsFitted};
use serde_json::json;

impl Describe for VectorsFitted {
    fn sentence(&self, _names: &Names) -> String {
        let body = direction(self.body.into());
        let surface = self.surface.map_or_else(
            || "no surface vector: all is body reflection".to_owned(),
            |surface| format!("surface vector {}", direction(surface.into())),
        );
        let verdict = verdict(self);
        format!("region {} is split by body vector {body}, {surface}; {verdict}", self.region)
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"final": self.region}),
            json!({
                "body": vector(&self.body),
                "surface": self.surface.as_ref().map(vector),
                "matte": line(&self.matte),
                "start": vector(&self.start),
                "starts": self.starts.iter().map(vector).collect::<Vec<_>>(),
                "fit_rms_counts": self.rms_counts,
                "texture": self.texture,
                "texture_slope": self.texture_slope,
                "holds": self.model_fits,
            }),
            json!({
                "least_offset": short(self.least_offset),
                "fit_rms_counts": self.limits.rms_counts,
                "texture": self.limits.texture,
                "texture_slope": self.limits.texture_slope,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let matte = super::linear::example_line();
        Self {
            region: crate::raster::RegionId::from_index(0),
            body: matte.direction,
            surface: None,
            matte,
            start: matte.mean,
            starts: vec![matte.mean],
            highlight: None,
            least_offset: 2.5,
            rms_counts: 1.25,
            texture: 0.125,
            texture_slope: 0.0625,
            limits: FitLimits { rms_counts: 1.875, rms_sigmas: 1.5, texture: 0.25, texture_slope: 0.2 },
            model_fits: true,
            origin: [0.0; 3],
        }
    }
}

/// Whether the skewed T explains a region, by the figures of the region.
fn verdict(fitted: &VectorsFitted) -> String {
    let VectorsFitted { rms_counts, texture, texture_slope, limits, .. } = fitted;
    let has_plane = fitted.surface.is_some();
    let failed = failed_limits([*rms_counts, *texture, *texture_slope], limits, has_plane);
    match (fitted.model_fits, failed.as_str()) {
        (false, _) => format!("it does not hold and its plane is not used: {failed}"),
        (true, "") => {
            let texture = if has_plane {
                format!(
                    ", texture correlation {texture:.2} (suspect above {}), slope {texture_slope:.2} (above {})",
                    limits.texture, limits.texture_slope
                )
            } else {
                String::new()
            };
            format!("it holds: {}{texture}", distance(*rms_counts, limits, has_plane))
        }
        (true, _) => format!("whether it holds is not asked ({failed})"),
    }
}

/// The limits that the figures of a region exceed, as phrases.
pub(in crate::describe) fn failed_limits(
    [rms, texture, slope]: [f64; 3],
    limits: &FitLimits,
    has_plane: bool,
) -> String {
    let far = (rms > limits.rms_counts).then(|| distance(rms, limits, has_plane));
    let textured = (texture > limits.texture && slope > limits.texture_slope).then(|| {
        format!(
            "body and surface vary against each other like a print, correlation {texture:.2} (at most {}), slope {slope:.2} (at \
             most {})",
            limits.texture, limits.texture_slope
        )
    });
    far.into_iter().chain(textured).collect::<Vec<_>>().join(", and ")
}

/// `2.2 counts rms from its plane (at most 1.9 = 1.5 σ)`
fn distance(rms: f64, limits: &FitLimits, has_plane: bool) -> String {
    let what = if has_plane { "plane" } else { "line" };
    let FitLimits { rms_counts, rms_sigmas, .. } = limits;
    format!("{rms:.1} counts rms from its {what} (at most {rms_counts:.1} = {rms_sigmas} \u{3c3})")
}
