//! Section 5.5: pixels whose colors clipping and blooming have moved out of the slices.
//!
//! The color of such a pixel is not usable, so the position decides: from its highlight pixels (nearer to the highlight line
//! than to the matte line) a region grows into unassigned neighbors that are brighter than the meeting point of both lines.
//! Then holes are filled: components of distorted pixels of whose assigned border one region has at least 70 %, and small components of unassigned
//! pixels that lie wholly inside one region. The paper only says that such a method “should be able to” help: the reading `fill_holes`.
//!
//! The position alone gives the clipped body of one object to the highlight of the object beside it: a bright green ball
//! turned black and orange. The bands that do not clip are known, and the clipped ones are at least the clip threshold (refinement
//! `clipped_bands`, `reflection/clipped_color`): a region takes a clipped pixel only where the color is nearer than an eighth of its length to
//! the colors that body and surface reflection of the region can have. On eight rendered scenes no clipped pixel of a plain object
//! is farther than a tenth of that limit from the colors of its own object.

use super::input::AnalysisInput;
use super::planar_hypothesis::{PlanarHypothesis, PlanarRegions};
use super::recorded_labels::RecordedLabels;
use crate::color::{Vec3, dot};
use crate::raster::{
    Border, ComponentSearch, Connectivity, HypothesisId, LabelMap, PixelIndex, UNASSIGNED, pixels_where,
};
use crate::reflection::ClippedColorTest;
use crate::trace::{GrowthBegan, HoleFilled, Pass, Recorder};
use rayon::prelude::*;

/// A component of distorted pixels joins a region to which at least this share of the component's assigned border belongs; unassigned
/// and dark pixels of the border do not count.
const MIN_BORDER_SHARE: f64 = 0.7;

/// Grows the planar regions into unassigned lit pixels that are brighter than the meeting point, and fills holes. Returns the region of each pixel.
pub fn clipping_regions<R: Recorder>(
    input: &AnalysisInput,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> LabelMap {
    let mut recorded_labels = RecordedLabels::new(planar.labels.clone(), recorder);
    recorded_labels.begin(Pass::Brightness);
    let members = recorded_labels.members(planar.hypotheses.len());
    let fronts: Vec<Vec<u32>> = planar
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| {
            let Some(highlight) = hypothesis.highlight_test() else { return Vec::new() };
            let is_highlight = |&pixel: &u32| highlight.is_highlight(input.pixels[pixel as usize]);
            members.region(HypothesisId::from_index(index)).iter().filter(is_highlight).collect()
        })
        .collect();
    let can_be = CanBe::new(input, planar);
    let ids = HypothesisId::all(planar.hypotheses.len());
    for ((id, hypothesis), mut front) in ids.zip(&planar.hypotheses).zip(fronts) {
        if input.stopped() {
            return recorded_labels.labels;
        }
        let meeting_point_norm2 = hypothesis.start.norm_squared() as f32;
        if R::KEEPS && !front.is_empty() {
            recorded_labels
                .recorder
                .record(GrowthBegan { hypothesis: id, limit: meeting_point_norm2.sqrt() });
        }
        recorded_labels.grow(
            id,
            &mut front,
            || input.stopped(),
            |_, pixel, holder| {
                let color = input.pixels[pixel];
                holder.is_none()
                    && input.masks.claimable_by_brightness(pixel)
                    && dot(color, color) > meeting_point_norm2
                    && can_be.of(id, pixel)
            },
        );
    }
    if input.readings.fill_holes {
        fill_holes(input, &can_be, &mut recorded_labels);
    }
    recorded_labels.labels
}

