//! The picture's position on the screen. The pixel of column x and row y covers the square from (x, y)
//! to (x + 1, y + 1).

use crate::raster::PixelIndex;
use crate::view::ImageSettings;
use egui::{Pos2, Rect, Vec2, pos2, vec2};

/// Margin around a fitted picture, screen points.
const MARGIN_PT: f32 = 6.0;
/// Largest zoom, screen points per image pixel. A picture that is fitted into its view may exceed the limit.
const MAX_ZOOM: f32 = 192.0;
/// Length of the picture's longer side at the smallest zoom, screen points. A smaller view lowers the smallest zoom.
const MIN_SIDE_PT: f32 = 32.0;

/// Position and zoom of a picture in a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rectangle of the view, screen points.
    pub view: Rect,
    /// Columns and rows of the picture.
    pub size: Vec2,
    /// Zoom, screen points per pixel.
    pub zoom: f32,
    /// The point of the picture in the middle of the view, pixels.
    pub center: Pos2,
}

impl Placement {
    /// The placement in the settings, limited so that a part of the picture is visible.
    pub fn new(view: Rect, size: Vec2, settings: &ImageSettings) -> Self {
        let zoom = settings.zoom.unwrap_or_else(|| fitting_zoom(view, size));
        let center = match (settings.zoom, settings.center_px) {
            (Some(_), Some([x, y])) => pos2(x, y),
            _ => (size / 2.0).to_pos2(),
        };
        Self { view, size, zoom, center }.clamped()
    }

    /// The placement of a picture of another size in the same view: the same part of the picture by fractions of its sides. The whole
    /// picture fits where the whole of this one fits.
    #[must_use]
    pub fn of_size(&self, size: Vec2) -> Self {
        let zoom = self.zoom * fitting_zoom(self.view, size) / fitting_zoom(self.view, self.size);
        let sides = self.size.max(Vec2::splat(1.0));
        let center = (self.center.to_vec2() / sides * size).to_pos2();
        Self { size, zoom, center, ..*self }.clamped()
    }

    /// Stores zoom and center in the settings.
    pub fn store(&self, settings: &mut ImageSettings) {
        settings.zoom = Some(self.zoom);
        settings.center_px = Some(self.center.into());
    }

    /// Screen position of a point of the picture.
    pub fn screen_from_image(&self, point: Pos2) -> Pos2 {
        self.view.center() + (point - self.center) * self.zoom
    }

    /// The point of the picture at a screen position, pixels.
    pub fn image_from_screen(&self, point: Pos2) -> Pos2 {
        self.center + (point - self.view.center()) / self.zoom
    }

    /// Rectangle of the picture on the screen.
    pub fn screen_rect(&self) -> Rect {
        self.screen_rect_of(Rect::from_min_size(Pos2::ZERO, self.size))
    }

    /// Screen rectangle of a part of the picture.
    pub fn screen_rect_of(&self, part: Rect) -> Rect {
        Rect::from_min_max(self.screen_from_image(part.min), self.screen_from_image(part.max))
    }

    /// Row-major index of the pixel at a screen position; `None` outside of the picture.
    pub fn pixel_at(&self, point: Pos2) -> Option<PixelIndex> {
        let at = self.image_from_screen(point);
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.size.x && at.y < self.size.y;
        inside.then(|| PixelIndex::new(at.y as u32 * self.size.x as u32 + at.x as u32))
    }

    /// The square that a pixel covers in the picture, pixels.
    pub fn square_of(&self, pixel: PixelIndex) -> Rect {
        let [x, y] = pixel.position(self.size.x as usize);
        Rect::from_min_size(pos2(x as f32, y as f32), vec2(1.0, 1.0))
    }

    /// The visible part of the picture: the ranges of columns and of rows.
    pub fn visible(&self) -> [std::ops::Range<usize>; 2] {
        let from = self.image_from_screen(self.view.min).max(Pos2::ZERO).floor();
        let to = self.image_from_screen(self.view.max).min(self.size.to_pos2()).ceil();
        [from.x as usize..to.x.max(0.0) as usize, from.y as usize..to.y.max(0.0) as usize]
    }

    /// This placement zoomed by a factor; the point of the picture at `anchor` on the screen stays there.
    #[must_use]
    pub fn zoomed(mut self, factor: f32, anchor: Pos2) -> Self {
        let fixed = self.image_from_screen(anchor);
        self.zoom =
            (self.zoom * factor).clamp(min_zoom(self.view, self.size), max_zoom(self.view, self.size));
        self.center = fixed - (anchor - self.view.center()) / self.zoom;
        self.clamped()
    }

    /// This placement with the picture moved by `by`, screen points.
    #[must_use]
    pub fn panned(mut self, by: Vec2) -> Self {
        self.center -= by / self.zoom;
        self.clamped()
    }

    /// This placement with zoom and center limited: a point of the picture is always in the middle of the view.
    fn clamped(mut self) -> Self {
        self.zoom = self.zoom.clamp(min_zoom(self.view, self.size), max_zoom(self.view, self.size));
        self.center = self.center.clamp(Pos2::ZERO, self.size.to_pos2());
        self
    }
}

/// The zoom at which the whole picture is seen, screen points per pixel.
fn fitting_zoom(view: Rect, size: Vec2) -> f32 {
    let free = (view.size() - Vec2::splat(2.0 * MARGIN_PT)).max(Vec2::splat(1.0));
    (free / size.max(Vec2::splat(1.0))).min_elem()
}

