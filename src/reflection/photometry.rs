//! Section 3.2, equations (3)–(11): the point of the matte line at which a highlight line starts, for a sphere.
//!
//! A sphere of radius r is lit by a point light and seen by a camera. Both are at distance d from the sphere's center; the
//! phase angle g is the angle between them. The highlight lies where the normal bisects g; the brightest visible matte point
//! is the visible point nearest to the light. The ratio q of the body reflections at both points is the evidence for the
//! paper's 50 % heuristic (section 5.4): a highlight line starts in the upper half of the matte line.
//!
//! Angles are in degrees, as in figure 6; lengths are in any one unit, as only r/d matters. An infinite d is legal
//! and gives parallel light and orthographic view.
//!
//! # One formula for equations (5), (6), (8) and (9)
//! All four contain the angle of incidence i at the point whose normal has the angle φ with the direction of the light. With
//! the point at distance r from the center along that normal and the light at distance d,
//! sin i = d·sin φ / √(d² + r² − 2dr·cos φ) and cos i = (d·cos φ − r) / √(d² + r² − 2dr·cos φ). The paper writes the cosine as
//! √(1 − sin²i). The two are equal at every lit point, but the paper's form loses half of its digits near the terminator,
//! where q becomes a ratio of two vanishing cosines.
//!
//! # Errors of the scan
//! - (8) and (9) print γ where the angle of (7), α, is meant. γ does not depend on g, yet the brightest visible point
//!   must: for α = 0 the point under the light is visible, so that i = 0 and m_b = 1 there.
//! - (9) prints 1/(1 − …) for √(1 − …), the form of (6); the printed one is never below 1.
//! - "q does not drop below 0.5 for d ≥ 5r" holds nearly: (3)–(10) give a minimum of 0.4973 at d = 5r (g ≈ 145°) and of
//!   0.4994 at d = 10r (g ≈ 163°), rising towards 0.5 with d. The heuristic has a margin for more than that.

/// A sphere with a point light and a camera, both at the same distance from its center (figure 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereGeometry {
    radius_over_distance: f64,
    phase_deg: f64,
}

impl SphereGeometry {
    /// Sphere of radius r, light and camera at distance d, phase angle g of either sign.
    ///
    /// `None` unless 0 < r < d with a finite r, and |g| ≤ g_max: beyond g_max the camera sees no lit point.
    pub fn new(radius: f64, distance: f64, phase_deg: f64) -> Option<Self> {
        let possible = radius > 0.0 && radius.is_finite() && radius < distance;
        let geometry = Self { radius_over_distance: radius / distance, phase_deg: phase_deg.abs() };
        // The comparison is false for a NaN too.
        (possible && geometry.phase_deg <= geometry.max_phase_deg()).then_some(geometry)
    }

    /// r/d.
    pub fn radius_over_distance(self) -> f64 {
        self.radius_over_distance
    }

    /// g, degrees, not negative.
    pub fn phase_deg(self) -> f64 {
        self.phase_deg
    }

    /// γ, equation (3): half the angle at which light or camera sees the sphere.
    pub fn cone_half_angle_deg(self) -> f64 {
        // arctan(r / √(d² − r²)) = arcsin(r / d), which is defined for an infinite d too.
        self.radius_over_distance.asin().to_degrees()
    }

    /// g_max, equation (4): the phase angle at which the camera loses sight of the lit part.
    pub fn max_phase_deg(self) -> f64 {
        2.0 * self.horizon_rad().to_degrees()
    }

    /// i_H, equation (5): angle of incidence at the highlight, in 0…90°.
    pub fn highlight_incidence_deg(self) -> f64 {
        self.incidence_rad(self.highlight_normal_rad()).to_degrees()
    }

    /// m_bH, equation (6): Lambertian body reflection under the highlight, in 0…1.
    pub fn highlight_body(self) -> f64 {
        self.body(self.highlight_normal_rad())
    }

    /// α, equation (7): angle between the light's direction and the normal of the brightest visible matte point.
    pub fn brightest_normal_deg(self) -> f64 {
        self.brightest_normal_rad().to_degrees()
    }

