//! The pictures of the layers, at the size of the photograph.

use super::curve::Curve;
use super::legends::{BORDERS, CLASSES, LAMPS, MASKS, REASONS};
use super::look::{DIFFERENCE_COUNTS, Fill, Look};
use crate::export::colored;
use crate::raster::{LabelMap, Raster, RegionId};
use crate::trace::Class;
use crate::view::elsewhere::{borders, label_colors};
use crate::view::snapshot::best_overlaps;
use crate::view::{Elsewhere, Lamp, LampOfPixels, LegendEntry, ResultSnapshot};
use rayon::prelude::*;

/// Color of regions of an earlier stage that no region of the result covers, sRGB.
const GONE: [u8; 3] = [150, 150, 150];

/// The input of a painter.
pub(super) struct PaintInput<'a> {
    /// The photograph, over which overlays are drawn.
    pub base: Base<'a>,
    /// The result, of the photograph's size.
    pub shown: &'a ResultSnapshot,
    /// The pinned result, of the photograph's size; none where nothing is pinned.
    pub pinned: Option<&'a ResultSnapshot>,
    /// What was made elsewhere.
    pub elsewhere: Option<&'a Elsewhere>,
    /// Exposure, fills and opacity.
    pub look: &'a Look,
}

impl PaintInput<'_> {
    /// The label map that was made elsewhere, of the photograph's size.
    fn other_labels(&self) -> Option<&LabelMap> {
        self.elsewhere?.pictures.labels.as_ref().filter(|labels| self.fits(labels))
    }

    /// The diffuse picture that was made elsewhere, linear counts, of the photograph's size.
    fn diffuse(&self) -> Option<&Raster<[f32; 3]>> {
        self.elsewhere?.pictures.diffuse.as_ref().filter(|diffuse| self.fits(diffuse))
    }

    fn fits<T>(&self, picture: &Raster<T>) -> bool {
        let photo = self.base.photo;
        (picture.width(), picture.height()) == (photo.width(), photo.height())
    }
}

/// The photograph, and the curve from counts to sRGB codes.
pub(super) struct Base<'a> {
    /// Linear counts of red, green and blue.
    pub photo: &'a Raster<[f32; 3]>,
    /// The curve from counts to codes.
    pub curve: Curve,
}

impl Base<'_> {
    /// Linear counts as opaque sRGB codes.
    pub fn light(&self, counts: &Raster<[f32; 3]>) -> Raster<[u8; 4]> {
        each_row(counts, |colors, row| self.light_row(colors, row))
    }

    fn light_row(&self, colors: &[[f32; 3]], row: &mut [[u8; 4]]) {
        for (pixel, &[r, g, b]) in row.iter_mut().zip(colors) {
            *pixel = [self.curve.code(r), self.curve.code(g), self.curve.code(b), 255];
        }
    }

    /// The photograph with `styles[label(x, y)]` over it: a color and its weight. Labels beyond `styles` are not drawn.
    /// With [`Fill::Outline`], only pixels with a 4-neighbor of another label are drawn over.
    fn overlaid(
        &self,
        fill: Fill,
        styles: &[[u8; 4]],
        label: impl Fn(usize, usize) -> usize + Sync,
    ) -> Raster<[u8; 4]> {
        let (width, height) = (self.photo.width(), self.photo.height());
        let mut painted = Raster::filled(width, height, [0u8; 4]);
        painted.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            self.light_row(self.photo.row(y), row);
            for (x, pixel) in row.iter_mut().enumerate() {
                let here = label(x, y);
                let Some(&style) = styles.get(here).filter(|style| style[3] > 0) else { continue };
                let on_border = || {
                    (x > 0 && label(x - 1, y) != here)
                        || (x + 1 < width && label(x + 1, y) != here)
                        || (y > 0 && label(x, y - 1) != here)
                        || (y + 1 < height && label(x, y + 1) != here)
                };
                if fill == Fill::Fill || on_border() {
                    *pixel = blended(*pixel, style);
                }
            }
        });
        painted
    }
}

