//! Pictures of the photograph and of what was found in it, as the image view shows them.
//!
//! Values are sRGB with straight alpha. What replaces the photograph ([`Layer::Body`] and its like) is drawn alone; what was
//! found about it ([`Layer::is_overlay`]) is drawn over it, as fills or as outlines one pixel wide inside each area.

mod curve;
mod instant;
mod marks;
mod pyramid;

pub use instant::{beside_color, instant_legend, paint_instant};
pub use marks::{ACCENT, marks};
pub use pyramid::pyramid;

use super::{Fill, ImageSettings, Layer, Picture, ResultSnapshot};
use crate::export::colored;
use crate::intrinsic::Reason;
use crate::photo::Masks;
use crate::raster::{LabelMap, Mask, Raster};
use crate::trace::Class;
pub(crate) use curve::Curve;
use rayon::prelude::*;

/// Body reflection that differs by this many counts is black or white in [`Layer::Difference`].
pub const DIFFERENCE_COUNTS: f32 = 64.0;

/// What is left of the color of regions that are not selected, while one is.
const DIMMED: f32 = 0.35;
/// Of regions of an earlier stage that no final region covers.
const GONE: [u8; 3] = [150, 150, 150];

/// Names, colors and meanings of the classes (section 5.2.1), in the paper's colors.
const CLASSES: [LegendEntry; 4] = [
    LegendEntry::new("point", [255, 255, 0], "5.2.1: no variation beyond the noise, a flat matte patch"),
    LegendEntry::new("line", [255, 0, 0], "5.2.1: one direction of variation, matte or highlight pixels"),
    LegendEntry::new(
        "plane",
        [0, 255, 0],
        "5.2.1: two directions, matte and highlight pixels or two objects",
    ),
    LegendEntry::new("volume", [0, 0, 255], "5.2.1: three directions, clipping or several objects"),
];

/// Names, colors and meanings of the masks (section 4). A pixel has the color of the last one that holds for it.
const MASKS: [LegendEntry; 5] = [
    LegendEntry::new("dark", [74, 111, 212], "4: too near to black, its color is mostly noise"),
    LegendEntry::new("bloomed", [240, 128, 32], "4: charge spilled over from clipped neighbors"),
    LegendEntry::new("clipped", [250, 226, 70], "4: a band at or above the clipping threshold"),
    LegendEntry::new("invalid", [210, 59, 214], "the file holds a negative or no number here"),
    LegendEntry::new("outside", [128, 128, 128], "outside the area that the analysis is restricted to"),
];

const NOISE: [LegendEntry; 3] = [
    LegendEntry::new("behind", [1, 1, 1], "6: on the face of the slice opposite to the plane's normal"),
    LegendEntry::new("in the plane", [128, 128, 128], "6: on the dichromatic plane, \u{3b5} = 0"),
    LegendEntry::new(
        "before",
        [255, 255, 255],
        "6: on the face of the slice that the plane's normal points to",
    ),
];

const DIFFERENCE: [LegendEntry; 3] = [
    LegendEntry::new("darker", [1, 1, 1], "body reflection 64 counts below the pinned result's"),
    LegendEntry::new("same", [128, 128, 128], "body reflection as in the pinned result"),
    LegendEntry::new("brighter", [255, 255, 255], "body reflection 64 counts above the pinned result's"),
];

const CONFIDENCE: [LegendEntry; 2] = [
    LegendEntry::new("not at all", [1, 1, 1], "the split of this pixel is not to be believed"),
    LegendEntry::new(
        "fully",
        [255, 255, 255],
        "the split of this pixel is to be believed as far as the model goes",
    ),
];

