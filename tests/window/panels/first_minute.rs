//! Tests of the first minute: the start screen, the region that is selected at first, the verdict, cards of words, and the view
//! before and after.

use crate::window::{
    Window, apply, choose, click, inside, item, named, open_sample, press, region, says, shown, state,
    tiny_window, window, words, zoom_in,
};
use dichroscope::app::{Edit, JobCommand, ViewCommand};
use dichroscope::params::Method;
use dichroscope::truth::sample;
use dichroscope::view::{Arrangement, Item, Layer, Origin};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Order};
use egui_kittest::kittest::{NodeT, Queryable};

#[test]
fn the_start_screen_opens_samples_and_dialogs_by_pointer_and_keyboard() {
    let mut window = window();
    click(&mut window, Role::Button, "Open a workspace\u{2026}");
    assert!(says(&window, "Path") && says(&window, "Open workspace"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    for sample in &sample::SAMPLES {
        assert!(says(&window, sample.name) && says(&window, sample.about), "{}", sample.name);
    }
    window.get_by_role_and_label(Role::Link, sample::NAME).focus();
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::Sample(sample::NAME.to_owned()));
}

/// Upper edges of the verdict's clauses.
fn clauses(window: &Window) -> Vec<f32> {
    let links = window.root().children_recursive().filter(|node| node.accesskit_node().role() == Role::Link);
    links.map(|link| link.rect().top()).collect()
}

#[test]
fn a_verdict_that_needs_more_lines_has_them_without_an_input() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(dichroscope::gui::Pane::Image));
    window.set_size(egui::vec2(900.0, 600.0));
    window.run_steps(4);
    let one_line = clauses(&window);
    assert!(one_line.len() > 1 && one_line.iter().all(|top| (top - one_line[0]).abs() < 0.1), "{one_line:?}");
    // As many frames as the window asks for, and then some more.
    window.set_size(egui::vec2(420.0, 600.0));
    window.run_ok();
    let lines = clauses(&window);
    window.run_steps(4);
    assert_eq!(lines, clauses(&window), "no clause moves later, when the pointer moves");
    assert!(lines[0] < lines[lines.len() - 1], "{lines:?}");
}

#[test]
fn the_picture_stays_where_it_is_when_the_verdict_needs_more_or_fewer_lines() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(dichroscope::gui::Pane::Image));
    for width in [420.0, 900.0] {
        window.set_size(egui::vec2(width, 600.0));
        window.run_steps(4);
        let seen = |window: &Window| (named(window, Role::Image, "Picture").rect(), clauses(window));
        let (place, lines) = seen(&window);
        for (method, is_same) in [(Method::Phoenix, false), (Method::Refined, true)] {
            apply(&mut window, Edit::SetMethod(method));
            window.run_steps(4);
            assert_eq!(seen(&window).0, place, "{method:?} at {width}");
            assert_eq!(seen(&window).1 == lines, is_same, "the sentence under {method:?} at {width}");
        }
    }
}

#[test]
fn a_verdict_that_is_too_long_for_its_lines_is_shown_over_the_picture() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(dichroscope::gui::Pane::Image));
    window.set_size(egui::vec2(330.0, 600.0));
    window.run_steps(4);
    assert_eq!(clauses(&window), [] as [f32; 0], "no clause has room");
    let is_verdict =
        |node: &egui_kittest::Node| words(node).is_some_and(|text| text.contains("regions fit;"));
    let lines = window.root().children_recursive().find(is_verdict).map(|node| node.rect());
    let lines = lines.expect("as much as there is room for is shown");
    window.hover_at(lines.center());
    window.run_steps(3);
    assert!(clauses(&window).len() > 1, "the whole sentence");
}