/// An opaque pixel with a color over it; the color's fourth number is its weight.
fn blended(below: [u8; 4], over: [u8; 4]) -> [u8; 4] {
    let weight = u32::from(over[3]);
    let mix = |band: usize| {
        let sum = u32::from(below[band]) * (255 - weight) + u32::from(over[band]) * weight;
        ((sum + 127) / 255) as u8
    };
    [mix(0), mix(1), mix(2), 255]
}

/// Fills a picture from the rows of another, in parallel.
fn each_row<T: Sync>(from: &Raster<T>, paint: impl Fn(&[T], &mut [[u8; 4]]) + Sync) -> Raster<[u8; 4]> {
    let mut painted = Raster::filled(from.width(), from.height(), [0u8; 4]);
    let rows = painted.as_mut_slice().par_chunks_mut(from.width().max(1));
    rows.enumerate().for_each(|(y, row)| paint(from.row(y), row));
    painted
}

/// The gray of a number: 128 for 0, 1 and 255 for ∓1.
fn swing(value: f32) -> u8 {
    (128.0 + 127.0 * value).round() as u8
}

/// The photograph.
pub(super) fn photograph(input: &PaintInput) -> Raster<[u8; 4]> {
    input.base.light(input.base.photo)
}

/// Body reflection.
pub(super) fn body(input: &PaintInput) -> Raster<[u8; 4]> {
    input.base.light(&input.shown.analysis.intrinsic.body)
}

/// Surface reflection.
pub(super) fn surface(input: &PaintInput) -> Raster<[u8; 4]> {
    input.base.light(&input.shown.analysis.intrinsic.surface)
}

/// ε: gray for 0, black and white at the faces of the slice.
pub(super) fn noise(input: &PaintInput) -> Raster<[u8; 4]> {
    let analysis = &input.shown.analysis;
    let gain = input.look.exposure_ev.exp2() / analysis.used.slice_half_width_counts() as f32;
    each_row(&analysis.intrinsic.noise, |epsilon, row| {
        for (pixel, &epsilon) in row.iter_mut().zip(epsilon) {
            let gray = swing(epsilon * gain);
            *pixel = [gray, gray, gray, 255];
        }
    })
}

/// Confidence: black for 0, white for 1.
pub(super) fn confidence(input: &PaintInput) -> Raster<[u8; 4]> {
    each_row(&input.shown.analysis.intrinsic.confidence, |share, row| {
        for (pixel, &share) in row.iter_mut().zip(share) {
            let gray = (share.clamp(0.0, 1.0) * 255.0).round() as u8;
            *pixel = [gray, gray, gray, 255];
        }
    })
}

/// A color for each reason; explained pixels have the color of the photograph.
pub(super) fn reasons(input: &PaintInput) -> Raster<[u8; 4]> {
    let (base, look, reasons) = (&input.base, input.look, &input.shown.analysis.intrinsic.reasons);
    let width = base.photo.width();
    base.overlaid(look.fill, &legend_styles(&REASONS, look), |x, y| reasons[y * width + x] as usize)
}

/// A color for each of two lamps; pixels that are not split have the color of the photograph, which the whole layer is with one lamp.
pub(super) fn lamps(input: &PaintInput) -> Raster<[u8; 4]> {
    let Some(lamps) = LampOfPixels::of(&input.shown.analysis) else { return photograph(input) };
    let (base, look) = (&input.base, input.look);
    let width = base.photo.width();
    base.overlaid(look.fill, &legend_styles(&LAMPS, look), |x, y| match lamps.at(y * width + x) {
        None => 0,
        Some(Lamp::First) => 1,
        Some(Lamp::Second) => 2,
    })
}

/// Body reflection minus that of the pinned result; gray for 0.
pub(super) fn difference(input: &PaintInput) -> Raster<[u8; 4]> {
    let now = &input.shown.analysis.intrinsic.body;
    let before = &input.pinned.unwrap_or(input.shown).analysis.intrinsic.body;
    gray_difference(now, before, input.look)
}

