//! The contents of the image view at an instant, copied from the cursor so that the picture can be painted on another thread.

use super::RegionNames;
use super::growth_pixels::{candidate_pixels, growth_pixels, test_at_cursor};
use super::step_pixels::blob_at_cursor;
use crate::photo::{Masks, WorkingPicture};
use crate::raster::{Blocks, HypothesisId, LabelMap, PixelIndex, Raster};
use crate::trace::{
    Class, Event, Grid, MergeTried, Pass, PixelKind, Replay, Stage, Step, Topic, WindowClassified,
};

/// An instant as the image view shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// The contents of the image view.
    pub view: InstantView,
    /// The pixel of the step taken last, where the step is about a pixel, and whether the pixel changed.
    pub pixel: Option<(PixelIndex, bool)>,
    /// The window that was classified last, in pixels: left, top and side.
    pub window: Option<[usize; 3]>,
}

/// The contents of an instant.
#[derive(Clone, Debug, PartialEq)]
pub enum InstantView {
    /// Nothing is decided yet.
    Nothing,
    /// Windows and areas, as far as they are known (5.2).
    Windows(WindowsView),
    /// Hypotheses, as far as they have grown (5.3, 5.4, 5.5).
    Regions(RegionsView),
    /// The kinds of the pixels, as far as they are decided (6).
    Roles(RolesView),
}

/// Windows at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowsView {
    /// Side of a window, pixels.
    pub size_px: usize,
    /// Windows in a row.
    pub columns: usize,
    /// Class of each window; none as long as the window was not classified, and for a window without a class.
    pub classes: Vec<Option<Class>>,
    /// The first window of each window's area.
    pub areas: Vec<u32>,
    /// The areas of the merge that was tried last, by first window: one area where they were joined.
    pub tried: Vec<u32>,
}

/// Hypotheses at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionsView {
    /// Hypothesis of each pixel.
    pub labels: LabelMap,
    /// Color of each hypothesis, by [`HypothesisId::index`].
    pub colors: Vec<[u8; 3]>,
    /// The hypothesis that the step taken last is about.
    pub focus: Option<HypothesisId>,
    /// Pixels that the hypothesis in focus took last.
    pub newest: Vec<u32>,
    /// Adjacent pixels that the hypothesis in focus did not take, or the pixels of the cluster that is tested as its highlight.
    pub beside: Vec<u32>,
    /// Whether `beside` holds the pixels of such a cluster.
    pub tested: bool,
    /// The windows in which unexplained pixels are classified again.
    pub windows: Option<WindowsView>,
}

/// Kinds of pixels at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RolesView {
    /// Kind of each pixel: unassigned as long as the kind is not decided.
    pub kinds: Raster<PixelKind>,
    /// The pixels of the blob that the step taken last judged, and whether the blob is a highlight.
    pub blob: Option<(Vec<u32>, bool)>,
    /// Whether the blob is a clipped area that is judged by its edge, before any kind of pixel is decided.
    pub is_edge_judged: bool,
}

impl WindowsView {
    fn of(grid: &Grid, last: Option<&Step>) -> Self {
        let areas = grid.areas();
        let tried = match last {
            Some(Step::Event(Event::MergeTried(MergeTried { into, from, .. }))) => {
                let mut tried: Vec<u32> =
                    [into, from].iter().filter_map(|window| areas.get(**window as usize)).copied().collect();
                tried.dedup();
                tried
            }
            _ => Vec::new(),
        };
        Self {
            size_px: (grid.laid.size_px as usize).max(1),
            columns: grid.laid.columns as usize,
            classes: grid.classes.as_slice().iter().map(|class| class.flatten()).collect(),
            areas,
            tried,
        }
    }

    fn square(&self, window: u32) -> [usize; 3] {
        let (window, columns) = (window as usize, self.columns.max(1));
        [window % columns * self.size_px, window / columns * self.size_px, self.size_px]
    }
}

impl Instant {
    /// The instant at the cursor; `chosen` is the hypothesis in focus where the step taken last is about none.
    pub fn of(
        replay: &Replay,
        names: &RegionNames,
        chosen: Option<HypothesisId>,
        working: &WorkingPicture,
    ) -> Self {
        let (colors, masks) = (&working.image.pixels, &working.masks);
        let last = replay.last();
        let stage = replay.stage().filter(|_| last.is_some());
        let windows = replay.grid().map(|grid| WindowsView::of(grid, last.as_ref()));
        let window = match (&last, &windows) {
            (Some(Step::Event(Event::WindowClassified(WindowClassified { window, .. }))), Some(windows)) => {
                Some(windows.square(*window))
            }
            _ => None,
        };
        let pixel = last.as_ref().and_then(|step| {
            let pixel = step.pixel()?;
            Some((pixel, !matches!(step, Step::Refusal { .. })))
        });
        let view = match stage {
            None => InstantView::Nothing,
            Some(Stage::Masks) => blob_at_cursor(replay).map_or(InstantView::Nothing, |blob| {
                InstantView::Roles(RolesView { kinds: roles(replay), blob: Some(blob), is_edge_judged: true })
            }),
            Some(Stage::Classify | Stage::Merge) => {
                windows.map_or(InstantView::Nothing, InstantView::Windows)
            }
            Some(Stage::Linear | Stage::Planar | Stage::Clipping) => {
                let is_in_windows = matches!(replay.pass(), Some(Pass::SmallerWindows(_)));
                let windows = windows.filter(|_| is_in_windows);
                InstantView::Regions(regions(replay, names, chosen, colors, masks, windows))
            }
            Some(Stage::Split) => {
                let (kinds, blob) = (roles(replay), blob_at_cursor(replay));
                InstantView::Roles(RolesView { kinds, blob, is_edge_judged: false })
            }
        };
        Self { view, pixel, window }.of_photograph(&replay.trace().pixel_blocks())
    }

