//! The cluster of the sphere of section 3 in the color space, in the colors of the selected region's plane.

use crate::app::State;
use crate::gpu::{Batch, Point};
use crate::gui::theme::ThemeColors;
use crate::raster::RegionId;
use crate::view::{ColorSpace, GeometrySettings, Picture, Theme, region_plane, sphere_colors};

/// Diameter of a point, screen points.
const POINT_PT: f32 = 3.0;

/// Identity of the points: generation of the result, region, settings, color space and theme.
type Key = (u64, RegionId, GeometrySettings, ColorSpace, Theme);

/// The points of the sphere, with the inputs that the points were made for.
#[derive(Default)]
pub struct SpherePoints {
    key: Option<Key>,
    /// The points to draw: none, or one batch.
    pub drawn: Vec<Batch<Point>>,
}

impl SpherePoints {
    /// Rebuilds the points when an input has changed.
    pub fn update(&mut self, state: &State, palette: &ThemeColors, picture: &Picture) {
        let settings = state.view.geometry;
        let shown = state.shown().filter(|_| settings.is_drawn);
        let subject = shown.zip(state.selected_region());
        let space = state.view.cube.space;
        let key =
            subject.map(|(shown, region)| (shown.generation, region, settings, space, state.view.theme));
        if self.key == key {
            return;
        }
        self.key = key;
        let plane = subject.and_then(|(shown, region)| region_plane(shown, region));
        let full = picture.histogram.full_counts;
        let [r, g, b, _] = palette.accent.to_array();
        let points = plane.map_or_else(Vec::new, |plane| sphere_colors(settings, &plane)).into_iter();
        let points: Vec<Point> = points
            .map(|color| Point {
                // A camera clips what is brighter than full scale.
                position: space.place(color.map(|band| band.clamp(0.0, full)), full),
                color: [r, g, b, 255],
                size_px: POINT_PT,
            })
            .collect();
        self.drawn = if points.is_empty() { Vec::new() } else { vec![Batch::new(points)] };
    }
}
