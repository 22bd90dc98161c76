//! The events of a trace: every decision that is recorded, by section of the paper.
//!
//! One table makes [`Event`], [`Kind`], the list of all kinds, their names, and the dispatch to an event's
//! structure. To add an event: write its structure with [`EventData`] in the file of its section, add a row to the
//! table, record the event in the stage, and write its sentence in `describe/events`. The compiler names each place
//! that is missing.
//!
//! Events are kept by the hundred thousand: large and rare ones are boxed. Claims, conflicts and labels are kept by the million
//! and are no events, see [`super::StageTrace`].

mod ambient;
mod baseline;
mod borders;
mod branches;
mod by_hand;
mod candidates;
mod clipping;
mod light;
mod linear;
mod local;
mod masks;
mod passes;
mod planar;
mod vectors;
mod windows;

pub use ambient::*;
pub use baseline::*;
pub use borders::*;
pub use branches::*;
pub use by_hand::*;
pub use candidates::*;
pub use clipping::*;
pub use light::*;
pub use linear::*;
pub use local::*;
pub use masks::*;
pub use passes::*;
pub use planar::*;
pub use vectors::*;
pub use windows::*;

use crate::raster::{HypothesisId, RegionId};

/// What an event is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Subject {
    /// A hypothesis.
    Hypothesis(HypothesisId),
    /// A region of the result.
    Region(RegionId),
    /// A candidate highlight or a clipped blob of the local split, by its number from 1.
    Blob(u16),
}

/// Properties of every event. An event writes those that differ from the default: it is about nothing, and holds nothing on the heap.
pub(crate) trait EventData {
    /// The hypotheses, regions and blobs that the event is about.
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    /// Bytes that the structure holds on the heap, its own size not included.
    fn heap_bytes(&self) -> usize {
        0
    }
}

impl<T: EventData> EventData for Box<T> {
    fn subjects(&self) -> [Option<Subject>; 2] {
        T::subjects(self)
    }

    fn heap_bytes(&self) -> usize {
        size_of::<T>() + T::heap_bytes(self)
    }
}

/// The type that an event is kept as: `boxed T` is `Box<T>`.
macro_rules! kept {
    (boxed $data:ty) => { Box<$data> };
    (inline $data:ty) => { $data };
}

/// A structure as it is kept.
macro_rules! keep {
    (boxed $data:expr) => {
        Box::new($data)
    };
    (inline $data:expr) => {
        $data
    };
}

/// Makes [`Event`], [`Kind`] and the dispatch over all events from the table. `$d` is a dollar sign for the macro that is made.
macro_rules! events {
    ($d:tt $($(#[$kind_doc:meta])+ $kind:ident $name:literal { $($place:ident $event:ident($data:ident)),* })*) => {
        /// A decision with the numbers that decided. The last [`Renumbered`] says which hypothesis became which region.
        #[derive(Clone, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Event {
            $($(
                #[doc = concat!("See [`", stringify!($data), "`].")]
                $event(kept!($place $data)),
            )*)*
        }

        /// A kind of step.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Kind {
            $($(#[$kind_doc])+ $kind,)*
        }

        impl Kind {
            /// All kinds, in the order of the table.
            pub const ALL: [Self; [$(Self::$kind),*].len()] = [$(Self::$kind),*];

            /// Name of the kind in traces and menus.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)*
                }
            }
        }

        impl Event {
            /// The kind of the event.
            pub fn kind(&self) -> Kind {
                match self {
                    $($(Self::$event(_) => Kind::$kind,)*)*
                }
            }

            fn data(&self) -> &dyn EventData {
                match self {
                    $($(Self::$event(data) => data,)*)*
                }
            }
        }

        $($(
            impl From<$data> for Event {
                fn from(data: $data) -> Self {
                    Self::$event(keep!($place data))
                }
            }
        )*)*

        /// Evaluates an expression with the structure of an event, whichever it is: `dispatch_event!(event, data => expression)`.
        macro_rules! dispatch_event {
            ($d event:expr, $d data:ident => $d body:expr) => {
                match $d event {
                    $($($crate::trace::Event::$event($d data) => $d body,)*)*
                }
            };
        }

        /// Calls a macro with the structures of all events, in the order of the table: `all_events!(callback)`.
        #[cfg(test)]
        macro_rules! all_events {
            ($d callback:ident) => {
                $d callback!($($($crate::trace::$data,)*)*)
            };
        }
    };
}