    /// i_MaxVisible, equation (8): angle of incidence at the brightest visible matte point, in 0…90°.
    pub fn brightest_incidence_deg(self) -> f64 {
        self.incidence_rad(self.brightest_normal_rad()).to_degrees()
    }

    /// m_bMaxVisible, equation (9): Lambertian body reflection at the brightest visible matte point, in 0…1.
    pub fn brightest_body(self) -> f64 {
        self.body(self.brightest_normal_rad())
    }

    /// q, equation (10): the point at which the highlight line leaves the matte line, as a share of the matte line's length.
    ///
    /// `None` at g = g_max, where both reflections vanish; q approaches 0.5 there.
    pub fn q(self) -> Option<f64> {
        let whole = self.brightest_body();
        (whole > 0.0).then(|| self.highlight_body() / whole)
    }

    /// The angle between the light's direction and the normal of a point on the terminator, 90° − γ.
    fn horizon_rad(self) -> f64 {
        self.radius_over_distance.acos()
    }

    /// The angle between the light's direction and the normal at the highlight: half of the phase angle, because light and
    /// camera are equally far away.
    fn highlight_normal_rad(self) -> f64 {
        self.phase_deg.to_radians() / 2.0
    }

    fn brightest_normal_rad(self) -> f64 {
        (self.phase_deg.to_radians() - self.horizon_rad()).max(0.0)
    }

    /// i at the point whose normal is `normal_rad` away from the direction of the light.
    fn incidence_rad(self, normal_rad: f64) -> f64 {
        normal_rad.sin().atan2(self.height_above_horizon(normal_rad))
    }

    /// cos i at the point whose normal is `normal_rad` away from the direction of the light.
    fn body(self, normal_rad: f64) -> f64 {
        let height = self.height_above_horizon(normal_rad);
        height / normal_rad.sin().hypot(height)
    }

    /// cos φ − r/d: height of the light above the tangent plane of the point, in units of d.
    fn height_above_horizon(self, normal_rad: f64) -> f64 {
        // cos φ − cos φ₀ as a product, so that the ratio of two such heights keeps its digits where both vanish.
        let horizon_rad = self.horizon_rad();
        let below_rad = (horizon_rad - normal_rad).max(0.0);
        2.0 * (horizon_rad - below_rad / 2.0).sin() * (below_rad / 2.0).sin()
    }
}

