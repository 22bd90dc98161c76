//! Painting over a layer: pixel grid and values at a large zoom, outlines, crosses, the profile's line, and texts.

use super::geometry::Placement;
use super::icons::{corners, cross};
use super::textures::LayerTexture;
use crate::app::State;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets;
use crate::raster::PixelIndex;
use crate::view::{
    ACCENT, DIFFERENCE_COUNTS, Item, Layer, LayerPixels, LegendEntry, ProfileLine, Tool, legend, reason_entry,
};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2};

/// The accent color over pictures, the same in both themes, because a picture is equally dark in both.
pub const MARK_COLOR: Color32 = Color32::from_rgb(ACCENT[0], ACCENT[1], ACCENT[2]);
/// Smallest zoom with a pixel grid, screen points per pixel.
const GRID_ZOOM: f32 = 8.0;
/// Smallest zoom with one number in each pixel, screen points per pixel.
const NUMBER_ZOOM: f32 = 16.0;
/// Smallest zoom with a number for each band, screen points per pixel.
const BANDS_ZOOM: f32 = 32.0;
/// Smallest zoom at which numbers have a decimal, screen points per pixel.
const DECIMALS_ZOOM: f32 = 48.0;
/// Smallest zoom at which outlines are lines between pixels, screen points per pixel; below, outlines are
/// pixels of a texture.
pub const OUTLINE_ZOOM: f32 = 4.0;

/// Paints lines between pixels.
pub fn grid(painter: &Painter, place: &Placement) {
    if place.zoom < GRID_ZOOM {
        return;
    }
    // The contrast of the grid grows with the zoom.
    let strength = ((place.zoom - GRID_ZOOM) / GRID_ZOOM).clamp(0.2, 1.0);
    let stroke = Stroke::new(1.0, Color32::from_gray(128).gamma_multiply(0.35 * strength));
    let area = place.screen_rect().intersect(place.view);
    let [columns, rows] = place.visible();
    for x in columns.start..=columns.end {
        painter.vline(place.screen_from_image(pos2(x as f32, 0.0)).x, area.y_range(), stroke);
    }
    for y in rows.start..=rows.end {
        painter.hline(area.x_range(), place.screen_from_image(pos2(0.0, y as f32)).y, stroke);
    }
}

/// Writes numbers into the pixels: the layer's numbers if the layer has numbers, otherwise the photograph's linear counts. At a
/// small zoom a pixel has room for one number: the mean of the bands.
pub fn values(painter: &Painter, place: &Placement, state: &State, layer: Layer, texture: &LayerTexture) {
    if place.zoom < NUMBER_ZOOM {
        return;
    }
    let Some(picture) = &state.picture else { return };
    let of = state.shown().map(|shown| LayerPixels {
        intrinsic: &shown.analysis.intrinsic,
        elsewhere: state.elsewhere.as_deref(),
    });
    let is_mean = place.zoom < BANDS_ZOOM;
    let size = if is_mean { place.zoom / 2.3 } else { place.zoom / 4.0 }.clamp(7.0, 13.0);
    let decimals = usize::from(place.zoom >= DECIMALS_ZOOM);
    let [columns, rows] = place.visible();
    for y in rows {
        for x in columns.clone() {
            let pixel = y * place.size.x as usize + x;
            let numbers = of.and_then(|of| layer.numbers(of, pixel));
            let mut lines = numbers.unwrap_or_else(|| picture.photo.image.pixels[pixel].to_vec());
            if is_mean {
                lines = vec![lines.iter().sum::<f32>() / lines.len().max(1) as f32];
            }
            let tone = readable_on(texture.color(pixel));
            let middle = place.screen_from_image(pos2(x as f32 + 0.5, y as f32 + 0.5));
            for (line, value) in lines.iter().enumerate() {
                let down = (line as f32 - (lines.len() as f32 - 1.0) / 2.0) * size * 1.15;
                let font = FontId::proportional(size);
                painter.text(
                    middle + vec2(0.0, down),
                    Align2::CENTER_CENTER,
                    widgets::signed(f64::from(*value), decimals),
                    font,
                    tone,
                );
            }
        }
    }
}