/// Linear counts minus other counts; gray for 0, black and white for ∓[`DIFFERENCE_COUNTS`].
fn gray_difference(now: &Raster<[f32; 3]>, before: &Raster<[f32; 3]>, look: &Look) -> Raster<[u8; 4]> {
    let gain = look.exposure_ev.exp2() / DIFFERENCE_COUNTS;
    let mut painted = Raster::filled(now.width(), now.height(), [0u8; 4]);
    let both = now.as_slice().par_iter().zip(before.as_slice());
    painted.as_mut_slice().par_iter_mut().zip(both).with_min_len(1 << 12).for_each(|(pixel, (a, b))| {
        let gray = |band: usize| swing((a[band] - b[band]) * gain);
        *pixel = [gray(0), gray(1), gray(2), 255];
    });
    painted
}

/// Windows in the color of their class.
pub(super) fn classes(&PaintInput { ref base, shown, look, .. }: &PaintInput) -> Raster<[u8; 4]> {
    let number = |class: &Option<Class>| match class {
        None => 0,
        Some(Class::Point) => 1,
        Some(Class::Line) => 2,
        Some(Class::Plane) => 3,
        Some(Class::Volume) => 4,
    };
    let side_px = shown.window_px();
    let windows = shown.classes().map(number);
    let styles = legend_styles(&CLASSES, look);
    // A division for each pixel would take longer than the rest of the function.
    let window = |length: usize| -> Vec<usize> { (0..length).map(|place| place / side_px).collect() };
    let (columns, rows) = (window(base.photo.width()), window(base.photo.height()));
    base.overlaid(look.fill, &styles, |x, y| *windows.get(columns[x], rows[y]).unwrap_or(&0))
}

/// Merged areas, which consist of whole windows, each in a color that its neighbors do not have.
pub(super) fn areas(&PaintInput { ref base, shown, look, .. }: &PaintInput) -> Raster<[u8; 4]> {
    let side_px = shown.window_px();
    let areas = shown.areas();
    let (columns, rows) = (areas.width().div_ceil(side_px), areas.height().div_ceil(side_px));
    let corner = |window: usize| areas.row(window / columns * side_px)[window % columns * side_px];
    let windows = Raster::from_vec(columns, rows, (0..columns * rows).map(corner).collect());
    let windows = windows.unwrap_or_default();
    base.overlaid(look.fill, &colored_styles(&windows, look), |x, y| areas[y * areas.width() + x] as usize)
}

/// The regions of the result in their colors.
pub(super) fn regions(&PaintInput { ref base, shown, look, .. }: &PaintInput) -> Raster<[u8; 4]> {
    let selected = |id: RegionId| look.selected.is_none_or(|selected| selected == id);
    let colors = RegionId::all(shown.region_colors.len()).zip(&shown.region_colors);
    let colors = colors.map(|(id, &color)| look.style(color, selected(id)));
    let styles: Vec<[u8; 4]> = std::iter::once([0; 4]).chain(colors).collect();
    let labels = shown.labels();
    base.overlaid(look.fill, &styles, |x, y| usize::from(labels[y * labels.width() + x]))
}

/// The regions that Phoenix finds, each in a color that its neighbors do not have.
pub(super) fn phoenix(&PaintInput { ref base, shown, look, .. }: &PaintInput) -> Raster<[u8; 4]> {
    let labels = shown.phoenix_labels();
    base.overlaid(look.fill, &colored_styles(labels, look), |x, y| {
        usize::from(labels[y * labels.width() + x])
    })
}

/// The labels that were made elsewhere; the photograph where there are none.
pub(super) fn other_regions(input: &PaintInput) -> Raster<[u8; 4]> {
    let Some(labels) = input.other_labels() else { return photograph(input) };
    let mut styles: Vec<[u8; 4]> =
        label_colors(labels, input.shown).into_iter().map(|color| input.look.style(color, true)).collect();
    if let Some(none) = styles.first_mut() {
        *none = [0; 4];
    }
    input.base.overlaid(input.look.fill, &styles, |x, y| usize::from(labels[y * labels.width() + x]))
}

