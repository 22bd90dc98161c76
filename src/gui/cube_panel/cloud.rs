//! The photograph's colors as points: those in focus in full color, the others faint ("ghosts").

use crate::app::State;
use crate::gpu::{Batch, Point};
use crate::gui::theme::ThemeColors;
use crate::raster::Mask;
use crate::raster::RegionId;
use crate::trace::Class;
use crate::view::{
    ColorBy, ColorSpace, CubeSettings, Item, NamedMarks, Picture, ResultSnapshot, Theme, UniqueColor, marking,
};
use egui::Color32;
use std::sync::Arc;

/// Diameter of a point when sizes do not show counts, screen points.
const PLAIN_PT: f32 = 3.0;
/// Diameter of a bin with one pixel and of the fullest bin, screen points.
const SIZES_PT: [f32; 2] = [2.0, 9.0];
/// Largest diameter of a ghost, screen points.
const GHOST_PT: f32 = 1.8;
const GHOST_ALPHA: u8 = 72;

/// The points of a photograph.
#[derive(Default)]
pub struct Cloud {
    /// The inputs that the points were made from.
    inputs: Option<Inputs>,
    majorities: BinMajorities,
    /// The bins, in the histogram's order.
    pub bins: Vec<Point>,
    /// The points to draw: those in focus, then the ghosts.
    pub drawn: [Batch<Point>; 2],
    /// Number of pixels in the fullest bin.
    pub fullest: u32,
}

/// Majority region and class of each bin.
#[derive(Default)]
struct BinMajorities {
    /// The photograph and the result that were counted.
    counted: Option<(Arc<Picture>, Option<Arc<ResultSnapshot>>)>,
    /// Region that most pixels of each bin are in; 0 for no region.
    regions: Vec<u16>,
    /// Class that most pixels' windows have, per bin.
    classes: Vec<Option<Class>>,
}

impl BinMajorities {
    /// Counts again when photograph or result have changed.
    fn update(&mut self, picture: &Arc<Picture>, shown: Option<&Arc<ResultSnapshot>>) {
        let same = |(photograph, result): &(Arc<Picture>, Option<Arc<ResultSnapshot>>)| {
            Arc::ptr_eq(photograph, picture) && same_arc(result.as_ref(), shown)
        };
        if self.counted.as_ref().is_some_and(same) {
            return;
        }
        let (histogram, width) = (&picture.histogram, picture.size().0);
        (self.regions, self.classes) = shown.map_or_else(Default::default, |shown| {
            let classes = histogram.majority_class(&shown.analysis.windows, width);
            (histogram.majority(shown.labels()), classes)
        });
        self.counted = Some((Arc::clone(picture), shown.cloned()));
    }
}

/// Everything that the points depend on.
#[derive(Clone)]
struct Inputs {
    picture: Arc<Picture>,
    shown: Option<Arc<ResultSnapshot>>,
    marked: Option<Arc<Mask>>,
    named: Arc<NamedMarks>,
    item: Option<Item>,
    /// Color space, coloring, whether sizes show counts, whether the rest is ghosts, theme.
    settings: (ColorSpace, ColorBy, bool, bool, Theme),
    /// Factor of the diameters, and opacity of the points that are no ghosts.
    scale_and_opacity: [f32; 2],
    unique_colors: Option<Arc<[UniqueColor]>>,
    /// Whether all points are ghosts, because the pixels at the debugger's cursor are drawn instead.
    ghosts_only: bool,
}

impl Inputs {
    fn of(
        state: &State,
        picture: &Arc<Picture>,
        unique_colors: Option<&Arc<[UniqueColor]>>,
        ghosts_only: bool,
    ) -> Self {
        let CubeSettings { space, size_by_count, ghost_rest, point_scale, point_opacity, .. } =
            state.view.cube;
        let color_by = color_by(state);
        let selection = &state.document.selection;
        Self {
            picture: Arc::clone(picture),
            shown: state.shown().cloned(),
            marked: selection.marked.clone(),
            named: Arc::clone(&selection.named),
            item: selection.item,
            settings: (space, color_by, size_by_count, ghost_rest, state.view.theme),
            scale_and_opacity: [point_scale, point_opacity],
            unique_colors: unique_colors.cloned(),
            ghosts_only,
        }
    }

