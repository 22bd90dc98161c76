//! The breakpoints panel: a list of conditions that stop the debugger's cursor.

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::{
    Breakpoint, CandidateCheck, Command, Condition, DebugCommand, DebugSettings, Edit, SavedClass, State,
};
use crate::raster::{HypothesisId, PixelIndex};
use crate::view::Item;
use egui::accesskit::Role;
use egui::{ComboBox, DragValue, Response, RichText, ScrollArea, Ui, WidgetInfo};

/// Number of pixels in a new condition on a region's size.
const DEFAULT_PIXELS: u32 = 1000;

/// Width of a panel in which a breakpoint has one line, points.
const ONE_LINE_PT: f32 = 520.0;

/// Least and largest width of the choice of a breakpoint's kind, points.
const KIND_PT: [f32; 2] = [60.0, 138.0];

/// Indentation of a breakpoint's arguments in a line of their own, points.
const INDENT_PT: f32 = 40.0;

/// The kinds of conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ConditionKind {
    Pixel,
    Size,
    Rejected,
    Candidate,
    Class,
    Conflict,
}

impl ConditionKind {
    /// All kinds with names and tooltips.
    const ALL: [(Self, &'static str, &'static str); 6] = [
        (Self::Pixel, "pixel changes owner", "A region claims this pixel or gives it up (5.3.2, 5.4.2)."),
        (Self::Size, "region exceeds", "A region grows beyond so many pixels (5.3.2)."),
        (
            Self::Rejected,
            "hypothesis is rejected",
            "An area is passed over although it was large enough, or a region is given up, absorbed or dropped (5.3).",
        ),
        (Self::Candidate, "candidate fails", "A neighbor fails a test of highlight candidates (5.4.1)."),
        (Self::Class, "window has class", "A window is classified so (5.2.1)."),
        (Self::Conflict, "conflict between", "Two regions want the same pixel (5.3.2, 5.4.2)."),
    ];

    fn of(condition: Condition) -> Self {
        match condition {
            Condition::PixelChangesOwner(_) => Self::Pixel,
            Condition::RegionExceeds { .. } => Self::Size,
            Condition::HypothesisRejected => Self::Rejected,
            Condition::CandidateFails(_) => Self::Candidate,
            Condition::ClassIs(_) => Self::Class,
            Condition::Conflict(..) => Self::Conflict,
        }
    }

    /// A new condition of this kind, for the selected pixel or region.
    fn default_condition(self, state: &State) -> Condition {
        let hypothesis = chosen_hypothesis(state);
        match self {
            Self::Pixel => Condition::PixelChangesOwner(state.explained_pixel().unwrap_or_default()),
            Self::Size => Condition::RegionExceeds { hypothesis, pixels: DEFAULT_PIXELS },
            Self::Rejected => Condition::HypothesisRejected,
            Self::Candidate => Condition::CandidateFails(CandidateCheck::Any),
            Self::Class => Condition::ClassIs(SavedClass::Volume),
            Self::Conflict => Condition::Conflict(hypothesis, None),
        }
    }
}

/// The breakpoints panel. The breakpoints themselves are in the state.
#[derive(Default)]
pub struct BreakpointsPanel;

impl BreakpointsPanel {
    /// Shows the panel.
    #[allow(clippy::unused_self, reason = "as the other panels")]
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let mut breakpoints = cx.state.view.debug.breakpoints.clone();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                ui.horizontal_wrapped(|ui| {
                    let tip = "Playing, running and stepping into stop where its condition holds.";
                    if ui.button("Add breakpoint").on_hover_text(tip).clicked() {
                        let condition = kind_for_selection(cx.state).default_condition(cx.state);
                        breakpoints.push(Breakpoint { enabled: true, condition });
                    }
                    if breakpoints.is_empty() {
                        let text = "Playing stops where a condition holds.";
                        ui.label(RichText::new(text).color(cx.palette.secondary));
                    }
                });
                let mut removed = None;
                for (index, breakpoint) in breakpoints.iter_mut().enumerate() {
                    if ui.push_id(index, |ui| row(ui, cx, index, breakpoint)).inner {
                        removed = Some(index);
                    }
                }
                if let Some(index) = removed {
                    breakpoints.remove(index);
                }
            });
        });
        let before = &cx.state.view.debug;
        if breakpoints != before.breakpoints {
            let settings = DebugSettings { breakpoints, ..before.clone() };
            cx.send(Command::Debug(DebugCommand::Settings(settings)));
        }
    }
}