    /// Converts the instant from working pixels, which are these blocks of the photograph, to pixels of the photograph.
    fn of_photograph(self, blocks: &Blocks) -> Self {
        if blocks.side() == 1 {
            return self;
        }
        let expanded = |pixels: Vec<u32>| {
            let members = pixels.into_iter().flat_map(|pixel| blocks.members(pixel as usize));
            members.map(|pixel| pixel as u32).collect::<Vec<u32>>()
        };
        let larger =
            |windows: WindowsView| WindowsView { size_px: windows.size_px * blocks.side(), ..windows };
        let view = match self.view {
            InstantView::Nothing => InstantView::Nothing,
            InstantView::Windows(windows) => InstantView::Windows(larger(windows)),
            InstantView::Regions(regions) => InstantView::Regions(RegionsView {
                labels: blocks.enlarged(&regions.labels),
                newest: expanded(regions.newest),
                beside: expanded(regions.beside),
                windows: regions.windows.map(larger),
                ..regions
            }),
            InstantView::Roles(roles) => InstantView::Roles(RolesView {
                kinds: blocks.enlarged(&roles.kinds),
                blob: roles.blob.map(|(pixels, kept)| (expanded(pixels), kept)),
                is_edge_judged: roles.is_edge_judged,
            }),
        };
        let middle = |pixel: PixelIndex| PixelIndex::from_index(blocks.middle(pixel.index()));
        Self {
            view,
            pixel: self.pixel.map(|(pixel, taken)| (middle(pixel), taken)),
            window: self.window.map(|window| window.map(|px| px * blocks.side())),
        }
    }
}

fn regions(
    replay: &Replay,
    names: &RegionNames,
    chosen: Option<HypothesisId>,
    colors: &Raster<[f32; 3]>,
    masks: &Masks,
    windows: Option<WindowsView>,
) -> RegionsView {
    let grown = growth_pixels(replay, colors, masks);
    let (newest, beside) = grown.map_or_else(Default::default, |grown| {
        let mut beside = grown.outside;
        beside.extend(grown.kept_out);
        (grown.newest, beside)
    });
    let test = test_at_cursor(replay);
    let beside = test.map_or(beside, |test| candidate_pixels(replay, test, masks));
    let topic = replay.at().checked_sub(1).and_then(|last| replay.trace().block_at(last));
    RegionsView {
        labels: replay.labels().clone(),
        colors: HypothesisId::all(replay.hypotheses().len()).map(|id| names.color(id)).collect(),
        focus: topic.map(|block| block.topic.hypothesis()).or(chosen),
        newest,
        beside,
        tested: test.is_some(),
        windows,
    }
}

fn roles(replay: &Replay) -> Raster<PixelKind> {
    let (width, height) = (replay.labels().width(), replay.labels().height());
    let mut kinds = Raster::filled(width, height, PixelKind::Unassigned);
    let known = replay.trace().stage_trace(Stage::Split).and_then(|stage_trace| stage_trace.kinds());
    let upto = replay.labeled_up_to();
    if let Some(known) = known.filter(|known| known.len() == kinds.len()) {
        let upto = upto.min(kinds.len());
        kinds.as_mut_slice()[..upto].copy_from_slice(&known.as_slice()[..upto]);
    }
    kinds
}

/// The place of the cursor, in a few words.
pub fn cursor_place(replay: &Replay) -> String {
    let Some(last) = replay.at().checked_sub(1) else { return "before the first step".to_owned() };
    let Some(stage) = replay.stage() else { return String::new() };
    let topic = replay.trace().block_at(last).map(|block| match block.topic {
        Topic::Hypothesis(id) => format!("hypothesis {id}"),
        Topic::Absorption(id) => format!("hypothesis {id} is absorbed"),
        Topic::Candidates(id) => format!("highlight of {id}?"),
        Topic::Slice(id) => format!("slice of {id}"),
        Topic::Brightness(id) => format!("highlight of {id}"),
        Topic::Hole(id) => format!("hole in {id}"),
        Topic::Part(id) => format!("part {id}"),
    });
    let pass = replay.pass().map(|pass| pass.name().to_owned());
    [Some(stage.name().to_owned()), topic.or(pass)].into_iter().flatten().collect::<Vec<_>>().join(" \u{b7} ")
}
