//! The instant at the debugger's cursor, as a picture to lay over the photograph.

use super::Look;
use super::legends::CLASSES;
use crate::raster::{HypothesisId, Raster};
use crate::trace::{Class, PixelKind};
use crate::view::{Fill, Instant, InstantView, LegendEntry, Meaning, RegionsView, RolesView, WindowsView};
use rayon::prelude::*;

const CLEAR: [u8; 4] = [0; 4];
/// Colors of what was joined or found and of what was not, where a step is about no hypothesis, sRGB.
const TAKEN: [u8; 3] = Meaning::Taken.color(None);
const REFUSED: [u8; 3] = Meaning::Refused.color(None);
/// Color of the seams between areas, sRGB with straight alpha.
const SEAM: [u8; 4] = [0, 0, 0, 200];
/// Opacity of pixels that a hypothesis did not take.
const BESIDE_ALPHA: u8 = 210;
/// Opacity of the hypotheses that are not in focus, as a share of the opacity of the one in focus: pixels of a hypothesis
/// remain distinct from pixels of none.
const HELD: f32 = 0.6;

/// Names, colors and meanings of the kinds of pixels (section 6).
const ROLES: [LegendEntry; 4] = [
    LegendEntry::new("matte", [0x5C, 0x96, 0xC8], "6: nearer to the matte line, body reflection alone"),
    LegendEntry::new("highlight", [0xF0, 0xE2, 0x8A], "6: nearer to the highlight line"),
    LegendEntry::new(
        "restored",
        [0xD0, 0x84, 0xC8],
        "6: clipped or bloomed, split by the bands to be believed",
    ),
    LegendEntry::new("lost", [0x8A, 0x8A, 0x8A], "6: clipped in every band"),
];

/// A blob that was judged where no region holds, and is a highlight or not.
const BLOBS: [LegendEntry; 2] = [
    LegendEntry::new(
        "highlight found",
        TAKEN,
        "where no region holds: a blob that is a highlight, or a clipped one that is filled",
    ),
    LegendEntry::new(
        "no highlight",
        REFUSED,
        "where no region holds: a blob that is no highlight, or a clipped one that is not filled",
    ),
];

/// A clipped area that was judged by its edge, and may be a highlight or not.
const EDGES: [LegendEntry; 2] = [
    LegendEntry::new(
        "may be a highlight",
        TAKEN,
        "beyond 4: a clipped area, and its edge, that may be a highlight",
    ),
    LegendEntry::new(
        "clipped object",
        REFUSED,
        "beyond 4: a white thing that clips, and its edge: no highlight",
    ),
];

/// The legend of an instant.
pub fn instant_legend(instant: &Instant) -> Vec<LegendEntry> {
    match &instant.view {
        InstantView::Nothing => Vec::new(),
        InstantView::Windows(windows) => {
            let mut legend = CLASSES.to_vec();
            let joined = "5.2.2: the union of both areas is of their class, and they are one from now on";
            let refused = "5.2.2: the union of both areas is of another class, and they stay apart";
            match windows.tried.len() {
                0 => {}
                1 => legend.push(LegendEntry::new("joined", TAKEN, joined)),
                _ => {
                    legend.push(LegendEntry::new("stays apart", TAKEN, refused));
                    legend.push(LegendEntry::new("from this", REFUSED, refused));
                }
            }
            legend
        }
        InstantView::Roles(RolesView { blob, is_edge_judged: true, .. }) => {
            blob.iter().map(|(_, kept)| EDGES[usize::from(!kept)]).collect()
        }
        InstantView::Roles(RolesView { blob, .. }) => {
            ROLES.into_iter().chain(blob.iter().map(|(_, kept)| BLOBS[usize::from(!kept)])).collect()
        }
        InstantView::Regions(regions) => {
            let own = regions.own_color();
            let mut legend = Vec::new();
            if !regions.newest.is_empty() {
                legend.push(Meaning::JustTaken.legend(own));
            }
            if !regions.beside.is_empty() {
                legend.push(regions.meaning_beside().legend(own));
            }
            legend
        }
    }
}