/// Black or white, whichever has more contrast with an sRGB color; at a luminance of 0.18 both have the same.
fn readable_on([r, g, b, _]: [u8; 4]) -> Color32 {
    // A square approximates the sRGB curve well enough for this choice.
    let light = |code: u8| (f32::from(code) / 255.0).powi(2);
    let luminance = 0.21 * light(r) + 0.72 * light(g) + 0.07 * light(b);
    if luminance > 0.18 { Color32::BLACK } else { Color32::WHITE }
}

/// Paints the outlines of marked pixels and of selected and hovered items as lines between pixels, for a zoom of at
/// least `OUTLINE_ZOOM`.
pub fn outlines(painter: &Painter, place: &Placement, state: &State) {
    let (Some(picture), width) = (&state.picture, place.size.x as usize) else { return };
    let selection = &state.document.selection;
    for mark in &selection.named.marks {
        let [r, g, b] = mark.color;
        let (color, inside) =
            (Color32::from_rgb(r, g, b), |x: usize, y: usize| mark.mask.get(x, y) == Some(&true));
        fill(painter, place, color.gamma_multiply(0.28), inside);
        edges(painter, place, color, inside);
    }
    if let Some(mask) = &selection.marked {
        let marked = |x: usize, y: usize| mask.get(x, y).copied().unwrap_or(false);
        fill(painter, place, MARK_COLOR.gamma_multiply(0.28), marked);
        edges(painter, place, MARK_COLOR, marked);
    }
    // Regions and windows belong to the result, which does not exist yet while the debugger's cursor is followed, and not as it was in the
    // preview of the next result.
    let shown = state.shown().filter(|_| state.followed().is_none() && state.shown_preview().is_none());
    if let Some((preview, region)) = state.outlined_in_preview() {
        let (labels, side, label) = (preview.shown.labels(), preview.blocks.side(), region.get());
        edges(painter, place, MARK_COLOR, |x, y| labels.get(x / side, y / side) == Some(&label));
    }
    for (item, color) in [(selection.item, MARK_COLOR), (state.hover, Color32::WHITE)] {
        match (item, shown) {
            (Some(Item::Region(region)), Some(shown)) => {
                let label = region.get();
                edges(painter, place, color, |x, y| shown.labels().get(x, y) == Some(&label));
            }
            (Some(Item::Window(window)), Some(shown)) => {
                let (side_px, columns) = (shown.window_px(), shown.classes().width().max(1));
                let at = [window as usize % columns, window as usize / columns].map(|k| (k * side_px) as f32);
                let square = Rect::from_min_size(at.into(), egui::Vec2::splat(side_px as f32));
                frame(painter, place.screen_rect_of(square), color);
            }
            (Some(Item::Bin(bin)), _) => {
                let of_bin = |x, y| picture.histogram.bin_of(y * width + x) == Some(bin);
                fill(painter, place, color.gamma_multiply(0.8), of_bin);
            }
            _ => {}
        }
    }
}

/// Writes name and number of pixels of the named mark under the pointer beside the pointer.
pub fn mark_at_pointer(
    ui: &egui::Ui,
    painter: &Painter,
    palette: &ThemeColors,
    place: &Placement,
    state: &State,
) {
    let Some(Item::Pixel(pixel)) = state.hover else { return };
    let Some(mark) = state.document.selection.named.at(pixel.index()) else { return };
    let square = place.screen_rect_of(place.square_of(pixel));
    let text = format!("{}: {} px", mark.name, crate::describe::grouped(mark.pixels));
    let area = text_box(painter, palette, square.center() + vec2(12.0, 14.0), Align2::LEFT_TOP, &text);
    let label = ui.interact(area, ui.scope_id().with("mark at the pointer"), egui::Sense::empty());
    label.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, text.clone()));
}

/// Largest number of pixels of hovered colors that have a ring each.
const MOST_RINGS: usize = 150;
/// Largest number of pixels of hovered colors that are painted; of more, evenly spread ones.
const MOST_HOVERED: usize = 20_000;

