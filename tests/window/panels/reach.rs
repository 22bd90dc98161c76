//! Everything that the pointer can press in the panels has a command in the palette, or a reason for which it has none.

use crate::window::{Fixture, Window, apply, press, region, with_gpu};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::params::Switch;
use egui::accesskit::{Action, Role};
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use std::collections::BTreeSet;

/// The controls whose commands do not begin with their names, with the beginnings of the commands' names.
const OTHER_NAMES: &[(&str, &str)] = &[
    ("1:1", "Image: Zoom to 100 %"),
    ("A pinned", "Compare: A/B"),
    ("B newest", "Compare: A/B"),
    ("By label", "Plane: Color by label"),
    ("Color space: lasso", "Tools: Lasso"),
    ("Color space: pointer", "Tools: Pointer"),
    ("Color space: polygon", "Tools: Polygon"),
    ("Color space: rectangle", "Tools: Rectangle"),
    ("Copy", "Regions: Copy the table"),
    ("Deselect", "Edit: Give up the gesture; select and mark nothing"),
    ("Difference image", "Image: layer difference"),
    ("Draw it in color space and plane", "Geometry: Draw the sphere"),
    ("Event back", "Decisions: An event back"),
    ("Event forward", "Decisions: An event forward"),
    ("Export\u{2026}", "Export: pixels of the selected region"),
    ("Fit", "Image: Zoom to fit"),
    ("Fit skewed T to the marked", "Edit: Fit a skewed T to the marked pixels"),
    ("Home", "Color space: Reset the view"),
    ("Hypothesis back", "Decisions: A hypothesis back"),
    ("Hypothesis forward", "Decisions: A hypothesis forward"),
    ("Keep as a named mark", "Edit: Keep the marked pixels as a named mark"),
    ("Lift", "Analyze: The whole picture"),
    ("Mark its pixels", "Edit: Mark the pixels of the selected region"),
    ("Next change of the selected region", "Decisions: The next change of what is selected"),
    ("Next breakpoint", "Decisions: The next breakpoint"),
    ("Open Export\u{2026}", "File: Export"),
    ("Own color", "Plane: Color by own color"),
    ("Pause", "Decisions: Play, or rest"),
    ("Plane: lasso", "Plane: Lasso"),
    ("Plane: pointer", "Plane: Pointer"),
    ("Restrict to them", "Analyze: Only the marked pixels"),
    ("Run to its next change", "Decisions: The next change of what is selected"),
    ("Show its plane", "Show: Plane"),
    ("Stage back", "Decisions: A stage back"),
    ("Stage forward", "Decisions: A stage forward"),
    ("Statistics", "Show: Selection"),
    ("Stop recording", "Decisions: Record decisions"),
    ("To marked", "Analyze: Only the marked pixels"),
    ("Unpin", "Compare: Pin the result, or unpin it"),
    ("ambient automatic", "Analyze: Ambient light found"),
    ("by-hand", "Analyze: Skewed T by hand"),
    ("column", "Profile: Along the column"),
    ("line", "Tools: Profile line"),
    ("paper", "Analyze: Paper's method"),
    ("phoenix", "Analyze: Phoenix"),
    ("pin illuminant", "Analyze: Pin the light"),
    ("pin second lamp", "Analyze: Pin the second lamp"),
    ("refined", "Analyze: Refined method"),
    ("row", "Profile: Along the row"),
    ("top-down", "Analyze: Top-down clusters"),
];

/// Why controls have no command, with the beginnings of their names.
const WITHOUT_COMMAND: &[(&str, &[&str])] = &[
    (
        "opens a list whose choices are commands",
        &[
            "Color by",
            "Color space shown",
            "Layer",
            "Run to",
            "Show",
            "Views",
            "Stages and passes",
            "Windows and areas (5.2)",
            "Linear hypotheses (5.3)",
            "Highlights and planes (5.4)",
            "Clipping, numbers, vectors (5.5, 6)",
            "Where no region holds",
        ],
    ),
    ("opens a list of values, or sets a value", &["Display", "Grain", "Add breakpoint"]),
    (
        "sorts a table by a column",
        &["#", "angle", "body C_b", "highlight", "notes", "pixels", "rms", "surface C_s"],
    ),
    ("shows or hides a curve of the profile", &["R", "G", "B", "body m_b", "surface m_s", "noise \u{3b5}"]),
    (
        "leads from a sentence about one result to its step",
        &["hypothesis ", "slice of hypothesis ", "what is left of "],
    ),
];

