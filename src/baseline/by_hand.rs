//! The method of 1987 and 1988: a skewed T of pixels that a person has marked (section 6, first paragraph).
//!
//! "We have previously reported a method to detect and remove highlights from hand-segmented images. That method projected the pixels from
//! a selected image area into the color space and fitted a skewed T to the entire color clusters, thus determining the body and surface
//! reflection vectors of the area." The area of the analysis takes the place of the windows, growth and neighbors of section 5: its
//! usable pixels are divided between matte and highlight line ([`SkewedTFit`]), the two lines are tested as a skewed T with the tests of section
//! 5.4.1, and the pixels are split as in section 6, by the two vectors of the skewed T. All lit pixels of the area are the one region, clipped
//! ones included. Pixels at the edge of the area are mixtures of two objects: no line is fitted to them, unless more than half of the pixels
//! are at an edge, as in scattered marks.
//!
//! The 50 % heuristic is measured and told, and does not decide: it tells highlights from neighboring objects, and a person has said that the
//! area is one object.
//!
//! Measured figures are in docs/by-hand.md.

use super::skewed_t_fit::{SkewedTFit, rms_from_line};
use crate::color::{Line, Moments, Vec3, axis_angle_deg, closest_points};
use crate::photo::Masks;
use crate::raster::{HypothesisId, LabelMap, UNASSIGNED};
use crate::reflection::{DichromaticPlane, MIN_ANGLE_DEG, Slice};
use crate::segment::{
    AnalysisInput, HighlightLine, Hypothesis, Illuminant, LightBasis, LightFindings, MatteLine, MatteRegions,
    Members, PlanarHypothesis, PlanarRegions, RecordedLabels, marked_highlight_line, matte_length,
};
use crate::trace::{
    AveragedDirection, CandidateSource, HighlightsAveraged, IlluminantGiven, MarkedCluster, MarkedLineFitted,
    MarkedPixelsTaken, Pass, Recorder, SliceMade,
};

/// Fewest usable pixels that a skewed T is fitted to.
pub const LEAST_MARKED_PX: usize = 20;
/// The only hypothesis.
const MARKED: HypothesisId = HypothesisId::from_index(0);

/// Why the marked pixels have no skewed T.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSkewedT {
    /// This number of marked pixels is usable: too few.
    TooFew(usize),
    /// The colors vary no more than the noise does.
    Point,
    /// All colors lie on one line: there is no highlight.
    Line,
    /// The matte and the highlight line are less than 3° apart: body and surface reflection are not told from each other.
    Parallel,
    /// The matte and the highlight line form no skewed T.
    NoMeeting,
}

/// The matte region: the usable marked pixels that are nearer to the matte line. No region where no line fits.
pub fn marked_matte_region<R: Recorder>(input: &AnalysisInput, recorder: &mut R) -> MatteRegions {
    let labels = LabelMap::filled(input.pixels.width(), input.pixels.height(), UNASSIGNED);
    let mut recorded_labels = RecordedLabels::new(labels, recorder);
    recorded_labels.begin(Pass::Marked);
    let pixels = usable_pixels(input.masks);
    let fitted = pixels.iter().filter(|&&pixel| input.is_fitted(pixel));
    let colors: Vec<[f32; 3]> = fitted.map(|&pixel| input.pixels[pixel]).collect();
    let fit = (pixels.len() >= LEAST_MARKED_PX).then(|| SkewedTFit::of(input, &colors)).flatten();
    let matte = fit.as_ref().and_then(|fit| fit.last(MarkedCluster::Matte));
    let Some((fit, matte)) = fit.as_ref().zip(matte) else {
        return MatteRegions { labels: recorded_labels.labels, hypotheses: Vec::new() };
    };
    if R::KEEPS {
        for fitted in &fit.fits {
            recorded_labels.recorder.record(MarkedLineFitted {
                hypothesis: MARKED,
                cluster: fitted.cluster,
                round: fitted.round,
                pixels: fitted.moments.n as u32,
                line: fitted.line,
                rms_counts: fitted.rms_counts,
                radius: input.used.radius_counts(),
            });
        }
    }
    let is_matte = |pixel: &usize| !fit.is_highlight(input.pixels[*pixel]);
    let members: Vec<usize> = pixels.into_iter().filter(is_matte).collect();
    take(&mut recorded_labels, MarkedCluster::Matte, &members);
    let mut hypothesis = Hypothesis::new(matte.line);
    let highlight = fit.last(MarkedCluster::Highlight);
    hypothesis.highlights.extend(highlight.map(|fit| (CandidateSource::Marked, fit.moments)));
    MatteRegions { labels: recorded_labels.labels, hypotheses: vec![hypothesis] }
}

