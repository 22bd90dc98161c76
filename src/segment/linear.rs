//! Section 5.3: linear hypotheses. Large merged areas of class *line* become color cylinders, and each cylinder segments
//! the image anew, pixel by pixel.
//!
//! Areas become hypotheses by decreasing number of unclaimed pixels until the largest is below the minimal area. A cylinder
//! ends at the dark sphere. A pixel inside two cylinders belongs to the nearer axis (the proximity heuristic).
//!
//! Refined: `robust_lines` fits lines with Tukey's weights, and fits and grows each region a second time from the pixels of
//! the first time; `all_seeds` starts from every pixel of the area inside the cylinder, not from the pixel nearest to the mean.

use super::classify::Windows;
use super::input::AnalysisInput;
use super::merge::Areas;
use super::recorded_labels::{Pixels, RecordedLabels};
use super::seed_areas::{SeedAreaRules, SeedAreas};
use crate::color::{Cylinder, Line, Moments, RobustFitSettings};
use crate::raster::{HypothesisId, PixelIndex};
use crate::trace::{
    CandidateSource, Class, Contest, GrowthBegan, HypothesisChosen, HypothesisPassedOver, LineRefitted,
    Measure, Pass, PassedOver, Recorder, SeedsPlaced,
};

/// A linear hypothesis: an object's matte line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hypothesis {
    /// Matte line: the axis of the cylinder.
    pub line: Line,
    /// Whether the hypothesis still exists: false after it was absorbed, merged into another hypothesis or dropped.
    pub alive: bool,
    /// Clusters that were absorbed as broad highlights of the object.
    pub highlights: Vec<(CandidateSource, Moments)>,
}

impl Hypothesis {
    /// The hypothesis of a matte line.
    pub(crate) fn new(line: Line) -> Self {
        Self { line, alive: true, highlights: Vec::new() }
    }
}

/// Largest number of pixels that a line is fitted to, evenly chosen; the reading `every_pixel` has no such limit.
const FIT_SAMPLES: usize = 4000;

/// Generates linear hypotheses from merged areas and exploits them; new hypotheses are appended to `hypotheses`.
pub fn linear<R: Recorder>(
    input: &AnalysisInput,
    windows: &Windows,
    areas: &Areas,
    rules: &SeedAreaRules,
    hypotheses: &mut Vec<Hypothesis>,
    recorded_labels: &mut RecordedLabels<R>,
) {
    recorded_labels.begin(Pass::Hypotheses);
    let mut seed_areas = SeedAreas::new(input, windows, areas, rules, recorded_labels);
    let mut rank = 0;
    while let Some(area) = seed_areas.largest(rules.min_area_px) {
        let pixels: Vec<u32> = seed_areas.free_pixels(input, area, recorded_labels).collect();
        seed_areas.mark_examined(area);
        if input.stopped() {
            return;
        }
        let pass_over = |recorded_labels: &mut RecordedLabels<R>, reason| {
            if R::KEEPS {
                let (area, pixels, least) = (area as u32, pixels.len() as u32, rules.min_area_px as u32);
                recorded_labels.recorder.record(HypothesisPassedOver { area, pixels, least, reason });
            }
        };
        rank += 1;
        let line = match seed_line(input, areas.classes[area], &pixels, rules, hypotheses.len()) {
            Ok(line) => line,
            Err(reason) => {
                pass_over(recorded_labels, reason);
                continue;
            }
        };
        let hypothesis = HypothesisId::from_index(hypotheses.len());
        if R::KEEPS {
            recorded_labels.recorder.record(HypothesisChosen {
                hypothesis,
                area: area as u32,
                rank: rank - 1,
                pixels: pixels.len() as u32,
                line,
                radius: input.used.radius_counts(),
            });
        }
        hypotheses.push(Hypothesis::new(line));
        let claimed = exploit(input, hypothesis, &pixels, hypotheses, recorded_labels);
        seed_areas.subtract(&claimed, windows, recorded_labels.labels.width());
        if rules.through_black && claimed.len() < rules.min_area_px {
            hypotheses[hypothesis.index()].alive = false;
            for pixel in claimed {
                recorded_labels.assign(pixel as usize, None);
            }
            pass_over(recorded_labels, PassedOver::Barren);
        }
    }
    if R::KEEPS {
        let least = rules.min_area_px as u32;
        for (area, pixels, reason) in seed_areas.never_examined(least) {
            recorded_labels.recorder.record(HypothesisPassedOver { area, pixels, least, reason });
        }
    }
}

