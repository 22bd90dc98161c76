//! The color space at the debugger's cursor: the pixels that the current step examines, and the
//! shapes as they are at that step.

use super::figure::ShapeBuilder;
use crate::app::State;
use crate::gpu::{Batch, Point};
use crate::gui::instant_key::{InstantKey, instant_key};
use crate::gui::theme::ThemeColors;
use crate::gui::widgets;
use crate::trace::{Measured, Replay};
use crate::view::{
    self, CubeSettings, Meaning, Picture, ResultSnapshot, Role, Theme, candidate_reach, step_pixels,
    test_at_cursor,
};
use egui::Color32;
use std::time::{Duration, Instant};

/// Largest number of points of each role.
const MOST_POINTS: usize = 20_000;
/// Diameter of a pixel in the region in focus, screen points.
const OWN_PT: f32 = 3.0;
const BESIDE_PT: f32 = 3.4;
/// Diameter of a pixel that a test ignores, screen points.
const QUIET_PT: f32 = 2.4;

/// Number of pixels above which a photograph is large: while the cursor plays, its points are updated once per
/// `UPDATE_INTERVAL`.
const LARGE_PX: usize = 1 << 22;
const UPDATE_INTERVAL: Duration = Duration::from_millis(120);

const THIN_PT: f32 = 1.0;
const THICK_PT: f32 = 2.0;
const MARK_PT: f32 = 4.5;

/// The pixels that the step at the cursor considers, as points.
#[derive(Default)]
pub struct CursorPoints {
    /// Instant, settings and theme that the points were made for.
    inputs: Option<(InstantKey, CubeSettings, Theme)>,
    /// The time at which the points were made.
    made_at: Option<Instant>,
    /// One batch of points per role of the pixels in the step.
    pub drawn: Vec<Batch<Point>>,
    /// The meanings of the points, for the legend.
    pub meanings: Vec<Meaning>,
}

impl CursorPoints {
    /// Rebuilds the points when the instant has changed.
    pub fn update(&mut self, state: &State, palette: &ThemeColors, picture: &Picture) {
        let inputs = instant_key(state).map(|key| (key, state.view.cube.clone(), state.view.theme));
        if self.inputs == inputs || (inputs.is_some() && self.keeps_earlier_points(state, picture)) {
            return;
        }
        self.inputs = inputs;
        self.made_at = Some(Instant::now());
        self.drawn.clear();
        self.meanings.clear();
        let (Some(replay), Some(shown)) = (state.followed(), &state.newest) else { return };
        let working = &shown.analysis.working;
        let (colors, masks) = (&working.image.pixels, &working.masks);
        let focus = state.debugger.focus();
        let (space, full) = (state.view.cube.space, picture.histogram.full_counts);
        for (role, pixels) in step_pixels(replay, focus, colors, masks, MOST_POINTS) {
            let (color, size_px) = color_and_size(role, state.focus_color(), palette);
            if let Role::Meaning(meaning) = role {
                self.meanings.push(meaning);
            }
            let point = |&pixel: &u32| Point {
                position: space.place(colors.as_slice()[pixel as usize], full),
                color: color.to_array(),
                size_px,
            };
            self.drawn.push(Batch::new(pixels.iter().map(point).collect::<Vec<_>>()));
        }
    }

    /// Whether the points of an earlier instant are kept: in a large photograph, while the cursor plays, for
    /// `UPDATE_INTERVAL`.
    fn keeps_earlier_points(&self, state: &State, picture: &Picture) -> bool {
        let large = picture.photo.image.pixels.len() > LARGE_PX && state.debugger.playing.is_some();
        large
            && self.inputs.is_some()
            && self.made_at.is_some_and(|made_at| made_at.elapsed() < UPDATE_INTERVAL)
    }

    /// Whether the step has points, in front of which all other colors are ghosts.
    pub fn is_shown(&self) -> bool {
        !self.drawn.is_empty()
    }
}

/// Color and diameter of the points of a role. `own` is the color of the hypothesis in focus.
fn color_and_size(role: Role, own: Option<[u8; 3]>, palette: &ThemeColors) -> (Color32, f32) {
    match role {
        Role::Meaning(meaning) => {
            let size_pt = match meaning {
                Meaning::Taken => OWN_PT,
                Meaning::JustTaken | Meaning::Refused | Meaning::Candidate => BESIDE_PT,
                Meaning::Ignored => QUIET_PT,
            };
            (widgets::color(meaning.color(own)), size_pt)
        }
        Role::Window(class) => (class.map_or(palette.secondary, super::cloud::class_color), BESIDE_PT),
    }
}