/// Shows one breakpoint, in a narrow panel with its arguments in a line of their own; returns whether the button "Remove" was clicked.
fn row(ui: &mut Ui, cx: &mut PanelContext, index: usize, breakpoint: &mut Breakpoint) -> bool {
    let number = index + 1;
    let has_one_line = ui.available_width() >= ONE_LINE_PT;
    let is_removed = ui.horizontal(|ui| {
        enabled_and_number(ui, cx, index, breakpoint);
        kind_control(ui, cx.state, number, &mut breakpoint.condition);
        if has_one_line {
            argument_controls(ui, cx, number, &mut breakpoint.condition);
        }
        remove_button(ui, number)
    });
    let has_arguments = breakpoint.condition != Condition::HypothesisRejected;
    if !has_one_line && has_arguments {
        ui.horizontal_wrapped(|ui| {
            ui.add_space(INDENT_PT);
            argument_controls(ui, cx, number, &mut breakpoint.condition);
        });
    }
    if cx.state.debugger.stopped_by == Some(index) {
        ui.label(RichText::new("stopped here").size(SMALL_PT).color(cx.palette.accent));
    }
    is_removed.inner
}

/// Text of the button that removes a breakpoint.
const REMOVE: &str = "Remove";

/// Width of the button that removes a breakpoint, points.
fn remove_width(ui: &Ui) -> f32 {
    let font = egui::TextStyle::Button.resolve(ui.style());
    let text = ui.painter().layout_no_wrap(REMOVE.to_owned(), font, egui::Color32::WHITE);
    text.size().x + 2.0 * ui.spacing().button_padding.x
}

/// Shows the button that removes a breakpoint; returns whether it was clicked.
fn remove_button(ui: &mut Ui, number: usize) -> bool {
    let remove = ui.small_button(REMOVE).on_hover_text("Take this breakpoint away.");
    remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Remove breakpoint {number}")));
    remove.clicked()
}

/// Shows whether a breakpoint is enabled, and its number, a click on which selects what it is about.
fn enabled_and_number(ui: &mut Ui, cx: &mut PanelContext, index: usize, breakpoint: &mut Breakpoint) {
    let number = index + 1;
    let stopped = cx.state.debugger.stopped_by == Some(index);
    let enabled = ui.checkbox(&mut breakpoint.enabled, "").on_hover_text("Whether it stops the cursor.");
    let on = breakpoint.enabled;
    enabled.widget_info(|| {
        WidgetInfo::selected(Role::CheckBox, true, on, format!("Breakpoint {number} enabled"))
    });
    let text_color = if stopped { cx.palette.accent } else { cx.palette.secondary };
    let tip = if stopped {
        "It stopped the cursor. Click to select what it is about."
    } else {
        "Click to select what it is about."
    };
    let name = egui::Button::new(RichText::new(number.to_string()).color(text_color)).frame(false);
    let label = ui.add(name).on_hover_text(tip);
    let words = format!("Breakpoint {number}{}", if stopped { ", stopped here" } else { "" });
    label.widget_info(|| WidgetInfo::labeled(Role::Button, true, &words));
    if label.clicked()
        && let Some(item) = item_of(cx.state, breakpoint.condition)
    {
        cx.send(Edit::Select(Some(item)));
    }
}

/// Shows the choice of the kind of a condition.
fn kind_control(ui: &mut Ui, state: &State, number: usize, condition: &mut Condition) {
    let kind = ConditionKind::of(*condition);
    let (_, name, tip) =
        ConditionKind::ALL.into_iter().find(|(known, ..)| *known == kind).unwrap_or(ConditionKind::ALL[0]);
    // The button that removes the breakpoint stays in the line.
    let [least, most] = KIND_PT;
    let room = ui.available_width() - remove_width(ui) - ui.spacing().item_spacing.x;
    let width = room.clamp(least, most);
    let combo = ui.scope(|ui| {
        // A long name is cut only at the end of the room, whatever the width of the box.
        ui.set_max_width(room.max(least));
        let combo = ComboBox::from_id_salt("kind").width(width).truncate().selected_text(name);
        combo.show_ui(ui, |ui| {
            for (choice, name, tip) in ConditionKind::ALL {
                let chosen = ui.selectable_label(choice == kind, name).on_hover_text(tip).clicked();
                if chosen && choice != kind {
                    *condition = choice.default_condition(state);
                }
            }
        })
    });
    let combo = combo.inner;
    set_accessible_name(&combo.response, Role::ComboBox, format!("Condition of breakpoint {number}"));
    combo.response.on_hover_text(tip);
}

/// Sets the accessible role and name of a widget.
fn set_accessible_name(response: &Response, role: Role, name: String) {
    response.widget_info(move || WidgetInfo::labeled(role, true, &name));
}

/// Shows the controls of the condition's arguments.
fn argument_controls(ui: &mut Ui, cx: &mut PanelContext, number: usize, condition: &mut Condition) {
    match condition {
        Condition::PixelChangesOwner(pixel) => pixel_controls(ui, cx.state, number, pixel),
        Condition::RegionExceeds { hypothesis, pixels } => {
            hypothesis_control(ui, cx, &format!("Region of breakpoint {number}"), hypothesis);
            let field = ui.add(DragValue::new(pixels).range(1..=u32::MAX).speed(10.0).suffix(" px"));
            set_accessible_name(&field, Role::SpinButton, format!("Pixels of breakpoint {number}"));
        }
        Condition::HypothesisRejected => {}
        Condition::CandidateFails(check) => {
            let choices = CandidateCheck::ALL.map(|check| (check, check.name()));
            choice_control(ui, format!("Test of breakpoint {number}"), check, &choices);
        }
        Condition::ClassIs(class) => {
            use SavedClass::{Line, Plane, Point, Volume};
            let choices =
                [Point, Line, Plane, Volume].map(|class| (class, crate::trace::Class::from(class).name()));
            choice_control(ui, format!("Class of breakpoint {number}"), class, &choices);
        }
        Condition::Conflict(one, other) => {
            hypothesis_control(ui, cx, &format!("First region of breakpoint {number}"), one);
            ui.label(RichText::new("and").color(cx.palette.secondary));
            hypothesis_control(ui, cx, &format!("Second region of breakpoint {number}"), other);
        }
    }
}