/// What keeps pixels from being explained, in the order of [`Reason::ALL`] from the second on.
const REASONS: [LegendEntry; 8] = [
    LegendEntry::new("shadow", [74, 111, 212], "5.6: too dark to be analyzed, shadow or background"),
    LegendEntry::new("no matte line", [160, 120, 220], "5.3: lit, but on no matte line that was found"),
    LegendEntry::new("mixed boundary", [120, 190, 200], "5.6: between two objects, a mixture of both"),
    LegendEntry::new(
        "off the plane",
        [90, 180, 110],
        "7.5: off the plane, light of a neighbor or a second material",
    ),
    LegendEntry::new(
        "texture",
        [232, 120, 90],
        "7.5: body and surface reflection vary against each other, a print",
    ),
    LegendEntry::new(
        "other object",
        [220, 140, 190],
        "5.5: the clipped highlight of another object than its region's",
    ),
    LegendEntry::new("collinear", [150, 150, 150], "3.2: the body has the light's color: gray, white, metal"),
    LegendEntry::new("clipped in all bands", [250, 226, 70], "5.5: nothing of its color is left to go by"),
];

/// What a color stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// Its name, a word or two.
    pub name: &'static str,
    /// The color, sRGB.
    pub color: [u8; 3],
    /// What it means, with the paper's section.
    pub tooltip: &'static str,
}

impl LegendEntry {
    const fn new(name: &'static str, color: [u8; 3], tooltip: &'static str) -> Self {
        Self { name, color, tooltip }
    }
}

/// The colors of `layer` that need explaining; none where it shows light, or regions, whose colors are in their table.
pub fn legend(layer: Layer) -> Vec<LegendEntry> {
    match layer {
        Layer::Classes => CLASSES.to_vec(),
        Layer::Masks => MASKS.to_vec(),
        Layer::Noise => NOISE.to_vec(),
        Layer::Difference => DIFFERENCE.to_vec(),
        Layer::Confidence => CONFIDENCE.to_vec(),
        Layer::Reasons => REASONS.to_vec(),
        Layer::Input
        | Layer::Areas
        | Layer::Linear
        | Layer::Planar
        | Layer::Regions
        | Layer::Body
        | Layer::Surface => Vec::new(),
    }
}

/// The classes in their order: point, line, plane, volume.
pub fn class_entries() -> [LegendEntry; 4] {
    CLASSES
}

/// How layers are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Stops; light is brighter by this power of two. It is the gain of [`Layer::Noise`] and [`Layer::Difference`] as well.
    pub exposure_ev: f32,
    /// sRGB values in 0…1 are raised to its inverse: above 1 the middle tones are brighter.
    pub gamma: f32,
    /// Fills or outlines.
    pub fill: Fill,
    /// Of fills, 0…1; outlines are opaque.
    pub opacity: f32,
    /// The region of the result shown that has its full color while all others are dimmed; none: all have theirs.
    pub selected: Option<u16>,
}

impl Look {
    /// The look that the image view asks for.
    pub fn of(settings: &ImageSettings, selected: Option<u16>) -> Self {
        let &ImageSettings { exposure_ev, gamma, fill, opacity, .. } = settings;
        Self { exposure_ev, gamma, fill, opacity, selected }
    }

    /// A color with the weight that it is laid over the photograph with.
    fn style(&self, color: [u8; 3], selected: bool) -> [u8; 4] {
        let full = if self.fill == Fill::Fill { self.opacity.clamp(0.0, 1.0) } else { 1.0 };
        let weight = if selected { full } else { full * DIMMED };
        [color[0], color[1], color[2], (weight * 255.0).round() as u8]
    }
}

impl Default for Look {
    fn default() -> Self {
        Self::of(&ImageSettings::default(), None)
    }
}