/// Paints the pixels whose colors are near the pointer in the color space view: white over the dimmed picture, and with a ring
/// each where they are few.
pub fn hovered_colors(painter: &Painter, place: &Placement, state: &State) {
    let pixels = &*state.hover_pixels;
    if pixels.is_empty() {
        return;
    }
    painter.rect_filled(place.screen_rect().intersect(place.view), 0.0, Color32::from_black_alpha(120));
    let mut mesh = egui::Mesh::default();
    for &pixel in pixels.iter().step_by(pixels.len().div_ceil(MOST_HOVERED)) {
        let square = place.screen_rect_of(place.square_of(PixelIndex::new(pixel)));
        let side = square.size().max(Vec2::splat(2.0));
        mesh.add_colored_rect(Rect::from_center_size(square.center(), side), Color32::WHITE);
    }
    painter.add(Shape::mesh(mesh));
    if pixels.len() <= MOST_RINGS {
        for &pixel in pixels {
            let square = place.screen_rect_of(place.square_of(PixelIndex::new(pixel)));
            let radius = 5.0 + 0.5 * square.width();
            for stroke in [Stroke::new(3.0, Color32::from_black_alpha(140)), Stroke::new(1.4, MARK_COLOR)] {
                painter.circle_stroke(square.center(), radius, stroke);
            }
        }
    }
}

/// Fills the visible pixels that are inside.
fn fill(painter: &Painter, place: &Placement, color: Color32, inside: impl Fn(usize, usize) -> bool) {
    let [columns, rows] = place.visible();
    for y in rows {
        let mut from = None;
        for x in columns.start..=columns.end {
            let here = x < columns.end && inside(x, y);
            match (from, here) {
                (None, true) => from = Some(x),
                (Some(start), false) => {
                    let run =
                        Rect::from_min_max(pos2(start as f32, y as f32), pos2(x as f32, y as f32 + 1.0));
                    painter.rect_filled(place.screen_rect_of(run), 0.0, color);
                    from = None;
                }
                _ => {}
            }
        }
    }
}

/// Paints lines between pixels that are inside and pixels that are not.
fn edges(painter: &Painter, place: &Placement, color: Color32, inside: impl Fn(usize, usize) -> bool) {
    let [columns, rows] = place.visible();
    let on_screen = |(x, y): (usize, usize)| place.screen_from_image(pos2(x as f32, y as f32));
    let mut lines = Vec::new();
    let mut line = |a: (usize, usize), b: (usize, usize)| lines.push([on_screen(a), on_screen(b)]);
    for y in rows {
        for x in columns.clone() {
            if !inside(x, y) {
                continue;
            }
            if x == 0 || !inside(x - 1, y) {
                line((x, y), (x, y + 1));
            }
            if !inside(x + 1, y) {
                line((x + 1, y), (x + 1, y + 1));
            }
            if y == 0 || !inside(x, y - 1) {
                line((x, y), (x + 1, y));
            }
            if !inside(x, y + 1) {
                line((x, y + 1), (x + 1, y + 1));
            }
        }
    }
    for stroke in [Stroke::new(3.5, Color32::from_black_alpha(140)), Stroke::new(1.5, color)] {
        painter.extend(lines.iter().map(|&line| Shape::line_segment(line, stroke)));
    }
}

/// Paints a frame with a dark border.
fn frame(painter: &Painter, area: Rect, color: Color32) {
    painter.add(Shape::line(corners(area).to_vec(), Stroke::new(3.0, Color32::from_black_alpha(140))));
    painter.add(Shape::line(corners(area).to_vec(), Stroke::new(1.4, color)));
}

/// Marks the selected pixel and the hovered pixel. At a small zoom the hovered pixel has no mark in the view under the
/// pointer (`pointer_here`).
pub fn pixels(painter: &Painter, place: &Placement, state: &State, pointer_here: bool) {
    let paint_pixel = |item: Option<Item>, color: Color32, at_any_zoom: bool| {
        let Some(Item::Pixel(pixel)) = item else { return };
        let square = place.screen_rect_of(place.square_of(pixel));
        if place.zoom >= GRID_ZOOM {
            frame(painter, square, color);
        } else if at_any_zoom {
            cross(painter, square.center(), color);
        }
    };
    paint_pixel(state.explained_pixel().map(Item::Pixel), MARK_COLOR, true);
    paint_pixel(state.hover, Color32::WHITE, !pointer_here);
}

