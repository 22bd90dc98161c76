//! Tests of selecting regions in the table, in the picture and by key: all panels show the same selection.

use crate::window::{
    Window, apply, at, click, drag, inside, item, named, pointer, press, region, says, shown, state,
    tiny_window, undo, words, zoom_in,
};
use dichroscope::app::{Command, DebugCommand, Edit, JobCommand};
use dichroscope::gui::Pane;
use dichroscope::raster::{PixelIndex, RegionId};
use dichroscope::trace::Topic;
use dichroscope::view::{Item, Origin};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Node;
use egui_kittest::kittest::NodeT;

/// Region ids in the order of the table's rows.
fn rows(window: &Window) -> Vec<u16> {
    let of_row = |node: Node<'_>| {
        let id = words(&node)?.strip_prefix("color of region ")?.parse().ok()?;
        Some((node.rect().center().y, id))
    };
    let mut rows: Vec<(f32, u16)> = window.root().children_recursive().filter_map(of_row).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|(_, id)| id).collect()
}

#[test]
fn a_row_selects_the_region_everywhere() {
    let mut window = tiny_window();
    assert!(says(&window, "Select a region to see its dichromatic plane."));
    click(&mut window, Role::Label, "color of region 2");
    assert_eq!((item(&window), state(&window).selected_region()), (Some(region(2)), RegionId::from_label(2)));
    assert!(says(&window, "Dichromatic plane of region 2"));
    click(&mut window, Role::Button, "Selection");
    let pixels = shown(&window).analysis.intrinsic.regions[1].pixels;
    assert!(says(&window, "Region 2") && says(&window, &grouped(pixels)));
    click(&mut window, Role::Button, "Deselect");
    assert_eq!(item(&window), None);
    assert!(says(&window, "Select a region to see its dichromatic plane."));
    undo(&mut window);
    assert_eq!(item(&window), Some(region(2)), "a selection is taken back like a parameter");
}

fn grouped(number: usize) -> String {
    let text = number.to_string();
    let (head, tail) = text.split_at(text.len().saturating_sub(3));
    if head.is_empty() { tail.to_owned() } else { format!("{head}\u{2009}{tail}") }
}

#[test]
fn a_second_click_on_the_row_lets_it_go() {
    let mut window = tiny_window();
    click(&mut window, Role::Label, "color of region 1");
    click(&mut window, Role::Label, "color of region 1");
    assert_eq!(item(&window), None);
}

#[test]
fn a_click_in_the_picture_selects_the_region_and_hovering_tells_the_pixel() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 2);
    let place = at(&window, x as f32 + 0.5, y as f32 + 0.5);
    window.hover_at(place);
    window.run_steps(2);
    assert_eq!(
        state(&window).hover,
        Some(Item::Pixel(PixelIndex::from_index(y * shown(&window).labels().width() + x)))
    );
    pointer(&mut window, place, true, Modifiers::NONE);
    pointer(&mut window, place, false, Modifiers::NONE);
    assert_eq!(item(&window), Some(region(2)));
    assert!(says(&window, "Dichromatic plane of region 2"));
    window.remove_cursor();
    window.run_steps(2);
    assert_eq!(state(&window).hover, None);
}

#[test]
fn clipped_pixels_of_a_gray_picture_are_not_called_highlights() {
    let gray = image::open(crate::window::tiny()).unwrap().into_luma8();
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::DynamicImage::from(gray).into_rgb8().write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let mut window = crate::window::window();
    let origin = Origin::Bytes { name: "gray.png".to_owned(), bytes: bytes.into_inner().into() };
    apply(&mut window, JobCommand::Open(origin));
    assert!(says(&window, "no highlight was found") || says(&window, "No highlight was found"));
    let region = shown(&window).analysis.intrinsic.regions[0].clone();
    assert!(region.highlight_pixels > 0 && region.clipped_pixels > 0, "pixels that are not matte");
    assert_eq!((region.highlights(), item(&window)), (None, Some(Item::Region(region.id))));
    let clipped = grouped(region.highlight_pixels);
    let told = format!("and {} clipped or bloomed", clipped.replace('\u{2009}', "\u{a0}"));
    assert!(says(&window, &told), "the inspector");
    let is_number = |node: Node<'_>| words(&node).is_some_and(|words| words == clipped);
    assert!(!window.root().children_recursive().any(is_number), "the table has no highlights");
}