/// Draws `layer`, a pixel a pixel, opaque.
///
/// What needs a result is the photograph itself while `shown` has none of its size. [`Layer::Difference`] is gray where
/// there is no `pinned` result to compare with.
pub fn paint(
    layer: Layer,
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    pinned: Option<&ResultSnapshot>,
    look: &Look,
) -> Raster<[u8; 4]> {
    let fits = |shown: &&ResultSnapshot| shown.picture.size() == picture.size();
    let base = Base { photo: &picture.photo.image.pixels, curve: Curve::new(look.exposure_ev, look.gamma) };
    let Some(shown) = shown.filter(fits) else { return base.light(base.photo) };
    let analysis = &shown.analysis;
    match layer {
        Layer::Input => base.light(base.photo),
        Layer::Body => base.light(&analysis.intrinsic.body),
        Layer::Surface => base.light(&analysis.intrinsic.surface),
        Layer::Noise => {
            noise(&analysis.intrinsic.noise, analysis.used.slice_half_width_counts() as f32, look)
        }
        Layer::Difference => {
            let before = pinned.filter(fits).unwrap_or(shown);
            difference(&analysis.intrinsic.body, &before.analysis.intrinsic.body, look)
        }
        Layer::Confidence => confidence(&analysis.intrinsic.confidence),
        Layer::Reasons => reasons(&base, &analysis.intrinsic.reasons, look),
        Layer::Classes => classes(&base, shown, look),
        Layer::Areas => areas(&base, shown, look),
        Layer::Linear => stage(&base, shown.linear_labels(), shown, look),
        Layer::Planar => stage(&base, shown.planar_labels(), shown, look),
        Layer::Regions => regions(&base, shown, look),
        Layer::Masks => masks(&base, &analysis.masks, shown.area.as_deref(), look),
    }
}

/// The photograph under an overlay.
struct Base<'a> {
    photo: &'a Raster<[f32; 3]>,
    curve: Curve,
}

impl Base<'_> {
    /// Linear counts as they look.
    fn light(&self, counts: &Raster<[f32; 3]>) -> Raster<[u8; 4]> {
        each_row(counts, |colors, row| self.light_row(colors, row))
    }

    fn light_row(&self, colors: &[[f32; 3]], row: &mut [[u8; 4]]) {
        for (pixel, &[r, g, b]) in row.iter_mut().zip(colors) {
            *pixel = [self.curve.code(r), self.curve.code(g), self.curve.code(b), 255];
        }
    }

    /// The photograph with `styles[label(x, y)]` over it: a color and the weight that it has. Labels beyond `styles` are
    /// not drawn. As outlines, only pixels with a 4-neighbor of another label.
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

/// 128 for 0, 1 and 255 for ∓1.
fn swing(value: f32) -> u8 {
    (128.0 + 127.0 * value).round() as u8
}

fn noise(epsilon: &Raster<f32>, half_width_counts: f32, look: &Look) -> Raster<[u8; 4]> {
    let gain = look.exposure_ev.exp2() / half_width_counts;
    each_row(epsilon, |epsilon, row| {
        for (pixel, &epsilon) in row.iter_mut().zip(epsilon) {
            let gray = swing(epsilon * gain);
            *pixel = [gray, gray, gray, 255];
        }
    })
}

/// Black for 0, white for 1.
fn confidence(share: &Raster<f32>) -> Raster<[u8; 4]> {
    each_row(share, |share, row| {
        for (pixel, &share) in row.iter_mut().zip(share) {
            let gray = (share.clamp(0.0, 1.0) * 255.0).round() as u8;
            *pixel = [gray, gray, gray, 255];
        }
    })
}

/// A color for each reason; what is explained is left clear.
fn reasons(base: &Base, reasons: &Raster<Reason>, look: &Look) -> Raster<[u8; 4]> {
    let width = base.photo.width();
    base.overlaid(look.fill, &legend_styles(&REASONS, look), |x, y| reasons[y * width + x] as usize)
}

fn difference(now: &Raster<[f32; 3]>, before: &Raster<[f32; 3]>, look: &Look) -> Raster<[u8; 4]> {
    let gain = look.exposure_ev.exp2() / DIFFERENCE_COUNTS;
    let mut painted = Raster::filled(now.width(), now.height(), [0u8; 4]);
    let both = now.as_slice().par_iter().zip(before.as_slice());
    painted.as_mut_slice().par_iter_mut().zip(both).with_min_len(1 << 12).for_each(|(pixel, (a, b))| {
        let gray = |band: usize| swing((a[band] - b[band]) * gain);
        *pixel = [gray(0), gray(1), gray(2), 255];
    });
    painted
}

