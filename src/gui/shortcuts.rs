//! The keyboard: one list, which decides what keys do and is shown as help.

mod debug;
mod shortcut;

pub use debug::{Listeners, SpaceTap};

use super::PanelContext;
use super::action::{Action, DebugAction};
use super::theme::SMALL_PT;
use crate::view::{Layer, Tool};
use egui::{Key, KeyboardShortcut, Modifiers, RichText, Ui};
use shortcut::Shortcut;

const fn plain(group: &'static str, key: Key, action: Action, words: &'static str) -> Shortcut {
    Shortcut::new(group, Modifiers::NONE, key, action, words)
}

const fn command(group: &'static str, key: Key, action: Action, words: &'static str) -> Shortcut {
    Shortcut::new(group, Modifiers::COMMAND, key, action, words)
}

const SHIFT_COMMAND: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// All keys.
fn all() -> impl Iterator<Item = &'static Shortcut> {
    GENERAL.iter().chain(debug::KEYS)
}

/// The keys that are not the debugger's. Those with more modifiers come first: egui lets `Ctrl+Shift+Z` pass for `Ctrl+Z`.
const GENERAL: &[Shortcut] = &[
    Shortcut::new("Edit", SHIFT_COMMAND, Key::Z, Action::Redo, "Redo"),
    command("File", Key::O, Action::Open, "Open a photograph"),
    command("File", Key::E, Action::Export, "Export"),
    command("File", Key::S, Action::Save, "Save the workspace"),
    command("Edit", Key::Z, Action::Undo, "Undo"),
    command("Edit", Key::Y, Action::Redo, "Redo"),
    command("Edit", Key::I, Action::Invert, "Invert the marked pixels"),
    command("Edit", Key::A, Action::MarkRegion, "Mark the pixels of the selected region"),
    plain("Edit", Key::Escape, Action::Escape, "Give up the gesture; select and mark nothing"),
    plain("Edit", Key::CloseBracket, Action::Region(true), "Select the next region"),
    plain("Edit", Key::OpenBracket, Action::Region(false), "Select the region before"),
    plain("Image", Key::Num1, Action::Layer(Layer::Input), "Input"),
    plain("Image", Key::Num2, Action::Layer(Layer::Masks), "Masks: dark, clipped, bloomed"),
    plain("Image", Key::Num3, Action::Layer(Layer::Classes), "Classification"),
    plain("Image", Key::Num4, Action::Layer(Layer::Areas), "Merged areas"),
    plain("Image", Key::Num5, Action::Layer(Layer::Linear), "Linear hypotheses"),
    plain("Image", Key::Num6, Action::Layer(Layer::Planar), "Planar hypotheses"),
    plain("Image", Key::Num7, Action::Layer(Layer::Regions), "Final regions"),
    plain("Image", Key::Num8, Action::Layer(Layer::Body), "Body reflection"),
    plain("Image", Key::Num9, Action::Layer(Layer::Surface), "Surface reflection"),
    plain("Image", Key::Num0, Action::Layer(Layer::Noise), "Noise"),
    plain("Image", Key::F, Action::Fit, "Fit the whole picture"),
    plain("Image", Key::Z, Action::OneToOne, "One point a pixel"),
    plain("Image", Key::O, Action::Outline, "Outlines or fills"),
    plain("Tools", Key::V, Action::Tool(Tool::Pointer), "Pointer: click selects, drag pans"),
    plain("Tools", Key::R, Action::Tool(Tool::Rectangle), "Rectangle"),
    plain("Tools", Key::L, Action::Tool(Tool::Lasso), "Lasso"),
    plain("Tools", Key::G, Action::Tool(Tool::Polygon), "Polygon"),
    plain("Tools", Key::B, Action::Tool(Tool::Brush), "Brush"),
    plain("Tools", Key::P, Action::Tool(Tool::Profile), "Profile line"),
    plain("Tools", Key::W, Action::Tool(Tool::WhitePatch), "White patch: pin the light's color"),
    plain("Compare", Key::K, Action::Pin, "Pin the result, or let it go"),
    plain("Compare", Key::A, Action::Swap, "A/B: pinned or newest result"),
    plain("Window", Key::T, Action::Theme, "Light or dark"),
    plain("Window", Key::Questionmark, Action::Help, "This list"),
    plain("Window", Key::F1, Action::Help, "This list"),
];

/// A window of this width has room for four columns of keys, points.
const FOUR_COLUMNS_PT: f32 = 1200.0;