/// Shows a choice of one of several values.
fn choice_control<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: String,
    value: &mut T,
    choices: &[(T, &'static str)],
) {
    let shown = choices.iter().find(|(choice, _)| choice == value).map_or("", |(_, name)| name);
    let combo = ComboBox::from_id_salt(&name).width(110.0).selected_text(shown);
    let combo = combo.show_ui(ui, |ui| {
        for &(choice, name) in choices {
            ui.selectable_value(value, choice, name);
        }
    });
    set_accessible_name(&combo.response, Role::ComboBox, name);
}

/// Shows fields for column and row of a pixel, and a button that takes the selected pixel.
fn pixel_controls(ui: &mut Ui, state: &State, number: usize, pixel: &mut PixelIndex) {
    let Some((width, height)) = state.picture.as_ref().map(|picture| picture.size()) else { return };
    let [mut x, mut y] = pixel.position(width);
    for (name, value, size) in [("Column", &mut x, width), ("Row", &mut y, height)] {
        let prefix = if name == "Column" { "x " } else { "y " };
        let field = ui.add(DragValue::new(value).range(0..=size.saturating_sub(1)).prefix(prefix));
        set_accessible_name(&field, Role::SpinButton, format!("{name} of breakpoint {number}"));
    }
    *pixel = PixelIndex::from_index(y * width + x);
    let selected = state.explained_pixel();
    let button = ui.add_enabled(selected.is_some(), egui::Button::new("selected pixel").small());
    set_accessible_name(&button, Role::Button, format!("Selected pixel for breakpoint {number}"));
    let button = button.on_hover_text("Take the pixel that is selected.");
    if button.on_disabled_hover_text("Select a pixel first: Alt + click in the image.").clicked() {
        *pixel = selected.unwrap_or(*pixel);
    }
}

/// Shows a field for a hypothesis id; 0 stands for any region.
fn hypothesis_control(ui: &mut Ui, cx: &PanelContext, name: &str, hypothesis: &mut Option<HypothesisId>) {
    if let Some(hypothesis) = *hypothesis {
        let color = widgets::color(cx.state.debugger.names.color(hypothesis));
        widgets::chip(ui, cx.palette, color, &format!("color of hypothesis {hypothesis}"));
    }
    let before = HypothesisId::label(*hypothesis);
    let mut number = before;
    let field = DragValue::new(&mut number)
        .range(0..=u16::MAX - 1)
        .speed(0.1)
        .custom_formatter(|number, _| match number as u16 {
            0 => "any region".to_owned(),
            number => format!("hypothesis {number}"),
        })
        .custom_parser(|text| {
            let number = text.trim().trim_start_matches(|c: char| !c.is_ascii_digit());
            if number.is_empty() { Some(0.0) } else { number.parse().ok() }
        });
    let field = ui.add(field);
    field.widget_info(|| WidgetInfo {
        label: Some(name.to_owned()),
        ..WidgetInfo::drag_value(true, f64::from(before))
    });
    field.on_hover_text("A region by the number of its hypothesis, as on the timeline; 0: any.");
    *hypothesis = HypothesisId::from_label(number);
}

/// The kind of condition of a new breakpoint: by the kind of the selected item.
fn kind_for_selection(state: &State) -> ConditionKind {
    match state.document.selection.item {
        Some(Item::Pixel(_)) => ConditionKind::Pixel,
        Some(Item::Region(_)) => ConditionKind::Size,
        _ => ConditionKind::Rejected,
    }
}

/// Id of the first hypothesis of the selected region; without a selected region, the chosen hypothesis.
fn chosen_hypothesis(state: &State) -> Option<HypothesisId> {
    match state.document.selection.item {
        Some(Item::Region(region)) => state.debugger.names.hypotheses_of(region).next(),
        _ => state.debugger.chosen,
    }
}

/// The pixel or region of a condition; `None` when the condition has none or the region is not in the result.
fn item_of(state: &State, condition: Condition) -> Option<Item> {
    match condition {
        Condition::PixelChangesOwner(pixel) => Some(Item::Pixel(pixel)),
        Condition::RegionExceeds { hypothesis: Some(hypothesis), .. }
        | Condition::Conflict(Some(hypothesis), _)
        | Condition::Conflict(None, Some(hypothesis)) => {
            state.debugger.names.region_of(hypothesis).map(Item::Region)
        }
        _ => None,
    }
}
