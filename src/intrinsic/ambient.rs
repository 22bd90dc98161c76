//! Section 7.5: ambient light adds a constant to every pixel, so that the matte lines meet away from black (Shafer's extended
//! model; refinement `ambient_light`).
//!
//! Each region's matte line is refitted to what lies in its cylinder. The common point p minimizes Σ ρ(|Q_k (p − m_k)|²/var_k),
//! Q_k the projection across line k, m_k a point of it, var_k how well it is known near black: its own noise, .15 counts, and
//! .1° of direction over the way there. ρ is Cauchy's, at three standard deviations. p is subtracted before the split if at
//! least three lines tell of it, or two that clearly meet, it is significant (χ² with three degrees of freedom, .999) and above
//! the noise, a color that light can have, a better meeting point than black, and no brighter than the darkest pixels. After
//! the split it is added to the body image: ambient light that is reflected is body reflection too.
//!
//! On lab scenes it is at most .3 counts a band; veils of 3 to 12 counts are found to .4 counts (1.3 on one scene of three
//! blue objects, within its own standard deviation), and the body image is as good as without them.

use crate::color::{Cylinder, Line, LineFit, Moments, Vec3, principal_axes};
use crate::params::AmbientSetting;
use crate::segment::{AnalysisInput, FinalRegions, Members, POOR_FIT, Pixels, PlanarHypothesis};
use crate::trace::{Ambient, AmbientVerdict, Meeting};
use nalgebra::Matrix3;
use rayon::prelude::*;

/// Three lines can agree on a point. Two nearly meet somewhere: they have to pass each other within half the noise, at a place
/// known to the noise.
const LEAST_LINES: usize = 3;
const CLOSE: f64 = 0.5;
/// Fewest pixels of a line, and the most that are looked at, evenly chosen.
const LEAST_PX: usize = 300;
const SAMPLES: usize = 4000;
/// How far a line has to reach, standard deviation along it, σ.
const LEAST_EXTENT: f64 = 8.0;
/// Errors that averaging does not remove: of a line's place, counts, and of its direction, degrees.
const PLACE_COUNTS: f64 = 0.15;
const DIRECTION_DEG: f64 = 0.1;
/// Neighboring pixels err together: so many count as one.
const TOGETHER: f64 = 4.0;
/// 99.9 % quantile of χ² with three degrees of freedom.
const SIGNIFICANT: f64 = 16.27;
/// Lines have to miss the common point by at most this share of what they miss black by.
const BETTER: f64 = 0.5;
/// Lines that miss a point by more do not meet there, σ.
const FAR: f64 = 2.0;
/// Share of the pixels that may be darker than the ambient light.
const DARKEST: f64 = 0.005;
/// How robust lines are fitted.
const TUNING: f64 = 4.7;
const ITERATIONS: usize = 12;

/// What a segmented picture tells of its ambient light.
pub fn ambient(input: &AnalysisInput, regions: &FinalRegions, members: &Members) -> Ambient {
    match input.used.ambient {
        AmbientSetting::Given(counts) => {
            Ambient { subtracted: Some(counts), meeting: None, verdict: AmbientVerdict::Given }
        }
        AmbientSetting::Auto if input.refine.ambient_light => estimated(input, regions, members),
        AmbientSetting::Off | AmbientSetting::Auto => Ambient::default(),
    }
}

