//! Which panels lie where: docked, resized and torn apart by hand, remembered with the workspace.

use super::breakpoints_panel::BreakpointsPanel;
use super::compare_panel::ComparePanel;
use super::cube_panel::CubePanel;
use super::image_panel::ImagePanel;
use super::plane_panel::PlanePanel;
use super::profile_panel::ProfilePanel;
use super::regions_panel::RegionsPanel;
use super::selection_panel::SelectionPanel;
use super::timeline_panel::TimelinePanel;
use super::watch_panel::WatchPanel;
use super::why_panel::WhyPanel;
use super::{Cx, parameters};
use egui::{Color32, Rect, Stroke, Ui, Visuals, WidgetText};
use egui_tiles::{Behavior, SimplificationOptions, TabState, Tile, TileId, Tiles, Tree, UiResponse};
use serde::{Deserialize, Serialize};

/// A panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Pane {
    /// The photograph and its layers.
    Image,
    /// The color space.
    #[serde(alias = "Colours")]
    Colors,
    /// The dichromatic plane of one region.
    Plane,
    /// Body, surface and ε along a line.
    Profile,
    /// Sliders and switches.
    Parameters,
    /// The regions as a table.
    Regions,
    /// Statistics of what is selected.
    Selection,
    /// Pinned and newest result.
    Compare,
    /// The decisions in their order, and the cursor among them.
    Timeline,
    /// What stands at the cursor.
    Watch,
    /// What stops the cursor.
    Breakpoints,
    /// Why a pixel or a region is what it is.
    Why,
}

impl Pane {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Image,
        Self::Colors,
        Self::Plane,
        Self::Profile,
        Self::Parameters,
        Self::Regions,
        Self::Selection,
        Self::Compare,
        Self::Timeline,
        Self::Watch,
        Self::Breakpoints,
        Self::Why,
    ];

    /// Its name on its tab.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Image => "Image",
            Self::Colors => "Color space",
            Self::Plane => "Plane",
            Self::Profile => "Profile",
            Self::Parameters => "Parameters",
            Self::Regions => "Regions",
            Self::Selection => "Selection",
            Self::Compare => "Compare",
            Self::Timeline => "Timeline",
            Self::Watch => "Watch",
            Self::Breakpoints => "Breakpoints",
            Self::Why => "Why",
        }
    }
}

/// What the panels have uploaded, and the gestures that they are in the middle of.
#[derive(Default)]
pub struct Panels {
    /// The image view.
    pub image: ImagePanel,
    /// The color space view.
    pub cube: CubePanel,
    /// The plane view.
    pub plane: PlanePanel,
    /// The profile.
    pub profile: ProfilePanel,
    /// The regions table.
    pub regions: RegionsPanel,
    /// Statistics.
    pub selection: SelectionPanel,
    /// Comparison.
    pub compare: ComparePanel,
    /// The timeline.
    pub timeline: TimelinePanel,
    /// Values at the cursor.
    pub watch: WatchPanel,
    /// Why.
    pub why: WhyPanel,
    /// Breakpoints.
    pub breakpoints: BreakpointsPanel,
    /// Where the color space was in the last frame; nowhere if it was not shown.
    pub colors: Option<Rect>,
}

impl Panels {
    /// Shows one panel in all of `ui`.
    pub fn show(&mut self, pane: Pane, ui: &mut Ui, cx: &mut Cx) {
        let fill = match pane {
            Pane::Image | Pane::Colors => cx.tones.background,
            _ => cx.tones.panel,
        };
        ui.painter().rect_filled(ui.max_rect(), 0.0, fill);
        match pane {
            Pane::Image => self.image.show(ui, cx),
            Pane::Colors => {
                self.colors = Some(ui.max_rect());
                self.cube.show(ui, cx);
            }
            Pane::Plane => self.plane.show(ui, cx),
            Pane::Profile => self.profile.show(ui, cx),
            Pane::Parameters => parameters::show(ui, cx),
            Pane::Regions => self.regions.show(ui, cx),
            Pane::Selection => self.selection.show(ui, cx),
            Pane::Compare => self.compare.show(ui, cx),
            Pane::Timeline => self.timeline.show(ui, cx),
            Pane::Watch => self.watch.show(ui, cx),
            Pane::Breakpoints => self.breakpoints.show(ui, cx),
            Pane::Why => self.why.show(ui, cx),
        }
    }
}

/// The tree of panels that a person arranges.
pub struct Dock {
    tree: Tree<Pane>,
}

impl Default for Dock {
    fn default() -> Self {
        Self { tree: arranged() }
    }
}

impl Dock {
    /// Shows every panel in its place.
    pub fn show(&mut self, ui: &mut Ui, panels: &mut Panels, cx: &mut Cx) {
        self.tree.ui(&mut DockBehavior { panels, cx }, ui);
    }