    /// Whether the points of both inputs are the same.
    fn is_same(&self, other: &Self) -> bool {
        let same = same_arc::<ResultSnapshot>;
        Arc::ptr_eq(&self.picture, &other.picture)
            && same(self.shown.as_ref(), other.shown.as_ref())
            && same_arc(self.marked.as_ref(), other.marked.as_ref())
            && Arc::ptr_eq(&self.named, &other.named)
            && same_arc(self.unique_colors.as_ref(), other.unique_colors.as_ref())
            && (self.item, self.settings, self.ghosts_only) == (other.item, other.settings, other.ghosts_only)
            && self.scale_and_opacity.map(f32::to_bits) == other.scale_and_opacity.map(f32::to_bits)
    }
}

/// The coloring of the points. Regions and classes belong to the result, which does not exist yet while the debugger's
/// cursor is followed: points then have their own color.
pub fn color_by(state: &State) -> ColorBy {
    match state.view.cube.color_by {
        ColorBy::Region | ColorBy::Class if state.followed().is_some() => ColorBy::Own,
        color_by => color_by,
    }
}

/// Whether two references are both none or lead to the same value.
fn same_arc<T: ?Sized>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

impl Cloud {
    /// Rebuilds the points when an input has changed. `unique_colors` holds the unique colors, if they are drawn in
    /// place of bins. With `ghosts_only`, all points are ghosts.
    pub fn update(
        &mut self,
        state: &State,
        palette: &ThemeColors,
        picture: &Arc<Picture>,
        unique_colors: Option<&Arc<[UniqueColor]>>,
        ghosts_only: bool,
    ) {
        let inputs = Inputs::of(state, picture, unique_colors, ghosts_only);
        if self.inputs.as_ref().is_some_and(|known| known.is_same(&inputs)) {
            return;
        }
        self.majorities.update(picture, inputs.shown.as_ref());
        let pixels_in_focus = if ghosts_only {
            Some(vec![0; picture.histogram.bins.len()])
        } else {
            pixels_in_focus(state, picture)
        };
        self.fullest = picture.histogram.bins.iter().map(|bin| bin.count).max().unwrap_or(1);
        let style = PointStyle {
            inputs: &inputs,
            majorities: &self.majorities,
            mark_colors: mark_colors(&inputs.named, picture),
            palette,
            fullest: self.fullest,
        };
        let bins = picture.histogram.bins.iter().enumerate();
        self.bins = bins.map(|(bin, of)| style.point(bin, of.mean, of.count)).collect();
        self.drawn = match &inputs.unique_colors {
            None => {
                let points = self.bins.iter().copied().enumerate();
                PointStyle::split(
                    points.map(|(bin, point)| (point, is_in_focus(pixels_in_focus.as_deref(), bin))),
                )
            }
            Some(colors) => PointStyle::split(colors.iter().map(|unique| {
                let mut point = style.point(unique.bin as usize, unique.color, unique.count);
                point.size_px = point.size_px.min(PLAIN_PT * inputs.scale_and_opacity[0]);
                (point, is_in_focus(pixels_in_focus.as_deref(), unique.bin as usize))
            })),
        };
        self.inputs = Some(inputs);
    }

    /// The region that most pixels of a bin are in; `None` when most are in none.
    pub fn region_of(&self, bin: u32) -> Option<RegionId> {
        RegionId::from_label(*self.majorities.regions.get(bin as usize)?)
    }
}

/// Whether a bin has pixels in focus; always true when nothing is selected.
fn is_in_focus(pixels_in_focus: Option<&[u32]>, bin: usize) -> bool {
    pixels_in_focus.is_none_or(|pixels_in_focus| pixels_in_focus[bin] > 0)
}

/// The color of the newest named mark that has pixels in a bin, per bin; empty without named marks.
fn mark_colors(named: &NamedMarks, picture: &Picture) -> Vec<Option<Color32>> {
    let mut colors = Vec::new();
    for mark in named.marks.iter().filter(|mark| mark.pixels > 0) {
        let counts = picture.histogram.bins_of(&mark.mask);
        colors.resize(counts.len(), None);
        let marked = colors.iter_mut().zip(counts).filter(|(_, count)| *count > 0);
        marked.for_each(|(color, _)| *color = Some(crate::gui::widgets::color(mark.color)));
    }
    colors
}

/// Number of pixels of each bin that are marked, in a named mark, or in the selected region, window or bin; `None` when no pixel is, or
/// when the setting `ghost_rest` is off.
fn pixels_in_focus(state: &State, picture: &Picture) -> Option<Vec<u32>> {
    if !state.view.cube.ghost_rest {
        return None;
    }
    let selection = &state.document.selection;
    let histogram = &picture.histogram;
    let item = state.selected_region().map(Item::Region).or(selection.item);
    let selected = item.zip(state.shown()).and_then(|(item, shown)| marking::mask_of(item, shown));
    let named = selection.named.marks.iter().map(|mark| &*mark.mask);
    let masks = selected.iter().chain(selection.marked.as_deref()).chain(named);
    let counts = masks.map(|mask| histogram.bins_of(mask)).reduce(|mut sum, counts| {
        sum.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        sum
    });
    counts.filter(|counts| counts.iter().any(|&count| count > 0))
}