/// Draws an instant at the size of the picture, as sRGB with straight alpha.
pub fn paint_instant(instant: &Instant, width: usize, height: usize, look: &Look) -> Raster<[u8; 4]> {
    let mut painted = Raster::filled(width, height, CLEAR);
    match &instant.view {
        InstantView::Nothing => {}
        InstantView::Windows(windows) => windows.paint(&mut painted, look),
        InstantView::Regions(regions) => regions.paint(&mut painted, look),
        InstantView::Roles(roles) => roles.paint(&mut painted, look),
    }
    painted
}

fn with_alpha([r, g, b]: [u8; 3], alpha: u8) -> [u8; 4] {
    [r, g, b, alpha]
}

fn rows(painted: &mut Raster<[u8; 4]>, paint: impl Fn(usize, &mut [[u8; 4]]) + Sync) {
    let width = painted.width().max(1);
    let rows = painted.as_mut_slice().par_chunks_mut(width).enumerate();
    rows.with_min_len(16).for_each(|(y, row)| paint(y, row));
}

/// Number of a class for the palette; 0 for no class.
const fn number(class: Option<Class>) -> usize {
    match class {
        None => 0,
        Some(Class::Point) => 1,
        Some(Class::Line) => 2,
        Some(Class::Plane) => 3,
        Some(Class::Volume) => 4,
    }
}

impl WindowsView {
    /// Paints the classes, seams between the areas once there are areas, and the pair of areas that was tried last.
    fn paint(&self, painted: &mut Raster<[u8; 4]>, look: &Look) {
        let filled = Look { fill: Fill::Fill, ..*look };
        let mut styles = vec![CLEAR];
        styles.extend(CLASSES.iter().map(|entry| filled.style(entry.color, true)));
        let merging =
            self.areas.iter().zip(0..).any(|(area, window)| *area != window) || !self.tried.is_empty();
        let styles: Vec<[u8; 4]> = (0..self.classes.len())
            .map(|window| match self.part(window) {
                Some(0) => with_alpha(TAKEN, 235),
                Some(_) => with_alpha(REFUSED, 235),
                None if look.fill == Fill::Outline => CLEAR,
                None => styles[number(self.classes[window])],
            })
            .collect();
        rows(painted, |y, row| self.row(y, row, &styles, merging || look.fill == Fill::Outline));
    }

    fn row(&self, y: usize, row: &mut [[u8; 4]], styles: &[[u8; 4]], seams: bool) {
        let (side, columns) = (self.size_px, self.columns.max(1));
        let first = y / side * columns;
        let edge = y.is_multiple_of(side);
        for (column, pixels) in row.chunks_mut(side).enumerate() {
            let window = first + column;
            let Some(&style) = styles.get(window) else { continue };
            pixels.fill(style);
            let known = number(self.classes[window]) > 0;
            if !seams || !known {
                continue;
            }
            if edge && window >= columns && self.parts(window, window - columns) {
                pixels.fill(SEAM);
            }
            if column > 0 && self.parts(window, window - 1) {
                pixels[0] = SEAM;
            }
        }
    }

    fn parts(&self, a: usize, b: usize) -> bool {
        self.areas[a] != self.areas[b]
    }

    /// The area of a window among the pair of areas that was tried last.
    fn part(&self, window: usize) -> Option<usize> {
        self.tried.iter().position(|area| *area == self.areas[window])
    }

    /// Paints frames of the classified windows over hypotheses: the grid of smaller windows in which unexplained pixels are classified again.
    fn outline(&self, painted: &mut Raster<[u8; 4]>) {
        let (side, columns, width) = (self.size_px, self.columns.max(1), painted.width());
        rows(painted, |y, row| {
            for (column, pixels) in row.chunks_mut(side).enumerate() {
                let window = y / side * columns + column;
                let class = self.classes.get(window).copied().flatten();
                let Some(class) = class else { continue };
                let color = self.part(window).map_or_else(
                    || CLASSES[number(Some(class)) - 1].color,
                    |part| if part == 0 { TAKEN } else { REFUSED },
                );
                let color = with_alpha(color, 230);
                let last = pixels.len() - 1;
                if y.is_multiple_of(side) || (y + 1).is_multiple_of(side) {
                    pixels.fill(color);
                }
                if width > side {
                    (pixels[0], pixels[last]) = (color, color);
                }
            }
        });
    }
}

