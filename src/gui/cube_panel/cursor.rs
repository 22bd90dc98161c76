//! The color space at the debugger's cursor: the pixels that the current step examines, and the shapes as they are
//! then.

use super::figure::ShapeBuilder;
use super::instant::{InstantKey, instant_key};
use crate::app::State;
use crate::gpu::{Batch, Point};
use crate::gui::theme::Tones;
use crate::gui::widgets;
use crate::trace::{Measured, Replay};
use crate::view::{
    self, CubeSettings, Picture, ResultSnapshot, Role, Theme, beside_color, candidate_reach, looked_at,
    test_at_cursor,
};
use egui::Color32;
use std::time::{Duration, Instant};

/// Largest number of points of each role.
const MOST: usize = 20_000;
/// Diameter of a pixel in the region in focus, screen points.
const OWN_PT: f32 = 3.0;
const BESIDE_PT: f32 = 3.4;
/// Diameter of a pixel that a test ignores, screen points.
const QUIET_PT: f32 = 2.4;

/// Number of pixels above which a photograph is large: while the cursor plays, its points are updated once per
/// `PATIENCE`.
const LARGE_PX: usize = 1 << 22;
const PATIENCE: Duration = Duration::from_millis(120);

const THIN_PT: f32 = 1.0;
const THICK_PT: f32 = 2.0;
const MARK_PT: f32 = 4.5;

/// The pixels that the step at the cursor considers, as points.
#[derive(Default)]
pub struct Track {
    of: Option<(InstantKey, CubeSettings, Theme)>,
    made: Option<Instant>,
    /// One batch of points per role of the pixels in the step.
    pub drawn: Vec<Batch<Point>>,
}

impl Track {
    /// Rebuilds the points when the instant has changed.
    pub fn update(&mut self, state: &State, tones: &Tones, picture: &Picture) {
        let of = instant_key(state).map(|key| (key, state.view.cube.clone(), state.view.theme));
        if self.of == of || (of.is_some() && self.rests(state, picture)) {
            return;
        }
        self.of = of;
        self.made = Some(Instant::now());
        self.drawn.clear();
        let (Some(replay), Some(shown)) = (state.followed(), &state.newest) else { return };
        let working = &shown.analysis.working;
        let (colors, masks) = (&working.image.pixels, &working.masks);
        let focus = state.debugger.focus();
        let (space, full) = (state.view.cube.space, picture.histogram.full_counts);
        for (role, pixels) in looked_at(replay, focus, colors, masks, MOST) {
            let (color, size_px) = look(role, own(state), tones);
            let point = |&pixel: &u32| Point {
                position: space.place(colors.as_slice()[pixel as usize], full),
                color: color.to_array(),
                size_px,
            };
            self.drawn.push(Batch::new(pixels.iter().map(point).collect::<Vec<_>>()));
        }
    }

    /// Whether the points of an earlier instant are kept: in a large photograph, while the cursor plays, for
    /// `PATIENCE`.
    fn rests(&self, state: &State, picture: &Picture) -> bool {
        let large = picture.photo.image.pixels.len() > LARGE_PX && state.debugger.playing.is_some();
        large && self.of.is_some() && self.made.is_some_and(|made| made.elapsed() < PATIENCE)
    }

    /// Whether the step has points, in front of which all other colors are ghosts.
    pub fn is_shown(&self) -> bool {
        !self.drawn.is_empty()
    }
}

/// The color of the region in focus, sRGB.
fn own(state: &State) -> Option<[u8; 3]> {
    state.debugger.focus().map(|focus| state.debugger.names.color(focus))
}

fn look(role: Role, own: Option<[u8; 3]>, tones: &Tones) -> (Color32, f32) {
    let accent = |color: Option<[u8; 3]>| color.map_or(tones.accent, widgets::color);
    match role {
        Role::Own => (accent(own), OWN_PT),
        Role::Newest => (tones.text, BESIDE_PT),
        Role::Beside => (widgets::color(beside_color(own.unwrap_or(view::ACCENT))), BESIDE_PT),
        Role::Ignored => (tones.quiet, QUIET_PT),
        Role::Window(class) => (class.map_or(tones.quiet, super::cloud::class_color), BESIDE_PT),
    }
}

