//! The state of the application.

use super::awaited::{AfterPin, Awaited};
use super::{
    Debugger, Document, History, JobState, OpenPhotograph, Preview, ViewSettings, WhatIfJob, Workspace,
};
use crate::color::ContrastCurve;
use crate::raster::{PixelIndex, RegionId};
use crate::trace::Replay;
use crate::view::{
    Against, Arrangement, Elsewhere, ElsewhereKind, ElsewherePaths, Item, Layer, LayerNeed, Picture,
    PixelReading, ResultSnapshot, Watch, watch,
};
use std::path::PathBuf;
use std::sync::Arc;

/// What is told in the place of a result where the photograph has none and none is being computed.
pub const NOT_ANALYZED: &str = "Not analyzed: press F5.";

/// Everything that the panels show. Panels read it; only the reducers change it.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// The open photograph.
    pub picture: Option<Arc<Picture>>,
    /// Parameters, area and selection.
    pub document: Document,
    /// The steps that can be undone and redone.
    pub history: History,
    /// The newest result.
    pub newest: Option<Arc<ResultSnapshot>>,
    /// The last complete result, while some stages of the newest one are still to be computed.
    pub(super) last_complete: Option<Arc<ResultSnapshot>>,
    /// The result for the working picture of a large photograph, while the pass at full resolution runs.
    pub preview: Option<Preview>,
    /// Unit direction of the light that the analysis last found in the open photograph by itself, without a given light.
    pub found_light: Option<[f64; 3]>,
    /// The workspace file that was opened or saved last, for the open photograph.
    pub workspace_path: Option<PathBuf>,
    /// The document as it was when the photograph was opened, or when the workspace was saved last.
    pub(super) saved: Document,
    /// The result that was pinned to be compared with.
    pub pinned: Option<Arc<ResultSnapshot>>,
    /// What another program made of the open photograph.
    pub elsewhere: Option<Arc<Elsewhere>>,
    /// The item under the pointer, in any panel.
    pub hover: Option<Item>,
    /// The pixels of the color bins near the pointer in the color space view, ascending; none unless the hovered item is a bin.
    pub hover_pixels: Arc<[u32]>,
    /// The photographs that are open beside the one that is shown, in the order of the circle in which keys switch.
    pub others: Vec<OpenPhotograph>,
    /// Whether the second view of the picture shows the next of these photographs in place of the one that is shown.
    pub compares_photographs: bool,
    /// The arrangement and the second layer before the comparison of two photographs; none while none are compared.
    pub(super) before_comparison: Option<(Arrangement, Layer)>,
    /// The settings of the views.
    pub view: ViewSettings,
    /// The step debugger.
    pub debugger: Debugger,
    /// The pixel that was clicked last, if nothing else has been selected since: the panel "Why" explains that pixel.
    pub(super) explained_pixel: Option<PixelIndex>,
    /// The what-if job, if one was started for the newest result.
    pub what_if_job: Option<WhatIfJob>,
    /// The work under way in the background.
    pub jobs: JobState,
    /// Notices, oldest first.
    pub notices: Vec<Notice>,
    /// Photographs opened before, newest first.
    pub recent: Vec<PathBuf>,
    /// Number of the newest analysis request.
    pub generation: u64,
    /// Whether it was told that changed parameters stay in force for the photographs that are opened next.
    pub(super) told_of_parameters: bool,
    /// Number of notices so far, those dismissed included.
    pub(super) notices_so_far: u64,
    /// The workspace whose photograph is being read.
    pub(super) restoring: Option<Restoring>,
    /// What is done as soon as the next result is complete.
    pub(super) awaited: Awaited,
}

/// A workspace whose photograph is being read.
#[derive(Clone, Debug)]
pub(super) struct Restoring {
    /// The contents of the workspace file.
    pub(super) workspace: Box<Workspace>,
    /// The workspace file.
    pub(super) path: PathBuf,
}

impl State {
    /// The result that the panels show: the pinned one if it is to be shown, otherwise the newest.
    pub fn shown(&self) -> Option<&Arc<ResultSnapshot>> {
        match &self.pinned {
            Some(pinned) if self.view.show_pinned => Some(pinned),
            _ => self.newest.as_ref(),
        }
    }

    /// Whether the panels show the pinned result in place of the newest.
    pub fn shows_pinned(&self) -> bool {
        self.view.show_pinned && self.pinned.is_some()
    }

