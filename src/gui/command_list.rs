//! The list of all commands by name, which the command palette shows.

use super::action::{Action, CubeAction, DebugAction, Lamp, LayerFile, PixelSet};
use super::cube_choices::{COLORINGS, CUBE_BOXES, NamedView};
use super::menu::{READINGS, THEMES, method_name};
use super::pane::Pane;
use super::shortcuts::named_actions;
use crate::gpu::Preset;
use crate::params::{self, Method};
use crate::trace::Kind;
use crate::truth::sample::SAMPLES;
use crate::view::{ArrangementKind, ColorSpace, ElsewhereKind, Layer, Tool};

/// An action with the name under which it is found.
pub struct Entry {
    /// What is done.
    pub action: Action,
    /// Group and name, such as "Image: Body reflection".
    pub name: String,
}

/// The commands that are no choices of a list.
const OTHERS: [(Action, &str); 38] = [
    (Action::OpenWorkspace, "File: Open a workspace"),
    (Action::SaveWorkspaceAs, "File: Save the workspace as another file"),
    (Action::ThreeLamps, "File: Open the sample scenes of three lamps"),
    (Action::ForgetRecent, "File: Forget the photographs opened before"),
    (Action::LoadParameters, "Analyze: Load parameters"),
    (Action::SaveParameters, "Analyze: Save parameters"),
    (Action::ResetParameters, "Analyze: Reset the parameters to the method's defaults"),
    (Action::PinLamp(Lamp::First), "Analyze: Pin the light, or let it be found"),
    (Action::PinLamp(Lamp::Second), "Analyze: Pin the second lamp, or let it be sought"),
    (Action::AmbientAuto, "Analyze: Ambient light found, or none"),
    (Action::FindWhatIf, "Analyze: Find what would change the clicked pixel, or stop that"),
    (Action::CancelExport, "Export: cancel the export under way"),
    (Action::ReleaseMark, "Edit: Mark something else than the named mark"),
    (Action::PlaneByLabel(true), "Plane: Color by label"),
    (Action::PlaneByLabel(false), "Plane: Color by own color"),
    (Action::PlaneTool(Tool::Pointer), "Plane: Pointer"),
    (Action::PlaneTool(Tool::Lasso), "Plane: Lasso"),
    (Action::Profile(false), "Profile: Along the row"),
    (Action::Profile(true), "Profile: Along the column"),
    (Action::CopyProfile, "Profile: Copy the numbers"),
    (Action::CopyRegions, "Regions: Copy the table"),
    (Action::DrawSphere, "Geometry: Draw the sphere in color space and plane, or not"),
    (Action::PinAnew, "Compare: Pin anew"),
    (Action::FirstDifference, "Compare: First decision that differs"),
    (Action::Debug(DebugAction::Loop), "Decisions: Loop, begin anew at the end"),
    (Action::Cube(CubeAction::Perspective), "Color space: Perspective or not"),
    (Action::Cube(CubeAction::Lock), "Color space: Lock the view, or let it follow the selected region"),
    (Action::DismissNotices, "Window: Dismiss all notices"),
    (Action::AnalyzeMarked, "Analyze: Only the marked pixels"),
    (Action::AnalyzeAll, "Analyze: The whole picture"),
    (Action::CopyCommandLine, "Analyze: Copy as command line"),
    (Action::OpenElsewhere(ElsewhereKind::Labels), "File: Open a label map of another program"),
    (Action::OpenElsewhere(ElsewhereKind::Diffuse), "File: Open a diffuse picture of another program"),
    (Action::CloseElsewhere(ElsewhereKind::Labels), "File: Close the label map of another program"),
    (Action::CloseElsewhere(ElsewhereKind::Diffuse), "File: Close the diffuse picture of another program"),
    (Action::ExportPixels(PixelSet::Marked), "Export: marked pixels"),
    (Action::ExportPixels(PixelSet::SelectedRegion), "Export: pixels of the selected region"),
    (Action::ShowAll, "Window: Arrange the panels as at first"),
];

