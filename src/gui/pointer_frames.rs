//! The end of a frame's input between the press of a button of the pointer, the movement after the press, the release, and the movement after
//! the release.

use egui::{Context, Event, Plugin, Pos2, RawInput};

/// Largest distance that the pointer moves during a click, points: egui's own limit.
const CLICK_PT: f32 = 6.0;

/// Gives a press, the drag after the press, the release, and the movement after the release a frame each, where all come within one slow frame.
/// egui knows one place of the pointer in a frame: an outline would begin where the pointer went after the press, a slider that is let go would
/// take the value at the place that the pointer went to afterwards, and a short drag would be neither a drag nor a click.
#[derive(Default)]
pub struct PointerFrames {
    /// The events of the next frame.
    held: Vec<Event>,
    /// The place of the last press, points; none before the first.
    press: Option<Pos2>,
}

impl Plugin for PointerFrames {
    fn debug_name(&self) -> &'static str {
        "pointer frames"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let mut events = std::mem::take(&mut self.held);
        events.append(&mut input.events);
        if let Some(len) = len_of_frame(&events, self.press) {
            self.held = events.split_off(len);
            ctx.request_repaint();
        }
        let mut presses = events.iter().filter_map(|event| match event {
            Event::PointerButton { pos, pressed: true, .. } => Some(*pos),
            _ => None,
        });
        self.press = presses.next_back().or(self.press);
        input.events = events;
    }
}

/// Number of the events that belong to one frame; none where all do. `press`: the place of the last press in the frames before.
fn len_of_frame(events: &[Event], press: Option<Pos2>) -> Option<usize> {
    let mut press = press;
    let mut has_moved = false;
    for (index, event) in events.iter().enumerate() {
        let Event::PointerButton { pos, pressed, .. } = event else {
            has_moved |= matches!(event, Event::PointerMoved(_));
            continue;
        };
        let later = &events[index + 1..];
        if *pressed {
            press = Some(*pos);
        } else if has_moved && press.is_some_and(|press| press.distance(*pos) > CLICK_PT) {
            return Some(index);
        }
        // The clicks of a double click stay in one frame.
        let is_click = *pressed || later.iter().any(|event| matches!(event, Event::PointerButton { .. }));
        let tolerance = if is_click { CLICK_PT } else { 0.0 };
        if later.iter().filter_map(place_of).any(|place| place.distance(*pos) > tolerance) {
            return Some(index + 1);
        }
    }
    None
}

/// The place of the pointer that an event tells.
const fn place_of(event: &Event) -> Option<Pos2> {
    match event {
        Event::PointerMoved(pos) | Event::PointerButton { pos, .. } => Some(*pos),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Modifiers, PointerButton, pos2};

    /// The events of each frame, where all of `events` come in the first frame.
    fn frames(events: &[Event]) -> Vec<Vec<Event>> {
        let ctx = Context::default();
        let mut pointer_frames = PointerFrames::default();
        let mut input = RawInput { events: events.to_vec(), ..RawInput::default() };
        let mut frames = Vec::new();
        loop {
            pointer_frames.input_hook(&ctx, &mut input);
            frames.push(std::mem::take(&mut input.events));
            if pointer_frames.held.is_empty() {
                return frames;
            }
        }
    }

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
    }

    #[test]
    fn press_drag_release_and_the_movement_afterwards_have_a_frame_each() {
        let [at, away, farther] = [pos2(10.0, 10.0), pos2(90.0, 90.0), pos2(95.0, 90.0)];
        let press = vec![Event::PointerMoved(at), button(at, true)];
        let drag = vec![Event::PointerMoved(farther), Event::PointerMoved(away)];
        let release = vec![button(away, false)];
        let rest = vec![Event::PointerMoved(farther), Event::Text("a".to_owned())];
        let all = [press.clone(), drag.clone(), release.clone(), rest.clone()];
        assert_eq!(frames(&all.concat()), all);
    }

    #[test]
    fn a_click_a_double_click_and_a_key_after_a_click_stay_in_one_frame() {
        let (at, beside) = (pos2(10.0, 10.0), pos2(11.0, 10.0));
        let click = [button(at, true), Event::PointerMoved(beside), button(beside, false)];
        let key = [Event::Text("a".to_owned())];
        for events in [click.to_vec(), [&click[..], &click[..]].concat(), [&click[..], &key[..]].concat()] {
            assert_eq!(frames(&events), [events]);
        }
    }
}
