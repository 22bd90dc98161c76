//! Tests of named marks: kept, named, edited by the tools, counted at the pointer, removed, and saved.

use crate::window::{apply, click, marked, named, press, says, shown, state, tiny_window, undo};
use dichroscope::app::{Combine, Edit, ExportKind, JobCommand, NamedMarkEdit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::raster::PixelIndex;
use dichroscope::view::Item;
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use std::sync::Arc;

#[test]
fn marks_are_kept_named_edited_and_removed_and_every_change_can_be_undone() {
    let mut window = tiny_window();
    let labels = shown(&window).labels().clone();
    let of = |region: u16| Arc::new(labels.map(|&label| label == region));
    window.state_mut().show_alone(Some(Pane::Selection));
    apply(&mut window, Edit::Mark(of(1), Combine::Replace, None));
    let first = marked(&window);
    click(&mut window, Role::Button, "Keep as a named mark");
    assert!(says(&window, "Edit mark 1"));
    click(&mut window, Role::Button, "Mark something else");
    assert_eq!(marked(&window), 0, "the tools begin anew");
    apply(&mut window, Edit::Mark(of(2), Combine::Replace, None));
    click(&mut window, Role::Button, "Keep as a named mark");
    let colors: Vec<[u8; 3]> =
        state(&window).document.selection.named.marks.iter().map(|mark| mark.color).collect();
    assert!(colors.len() == 2 && colors[0] != colors[1]);
    named(&window, Role::TextInput, "Name of mark 1").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text("leaf".to_owned()));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(says(&window, "Edit leaf"));
    click(&mut window, Role::Button, "Edit leaf");
    assert_eq!(marked(&window), first, "its pixels are the marked ones");
    apply(&mut window, Edit::Mark(of(3), Combine::Union, None));
    let named_marks = &state(&window).document.selection.named;
    assert!(named_marks.marks[0].pixels > first, "a tool changes the mark");
    undo(&mut window);
    assert_eq!(state(&window).document.selection.named.marks[0].pixels, first);
    click(&mut window, Role::Button, "Remove mark 2");
    assert_eq!(state(&window).document.selection.named.marks.len(), 1);
    undo(&mut window);
    assert_eq!(state(&window).document.selection.named.marks.len(), 2);
    click(&mut window, Role::Button, "Another color for leaf");
    assert!(!colors.contains(&state(&window).document.selection.named.marks[0].color));
}

#[test]
fn a_mark_is_counted_at_the_pointer_and_comes_back_with_the_workspace() {
    let mut window = tiny_window();
    let labels = shown(&window).labels().clone();
    let mask = Arc::new(labels.map(|&label| label == 1));
    apply(&mut window, Edit::Mark(mask, Combine::Replace, None));
    apply(&mut window, Edit::NamedMark(NamedMarkEdit::Keep));
    apply(&mut window, Edit::NamedMark(NamedMarkEdit::Rename(0, "leaf".to_owned())));
    apply(&mut window, Edit::ClearSelection);
    assert_eq!((marked(&window), state(&window).document.selection.named.marks.len()), (0, 1));
    let inside = labels.as_slice().iter().position(|&label| label == 1).unwrap();
    apply(&mut window, ViewCommand::Hover(Some(Item::Pixel(PixelIndex::from_index(inside)))));
    assert!(says(&window, "leaf: "), "name and number beside the pointer");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.dichroscope");
    apply(&mut window, JobCommand::Export(ExportKind::Workspace.to(path.clone())));
    let before = state(&window).document.selection.named.clone();
    apply(&mut window, Edit::NamedMark(NamedMarkEdit::Remove(0)));
    apply(&mut window, JobCommand::OpenWorkspace(path));
    assert_eq!(state(&window).document.selection.named, before);
}

#[test]
fn the_marked_pixels_are_kept_by_a_key_and_from_the_command_palette() {
    let mut window = tiny_window();
    let labels = shown(&window).labels().clone();
    let of = |region: u16| Arc::new(labels.map(|&label| label == region));
    apply(&mut window, Edit::Mark(of(1), Combine::Replace, None));
    press(&mut window, Modifiers::COMMAND, Key::M);
    assert_eq!(state(&window).document.selection.named.marks.len(), 1);
    apply(&mut window, Edit::NamedMark(NamedMarkEdit::Release));
    apply(&mut window, Edit::Mark(of(2), Combine::Replace, None));
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("keep named".to_owned()));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(state(&window).document.selection.named.marks.len(), 2);
    undo(&mut window);
    assert_eq!(state(&window).document.selection.named.marks.len(), 1);
}