events! { $
    /// A stage begins.
    Stage "stage" { inline StageBegan(StageBegan) }
    /// A pass of a stage begins.
    Pass "pass" { inline PassBegan(PassBegan) }
    /// The masks were made (section 4).
    Masks "masks" { boxed MasksMade(MasksMade) }
    /// A clipped area was judged by its edge (section 4).
    ClippedArea "clipped area" { boxed ClippedAreaJudged(ClippedAreaJudged) }
    /// A grid of windows was laid (section 5.2).
    Windows "windows" { boxed WindowsLaid(WindowsLaid) }
    /// A window was classified (section 5.2.1).
    Window "window" { inline WindowClassified(WindowClassified) }
    /// A merge of two areas was tried (section 5.2.2).
    Merge "merge" { inline MergeTried(MergeTried) }
    /// A hypothesis was chosen (section 5.3.1).
    Hypothesis "hypothesis" { boxed HypothesisChosen(HypothesisChosen) }
    /// An area was passed over (section 5.3.1).
    PassedOver "passed over" { inline HypothesisPassedOver(HypothesisPassedOver) }
    /// Seeds of a growth were placed (section 5.3.2).
    Seeds "seeds" { inline SeedsPlaced(SeedsPlaced) }
    /// A growth begins.
    Growth "growth" { inline GrowthBegan(GrowthBegan) }
    /// A line was fitted again (refines section 5.3).
    Refit "refit" { boxed LineRefitted(LineRefitted) }
    /// A broad highlight was absorbed (refines section 5.3).
    Absorbed "absorbed" { inline Absorbed(Absorbed) }
    /// Two hypotheses became one (refines section 5.3.2).
    Merged "regions merged" { inline RegionsMerged(RegionsMerged) }
    /// A highlight candidate was tested (section 5.4.1).
    Candidate "candidate" { boxed CandidateTested(CandidateTested) }
    /// A highlight line was chosen (section 5.4.1).
    Highlight "highlight chosen" { boxed CandidateChosen(CandidateChosen) }
    /// The illuminant was estimated or given (section 5.4.1).
    Illuminant "illuminant" { boxed IlluminantEstimated(IlluminantEstimated), inline IlluminantGiven(IlluminantGiven), boxed HighlightsAveraged(HighlightsAveraged) }
    /// Small highlights voted for a light (refines section 5.4.1).
    Votes "votes" { boxed VotesCast(VotesCast) }
    /// The light that is used was chosen (refines section 5.4.1).
    LightChoice "light chosen" { boxed LightChosen(LightChosen) }
    /// A second lamp was sought (section 7.5).
    Lamps "lamps compared" { boxed LampsCompared(LampsCompared) }
    /// A slice was made (section 5.4.2).
    Slice "slice" { boxed SliceMade(SliceMade) }
    /// Two matte areas of one object were united (section 5.4.2).
    United "matte areas united" { inline MatteAreasUnited(MatteAreasUnited) }
    /// A hole was filled (section 5.5).
    Hole "hole filled" { inline HoleFilled(HoleFilled) }
    /// A hypothesis was dropped.
    Dropped "dropped" { inline Dropped(Dropped) }
    /// A part became a hypothesis of its own.
    Part "part separated" { inline ComponentSplit(ComponentSplit) }
    /// Hypotheses became the regions of the result.
    Numbers "numbers" { inline Renumbered(Renumbered) }
    /// Ambient light was sought (section 7.5).
    Ambient "ambient light" { boxed AmbientSought(Ambient) }
    /// The highlights of a region were compared (section 7.4).
    Branches "highlight branches" { boxed BranchesSought(BranchesSought) }
    /// Reflection vectors were fitted (section 6).
    Vectors "vectors" { boxed VectorsFitted(VectorsFitted) }
    /// The surface reflection at borders was limited (refines section 5.6).
    Borders "borders" { boxed BordersLimited(BordersLimited) }
    /// The local split begins, or does not.
    LocalSplit "local split" { boxed LocalBegan(LocalBegan) }
    /// The odds of the picture were found.
    PictureOdds "picture odds" { inline PictureOddsFound(PictureOddsFound) }
    /// The plausibility of the highlights was tested.
    Plausibility "belief" { boxed PlausibilityTested(PlausibilityTested) }
    /// A clipped blob was filled, or not.
    Repair "clip repair" { boxed RepairTried(RepairTried) }
    /// The histograms of a region were searched (section 7.2, an earlier method).
    Histograms "histograms" { boxed HistogramsSearched(HistogramsSearched) }
    /// The peaks of the whole picture's histogram were found (section 5.1, an earlier method).
    Peaks "color peaks" { boxed ColorPeaksFound(ColorPeaksFound) }
    /// A region of an earlier method was made (sections 5.1 and 7.2).
    Patch "patch" { inline PatchMade(PatchMade) }
    /// The matte or the highlight line of marked pixels was fitted (section 6, the method by hand).
    MarkedLine "line of the marked" { boxed MarkedLineFitted(MarkedLineFitted) }
    /// The region takes marked pixels (section 6, the method by hand).
    MarkedPixels "marked pixels" { inline MarkedPixelsTaken(MarkedPixelsTaken) }
    /// A pixel changed its owner.
    Claim "claim" {}
    /// A change of owner was refused in a contest.
    Refusal "refusal" {}
    /// A pixel got its kind (section 6).
    Label "label" {}
}

#[cfg(test)]
pub(crate) use all_events;
pub(crate) use dispatch_event;

impl Event {
    /// The hypotheses, regions and blobs that the event is about.
    pub fn subjects(&self) -> [Option<Subject>; 2] {
        self.data().subjects()
    }

    /// Bytes that the event holds on the heap.
    pub fn heap_bytes(&self) -> usize {
        self.data().heap_bytes()
    }

    /// Number of the blob that the event is about; `None` when it is about none.
    pub fn blob(&self) -> Option<u16> {
        self.subjects().into_iter().flatten().find_map(|subject| match subject {
            Subject::Blob(blob) => Some(blob),
            _ => None,
        })
    }
}
