//! Section 7.5: ambient light adds a constant to every pixel, so that the matte lines meet away from black (Shafer's extended
//! model; refinement `ambient_light`).
//!
//! Each region's matte line is refitted to the colors in the line's cylinder. The common point p minimizes
//! Σ ρ(|Q_k (p − m_k)|²/var_k), Q_k the projection across line k, m_k a point of line k, var_k the variance of line k near p:
//! the line's own noise, .15 counts, and .1° of direction over the distance from m_k. ρ is Cauchy's, at three standard deviations. p is subtracted before the split
//! if at least three lines, or two that clearly meet, determine p, and if p is significant (χ² with three degrees of freedom,
//! .999), above the noise, not negative, a better meeting point than black, and no brighter than the darkest pixels. After
//! the split p is added to the body image: reflected ambient light is body reflection too.
//!
//! On lab scenes p is at most .3 counts a band. Ambient light of 3 to 12 counts is found to .4 counts (1.3 on one scene of three
//! blue objects, within the estimate's standard deviation), and the body image is as good as without ambient light.

use crate::color::{Cylinder, Line, Moments, RobustFitSettings, Vec3, principal_axes};
use crate::params::AmbientSetting;
use crate::raster::RegionId;
use crate::segment::{AnalysisInput, FinalRegions, Members, Pixels, PlanarHypothesis};
use crate::trace::{Ambient, AmbientVerdict, Meeting};
use nalgebra::Matrix3;
use rayon::prelude::*;

/// Fewest lines that determine a point by themselves. Any two lines nearly meet somewhere: see [`CLOSE`].
const LEAST_LINES: usize = 3;
/// Largest distance of two lines from their common point, standard deviations of the noise; the point has to be known to one
/// standard deviation.
const CLOSE: f64 = 0.5;
/// Largest root mean square distance of the pixels of a straight matte line from the line, σ.
const STRAIGHT: f64 = 1.5;
/// Fewest pixels of a line.
const LEAST_PX: usize = 300;
/// Most pixels to which a line is fitted, evenly chosen.
const SAMPLES: usize = 4000;
/// Least standard deviation of the colors along a line, standard deviations of the noise.
const LEAST_EXTENT: f64 = 8.0;
/// Standard error of a line's place that averaging does not remove, counts.
const PLACE_COUNTS: f64 = 0.15;
/// Standard error of a line's direction that averaging does not remove, degrees.
const DIRECTION_DEG: f64 = 0.1;
/// Number of pixels that count as one independent pixel: errors of neighboring pixels are correlated.
const PIXELS_PER_INDEPENDENT: f64 = 4.0;
/// Largest distance of the lines from the common point, as a share of their distance from black.
const BETTER: f64 = 0.5;
/// Distance from the common point above which lines do not meet, standard deviations of the noise.
const FAR: f64 = 2.0;
/// Largest share of pixels that may be darker than the ambient light.
const DARKEST: f64 = 0.005;
/// Tukey's constant of the robust line fit.
const TUNING: f64 = 4.7;
/// Most reweightings of the robust line fit.
const ITERATIONS: usize = 12;

/// The ambient light of a segmented picture: given by the user, estimated, not estimated, or off.
pub fn ambient(input: &AnalysisInput, regions: &FinalRegions, members: &Members) -> Ambient {
    match input.used.ambient {
        AmbientSetting::Given(counts) => {
            Ambient { subtracted: Some(counts), meeting: None, verdict: AmbientVerdict::Given }
        }
        AmbientSetting::Auto if input.refine.ambient_light => estimated(input, regions, members),
        AmbientSetting::Auto => Ambient { verdict: AmbientVerdict::NotEstimated, ..Ambient::default() },
        AmbientSetting::Off => Ambient::default(),
    }
}

fn estimated(input: &AnalysisInput, regions: &FinalRegions, members: &Members) -> Ambient {
    let lines: Vec<MatteLine> = (0..regions.hypotheses.len())
        .into_par_iter()
        .map(RegionId::from_index)
        .filter_map(|id| MatteLine::new(input, &regions.hypotheses[id.index()], members.region(id)))
        .collect();
    let meeting = meeting(&lines);
    let is_determined = |found: &Meeting| {
        let known = found.sd_counts.iter().all(|sd| *sd <= input.sigma());
        found.lines >= LEAST_LINES || (known && found.miss_counts[0] <= CLOSE * input.sigma())
    };
    let Some(found) = meeting.filter(is_determined) else {
        return Ambient { subtracted: None, meeting, verdict: AmbientVerdict::FewLines };
    };
    let color = Vec3::from(found.counts);
    let verdict = if found.chi_square <= Meeting::SIGNIFICANT_CHI_SQUARE || color.norm() <= input.sigma() {
        if found.miss_counts[0] > FAR * input.sigma() {
            AmbientVerdict::NoMeeting
        } else {
            AmbientVerdict::Black
        }
    } else if (0..3).any(|band| found.counts[band] < -2.0 * found.sd_counts[band]) {
        AmbientVerdict::Negative
    } else if found.miss_counts[0] > BETTER * found.miss_counts[1] {
        AmbientVerdict::NoMeeting
    } else if brighter_than_the_darkest(input, regions, &found.counts) {
        AmbientVerdict::DarkerPixels
    } else {
        AmbientVerdict::Subtracted
    };
    let light = found.counts.map(|band| band.max(0.0));
    Ambient { subtracted: (verdict == AmbientVerdict::Subtracted).then_some(light), meeting, verdict }
}