/// The borders of regions and of the labels that were made elsewhere; the photograph where there are no such labels.
pub(super) fn other_borders(input: &PaintInput) -> Raster<[u8; 4]> {
    let Some(labels) = input.other_labels() else { return photograph(input) };
    let kinds = borders(input.shown.labels(), labels);
    // Lines are opaque, as outlines are.
    let look = Look { fill: Fill::Outline, ..*input.look };
    let styles = legend_styles(&BORDERS, &look);
    input.base.overlaid(Fill::Fill, &styles, |x, y| usize::from(kinds[y * kinds.width() + x]))
}

/// The diffuse picture that was made elsewhere; the photograph where there is none.
pub(super) fn other_body(input: &PaintInput) -> Raster<[u8; 4]> {
    input.base.light(input.diffuse().unwrap_or(input.base.photo))
}

/// The diffuse picture that was made elsewhere minus body reflection; the photograph where there is none.
pub(super) fn other_difference(input: &PaintInput) -> Raster<[u8; 4]> {
    let Some(diffuse) = input.diffuse() else { return photograph(input) };
    gray_difference(diffuse, &input.shown.analysis.intrinsic.body, input.look)
}

/// Regions after the linear stage.
pub(super) fn linear(input: &PaintInput) -> Raster<[u8; 4]> {
    stage(input, input.shown.linear_labels())
}

/// Regions after the planar stage.
pub(super) fn planar(input: &PaintInput) -> Raster<[u8; 4]> {
    stage(input, input.shown.planar_labels())
}

/// Regions of an earlier stage, each in the color of the region of the result that covers most of its pixels.
fn stage(&PaintInput { ref base, shown, look, .. }: &PaintInput, labels: &LabelMap) -> Raster<[u8; 4]> {
    let style = |best_overlap: Option<RegionId>| {
        let color = best_overlap.and_then(|region| shown.region_colors.get(region.index()).copied());
        look.style(color.unwrap_or(GONE), look.selected.is_none_or(|selected| Some(selected) == best_overlap))
    };
    let best_overlaps = best_overlaps(labels, shown.labels());
    let styles: Vec<[u8; 4]> = std::iter::once([0; 4])
        .chain(best_overlaps.iter().skip(1).map(|&best_overlap| style(best_overlap)))
        .collect();
    base.overlaid(look.fill, &styles, |x, y| usize::from(labels[y * labels.width() + x]))
}

/// Masks of the photograph, and the pixels outside the analyzed area.
pub(super) fn masks(&PaintInput { ref base, shown, look, .. }: &PaintInput) -> Raster<[u8; 4]> {
    let (masks, area) = (&shown.analysis.masks, shown.area.as_deref());
    let width = base.photo.width();
    base.overlaid(look.fill, &legend_styles(&MASKS, look), |x, y| {
        let pixel = y * width + x;
        if area.is_some_and(|area| !area[pixel]) {
            6
        } else if masks.invalid(pixel) {
            5
        } else if masks.in_clipped_object(pixel) {
            4
        } else if masks.clipped(pixel) {
            3
        } else if masks.distorted(pixel) {
            2
        } else {
            usize::from(masks.dark(pixel))
        }
    })
}

/// A style for each label, in a color that the labels of its neighbors do not have; none for label 0.
fn colored_styles<T: Copy + Into<u32>>(labels: &Raster<T>, look: &Look) -> Vec<[u8; 4]> {
    let numbers = || labels.as_slice().iter().map(|&label| label.into() as usize);
    let mut styles = vec![[0; 4]; numbers().max().unwrap_or(0) + 1];
    for (label, &color) in numbers().zip(colored(labels).as_slice()).filter(|(label, _)| *label > 0) {
        styles[label] = look.style(color, true);
    }
    styles
}

fn legend_styles(entries: &[LegendEntry], look: &Look) -> Vec<[u8; 4]> {
    let styles = entries.iter().map(|entry| look.style(entry.color, true));
    std::iter::once([0; 4]).chain(styles).collect()
}