fn estimated(input: &AnalysisInput, regions: &FinalRegions, members: &Members) -> Ambient {
    let lines: Vec<MatteLine> = (1..=regions.hypotheses.len() as u16)
        .into_par_iter()
        .filter_map(|id| MatteLine::new(input, &regions.hypotheses[usize::from(id) - 1], members.region(id)))
        .collect();
    let meeting = meeting(&lines);
    let tells = |found: &Meeting| {
        let known = found.sd_counts.iter().all(|sd| *sd <= input.sigma());
        found.lines >= LEAST_LINES || (known && found.miss_counts[0] <= CLOSE * input.sigma())
    };
    let Some(found) = meeting.filter(tells) else {
        return Ambient { subtracted: None, meeting, verdict: AmbientVerdict::FewLines };
    };
    let color = Vec3::from(found.counts);
    let verdict = if found.chi_square <= SIGNIFICANT || color.norm() <= input.sigma() {
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

/// Whether more pixels of the regions than noise explains are darker in some band.
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

/// A matte line and how well it is known.
struct MatteLine {
    line: Line,
    /// Squared standard error of its place at its mean, counts².
    place: f64,
    /// Squared standard error of its direction.
    direction: f64,
}

impl MatteLine {
    /// Of one region; none where it has too few pixels on a line, or none that is long enough.
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
        let fit = LineFit { sigma: input.sigma(), tuning: TUNING, iterations: ITERATIONS };
        let line = hypothesis.matte.refit(&colors, &fit);
        let near = Cylinder::new(&line, POOR_FIT * 2.0 * input.sigma());
        let moments: Moments = colors.into_iter().filter(|&color| near.contains(color)).collect();
        let ([along, across, height], _) = principal_axes(&moments.covariance());
        let noise = f64::midpoint(across, height);
        let long = along.max(0.0).sqrt() >= LEAST_EXTENT * input.sigma();
        let straight = noise.max(0.0).sqrt() <= POOR_FIT * input.sigma();
        let independent = moments.n / TOGETHER;
        (moments.n >= LEAST_PX as f64 && long && straight).then(|| Self {
            line,
            place: noise / independent + PLACE_COUNTS * PLACE_COUNTS,
            direction: noise / (independent * along) + DIRECTION_DEG.to_radians().powi(2),
        })
    }

    /// From a point to the nearest one of the line, and the squared standard error of that.
    fn miss(&self, point: &Vec3) -> (Vec3, f64) {
        let from = point - self.line.mean;
        let way = from.dot(&self.line.direction);
        (self.line.direction * way - from, self.place + way * way * self.direction)
    }
}

/// The point nearest to all lines; none where they are too few or parallel.
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
            let reject_reason = miss.norm_squared() / (9.0 * variance);
            let across = Matrix3::identity() - line.line.direction * line.line.direction.transpose();
            let weighted = across / (variance * (1.0 + reject_reason));
            information += weighted;
            right += weighted * line.line.mean;
        }
        point = information.try_inverse()? * right;
    }
    let squared = |point: &Vec3| lines.iter().map(|line| line.miss(point).0.norm_squared()).sum::<f64>();
    let misfit: f64 = lines.iter().map(|line| line.miss(&point)).map(|(m, v)| m.norm_squared() / v).sum();
    // Lines that disagree by more than they should tell less than they say.
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
    use crate::raster::LabelMap;
    use crate::segment::testing::Drawing;
    use crate::segment::{LightFindings, members};
    use proptest::prelude::*;

    const SIDE_PX: usize = 40;

    /// Stripes of shaded bodies, each from a point of its own, and what is found of their ambient light.
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
        let hypotheses = (1..).zip(bodies).map(|(origin, (body, from))| {
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
        let regions =
            FinalRegions { labels, hypotheses: hypotheses.collect(), light: LightFindings::default() };
        ambient(&drawing.input(), &regions, &members(&regions))
    }

    const RED: [f64; 3] = [0.9, 0.3, 0.2];
    const GREEN: [f64; 3] = [0.2, 0.8, 0.3];
    const BLUE: [f64; 3] = [0.3, 0.4, 0.9];

    proptest! {
        #[test]
        fn three_lines_tell_where_they_meet(veil in prop::array::uniform3(2.0f64..15.0)) {
            let told = found(&[(RED, veil), (GREEN, veil), (BLUE, veil)], AmbientSetting::Auto);
            prop_assert_eq!(told.verdict, AmbientVerdict::Subtracted);
            let subtracted = told.subtracted.unwrap();
            for band in 0..3 {
                prop_assert!((subtracted[band] - veil[band]).abs() < 0.6, "{:?} {:?}", subtracted, veil);
            }
        }
    }

    #[test]
    fn black_needs_no_light_and_darkness_is_none() {
        let of = |p: [f64; 3]| found(&[(RED, p), (GREEN, p), (BLUE, p)], AmbientSetting::Auto);
        assert_eq!(of([0.0; 3]).verdict, AmbientVerdict::Black);
        let dark = of([-6.0, -5.0, -6.0]);
        assert_eq!((dark.verdict, dark.subtracted), (AmbientVerdict::Negative, None));
    }

    #[test]
    fn lines_that_do_not_meet_tell_of_no_light_and_two_have_to_meet_closely() {
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
    fn what_is_given_is_taken_and_off_is_off() {
        let bodies = [(RED, [8.0; 3]), (GREEN, [8.0; 3]), (BLUE, [8.0; 3])];
        assert_eq!(found(&bodies, AmbientSetting::Off), Ambient::default());
        let given = found(&bodies, AmbientSetting::Given([1.0, 2.0, 3.0]));
        assert_eq!((given.subtracted, given.verdict), (Some([1.0, 2.0, 3.0]), AmbientVerdict::Given));
    }
}
