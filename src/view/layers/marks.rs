//! The selection and the hovered item, as a picture to draw over any layer.

use crate::raster::{Mask, Raster};
use crate::view::{ACCENT, Item, NamedMark, Picture, ResultSnapshot, Selection};
use rayon::prelude::*;

/// Opacity of the fill of marked pixels.
const FILL_ALPHA: u8 = 72;
const OUTLINE: [u8; 4] = with_alpha(ACCENT, 255);
const HOVERED: [u8; 4] = [255, 255, 255, 220];
/// The color around an outline, which stands out from a bright object of the outline's color.
const AROUND: [u8; 4] = [0, 0, 0, 150];
const CLEAR: [u8; 4] = [0; 4];

/// The marked pixels (a translucent fill and an outline), the selected region, window or color bin and the hovered item, at the
/// size of the picture, as sRGB with straight alpha. None where there is nothing to draw.
///
/// Of a result for the working picture, the picture has the size of the working picture, and the selected and hovered regions alone.
///
/// Outlines are one pixel wide, inside, with a dark line around. A single pixel is too small to be drawn here: views draw a cross-hair.
pub fn marks(
    picture: &Picture,
    shown: Option<&ResultSnapshot>,
    selection: &Selection,
    hover: Option<Item>,
) -> Option<Raster<[u8; 4]>> {
    let shown = shown.filter(|shown| shown.picture.size() == picture.size());
    let (width, height) =
        shown.map_or_else(|| picture.size(), |shown| (shown.labels().width(), shown.labels().height()));
    let marked = selection.marked.as_deref().filter(|mask| (mask.width(), mask.height()) == (width, height));
    let drawn = |item: &Item| match *item {
        Item::Pixel(_) => false,
        Item::Region(_) | Item::Window(_) => shown.is_some(),
        Item::Bin(bin) => (bin as usize) < picture.histogram.bins.len(),
    };
    let (selected, hover) = (selection.item.filter(drawn), hover.filter(drawn));
    let fits = |mark: &&NamedMark| (mark.mask.width(), mark.mask.height()) == (width, height);
    let named: Vec<&NamedMark> = selection.named.marks.iter().filter(fits).collect();
    if marked.is_none() && selected.is_none() && hover.is_none() && named.is_empty() {
        return None;
    }
    let mut canvas = Canvas { picture, shown, painted: Raster::filled(width, height, CLEAR) };
    for mark in named {
        canvas.fill(&mark.mask, mark.color);
    }
    if let Some(mask) = marked {
        canvas.fill(mask, ACCENT);
    }
    for (item, color) in [(selected, OUTLINE), (hover, HOVERED)] {
        if let Some(item) = item {
            canvas.item(item, color);
        }
    }
    Some(canvas.painted)
}

const fn with_alpha([r, g, b]: [u8; 3], alpha: u8) -> [u8; 4] {
    [r, g, b, alpha]
}

struct Canvas<'a> {
    picture: &'a Picture,
    shown: Option<&'a ResultSnapshot>,
    painted: Raster<[u8; 4]>,
}

impl Canvas<'_> {
    /// Paints a translucent fill and an outline.
    fn fill(&mut self, mask: &Mask, color: [u8; 3]) {
        let fill = Some(with_alpha(color, FILL_ALPHA));
        self.outline(mask, |on| on, with_alpha(color, 255), fill);
    }

    fn item(&mut self, item: Item, color: [u8; 4]) {
        match (item, self.shown) {
            (Item::Region(region), Some(shown)) => {
                let region = region.get();
                self.outline(shown.labels(), |label| label == region, color, None);
            }
            (Item::Window(window), Some(shown)) => {
                let (side_px, columns) = (shown.window_px(), shown.classes().width().max(1));
                let (left, top) = (window as usize % columns * side_px, window as usize / columns * side_px);
                self.frame(left, top, side_px, color);
            }
            (Item::Bin(bin), _) => {
                for pixel in self.picture.histogram.pixels_of(bin) {
                    self.painted[pixel as usize] = color;
                }
            }
            _ => {}
        }
    }

    /// Paints the outline of a square, cut off at the border of the picture.
    fn frame(&mut self, left: usize, top: usize, side_px: usize, color: [u8; 4]) {
        let right = (left + side_px).min(self.painted.width());
        let bottom = (top + side_px).min(self.painted.height());
        let width = self.painted.width();
        for y in top..bottom {
            for x in left..right {
                if x == left || x + 1 == right || y == top || y + 1 == bottom {
                    self.painted[y * width + x] = color;
                }
            }
        }
    }

    /// Paints the border of the area in which the values are inside, the dark line around the border, and what is left of the area with the
    /// fill. A line around does not cover the outline of another area.
    fn outline<T: Copy + Sync>(
        &mut self,
        values: &Raster<T>,
        inside: impl Fn(T) -> bool + Sync,
        line: [u8; 4],
        fill: Option<[u8; 4]>,
    ) {
        let (width, height) = (self.painted.width().max(1), self.painted.height());
        let is_inside = |row: Option<&[T]>, x: usize| row.is_some_and(|row| inside(row[x]));
        self.painted.as_mut_slice().par_chunks_mut(width).enumerate().for_each(|(y, painted)| {
            let here = Some(values.row(y));
            let above = (y > 0).then(|| values.row(y - 1));
            let below = (y + 1 < height).then(|| values.row(y + 1));
            let rows = [here, above, below];
            if !rows.into_iter().flatten().any(|row| row.iter().any(|&value| inside(value))) {
                return;
            }
            for (x, pixel) in painted.iter_mut().enumerate() {
                let beside = [
                    is_inside(above, x),
                    is_inside(below, x),
                    x > 0 && is_inside(here, x - 1),
                    x + 1 < width && is_inside(here, x + 1),
                ];
                if is_inside(here, x) {
                    let color = if beside == [true; 4] { fill } else { Some(line) };
                    *pixel = color.unwrap_or(*pixel);
                } else if beside != [false; 4] && pixel[3] < 255 {
                    *pixel = AROUND;
                }
            }
        });
    }
}
