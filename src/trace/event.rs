//! The words in which decisions are recorded.
//!
//! Events are kept by the hundred thousand, so what is rare and large is boxed. Claims, conflicts and labels are kept by the
//! million: they are no events, see [`super::StageTrace`].

use super::{
    Ambient, BranchesSought, Class, LightChosen, LocalDecision, Stage, TwoLightTest, VectorsFitted, VotesCast,
};
use crate::color::{Line, Vec3};
use crate::photo::MaskLimits;
use crate::reflection::{DichromaticPlane, Slice};

/// A decision, and the numbers that it rested on. Regions are numbered from 1 in the order of their birth; the last
/// [`Event::Renumbered`] says which number each has in the result.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// What follows belongs to this stage.
    StageBegan {
        /// The stage.
        stage: Stage,
    },
    /// What follows belongs to this part of the stage.
    PassBegan {
        /// The part.
        pass: Pass,
    },
    /// Which pixels are believed (section 4).
    MasksMade(Box<MasksMade>),
    /// A grid of windows was laid over the picture; the windows that follow are its.
    WindowsLaid(Box<WindowsLaid>),
    /// A window was classified (5.2.1).
    WindowClassified {
        /// Its index, row-major.
        window: u32,
        /// Valid pixels in it.
        pixels: u32,
        /// Variances along the principal axes, counts², largest first.
        eigenvalues: [f32; 3],
        /// The statistic of the test that decided the class, and the χ² quantile that it was held against: the test after
        /// which no direction was left but noise, or the last one.
        chi_square: [f32; 2],
        /// Its class, unless it holds too few valid pixels.
        class: Option<Class>,
    },
    /// Two neighboring areas were tested for union (5.2.2).
    MergeTried {
        /// First window of the area that would remain.
        into: u32,
        /// First window of the area that would vanish.
        from: u32,
        /// Valid pixels of both parts.
        pixels: [u32; 2],
        /// Variances of the union along its principal axes, counts², largest first.
        eigenvalues: [f32; 3],
        /// The statistic of the test that decided the union's class, and the χ² quantile that it was held against: the test after
        /// which no direction was left but noise, or the last one.
        chi_square: [f32; 2],
        /// Class of both.
        class: Class,
        /// Class of the union: they merge if it is the same.
        union: Class,
    },
    /// A merged area started a linear hypothesis (5.3.1).
    HypothesisChosen(Box<HypothesisChosen>),
    /// A merged area did not start a hypothesis, or the one that it started was taken back.
    HypothesisPassedOver {
        /// First window of the area.
        area: u32,
        /// Pixels of the area that no region had claimed.
        pixels: u32,
        /// Fewest that it needs.
        least: u32,
        /// Why.
        reason: PassedOver,
    },
    /// The claims that follow, so many, are where a region starts to grow.
    SeedsPlaced {
        /// The region.
        region: u16,
        /// How many.
        pixels: u32,
    },
    /// A region starts to grow: the claims that follow were reached from a neighbor.
    GrowthBegan {
        /// The region.
        region: u16,
        /// What bounds it, counts: the cylinder's radius (linear), half the slice's thickness (planar), the least
        /// brightness (clipping).
        limit: f32,
    },
    /// A region's line was fitted again to what it had grown into.
    LineRefitted(Box<LineRefitted>),
    /// A linear region turned out to be the broad highlight of its neighbor.
    Absorbed {
        /// The highlight, a region no longer.
        region: u16,
        /// The object that it lies on.
        by: u16,
        /// Distances of both lines from black, counts: the highlight's, the object's.
        feet: [f64; 2],
        /// Distance between the lines, counts.
        gap: f64,
    },
    /// Two regions' lines could not be told apart.
    RegionsMerged {
        /// The region that vanished.
        region: u16,
        /// The region that has its pixels now.
        into: u16,
        /// Angle between their lines, degrees.
        angle_deg: f64,
        /// Root mean square distance of the vanished region's pixels from the other's line, counts.
        rms: f64,
    },
    /// A neighbor was tested as a region's highlight (5.4.1).
    CandidateTested(Box<CandidateTest>),
    /// A region's highlight line was chosen from the candidates that passed.
    CandidateChosen(Box<CandidateChosen>),
    /// The color of the light was estimated (5.4.1).
    IlluminantEstimated(Box<IlluminantEstimated>),
    /// The color of the light was given: none was estimated.
    IlluminantGiven {
        /// Unit direction.
        direction: [f64; 3],
    },
    /// Small highlights voted for a light (refines 5.4.1).
    VotesCast(Box<VotesCast>),
    /// It was decided which light is used (refines 5.4.1).
    LightChosen(Box<LightChosen>),
    /// A region's dichromatic plane became a slice (5.4.2).
    SliceMade(Box<SliceMade>),
    /// A component of unassigned pixels was given to the region around it (5.5).
    HoleFilled {
        /// The region.
        region: u16,
        /// The component's first pixel.
        pixel: u32,
        /// Pixels of the component.
        pixels: u32,
        /// Share of its assigned border that the region holds.
        border_share: f64,
    },
    /// A region was too small to keep.
    Dropped {
        /// The region.
        region: u16,
        /// Its pixels.
        pixels: u32,
    },
    /// A part of a region that lies apart became a region of its own.
    ComponentSplit {
        /// The region.
        region: u16,
        /// The new one.
        part: u16,
        /// Pixels of the part.
        pixels: u32,
    },
    /// The regions got their final numbers.
    Renumbered {
        /// The final number of region `i + 1` at index `i`; 0 for one that is no more.
        finals: Box<[u16]>,
    },
    /// Ambient light was sought where the matte lines meet (7.5).
    AmbientSought(Box<Ambient>),
    /// A region's highlights were held against one another: do they lie on different shades (7.4)?
    BranchesSought(Box<BranchesSought>),
    /// By which vectors a region's pixels are split (section 6).
    VectorsFitted(Box<VectorsFitted>),
    /// A decision of the local split (beyond section 6).
    Local(LocalDecision),
}

