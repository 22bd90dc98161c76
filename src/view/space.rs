//! The color spaces of the color space view: the place of a color in each space.
//!
//! Every space is a function from linear counts into a world about the size of the unit cube, whose third
//! coordinate points up.

use super::ColorSpace;
use super::vector::{Point, dot};

/// Half of the range of a* and b* in the world: all of sRGB lies between −108 and 99.
pub(super) const LAB_REACH: f32 = 110.0;
/// Smallest value of a band that log RGB distinguishes from black, as a share of full scale: one count of 255.
pub(super) const LOG_FLOOR: f32 = 1.0 / 255.0;

/// D65 in XYZ, and linear sRGB to XYZ (IEC 61966-2-1).
const WHITE: [f32; 3] = [0.950_47, 1.0, 1.088_83];
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_456_4, 0.357_576_1, 0.180_437_5],
    [0.212_672_9, 0.715_152_2, 0.072_175],
    [0.019_333_9, 0.119_192, 0.950_304_1],
];
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

impl ColorSpace {
    /// All spaces, in the order of the menu.
    pub const ALL: [Self; 5] = [Self::Rgb, Self::Lab, Self::Hsv, Self::Chromaticity, Self::LogRgb];

    /// The name in the menu.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rgb => "RGB",
            Self::Lab => "CIE L*a*b*",
            Self::Hsv => "HSV",
            Self::Chromaticity => "r\u{2013}g chromaticity",
            Self::LogRgb => "log RGB",
        }
    }

    /// The use of the space, one sentence.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Rgb => "Linear counts, the only space in which the model's lines and planes are straight.",
            Self::Lab => {
                "Lightness and two opponent colors, in which equal distances look about equally large."
            }
            Self::Hsv => "A cone around gray: hue around it, saturation outwards, the largest band upwards.",
            Self::Chromaticity => "Shares of red and green: shading disappears, a matte line stands upright.",
            Self::LogRgb => "Logarithm of each band: shading moves all colors of an object by the same step.",
        }
    }

    /// The place in the world of a color in linear counts; `full_counts` is the end of each band of the cube.
    ///
    /// Bands below zero count as zero, except in RGB. Black has no hue and no chromaticity: its place is that of gray.
    pub fn place(self, counts: Point, full_counts: f32) -> Point {
        let shares = counts.map(|v| v / full_counts);
        if self == Self::Rgb {
            return shares;
        }
        let shares = shares.map(|v| v.max(0.0));
        match self {
            Self::Rgb => shares,
            Self::Lab => {
                let [l, a, b] = lab_from_linear(shares);
                [0.5 + 0.5 * a / LAB_REACH, 0.5 + 0.5 * b / LAB_REACH, l / 100.0]
            }
            Self::Hsv => {
                let [hue_rad, saturation, value] = hsv_from_linear(shares);
                let radius = 0.5 * saturation * value;
                [0.5 + radius * hue_rad.cos(), 0.5 + radius * hue_rad.sin(), value]
            }
            Self::Chromaticity => {
                let sum: f32 = shares.iter().sum();
                if sum <= 0.0 {
                    return [1.0 / 3.0, 1.0 / 3.0, 0.0];
                }
                [shares[0] / sum, shares[1] / sum, sum / 3.0]
            }
            Self::LogRgb => shares.map(|v| 1.0 - v.max(LOG_FLOOR).ln() / LOG_FLOOR.ln()),
        }
    }

    /// The color in linear counts at a place in the world; none where the color would have a negative band.
    pub fn inverse(self, place: Point, full_counts: f32) -> Option<Point> {
        let [x, y, z] = place;
        let shares = match self {
            Self::Rgb => place,
            Self::Lab => {
                let opponent = |v: f32| (v - 0.5) * 2.0 * LAB_REACH;
                linear_from_lab([z * 100.0, opponent(x), opponent(y)])
            }
            Self::Hsv => {
                let (u, v) = (2.0 * (x - 0.5), 2.0 * (y - 0.5));
                let chroma = u.hypot(v);
                if chroma > z + 1e-5 {
                    return None;
                }
                linear_from_hsv(v.atan2(u), chroma, z)
            }
            Self::Chromaticity => [x, y, 1.0 - x - y].map(|share| share * 3.0 * z),
            Self::LogRgb => place.map(|v| ((1.0 - v) * LOG_FLOOR.ln()).exp()),
        };
        let lit = shares.iter().all(|v| v.is_finite() && *v > -1e-4);
        lit.then(|| shares.map(|v| v.max(0.0) * full_counts))
    }
}