impl RegionsView {
    /// The color of the hypothesis in focus, sRGB; none without a hypothesis in focus.
    fn own_color(&self) -> Option<[u8; 3]> {
        self.focus.and_then(|focus| self.colors.get(focus.index())).copied()
    }

    /// The meaning of the pixels beside the hypothesis in focus.
    const fn meaning_beside(&self) -> Meaning {
        if self.tested { Meaning::Candidate } else { Meaning::Refused }
    }

    /// Paints the hypotheses, all dimmed but the one in focus; pixels that this hypothesis took last,
    /// and pixels beside the hypothesis, have the colors of their meanings.
    fn paint(&self, painted: &mut Raster<[u8; 4]>, look: &Look) {
        let selected = |id: HypothesisId| self.focus.is_none_or(|focus| focus == id);
        let styles: Vec<[u8; 4]> = std::iter::once(CLEAR)
            .chain(self.colors.iter().zip(HypothesisId::all(self.colors.len())).map(|(&color, id)| {
                let [r, g, b, alpha] = look.style(color, true);
                [r, g, b, if selected(id) { alpha } else { (f32::from(alpha) * HELD) as u8 }]
            }))
            .collect();
        let labels = &self.labels;
        let style = |label: u16| styles.get(usize::from(label)).copied().unwrap_or(CLEAR);
        if look.fill == Fill::Fill {
            rows(painted, |y, row| {
                for (pixel, &label) in row.iter_mut().zip(labels.row(y)) {
                    *pixel = style(label);
                }
            });
        } else {
            rows(painted, |y, row| {
                for (x, pixel) in row.iter_mut().enumerate() {
                    let here = labels.row(y)[x];
                    let differs = |x: usize, y: usize| labels.get(x, y).is_some_and(|&label| label != here);
                    let border = differs(x.wrapping_sub(1), y)
                        || differs(x + 1, y)
                        || differs(x, y.wrapping_sub(1))
                        || differs(x, y + 1);
                    if here != 0 && border {
                        *pixel = style(here);
                    }
                }
            });
        }
        let own = self.own_color();
        for (pixels, color) in [
            (&self.beside, with_alpha(self.meaning_beside().color(own), BESIDE_ALPHA)),
            (&self.newest, with_alpha(Meaning::JustTaken.color(own), 255)),
        ] {
            for &pixel in pixels {
                painted[pixel as usize] = color;
            }
        }
        if let Some(windows) = &self.windows {
            windows.outline(painted);
        }
    }
}