/// q∞, equation (11): [`SphereGeometry::q`] for light and camera infinitely far away.
///
/// `None` unless |g| ≤ 180°. Unlike q itself it has a value at g_max = 180°, which is 0.5.
pub fn q_infinity(phase_deg: f64) -> Option<f64> {
    let phase_deg = phase_deg.abs();
    let half_rad = phase_deg.to_radians() / 2.0;
    match phase_deg {
        ..=90.0 => Some(half_rad.cos()),
        ..=180.0 => Some(0.5 / half_rad.sin()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A sphere of radius 1 at `distance`, at the phase angle `part`·g_max.
    fn at(distance: f64, part: f64) -> SphereGeometry {
        let head_on = SphereGeometry::new(1.0, distance, 0.0).unwrap();
        SphereGeometry::new(1.0, distance, part * head_on.max_phase_deg()).unwrap()
    }

    /// The smallest q over all phase angles, and the phase angle where it occurs.
    fn minimum(distance: f64) -> (f64, f64) {
        let steps = 20_000;
        (0..steps)
            .map(|i| at(distance, f64::from(i) / f64::from(steps)))
            .map(|geometry| (geometry.q().unwrap(), geometry.phase_deg))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap()
    }

    #[track_caller]
    fn assert_near(found: f64, expected: f64, tolerance: f64) {
        assert!((found - expected).abs() <= tolerance, "{found} is not {expected} ± {tolerance}");
    }

    #[test]
    fn a_sphere_at_twice_its_radius_by_hand() {
        let geometry = SphereGeometry::new(3.0, 6.0, 90.0).unwrap();
        assert_near(geometry.cone_half_angle_deg(), 30.0, 1e-12);
        assert_near(geometry.max_phase_deg(), 120.0, 1e-12);
        assert_near(geometry.brightest_normal_deg(), 30.0, 1e-12);
        // tan i = sin φ / (cos φ − r/d) at φ = 45° and at φ = 30°.
        let half = 0.5_f64;
        let tangent_highlight = half.sqrt() / (half.sqrt() - 0.5);
        let tangent_brightest = 0.5 / (0.75_f64.sqrt() - 0.5);
        assert_near(geometry.highlight_incidence_deg(), tangent_highlight.atan().to_degrees(), 1e-12);
        assert_near(geometry.brightest_incidence_deg(), tangent_brightest.atan().to_degrees(), 1e-12);
    }

    #[test]
    fn the_highlight_of_a_camera_beside_the_light_starts_at_the_tip() {
        for distance in [1.01, 2.0, 5.0, 100.0, f64::INFINITY] {
            let geometry = at(distance, 0.0);
            assert_eq!(geometry.q(), Some(1.0));
            assert_near(geometry.highlight_incidence_deg(), 0.0, 1e-12);
        }
    }

    #[test]
    fn q_approaches_a_half_where_the_lit_part_disappears() {
        for distance in [1.1, 2.0, 5.0, 10.0, 100.0, 1e6, f64::INFINITY] {
            // However near to g_max: the ratio of two vanishing numbers keeps its digits.
            for (gap, tolerance) in [(1e-3, 1e-3), (1e-6, 1e-6), (1e-9, 1e-6)] {
                assert_near(at(distance, 1.0 - gap).q().unwrap(), 0.5, tolerance);
            }
        }
    }

    #[test]
    fn q_has_no_value_at_the_largest_phase_angle() {
        let geometry = at(5.0, 1.0);
        assert_eq!(geometry.q(), None);
        assert_eq!((geometry.highlight_body(), geometry.brightest_body()), (0.0, 0.0));
        assert_near(geometry.brightest_incidence_deg(), 90.0, 1e-12);
    }

    #[test]
    fn figure_6_the_minima_of_q() {
        let (q, phase_deg) = minimum(5.0);
        assert_near(q, 0.4973, 5e-5);
        assert_near(phase_deg, 145.3, 0.1);
        let (q, phase_deg) = minimum(10.0);
        assert_near(q, 0.4994, 5e-5);
        assert_near(phase_deg, 162.8, 0.1);
    }

    #[test]
    fn figure_6_the_minimum_rises_towards_a_half_with_distance() {
        let minima = [1.1, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0].map(|d| minimum(d).0);
        assert!(minima.is_sorted_by(|near, far| near < far), "{minima:?}");
        assert!(minima.iter().all(|&q| q < 0.5), "{minima:?}");
        assert_near(minima[8], 0.5, 1e-5);
    }

    #[test]
    fn figure_6_from_far_away_q_only_falls() {
        for distance in [1e6, f64::INFINITY] {
            let curve: Vec<f64> =
                (0..2000).map(|i| at(distance, f64::from(i) / 2000.0).q().unwrap()).collect();
            assert!(curve.is_sorted_by(|before, after| before > after));
        }
    }

    #[test]
    fn equation_11_is_continuous_and_has_the_ends_of_figure_6() {
        assert_eq!(q_infinity(0.0), Some(1.0));
        assert_near(q_infinity(90.0).unwrap(), 0.5_f64.sqrt(), 1e-12);
        assert_near(q_infinity(90.0 + 1e-9).unwrap(), 0.5_f64.sqrt(), 1e-10);
        assert_near(q_infinity(60.0).unwrap(), 0.75_f64.sqrt(), 1e-12);
        assert_near(q_infinity(180.0).unwrap(), 0.5, 1e-12);
        assert_eq!(q_infinity(180.1), None);
        assert_eq!(q_infinity(f64::NAN), None);
    }

    #[test]
    fn impossible_geometries_are_refused() {
        let refused = [
            (0.0, 5.0, 0.0),
            (-1.0, 5.0, 0.0),
            (5.0, 5.0, 0.0),
            (6.0, 5.0, 0.0),
            (f64::INFINITY, f64::INFINITY, 0.0),
            (f64::NAN, 5.0, 0.0),
            (1.0, f64::NAN, 0.0),
            (1.0, 5.0, f64::NAN),
            (1.0, 5.0, 157.0),
            (1.0, 5.0, -157.0),
            (1.0, f64::INFINITY, 180.1),
        ];
        for (radius, distance, phase_deg) in refused {
            let geometry = SphereGeometry::new(radius, distance, phase_deg);
            assert_eq!(geometry, None, "r {radius}, d {distance}, g {phase_deg}");
        }
    }

    proptest! {
        #[test]
        fn q_is_a_part_of_the_matte_line(distance in 1.001..1e4, part in 0.0..0.999_999) {
            let geometry = at(distance, part);
            let q = geometry.q().unwrap();
            prop_assert!(q > 0.0 && q <= 1.0, "q = {}", q);
            prop_assert!(geometry.highlight_incidence_deg() >= geometry.brightest_incidence_deg());
        }

        #[test]
        fn only_the_ratio_of_the_lengths_counts_and_the_sign_of_g_does_not(
            distance in 1.001..1e4,
            part in 0.0..0.999,
            scale in 0.001..1000.0,
        ) {
            let geometry = at(distance, part);
            let mirrored = SphereGeometry::new(1.0, distance, -geometry.phase_deg).unwrap();
            let scaled = SphereGeometry::new(scale, scale * distance, geometry.phase_deg).unwrap();
            prop_assert_eq!(mirrored.q(), geometry.q());
            prop_assert!((scaled.q().unwrap() - geometry.q().unwrap()).abs() < 1e-9);
        }

        #[test]
        fn equations_3_to_10_as_printed_and_corrected_give_the_same(distance in 1.01..100.0, part in 0.0..0.99) {
            let geometry = at(distance, part);
            let (d, r) = (distance, 1.0_f64);
            let gamma = (r / (d * d - r * r).sqrt()).atan();
            let g_max = 2.0 * ((d * d - r * r).sqrt() / r).atan();
            let g = part * g_max;
            let alpha = if g >= g_max / 2.0 { g - g_max / 2.0 } else { 0.0 };
            let sine = |angle: f64| d * angle.sin() / (d * d + r * r - 2.0 * d * r * angle.cos()).sqrt();
            let cosine = |angle: f64| (1.0 - sine(angle).powi(2)).sqrt();
            let near = |found: f64, expected: f64| (found - expected).abs() < 1e-6;
            prop_assert!(near(geometry.cone_half_angle_deg(), gamma.to_degrees()));
            prop_assert!(near(geometry.max_phase_deg(), g_max.to_degrees()));
            prop_assert!(near(geometry.highlight_incidence_deg(), sine(g / 2.0).asin().to_degrees()));
            prop_assert!(near(geometry.highlight_body(), cosine(g / 2.0)));
            prop_assert!(near(geometry.brightest_normal_deg(), alpha.to_degrees()));
            prop_assert!(near(geometry.brightest_incidence_deg(), sine(alpha).asin().to_degrees()));
            prop_assert!(near(geometry.brightest_body(), cosine(alpha)));
            prop_assert!(near(geometry.q().unwrap(), cosine(g / 2.0) / cosine(alpha)));
        }

        #[test]
        fn equation_11_is_the_limit_of_distance(phase_deg in -179.9..179.9) {
            let limit = q_infinity(phase_deg).unwrap();
            let at_infinity = SphereGeometry::new(1.0, f64::INFINITY, phase_deg).unwrap().q().unwrap();
            let far = SphereGeometry::new(1.0, 1e7, phase_deg).unwrap().q().unwrap();
            prop_assert!((at_infinity - limit).abs() < 1e-9);
            prop_assert!((far - limit).abs() < 1e-3);
        }
    }
}
