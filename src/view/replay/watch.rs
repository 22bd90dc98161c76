//! The values of the watch list, at the cursor.

use super::RegionNames;
use crate::color::{Line, dot, vec3};
use crate::raster::{HypothesisId, PixelIndex, Raster, RegionId};
use crate::trace::{Class, Pass, PixelKind, Replay, Stage};

/// The values at the cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct Watch {
    /// Number of steps taken, and number of all steps.
    pub at: [usize; 2],
    /// The stage, once one has begun.
    pub stage: Option<Stage>,
    /// The pass, once one has begun.
    pub pass: Option<Pass>,
    /// Number of hypotheses that stand, and number of all hypotheses so far.
    pub regions: [usize; 2],
    /// Number of pixels in no hypothesis.
    pub unassigned: u32,
    /// The hypothesis that the cursor is about.
    pub current: Option<CurrentHypothesis>,
    /// Unit direction of the light as estimated so far.
    pub light: Option<[f64; 3]>,
    /// The watched pixel, where one is selected.
    pub pixel: Option<WatchedPixel>,
}

/// The hypothesis that the cursor is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentHypothesis {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The region that the hypothesis will be part of in the result; none where nothing is left of the hypothesis.
    pub region: Option<RegionId>,
    /// Number of its pixels.
    pub pixels: u32,
    /// The axis of the cylinder.
    pub line: Line,
    /// Radius of the cylinder, counts.
    pub radius: f64,
    /// Half the thickness of the slice, counts; none as long as there is no slice.
    pub half_width: Option<f64>,
}

/// The selected pixel at the cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedPixel {
    /// The pixel of the photograph.
    pub pixel: PixelIndex,
    /// Color of the pixel, counts.
    pub color: [f32; 3],
    /// Class of the pixel's window; none as long as the window was not classified, `Some(None)` where the window
    /// holds too few pixels.
    pub class: Option<Option<Class>>,
    /// The hypothesis that holds the pixel; none: no hypothesis.
    pub hypothesis: Option<HypothesisId>,
    /// Kind of the pixel; unassigned as long as the kind is not decided.
    pub kind: PixelKind,
    /// Distances of the color from axis and plane of each hypothesis that stands, nearest axis first.
    pub distances: Vec<AxisDistance>,
}

/// The distances of a color from the axis and the plane of a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisDistance {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Distance from the axis, and the radius, counts.
    pub axis: [f64; 2],
    /// Distance from the plane, and half the thickness of the slice, counts; none without a slice.
    pub plane: Option<[f64; 2]>,
    /// Place along the axis from black, counts.
    pub along: f64,
}

/// The values at the cursor, with those of `pixel` of the photograph. `colors`: those of the working picture, counts.
pub fn watch(
    replay: &Replay,
    names: &RegionNames,
    colors: &Raster<[f32; 3]>,
    pixel: Option<PixelIndex>,
) -> Watch {
    let active = replay.hypotheses().iter().filter(|hypothesis| hypothesis.end().is_none()).count();
    let block = replay.at().checked_sub(1).and_then(|last| replay.trace().block_at(last));
    Watch {
        at: [replay.at(), replay.trace().len()],
        stage: replay.stage(),
        pass: replay.pass(),
        regions: [active, replay.hypotheses().len()],
        unassigned: replay.unassigned(),
        current: block.and_then(|block| current_hypothesis(replay, names, block.topic.hypothesis())),
        light: replay.light(),
        pixel: pixel.and_then(|pixel| watched_pixel(replay, colors, pixel)),
    }
}

fn current_hypothesis(replay: &Replay, names: &RegionNames, id: HypothesisId) -> Option<CurrentHypothesis> {
    let hypothesis = replay.hypothesis(id)?;
    Some(CurrentHypothesis {
        hypothesis: id,
        region: names.region_of(id),
        pixels: replay.size(id),
        line: *hypothesis.line()?,
        radius: hypothesis.radius,
        half_width: replay.slice(id).map(|slice| slice.half_width),
    })
}

fn watched_pixel(replay: &Replay, colors: &Raster<[f32; 3]>, pixel: PixelIndex) -> Option<WatchedPixel> {
    let [width, height] = replay.trace().pixel_blocks().picture();
    let working_pixel = replay.trace().working_pixel(pixel);
    let color = *colors.as_slice().get(working_pixel.index()).filter(|_| pixel.index() < width * height)?;
    let hypothesis = HypothesisId::from_label(*replay.labels().as_slice().get(working_pixel.index())?);
    let grid = replay.first_grid();
    let class = grid.and_then(|grid| {
        let window = grid.window_of(working_pixel.index(), colors.width());
        grid.classes.as_slice().get(window).copied().flatten()
    });
    let mut distances: Vec<AxisDistance> = replay
        .numbered_hypotheses()
        .filter(|(_, hypothesis)| hypothesis.end().is_none())
        .filter_map(|(id, hypothesis)| {
            let line = hypothesis.line()?;
            let slice = replay.slice(id);
            let plane = slice.map(|made| [f64::from(made.slice.distance(color)), made.half_width]);
            let axis = [line.distance(&vec3(color)), hypothesis.radius];
            let along = f64::from(dot(color, crate::color::rgb(&line.direction)));
            Some(AxisDistance { hypothesis: id, axis, plane, along })
        })
        .collect();
    distances.sort_by(|a, b| a.axis[0].total_cmp(&b.axis[0]));
    Some(WatchedPixel {
        pixel,
        color,
        class,
        hypothesis,
        kind: replay.kind(working_pixel.index()),
        distances,
    })
}