/// Fills the components of distorted pixels, and then the small components of unassigned pixels.
fn fill_holes<R: Recorder>(input: &AnalysisInput, can_be: &CanBe, recorded_labels: &mut RecordedLabels<R>) {
    let fits = |hole: &Hole| can_be.most_of(hole.hypothesis, hole.component);
    recorded_labels.begin(Pass::ClippedHoles);
    let distorted = |pixel: usize| input.masks.distorted(pixel) && !input.masks.dark(pixel);
    fill(recorded_labels, distorted, |hole| hole.border_share >= MIN_BORDER_SHARE && fits(hole));
    if input.stopped() {
        return;
    }
    recorded_labels.begin(Pass::SmallHoles);
    let largest_px = input.used.min_area as usize;
    let lit = |pixel: usize| !input.masks.dark(pixel);
    fill(recorded_labels, lit, |hole| {
        hole.closed && hole.border_share >= 1.0 && hole.component.len() <= largest_px && fits(hole)
    });
}

/// Which clipped pixels can belong to which region, by the bands that do not clip (refinement `clipped_bands`).
struct CanBe<'a> {
    input: &'a AnalysisInput<'a>,
    /// The test of each hypothesis; none where its surface reflection has no direction, and without the refinement.
    tests: Vec<Option<ClippedColorTest>>,
}

impl<'a> CanBe<'a> {
    fn new(input: &'a AnalysisInput<'a>, planar: &PlanarRegions) -> Self {
        let light = planar.light.direction.map(Vec3::from);
        let test = |hypothesis: &PlanarHypothesis| {
            let surface = hypothesis.plane.map(|plane| plane.surface).or(light)?;
            let PlanarHypothesis { matte, .. } = hypothesis;
            let threshold = input.used.clip_threshold as f32;
            input
                .refine
                .clipped_bands
                .then(|| ClippedColorTest::new(&matte.foot(), &matte.direction, &surface, threshold))
        };
        Self { input, tests: planar.hypotheses.iter().map(test).collect() }
    }

    /// Whether the pixel does not clip, or its bands that do not clip can be those of the region.
    fn of(&self, id: HypothesisId, pixel: usize) -> bool {
        let test = self.tests[id.index()].as_ref();
        test.is_none_or(|test| test.refusal(self.input.pixels[pixel]).is_none())
    }

    /// Whether at least half of the pixels can be of the region.
    fn most_of(&self, id: HypothesisId, pixels: &[usize]) -> bool {
        2 * pixels.iter().filter(|&&pixel| self.of(id, pixel)).count() >= pixels.len()
    }
}

/// A component of unassigned pixels, compared with the region that most of its border belongs to.
struct Hole<'a> {
    /// The region.
    hypothesis: HypothesisId,
    /// The pixels of the component.
    component: &'a [usize],
    /// Share of the region in the assigned part of the border, 0…1.
    border_share: f64,
    /// Whether regions surround the component on all sides.
    closed: bool,
}