/// The output of the planar stage where no line fits the marked pixels: no region, and the light that was given.
fn no_planar_region(input: &AnalysisInput, labels: LabelMap) -> PlanarRegions {
    PlanarRegions {
        labels,
        hypotheses: Vec::new(),
        illuminant: input.used.illuminant.map(given_light),
        light: input.used.illuminant.map_or_else(no_light, LightFindings::given),
        second_lamp_mask: None,
    }
}

/// The region of all usable marked pixels, with its skewed T. The direction of its own highlight line is the light, unless a light was given.
pub fn marked_planar_region<R: Recorder>(
    input: &AnalysisInput,
    matte: &MatteRegions,
    recorder: &mut R,
) -> PlanarRegions {
    let mut recorded_labels = RecordedLabels::new(matte.labels.clone(), recorder);
    let Some(hypothesis) = matte.hypotheses.first() else {
        return no_planar_region(input, recorded_labels.labels);
    };
    recorded_labels.begin(Pass::Candidates);
    let members = Members::of(&matte.labels, 1);
    let length = matte_length(input, &hypothesis.line, members.region(MARKED));
    let highlight =
        hypothesis.highlights.first().filter(|(_, cluster)| !is_parallel(&hypothesis.line, cluster));
    let highlight = highlight.and_then(|(_, cluster)| {
        let matte = MatteLine { hypothesis: MARKED, line: hypothesis.line, length };
        marked_highlight_line(input, &matte, cluster, recorded_labels.recorder)
    });
    recorded_labels.begin(Pass::Illuminant);
    let (illuminant, light) = light(input, highlight.as_ref(), recorded_labels.recorder);
    let plane = illuminant.and_then(|light| DichromaticPlane::new(&hypothesis.line, &light.direction.into()));
    let default_start = PlanarHypothesis::default_start(&hypothesis.line, length);
    let start = highlight.map_or(default_start, |line| line.start);
    recorded_labels.begin(Pass::Slices);
    if let (true, Some(plane)) = (R::KEEPS, plane) {
        let half_width = input.used.slice_half_width_counts();
        recorded_labels.recorder.record(SliceMade {
            hypothesis: MARKED,
            plane,
            matte_length: length,
            start,
            half_width,
            slice: Slice::unbounded(&plane, half_width),
        });
    }
    let labels = &recorded_labels.labels;
    let others: Vec<usize> =
        usable_pixels(input.masks).into_iter().filter(|&pixel| labels[pixel] == UNASSIGNED).collect();
    take(&mut recorded_labels, MarkedCluster::Highlight, &others);
    let planar = PlanarHypothesis {
        origin: MARKED,
        matte: hypothesis.line,
        matte_length: length,
        plane,
        start,
        highlight: highlight.map(|line| line.direction),
        alive: true,
    };
    PlanarRegions {
        labels: recorded_labels.labels,
        hypotheses: vec![planar],
        illuminant,
        light,
        second_lamp_mask: None,
    }
}

/// The region of all lit marked pixels: clipped and bloomed pixels join it.
pub fn marked_region_with_distorted<R: Recorder>(
    input: &AnalysisInput,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> LabelMap {
    let mut recorded_labels = RecordedLabels::new(planar.labels.clone(), recorder);
    recorded_labels.begin(Pass::Marked);
    if !planar.hypotheses.is_empty() {
        let labels = &recorded_labels.labels;
        let left = |pixel: &usize| labels[*pixel] == UNASSIGNED && !input.masks.dark(*pixel);
        let others: Vec<usize> = (0..labels.len()).filter(left).collect();
        take(&mut recorded_labels, MarkedCluster::Distorted, &others);
    }
    recorded_labels.labels
}

/// The region in pixels of the photograph: the lit marked pixels; empty where the working picture has no region.
pub fn marked_labels(masks: &Masks, has_region: bool) -> LabelMap {
    masks.mask(|masks, pixel| has_region && !masks.dark(pixel)).map(|&member| u16::from(member))
}

/// The skewed T of marked pixels: how both lines meet, whether or not they passed the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkedSkewedT {
    /// Number of pixels that the highlight line was fitted to.
    pub highlight_pixels: usize,
    /// Root mean square distance of these pixels from the highlight line, counts.
    pub highlight_rms_counts: f64,
    /// Point of the matte line that is nearest to the highlight line, counts.
    pub meeting_point: [f64; 3],
    /// Distance between both lines, counts.
    pub gap_counts: f64,
    /// Place of the meeting point on the matte line, percent of its length from black (the 50 % heuristic of section 3.2).
    pub position_percent: f64,
    /// Angle between both lines, degrees.
    pub angle_deg: f64,
}

