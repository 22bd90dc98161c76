//! The list of all keys: the actions of the keys, and the help that shows them.

mod debug;
mod shortcut;

pub use debug::{KeyListeners, SpaceTap};

use super::action::{Action, DebugAction, TextStep, ViewStep};
use super::keyboard_focus::is_keyboard_owned;
use super::theme::SMALL_PT;
use super::{PanelContext, dialog_room};
use crate::app::Switching;
use crate::view::{Layer, Tool};
use egui::{Key, KeyboardShortcut, Modifiers, RichText, Ui};
use shortcut::Shortcut;

/// A key without modifiers.
const fn key_alone(group: &'static str, key: Key, action: Action, description: &'static str) -> Shortcut {
    Shortcut::new(group, Modifiers::NONE, key, action, description)
}

/// A key with Ctrl, on a Mac with Command.
const fn key_with_command(
    group: &'static str,
    key: Key,
    action: Action,
    description: &'static str,
) -> Shortcut {
    Shortcut::new(group, Modifiers::COMMAND, key, action, description)
}

/// Shift and Ctrl, on a Mac Shift and Command.
const SHIFT_COMMAND: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// A key that moves the picture. The arrow keys with fewer modifiers step the debugger.
const fn pan(key: Key, step: ViewStep, description: &'static str) -> Shortcut {
    Shortcut::new("Image", SHIFT_COMMAND, key, Action::View(step), description)
}

/// All keys, in the order in which the help lists them.
fn all_shortcuts() -> impl Iterator<Item = &'static Shortcut> {
    GENERAL.iter().chain(debug::KEYS)
}

/// The group, the description and the action of each key.
pub fn named_actions() -> impl Iterator<Item = (&'static str, &'static str, Action)> {
    all_shortcuts().map(|shortcut| (shortcut.group, shortcut.description, shortcut.action))
}

