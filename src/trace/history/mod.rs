//! The history of one pixel: the decisions about the pixel, the numbers that decided, and why hypotheses refused the pixel.
//!
//! Claims, contests and events are in the trace. Other decisions are computed again, exactly, from the recorded line or plane and
//! the color of the pixel: the distance from the axis of the hypothesis that claimed the pixel, and why a hypothesis that grew next
//! to the pixel did not take the pixel. A growth visits the 4-neighbors of all pixels that it starts from and takes (5.3.2, 5.4.2,
//! 5.5), so that a neighbor which was neither taken nor contested was refused by its mask or by its color.
//!
//! The history takes one pass over the trace: the changes of owner of the pixel and of its four neighbors, and the events.

mod builder;
mod facts;
mod growth;
mod local;
mod patch;
mod split;
#[cfg(test)]
mod tests;

pub use split::{BorderLimit, LocalFate, LocalStory, SplitStory, Unfit};

use super::{Class, CodeInterval, Contest, Event, MarkedCluster, Measured, PassedOver, Stage, Trace};
use crate::color::Trial;
use crate::photo::{LinearImage, Masks};
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::reflection::SliceMiss;

/// A decision about a pixel.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HistoryEntry {
    /// The step of the trace at which it was decided.
    pub step: usize,
    /// The stage of that step.
    pub stage: Stage,
    /// The decision.
    pub what: HistoryKind,
}

/// A decision about a pixel: its kind and numbers.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum HistoryKind {
    /// The verdict of the masks (section 4).
    Masked(MaskVerdict),
    /// The window of the pixel was classified (5.2.1).
    Window(Box<WindowStory>),
    /// Unions of the area of the pixel with its neighbors were tried (5.2.2).
    Merging(Box<MergeStory>),
    /// The area of the pixel started a hypothesis (5.3.1).
    AreaChosen {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Number of areas taken before in this pass.
        rank: u32,
        /// Unclaimed pixels of the area.
        pixels: u32,
        /// Radius of the cylinder, counts.
        radius: f64,
    },
    /// The area of the pixel did not start a hypothesis, while the pixel was in no hypothesis.
    AreaPassedOver {
        /// Unclaimed pixels of the area.
        pixels: u32,
        /// Fewest that it needs.
        least: u32,
        /// Why.
        reason: PassedOver,
    },
    /// A hypothesis began to grow from the pixel.
    Seeded {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Place of the color in the cylinder.
        reach: Reach,
    },
    /// A hypothesis that grew took the pixel.
    Claimed {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The hypothesis that had it; none: no hypothesis.
        from: Option<HypothesisId>,
        /// Place of the color among the accepted colors.
        reach: Reach,
        /// The contest with the hypothesis that had the pixel.
        contest: Option<Contest>,
    },
    /// A hypothesis that grew wanted the pixel, and the hypothesis that had the pixel kept it.
    Kept {
        /// The hypothesis that had it.
        holder: HypothesisId,
        /// The hypothesis that wanted it.
        challenger: HypothesisId,
        /// The contest.
        contest: Contest,
    },
    /// A hypothesis grew next to the pixel and refused the pixel.
    Refused {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The bound that the color lies outside of.
        barrier: Barrier,
    },
    /// Hypotheses grew next to the pixel, which could not be claimed because of its mask.
    Unclaimable {
        /// The hypotheses, in the order of their growth.
        hypotheses: Vec<HypothesisId>,
    },
    /// The hypothesis that had the pixel gave the pixel up.
    Released {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Why.
        why: Release,
    },
    /// The hypothesis that had the pixel became part of another one.
    Merged {
        /// The hypothesis that vanished.
        from: HypothesisId,
        /// The hypothesis that has the pixel now.
        into: HypothesisId,
        /// Angle between their lines, degrees.
        angle_deg: f64,
        /// Root mean square distance of the pixels of the vanished hypothesis from the line of the other, counts.
        rms: f64,
    },
    /// The pixel went to the majority around it.
    Voted {
        /// The hypothesis that had it.
        from: HypothesisId,
        /// The hypothesis that has it now.
        hypothesis: HypothesisId,
        /// Number of pixels of that hypothesis around the pixel, and of all hypotheses.
        votes: [u32; 2],
    },
    /// The owner of the pixel was reset to the owner before the slices grew, for slices under another light.
    Reset {
        /// The hypothesis that had it.
        from: HypothesisId,
        /// The hypothesis that has it again; none: no hypothesis.
        to: Option<HypothesisId>,
    },
    /// A hole around the pixel was given to a hypothesis.
    Filled {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Pixels of the hole.
        pixels: u32,
        /// Share of the hole's assigned border that the region holds.
        border_share: f64,
    },
    /// The part of the hypothesis around the pixel became a hypothesis of its own.
    Separated {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The new hypothesis.
        part: HypothesisId,
        /// Pixels of the part.
        pixels: u32,
    },
    /// An earlier method put the pixel into a region, which may be a part of another region (5.1, 7.2).
    Patched {
        /// The region.
        hypothesis: HypothesisId,
        /// The region that it is a part of; none: of the picture.
        of: Option<HypothesisId>,
        /// Number of pixels of the region.
        pixels: u32,
        /// The feature that decided, with its codes in the region; none where no feature decided.
        interval: Option<CodeInterval>,
        /// The pixel's code of that feature; 0 where no feature decided. A code outside the interval belongs to a small patch that was
        /// absorbed.
        code: u8,
    },
    /// A person has marked the pixel, and the hypothesis of the marked pixels took it (section 6).
    Marked {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// Which of the marked pixels it is.
        cluster: MarkedCluster,
        /// Distance from the matte line, counts.
        distance: f64,
    },
    /// The hypothesis that has the pixel became a region of the result, or none.
    Numbered {
        /// The hypothesis.
        hypothesis: HypothesisId,
        /// The region that the hypothesis became; none: the hypothesis is in no region.
        region: Option<RegionId>,
    },
    /// The pixel was classed as matte or highlight, and split (section 6).
    Split(Box<SplitStory>),
    /// The figures by which a pixel that no region explains was judged.
    Surroundings(Box<LocalStory>),
    /// A decision about more than this pixel that a pixel which no region explains depends on: the light, the plausibility of the
    /// highlights, the judgment of its blob.
    Decided(Box<Event>),
}

