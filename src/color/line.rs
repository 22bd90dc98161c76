//! Straight lines through the color cube, their robust fit, and the cylinders around them (section 5.3.2).

use super::{Moments, Vec3, dot, principal_axes, rgb};

/// A line of the color space: a matte or a highlight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point on the line: the mean of the colors that the line was fitted to, counts.
    pub mean: Vec3,
    /// Unit direction, away from black.
    pub direction: Vec3,
}

/// Settings of a robust line fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobustFitSettings {
    /// Standard deviation of the noise of a band, counts; the scale of the residuals is never taken smaller.
    pub sigma: f64,
    /// Tukey's constant, in units of the residuals' scale.
    pub tuning: f64,
    /// Largest number of reweightings.
    pub iterations: usize,
}

impl Line {
    /// The line through the mean of a cluster along its first eigenvector; `None` for a cluster without extent, or of a total
    /// weight below 2.
    pub fn principal(moments: &Moments) -> Option<Self> {
        let ([first, ..], [axis, ..]) = principal_axes(&moments.covariance());
        (moments.n >= 2.0 && first > 0.0).then(|| Self::new(moments.mean(), axis))
    }

    /// The line through `mean` along `direction`, which is turned away from black and made a unit vector.
    pub fn new(mean: Vec3, direction: Vec3) -> Self {
        // A direction perpendicular to the mean is turned towards brighter colors.
        let along = direction.dot(&mean) + 1e-9 * direction.sum();
        Self { mean, direction: direction.normalize() * if along < 0.0 { -1.0 } else { 1.0 } }
    }

    /// Vector from black to the nearest point of the line.
    pub fn foot(&self) -> Vec3 {
        self.mean - self.direction * self.mean.dot(&self.direction)
    }

    /// Distance of a color from the line, counts.
    pub fn distance(&self, color: &Vec3) -> f64 {
        (color - self.mean).cross(&self.direction).norm()
    }

    /// The part of the gray direction that is perpendicular to the line (section 5.4.1), not a unit vector; zero for a gray line. The
    /// highlights of an object lie in this direction from its matte line.
    pub fn inward(&self) -> Vec3 {
        let ones = Vec3::repeat(1.0);
        ones - self.direction * self.direction.sum()
    }

    /// The side of the line that faces away from gray.
    pub fn outer_side(&self) -> OuterSide {
        let (inward, mean) = (rgb(&self.inward()), rgb(&self.mean));
        OuterSide { inward, at_mean: dot(mean, inward) }
    }

    /// The line fitted to `colors` by iteratively reweighted least squares with Tukey's weights, starting from this line.
    ///
    /// The residual of a color is its distance from the line; the scale of the residuals is the larger of `fit.sigma` and their
    /// median. With fewer than three colors the line stays as it is.
    #[must_use]
    pub fn refit(self, colors: &[[f32; 3]], fit: &RobustFitSettings) -> Self {
        let mut line = self;
        if colors.len() < 3 {
            return line;
        }
        for _ in 0..fit.iterations {
            // Only the axis of the cylinder matters here.
            let cylinder = Cylinder::new(&line, 0.0);
            let cut = fit.tuning * fit.sigma.max(cylinder.median_distance(colors));
            let cut2 = (cut * cut) as f32;
            let Some(next) = Self::principal(&tukey_moments(colors, &cylinder, cut2)) else { break };
            let turned = next.direction.cross(&line.direction).norm();
            line = next;
            if turned < 1e-5 {
                break;
            }
        }
        line
    }
}

/// Moments of the colors with Tukey's weights (1 − u²)², u² the squared distance from the axis divided by `cut2` (counts²).
fn tukey_moments(colors: &[[f32; 3]], cylinder: &Cylinder, cut2: f32) -> Moments {
    let mut moments = Moments::default();
    for &color in colors {
        let u2 = cylinder.distance2(color) / cut2;
        if u2 < 1.0 {
            moments.add_weighted(color, f64::from((1.0 - u2) * (1.0 - u2)));
        }
    }
    moments
}

/// The point of each line that is nearest to the other line, counts; `None` for parallel lines.
pub fn closest_points(a: &Line, b: &Line) -> Option<(Vec3, Vec3)> {
    let cosine = a.direction.dot(&b.direction);
    let sine2 = 1.0 - cosine * cosine;
    if sine2 < 1e-9 {
        return None;
    }
    let between = b.mean - a.mean;
    let (along_a, along_b) = (between.dot(&a.direction), between.dot(&b.direction));
    let s = (along_a - cosine * along_b) / sine2;
    let t = (cosine * along_a - along_b) / sine2;
    Some((a.mean + a.direction * s, b.mean + b.direction * t))
}

/// The colors within a radius of a line, in single precision as the colors of pixels are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    mean: [f32; 3],
    direction: [f32; 3],
    radius2: f32,
}