    /// The contrast curve with which the open photograph was read, which the views apply again; none without one.
    pub fn contrast(&self) -> Option<ContrastCurve> {
        self.picture.as_ref().and_then(|picture| picture.photo.image.contrast)
    }

    /// The result of the newest run: that for the working picture, until the whole result is there. What is in working pixels or in no
    /// pixels (parameters, lights) is the same in both.
    pub fn newest_run(&self) -> Option<&ResultSnapshot> {
        self.preview.as_ref().map(|preview| &*preview.shown).or(self.newest.as_deref())
    }

    /// Side of a working pixel of the newest run, pixels of the photograph; 1 before the first run.
    pub fn working_side_px(&self) -> usize {
        let of_newest = || self.newest.as_ref().map(|shown| shown.analysis.working.blocks.side());
        self.preview.as_ref().map(|preview| preview.blocks.side()).or_else(of_newest).unwrap_or(1)
    }

    /// The result for the working picture that views show in place of the result, and the selected region in it; none where the
    /// result itself or the pinned result is to be shown.
    pub fn shown_preview(&self) -> Option<(&Preview, Option<RegionId>)> {
        let preview = self.preview.as_ref().filter(|_| self.pinned.is_none() || !self.view.show_pinned)?;
        // A region keeps its color from result to result, not its number.
        let color_of = |region: RegionId| self.shown()?.region_colors.get(region.index());
        let selected_color = self.selected_region().and_then(color_of);
        let selected = selected_color.and_then(|color| {
            let index = preview.shown.region_colors.iter().position(|other| other == color)?;
            Some(RegionId::from_index(index))
        });
        Some((preview, selected))
    }

    /// The preview that views show, and in it the region that is selected as a region, whose outline views draw.
    pub fn outlined_in_preview(&self) -> Option<(&Preview, RegionId)> {
        let is_region = matches!(self.document.selection.item, Some(Item::Region(_)));
        let (preview, region) = self.shown_preview().filter(|_| is_region && self.followed().is_none())?;
        Some((preview, region?))
    }

    /// The region of the result shown that has the color of a region of the preview.
    pub fn region_of_preview(&self, region: RegionId) -> Option<RegionId> {
        let color = self.preview.as_ref()?.shown.region_colors.get(region.index())?;
        let index = self.shown()?.region_colors.iter().position(|other| other == color)?;
        Some(RegionId::from_index(index))
    }

    /// The region of the result shown that an item is or lies in.
    pub fn region_of(&self, item: Item) -> Option<RegionId> {
        let shown = self.shown()?;
        let labels = &shown.labels();
        let region = match item {
            Item::Region(region) => region,
            Item::Pixel(pixel) => RegionId::from_label(*labels.as_slice().get(pixel.index())?)?,
            Item::Window(_) | Item::Bin(_) => return None,
        };
        (region.index() < shown.analysis.intrinsic.regions.len()).then_some(region)
    }

    /// The ends of the profile's line, in pixels of the picture: through the hovered pixel, else through the selected one,
    /// else through the middle.
    pub fn profile_ends(&self) -> Option<[[f32; 2]; 2]> {
        let pixel = |item: Option<Item>| match item {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => None,
        };
        let at = pixel(self.hover).or(pixel(self.document.selection.item));
        self.picture.as_ref().map(|picture| crate::view::profile_ends(self.view.profile, picture, at))
    }

    /// The pixel that the panel "Why" explains: the selected one, or the one at which the selected region was clicked.
    pub fn explained_pixel(&self) -> Option<PixelIndex> {
        match self.document.selection.item {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => self.explained_pixel,
        }
    }

    /// The debugger's cursor, if image, color space and tables show the instant at the cursor in place of the result.
    pub fn followed(&self) -> Option<&Replay> {
        let replay = self.debugger.stopped().filter(|_| self.view.debug.follow && !self.view.show_pinned)?;
        let newest = self.newest.as_ref().filter(|_| self.picture.is_some())?;
        (newest.analysis.working.blocks == replay.trace().pixel_blocks()).then_some(replay)
    }

    /// Forgets what was under way and pointed at in the photograph that was shown, before another one is shown. The views' zoom, which photographs
    /// of one size share, stays.
    pub(super) fn leave_photograph(&mut self) {
        self.notices.retain(|notice| !notice.of_photograph);
        (self.debugger, self.jobs.recording) = (Debugger::default(), None);
        (self.preview, self.last_complete) = (None, None);
        self.hover = None;
        self.hover_pixels = Arc::default();
        self.explained_pixel = None;
        self.view.show_pinned = false;
        self.awaited = Awaited::default();
    }

