//! The values that a person watches while the cursor moves.

use super::RegionNames;
use crate::color::{Line, dot, vec3};
use crate::raster::Raster;
use crate::trace::{Class, Pass, PixelKind, Replay, Stage};

/// What stands at the cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct Watch {
    /// Steps taken, and in all.
    pub at: [usize; 2],
    /// The stage, once one has begun.
    pub stage: Option<Stage>,
    /// The part of it.
    pub pass: Option<Pass>,
    /// Regions that stand, and that were begun.
    pub regions: [usize; 2],
    /// Pixels in no region.
    pub unassigned: u32,
    /// The region that the cursor is about.
    pub current: Option<Current>,
    /// Unit direction of the light as estimated so far.
    pub light: Option<[f64; 3]>,
    /// The watched pixel, where one is selected.
    pub pixel: Option<WatchedPixel>,
}

/// The region that the cursor is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Current {
    /// By its number of birth.
    pub region: u16,
    /// What it will be in the result; 0 where nothing is left of it.
    pub final_number: u16,
    /// Its pixels.
    pub pixels: u32,
    /// The axis of its cylinder.
    pub line: Line,
    /// Radius of its cylinder, counts.
    pub radius: f64,
    /// Half the thickness of its slice, counts, once it has one.
    pub half_width: Option<f64>,
}

/// The selected pixel at the cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedPixel {
    /// Its index, row-major.
    pub pixel: u32,
    /// Its color, counts.
    pub color: [f32; 3],
    /// Class of its window, once that is known; none within where it holds too few pixels.
    pub class: Option<Option<Class>>,
    /// The region that holds it, by its number of birth; 0: none.
    pub region: u16,
    /// Its role, once it has one.
    pub kind: PixelKind,
    /// How far it is from the axis and plane of each region that stands, nearest axis first.
    pub distances: Vec<AxisDistance>,
}

/// How far a color is from a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisDistance {
    /// The region, by its number of birth.
    pub region: u16,
    /// Distance from the axis, and the radius, counts.
    pub axis: [f64; 2],
    /// Distance from the plane, and half the slice's thickness, counts; none where it has no plane.
    pub plane: Option<[f64; 2]>,
    /// Where it lies along the axis from black, counts.
    pub along: f64,
}

/// What stands at the cursor, with what is to be told of `pixel`.
pub fn watch(replay: &Replay, names: &RegionNames, colors: &Raster<[f32; 3]>, pixel: Option<u32>) -> Watch {
    let standing = replay.hypotheses().iter().filter(|hypothesis| hypothesis.end().is_none()).count();
    let block = replay.at().checked_sub(1).and_then(|last| replay.trace().block_at(last));
    Watch {
        at: [replay.at(), replay.trace().len()],
        stage: replay.stage(),
        pass: replay.pass(),
        regions: [standing, replay.hypotheses().len()],
        unassigned: replay.size(0),
        current: block.and_then(|block| current(replay, names, block.topic.region())),
        light: replay.light(),
        pixel: pixel.and_then(|pixel| watched(replay, colors, pixel)),
    }
}

fn current(replay: &Replay, names: &RegionNames, region: u16) -> Option<Current> {
    let hypothesis = replay.hypothesis(region)?;
    Some(Current {
        region,
        final_number: names.final_number(region),
        pixels: replay.size(region),
        line: *hypothesis.line()?,
        radius: hypothesis.radius,
        half_width: replay.slice(region).map(|slice| slice.half_width),
    })
}

fn watched(replay: &Replay, colors: &Raster<[f32; 3]>, pixel: u32) -> Option<WatchedPixel> {
    let color = *colors.as_slice().get(pixel as usize)?;
    let region = *replay.labels().as_slice().get(pixel as usize)?;
    let grid = replay.first_grid();
    let class = grid.and_then(|grid| {
        let window = grid.window_of(pixel as usize, colors.width());
        grid.classes.as_slice().get(window).copied().flatten()
    });
    let mut distances: Vec<AxisDistance> = (1..)
        .zip(replay.hypotheses())
        .filter(|(_, hypothesis)| hypothesis.end().is_none())
        .filter_map(|(region, hypothesis)| {
            let line = hypothesis.line()?;
            let slice = replay.slice(region);
            let plane = slice.map(|made| [f64::from(made.slice.distance(color)), made.half_width]);
            let axis = [line.distance(&vec3(color)), hypothesis.radius];
            let along = f64::from(dot(color, crate::color::rgb(&line.direction)));
            Some(AxisDistance { region, axis, plane, along })
        })
        .collect();
    distances.sort_by(|a, b| a.axis[0].total_cmp(&b.axis[0]));
    Some(WatchedPixel { pixel, color, class, region, kind: replay.kind(pixel as usize), distances })
}