/// The keys that are not the debugger's.
const GENERAL: &[Shortcut] = &[
    key_with_command("File", Key::O, Action::Open, "Open a photograph"),
    key_with_command("File", Key::E, Action::Export, "Export"),
    key_with_command("File", Key::S, Action::Save, "Save the workspace"),
    Shortcut::new(
        "File",
        Modifiers::CTRL.plus(Modifiers::SHIFT),
        Key::Tab,
        Action::Switch(Switching::Previous),
        "The open photograph before",
    ),
    Shortcut::new(
        "File",
        Modifiers::CTRL,
        Key::Tab,
        Action::Switch(Switching::Next),
        "The next open photograph",
    ),
    key_with_command("File", Key::PageDown, Action::Switch(Switching::Next), "The next open photograph"),
    key_with_command("File", Key::PageUp, Action::Switch(Switching::Previous), "The open photograph before"),
    key_with_command("File", Key::W, Action::ClosePhotograph, "Close the photograph, where others are open"),
    key_with_command("File", Key::D, Action::ComparePhotographs, "Compare the next open photograph beside"),
    key_with_command("File", Key::Q, Action::Quit, "Quit"),
    key_with_command("Edit", Key::Z, Action::Undo, "Undo"),
    Shortcut::new("Edit", SHIFT_COMMAND, Key::Z, Action::Redo, "Redo"),
    key_with_command("Edit", Key::Y, Action::Redo, "Redo"),
    key_with_command("Edit", Key::I, Action::Invert, "Invert the marked pixels"),
    key_with_command("Edit", Key::A, Action::MarkRegion, "Mark the pixels of the selected region"),
    key_with_command("Edit", Key::M, Action::KeepMark, "Keep the marked pixels as a named mark"),
    key_with_command("Edit", Key::T, Action::FitSkewedT, "Fit a skewed T to the marked pixels"),
    key_alone("Edit", Key::Escape, Action::Escape, "Give up the gesture; select and mark nothing"),
    key_alone("Analyze", Key::F5, Action::Analyze, "Analyze now, with the present parameters"),
    key_alone(
        "Analyze",
        Key::Escape,
        Action::CancelAnalysis,
        "Cancel the analysis, or the recording of its decisions",
    ),
    key_alone("Edit", Key::CloseBracket, Action::Region(true), "Select the next region"),
    key_alone("Edit", Key::OpenBracket, Action::Region(false), "Select the region before"),
    key_alone("Image", Key::Num1, Action::Layer(Layer::Input), "Input"),
    key_alone("Image", Key::Num2, Action::Layer(Layer::Masks), "Masks: dark, clipped, bloomed"),
    key_alone("Image", Key::Num3, Action::Layer(Layer::Classes), "Classification"),
    key_alone("Image", Key::Num4, Action::Layer(Layer::Areas), "Merged areas"),
    key_alone("Image", Key::Num5, Action::Layer(Layer::Linear), "Linear hypotheses"),
    key_alone("Image", Key::Num6, Action::Layer(Layer::Planar), "Planar hypotheses"),
    key_alone("Image", Key::Num7, Action::Layer(Layer::Regions), "Final regions"),
    key_alone("Image", Key::Num8, Action::Layer(Layer::Body), "Body reflection"),
    key_alone("Image", Key::Num9, Action::Layer(Layer::Surface), "Surface reflection"),
    key_alone("Image", Key::Num0, Action::Layer(Layer::Noise), "Noise"),
    key_alone("Image", Key::Plus, Action::View(ViewStep::ZoomIn), "Zoom in"),
    key_alone("Image", Key::Equals, Action::View(ViewStep::ZoomIn), "Zoom in"),
    key_alone("Image", Key::Minus, Action::View(ViewStep::ZoomOut), "Zoom out"),
    key_alone("Image", Key::F, Action::Fit, "Zoom to fit: the whole picture"),
    key_alone("Image", Key::Z, Action::OneToOne, "Zoom to 100 %: one point a pixel"),
    pan(Key::ArrowLeft, ViewStep::Left, "Pan to the left"),
    pan(Key::ArrowRight, ViewStep::Right, "Pan to the right"),
    pan(Key::ArrowUp, ViewStep::Up, "Pan to the top"),
    pan(Key::ArrowDown, ViewStep::Down, "Pan to the bottom"),
    key_alone("Image", Key::O, Action::Outline, "Outlines or fills"),
    key_alone("Image", Key::H, Action::LockReadout, "Lock the readout to the selected pixel"),
    key_alone("Tools", Key::V, Action::Tool(Tool::Pointer), "Pointer: click selects, drag pans"),
    key_alone("Tools", Key::R, Action::Tool(Tool::Rectangle), "Rectangle"),
    key_alone("Tools", Key::L, Action::Tool(Tool::Lasso), "Lasso"),
    key_alone("Tools", Key::G, Action::Tool(Tool::Polygon), "Polygon"),
    key_alone("Tools", Key::B, Action::Tool(Tool::Brush), "Brush"),
    key_alone("Tools", Key::P, Action::Tool(Tool::Profile), "Profile line"),
    key_alone(
        "Tools",
        Key::W,
        Action::Tool(Tool::WhitePatch),
        "White patch: pin the light's color, with Shift the second lamp's",
    ),
    key_alone("Compare", Key::K, Action::Pin, "Pin the result, or unpin it"),
    key_alone("Compare", Key::A, Action::Swap, "A/B: pinned or newest result"),
    key_with_command("Window", Key::P, Action::Palette, "All commands by name"),
    key_alone("Window", Key::F10, Action::Menus, "The menus; Alt and a first letter opens one"),
    key_alone("Window", Key::T, Action::Theme, "Light or dark theme"),
    key_with_command("Window", Key::Plus, Action::TextSize(TextStep::Larger), "Larger text and controls"),
    key_with_command("Window", Key::Equals, Action::TextSize(TextStep::Larger), "Larger text and controls"),
    key_with_command("Window", Key::Minus, Action::TextSize(TextStep::Smaller), "Smaller text and controls"),
    key_with_command(
        "Window",
        Key::Num0,
        Action::TextSize(TextStep::AsAtFirst),
        "Text and controls as at first",
    ),
    key_alone("Window", Key::Questionmark, Action::Help, "The list of keys and of the pointer"),
    key_alone("Window", Key::F1, Action::Help, "The list of keys and of the pointer"),
];

/// A window of this width has room for four columns of keys, points.
const FOUR_COLUMNS_PT: f32 = 1200.0;

/// A window of this width has room for three columns of keys, points.
const THREE_COLUMNS_PT: f32 = 1000.0;

/// A window of this width has room for two columns of keys, points.
const TWO_COLUMNS_PT: f32 = 560.0;

/// Width of the column of keys in the help, points.
const KEYS_PT: f32 = 130.0;

/// Width of the widest column of the help, points.
const WIDEST_COLUMN_PT: f32 = 330.0;

/// Distance between the columns of the help, points.
const GAP_PT: f32 = 12.0;

/// The effects of the pointer, which the help lists beside the keys.
const POINTER_HELP: &[(&str, &str)] = &[
    ("Scroll", "zoom at the pointer"),
    ("Drag", "pan the image, orbit the color space"),
    ("Middle drag, Space drag", "pan, whatever the tool"),
    ("Double-click", "fit a view; reset a slider to its default"),
    ("Shift + click on the timeline", "run there, or to a breakpoint on the way"),
    ("Shift + mark", "add to what is marked"),
    ("Alt + mark", "take away from what is marked"),
    ("C, held", "the photograph in place of the layers, or the body in place of the photograph"),
    ("Arrow keys on a slider", "one step"),
    ("Arrow keys, + \u{2212} on the cube", "orbit, zoom"),
    ("X Y U D S E M on the cube", "named views, see its menu"),
];

