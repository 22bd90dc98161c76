//! The table of the panels, and their arrangement: docked, resized, rearranged by hand, and saved with the workspace.
//!
//! A new panel is a module with a function `show`, a variant of [`Pane`], and a row of the table.

use super::PanelContext;
use super::about::About;
use super::pane::Pane;
use super::theme::ThemeColors;
use egui::{Color32, Rect, Stroke, Ui, Visuals, WidgetText};
use egui_tiles::{
    Behavior, LinearDir, SimplificationOptions, TabState, Tile, TileId, Tiles, Tree, UiResponse,
};

/// A row of the table: one panel.
struct PaneRow {
    /// The result that the panel is about.
    about: About,
    /// The background color of the panel.
    background: fn(&ThemeColors) -> Color32,
    /// The group of tabs that the panel belongs to in the first arrangement.
    tabs: TabGroup,
    /// Shows the panel in the whole `Ui`.
    show: fn(&mut Panels, &mut Ui, &mut PanelContext),
}

/// Panels that share tabs in the first arrangement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TabGroup {
    Image,
    Tables,
    Questions,
    Colors,
    Plots,
    Parameters,
    Timeline,
}

/// Makes the rows and [`Panels`] from the table: for each panel the field of [`Panels`] with the panel's own data (braces are
/// empty without such data), and the row.
macro_rules! panes {
    ($($pane:ident { $($field:ident: $panel:ty)? } $row:expr;)+) => {
        impl Pane {
            const fn row(self) -> &'static PaneRow {
                match self {
                    $(Self::$pane => const { &$row },)+
                }
            }
        }

        /// The panels' own data: uploaded textures, and gestures in progress.
        #[derive(Default)]
        pub struct Panels {
            $($(#[doc = concat!("The panel ", stringify!($pane), ".")] pub $field: $panel,)?)+
            /// The rectangle of the color space in the last frame; none if the color space was not shown.
            pub color_space_rect: Option<Rect>,
            /// The panels that a panic ended: not drawn again until their size changes.
            pub failed: Vec<FailedPane>,
        }
    };
}

panes! {
    Image { image: super::image_panel::ImagePanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.background,
        tabs: TabGroup::Image,
        show: |panels, ui, cx| panels.image.show(ui, cx),
    };
    Colors { cube: super::cube_panel::CubePanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.background,
        tabs: TabGroup::Colors,
        show: |panels, ui, cx| {
            panels.color_space_rect = Some(ui.max_rect());
            panels.cube.show(ui, cx);
        },
    };
    Plane { plane: super::plane_panel::PlanePanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.panel,
        tabs: TabGroup::Plots,
        show: |panels, ui, cx| panels.plane.show(ui, cx),
    };
    Profile { profile: super::profile_panel::ProfilePanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.panel,
        tabs: TabGroup::Plots,
        show: |panels, ui, cx| panels.profile.show(ui, cx),
    };
    Geometry { geometry: super::geometry_panel::GeometryPanel } PaneRow {
        about: About::None,
        background: |palette| palette.panel,
        tabs: TabGroup::Plots,
        show: |panels, ui, cx| panels.geometry.show(ui, cx),
    };
    Parameters {} PaneRow {
        about: About::Request,
        background: |palette| palette.panel,
        tabs: TabGroup::Parameters,
        show: |_, ui, cx| super::parameters::show(ui, cx),
    };
    Regions { regions: super::regions_panel::RegionsPanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.panel,
        tabs: TabGroup::Tables,
        show: |panels, ui, cx| panels.regions.show(ui, cx),
    };
    Selection { selection: super::selection_panel::SelectionPanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.panel,
        tabs: TabGroup::Tables,
        show: |panels, ui, cx| panels.selection.show(ui, cx),
    };
    Compare { compare: super::compare_panel::ComparePanel } PaneRow {
        about: About::None,
        background: |palette| palette.panel,
        tabs: TabGroup::Tables,
        show: |panels, ui, cx| panels.compare.show(ui, cx),
    };
    History { history: super::history_panel::HistoryPanel } PaneRow {
        about: About::Request,
        background: |palette| palette.panel,
        tabs: TabGroup::Tables,
        show: |panels, ui, cx| panels.history.show(ui, cx),
    };
    Timeline { timeline: super::timeline_panel::TimelinePanel } PaneRow {
        about: About::Newest,
        background: |palette| palette.panel,
        tabs: TabGroup::Timeline,
        show: |panels, ui, cx| panels.timeline.show(ui, cx),
    };
    Inspector { inspector: super::inspector_panel::InspectorPanel } PaneRow {
        about: About::Shown,
        background: |palette| palette.panel,
        tabs: TabGroup::Questions,
        show: |panels, ui, cx| panels.inspector.show(ui, cx),
    };
    Watch { watch: super::watch_panel::WatchPanel } PaneRow {
        about: About::Newest,
        background: |palette| palette.panel,
        tabs: TabGroup::Questions,
        show: |panels, ui, cx| panels.watch.show(ui, cx),
    };
    Breakpoints { breakpoints: super::breakpoints_panel::BreakpointsPanel } PaneRow {
        about: About::None,
        background: |palette| palette.panel,
        tabs: TabGroup::Questions,
        show: |panels, ui, cx| panels.breakpoints.show(ui, cx),
    };
}

/// A panel whose drawing ended by a panic.
pub struct FailedPane {
    pane: Pane,
    /// The size of the panel at the panic, points.
    size: egui::Vec2,
}

impl Panels {
    /// Shows one panel in all of `ui`. A panic of the panel ends the panel alone: the panel says so until its size changes
    /// or a person tries again, and the workspace is saved.
    pub fn show(&mut self, pane: Pane, ui: &mut Ui, cx: &mut PanelContext) {
        let row = pane.row();
        // Contents that need more room than there is enlarge the rectangle.
        let place = ui.max_rect();
        let size = place.size();
        ui.painter().rect_filled(ui.max_rect(), 0.0, (row.background)(cx.palette));
        self.failed.retain(|failed| failed.pane != pane || (failed.size - size).length() < 1.0);
        if self.failed.iter().any(|failed| failed.pane == pane) {
            let text = "This panel was ended by an error of the program.";
            ui.label(egui::RichText::new(text).color(cx.palette.error));
            if ui.button("Try again").clicked() {
                self.failed.retain(|failed| failed.pane != pane);
            }
            return;
        }
        if let Err(reason) = crate::app::catch_panic(|| (row.show)(self, ui, cx)) {
            self.failed.push(FailedPane { pane, size });
            let text = format!(
                "the panel {} was ended by an error of the program ({reason}); please report the error, and go on",
                pane.title()
            );
            cx.send(crate::app::JobCommand::Rescue(text));
        }
        // The image shows the newer result as far as it is computed, and dims single layers.
        if pane != Pane::Image {
            row.about.mark(ui, cx, place, (row.background)(cx.palette));
        }
    }
}

/// Height of the tabs over a panel, points.
pub const TAB_BAR_PT: f32 = 22.0;

/// The tree of panels that a person arranges.
pub struct Dock {
    tree: Tree<Pane>,
}

impl Default for Dock {
    fn default() -> Self {
        Self { tree: initial_arrangement() }
    }
}

impl Dock {
    /// Shows all panels as they are arranged.
    pub fn show(&mut self, ui: &mut Ui, panels: &mut Panels, cx: &mut PanelContext) {
        self.tree.ui(&mut DockBehavior { panels, cx }, ui);
    }

    /// Whether a panel is in the window, in front or behind another tab.
    pub fn is_visible(&self, pane: Pane) -> bool {
        self.find(pane).is_some_and(|id| self.tree.is_visible(id))
    }

    /// The place of a panel in the last frame; none where it is hidden or behind another tab.
    pub fn rect_of(&self, pane: Pane) -> Option<Rect> {
        let id = self.find(pane).filter(|_| self.is_visible(pane) && self.is_in_front(pane))?;
        self.tree.tiles.rect(id)
    }

    /// Whether every panel is hidden.
    pub fn is_empty(&self) -> bool {
        !Pane::ALL.into_iter().any(|pane| self.is_visible(pane))
    }

    /// Shows or hides a panel.
    pub fn set_visible(&mut self, pane: Pane, visible: bool) {
        if let Some(id) = self.find(pane) {
            self.tree.set_visible(id, visible);
            if visible {
                self.activate(pane);
            }
        }
    }

    /// All `panes` as tabs of one group.
    pub fn of_tabs(panes: &[Pane]) -> Self {
        let mut tiles = Tiles::default();
        let tabs = panes.iter().map(|&pane| tiles.insert_pane(pane)).collect();
        let root = tiles.insert_tab_tile(tabs);
        Self { tree: Tree::new(egui::Id::unique("compact dock"), root, tiles) }
    }

    /// Whether the panel's tab is in front of the other tabs of its group.
    pub fn is_in_front(&self, pane: Pane) -> bool {
        let active = self.tree.active_tiles();
        self.find(pane).is_some_and(|id| active.contains(&id))
    }

    /// Brings the panel's tab to the front.
    pub fn activate(&mut self, pane: Pane) {
        self.tree.make_active(|_, tile| matches!(tile, Tile::Pane(found) if *found == pane));
    }

    /// Restores the first arrangement.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The arrangement as text, to be saved. Equal arrangements give equal texts, although the tiles lie in a hash map.
    pub fn to_text(&self) -> String {
        let Ok(mut tree) = serde_json::to_value(&self.tree) else { return String::new() };
        tree.sort_all_objects();
        if let Some(invisible) = tree.get_mut("invisible").and_then(serde_json::Value::as_array_mut) {
            invisible.sort_by_key(serde_json::Value::as_u64);
        }
        tree.to_string()
    }

    /// A saved arrangement; none where it cannot be read. A panel that it lacks is added: to the tabs of a panel of the
    /// same group, or beside everything else where there is none.
    pub fn from_text(text: &str) -> Option<Self> {
        let mut dock = Self { tree: serde_json::from_str(text).ok()? };
        for pane in Pane::ALL {
            if dock.find(pane).is_none() {
                dock.add(pane);
            }
        }
        Some(dock)
    }

    /// Adds a panel that is not in the tree.
    fn add(&mut self, pane: Pane) {
        let siblings = Pane::ALL.into_iter().filter(|other| other.row().tabs == pane.row().tabs);
        let tabs = siblings
            .filter_map(|sibling| self.find(sibling))
            .find_map(|sibling| self.tree.tiles.parent_of(sibling));
        let added = self.tree.tiles.insert_pane(pane);
        if let Some(Tile::Container(container)) = tabs.and_then(|tabs| self.tree.tiles.get_mut(tabs)) {
            container.add_child(added);
            return;
        }
        let added = self.tree.tiles.insert_tab_tile(vec![added]);
        self.tree.root = Some(match self.tree.root {
            Some(root) => split(&mut self.tree.tiles, LinearDir::Horizontal, &[(root, 0.8), (added, 0.2)]),
            None => added,
        });
    }

    /// The tile of a panel.
    fn find(&self, pane: Pane) -> Option<TileId> {
        self.tree.tiles.find_pane(&pane)
    }
}

/// The first arrangement: image over tables; color space over plane and profile; parameters over questions;
/// the timeline below.
fn initial_arrangement() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let mut tabs = |group: TabGroup| {
        let panes = Pane::ALL.into_iter().filter(|pane| pane.row().tabs == group);
        let children = panes.map(|pane| tiles.insert_pane(pane)).collect();
        tiles.insert_tab_tile(children)
    };
    let image = tabs(TabGroup::Image);
    let tables = tabs(TabGroup::Tables);
    let questions = tabs(TabGroup::Questions);
    let color_space_rect = tabs(TabGroup::Colors);
    let plots = tabs(TabGroup::Plots);
    let parameters = tabs(TabGroup::Parameters);
    let timeline = tabs(TabGroup::Timeline);
    let left = split(&mut tiles, LinearDir::Vertical, &[(image, 0.68), (tables, 0.32)]);
    let middle = split(&mut tiles, LinearDir::Vertical, &[(color_space_rect, 0.60), (plots, 0.40)]);
    let right = split(&mut tiles, LinearDir::Vertical, &[(parameters, 0.52), (questions, 0.48)]);
    let views = split(&mut tiles, LinearDir::Horizontal, &[(left, 0.39), (middle, 0.38), (right, 0.23)]);
    let root = split(&mut tiles, LinearDir::Vertical, &[(views, 0.86), (timeline, 0.14)]);
    Tree::new(egui::Id::unique("dock"), root, tiles)
}