#[test]
fn the_largest_region_is_selected_until_a_person_selects() {
    let mut window = window();
    open_sample(&mut window, sample::NAME);
    let regions = &shown(&window).analysis.intrinsic.regions;
    let largest = regions.iter().max_by_key(|region| region.pixels).unwrap().id;
    assert_eq!(item(&window), Some(Item::Region(largest)));
    assert!(!state(&window).history.can_undo(), "the selection is no step");
    assert!(says(&window, "Dichromatic plane of region"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(item(&window), None);
    named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(4.0);
    window.run_steps(3);
    assert_eq!(item(&window), None, "what was deselected stays so");
    click(&mut window, Role::Button, "Select the largest region");
    assert_eq!(item(&window), Some(Item::Region(largest)));
}

#[test]
fn each_clause_of_the_verdict_leads_to_its_subject() {
    let mut window = tiny_window();
    let clause = |window: &Window, text: &str| {
        window.root().children_recursive().any(|node| {
            node.accesskit_node().role() == Role::Link
                && words(&node).is_some_and(|words| words.contains(text))
        })
    };
    assert!(clause(&window, "regions fit;") && clause(&window, "the light comes from"));
    choose(&mut window, "View", "Regions");
    let regions = shown(&window).analysis.intrinsic.regions.len();
    click(&mut window, Role::Link, &format!("All {regions} regions fit;"));
    assert_eq!(state(&window).view.image.layer, Layer::Regions);
    assert!(says(&window, "color of region 1"), "the table is shown again");
}

#[test]
fn a_way_back_leads_from_no_panel_to_all() {
    let mut window = tiny_window();
    for pane in dichroscope::gui::Pane::ALL {
        choose(&mut window, "View", pane.title());
    }
    assert!(says(&window, "All panels are hidden"));
    click(&mut window, Role::Button, "Profile");
    assert!(!says(&window, "All panels are hidden") && says(&window, "row"));
    choose(&mut window, "View", "Profile");
    click(&mut window, Role::Button, "Arrange as at first");
    assert!(says(&window, "color of region 1"));
}

#[test]
fn the_readout_keeps_the_clicked_pixel_and_names_measured_and_resulting_amounts() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 1);
    let place = crate::window::at(&window, x as f32 + 0.5, y as f32 + 0.5);
    window.hover_at(place);
    window.run_steps(2);
    for pressed in [true, false] {
        crate::window::pointer(&mut window, place, pressed, Modifiers::NONE);
    }
    window.event(Event::PointerGone);
    window.run_steps(3);
    let readout = words(&named(&window, Role::Label, &format!("x {x}, y {y}"))).unwrap();
    assert!(readout.contains("result, m_b ") && readout.contains("m_s "), "{readout}");
    let measured = readout.contains("measured, m_b ");
    assert_eq!(measured, says(&window, "before the cut at noise"), "*Why* says the same: {readout}");
}

#[test]
fn while_c_is_held_the_photograph_is_shown() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::Num8);
    let before = state(&window).view.image.clone();
    let hold = |window: &mut Window, pressed: bool| {
        let (key, physical_key, repeat, modifiers) = (Key::C, None, false, Modifiers::NONE);
        window.event(Event::Key { key, physical_key, pressed, repeat, modifiers });
        window.run_steps(2);
    };
    hold(&mut window, true);
    assert_eq!(state(&window).view.image, before, "the settings stay");
    hold(&mut window, false);
    assert_eq!(state(&window).view.image, before);
}

#[test]
fn words_have_cards_with_a_drawing() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    assert!(!says(&window, "drawing of"));
    for (label, word) in [("matte line", "matte line"), ("m_s, counts", "m_s, amount of surface")] {
        let label = window.get_by_role_and_label(Role::Label, label).rect().center();
        window.hover_at(label);
        window.run_steps(40);
        assert!(says(&window, &format!("drawing of: {word}")), "{word}");
    }
}

/// Number of tooltips that are shown.
fn tooltips(window: &Window) -> usize {
    let layers = window.ctx.memory(|memory| memory.areas().visible_layer_ids());
    layers.iter().filter(|layer| layer.order == Order::Tooltip).count()
}

#[test]
fn no_two_tooltips_are_shown_at_once() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    apply(&mut window, ViewCommand::Pin(true));
    window.ctx.all_styles_mut(|style| {
        (style.interaction.tooltip_delay, style.interaction.tooltip_grace_time) = (0.0, 0.0);
        style.interaction.show_tooltips_only_when_still = false;
    });
    let nodes = window.root().children_recursive();
    let with_place = nodes.filter(|node| node.accesskit_node().bounding_box().is_some());
    let mut places: Vec<_> = with_place.map(|node| node.rect().center()).collect();
    places.dedup();
    let mut any = 0;
    for place in places {
        window.hover_at(place);
        window.run_steps(2);
        let shown = tooltips(&window);
        assert!(shown <= 1, "{shown} tooltips at {place}");
        any += shown;
    }
    assert!(any > 20, "tooltips are shown at all: {any}");
}

#[test]
fn a_second_photograph_is_shown_with_its_own_verdict() {
    let mut window = tiny_window();
    apply(&mut window, JobCommand::Open(Origin::Sample(sample::NAME.to_owned())));
    assert!(says(&window, "the body image is"), "the truth of a sample is known");
    assert_eq!(
        state(&window).view.image.arrangement,
        Arrangement::Single,
        "a choice of the first start only"
    );
}

#[test]
fn a_dialog_that_opens_under_the_pointer_ends_the_tooltip_of_what_it_covers() {
    let mut window = tiny_window();
    let covered = named(&window, Role::Label, "slice width").rect().center();
    for (modifiers, key) in [(Modifiers::NONE, Key::F1), (Modifiers::COMMAND, Key::P)] {
        window.hover_at(covered);
        window.run_steps(40);
        assert_eq!(tooltips(&window), 1, "{key:?}");
        press(&mut window, modifiers, key);
        window.run_steps(4);
        let covers = window.ctx.layer_id_at(covered).is_some_and(|layer| layer.order != Order::Background);
        assert_eq!(tooltips(&window), usize::from(!covers), "{key:?}");
        assert!(covers || key == Key::P, "the list of keys is as wide as the window");
        press(&mut window, Modifiers::NONE, if key == Key::F1 { key } else { Key::Escape });
        window.hover_at(egui::Pos2::ZERO);
        window.run_steps(4);
    }
}