/// The keys of an action as text, for menus and tooltips; empty for an action without keys.
pub fn keys_of(ctx: &egui::Context, action: Action) -> String {
    let shortcut = all_shortcuts().find(|shortcut| shortcut.action == action);
    shortcut.map_or_else(String::new, |shortcut| keys_as_text(ctx, shortcut.keys))
}

/// Keys as they are printed on a keyboard.
fn keys_as_text(ctx: &egui::Context, keys: KeyboardShortcut) -> String {
    let text = ctx.format_shortcut(&keys);
    let symbol = match keys.logical_key {
        // The bundled fonts have these arrows, and not those of egui's symbols.
        Key::ArrowLeft => "\u{2190}",
        Key::ArrowRight => "\u{2192}",
        Key::ArrowUp => "\u{2191}",
        Key::ArrowDown => "\u{2193}",
        key => key.symbol_or_name(),
    };
    text.strip_suffix(keys.logical_key.name())
        .map_or_else(|| text.clone(), |modifiers| format!("{modifiers}{symbol}"))
}

/// The actions whose keys were pressed, and what was typed after a key that opens a field for text; none while a text is being edited
/// or a menu is open. `escape_is_action`: whether Escape has an action; otherwise Escape closes a dialog or a menu.
pub fn pressed(
    ctx: &egui::Context,
    escape_is_action: bool,
    listeners: KeyListeners,
    space_tap: &mut SpaceTap,
) -> (Vec<Action>, Vec<egui::Event>) {
    if is_keyboard_owned(ctx) {
        return (Vec::new(), Vec::new());
    }
    let active: Vec<&Shortcut> = all_shortcuts()
        .filter(|shortcut| escape_is_action || shortcut.keys.logical_key != Key::Escape)
        .filter(|shortcut| listeners.allows(ctx, shortcut))
        .collect();
    let (space_shortcuts, keys): (Vec<&Shortcut>, Vec<&Shortcut>) =
        active.into_iter().partition(|shortcut| shortcut.keys.logical_key == Key::Space);
    let released = space_tap.released(ctx, !space_shortcuts.is_empty());
    let (mut actions, typed) = ctx.input_mut(|input| take_actions(&mut input.events, &keys));
    actions.extend(released.map(|direction| Action::Debug(DebugAction::Play(direction))));
    (actions, typed)
}

/// Whether an event is of a key, of typed text or of the clipboard.
pub const fn is_of_keyboard(event: &egui::Event) -> bool {
    use egui::Event;
    matches!(
        event,
        Event::Key { .. } | Event::Text(_) | Event::Ime(_) | Event::Copy | Event::Cut | Event::Paste(_)
    )
}

/// Takes the events of the keys of `shortcuts` out of `events`, and returns their actions in the order of the events: a key that is pressed
/// twice within a slow frame counts twice. What is typed after a key that opens a field for text is meant for the field: it is taken out,
/// too, and returned beside the actions.
fn take_actions(events: &mut Vec<egui::Event>, shortcuts: &[&Shortcut]) -> (Vec<Action>, Vec<egui::Event>) {
    let (mut actions, mut typed): (Vec<Action>, Vec<egui::Event>) = Default::default();
    events.retain(|event| {
        if actions.last().is_some_and(|action| action.asks_for_text()) && is_of_keyboard(event) {
            typed.push(event.clone());
            return false;
        }
        let egui::Event::Key { key, physical_key, pressed: true, modifiers, .. } = event else {
            return true;
        };
        let of_digit = physical_key.and_then(|key| shortcut_of_digit(key, *modifiers, shortcuts));
        let of_key = || {
            let is_pressed = |KeyboardShortcut { modifiers: wanted, logical_key }| {
                *key == logical_key && modifiers.matches_logically(wanted)
            };
            // egui lets `Ctrl+Shift+Z` pass for `Ctrl+Z`: of several keys, the one with the most modifiers is meant.
            let pressed = shortcuts.iter().filter(|shortcut| is_pressed(shortcut.keys));
            pressed.max_by_key(|shortcut| modifier_count(shortcut.keys.modifiers))
        };
        let shortcut = of_digit.or_else(of_key);
        actions.extend(shortcut.map(|shortcut| shortcut.action));
        shortcut.is_none()
    });
    (actions, typed)
}