    /// Gives up the pinned result of a restored workspace, where that is being computed: the parameters are those of the newest result.
    pub(super) fn give_up_pin(&mut self) {
        if let Some(after) = self.awaited.after_pin.take() {
            self.document.params = after.params;
        }
    }

    /// The photograph that the second view shows for comparison: the next open one.
    pub fn compared_photograph(&self) -> Option<&OpenPhotograph> {
        self.others.first().filter(|_| self.compares_photographs && self.picture.is_some())
    }

    /// The values at the debugger's cursor, those of the selected pixel among them; none where no decisions are recorded.
    pub fn watched(&self) -> Option<Watch> {
        let (replay, picture) = (self.debugger.replay.as_ref()?, self.picture.as_ref()?);
        // While another scale is analyzed, the working picture may be another one than that of the trace.
        let pixel_blocks = replay.trace().pixel_blocks();
        let working = self.newest.as_ref().map(|shown| &shown.analysis.working);
        let working = working.filter(|working| working.blocks == pixel_blocks);
        let pixel = self.explained_pixel().filter(|_| working.is_some());
        let colors = working.map_or(&picture.photo.image.pixels, |working| &working.image.pixels);
        Some(watch(replay, &self.debugger.names, colors, pixel))
    }

    /// What is known of a pixel: at the debugger's cursor where that is followed, otherwise in the result shown.
    pub fn reading_of(&self, pixel: PixelIndex) -> Option<PixelReading> {
        let picture = self.picture.as_ref()?;
        let reading = match self.followed() {
            Some(replay) => PixelReading::at_cursor(picture, replay, &self.debugger.names, pixel.index()),
            None => PixelReading::of(picture, self.shown().map(|shown| &**shown), pixel.index()),
        };
        let elsewhere = self.elsewhere.as_ref().map(|elsewhere| elsewhere.at(pixel.index()));
        reading.map(|reading| PixelReading { elsewhere, ..reading })
    }