fn lab_from_linear(linear: Point) -> Point {
    let xyz = XYZ_FROM_RGB.map(|row| dot(row, linear));
    let [x, y, z] = std::array::from_fn(|i| {
        let t = xyz[i] / WHITE[i];
        // CIE 15: the cube root, continued straight below (6/29)³.
        if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn linear_from_lab([l, a, b]: Point) -> Point {
    let y = (l + 16.0) / 116.0;
    let roots = [y + a / 500.0, y, y - b / 200.0];
    let xyz: Point = std::array::from_fn(|i| {
        let t = roots[i];
        WHITE[i] * if t > 6.0 / 29.0 { t.powi(3) } else { (116.0 * t - 16.0) * 27.0 / 24389.0 }
    });
    RGB_FROM_XYZ.map(|row| dot(row, xyz))
}

/// Hue in radians, saturation and value in 0…1.
fn hsv_from_linear([r, g, b]: Point) -> Point {
    let value = r.max(g).max(b);
    let chroma = value - r.min(g).min(b);
    if chroma <= 0.0 {
        return [0.0, 0.0, value];
    }
    let sextant = if r >= g && r >= b {
        (g - b) / chroma
    } else if g >= b {
        2.0 + (b - r) / chroma
    } else {
        4.0 + (r - g) / chroma
    };
    [sextant * std::f32::consts::FRAC_PI_3, chroma / value, value]
}

/// From hue in radians, chroma (saturation · value) and value.
fn linear_from_hsv(hue_rad: f32, chroma: f32, value: f32) -> Point {
    let sextant = (hue_rad / std::f32::consts::FRAC_PI_3).rem_euclid(6.0);
    [0.0, 4.0, 2.0].map(|lead: f32| {
        let from_peak = (sextant + lead).rem_euclid(6.0);
        let away = (from_peak.min(6.0 - from_peak) - 1.0).clamp(0.0, 1.0);
        value - chroma * away
    })
}

#[cfg(test)]
mod tests {
    use super::super::vector::distance;
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(space: ColorSpace, counts: Point, place: Point) {
        let found = space.place(counts, 255.0);
        assert!(distance(found, place) < 2e-3, "{space:?} {counts:?}: {found:?}, not {place:?}");
    }

    #[test]
    fn known_colors_have_their_published_coordinates() {
        check(ColorSpace::Rgb, [51.0, 102.0, 255.0], [0.2, 0.4, 1.0]);
        // sRGB's red: L* 53.24, a* 80.09, b* 67.20.
        let lab = |v: f32| 0.5 + v / 220.0;
        check(ColorSpace::Lab, [255.0, 0.0, 0.0], [lab(80.09), lab(67.2), 0.5324]);
        check(ColorSpace::Lab, [255.0; 3], [0.5, 0.5, 1.0]);
        check(ColorSpace::Lab, [0.0; 3], [0.5, 0.5, 0.0]);
        // Linear 18 % gray is L* 49.5.
        check(ColorSpace::Lab, [45.9; 3], [0.5, 0.5, 0.495]);
        check(ColorSpace::Hsv, [0.0; 3], [0.5, 0.5, 0.0]);
        check(ColorSpace::Hsv, [255.0, 0.0, 0.0], [1.0, 0.5, 1.0]);
        check(ColorSpace::Hsv, [0.0, 255.0, 255.0], [0.0, 0.5, 1.0]);
        check(ColorSpace::Hsv, [127.5; 3], [0.5, 0.5, 0.5]);
        check(ColorSpace::Chromaticity, [60.0, 30.0, 30.0], [0.5, 0.25, 120.0 / 765.0]);
        check(ColorSpace::Chromaticity, [0.0; 3], [1.0 / 3.0, 1.0 / 3.0, 0.0]);
        check(ColorSpace::LogRgb, [0.0, 1.0, 255.0], [0.0, 0.0, 1.0]);
        check(ColorSpace::LogRgb, [15.9687; 3], [0.5; 3]);
    }

    #[test]
    fn coordinates_outside_the_space_are_no_color() {
        assert_eq!(ColorSpace::Hsv.inverse([1.0, 0.5, 0.5], 255.0), None, "outside the cone");
        assert_eq!(ColorSpace::Lab.inverse([1.0, 0.0, 0.1], 255.0), None);
        assert_eq!(ColorSpace::Chromaticity.inverse([0.8, 0.8, 0.5], 255.0), None);
        assert_eq!(ColorSpace::Rgb.inverse([-0.5, 0.0, 0.0], 255.0), None);
    }

    proptest! {
        #[test]
        fn there_and_back_is_the_same_color(
            counts in prop::array::uniform3(8f32..2040.0), full in prop::sample::select(vec![255f32, 2040.0]),
        ) {
            let counts = counts.map(|v| v * full / 2040.0);
            for space in ColorSpace::ALL {
                let place = space.place(counts, full);
                prop_assert!(place.iter().all(|v| (-1e-4..=1.0001).contains(v)), "{space:?}: {place:?}");
                let back = space.inverse(place, full).unwrap();
                prop_assert!(distance(back, counts) < 2e-3 * full, "{space:?}: {counts:?} {back:?}");
            }
        }
    }
}