/// The side of a line that faces away from gray: highlights, which lie towards gray, do not reach there (section 5.4.1, figure 9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterSide {
    inward: [f32; 3],
    /// Product of the line's mean with `inward`.
    at_mean: f32,
}

impl OuterSide {
    /// Whether a color lies on this side, or at the line itself. For a gray line no side faces away from gray, and rounding decides.
    #[inline]
    pub fn contains(&self, color: [f32; 3]) -> bool {
        dot(color, self.inward) <= self.at_mean
    }
}

impl Cylinder {
    /// The cylinder of `radius_counts` around `line`.
    pub fn new(line: &Line, radius_counts: f64) -> Self {
        Self {
            mean: rgb(&line.mean),
            direction: rgb(&line.direction),
            radius2: (radius_counts * radius_counts) as f32,
        }
    }

    /// Squared distance of a color from the axis, counts².
    #[inline]
    pub fn distance2(&self, color: [f32; 3]) -> f32 {
        let v = [color[0] - self.mean[0], color[1] - self.mean[1], color[2] - self.mean[2]];
        let d = self.direction;
        let x = v[1] * d[2] - v[2] * d[1];
        let y = v[2] * d[0] - v[0] * d[2];
        let z = v[0] * d[1] - v[1] * d[0];
        x * x + y * y + z * z
    }

    /// Whether a color lies inside.
    #[inline]
    pub fn contains(&self, color: [f32; 3]) -> bool {
        self.distance2(color) <= self.radius2
    }

    /// Median distance of colors from the axis, from at most a thousand of them, evenly chosen.
    fn median_distance(&self, colors: &[[f32; 3]]) -> f64 {
        let step = colors.len().div_ceil(1000).max(1);
        let mut distances: Vec<f32> = colors.iter().step_by(step).map(|&c| self.distance2(c)).collect();
        let middle = distances.len() / 2;
        let (_, median, _) = distances.select_nth_unstable_by(middle, f32::total_cmp);
        f64::from(*median).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{axis_angle_deg, vec3};
    use proptest::prelude::*;

    fn direction() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(0.05f64..1.0).prop_map(|v| Vec3::from(v).normalize())
    }

    #[test]
    fn closest_points_of_two_known_lines() {
        let a = Line::new(Vec3::new(10.0, 0.0, 0.0), Vec3::x());
        let b = Line::new(Vec3::new(3.0, 7.0, 2.0), Vec3::y());
        let (p, q) = closest_points(&a, &b).unwrap();
        assert!((p - Vec3::new(3.0, 0.0, 0.0)).norm() < 1e-9 && (q - Vec3::new(3.0, 0.0, 2.0)).norm() < 1e-9);
        assert!(closest_points(&a, &a).is_none());
    }

    #[test]
    fn a_line_points_away_from_black_and_inward_is_towards_gray() {
        let line = Line::new(Vec3::new(100.0, 10.0, 10.0), -Vec3::x());
        assert_eq!(line.direction, Vec3::x());
        assert!((line.foot() - Vec3::new(0.0, 10.0, 10.0)).norm() < 1e-12);
        assert!(line.inward().dot(&Vec3::new(0.0, 1.0, 1.0)) > 0.0);
        let outer_side = line.outer_side();
        assert!(outer_side.contains([90.0, 5.0, 5.0]) && outer_side.contains([20.0, 10.0, 10.0]));
        assert!(!outer_side.contains([90.0, 15.0, 15.0]));
    }

    proptest! {
        #[test]
        fn a_robust_line_is_exact_when_a_fifth_of_the_colors_are_outliers(d in direction(), spread in 120f64..200.0) {
            let aside = d.cross(&Vec3::new(0.3, -0.8, 0.5)).normalize() * 40.0;
            let colors: Vec<[f32; 3]> = (0..200)
                .map(|i| {
                    let along = 30.0 + spread * f64::from(i) / 200.0;
                    let outlier = if i % 5 == 0 { aside } else { Vec3::zeros() };
                    rgb(&(d * along + outlier))
                })
                .collect();
            let start = Line::principal(&colors.iter().copied().collect()).unwrap();
            let fit = RobustFitSettings { sigma: 1.25, tuning: 4.0, iterations: 30 };
            let line = start.refit(&colors, &fit);
            prop_assert!(axis_angle_deg(&line.direction, &d) < 0.01);
            prop_assert!(line.foot().norm() < 0.05);
        }

        #[test]
        fn distance_is_the_same_in_both_precisions(
            m in prop::array::uniform3(0f64..255.0), d in direction(), c in prop::array::uniform3(0f32..255.0),
        ) {
            let line = Line::new(Vec3::from(m), d);
            let fast = f64::from(Cylinder::new(&line, 1.0).distance2(c)).sqrt();
            prop_assert!((fast - line.distance(&vec3(c))).abs() < 1e-2);
        }
    }
}