/// A part of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// Areas become cylinders that grow (5.3).
    Hypotheses,
    /// Broad highlights go back to their objects (refines 5.3).
    Absorbing,
    /// Unexplained pixels are classified again in windows of this side, pixels (refines 5.3).
    SecondLook(u16),
    /// Contested pixels follow the majority around them (refines 5.3.2).
    Vote,
    /// Regions on one matte line become one (refines 5.3.2).
    Uniting,
    /// Neighbors are tested as highlights (5.4.1).
    Candidates,
    /// The light's color is estimated (5.4.1), for the first time or once more.
    Illuminant,
    /// Planes or votes: which light is used (refines 5.4.1).
    LightChoice,
    /// Labels go back to the matte regions, for slices that turn to another light (refines 5.4).
    Reset,
    /// Slices grow (5.4.2).
    Slices,
    /// Highlights grow into what is brighter than where they start (5.5).
    Brightness,
    /// Clipped components join the region around them (5.5).
    ClippedHoles,
    /// Small components wholly inside a region join it (5.5).
    SmallHoles,
    /// Regions on one matte line that an occluder parts are joined.
    Joining,
    /// Parts of a region that are objects of their own are separated.
    Separating,
    /// Regions that are too small go, the others are numbered.
    Numbering,
    /// What the matte lines tell of ambient light (7.5).
    Ambient,
    /// Body and surface vectors of each region (section 6).
    Vectors,
    /// Where no region holds, pixels are split by their surroundings (beyond section 6).
    LocalSplit,
    /// Clipped blobs there are filled from around them.
    ClipRepair,
    /// Each pixel's role (section 6).
    Labels,
}

impl Pass {
    /// Its name on the timeline and in traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hypotheses => "hypotheses",
            Self::Absorbing => "absorb highlights",
            Self::SecondLook(_) => "second look",
            Self::Vote => "proximity vote",
            Self::Uniting => "unite regions",
            Self::Candidates => "skewed-T tests",
            Self::Illuminant => "illuminant",
            Self::LightChoice => "choice of light",
            Self::Reset => "back to matte",
            Self::Slices => "slices",
            Self::Brightness => "brighter than the start",
            Self::ClippedHoles => "clipped holes",
            Self::SmallHoles => "small holes",
            Self::Joining => "join across",
            Self::Separating => "separate parts",
            Self::Numbering => "number",
            Self::Ambient => "ambient light",
            Self::Vectors => "vectors",
            Self::LocalSplit => "local split",
            Self::ClipRepair => "clip repair",
            Self::Labels => "labels",
        }
    }
}

/// What [`Event::MasksMade`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct MasksMade {
    /// The limits that pixels were held against.
    pub limits: MaskLimits,
    /// Pixels too dark to be analyzed, invalid ones and those outside the area included.
    pub dark: u32,
    /// Other pixels that are clipped or bloomed.
    pub distorted: u32,
    /// Standard deviation of a band's noise that the image told, counts; none where it was not asked or could not be told.
    pub sigma: Option<f64>,
}

/// What [`Event::WindowsLaid`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowsLaid {
    /// Side of a window, pixels.
    pub size_px: u32,
    /// Windows in a row.
    pub columns: u32,
    /// Rows of windows.
    pub rows: u32,
    /// Fewest valid pixels of a window that gets a class.
    pub least_pixels: u32,
    /// Camera noise σ0 that variances are held against, counts.
    pub camera_noise: f64,
    /// Whether by the tail test.
    pub tail_test: bool,
}