impl ShapeBuilder<'_> {
    /// Adds the shapes at the cursor.
    pub fn add_instant(
        &mut self,
        state: &State,
        replay: &Replay,
        shown: &ResultSnapshot,
        palette: &ThemeColors,
    ) {
        let show = &state.view.cube;
        let focus = state.debugger.focus();
        let shapes = view::cursor_shapes(replay, focus, shown);
        let color = state.focus_color().map_or(palette.secondary, widgets::color);
        if show.show_lines {
            for (region, axis) in &shapes.others {
                let color = widgets::color(state.debugger.names.color(*region)).gamma_multiply(0.7);
                self.add_line(axis, color, THIN_PT, 0.0);
            }
        }
        if let Some(ends) = shapes.light.filter(|_| show.show_illuminant) {
            let tip = "The color of the light as it is estimated so far (section 5.4).";
            self.add_light(&ends, palette.text, "illuminant so far", tip);
        }
        for (region, ends) in &shapes.averaged {
            let color = widgets::color(state.debugger.names.color(*region));
            self.add_line(ends, color, THICK_PT, 0.0);
            let tip =
                "The direction of a highlight cluster; the light is the average of all (section 5.4.1).";
            self.add_label(ends[1], format!("highlight of {region}"), tip, true);
        }
        if let Some(solid) = shapes.cylinder.as_ref().filter(|_| show.show_cylinder) {
            self.add_body(solid, color, "cylinder", "The colors that the region may claim (section 5.3.2).");
        }
        if let Some(solid) = shapes.slice.as_ref().filter(|_| show.show_slice) {
            self.add_body(solid, color, "slice", "The colors that the region may claim (section 5.4.2).");
        }
        if let Some(test) = test_at_cursor(replay) {
            self.test(test, replay, shown, color, palette);
        } else if let Some(axis) = shapes.axis.filter(|_| show.show_lines) {
            self.add_line(&axis, palette.text, THICK_PT, 0.0);
            if let Some(start) = shapes.start {
                let tip = "Where highlights leave the matte line (section 5.4.1).";
                self.add_label(start, "meeting point", tip, true);
            }
        }
        if show.show_ellipsoid {
            self.add_window(replay, shown, palette);
        }
    }

    /// Adds the ellipsoid of the window that was classified last.
    fn add_window(&mut self, replay: &Replay, shown: &ResultSnapshot, palette: &ThemeColors) {
        let working = &shown.analysis.working;
        let colors = &working.image.pixels;
        let groups = step_pixels(replay, None, colors, &working.masks, usize::MAX);
        let Some((Role::Window(_), pixels)) = groups.first() else { return };
        let colors = pixels.iter().map(|&pixel| colors.as_slice()[pixel as usize]);
        if let Some(solid) = view::cluster_ellipsoid(colors) {
            let tip = "The window's colors at two standard deviations: what its class is decided from (section 5.2.1).";
            self.add_body(&solid, palette.accent, "window", tip);
        }
    }

    /// Adds a skewed-T test: both lines, the part of the matte line where highlights may begin, and the
    /// gap (section 5.4.1).
    fn test(
        &mut self,
        test: &crate::trace::CandidateTested,
        replay: &Replay,
        shown: &ResultSnapshot,
        color: Color32,
        palette: &ThemeColors,
    ) {
        let working = &shown.analysis.working;
        let colors = working.image.pixels.as_slice();
        let pixels = view::candidate_pixels(replay, test, &working.masks);
        let reach = candidate_reach(test, pixels.iter().map(|&pixel| colors[pixel as usize]));
        let skewed_t_view = view::skewed_t_view(test, reach);
        self.add_line(&skewed_t_view.upper, color, MARK_PT, 0.0);
        self.add_matte_line(&skewed_t_view.matte, palette.text, THICK_PT);
        self.add_line(&skewed_t_view.line, widgets::color(Meaning::Candidate.color(None)), THICK_PT, 0.0);
        self.add_line(&skewed_t_view.gap, palette.accent, THICK_PT, 0.0);
        let Measured { value: gap, limit } = test.gap;
        let tip = "The shortest way between both lines, against the longest allowed (section 5.4.1).";
        self.add_label(skewed_t_view.gap[0], format!("gap {gap:.1} of {limit:.1}"), tip, true);
        let tip = "The end of the matte line: the brightest pixel on its outside, but for half a percent (section 5.4.1).";
        self.add_label(skewed_t_view.matte[1], "brightest matte point", tip, true);
        let tip = "The first eigenvector of the neighboring cluster, through its mean (section 5.4.1).";
        self.add_label(skewed_t_view.line[1], "candidate", tip, false);
        let tip = "Where the highlight line may leave the matte line: the 50 % heuristic (section 5.4.1).";
        self.add_label(skewed_t_view.upper[0], "upper 50 %", tip, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_the_colors_of_their_meanings() {
        let palette = ThemeColors::of(Theme::Dark);
        for meaning in Meaning::ALL {
            for own in [None, Some([10, 200, 30])] {
                let (color, _) = color_and_size(Role::Meaning(meaning), own, &palette);
                assert_eq!(color, widgets::color(meaning.color(own)), "{meaning:?}");
            }
        }
    }
}