/// Computes position, color and size of points.
struct PointStyle<'a> {
    inputs: &'a Inputs,
    majorities: &'a BinMajorities,
    /// The color of the named mark of each bin; empty without named marks.
    mark_colors: Vec<Option<Color32>>,
    palette: &'a ThemeColors,
    fullest: u32,
}

impl PointStyle<'_> {
    fn point(&self, bin: usize, counts: [f32; 3], pixels: u32) -> Point {
        let (space, color_by, size_by_count, ..) = self.inputs.settings;
        let full = self.inputs.picture.histogram.full_counts;
        let share = (pixels as f32).ln_1p() / (self.fullest as f32).ln_1p().max(1e-6);
        let of_mark = self.mark_colors.get(bin).copied().flatten();
        let color = of_mark.unwrap_or_else(|| match color_by {
            ColorBy::Own => {
                let contrast = self.inputs.picture.photo.image.contrast;
                crate::gui::widgets::own_color(counts, contrast)
            }
            ColorBy::Region => self.region_color(bin),
            ColorBy::Class => self
                .majorities
                .classes
                .get(bin)
                .copied()
                .flatten()
                .map_or(self.palette.secondary, class_color),
            ColorBy::Density => density_color(share, self.inputs.settings.4),
        });
        let size_px =
            if size_by_count { SIZES_PT[0] + (SIZES_PT[1] - SIZES_PT[0]) * share * share } else { PLAIN_PT };
        let [scale, opacity] = self.inputs.scale_and_opacity;
        let [r, g, b, _] = color.to_array();
        let alpha = (255.0 * opacity.clamp(0.0, 1.0)).round() as u8;
        let size_px = size_px * scale.clamp(0.1, 10.0);
        Point { position: space.place(counts, full), color: [r, g, b, alpha], size_px }
    }

    fn region_color(&self, bin: usize) -> Color32 {
        let region = self.majorities.regions.get(bin).copied().unwrap_or(0);
        let colors = self.inputs.shown.as_ref().map(|shown| shown.region_colors.as_slice());
        let color = colors.and_then(|colors| colors.get(usize::from(region).checked_sub(1)?));
        color.map_or(self.palette.secondary, |&color| crate::gui::widgets::color(color))
    }

    /// Separates the points in focus from the others, and makes the others ghosts.
    fn split(points: impl Iterator<Item = (Point, bool)>) -> [Batch<Point>; 2] {
        let (mut full, mut ghosts) = (Vec::new(), Vec::new());
        for (point, is_in_focus) in points {
            if is_in_focus {
                full.push(point);
            } else {
                let [r, g, b, _] = point.color;
                let size_px = point.size_px.min(GHOST_PT);
                ghosts.push(Point { color: [r, g, b, GHOST_ALPHA], size_px, ..point });
            }
        }
        [Batch::new(full), Batch::new(ghosts)]
    }
}

/// Color of a class, as in the paper's figures: point yellow, line red, plane green, volume blue.
pub const fn class_color(class: Class) -> Color32 {
    match class {
        Class::Point => Color32::from_rgb(0xF0, 0xD0, 0x30),
        Class::Line => Color32::from_rgb(0xE8, 0x4A, 0x40),
        Class::Plane => Color32::from_rgb(0x45, 0xB8, 0x50),
        Class::Volume => Color32::from_rgb(0x4A, 0x7A, 0xF0),
    }
}

/// Color of a bin's density, from 0 (few pixels) to 1 (the fullest bin). Contrast with the background
/// grows with density.
pub fn density_color(share: f32, theme: Theme) -> Color32 {
    // The color map Viridis at 0, 1/4, 1/2, 3/4 and 1 (Smith & van der Walt 2015).
    const STOPS: [[f32; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [59.0, 82.0, 139.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    // The part of the map that resembles the background is left out.
    let share = share.clamp(0.0, 1.0);
    let at = if theme == Theme::Dark { 0.6 + 3.4 * share } else { 3.4 * (1.0 - share) };
    let stop = (at as usize).min(3);
    let t = at - stop as f32;
    let [r, g, b] = std::array::from_fn(|i| STOPS[stop][i] + (STOPS[stop + 1][i] - STOPS[stop][i]) * t);
    Color32::from_rgb(r as u8, g as u8, b as u8)
}