impl WindowsLaid {
    /// Index of the window that holds a pixel of a picture `width` pixels wide.
    pub fn window_of(&self, pixel: usize, width: usize) -> usize {
        let size = (self.size_px as usize).max(1);
        let width = width.max(1);
        pixel / width / size * self.columns as usize + pixel % width / size
    }
}

/// What [`Event::HypothesisChosen`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct HypothesisChosen {
    /// The new region.
    pub region: u16,
    /// First window of the area.
    pub area: u32,
    /// How many areas had been looked at before in this pass: 0 for the largest.
    pub rank: u32,
    /// Pixels of the area that no region had claimed.
    pub pixels: u32,
    /// The axis of its cylinder.
    pub line: Line,
    /// Radius of its cylinder, counts.
    pub radius: f64,
}

/// What [`Event::LineRefitted`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct LineRefitted {
    /// The region.
    pub region: u16,
    /// The axis of its cylinder from now on.
    pub line: Line,
}

/// What [`Event::CandidateTested`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateTest {
    /// The region.
    pub region: u16,
    /// The neighbor.
    pub candidate: CandidateSource,
    /// Pixels of the neighbor.
    pub pixels: u32,
    /// The region's matte line.
    pub matte: Line,
    /// Its length from black, counts.
    pub matte_length: f64,
    /// The neighbor's line.
    pub line: Line,
    /// The points of both lines that are nearest to one another: on the matte line, on the neighbor's.
    pub meeting: [Vec3; 2],
    /// Distance between the two lines, counts, and the largest allowed.
    pub gap: [f64; 2],
    /// Where they meet on the matte line, in % of its length.
    pub position_percent: f64,
    /// The lowest and highest such place allowed, in %.
    pub position_limits: [f64; 2],
    /// Which tests it passed.
    pub verdict: CandidateVerdict,
    /// Pixels of it that all candidates which passed are weighed by; 0 if it did not.
    pub weight: f64,
}

/// What [`Event::CandidateChosen`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateChosen {
    /// The region.
    pub region: u16,
    /// The neighbor whose meeting point lies nearest to the mean of all.
    pub candidate: CandidateSource,
    /// Weighted mean of the meeting points, counts.
    pub meeting_point: Vec3,
    /// Unit direction of the highlight line.
    pub direction: Vec3,
}

/// What [`Event::IlluminantEstimated`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct IlluminantEstimated {
    /// Unit direction.
    pub direction: [f64; 3],
    /// Each region that had a say.
    pub contributions: Vec<Contribution>,
    /// Whether all pixels off the matte lines or the highlights alone had it, where both were held against each other.
    pub outshone: Option<TwoLightTest>,
}

/// What one region said about the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// The region.
    pub region: u16,
    /// How far the light lies from where the region puts it, degrees.
    pub residual_deg: f64,
    /// Its weight.
    pub weight: f64,
}

/// What [`Event::SliceMade`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct SliceMade {
    /// The region.
    pub region: u16,
    /// Its dichromatic plane.
    pub plane: DichromaticPlane,
    /// Length of the matte line from black, counts.
    pub matte_length: f64,
    /// Where the highlight line leaves the matte line, counts.
    pub start: Vec3,
    /// Half its thickness, counts.
    pub half_width: f64,
    /// What it holds.
    pub slice: Slice,
}

/// Why an area did not start a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassedOver {
    /// It never had the minimal area.
    TooSmall,
    /// Regions claimed so many of its pixels that too few were left.
    Consumed,
    /// Its line passes farther from black than the cylinder's radius.
    FarFromBlack,
    /// Its colors have no extent to fit a line to.
    NoExtent,
    /// Growing from it claimed too few pixels, which were given back.
    Barren,
    /// There are as many regions as a label map can hold.
    NoNumberLeft,
}

/// Where a highlight candidate came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CandidateSource {
    /// What growing left of a merged area (its first window).
    Leftover(u32),
    /// A neighboring linear region.
    Region(u16),
    /// A region that was absorbed as a broad highlight.
    Absorbed(u16),
}

/// The tests of a highlight candidate, each true when passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(clippy::struct_excessive_bools, reason = "four independent verdicts")]
pub struct CandidateVerdict {
    /// The lines pass near enough to one another to form a skewed T.
    pub lines_meet: bool,
    /// They meet in the upper 50 % of the matte line.
    pub upper_half: bool,
    /// The candidate's direction is positive in every band.
    pub positive: bool,
    /// Its mean lies beyond the meeting point.
    pub beyond: bool,
}

impl CandidateVerdict {
    /// Whether every test was passed.
    pub fn accepted(self) -> bool {
        self.lines_meet && self.upper_half && self.positive && self.beyond
    }
}
