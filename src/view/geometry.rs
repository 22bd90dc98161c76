//! The sphere of section 3 as the panel *Geometry* shows it: its settings, and its cluster in the plane of a region.

use super::{Point, RegionPlane};
use crate::reflection::photometry::SphereGeometry;
use crate::reflection::{SpherePoint, sphere_points};
use serde::{Deserialize, Serialize};

/// Smallest and largest distance of light and camera from the center, radii of the sphere.
pub const SPHERE_DISTANCES: [f64; 2] = [1.1, 100.0];
/// Points along each side of the grid over the sphere: of the picture, and of the cluster, whose highlight is small.
const PICTURE_SIDE: usize = 64;
const CLUSTER_SIDE: usize = 140;

/// The sphere, its light and its camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct GeometrySettings {
    /// Distance of light and camera from the sphere's center, d/r.
    pub distance: f64,
    /// Phase angle g between light and camera, degrees.
    pub phase_deg: f64,
    /// Standard deviation of the highlight's lobe, degrees.
    pub roughness_deg: f64,
    /// Surface reflection at the peak of the lobe, as a share of the brightest body reflection.
    pub strength: f64,
    /// Whether the sphere's cluster is drawn in the color space and the plane.
    pub is_drawn: bool,
}

impl Default for GeometrySettings {
    fn default() -> Self {
        Self { distance: 5.0, phase_deg: 60.0, roughness_deg: 6.0, strength: 1.0, is_drawn: false }
    }
}

impl GeometrySettings {
    /// The settings with every value in its range; a value that is no number becomes its default.
    #[must_use]
    pub fn in_range(self) -> Self {
        let defaults = Self::default();
        let within = |value: f64, [low, high]: [f64; 2], default: f64| {
            if value.is_nan() { default } else { value.clamp(low, high) }
        };
        let distance = within(self.distance, SPHERE_DISTANCES, defaults.distance);
        let most = SphereGeometry::new(1.0, distance, 0.0).map_or(0.0, SphereGeometry::max_phase_deg);
        Self {
            distance,
            // At g_max itself nothing is lit and seen.
            phase_deg: within(self.phase_deg, [0.0, most - 0.1], defaults.phase_deg.min(most - 0.1)),
            roughness_deg: within(self.roughness_deg, [0.5, 40.0], defaults.roughness_deg),
            strength: within(self.strength, [0.0, 4.0], defaults.strength),
            is_drawn: self.is_drawn,
        }
    }

    /// The sphere of the settings in range.
    pub fn sphere(self) -> Option<SphereGeometry> {
        let Self { distance, phase_deg, .. } = self.in_range();
        SphereGeometry::new(1.0, distance, phase_deg)
    }

    /// The lit and seen points of the sphere.
    pub fn points(self) -> Vec<SpherePoint> {
        let roughness_deg = self.in_range().roughness_deg;
        self.sphere().map_or_else(Vec::new, |sphere| sphere_points(sphere, roughness_deg, PICTURE_SIDE))
    }
}

/// m_b and m_s of the sphere's points in the plane of a region, counts: the brightest visible point has the m_b of the region's brightest
/// matte point. Empty without a plane.
pub fn sphere_in_plane(settings: GeometrySettings, plane: &RegionPlane) -> Vec<[f32; 2]> {
    let settings = settings.in_range();
    let Some(sphere) = settings.sphere().filter(|_| plane.has_plane) else { return Vec::new() };
    let brightest = sphere.brightest_body() as f32;
    if brightest <= 0.0 {
        return Vec::new();
    }
    let per_body = plane.matte_length / brightest;
    let per_surface = settings.strength as f32 * plane.matte_length;
    let points = sphere_points(sphere, settings.roughness_deg, CLUSTER_SIDE).into_iter();
    // The other half of the sphere has the same amounts.
    let half = points.filter(|point| point.at[1] >= 0.0);
    half.map(|point| [point.body * per_body, point.surface * per_surface]).collect()
}

/// The colors of the sphere's points in the color space of a region, counts.
pub fn sphere_colors(settings: GeometrySettings, plane: &RegionPlane) -> Vec<Point> {
    sphere_in_plane(settings, plane).into_iter().map(|[body, surface]| plane.color(body, surface)).collect()
}

/// The place where the strongest highlight of a region leaves its matte line, as a share of the matte line's length; none without a plane
/// or a highlight.
pub fn meeting_share(plane: &RegionPlane) -> Option<f64> {
    let meeting_point = plane.branches.first().filter(|_| plane.has_plane)?.meeting_point;
    (plane.matte_length > 0.0).then(|| f64::from(meeting_point / plane.matte_length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::RegionId;
    use crate::view::region_plane;
    use crate::view::testing::tiny;

    #[test]
    fn settings_of_a_file_are_brought_into_range() {
        let broken = GeometrySettings {
            distance: f64::NAN,
            phase_deg: 400.0,
            roughness_deg: -1.0,
            strength: f64::INFINITY,
            is_drawn: true,
        };
        let found = broken.in_range();
        assert_eq!((found.distance.to_bits(), found.is_drawn), (5f64.to_bits(), true));
        assert!(found.sphere().is_some_and(|sphere| sphere.q().is_some()));
        // At the largest phase angle the lit crescent is thinner than the grid.
        assert!(!GeometrySettings { phase_deg: 120.0, ..broken }.points().is_empty());
    }

    #[test]
    fn the_cluster_reaches_the_ends_of_the_regions_matte_line() {
        let shown = tiny();
        let plane = region_plane(&shown, RegionId::from_index(0)).unwrap();
        let settings = GeometrySettings { strength: 2.0, ..GeometrySettings::default() };
        let cluster = sphere_in_plane(settings, &plane);
        assert!(plane.has_plane && cluster.len() > 1000);
        let most = |axis: usize| cluster.iter().map(|amounts| amounts[axis]).fold(0.0, f32::max);
        assert!((most(0) / plane.matte_length - 1.0).abs() < 0.02, "{} {}", most(0), plane.matte_length);
        assert!(most(1) > 1.8 * plane.matte_length);
        for (color, amounts) in sphere_colors(settings, &plane).iter().zip(&cluster).step_by(97) {
            let found = plane.amounts(*color);
            assert!(
                (found.body - amounts[0]).abs() < 0.1 && found.noise.abs() < 0.1,
                "{found:?} {amounts:?}"
            );
        }
        assert!(meeting_share(&plane).is_some_and(|share| share > 0.4 && share < 1.3));
    }
}