/// Assigns each component of unassigned pixels for which `member` is true to the region with most of the component's border,
/// if `accepts` is true for the hole.
fn fill<R: Recorder>(
    recorded_labels: &mut RecordedLabels<R>,
    member: impl Fn(usize) -> bool + Sync,
    accepts: impl Fn(&Hole) -> bool,
) {
    let (width, height) = (recorded_labels.labels.width(), recorded_labels.labels.height());
    let mut search = ComponentSearch::new(width, height, Connectivity::Four);
    let labels = &recorded_labels.labels;
    for start in pixels_where(labels.len(), |pixel| labels[pixel] == UNASSIGNED && member(pixel)) {
        let labels = &recorded_labels.labels;
        let inside = |pixel: usize| labels[pixel] == UNASSIGNED && member(pixel);
        let Some(component) = search.component_at(start, inside) else { continue };
        let border = Border::of(labels, component, |pixel| !inside(pixel));
        let Some((label, border_share)) = border.main_region() else { continue };
        let Some(hypothesis) = HypothesisId::from_label(label) else { continue };
        if !accepts(&Hole { hypothesis, component, border_share, closed: border.is_closed() }) {
            continue;
        }
        if R::KEEPS {
            let (pixel, pixels) = (PixelIndex::from_index(start), component.len() as u32);
            recorded_labels.recorder.record(HoleFilled { hypothesis, pixel, pixels, border_share });
        }
        for &pixel in component {
            recorded_labels.assign(pixel, Some(hypothesis));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Line, Vec3};
    use crate::reflection::DichromaticPlane;
    use crate::segment::testing::{Drawing, check, labels};
    use crate::segment::{LightFindings, PlanarHypothesis};
    use crate::trace::NoopRecorder;

    fn body() -> Vec3 {
        Vec3::new(0.9, 0.3, 0.2).normalize()
    }

    /// A picture drawn with letters: m for matte, h for highlight, w for white and clipped, g for another color whose green clips, d for dim
    /// and of another color, a point for black.
    fn drawing(rows: &[&str]) -> Drawing {
        Drawing::new(rows, |c| match c {
            'm' => body() * 120.0,
            'h' => body() * 130.0 + Vec3::repeat(60.0),
            'w' => Vec3::repeat(255.0),
            'g' => Vec3::new(30.0, 255.0, 60.0),
            _ => Vec3::new(20.0, 60.0, 40.0),
        })
    }

    /// Checks that the clipping stage makes the labels `after` of the labels `before`. The highlight line of every region leaves the matte line at
    /// 120 counts; without a plane there is no highlight line.
    fn fill_in(drawing: &Drawing, before: &[&str], with_plane: bool, after: &[&str]) {
        let matte = Line::new(body() * 80.0, body());
        let hypothesis = PlanarHypothesis {
            origin: HypothesisId::from_index(0),
            matte,
            matte_length: 150.0,
            plane: DichromaticPlane::new(&matte, &Vec3::repeat(1.0)).filter(|_| with_plane),
            start: body() * 120.0,
            highlight: None,
            alive: true,
        };
        let planar = PlanarRegions {
            labels: labels(before),
            hypotheses: vec![hypothesis; 2],
            illuminant: None,
            light: LightFindings::default(),
            second_lamp_mask: None,
        };
        check(&clipping_regions(&drawing.input(), &planar, &mut NoopRecorder), after);
    }

    #[test]
    fn highlights_grow_into_what_is_brighter_than_the_meeting_point() {
        let picture = drawing(&["mmmmmm", "mhwwdd", "mmwwdm", "mmmmd."]);
        let before = ["111111", "11....", "11...1", "1111.."];
        fill_in(&picture, &before, true, &["111111", "1111..", "1111.1", "1111.."]);
    }

    #[test]
    fn a_clipped_pixel_whose_other_bands_the_region_cannot_have_is_left() {
        let picture = drawing(&["mmmmmm", "mhwggm", "mmmmmm", "mmggmm", "mmmmmm"]);
        let before = ["111111", "11...1", "111111", "11..11", "111111"];
        fill_in(&picture, &before, true, &["111111", "111..1", "111111", "11..11", "111111"]);
    }

    #[test]
    fn a_clipped_hole_joins_the_region_with_most_of_its_border() {
        let picture = drawing(&["mmmmmmmm", "mwwmmwwm", "mmmmmmmm"]);
        // The second hole has two equal neighbors.
        let most = ["11111122", "1..11..2", "11111122"];
        fill_in(&picture, &most, false, &["11111122", "11111..2", "11111122"]);
    }

    #[test]
    fn an_unexplained_hole_is_filled_when_it_is_small_and_wholly_inside() {
        let picture = drawing(&["mmmmmmmm", "mddmm.dm", "mmmmmmmm", "mmddddmm", "mmdddmmm", "mmmmmmmd"]);
        let before = ["11111111", "1..11..1", "11111111", "11....11", "11...111", "1111111."];
        // The second hole touches a dark pixel, the third has more pixels than the minimal area of 4, the fourth touches the picture's border.
        let after = ["11111111", "11111..1", "11111111", "11....11", "11...111", "1111111."];
        fill_in(&picture, &before, false, &after);
    }
}