/// A container of `parts`, each with its share of the length.
fn split(tiles: &mut Tiles<Pane>, dir: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = egui_tiles::Linear::new(dir, parts.iter().map(|part| part.0).collect());
    for &(tile, share) in parts {
        linear.shares.set_share(tile, share);
    }
    tiles.insert_new(Tile::Container(linear.into()))
}

/// The appearance and contents of the tiles.
struct DockBehavior<'a, 'b> {
    panels: &'a mut Panels,
    cx: &'a mut PanelContext<'b>,
}

impl Behavior<Pane> for DockBehavior<'_, '_> {
    fn pane_ui(&mut self, ui: &mut Ui, _id: TileId, pane: &mut Pane) -> UiResponse {
        self.panels.show(*pane, ui, self.cx);
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        let title = format!("{}{}", pane.title(), pane.row().about.suffix(self.cx.state));
        egui::RichText::new(title).size(super::theme::SMALL_PT).into()
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        TAB_BAR_PT
    }

    fn tab_bar_color(&self, _visuals: &Visuals) -> Color32 {
        self.cx.palette.panel
    }

    fn tab_bg_color(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, _: &TabState) -> Color32 {
        self.cx.palette.panel
    }

    fn tab_outline_stroke(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, _: &TabState) -> Stroke {
        Stroke::NONE
    }