/// Number of the keys that modify another key.
fn modifier_count(modifiers: Modifiers) -> usize {
    let Modifiers { alt, ctrl, shift, command, .. } = modifiers;
    [alt, ctrl, shift, command].into_iter().filter(|&is_held| is_held).count()
}

/// The shortcut of a digit key. The place of a key decides, as the key cap may show something else: the key 6 of a French keyboard is a
/// minus sign, which is another action's key elsewhere.
fn shortcut_of_digit<'a>(
    key: Key,
    modifiers: Modifiers,
    shortcuts: &'a [&'a Shortcut],
) -> Option<&'a &'a Shortcut> {
    let is_digit = (Key::Num0..=Key::Num9).contains(&key) && modifiers.is_none();
    let is_of_key = |shortcut: &&&Shortcut| {
        is_digit && shortcut.keys.logical_key == key && shortcut.keys.modifiers.is_none()
    };
    shortcuts.iter().find(is_of_key)
}

/// Shows the list of keys in a window of its own, until a person closes the window.
pub fn show_help(ui: &mut Ui, cx: &PanelContext, open: &mut bool) {
    let ctx = ui.ctx().clone();
    let room = ctx.content_rect().size();
    let columns: &[&[&str]] = if room.x >= FOUR_COLUMNS_PT {
        &[
            &["File", "Edit", "Analyze", "Compare"],
            &["Image"],
            &["Decisions", "Window"],
            &["Tools", "Pointer"],
        ]
    } else if room.x >= THREE_COLUMNS_PT {
        &[&["File", "Edit", "Analyze", "Compare"], &["Image", "Decisions"], &["Tools", "Pointer", "Window"]]
    } else if room.x >= TWO_COLUMNS_PT {
        &[&["File", "Edit", "Analyze", "Image", "Compare"], &["Window", "Decisions", "Tools", "Pointer"]]
    } else {
        &[&["File", "Edit", "Analyze", "Image", "Compare", "Window", "Decisions", "Tools", "Pointer"]]
    };
    // The window with its margins and its bar is never wider than the room.
    let column_pt = ((room.x - 60.0) / columns.len() as f32 - GAP_PT).clamp(60.0, WIDEST_COLUMN_PT);
    let height = dialog_room::height(&ctx);
    // egui keeps the height of a window by its id: in a larger room the list would stay as low as in the smaller one before.
    let id = egui::Id::unique("keyboard and pointer").with(height as u32);
    let shown = egui::Window::new("Keyboard and pointer")
        .id(id)
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .show(&ctx, |ui| {
            dialog_room::scrolling(ui, "keys", height, |ui| {
                ui.horizontal_top(|ui| {
                    for groups in columns {
                        of_width(ui, column_pt, |ui| {
                            groups.iter().for_each(|group| show_group(ui, cx, group, column_pt));
                        });
                    }
                });
            });
        });
    // The place of the window follows from the size of the frame before.
    if shown.is_some_and(|shown| !ctx.content_rect().contains_rect(shown.response.rect)) {
        ctx.request_repaint();
    }
}

/// Shows a group of keys with its heading; long descriptions wrap in a column of `column_pt` points.
fn show_group(ui: &mut Ui, cx: &PanelContext, group: &str, column_pt: f32) {
    super::widgets::heading(ui, cx.palette, group);
    let rows: Vec<(String, &str)> = if group == "Pointer" {
        POINTER_HELP.iter().map(|&(keys, description)| (keys.to_owned(), description)).collect()
    } else {
        let of_group = all_shortcuts().filter(|shortcut| shortcut.group == group);
        of_group.map(|shortcut| (keys_as_text(ui.ctx(), shortcut.keys), shortcut.description)).collect()
    };
    // Widths that do not depend on an earlier frame: the list is whole in its first frame.
    ui.spacing_mut().item_spacing = egui::vec2(GAP_PT, 3.0);
    let keys_pt = KEYS_PT.min(0.5 * column_pt);
    for (keys, description) in rows {
        ui.horizontal_top(|ui| {
            of_width(ui, keys_pt, |ui| {
                // The smaller letters stand on the line of the larger ones.
                ui.add_space(1.5);
                ui.add(egui::Label::new(RichText::new(keys).size(SMALL_PT).color(cx.palette.accent)).wrap());
            });
            of_width(ui, column_pt - keys_pt - GAP_PT, |ui| {
                ui.add(egui::Label::new(description).wrap());
            });
        });
    }
}

/// Shows contents in a column of a width, points.
fn of_width(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui)) {
    ui.vertical(|ui| {
        ui.set_width(width);
        contents(ui);
    });
}