/// The matte line of a hypothesis from the unclaimed pixels of an area, or why the area makes no hypothesis. `made`: number of hypotheses so
/// far.
fn seed_line(
    input: &AnalysisInput,
    class: Option<Class>,
    pixels: &[u32],
    rules: &SeedAreaRules,
    made: usize,
) -> Result<Line, PassedOver> {
    if pixels.len() < rules.min_area_px {
        return Err(PassedOver::Consumed);
    }
    if made >= HypothesisId::MOST {
        return Err(PassedOver::NoNumberLeft);
    }
    let line = fitted_line(input, class, &sample(input, pixels)).ok_or(PassedOver::NoExtent)?;
    let is_far = rules.through_black && line.foot().norm() > input.used.radius_counts();
    if is_far { Err(PassedOver::FarFromBlack) } else { Ok(line) }
}

/// Mean and first eigenvector of colors, fitted robustly with `robust_lines`; of an area of class *point*, the line from black through the
/// mean. `None` for colors without extent.
fn fitted_line(input: &AnalysisInput, class: Option<Class>, colors: &[[f32; 3]]) -> Option<Line> {
    let moments: Moments = colors.iter().copied().collect();
    if class == Some(Class::Point) {
        let mean = moments.mean();
        return (mean.norm() > 0.0).then(|| Line::new(mean, mean));
    }
    let line = Line::principal(&moments)?;
    Some(if input.refine.robust_lines { line.refit(colors, &line_fit(input, 10)) } else { line })
}

/// The settings of a robust line fit: residuals below the image's noise count fully.
pub fn line_fit(input: &AnalysisInput, iterations: usize) -> RobustFitSettings {
    RobustFitSettings { sigma: input.sigma(), tuning: 4.0, iterations }
}