impl RolesView {
    fn paint(&self, painted: &mut Raster<[u8; 4]>, look: &Look) {
        let filled = Look { fill: Fill::Fill, ..*look };
        let styles = ROLES.map(|role| filled.style(role.color, true));
        rows(painted, |y, row| {
            for (pixel, kind) in row.iter_mut().zip(self.kinds.row(y)) {
                *pixel = match kind {
                    PixelKind::Unassigned => CLEAR,
                    PixelKind::Matte => styles[0],
                    PixelKind::Highlight => styles[1],
                    PixelKind::Restored => styles[2],
                    PixelKind::Lost => styles[3],
                };
            }
        });
        if let Some((blob, kept)) = &self.blob {
            let color = with_alpha(if *kept { TAKEN } else { REFUSED }, 235);
            for &pixel in blob {
                painted[pixel as usize] = color;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(painted: &Raster<[u8; 4]>, named: &[(char, [u8; 4])]) -> Vec<String> {
        let name =
            |pixel: &[u8; 4]| named.iter().find(|(_, color)| color == pixel).map_or('?', |(name, _)| *name);
        (0..painted.height()).map(|y| painted.row(y).iter().map(name).collect()).collect()
    }

    fn look() -> Look {
        Look { opacity: 1.0, ..Look::default() }
    }

    fn painted(view: InstantView, width: usize, height: usize, look: &Look) -> Raster<[u8; 4]> {
        paint_instant(&Instant { view, pixel: None, window: None }, width, height, look)
    }

    fn regions(rows: &[&str]) -> RegionsView {
        RegionsView {
            labels: crate::view::testing::labels(rows),
            colors: vec![[200, 0, 0], [0, 0, 200]],
            focus: HypothesisId::from_label(1),
            newest: Vec::new(),
            beside: Vec::new(),
            tested: false,
            windows: None,
        }
    }

    const DIM: u8 = (255.0 * HELD) as u8;

    #[test]
    fn the_region_in_focus_its_newest_ring_and_its_surroundings_have_three_colors() {
        let mut view = regions(&["112..", "112..", "....."]);
        (view.newest, view.beside) = (vec![1, 6], vec![2, 7]);
        let named = [
            ('.', CLEAR),
            ('1', [200, 0, 0, 255]),
            ('+', with_alpha(Meaning::JustTaken.color(None), 255)),
            ('2', [0, 0, 200, DIM]),
            ('x', with_alpha(REFUSED, BESIDE_ALPHA)),
        ];
        let legend =
            instant_legend(&Instant { view: InstantView::Regions(view.clone()), pixel: None, window: None });
        assert_eq!(legend.iter().map(|entry| entry.name).collect::<Vec<_>>(), ["just taken", "not taken"]);
        let found = painted(InstantView::Regions(view.clone()), 5, 3, &look());
        assert_eq!(drawn(&found, &named), ["1+x..", "1+x..", "....."]);
        view.focus = None;
        (view.newest, view.beside) = (Vec::new(), Vec::new());
        let all = [('.', CLEAR), ('1', [200, 0, 0, 255]), ('2', [0, 0, 200, 255])];
        let found = painted(InstantView::Regions(view), 5, 3, &look());
        assert_eq!(drawn(&found, &all), ["112..", "112..", "....."]);
    }

    #[test]
    fn outlines_run_inside() {
        let view = RegionsView { focus: None, ..regions(&["1112", "1112", "1112"]) };
        let outline = Look { fill: Fill::Outline, ..look() };
        let named = [('.', CLEAR), ('1', [200, 0, 0, 255]), ('2', [0, 0, 200, 255])];
        let found = painted(InstantView::Regions(view), 4, 3, &outline);
        assert_eq!(drawn(&found, &named), ["..12", "..12", "..12"]);
    }

    #[test]
    fn windows_have_their_class_as_far_as_it_is_known_and_a_pair_that_is_tried_stands_out() {
        let known = [Some(Class::Line), Some(Class::Line), None, None];
        let view = WindowsView {
            size_px: 2,
            columns: 2,
            classes: known.to_vec(),
            areas: vec![0, 1, 2, 3],
            tried: Vec::new(),
        };
        let named = [
            ('.', CLEAR),
            ('L', [255, 0, 0, 255]),
            ('a', with_alpha(TAKEN, 235)),
            ('b', with_alpha(REFUSED, 235)),
            ('|', SEAM),
        ];
        let found = painted(InstantView::Windows(view.clone()), 4, 4, &look());
        assert_eq!(drawn(&found, &named), ["LLLL", "LLLL", "....", "...."]);
        let refused = WindowsView { tried: vec![0, 1], ..view.clone() };
        let found = painted(InstantView::Windows(refused), 4, 4, &look());
        assert_eq!(drawn(&found, &named), ["aa|b", "aa|b", "....", "...."]);
        let joined = WindowsView { tried: vec![0], areas: vec![0, 0, 2, 3], ..view };
        let found = painted(InstantView::Windows(joined), 4, 4, &look());
        assert_eq!(drawn(&found, &named), ["aaaa", "aaaa", "....", "...."]);
    }

    #[test]
    fn roles_are_shown_as_far_as_they_are_given() {
        let kinds = vec![PixelKind::Matte, PixelKind::Highlight, PixelKind::Restored, PixelKind::Unassigned];
        let kinds = Raster::from_vec(4, 1, kinds).unwrap();
        let view = RolesView { kinds, blob: Some((vec![3], true)), is_edge_judged: false };
        let found = painted(InstantView::Roles(view), 4, 1, &look());
        let color = |role: usize| with_alpha(ROLES[role].color, 255);
        let blob = with_alpha(TAKEN, 235);
        assert_eq!(found.as_slice(), [color(0), color(1), color(2), blob]);
    }
}