/// Paints the line of the profile, with handles while the profile tool is chosen.
pub fn profile(painter: &Painter, place: &Placement, state: &State) {
    let editing = state.view.image.tool == Tool::Profile;
    let ends = match state.view.profile {
        ProfileLine::Between(a, b) => [a, b].map(Pos2::from),
        line if editing => full_line(line, place, state),
        _ => return,
    };
    let [a, b] = ends.map(|end| place.screen_from_image(end));
    let strength = if editing { 1.0 } else { 0.6 };
    painter.line_segment([a, b], Stroke::new(3.0, Color32::from_black_alpha(130)));
    painter.line_segment([a, b], Stroke::new(1.3, MARK_COLOR.gamma_multiply(strength)));
    if editing && matches!(state.view.profile, ProfileLine::Between(..)) {
        for end in [a, b] {
            painter.circle(end, 4.0, Color32::from_black_alpha(160), Stroke::new(1.5, MARK_COLOR));
        }
    }
}

/// Ends of the row or column of the hovered pixel, otherwise of the selected one, otherwise of the
/// picture's middle, pixels.
fn full_line(line: ProfileLine, place: &Placement, state: &State) -> [Pos2; 2] {
    let pixel = [state.hover, state.document.selection.item].into_iter().find_map(|item| match item {
        Some(Item::Pixel(pixel)) => Some(place.square_of(pixel).center()),
        _ => None,
    });
    let through = pixel.unwrap_or((place.size / 2.0).to_pos2());
    if line == ProfileLine::Column {
        [pos2(through.x, 0.0), pos2(through.x, place.size.y)]
    } else {
        [pos2(0.0, through.y), pos2(place.size.x, through.y)]
    }
}

/// Writes a text with a background over the picture; returns the rectangle.
pub fn text_box(painter: &Painter, palette: &ThemeColors, at: Pos2, align: Align2, text: &str) -> Rect {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(SMALL_PT), palette.text);
    let area = align.anchor_size(at, galley.size() + vec2(10.0, 4.0));
    painter.rect_filled(area, 3.0, palette.panel.gamma_multiply(0.86));
    painter.galley(area.min + vec2(5.0, 2.0), galley, palette.text);
    area
}

/// Paints the legend of a layer along the lower edge: a bar with units where grays stand for numbers, otherwise colors and names.
pub fn layer_legend(painter: &Painter, palette: &ThemeColors, view: Rect, layer: Layer, state: &State) {
    let slice = state.shown().map(|shown| shown.analysis.used.slice_half_width_counts());
    match (layer, slice) {
        (Layer::Noise, Some(slice)) => {
            let [low, high] = [-slice, slice].map(|counts| widgets::signed(counts, 1));
            color_bar(painter, palette, view, &[&low, "0", &format!("{high} counts off the plane")]);
        }
        (Layer::Difference | Layer::OtherDifference, _) => {
            let [low, high] = [-1.0, 1.0].map(|sign| widgets::signed(sign * f64::from(DIFFERENCE_COUNTS), 0));
            color_bar(painter, palette, view, &[&low, "0", &format!("{high} counts")]);
        }
        (Layer::Confidence, _) => color_bar(painter, palette, view, &["0 not at all", "fully 1"]),
        (Layer::Reasons, Some(_)) => {
            let found = state.shown().map_or(&[][..], |shown| shown.reasons());
            let entries: Vec<LegendEntry> = found.iter().copied().filter_map(reason_entry).collect();
            legend_box(painter, palette, view, &entries);
        }
        _ => legend_box(painter, palette, view, &legend(layer)),
    }
}

/// Width and height of a bar of grays, points.
const BAR_PT: Vec2 = vec2(160.0, 8.0);