/// Whether more pixels of the regions than [`DARKEST`] are darker than the ambient light `counts` in some band.
fn brighter_than_the_darkest(input: &AnalysisInput, regions: &FinalRegions, counts: &[f64; 3]) -> bool {
    let least = counts.map(|band| (band - 3.0 * input.sigma()) as f32);
    let mut darker = [0usize; 3];
    let mut all = 0usize;
    for (color, &label) in input.pixels.as_slice().iter().zip(regions.labels.as_slice()) {
        if label != crate::raster::UNASSIGNED {
            all += 1;
            (0..3).for_each(|band| darker[band] += usize::from(color[band] < least[band]));
        }
    }
    darker.iter().any(|&count| count as f64 > DARKEST * all as f64)
}

/// A matte line and its standard errors.
struct MatteLine {
    line: Line,
    /// Squared standard error of the line's place at the mean, counts².
    place: f64,
    /// Squared standard error of the line's direction, rad².
    direction: f64,
}

impl MatteLine {
    /// The matte line of one region; none where too few of the region's pixels lie on a line, or where the line is too short.
    fn new(input: &AnalysisInput, hypothesis: &PlanarHypothesis, pixels: Pixels) -> Option<Self> {
        let cylinder = Cylinder::new(&hypothesis.matte, input.used.radius_counts());
        let colors: Vec<[f32; 3]> = pixels
            .sample(SAMPLES)
            .filter(|&pixel| input.masks.usable(pixel as usize))
            .map(|pixel| input.pixels[pixel as usize])
            .filter(|&color| cylinder.contains(color))
            .collect();
        if colors.len() < LEAST_PX {
            return None;
        }
        let fit = RobustFitSettings { sigma: input.sigma(), tuning: TUNING, iterations: ITERATIONS };
        let line = hypothesis.matte.refit(&colors, &fit);
        let near = Cylinder::new(&line, 2.0 * STRAIGHT * input.sigma());
        let moments: Moments = colors.into_iter().filter(|&color| near.contains(color)).collect();
        let ([along, across, height], _) = principal_axes(&moments.covariance());
        let noise = f64::midpoint(across, height);
        let long = along.max(0.0).sqrt() >= LEAST_EXTENT * input.sigma();
        let straight = noise.max(0.0).sqrt() <= STRAIGHT * input.sigma();
        let independent = moments.n / PIXELS_PER_INDEPENDENT;
        (moments.n >= LEAST_PX as f64 && long && straight).then(|| Self {
            line,
            place: noise / independent + PLACE_COUNTS * PLACE_COUNTS,
            direction: noise / (independent * along) + DIRECTION_DEG.to_radians().powi(2),
        })
    }

    /// Vector from a point to the nearest point of the line, counts, and the squared standard error of that vector, counts².
    fn miss(&self, point: &Vec3) -> (Vec3, f64) {
        let from = point - self.line.mean;
        let way = from.dot(&self.line.direction);
        (self.line.direction * way - from, self.place + way * way * self.direction)
    }
}