impl ShapeBuilder<'_> {
    /// Adds the shapes at the cursor.
    pub fn instant(&mut self, state: &State, replay: &Replay, shown: &ResultSnapshot, tones: &Tones) {
        let show = &state.view.cube;
        let focus = state.debugger.focus();
        let shapes = view::cursor_shapes(replay, focus, shown);
        let color = own(state).map_or(tones.quiet, widgets::color);
        if show.show_lines {
            for (region, axis) in &shapes.others {
                let color = widgets::color(state.debugger.names.color(*region)).gamma_multiply(0.7);
                self.line(axis, color, THIN_PT, 0.0);
            }
        }
        if let Some(ends) = shapes.light.filter(|_| show.show_illuminant) {
            let tip = "The color of the light as it is estimated so far (section 5.4).";
            self.light(&ends, tones.text, "illuminant so far", tip);
        }
        if let Some(solid) = shapes.cylinder.as_ref().filter(|_| show.show_cylinder) {
            self.body(solid, color, "cylinder", "The colors that the region may claim (section 5.3.2).");
        }
        if let Some(solid) = shapes.slice.as_ref().filter(|_| show.show_slice) {
            self.body(solid, color, "slice", "The colors that the region may claim (section 5.4.2).");
        }
        if let Some(test) = test_at_cursor(replay) {
            self.test(test, replay, shown, color, tones);
        } else if let Some(axis) = shapes.axis.filter(|_| show.show_lines) {
            self.line(&axis, tones.text, THICK_PT, 0.0);
            if let Some(start) = shapes.start {
                let tip = "Where highlights leave the matte line (section 5.4.1).";
                self.note(start, "meeting point", tip, true);
            }
        }
        if show.show_ellipsoid {
            self.window(replay, shown, tones);
        }
    }

    /// Adds the ellipsoid of the window that was classified last.
    fn window(&mut self, replay: &Replay, shown: &ResultSnapshot, tones: &Tones) {
        let working = &shown.analysis.working;
        let colors = &working.image.pixels;
        let groups = looked_at(replay, None, colors, &working.masks, usize::MAX);
        let Some((Role::Window(_), pixels)) = groups.first() else { return };
        let colors = pixels.iter().map(|&pixel| colors.as_slice()[pixel as usize]);
        if let Some(solid) = view::cluster_ellipsoid(colors) {
            let tip = "The window's colors at two standard deviations: what its class is decided from (section 5.2.1).";
            self.body(&solid, tones.accent, "window", tip);
        }
    }

    /// Adds a skewed-T test: both lines, the part of the matte line where highlights may begin, and the gap (section
    /// 5.4.1).
    fn test(
        &mut self,
        test: &crate::trace::CandidateTested,
        replay: &Replay,
        shown: &ResultSnapshot,
        color: Color32,
        tones: &Tones,
    ) {
        let working = &shown.analysis.working;
        let colors = working.image.pixels.as_slice();
        let pixels = view::candidate_pixels(replay, test.candidate, &working.masks);
        let reach = candidate_reach(test, pixels.iter().map(|&pixel| colors[pixel as usize]));
        let skewed_t_view = view::skewed_t_view(test, reach);
        self.line(&skewed_t_view.upper, color, MARK_PT, 0.0);
        self.spine(&skewed_t_view.matte, tones.text, THICK_PT);
        self.line(&skewed_t_view.line, tones.text, THICK_PT, 0.0);
        self.line(&skewed_t_view.gap, tones.accent, THICK_PT, 0.0);
        let Measured { value: gap, limit } = test.gap;
        let tip = "The shortest way between both lines, against the longest allowed (section 5.4.1).";
        self.note(skewed_t_view.gap[0], format!("gap {gap:.1} of {limit:.1}"), tip, true);
        let tip = "The end of the matte line: the brightest pixel on its outside, but for half a percent (section 5.4.1).";
        self.note(skewed_t_view.matte[1], "brightest matte point", tip, true);
        let tip = "The first eigenvector of the neighboring cluster, through its mean (section 5.4.1).";
        self.note(skewed_t_view.line[1], "candidate", tip, false);
        let tip = "Where the highlight line may leave the matte line: the 50 % heuristic (section 5.4.1).";
        self.note(skewed_t_view.upper[0], "upper 50 %", tip, false);
    }
}
