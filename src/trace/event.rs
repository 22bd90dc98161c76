//! The words in which decisions are recorded.

/// The stages in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Dark, clipped and bloomed pixels; the parameters left to the image.
    Masks,
    /// Section 5.2.1.
    Classify,
    /// Section 5.2.2.
    Merge,
    /// Section 5.3.
    Linear,
    /// Section 5.4.
    Planar,
    /// Section 5.5.
    Clipping,
    /// Section 6.
    Split,
}

impl Stage {
    /// All of them, first to last.
    pub const ALL: [Self; 7] =
        [Self::Masks, Self::Classify, Self::Merge, Self::Linear, Self::Planar, Self::Clipping, Self::Split];

    /// Its name in reports and traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Masks => "masks",
            Self::Classify => "classify",
            Self::Merge => "merge",
            Self::Linear => "linear",
            Self::Planar => "planar",
            Self::Clipping => "clipping",
            Self::Split => "split",
        }
    }
}

/// Class of a colour cluster by its number of significant eigenvalues (section 5.2.1, table 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// None: no variation beyond the noise.
    Point,
    /// One: matte or highlight line.
    Line,
    /// Two: a dichromatic plane, or two objects.
    Plane,
    /// Three: clipping, or several objects.
    Volume,
}

impl Class {
    /// Its name in tables and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line => "line",
            Self::Plane => "plane",
            Self::Volume => "volume",
        }
    }
}

/// What a pixel is to its region (section 6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelKind {
    /// In no region.
    #[default]
    Unassigned,
    /// Nearer to the matte line.
    Matte,
    /// Nearer to the highlight line.
    Highlight,
    /// Clipped or bloomed, its colour restored from the bands that can be believed.
    Restored,
    /// Clipped in every band: nothing to restore it from but its surroundings.
    Lost,
}

impl PixelKind {
    /// Its name in tables and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unassigned => "unassigned",
            Self::Matte => "matte",
            Self::Highlight => "highlight",
            Self::Restored => "restored",
            Self::Lost => "lost",
        }
    }
}

/// Three numbers of a colour or direction, as recorded.
pub type Triple = [f64; 3];

/// A decision, and the numbers that it rested on. Regions are numbered from 1 in the order of their birth; the last
/// [`Event::Renumbered`] says which number each has in the result.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// What follows belongs to this stage.
    StageBegan {
        /// The stage.
        stage: Stage,
    },
    /// A window was classified (5.2.1).
    WindowClassified {
        /// Its index, row-major.
        window: u32,
        /// Valid pixels in it.
        pixels: u32,
        /// Variances along the principal axes, counts², largest first.
        eigenvalues: Triple,
        /// Its class, unless it holds too few valid pixels.
        class: Option<Class>,
    },
    /// Two neighbouring areas were tested for union (5.2.2).
    MergeTried {
        /// First window of the area that would remain.
        into: u32,
        /// First window of the area that would vanish.
        from: u32,
        /// Class of both.
        class: Class,
        /// Class of the union: they merge if it is the same.
        union: Class,
    },
    /// A merged area started a linear hypothesis (5.3.1).
    HypothesisChosen {
        /// The new region.
        region: u16,
        /// First window of the area.
        area: u32,
        /// Pixels of the area that no region had claimed.
        pixels: u32,
        /// A point of its axis, counts.
        mean: Triple,
        /// Unit direction of its axis.
        direction: Triple,
        /// Radius of its cylinder, counts.
        radius: f64,
    },
    /// A merged area did not start a hypothesis.
    HypothesisPassedOver {
        /// First window of the area.
        area: u32,
        /// Pixels of the area that no region had claimed.
        pixels: u32,
        /// Why.
        reason: PassedOver,
    },
    /// A region's line was fitted again to what it had grown into.
    LineRefitted {
        /// The region.
        region: u16,
        /// A point of its axis, counts.
        mean: Triple,
        /// Unit direction of its axis.
        direction: Triple,
    },
    /// Growth of a region started from a pixel.
    Seeded {
        /// The region.
        region: u16,
        /// The pixel, `y · width + x`.
        pixel: u32,
    },
    /// Two regions wanted a pixel (the proximity heuristic).
    Conflict {
        /// The pixel.
        pixel: u32,
        /// Region that held it.
        holder: u16,
        /// Region that wanted it.
        challenger: u16,
        /// Distance from the holder's axis or plane, counts.
        holder_distance: f64,
        /// Distance from the challenger's, counts.
        challenger_distance: f64,
        /// Whether it changed hands.
        taken: bool,
    },
    /// A linear region turned out to be the broad highlight of its neighbour.
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
    /// A neighbour was tested as a region's highlight (5.4.1).
    CandidateTested {
        /// The region.
        region: u16,
        /// The neighbour.
        candidate: CandidateSource,
        /// Pixels of the neighbour.
        pixels: u32,
        /// Distance between the two lines, counts, and the largest allowed.
        gap: [f64; 2],
        /// Where they meet on the matte line, in % of its length.
        position_percent: f64,
        /// Unit direction of the neighbour's line.
        direction: Triple,
        /// Which tests it passed.
        verdict: CandidateVerdict,
    },
    /// A region's highlight line was chosen from the candidates that passed.
    CandidateChosen {
        /// The region.
        region: u16,
        /// The neighbour whose meeting point lies nearest to the mean of all.
        candidate: CandidateSource,
        /// Weighted mean of the meeting points, counts.
        meeting_point: Triple,
    },
    /// The colour of the light was estimated (5.4.1).
    IlluminantEstimated {
        /// Unit direction.
        direction: Triple,
        /// Each region that had a say, with its residual in degrees and its weight.
        contributions: Vec<(u16, f64, f64)>,
    },
    /// The colour of the light was given: none was estimated.
    IlluminantGiven {
        /// Unit direction.
        direction: Triple,
    },
    /// A region's dichromatic plane became a slice (5.4.2).
    SliceMade {
        /// The region.
        region: u16,
        /// Unit normal of the plane.
        normal: Triple,
        /// Where the highlight line leaves the matte line, counts.
        start: Triple,
        /// Half its thickness, counts.
        half_width: f64,
    },
    /// A component of unassigned pixels was given to the region around it (5.5).
    HoleFilled {
        /// The region.
        region: u16,
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
        finals: Vec<u16>,
    },
}

/// Why an area did not start a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassedOver {
    /// Fewer unclaimed pixels than the minimal area.
    TooSmall,
    /// Its line passes farther from black than the cylinder's radius.
    FarFromBlack,
    /// Its colours have no extent to fit a line to.
    NoExtent,
    /// Growing from it claimed too few pixels.
    Barren,
}

/// Where a highlight candidate came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CandidateSource {
    /// What growing left of a merged area (its first window).
    Leftover(u32),
    /// A neighbouring linear region.
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
