//! The history of one pixel: what was decided about it, by which numbers, and why it was refused where it was.
//!
//! Claims, contests and events are in the trace. What the trace leaves out is computed again, exactly, from the recorded line
//! or plane and the pixel's color: how far it lay from the axis that claimed it, and why a region that grew beside it did
//! not take it. A region's growth visits the 4-neighbors of all it starts from and takes (5.3.2, 5.4.2, 5.5), so that a
//! neighbor which was neither taken nor contested was refused by its mask or by its color.
//!
//! One pass over the trace suffices: the changes of hands of the pixel and of its four neighbors, and the events.

mod builder;
mod facts;
mod growth;
mod local;
mod patch;
mod split;
#[cfg(test)]
mod tests;

pub use split::{LocalFate, LocalStory, SplitStory, Unfit};

use super::{Class, Contest, Event, PassedOver, Stage, Trace};
use crate::color::Trial;
use crate::photo::{LinearImage, Masks};
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::reflection::SliceMiss;

/// Something that was decided about a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct HistoryEntry {
    /// The step of the trace at which it was decided.
    pub step: usize,
    /// The stage of that step.
    pub stage: Stage,
    /// What was decided.
    pub what: HistoryKind,
}

/// What was decided about a pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum HistoryKind {
    /// Its color is believed, or why not (section 4).
    Masked(MaskVerdict),
    /// Its window was classified (5.2.1).
    Window(Box<WindowStory>),
    /// Its window's area was tried with its neighbors (5.2.2).
    Merging(Box<MergeStory>),
    /// Its area started a hypothesis (5.3.1).
    AreaChosen {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Areas looked at before in this pass.
        rank: u32,
        /// Unclaimed pixels of the area.
        pixels: u32,
        /// Radius of the cylinder, counts.
        radius: f64,
    },
    /// Its area did not start a hypothesis while the pixel was in no region.
    AreaPassedOver {
        /// Unclaimed pixels of the area.
        pixels: u32,
        /// Fewest that it needs.
        least: u32,
        /// Why.
        reason: PassedOver,
    },
    /// A region began to grow here.
    Seeded {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// How far inside its cylinder it lies.
        reach: Reach,
    },
    /// A region that grew took it.
    Claimed {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The hypothesis that had it; none: no hypothesis.
        from: Option<HypothesisId>,
        /// How far inside the region's reach it lies.
        reach: Reach,
        /// The contest with the region that had it.
        contest: Option<Contest>,
    },
    /// A region that grew wanted it, and the one that had it kept it.
    Kept {
        /// The hypothesis that had it.
        holder: HypothesisId,
        /// The hypothesis that wanted it.
        challenger: HypothesisId,
        /// By what it was decided.
        contest: Contest,
    },
    /// A region grew beside it and did not want it.
    Refused {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// What kept it out.
        barrier: Barrier,
    },
    /// Regions grew beside it, which by its mask was not there to be claimed.
    Unclaimable {
        /// The hypotheses, in the order of their growth.
        hypotheses: Vec<HypothesisId>,
    },
    /// Its region gave it up.
    Released {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Why.
        why: Release,
    },
    /// Its region became part of another one.
    Merged {
        /// The hypothesis that vanished.
        from: HypothesisId,
        /// The hypothesis that has the pixel now.
        into: HypothesisId,
        /// Angle between their lines, degrees.
        angle_deg: f64,
        /// Root mean square distance of the vanished region's pixels from the other's line, counts.
        rms: f64,
    },
    /// It followed the majority around it.
    Voted {
        /// The hypothesis that had it.
        from: HypothesisId,
        /// The hypothesis that has it now.
        hypothesis: HypothesisId,
        /// Pixels of that region around it, and of all regions.
        votes: [u32; 2],
    },
    /// It went back to whose it was before the slices grew, for slices that turn to another light.
    Reset {
        /// The hypothesis that had it.
        from: HypothesisId,
        /// The hypothesis that has it again; none: no hypothesis.
        to: Option<HypothesisId>,
    },
    /// A hole around it was given to a region.
    Filled {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Pixels of the hole.
        pixels: u32,
        /// Share of the hole's assigned border that the region holds.
        border_share: f64,
    },
    /// The part of its region around it became a region of its own.
    Separated {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The new one.
        part: HypothesisId,
        /// Pixels of the part.
        pixels: u32,
    },
    /// Its region got its final number.
    Numbered {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The region that the hypothesis became; none: the hypothesis is in no region.
        region: Option<RegionId>,
    },
    /// It was told matte from highlight, and split (section 6).
    Split(Box<SplitStory>),
    /// No region explains it: what it was judged by instead.
    Surroundings(Box<LocalStory>),
    /// A decision about more than this pixel that it hangs on, where no region explains it: which light is used, whether there
    /// are highlights to be believed, whether its blob is one.
    Decided(Box<Event>),
}