/// All actions. An action with several keys is listed once.
pub fn entries() -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    let keyed =
        named_actions().map(|(group, name, action)| Entry { action, name: format!("{group}: {name}") });
    let layers = Layer::ALL
        .into_iter()
        .map(|layer| Entry { action: Action::Layer(layer), name: format!("Image: layer {}", layer.name()) });
    let arrangements = ArrangementKind::ALL
        .into_iter()
        .map(|kind| Entry { action: Action::Arrange(kind), name: format!("Image: {}", kind.name()) });
    let second_layers = Layer::ALL.into_iter().map(|layer| Entry {
        action: Action::SecondLayer(layer),
        name: format!("Image: second layer {}", layer.name()),
    });
    let layer_files = Layer::ALL.into_iter().flat_map(|layer| {
        LayerFile::ALL.map(|file| Entry {
            action: Action::ExportLayer(layer, file),
            name: format!("Export: layer {} as {}", layer.name(), file.name()),
        })
    });
    let panes = Pane::ALL
        .into_iter()
        .map(|pane| Entry { action: Action::Show(pane), name: format!("Show: {}", pane.title()) });
    let goals = Kind::ALL.into_iter().map(|kind| Entry {
        action: Action::Debug(DebugAction::Next(kind)),
        name: format!("Decisions: Run to the next {}", kind.name()),
    });
    let others = OTHERS.map(|(action, name)| Entry { action, name: name.to_owned() });
    let of_menus = choices_of_menus();
    for entry in keyed
        .chain(layers)
        .chain(arrangements)
        .chain(second_layers)
        .chain(panes)
        .chain(of_menus)
        .chain(of_color_space())
        .chain(goals)
        .chain(layer_files)
        .chain(others)
    {
        let opens_a_list = matches!(entry.action, Action::Palette | Action::Menus);
        if !opens_a_list && entries.iter().all(|known| known.action != entry.action) {
            entries.push(entry);
        }
    }
    entries
}

/// The choices of menus: scenes, encodings, methods, columns of table 6 and themes.
fn choices_of_menus() -> impl Iterator<Item = Entry> {
    let samples = SAMPLES.iter().enumerate().map(|(index, sample)| {
        (Action::Sample(index), format!("File: Open the sample scene {}", sample.name))
    });
    let readings = READINGS
        .iter()
        .enumerate()
        .map(|(index, reading)| (Action::ReadAs(index), format!("File: Read as {}", reading.name)));
    let methods = Method::ALL
        .into_iter()
        .map(|method| (Action::Method(method), format!("Analyze: {}", method_name(method))));
    let presets = params::Preset::ALL
        .into_iter()
        .map(|preset| (Action::Preset(preset), format!("Analyze: Preset of table 6, {}", preset.title())));
    let themes =
        THEMES.into_iter().map(|(theme, name)| (Action::UseTheme(theme), format!("Window: {name} theme")));
    let all = samples.chain(readings).chain(methods).chain(presets).chain(themes);
    all.map(|(action, name)| Entry { action, name })
}

/// The choices of the color space view.
fn of_color_space() -> impl Iterator<Item = Entry> {
    let colorings = COLORINGS.into_iter().map(|(color_by, name, _)| {
        (CubeAction::ColorBy(color_by), format!("Color by {}", name.to_lowercase()))
    });
    let spaces =
        ColorSpace::ALL.into_iter().map(|space| (CubeAction::Space(space), format!("Show {}", space.name())));
    let views = NamedView::ALL.into_iter().map(|(view, _, name, _)| {
        // The home view is what brings a lost cube back.
        let name =
            if view == NamedView::Along(Preset::Home) { "Reset the view: the whole cube" } else { name };
        (CubeAction::View(view), name.to_owned())
    });
    let boxes = CUBE_BOXES
        .into_iter()
        .enumerate()
        .map(|(index, shown)| (CubeAction::Box(index), format!("{}, shown or not", shown.name)));
    let all = colorings.chain(spaces).chain(views).chain(boxes);
    all.map(|(action, name)| Entry { action: Action::Cube(action), name: format!("Color space: {name}") })
}