    /// What a layer may compare the result with.
    pub fn against(&self) -> Against<'_> {
        Against { pinned: self.pinned.as_deref(), elsewhere: self.elsewhere.as_deref() }
    }

    /// Why a layer shows nothing of its own, and what a person has to do first where a layer compares the result with something that is not
    /// there; none where the layer can be shown.
    pub fn lacks(&self, layer: Layer) -> Option<&'static str> {
        let has_one_lamp = || self.shown().is_some_and(|shown| shown.analysis.finals.light.second.is_none());
        if layer.needs_result() && self.lacks_result() && self.newest.is_none() {
            return Some(NOT_ANALYZED);
        }
        if layer.needs_second_lamp() && has_one_lamp() {
            return Some("One lamp: no second lamp was found or given (section 7.5).");
        }
        let has = |kind| self.elsewhere.as_ref().is_some_and(|elsewhere| elsewhere.has(kind));
        match layer.need()? {
            LayerNeed::Pinned => self.pinned.is_none().then_some("Pin a result first (K)."),
            LayerNeed::Elsewhere(kind) if has(kind) => None,
            LayerNeed::Elsewhere(ElsewhereKind::Labels) => {
                Some("Open a label map of another program first (menu File).")
            }
            LayerNeed::Elsewhere(ElsewhereKind::Diffuse) => {
                Some("Open a diffuse picture of another program first (menu File).")
            }
        }
    }

    /// Shows layers of the result in place of layers of another program's pictures that are not there any more.
    pub(super) fn leave_missing_layers(&mut self) {
        for kind in ElsewhereKind::ALL {
            self.leave_layers_of(kind);
        }
    }

    /// Shows a layer of the result in place of the layers of another program's picture of this kind, where there is no such picture.
    /// Returns the layer that was shown; none where the views stay as they are.
    pub(super) fn leave_layers_of(&mut self, kind: ElsewhereKind) -> Option<Layer> {
        if self.elsewhere.as_ref().is_some_and(|elsewhere| elsewhere.has(kind)) {
            return None;
        }
        let image = &mut self.view.image;
        let mut left = None;
        // The layer of the first view is named where both views are left.
        for layer in [&mut image.other, &mut image.layer] {
            if layer.need() == Some(LayerNeed::Elsewhere(kind)) {
                left = Some(std::mem::replace(layer, own_layer(kind)));
            }
        }
        left
    }

    /// The color of the hypothesis that the debugger's cursor is about, sRGB; none where the cursor is about no hypothesis.
    pub fn focus_color(&self) -> Option<[u8; 3]> {
        self.debugger.focus().map(|focus| self.debugger.names.color(focus))
    }

    /// Whether a person has changed parameters, marks or area since the photograph was opened and since the workspace was saved last.
    pub fn is_unsaved(&self) -> bool {
        self.picture.is_some() && self.document.holds_other_work(&self.saved)
    }

    /// Whether a photograph is the one that is shown.
    pub fn shows_photograph(&self, picture: &Arc<Picture>) -> bool {
        self.picture.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, picture))
    }

    /// Whether the work on an open photograph, which may not be the one that is shown, is in no workspace.
    pub fn is_photograph_unsaved(&self, picture: &Arc<Picture>) -> bool {
        let is_other = |other: &OpenPhotograph| Arc::ptr_eq(&other.picture, picture) && other.is_unsaved();
        self.shows_photograph(picture) && self.is_unsaved() || self.others.iter().any(is_other)
    }

    /// The names of the open photographs whose parameters, marks or area are not saved, that of the photograph shown first.
    pub fn unsaved_names(&self) -> Vec<String> {
        let shown = self.picture.iter().filter(|_| self.is_unsaved());
        let others = self.others.iter().filter(|other| other.is_unsaved()).map(|other| &other.picture);
        shown.chain(others).map(|picture| picture.origin.name()).collect()
    }

    /// Adds a notice about the open photograph, in place of a notice with the same text.
    pub(super) fn notify(&mut self, severity: Severity, text: String) {
        self.add_notice(severity, text, self.picture.is_some());
    }

    /// Adds a notice that stays when another photograph is opened, in place of a notice with the same text.
    pub(super) fn notify_of_files(&mut self, severity: Severity, text: String) {
        self.add_notice(severity, text, false);
    }

    fn add_notice(&mut self, severity: Severity, text: String, of_photograph: bool) {
        // What is told again is the newest notice again: a dialog that waits for a file finds its error.
        self.notices.retain(|notice| notice.text != text);
        self.notices_so_far += 1;
        self.notices.push(Notice { id: self.notices_so_far, severity, text, of_photograph });
    }

    /// The workspace that would be saved now.
    ///
    /// # Errors
    /// A sentence, where no photograph is open or the open one is in no file that could be opened again.
    pub(super) fn workspace(&self) -> Result<Workspace, String> {
        let picture =
            self.picture.as_ref().ok_or("there is no workspace to save: open a photograph first")?;
        let pinned = self.pinned.as_ref().map(|pinned| &pinned.params);
        let mut workspace = match self.awaited.after_pin {
            None => Workspace::new(picture, &self.document, pinned, &self.view)?,
            // The parameters of the document are those of the pinned result, which is being computed.
            Some(AfterPin { params, item, show_pinned }) => {
                let mut document = Document { params, ..self.document.clone() };
                document.selection.item = item;
                let view = ViewSettings { show_pinned, ..self.view.clone() };
                Workspace::new(picture, &document, Some(&self.document.params), &view)?
            }
        };
        workspace.elsewhere =
            self.elsewhere.as_ref().map_or_else(ElsewherePaths::default, |all| all.paths.clone());
        Ok(workspace)
    }

    /// The region of the selected item, which the panels about one region show.
    pub fn selected_region(&self) -> Option<RegionId> {
        self.document.selection.item.and_then(|item| self.region_of(item))
    }
}

/// The layer of the result that a picture of another program is held against.
pub(super) const fn own_layer(kind: ElsewhereKind) -> Layer {
    match kind {
        ElsewhereKind::Labels => Layer::Regions,
        ElsewhereKind::Diffuse => Layer::Body,
    }
}

/// The kind of a notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The debugger answers a key.
    Answer,
    /// Something was done.
    Done,
    /// Something may be wrong.
    Warning,
    /// Something failed.
    Error,
}

/// A sentence for the person at the screen. Panels show a warning and an error until the notice is dismissed, and a success or
/// an answer for some seconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Identifies the notice when it is dismissed.
    pub id: u64,
    /// The kind of the notice.
    pub severity: Severity,
    /// What happened, to what, and what to do.
    pub text: String,
    /// Whether a photograph was open: such a notice ends when another photograph is opened.
    pub of_photograph: bool,
}