/// The point nearest to all lines; none for fewer than two lines and for parallel lines.
fn meeting(lines: &[MatteLine]) -> Option<Meeting> {
    if lines.len() < 2 {
        return None;
    }
    let mut point = Vec3::zeros();
    let mut information = Matrix3::zeros();
    for _ in 0..12 {
        let mut right = Vec3::zeros();
        information = Matrix3::zeros();
        for line in lines {
            let (miss, variance) = line.miss(&point);
            let cauchy = miss.norm_squared() / (9.0 * variance);
            let across = Matrix3::identity() - line.line.direction * line.line.direction.transpose();
            let weighted = across / (variance * (1.0 + cauchy));
            information += weighted;
            right += weighted * line.line.mean;
        }
        point = information.try_inverse()? * right;
    }
    let squared = |point: &Vec3| lines.iter().map(|line| line.miss(point).0.norm_squared()).sum::<f64>();
    let misfit: f64 = lines.iter().map(|line| line.miss(&point)).map(|(m, v)| m.norm_squared() / v).sum();
    // Where the lines miss the point by more than their standard errors, the covariance is enlarged accordingly.
    let free = (2 * lines.len()) as f64 - 3.0;
    let covariance = information.try_inverse()? * (misfit / free).max(1.0);
    let chi_square = (point.transpose() * covariance.try_inverse()? * point)[0];
    let rms = |point: &Vec3| (squared(point) / lines.len() as f64).sqrt();
    let finite = point.iter().chain(covariance.iter()).all(|value| value.is_finite());
    finite.then(|| Meeting {
        counts: point.into(),
        sd_counts: std::array::from_fn(|band| covariance[(band, band)].max(0.0).sqrt()),
        lines: lines.len(),
        miss_counts: [rms(&point), rms(&Vec3::zeros())],
        chi_square,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{HypothesisId, LabelMap};
    use crate::segment::testing::Drawing;
    use crate::segment::{LightFindings, members};
    use proptest::prelude::*;

    const SIDE_PX: usize = 40;

    /// The ambient light found in a picture of stripes. Each stripe is a shaded body with a body vector and the point at which
    /// the stripe's matte line starts.
    fn found(bodies: &[([f64; 3], [f64; 3])], setting: AmbientSetting) -> Ambient {
        let width = SIDE_PX * bodies.len();
        let place = |x: f64| (x as usize / SIDE_PX).min(bodies.len() - 1);
        let mut drawing = Drawing::by_place(width, |x, y| {
            let (body, from) = bodies[place(x)];
            Vec3::from(from) + Vec3::from(body).normalize() * (40.0 + (3.0 * y) % 120.0)
        });
        drawing.used.ambient = setting;
        let of_pixel = |i: usize| place((i % width) as f64) as u16 + 1;
        let labels = LabelMap::from_vec(width, width, (0..width * width).map(of_pixel).collect()).unwrap();
        let hypotheses = HypothesisId::all(bodies.len()).zip(bodies).map(|(origin, (body, from))| {
            let direction = Vec3::from(*body).normalize();
            let matte = Line::new(Vec3::from(*from) + direction * 90.0, direction);
            let start = matte.mean;
            PlanarHypothesis {
                origin,
                matte,
                matte_length: 160.0,
                plane: None,
                start,
                highlight: None,
                alive: true,
            }
        });
        let regions = FinalRegions {
            labels,
            hypotheses: hypotheses.collect(),
            light: LightFindings::default(),
            second_lamp_mask: None,
        };
        ambient(&drawing.input(), &regions, &members(&regions))
    }

    const RED: [f64; 3] = [0.9, 0.3, 0.2];
    const GREEN: [f64; 3] = [0.2, 0.8, 0.3];
    const BLUE: [f64; 3] = [0.3, 0.4, 0.9];

    proptest! {
        #[test]
        fn the_meeting_point_of_three_lines_is_found(ambient in prop::array::uniform3(2.0f64..15.0)) {
            let estimate = found(&[(RED, ambient), (GREEN, ambient), (BLUE, ambient)], AmbientSetting::Auto);
            prop_assert_eq!(estimate.verdict, AmbientVerdict::Subtracted);
            let subtracted = estimate.subtracted.unwrap();
            for band in 0..3 {
                prop_assert!((subtracted[band] - ambient[band]).abs() < 0.6, "{:?} {:?}", subtracted, ambient);
            }
        }
    }

    #[test]
    fn lines_through_black_have_no_ambient_light_and_negative_light_is_refused() {
        let of = |p: [f64; 3]| found(&[(RED, p), (GREEN, p), (BLUE, p)], AmbientSetting::Auto);
        assert_eq!(of([0.0; 3]).verdict, AmbientVerdict::Black);
        let dark = of([-6.0, -5.0, -6.0]);
        assert_eq!((dark.verdict, dark.subtracted), (AmbientVerdict::Negative, None));
    }

    #[test]
    fn lines_that_do_not_meet_give_no_estimate_and_two_lines_have_to_meet_closely() {
        let apart = [
            (RED, [0.0, 12.0, 0.0]),
            (GREEN, [14.0, 0.0, 0.0]),
            (BLUE, [0.0, 0.0, 9.0]),
            (RED, [0.0, 0.0, 14.0]),
        ];
        let found_apart = found(&apart, AmbientSetting::Auto);
        assert_eq!(
            (found_apart.verdict, found_apart.subtracted),
            (AmbientVerdict::NoMeeting, None),
            "{found_apart:?}"
        );
        let two = |second: [f64; 3]| found(&[(RED, [8.0; 3]), (GREEN, second)], AmbientSetting::Auto);
        assert_eq!(two([8.0; 3]).verdict, AmbientVerdict::Subtracted);
        assert_eq!(two([10.0, 8.0, 6.0]).verdict, AmbientVerdict::FewLines);
    }

    #[test]
    fn a_given_light_is_used_and_off_estimates_nothing() {
        let bodies = [(RED, [8.0; 3]), (GREEN, [8.0; 3]), (BLUE, [8.0; 3])];
        assert_eq!(found(&bodies, AmbientSetting::Off), Ambient::default());
        let given = found(&bodies, AmbientSetting::Given([1.0, 2.0, 3.0]));
        assert_eq!((given.subtracted, given.verdict), (Some([1.0, 2.0, 3.0]), AmbientVerdict::Given));
    }
}