fn classes(base: &Base, shown: &ResultSnapshot, look: &Look) -> Raster<[u8; 4]> {
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
    // A division for each pixel would take longer than all else.
    let window = |length: usize| -> Vec<usize> { (0..length).map(|place| place / side_px).collect() };
    let (columns, rows) = (window(base.photo.width()), window(base.photo.height()));
    base.overlaid(look.fill, &styles, |x, y| *windows.get(columns[x], rows[y]).unwrap_or(&0))
}

/// Merged areas, each in a color that its neighbors do not have. They consist of whole windows.
fn areas(base: &Base, shown: &ResultSnapshot, look: &Look) -> Raster<[u8; 4]> {
    let side_px = shown.window_px();
    let areas = shown.areas();
    let (columns, rows) = (areas.width().div_ceil(side_px), areas.height().div_ceil(side_px));
    let corner = |window: usize| areas.row(window / columns * side_px)[window % columns * side_px];
    let windows = Raster::from_vec(columns, rows, (0..columns * rows).map(corner).collect());
    let windows = windows.unwrap_or_default();
    let colors = colored(&windows);
    let most = windows.as_slice().iter().max().map_or(0, |&area| area as usize);
    let mut styles = vec![[0; 4]; most + 1];
    for (&area, &color) in windows.as_slice().iter().zip(colors.as_slice()).filter(|(area, _)| **area > 0) {
        styles[area as usize] = look.style(color, true);
    }
    base.overlaid(look.fill, &styles, |x, y| areas[y * areas.width() + x] as usize)
}

fn regions(base: &Base, shown: &ResultSnapshot, look: &Look) -> Raster<[u8; 4]> {
    let selected = |id: usize| look.selected.is_none_or(|selected| usize::from(selected) == id);
    let colors = shown.region_colors.iter().zip(1..).map(|(&color, id)| look.style(color, selected(id)));
    let styles: Vec<[u8; 4]> = std::iter::once([0; 4]).chain(colors).collect();
    let labels = shown.labels();
    base.overlaid(look.fill, &styles, |x, y| usize::from(labels[y * labels.width() + x]))
}

/// Regions of an earlier stage, each in the color of the final region that covers most of it.
fn stage(base: &Base, labels: &LabelMap, shown: &ResultSnapshot, look: &Look) -> Raster<[u8; 4]> {
    let style = |best_overlap: u16| {
        let color =
            shown.region_colors.get(usize::from(best_overlap).wrapping_sub(1)).copied().unwrap_or(GONE);
        look.style(color, look.selected.is_none_or(|selected| selected == best_overlap))
    };
    let best_overlaps = super::snapshot::best_overlaps(labels, shown.labels());
    let styles: Vec<[u8; 4]> = std::iter::once([0; 4])
        .chain(best_overlaps.iter().skip(1).map(|&best_overlap| style(best_overlap)))
        .collect();
    base.overlaid(look.fill, &styles, |x, y| usize::from(labels[y * labels.width() + x]))
}

fn masks(base: &Base, masks: &Masks, area: Option<&Mask>, look: &Look) -> Raster<[u8; 4]> {
    let width = base.photo.width();
    base.overlaid(look.fill, &legend_styles(&MASKS, look), |x, y| {
        let pixel = y * width + x;
        match () {
            () if area.is_some_and(|area| !area[pixel]) => 5,
            () if masks.invalid(pixel) => 4,
            () if masks.clipped(pixel) => 3,
            () if masks.distorted(pixel) => 2,
            () => usize::from(masks.dark(pixel)),
        }
    })
}

fn legend_styles(entries: &[LegendEntry], look: &Look) -> Vec<[u8; 4]> {
    let styles = entries.iter().map(|entry| look.style(entry.color, true));
    std::iter::once([0; 4]).chain(styles).collect()
}

#[cfg(test)]
mod tests;