/// The verdict of the masks on a color (section 4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MaskVerdict {
    /// Neither dark nor distorted.
    Believed {
        /// Distance from black, counts, and that below which a pixel is dark.
        brightness: [f64; 2],
        /// The largest band, counts, and that from which a pixel is clipped.
        largest: [f64; 2],
    },
    /// The pixel lies outside the area that the analysis is restricted to.
    Outside,
    /// The file holds no usable value.
    Invalid,
    /// The pixel is that of a clipped object or of its edge (refinement `clipped_objects`).
    ClippedObject {
        /// Number of clipped pixels of the object.
        clipped: u32,
        /// The share of surface reflection that would be left one pixel farther out, and the share below which the edge is abrupt.
        left: Measured<f64>,
    },
    /// The color is too near to black.
    Dark {
        /// Distance from black, counts, and that below which a pixel is dark.
        brightness: [f64; 2],
    },
    /// A band is clipped.
    Clipped {
        /// The largest band, counts, and that from which a pixel is clipped.
        largest: [f64; 2],
    },
    /// Too many of the 8 neighbors are clipped.
    Bloomed {
        /// Number of clipped neighbors, and the least number of a bloomed pixel.
        neighbors: [usize; 2],
    },
}

/// How the window of the pixel was classified.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WindowStory {
    /// Side of the windows, pixels.
    pub size_px: u32,
    /// Number of valid pixels in the window, and the least number for a class.
    pub pixels: [u32; 2],
    /// Variances along the principal axes, counts², largest first.
    pub eigenvalues: [f32; 3],
    /// The χ² tests made, in order; none where there is no class.
    pub trials: Vec<Trial>,
    /// Whether the tests were tail tests, or those of the paper.
    pub tail_test: bool,
    /// The class of the window; none where the window holds too few valid pixels.
    pub class: Option<Class>,
}

/// How the area of the pixel grew.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MergeStory {
    /// Number of unions that were tried with the area.
    pub tried: u32,
    /// Number of unions that were kept.
    pub joined: u32,
    /// Number of valid pixels of the area after the last union that was kept.
    pub pixels: u32,
    /// The last union that was refused.
    pub refusal: Option<MergeRefusal>,
    /// Class of the area.
    pub class: Class,
}

/// A union that was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MergeRefusal {
    /// The step.
    pub step: usize,
    /// Valid pixels of the neighbor.
    pub neighbor_pixels: u32,
    /// The class of the union.
    pub union: Class,
    /// The χ² test that showed a direction too many.
    pub trial: Option<Trial>,
}

/// The place of a color among the colors that a growing hypothesis accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Of a cylinder (5.3.2).
    Axis {
        /// Distance from the axis, counts.
        distance: f32,
        /// Radius of the cylinder, counts.
        radius: f64,
    },
    /// Of a slice (5.4.2).
    Plane {
        /// Distance from the dichromatic plane, counts.
        distance: f32,
        /// Half the thickness of the slice, counts.
        half_width: f64,
    },
    /// Of growth by brightness (5.5).
    Brightness {
        /// Distance from black, counts.
        brightness: f32,
        /// Distance from black of the point where the highlight starts, counts.
        start: f32,
    },
}

/// The bound that a refused color lies outside of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Barrier {
    /// The color lies outside the cylinder.
    Cylinder {
        /// Distance from the axis, counts.
        distance: f32,
        /// The radius, counts.
        radius: f64,
    },
    /// The color lies outside the slice.
    Slice(SliceMiss),
    /// A band of the color clips, and the other bands are not those of body and surface reflection of the region.
    OtherBands {
        /// Distance from the nearest color that body and surface reflection can have, counts.
        distance: f32,
        /// The largest distance, counts.
        limit: f32,
    },
    /// The color is no brighter than the point where the highlight starts.
    Darker {
        /// Distance from black, counts.
        brightness: f32,
        /// Distance from black of the point where the highlight starts, counts.
        start: f32,
    },
}

/// Why a hypothesis gave a pixel up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Release {
    /// The line was fitted again, and the pixel lies outside the new cylinder.
    Refit {
        /// Distance from the new axis, counts.
        distance: f32,
        /// The radius, counts.
        radius: f64,
    },
    /// The hypothesis claimed too few pixels.
    Barren {
        /// Number of pixels of the area that the hypothesis started from.
        pixels: u32,
        /// Fewest pixels that the hypothesis had to claim.
        least: u32,
    },
    /// The hypothesis was the broad highlight of another one.
    Absorbed {
        /// The object that the highlight lies on.
        by: HypothesisId,
        /// Distance of the highlight's line from black, counts.
        highlight_foot: f64,
        /// Distance of the object's line from black, counts.
        object_foot: f64,
        /// Distance between the lines, counts.
        gap: f64,
    },
    /// The hypothesis was too small to keep.
    Dropped {
        /// Its pixels.
        pixels: u32,
    },
}

/// All decisions about a pixel, oldest first. Empty for a pixel outside the picture, and for a trace of another picture.
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
    builder::HistoryBuilder::new(trace, image, masks, pixel.index()).entries()
}