    /// Whether a panel is in the window at all.
    pub fn has(&self, pane: Pane) -> bool {
        self.find(pane).is_some_and(|id| self.tree.is_visible(id))
    }

    /// Shows or hides a panel.
    pub fn set(&mut self, pane: Pane, visible: bool) {
        if let Some(id) = self.find(pane) {
            self.tree.set_visible(id, visible);
            if visible {
                self.bring_up(pane);
            }
        }
    }

    /// Brings the panel's tab to the front.
    pub fn bring_up(&mut self, pane: Pane) {
        self.tree.make_active(|_, tile| matches!(tile, Tile::Pane(found) if *found == pane));
    }

    /// Back to the arrangement of the first start.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The arrangement, to be remembered: the same for the same arrangement, however its tiles are hashed.
    pub fn to_text(&self) -> String {
        let Ok(mut tree) = serde_json::to_value(&self.tree) else { return String::new() };
        tree.sort_all_objects();
        if let Some(invisible) = tree.get_mut("invisible").and_then(serde_json::Value::as_array_mut) {
            invisible.sort_by_key(serde_json::Value::as_u64);
        }
        tree.to_string()
    }

    /// A remembered arrangement; none where it cannot be read or lacks a panel.
    pub fn from_text(text: &str) -> Option<Self> {
        let dock = Self { tree: serde_json::from_str(text).ok()? };
        Pane::ALL.iter().all(|&pane| dock.find(pane).is_some()).then_some(dock)
    }

    fn find(&self, pane: Pane) -> Option<TileId> {
        self.tree.tiles.find_pane(&pane)
    }
}

/// Image over tables; color space over plane and profile; parameters over questions; below them all the timeline.
fn arranged() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let mut tabs = |panes: &[Pane]| {
        let children = panes.iter().map(|&pane| tiles.insert_pane(pane)).collect();
        tiles.insert_tab_tile(children)
    };
    let image = tabs(&[Pane::Image]);
    let tables = tabs(&[Pane::Regions, Pane::Selection, Pane::Compare]);
    let questions = tabs(&[Pane::Why, Pane::Watch, Pane::Breakpoints]);
    let colors = tabs(&[Pane::Colors]);
    let plots = tabs(&[Pane::Plane, Pane::Profile]);
    let parameters = tabs(&[Pane::Parameters]);
    let timeline = tabs(&[Pane::Timeline]);
    let left = split(&mut tiles, egui_tiles::LinearDir::Vertical, &[(image, 0.68), (tables, 0.32)]);
    let middle = split(&mut tiles, egui_tiles::LinearDir::Vertical, &[(colors, 0.60), (plots, 0.40)]);
    let right = split(&mut tiles, egui_tiles::LinearDir::Vertical, &[(parameters, 0.52), (questions, 0.48)]);
    let views =
        split(&mut tiles, egui_tiles::LinearDir::Horizontal, &[(left, 0.39), (middle, 0.38), (right, 0.23)]);
    let root = split(&mut tiles, egui_tiles::LinearDir::Vertical, &[(views, 0.86), (timeline, 0.14)]);
    Tree::new(egui::Id::unique("dock"), root, tiles)
}

fn split(tiles: &mut Tiles<Pane>, dir: egui_tiles::LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = egui_tiles::Linear::new(dir, parts.iter().map(|part| part.0).collect());
    for &(tile, share) in parts {
        linear.shares.set_share(tile, share);
    }
    tiles.insert_new(Tile::Container(linear.into()))
}

struct DockBehavior<'a, 'b> {
    panels: &'a mut Panels,
    cx: &'a mut Cx<'b>,
}

impl Behavior<Pane> for DockBehavior<'_, '_> {
    fn pane_ui(&mut self, ui: &mut Ui, _id: TileId, pane: &mut Pane) -> UiResponse {
        self.panels.show(*pane, ui, self.cx);
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        egui::RichText::new(pane.title()).size(super::theme::SMALL_PT).into()
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        22.0
    }

    fn tab_bar_color(&self, _visuals: &Visuals) -> Color32 {
        self.cx.tones.panel
    }

    fn tab_bg_color(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, _: &TabState) -> Color32 {
        self.cx.tones.panel
    }

    fn tab_outline_stroke(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, _: &TabState) -> Stroke {
        Stroke::NONE
    }

    fn tab_text_color(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, state: &TabState) -> Color32 {
        if state.active { self.cx.tones.text } else { self.cx.tones.quiet }
    }

    fn tab_bar_hline_stroke(&self, _: &Visuals) -> Stroke {
        Stroke::new(1.0, self.cx.tones.line)
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        2.0
    }

    fn min_size(&self) -> f32 {
        96.0
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }
}