/// Paints a bar from black to white along the lower edge, with texts at equal distances below.
fn color_bar(painter: &Painter, palette: &ThemeColors, view: Rect, texts: &[&str]) {
    let corner = view.left_bottom() + vec2(6.0, -38.0);
    let galleys: Vec<_> = texts
        .iter()
        .map(|text| painter.layout_no_wrap((*text).to_owned(), FontId::proportional(SMALL_PT), palette.text))
        .collect();
    let last = galleys.len().saturating_sub(1).max(1) as f32;
    let end = galleys.last().map_or(0.0, |galley| galley.size().x);
    // The first two texts of three are centered below their places; the last begins below its place.
    let width = (BAR_PT.x + end + 12.0).min(view.width() - 12.0);
    painter.rect_filled(
        Rect::from_min_size(corner, vec2(width, 32.0)),
        3.0,
        palette.panel.gamma_multiply(0.86),
    );
    let bar = Rect::from_min_size(corner + vec2(18.0, 4.0), vec2(BAR_PT.x - 24.0, BAR_PT.y));
    let mut mesh = egui::Mesh::default();
    for (x, gray) in [(bar.left(), 1), (bar.right(), 255)] {
        mesh.colored_vertex(pos2(x, bar.top()), Color32::from_gray(gray));
        mesh.colored_vertex(pos2(x, bar.bottom()), Color32::from_gray(gray));
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(1, 2, 3);
    painter.add(Shape::mesh(mesh));
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, palette.secondary), egui::StrokeKind::Outside);
    for (index, galley) in galleys.into_iter().enumerate() {
        let x = bar.left() + bar.width() * index as f32 / last;
        let shift = if index as f32 >= last { 8.0 } else { galley.size().x / 2.0 };
        painter.galley(pos2((x - shift).max(corner.x + 3.0), bar.bottom() + 2.0), galley, palette.text);
    }
}

/// Paints a legend of colors and names along the lower edge, in as many lines as needed and as leave room for the layer's name above;
/// what does not fit is counted in the last line.
pub fn legend_box(painter: &Painter, palette: &ThemeColors, view: Rect, entries: &[LegendEntry]) {
    const LINE_PT: f32 = 18.0;
    const NAME_PT: f32 = 28.0;
    let layout = |text: String| painter.layout_no_wrap(text, FontId::proportional(SMALL_PT), palette.text);
    let most = view.width() - 12.0;
    let mut lines: Vec<(f32, Vec<_>)> = Vec::new();
    for entry in entries {
        let galley = layout(entry.name.to_owned());
        let step = galley.size().x + 24.0;
        match lines.last_mut() {
            Some((width, line)) if *width + step <= most => {
                *width += step;
                line.push((Some(entry.color), galley));
            }
            _ => lines.push((step + 2.0, vec![(Some(entry.color), galley)])),
        }
    }
    let most_lines = (((view.height() - NAME_PT - 6.0) / LINE_PT) as usize).max(1);
    if lines.len() > most_lines {
        let left_out: usize = lines.drain(most_lines - 1..).map(|(_, line)| line.len()).sum();
        let galley = layout(format!("{left_out} more"));
        lines.push((galley.size().x + 12.0, vec![(None, galley)]));
    }
    let top = view.bottom() - 6.0 - LINE_PT * lines.len() as f32;
    for (index, (width, line)) in lines.into_iter().enumerate() {
        let corner = pos2(view.left() + 6.0, top + LINE_PT * index as f32);
        let area = Rect::from_min_size(corner, vec2(width, LINE_PT));
        painter.rect_filled(area, 3.0, palette.panel.gamma_multiply(0.86));
        let mut x = area.left() + 6.0;
        for (color, galley) in line {
            if let Some(color) = color {
                let chip = Rect::from_center_size(pos2(x + 4.5, area.center().y), vec2(9.0, 9.0));
                painter.rect_filled(chip, 2.0, crate::gui::widgets::color(color));
                x += 13.0;
            }
            let (text, step) = (pos2(x, area.center().y - galley.size().y / 2.0), galley.size().x + 11.0);
            painter.galley(text, galley, palette.text);
            x += step;
        }
    }
}