/// Smallest zoom, screen points per image pixel: the zoom at which the longer side has [`MIN_SIDE_PT`], or the zoom at which
/// the picture fits into a view that is smaller.
fn min_zoom(view: Rect, size: Vec2) -> f32 {
    (MIN_SIDE_PT / size.max_elem().max(1.0)).min(fitting_zoom(view, size))
}

/// Largest zoom, screen points per image pixel: [`MAX_ZOOM`], or the zoom at which a tiny picture fits into its view.
fn max_zoom(view: Rect, size: Vec2) -> f32 {
    MAX_ZOOM.max(fitting_zoom(view, size))
}

/// Index of the copy to draw among `levels` copies of a picture: copy 0 is the picture itself, and each further copy has half
/// the columns and rows of the copy before. The chosen copy has at least one and less than two texels per screen pixel,
/// unless the last copy still has more. `screen_pixels_per_image_pixel` is the zoom, screen pixels per image pixel.
pub fn level_for(screen_pixels_per_image_pixel: f32, levels: usize) -> usize {
    let level = (1.0 / screen_pixels_per_image_pixel.max(f32::MIN_POSITIVE)).log2().floor();
    (level.max(0.0) as usize).min(levels.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placement(settings: &ImageSettings) -> Placement {
        Placement::new(
            Rect::from_min_size(pos2(100.0, 50.0), vec2(600.0, 400.0)),
            vec2(512.0, 480.0),
            settings,
        )
    }

    #[test]
    fn a_picture_of_another_size_shows_the_same_part_and_the_way_back_is_the_same_placement() {
        let place = placement(&ImageSettings::default()).zoomed(3.0, pos2(250.0, 200.0));
        let twice = place.of_size(place.size * 2.0);
        let part = |place: &Placement, at: Pos2| place.image_from_screen(at).to_vec2() / place.size;
        for at in [pos2(110.0, 60.0), pos2(400.0, 300.0)] {
            assert!((part(&place, at) - part(&twice, at)).length() < 1e-4);
        }
        let back = place.of_size(vec2(640.0, 300.0)).of_size(place.size);
        assert!((back.zoom - place.zoom).abs() < 1e-4 && (back.center - place.center).length() < 1e-2);
    }

    #[test]
    fn the_whole_picture_fits_and_is_in_the_middle() {
        let place = placement(&ImageSettings::default());
        assert!(place.view.contains_rect(place.screen_rect()));
        assert!((place.screen_rect().center() - place.view.center()).length() < 1e-3);
        assert!((place.zoom - (400.0 - 12.0) / 480.0).abs() < 1e-6);
        assert_eq!(place.visible(), [0..512, 0..480]);
    }

    #[test]
    fn from_the_screen_to_the_picture_and_back() {
        for zoom in [None, Some(0.3), Some(1.0), Some(17.3)] {
            let settings =
                ImageSettings { zoom, center_px: Some([130.5, 77.25]), ..ImageSettings::default() };
            let place = placement(&settings);
            for point in [pos2(100.0, 50.0), pos2(333.3, 222.2), pos2(699.0, 449.0)] {
                let back = place.screen_from_image(place.image_from_screen(point));
                assert!((back - point).length() < 1e-2, "{zoom:?} {point:?} {back:?}");
            }
        }
    }

    #[test]
    fn a_point_is_in_the_pixel_whose_square_holds_it() {
        let place = placement(&ImageSettings { zoom: Some(4.0), ..ImageSettings::default() });
        let pixel = place.pixel_at(pos2(400.0, 250.0)).unwrap();
        assert_eq!(pixel, PixelIndex::new(240 * 512 + 256));
        assert!(place.screen_rect_of(place.square_of(pixel)).contains(pos2(401.0, 251.0)));
        let fitted = placement(&ImageSettings::default());
        assert_eq!(fitted.pixel_at(fitted.screen_rect().min - vec2(1.0, 1.0)), None);
        assert_eq!(fitted.pixel_at(fitted.screen_rect().max + vec2(1.0, 1.0)), None);
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let pointer = pos2(321.0, 187.0);
        let mut place = placement(&ImageSettings::default());
        let under = place.image_from_screen(pointer);
        for factor in [1.25, 1.25, 3.0, 0.5, 8.0] {
            place = place.zoomed(factor, pointer);
            assert!((place.image_from_screen(pointer) - under).length() < 1e-2);
        }
    }

    #[test]
    fn panning_and_zooming_leave_a_part_of_the_picture_in_the_view() {
        let place = placement(&ImageSettings::default());
        for by in [vec2(1e6, -1e6), vec2(-1e6, 0.0)] {
            let moved = place.panned(by);
            assert!(moved.view.intersects(moved.screen_rect()));
        }
        let far = place.zoomed(1e-9, place.view.min);
        assert!(far.screen_rect().size().max_elem() >= MIN_SIDE_PT - 1e-3);
        assert!((place.zoomed(1e9, place.view.min).zoom - MAX_ZOOM).abs() < 1e-3);
    }

    #[test]
    fn the_copy_drawn_has_at_least_one_and_less_than_two_texels_per_screen_pixel() {
        for (scale, level) in [(8.0, 0), (1.0, 0), (0.51, 0), (0.5, 1), (0.26, 1), (0.1, 3), (0.001, 4)] {
            assert_eq!(level_for(scale, 5), level, "{scale}");
        }
        assert_eq!(level_for(0.1, 1), 0);
    }
}