    fn tab_text_color(&self, _: &Visuals, _: &Tiles<Pane>, _: TileId, state: &TabState) -> Color32 {
        if state.active { self.cx.palette.text } else { self.cx.palette.secondary }
    }

    fn tab_bar_hline_stroke(&self, _: &Visuals) -> Stroke {
        Stroke::new(1.0, self.cx.palette.line)
    }

    fn is_tile_draggable(&self, tiles: &Tiles<Pane>, tile_id: TileId) -> bool {
        // Single panels are dragged by their tabs. A bar of tabs that could be dragged would be a stop of Tab without a name.
        matches!(tiles.get(tile_id), Some(Tile::Pane(_)))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A saved arrangement without `pane`, with one panel hidden.
    fn saved_without(pane: Pane) -> String {
        let mut dock = Dock::default();
        dock.set_visible(Pane::Profile, false);
        dock.tree.remove_recursively(dock.find(pane).unwrap());
        let text = dock.to_text();
        assert!(!text.contains(&format!("\"{pane:?}\"")), "{text}");
        text
    }

    fn tabs_with(dock: &Dock, pane: Pane) -> Vec<TileId> {
        let tabs = dock.tree.tiles.parent_of(dock.find(pane).unwrap()).unwrap();
        dock.tree.tiles.get_container(tabs).unwrap().children_vec()
    }

    #[test]
    fn a_saved_arrangement_gains_the_panel_that_it_lacks_and_keeps_the_others() {
        let whole = Dock::default();
        for pane in Pane::ALL {
            if pane == Pane::Profile {
                continue;
            }
            let dock = Dock::from_text(&saved_without(pane)).expect("it can be read");
            assert!(dock.is_visible(pane), "{pane:?} is back");
            assert!(!dock.is_visible(Pane::Profile), "a hidden panel stays hidden");
            for other in Pane::ALL.into_iter().filter(|&other| other != pane) {
                assert_eq!(dock.find(other), whole.find(other), "{other:?} is the same tile");
                let share_tabs = |dock: &Dock| tabs_with(dock, other).contains(&dock.find(pane).unwrap());
                assert_eq!(
                    share_tabs(&dock),
                    share_tabs(&whole),
                    "{pane:?} shares its tabs with {other:?} or not"
                );
            }
        }
    }

    #[test]
    fn an_arrangement_without_any_panel_gains_all_and_no_arrangement_is_none() {
        let empty = Dock { tree: Tree::empty(egui::Id::unique("dock")) };
        let dock = Dock::from_text(&empty.to_text()).unwrap();
        assert!(Pane::ALL.into_iter().all(|pane| dock.is_visible(pane)));
        assert!(Dock::from_text("{").is_none());
    }

    #[test]
    fn an_arrangement_stays_the_same_when_it_is_saved_and_read() {
        let text = Dock::default().to_text();
        assert_eq!(Dock::from_text(&text).unwrap().to_text(), text);
    }
}