/// Whether a color is believed (section 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaskVerdict {
    /// Neither dark nor distorted.
    Believed {
        /// Distance from black, counts, and that below which a pixel is dark.
        brightness: [f64; 2],
        /// The largest band, counts, and that from which a pixel is clipped.
        largest: [f64; 2],
    },
    /// It lies outside the area that the analysis is restricted to.
    Outside,
    /// The file holds no usable value.
    Invalid,
    /// It is too near to black.
    Dark {
        /// Distance from black, counts, and that below which a pixel is dark.
        brightness: [f64; 2],
    },
    /// A band is clipped.
    Clipped {
        /// The largest band, counts, and that from which a pixel is clipped.
        largest: [f64; 2],
    },
    /// Too many of its 8 neighbors are clipped.
    Bloomed {
        /// Clipped neighbors, and so many make a pixel bloomed.
        neighbors: [usize; 2],
    },
}

/// How its window was classified.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowStory {
    /// Side of the windows, pixels.
    pub size_px: u32,
    /// Valid pixels in it, and the fewest that get a class.
    pub pixels: [u32; 2],
    /// Variances along the principal axes, counts², largest first.
    pub eigenvalues: [f32; 3],
    /// The χ² tests made, in order; none where there is no class.
    pub trials: Vec<Trial>,
    /// Whether they were tail tests, or the paper's.
    pub tail_test: bool,
    /// Its class, unless it holds too few valid pixels.
    pub class: Option<Class>,
}

/// How its window's area grew.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeStory {
    /// Unions tried with the area, and those that were kept.
    pub tried: u32,
    /// Those that were kept.
    pub joined: u32,
    /// Valid pixels of the area after the last union kept.
    pub pixels: u32,
    /// The last union refused.
    pub refusal: Option<MergeRefusal>,
    /// Class of the area.
    pub class: Class,
}

/// A union that was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MergeRefusal {
    /// The step at which it was.
    pub step: usize,
    /// Valid pixels of the neighbor.
    pub neighbor_pixels: u32,
    /// What the union would have been.
    pub union: Class,
    /// The χ² test that showed one direction too many.
    pub trial: Option<Trial>,
}

/// How far inside a region's reach a pixel lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Of a cylinder (5.3.2).
    Axis {
        /// Distance from its axis, counts.
        distance: f32,
        /// Its radius, counts.
        radius: f64,
    },
    /// Of a slice (5.4.2).
    Plane {
        /// Distance from the dichromatic plane, counts.
        distance: f32,
        /// Half the slice's thickness, counts.
        half_width: f64,
    },
    /// Of a highlight that grows by brightness (5.5).
    Brightness {
        /// Distance from black, counts.
        brightness: f32,
        /// That of the point where the highlight starts, counts.
        start: f32,
    },
}

/// What kept a pixel out of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Barrier {
    /// It lies outside the cylinder.
    Cylinder {
        /// Distance from the axis, counts.
        distance: f32,
        /// The radius, counts.
        radius: f64,
    },
    /// It lies outside the slice.
    Slice(SliceMiss),
    /// It is no brighter than where the highlight starts.
    Darker {
        /// Distance from black, counts.
        brightness: f32,
        /// That of the point where the highlight starts, counts.
        start: f32,
    },
}

/// Why a region gave a pixel up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Release {
    /// The line was fitted again, and the pixel lies outside the new cylinder.
    Refit {
        /// Distance from the new axis, counts.
        distance: f32,
        /// The radius, counts.
        radius: f64,
    },
    /// The region claimed too few pixels.
    Barren {
        /// Pixels of the area that it started from.
        pixels: u32,
        /// Fewest that it had to claim.
        least: u32,
    },
    /// The region turned out to be the broad highlight of another one.
    Absorbed {
        /// The object that it lies on.
        by: HypothesisId,
        /// Distance of the highlight's line from black, counts.
        highlight_foot: f64,
        /// Distance of the object's line from black, counts.
        object_foot: f64,
        /// Distance between the lines, counts.
        gap: f64,
    },
    /// The region was too small to keep.
    Dropped {
        /// Its pixels.
        pixels: u32,
    },
}

/// Everything that was decided about a pixel, oldest first. Nothing for a pixel outside the picture, or a trace of another
/// picture.
///
/// `image` and `masks` are those that the trace was made from.
pub fn pixel_history(
    trace: &Trace,
    image: &LinearImage,
    masks: &Masks,
    pixel: PixelIndex,
) -> Vec<HistoryEntry> {
    let shape = (trace.width(), trace.height());
    if shape != (image.width(), image.height())
        || shape != masks.shape()
        || pixel.index() >= image.pixels.len()
    {
        return Vec::new();
    }
    builder::HistoryBuilder::new(trace, image, masks, pixel.index()).tell()
}