/// Grows `hypothesis` from an area's unclaimed pixels; with `robust_lines` fits and grows a second time. Returns
/// the region's pixels.
fn exploit<R: Recorder>(
    input: &AnalysisInput,
    hypothesis: HypothesisId,
    area_pixels: &[u32],
    hypotheses: &mut [Hypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) -> Vec<u32> {
    let index = hypothesis.index();
    let mut cylinders = cylinders(input, hypotheses);
    let mut claimed = seeds(input, &hypotheses[index].line, cylinders[index], area_pixels);
    if R::KEEPS {
        recorded_labels.recorder.record(SeedsPlaced { hypothesis, pixels: claimed.len() as u32 });
    }
    for &pixel in &claimed {
        recorded_labels.assign(pixel as usize, Some(hypothesis));
    }
    grow_cylinder(input, hypothesis, &cylinders, &mut claimed, recorded_labels);
    if !input.refine.robust_lines || claimed.is_empty() {
        return claimed;
    }
    refit(input, hypothesis, &claimed, hypotheses, recorded_labels);
    cylinders[index] = Cylinder::new(&hypotheses[index].line, input.used.radius_counts());
    claimed.retain(|&pixel| {
        let inside = cylinders[index].contains(input.pixels[pixel as usize]);
        if !inside {
            recorded_labels.assign(pixel as usize, None);
        }
        inside
    });
    grow_cylinder(input, hypothesis, &cylinders, &mut claimed, recorded_labels);
    claimed
}

/// Fits a region's line to the region's pixels again.
fn refit<R: Recorder>(
    input: &AnalysisInput,
    hypothesis: HypothesisId,
    pixels: &[u32],
    hypotheses: &mut [Hypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) {
    let colors = sample(input, pixels);
    let line = &mut hypotheses[hypothesis.index()].line;
    *line = line.refit(&colors, &line_fit(input, 6));
    if R::KEEPS {
        recorded_labels.recorder.record(LineRefitted { hypothesis, line: *line });
    }
}

/// Largest number of pixels from which the length of a matte line is measured, evenly chosen; the reading `every_pixel` has no such
/// limit.
const LENGTH_SAMPLES: usize = 6000;

/// Colors of at most [`FIT_SAMPLES`] of the pixels, evenly chosen.
fn sample(input: &AnalysisInput, pixels: &[u32]) -> Vec<[f32; 3]> {
    let step = pixels.len().div_ceil(input.fit_samples(FIT_SAMPLES)).max(1);
    pixels.iter().step_by(step).map(|&pixel| input.pixels[pixel as usize]).collect()
}

/// The cylinder of every hypothesis.
pub fn cylinders(input: &AnalysisInput, hypotheses: &[Hypothesis]) -> Vec<Cylinder> {
    hypotheses.iter().map(|h| Cylinder::new(&h.line, input.used.radius_counts())).collect()
}

/// The pixels from which growth starts: with `all_seeds` every pixel inside the cylinder, else the one nearest to the mean.
fn seeds(input: &AnalysisInput, line: &Line, cylinder: Cylinder, area_pixels: &[u32]) -> Vec<u32> {
    let inside = area_pixels.iter().copied().filter(|&p| cylinder.contains(input.pixels[p as usize]));
    if input.refine.all_seeds {
        return inside.collect();
    }
    let from_mean = |pixel: &u32| (crate::color::vec3(input.pixels[*pixel as usize]) - line.mean).norm();
    inside.min_by(|a, b| from_mean(a).total_cmp(&from_mean(b))).into_iter().collect()
}

/// Grows a region from the pixels `claimed` into the pixels inside its cylinder. A pixel of another region is claimed only if
/// the own axis is nearer. Claimed pixels are appended to `claimed`.
fn grow_cylinder<R: Recorder>(
    input: &AnalysisInput,
    hypothesis: HypothesisId,
    cylinders: &[Cylinder],
    claimed: &mut Vec<u32>,
    recorded_labels: &mut RecordedLabels<R>,
) {
    let own = cylinders[hypothesis.index()];
    if R::KEEPS {
        let limit = input.used.radius_counts() as f32;
        recorded_labels.recorder.record(GrowthBegan { hypothesis, limit });
    }
    recorded_labels.grow(
        hypothesis,
        claimed,
        || input.stopped(),
        |recorder, pixel, holder| {
            let color = input.pixels[pixel];
            if !input.claimable(pixel) || !own.contains(color) {
                return false;
            }
            let Some(holder) = holder else { return true };
            let own_distance2 = own.distance2(color);
            let holder_distance2 = cylinders[holder.index()].distance2(color);
            let taken = own_distance2 < holder_distance2;
            if R::KEEPS {
                let contest = Contest {
                    measure: Measure::Axis,
                    challenger: own_distance2.sqrt(),
                    holder: holder_distance2.sqrt(),
                };
                recorder.contest(PixelIndex::from_index(pixel), holder, hypothesis, taken, contest);
            }
            taken
        },
    );
}

/// Length of a region's matte line from black, counts: the 99.5 % quantile of C·d (d the line's direction) over the pixels on
/// the outer side of the line. Highlights lie on the inner side (section 5.4.1, figure 9), so that the brightest matte point
/// is measured on the outer side. Under the reading `brightest_pixel` the largest C·d instead of the quantile.
pub fn matte_length(input: &AnalysisInput, line: &Line, pixels: Pixels) -> f64 {
    let outer_side = line.outer_side();
    let direction = crate::color::rgb(&line.direction);
    let mut lengths: Vec<f32> = pixels
        .sample(input.fit_samples(LENGTH_SAMPLES))
        .map(|pixel| input.pixels[pixel as usize])
        .filter(|&color| outer_side.contains(color))
        .map(|color| crate::color::dot(color, direction))
        .collect();
    if lengths.is_empty() {
        return line.mean.dot(&line.direction);
    }
    let per_mille = if input.readings.brightest_pixel { 1000 } else { 995 };
    let rank = (lengths.len() - 1) * per_mille / 1000;
    let (_, &mut length, _) = lengths.select_nth_unstable_by(rank, f32::total_cmp);
    f64::from(length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::raster::LabelMap;
    use crate::segment::testing::{Drawing, check, labels};
    use crate::trace::{Stage, StageTrace, Step, TraceRecorder};

    /// Grows region 1 from its pixels in `before`, with a cylinder around each axis, compares the labels with `after`, and
    /// returns the record.
    fn grow(drawing: &Drawing, before: &LabelMap, axes: &[Vec3], after: &[&str]) -> StageTrace {
        let hypotheses: Vec<Hypothesis> =
            axes.iter().map(|axis| Hypothesis::new(Line::new(axis * 100.0, *axis))).collect();
        let mut recorder = TraceRecorder::default();
        let mut recorded_labels = RecordedLabels::new(before.clone(), &mut recorder);
        let mut claimed: Vec<u32> = (0..before.len() as u32).filter(|&p| before[p as usize] == 1).collect();
        let input = drawing.input();
        grow_cylinder(
            &input,
            HypothesisId::from_index(0),
            &cylinders(&input, &hypotheses),
            &mut claimed,
            &mut recorded_labels,
        );
        check(&recorded_labels.labels, after);
        recorder.finish(Stage::Linear).unwrap()
    }

    #[test]
    fn a_region_grows_along_edges_into_the_colors_of_its_cylinder_and_stops_at_the_dark_sphere() {
        let red = Vec3::new(0.9, 0.3, 0.3).normalize();
        let drawing = Drawing::new(&["rrRRg", "r.rgg", "dgrrR", "rggrr"], |c| match c {
            'r' => red * 60.0,
            'R' => red * 150.0,
            'd' => red * 20.0,
            _ => Vec3::new(20.0, 90.0, 30.0),
        });
        let seed = labels(&["1....", ".....", ".....", "....."]);
        grow(&drawing, &seed, &[red], &["1111.", "1.1..", "..111", "...11"]);
    }

    #[test]
    fn a_pixel_inside_two_cylinders_belongs_to_the_nearer_axis() {
        let one = Vec3::x();
        let other = Vec3::new(1.0, 0.09, 0.0).normalize();
        let drawing = Drawing::new(&["axyb"], |c| match c {
            'a' => one * 100.0,
            'x' => Vec3::new(100.0, 3.0, 0.0),
            'y' => Vec3::new(100.0, 6.0, 0.0),
            _ => other * 100.0,
        });
        let stage_trace = grow(&drawing, &labels(&["1222"]), &[one, other], &["1122"]);
        let verdicts: Vec<(u32, bool)> = stage_trace
            .steps()
            .filter_map(|step| match step {
                Step::Claim { pixel, contest: Some(_), .. } => Some((pixel.get(), true)),
                Step::Refusal { pixel, .. } => Some((pixel.get(), false)),
                _ => None,
            })
            .collect();
        assert_eq!(verdicts, [(1, true), (2, false)]);
    }

    #[test]
    fn the_paper_starts_from_the_pixel_nearest_to_the_mean_and_refined_from_all_inside() {
        let red = Vec3::new(0.9, 0.3, 0.3).normalize();
        let mut drawing = Drawing::new(&["1284g"], |c| match c.to_digit(10) {
            Some(digit) => red * f64::from(20 * digit),
            None => Vec3::new(20.0, 90.0, 30.0),
        });
        let line = Line::new(red * 75.0, red);
        let cylinder = Cylinder::new(&line, 10.0);
        assert_eq!(seeds(&drawing.input(), &line, cylinder, &[0, 1, 2, 3, 4]), [0, 1, 2, 3]);
        drawing.refine.all_seeds = false;
        assert_eq!(seeds(&drawing.input(), &line, cylinder, &[0, 1, 2, 3, 4]), [3]);
    }
}