/// Names of all that can be pressed, but for links inside of sentences, which lead to what the sentence is about.
fn pressable(window: &Window) -> BTreeSet<String> {
    let roles = [Role::Button, Role::CheckBox, Role::RadioButton, Role::ComboBox];
    let nodes = window.root().children_recursive().map(|node| node.accesskit_node());
    nodes
        .filter(|node| roles.contains(&node.role()) && node.data().supports_action(Action::Click))
        .filter_map(|node| node.label())
        .collect()
}

/// Whether one of the commands does what a control of this name does.
fn has_command(name: &str, commands: &BTreeSet<String>) -> bool {
    // A control of a menu has its key behind its name, as commands have.
    let is_named =
        |known: &str| name.strip_prefix(known).is_some_and(|key| key.is_empty() || key.starts_with(' '));
    // "Fit" is the beginning of another control's name.
    if let Some((_, command)) = OTHER_NAMES.iter().rev().find(|(control, _)| is_named(control)) {
        return commands.iter().any(|known| known.to_lowercase().starts_with(&command.to_lowercase()));
    }
    let name = name.trim_end_matches('\u{2026}').to_lowercase();
    commands.iter().filter_map(|command| command.split_once(": ")).any(|(_, command)| {
        let command = command.to_lowercase();
        command.starts_with(&name) || name.len() > 6 && name.starts_with(command.trim_end())
    })
}

/// Whether a control of this name needs no command: a switch or number of the parameters, or one of [`WITHOUT_COMMAND`].
fn needs_none(name: &str) -> bool {
    let is_switch = Switch::ALL.iter().any(|switch| switch.name().replace('_', " ") == name);
    let is_number = name.ends_with(" auto");
    let mut reasons = WITHOUT_COMMAND.iter().flat_map(|(_, names)| names.iter());
    is_switch
        || is_number
        || reasons.any(|known| {
            *known == name
                || known.len() > 9 && name.starts_with(known)
                || name == format!("{known}, ascending")
        })
}

#[test]
fn what_the_pointer_can_press_has_a_command_or_a_reason_for_none() {
    let Some(mut window) = with_gpu(vec2(1200.0, 900.0), Fixture::Tiny) else { return };
    let before = pressable(&window);
    press(&mut window, Modifiers::COMMAND, Key::P);
    let commands: BTreeSet<String> = pressable(&window).difference(&before).cloned().collect();
    assert!(commands.len() > 250, "{}", commands.len());
    press(&mut window, Modifiers::NONE, Key::Escape);
    apply(&mut window, Edit::Select(Some(region(1))));
    apply(&mut window, ViewCommand::Pin(true));
    press(&mut window, Modifiers::COMMAND, Key::A);
    let mut missing = BTreeSet::new();
    let mut controls = 0;
    let mut look = |window: &Window, place: &str| {
        let shown = pressable(window);
        controls += shown.len();
        let forgotten = shown.iter().filter(|name| !has_command(name, &commands) && !needs_none(name));
        missing.extend(forgotten.map(|name| format!("{place}: {name}")));
    };
    for pane in Pane::ALL {
        window.state_mut().show_alone(Some(pane));
        window.run_steps(3);
        look(&window, pane.title());
        for menu in [("Color space", "Show"), ("Color space", "Views"), ("Timeline", "Run to")] {
            if menu.0 == pane.title() {
                window.get_by_role_and_label(Role::Button, menu.1).click();
                window.run_steps(3);
                look(&window, menu.1);
                press(&mut window, Modifiers::NONE, Key::Escape);
            }
        }
    }
    assert!(controls > 150, "{controls}");
    assert!(missing.is_empty(), "neither a command nor a reason for none: {missing:#?}");
}