/// What the pointer does, listed with the keys.
const POINTER: &[(&str, &str)] = &[
    ("Scroll", "zoom at the pointer"),
    ("Drag", "pan the image, orbit the color space"),
    ("Middle drag, Space drag", "pan, whatever the tool"),
    ("Double-click", "fit a view; reset a slider to its default"),
    ("Shift + click on the timeline", "run there, or to a breakpoint on the way"),
    ("Shift + mark", "add to what is marked"),
    ("Alt + mark", "take away from what is marked"),
    ("Arrow keys on a slider", "one step"),
    ("Arrow keys, + \u{2212} on the cube", "orbit, zoom"),
    ("X Y U D S E M on the cube", "named views, see its menu"),
];

/// The keys of an action as text, for menus and tooltips; empty where it has none.
pub fn keys_of(ctx: &egui::Context, action: Action) -> String {
    let found = all().find(|shortcut| shortcut.action == action);
    found.map_or_else(String::new, |shortcut| written(ctx, shortcut.keys))
}

/// Keys as they are printed on a keyboard.
fn written(ctx: &egui::Context, keys: KeyboardShortcut) -> String {
    let all = ctx.format_shortcut(&keys);
    let symbol = match keys.logical_key {
        // Of these the bundled fonts have no other sign.
        Key::ArrowLeft => "\u{2190}",
        Key::ArrowRight => "\u{2192}",
        key => key.symbol_or_name(),
    };
    all.strip_suffix(keys.logical_key.name()).map_or_else(|| all.clone(), |held| format!("{held}{symbol}"))
}

/// The actions whose keys were pressed; none while a text is being edited. `escape_is_meant`: whether Escape is an action, and
/// does not close something that is open over the panels.
pub fn pressed(
    ctx: &egui::Context,
    escape_is_meant: bool,
    listeners: Listeners,
    tap: &mut SpaceTap,
) -> Vec<Action> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    let meant: Vec<&Shortcut> = all()
        .filter(|shortcut| escape_is_meant || shortcut.action != Action::Escape)
        .filter(|shortcut| listeners.leave(ctx, shortcut))
        .collect();
    let (taps, keys): (Vec<&Shortcut>, Vec<&Shortcut>) =
        meant.into_iter().partition(|shortcut| shortcut.keys.logical_key == Key::Space);
    let tapped = tap.tapped(ctx, !taps.is_empty());
    let mut actions: Vec<Action> = ctx.input_mut(|input| {
        keys.iter()
            .filter(|shortcut| input.consume_shortcut(&shortcut.keys))
            .map(|shortcut| shortcut.action)
            .collect()
    });
    actions.extend(tapped.map(|direction| Action::Debug(DebugAction::Play(direction))));
    actions
}

/// Shows the list of keys, in a window that stays until it is closed.
pub fn show_help(ui: &mut Ui, cx: &PanelContext, open: &mut bool) {
    let ctx = ui.ctx().clone();
    let columns: &[&[&str]] = if ctx.content_rect().width() >= FOUR_COLUMNS_PT {
        &[&["File", "Edit", "Compare", "Window"], &["Image"], &["Decisions"], &["Tools", "Pointer"]]
    } else {
        &[&["File", "Edit", "Compare", "Window"], &["Image", "Decisions"], &["Tools", "Pointer"]]
    };
    egui::Window::new("Keyboard and pointer")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .scroll(true)
        .min_width(880.0)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .show(&ctx, |ui| {
            ui.horizontal_top(|ui| {
                for groups in columns {
                    ui.vertical(|ui| groups.iter().for_each(|group| list(ui, cx, group)));
                    ui.add_space(12.0);
                }
            });
        });
}

fn list(ui: &mut Ui, cx: &PanelContext, group: &str) {
    super::widgets::heading(ui, cx.tones, group);
    let rows: Vec<(String, &str)> = if group == "Pointer" {
        POINTER.iter().map(|&(keys, words)| (keys.to_owned(), words)).collect()
    } else {
        let of_group = all().filter(|shortcut| shortcut.group == group);
        of_group.map(|shortcut| (written(ui.ctx(), shortcut.keys), shortcut.words)).collect()
    };
    egui::Grid::new(group).num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        for (keys, words) in rows {
            ui.label(RichText::new(keys).size(SMALL_PT).color(cx.tones.accent));
            ui.label(words);
            ui.end_row();
        }
    });
}