#[test]
fn headings_sort() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Regions));
    window.run_steps(3);
    let regions = shown(&window).analysis.intrinsic.regions.clone();
    let count = regions.len() as u16;
    assert_eq!(rows(&window), (1..=count).collect::<Vec<_>>());
    click(&mut window, Role::Button, "#");
    assert_eq!(rows(&window), (1..=count).rev().collect::<Vec<_>>(), "again: the other way round");
    click(&mut window, Role::Button, "pixels");
    let pixels = |window: &Window| -> Vec<usize> {
        rows(window).iter().map(|&id| regions[usize::from(id) - 1].pixels).collect()
    };
    assert!(pixels(&window).is_sorted_by(|a, b| a >= b), "{:?}", pixels(&window));
    assert!(says(&window, "pixels, descending"), "the heading tells the order");
    click(&mut window, Role::Button, "pixels");
    assert!(pixels(&window).is_sorted(), "{:?}", pixels(&window));
    for heading in ["body C_b", "surface C_s", "angle", "highlight", "rms", "notes"] {
        click(&mut window, Role::Button, heading);
        let mut sorted = rows(&window);
        sorted.sort_unstable();
        assert_eq!(sorted, (1..=count).collect::<Vec<_>>(), "{heading} loses nobody");
    }
}

/// Fails where a heading or a row of the table ends beyond the panel, whose right edge is at `right`.
#[track_caller]
fn assert_table_ends_before(window: &Window, right: f32) {
    for node in window.root().children_recursive() {
        let Some(name) = words(&node) else { continue };
        let is_of_table = ["#", "pixels", "C_b", "angle", "rms", "notes", "d", "radius", "status", "result"]
            .contains(&&*name)
            || name.starts_with("color of ")
            || name.starts_with("\u{2192} region");
        assert!(
            !is_of_table || node.rect().right() <= right + 0.5,
            "{name} ends at {} of {right}",
            node.rect().right()
        );
    }
}

#[test]
fn the_tables_of_a_narrow_panel_leave_columns_out_and_do_not_scroll() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Regions));
    let seek = |window: &mut Window, n| apply(window, Command::Debug(DebugCommand::Seek(n)));
    for width in [350.0, 260.0] {
        window.set_size(egui::vec2(width, 300.0));
        seek(&mut window, usize::MAX);
        window.run_steps(3);
        for heading in ["pixels", "rms", "notes"] {
            assert!(width < 300.0 && heading == "rms" || says(&window, heading), "{heading} at {width}");
        }
        assert_table_ends_before(&window, width);
        let trace = std::sync::Arc::clone(state(&window).debugger.trace().unwrap());
        let slice = trace.blocks().find(|block| matches!(block.topic, Topic::Slice(_))).unwrap();
        seek(&mut window, slice.steps.start);
        window.run_steps(3);
        assert!(says(&window, "status") && says(&window, "result"), "{width}");
        assert_table_ends_before(&window, width);
    }
}

#[test]
fn brackets_step_through_the_regions() {
    let mut window = tiny_window();
    let count = shown(&window).analysis.intrinsic.regions.len() as u16;
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    assert_eq!(item(&window), Some(region(1)));
    press(&mut window, Modifiers::NONE, Key::OpenBracket);
    assert_eq!(item(&window), Some(region(count)));
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    assert_eq!(item(&window), Some(region(1)));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(item(&window), None);
}

#[test]
fn a_selected_region_survives_a_slider() {
    let mut window = tiny_window();
    let (x, y) = inside(&window, 1);
    apply(&mut window, Edit::Select(Some(region(1))));
    let slider = named(&window, Role::Slider, "cylinder width").rect();
    let (a, b) = (slider.left_center().lerp(slider.right_center(), 0.3), slider.center());
    drag(&mut window, &[a, b], Modifiers::NONE);
    let label = shown(&window).labels().get(x, y).copied().unwrap();
    assert_eq!(state(&window).selected_region(), RegionId::from_label(label));
}

#[test]
fn the_plane_is_panned_and_two_clicks_fit_it() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    let plane = named(&window, Role::Canvas, "Dichromatic plane of region 1").rect();
    assert!(plane.width() > 300.0 && plane.height() > 150.0, "{plane:?}");
    let middle = plane.center();
    drag(&mut window, &[middle, middle + egui::vec2(30.0, 10.0)], Modifiers::NONE);
    assert_eq!(item(&window), Some(region(1)), "a drag selects nothing");
    crate::window::double_click(&mut window, middle);
    assert_eq!(item(&window), Some(region(1)));
}
