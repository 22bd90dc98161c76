//! Reflection vectors (section 6).

use super::{Describe, LineObjects, line, vector};
use crate::describe::Names;
use crate::describe::names::direction;
use crate::describe::names::short;
use crate::trace::{FitFigures, FitLimits, VectorsFitted};
use serde_json::json;

impl Describe for VectorsFitted {
    fn sentence(&self, _names: &Names) -> String {
        let body = direction(self.body.into());
        let surface = self.surface.map_or_else(
            || {
                let what =
                    if self.unsplit { "its pixels stay as they are" } else { "all is body reflection" };
                format!("no surface vector: {what}")
            },
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
                "fit_rms_counts": self.figures.rms_counts,
                "texture": self.figures.texture,
                "texture_slope": self.figures.texture_slope,
                "light_share": self.figures.light_share,
                "new_edges": self.figures.new_edges,
                "highlights": self.figures.highlights,
                "holds": self.model_fits,
            }),
            json!({
                "least_offset": short(self.least_offset),
                "fit_rms_counts": self.limits.rms_counts,
                "texture": self.limits.texture,
                "texture_slope": self.limits.texture_slope,
                "light_share": self.limits.light_share,
                "new_edges": self.limits.new_edges,
                "highlights": self.limits.highlights,
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
            figures: FitFigures {
                rms_counts: 1.25,
                texture: 0.125,
                texture_slope: 0.0625,
                light_share: 0.375,
                new_edges: 0.03125,
                highlights: Some(0.75),
            },
            limits: FitLimits {
                rms_counts: 1.875,
                rms_sigmas: 1.5,
                texture: 0.25,
                texture_slope: 0.2,
                light_share: 1.0,
                new_edges: 0.12,
                highlights: 0.3,
            },
            model_fits: true,
            is_judged: true,
            origin: [0.0; 3],
            unsplit: false,
            noise_line: None,
        }
    }
}

/// Whether the skewed T explains a region, by the figures of the region.
fn verdict(fitted: &VectorsFitted) -> String {
    let VectorsFitted { figures, limits, .. } = fitted;
    let FitFigures { rms_counts, texture, texture_slope, .. } = figures;
    let has_plane = fitted.surface.is_some();
    let failed = failed_limits(figures, limits, has_plane);
    let is_held = fitted.is_judged.then_some(fitted.model_fits);
    match (is_held, failed.as_str()) {
        (Some(false), _) => format!("it does not hold and its plane is not used: {failed}"),
        (Some(true), "") => {
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
        (None, "") => format!("whether it holds is not asked ({})", distance(*rms_counts, limits, has_plane)),
        (_, failed) => format!("whether it holds is not asked ({failed})"),
    }
}

/// The limits that the figures of a region exceed, as phrases.
pub(in crate::describe) fn failed_limits(
    figures: &FitFigures,
    limits: &FitLimits,
    has_plane: bool,
) -> String {
    let FitFigures { rms_counts: rms, texture, texture_slope: slope, light_share, new_edges, highlights } =
        *figures;
    let far = (rms > limits.rms_counts).then(|| distance(rms, limits, has_plane));
    let textured = (texture > limits.texture && slope > limits.texture_slope).then(|| {
        format!(
            "body and surface vary against each other like a print, correlation {texture:.2} (at most {}), slope {slope:.2} (at \
             most {})",
            limits.texture, limits.texture_slope
        )
    });
    let has_color_of_light = (light_share > limits.light_share).then(|| {
        format!(
            "its body color is the light's as far as is known: the light is uncertain by {light_share:.1} times the angle between \
             them (at most {})",
            limits.light_share
        )
    });
    let has_new_edges = (new_edges > limits.new_edges).then(|| {
        format!(
            "the split would make new edges at {:.0} % of its border (at most {:.0} %), so that it is only a part of an object",
            100.0 * new_edges,
            100.0 * limits.new_edges
        )
    });
    let lacks_highlights = highlights.filter(|&highlights| highlights < limits.highlights).map(|highlights| {
        format!(
            "what its plane takes for surface reflection looks like print, probability of highlights {highlights:.2} (at least {})",
            limits.highlights
        )
    });
    far.into_iter()
        .chain(textured)
        .chain(has_color_of_light)
        .chain(has_new_edges)
        .chain(lacks_highlights)
        .collect::<Vec<_>>()
        .join(", and ")
}

/// `2.2 counts rms from its plane (at most 1.9 = 1.5 σ)`
fn distance(rms: f64, limits: &FitLimits, has_plane: bool) -> String {
    let what = if has_plane { "plane" } else { "line" };
    let FitLimits { rms_counts, rms_sigmas, .. } = limits;
    format!("{rms:.1} counts rms from its {what} (at most {rms_counts:.1} = {rms_sigmas} \u{3c3})")
}