impl MarkedSkewedT {
    /// The skewed T of an analysis by hand; `None` without a highlight line.
    pub fn of(matte: &MatteRegions, planar: &PlanarRegions) -> Option<Self> {
        let (matte, planar) = matte.hypotheses.first().zip(planar.hypotheses.first())?;
        let (_, cluster) = matte.highlights.iter().find(|(source, _)| *source == CandidateSource::Marked)?;
        let line = Line::principal(cluster)?;
        let (on_matte, on_highlight) = closest_points(&matte.line, &line)?;
        Some(Self {
            highlight_pixels: cluster.n as usize,
            highlight_rms_counts: rms_from_line(cluster, &line),
            meeting_point: on_matte.into(),
            gap_counts: (on_matte - on_highlight).norm(),
            position_percent: 100.0 * on_matte.dot(&matte.line.direction)
                / planar.matte_length.max(f64::MIN_POSITIVE),
            angle_deg: axis_angle_deg(&matte.line.direction, &line.direction),
        })
    }
}

/// Why the marked pixels have no skewed T; none where they have one. `masks` are those of the working picture.
pub fn no_skewed_t(masks: &Masks, matte: &MatteRegions, planar: &PlanarRegions) -> Option<NoSkewedT> {
    let usable = usable_pixels(masks).len();
    let (Some(matte), Some(planar)) = (matte.hypotheses.first(), planar.hypotheses.first()) else {
        return Some(if usable < LEAST_MARKED_PX { NoSkewedT::TooFew(usable) } else { NoSkewedT::Point });
    };
    match (planar.highlight, matte.highlights.is_empty()) {
        (Some(_), _) => None,
        (None, true) => Some(NoSkewedT::Line),
        (None, false) => {
            let is_parallel = matte.highlights.iter().any(|(_, cluster)| is_parallel(&matte.line, cluster));
            Some(if is_parallel { NoSkewedT::Parallel } else { NoSkewedT::NoMeeting })
        }
    }
}

/// Whether the line of a highlight cluster is too nearly parallel to the matte line for a split.
fn is_parallel(matte: &Line, highlight: &Moments) -> bool {
    Line::principal(highlight)
        .is_some_and(|line| axis_angle_deg(&line.direction, &matte.direction) < MIN_ANGLE_DEG)
}

/// The light: the given one, or the direction of the highlight line.
fn light<R: Recorder>(
    input: &AnalysisInput,
    highlight: Option<&HighlightLine>,
    recorder: &mut R,
) -> (Option<Illuminant>, LightFindings) {
    if let Some(direction) = input.used.illuminant {
        if R::KEEPS {
            recorder.record(IlluminantGiven { direction });
        }
        return (Some(given_light(direction)), LightFindings::given(direction));
    }
    let Some(line) = highlight else { return (None, no_light()) };
    let direction = Vec3::into(line.direction);
    if R::KEEPS {
        let only = AveragedDirection { hypothesis: MARKED, direction, angle_deg: 0.0 };
        recorder.record(HighlightsAveraged { direction, contributions: vec![only] });
    }
    let light = LightFindings { direction: Some(direction), ..no_light() };
    (Some(Illuminant { direction, objects: 1, given: false }), light)
}

/// The findings where the marked pixels have no skewed T.
fn no_light() -> LightFindings {
    LightFindings { basis: LightBasis::ByHand, ..LightFindings::default() }
}

fn given_light(direction: [f64; 3]) -> Illuminant {
    Illuminant { direction, objects: 0, given: true }
}

/// Gives unassigned pixels to the hypothesis, with the record of why.
fn take<R: Recorder>(recorded_labels: &mut RecordedLabels<R>, cluster: MarkedCluster, pixels: &[usize]) {
    if pixels.is_empty() {
        return;
    }
    if R::KEEPS {
        let pixels = pixels.len() as u32;
        recorded_labels.recorder.record(MarkedPixelsTaken { hypothesis: MARKED, cluster, pixels });
    }
    for &pixel in pixels {
        recorded_labels.assign(pixel, Some(MARKED));
    }
}

/// The pixels of the area whose colors are used, row-major.
fn usable_pixels(masks: &Masks) -> Vec<usize> {
    let (width, height) = masks.shape();
    (0..width * height).filter(|&pixel| masks.usable(pixel)).collect()
}
