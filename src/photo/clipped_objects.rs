//! Rule `clipped_objects`: a clipped area with an abrupt edge is a thing that clips, and no highlight (no counterpart in the paper).
//!
//! The sky between leaves, a lamp, white paint and white letters clip like highlights do. At their edges a pixel mixes two things: the body reflection
//! behind is replaced, where surface reflection would be added to it. Neither regions nor the local split can tell such a mixture from a highlight by its color.
//! The shape tells them apart. The surface reflection around the clipped core of a highlight falls off gradually, the more so the larger the
//! core: around a core of radius R pixels of a Gaussian lobe whose peak is P times as bright as the clip threshold, exp(−2 ln P / R) of the
//! surface reflection is left one pixel farther out. An edge is as narrow as the blur of lens and file, however large the area is.
//!
//! The clipped areas of the working picture are judged by their smallest band, in which surface reflection differs most from colored body reflection: by
//! its means over the rings of 1 px around the area. What is left one pixel farther out is the mean of two shares: that of the rise of the first ring above
//! the darkest ring that the second has, and that of the fall from the first ring to the second that follows from the second to the third. R is twice the
//! number of the area's pixels divided by that of the first ring, which for a disk is its radius.
//!
//! Where body reflection clips one band alone, the edge of the area is not that of the core, and may be as abrupt as the body colors are. White areas, whose smallest
//! band nearly clips on average, are held to a higher limit therefore, and areas in most pixels of which all bands clip to a still higher one.
//!
//! The highlight of a facet ends at the edges of the facet, and a highlight may be hidden in part by another object. Such areas are few and small, so that areas
//! with abrupt edges are objects only where they are a good part of what clips, and of the picture. In a picture with objects, an area of any size whose edge is
//! as narrow as theirs is one too.
//! The pixels of an object and of its edge are not analyzed: they keep the colors of the photograph.

use super::{LinearImage, Masks};
use crate::raster::{ComponentSearch, Connectivity, Mask, Raster};

/// Least radius of an area that is judged, pixels.
const LEAST_RADIUS_PX: f64 = 1.0;
/// Least radius of an area that tells of objects, pixels: a narrower highlight may be as abrupt as an edge.
const LEAST_TELLING_RADIUS_PX: f64 = 2.0;
/// Number of rings around an area; the darkest from the third on is the foot of a highlight.
const RINGS: usize = 8;
/// Rings that are the edge of an object.
const EDGE_RINGS: usize = 2;
/// Least number of pixels of a ring that tells something, as a share of those of the first ring.
const LEAST_RING_SHARE: f64 = 0.2;
/// The same as a number of pixels.
const LEAST_RING_PIXELS: f64 = 3.0;
/// Least difference between the area and the foot, as a share of the clip threshold: the area is another color than its surroundings.
const LEAST_CONTRAST: f64 = 0.2;
/// Least difference of the first ring and what lies outside of it that a farther one is compared with, as a share of the clip threshold.
const LEAST_RISE: f64 = 0.02;
/// Most that an edge leaves one pixel farther out, as a share: lens, demosaicing and compression blur it.
const MOST_LEFT_OF_AN_EDGE: f64 = 0.25;
/// The same of an area of any radius in a picture with objects.
const MOST_LEFT_BESIDE_OBJECTS: f64 = 0.2;
/// Least mean of the smallest band of a white area, as a share of the clip threshold.
const LEAST_OF_WHITE: f64 = 0.7;
/// Most that the edge of a white area leaves, as a share of what the brightest highlight leaves.
const MOST_LEFT_OF_WHITE: f64 = 0.6;
/// Least share of the pixels of a saturated area in which all bands clip.
const LEAST_SATURATED: f64 = 0.8;
/// Most that the edge of a saturated area leaves, as a share of what the brightest highlight leaves.
const MOST_LEFT_OF_SATURATED: f64 = 0.8;
/// 2 ln P for the brightest highlight, P = 20.
const FALL: f64 = 6.0;
/// Least share of the clipped pixels of all judged areas that lie in areas with abrupt edges, if these are objects.
const LEAST_OF_CLIPPED: f64 = 0.25;
/// The same as a share of the picture.
const LEAST_OF_PICTURE: f64 = 0.005;

/// What a clipped area is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ClippedAreaVerdict {
    /// The edge is gradual, or the area is narrow: it may be a highlight.
    MayBeHighlight,
    /// The edge is abrupt, but too few clipped pixels of the picture have such an edge: the area may be the highlight of a facet, or hidden in part.
    Few,
    /// The area is an object that clips, and no highlight.
    Object,
}

/// A clipped area that was judged.
#[derive(Clone, Debug, PartialEq)]
pub struct ClippedArea {
    /// The clipped pixels and those of the edge around them, in ascending order.
    pub pixels: Vec<usize>,
    /// Number of clipped pixels.
    pub clipped: usize,
    /// The share of surface reflection that would be left one pixel farther out.
    pub left: f64,
    /// The share below which the edge is abrupt; 0 where the area is too narrow to tell.
    pub most_left: f64,
    /// What the area is.
    pub verdict: ClippedAreaVerdict,
}

impl ClippedArea {
    fn is_abrupt(&self) -> bool {
        self.left < self.most_left
    }
}

/// The clipped areas of a picture that are large and bright enough to be judged, in the order of their first pixels. `clip_threshold`: value
/// from which on a band is clipped, counts.
pub fn clipped_areas(image: &LinearImage, masks: &Masks, clip_threshold: f64) -> Vec<ClippedArea> {
    let Some(mut found) = Areas::new(image, masks, clip_threshold) else { return Vec::new() };
    found.find_rings(image, masks);
    let mut judged_of = vec![None; found.profiles.len()];
    let mut judged = Vec::new();
    for (profile, place) in found.profiles.iter().zip(&mut judged_of) {
        let Some((left, most_left)) = profile.left(clip_threshold) else { continue };
        *place = Some(judged.len());
        let verdict = ClippedAreaVerdict::MayBeHighlight;
        let clipped = profile.area.pixels;
        judged.push(ClippedArea { pixels: Vec::new(), clipped, left, most_left, verdict });
    }
    judge(&mut judged, (0..found.owners.len()).filter(|&pixel| masks.has_value(pixel)).count());
    for pixel in 0..found.owners.len() {
        let owner = (found.owners[pixel] as usize).checked_sub(1);
        let place = owner.and_then(|area| judged_of[area]);
        if let Some(place) = place.filter(|_| masks.clipped(pixel) || found.is_edge[pixel]) {
            judged[place].pixels.push(pixel);
        }
    }
    judged
}

/// Sets the verdicts on the areas of a picture of `pixels` pixels.
fn judge(areas: &mut [ClippedArea], pixels: usize) {
    let clipped = |area: &ClippedArea| area.clipped as f64;
    let abrupt: f64 = areas.iter().filter(|area| area.is_abrupt()).map(clipped).sum();
    let all: f64 = areas.iter().map(clipped).sum();
    let are_objects =
        abrupt > 0.0 && abrupt >= LEAST_OF_CLIPPED * all && abrupt >= LEAST_OF_PICTURE * pixels as f64;
    for area in areas {
        if are_objects {
            area.most_left = area.most_left.max(MOST_LEFT_BESIDE_OBJECTS);
        }
        area.verdict = match area.is_abrupt() {
            false => ClippedAreaVerdict::MayBeHighlight,
            true if are_objects => ClippedAreaVerdict::Object,
            true => ClippedAreaVerdict::Few,
        };
    }
}

/// Pixels and the sum of their smallest bands, counts.
#[derive(Clone, Copy, Default)]
struct Sum {
    pixels: usize,
    value: f64,
}

impl Sum {
    fn add(&mut self, color: [f32; 3]) {
        self.pixels += 1;
        self.value += f64::from(color[0].min(color[1]).min(color[2]));
    }

    fn mean(self) -> f64 {
        self.value / self.pixels.max(1) as f64
    }
}

/// A clipped area and the rings around it.
#[derive(Clone, Copy, Default)]
struct Profile {
    area: Sum,
    /// Number of the area's pixels in which all bands clip.
    saturated: usize,
    rings: [Sum; RINGS],
}

impl Profile {
    /// The share of surface reflection that is left one pixel farther out, if the area is the core of a highlight, and the share below which an edge is
    /// abrupt; none where the area is too narrow, has too little around it, or is no brighter than its surroundings.
    fn left(&self, clip_threshold: f64) -> Option<(f64, f64)> {
        let [first, second, third, ..] = self.rings;
        let least = (LEAST_RING_SHARE * first.pixels as f64).max(LEAST_RING_PIXELS);
        let known = |ring: &Sum| ring.pixels as f64 >= least;
        let radius_px = 2.0 * self.area.pixels as f64 / first.pixels.max(1) as f64;
        if radius_px < LEAST_RADIUS_PX || ![first, second, third].iter().all(known) {
            return None;
        }
        if self.area.mean() - third.mean() <= LEAST_CONTRAST * clip_threshold {
            return None;
        }
        let farther = self.rings.iter().skip(2).filter(|ring| known(ring)).map(|ring| ring.mean());
        let foot = farther.fold(f64::INFINITY, f64::min);
        let fall = |from: f64, to: f64| (from - to).max(LEAST_RISE * clip_threshold);
        let of_rise = (second.mean() - foot) / fall(first.mean(), foot);
        let of_fall = (second.mean() - third.mean()) / fall(first.mean(), second.mean());
        let tells = radius_px >= LEAST_TELLING_RADIUS_PX;
        let most_left = if tells { self.most_left((-FALL / radius_px).exp(), clip_threshold) } else { 0.0 };
        Some((0.5 * (of_rise + of_fall), most_left))
    }

    /// The share below which the edge of the area is abrupt. `left_of_highlight`: the share that the brightest highlight of this radius leaves.
    fn most_left(&self, left_of_highlight: f64, clip_threshold: f64) -> f64 {
        let share = if self.saturated as f64 >= LEAST_SATURATED * self.area.pixels as f64 {
            MOST_LEFT_OF_SATURATED
        } else if self.area.mean() >= LEAST_OF_WHITE * clip_threshold {
            MOST_LEFT_OF_WHITE
        } else {
            0.0
        };
        MOST_LEFT_OF_AN_EDGE.min(left_of_highlight).max(share * left_of_highlight)
    }
}

/// The clipped areas of a picture.
struct Areas {
    /// The number of the area that each pixel belongs to or is nearest to, from 1; 0 for pixels far from all.
    owners: Raster<u32>,
    /// The unclipped pixels next to an area.
    is_edge: Mask,
    /// The areas, by their number less 1.
    profiles: Vec<Profile>,
}

impl Areas {
    /// The clipped areas without their rings; none where nothing is clipped.
    fn new(image: &LinearImage, masks: &Masks, clip_threshold: f64) -> Option<Self> {
        let (width, height) = masks.shape();
        let clipped = |pixel: usize| masks.clipped(pixel) && masks.has_value(pixel);
        let first = (0..width * height).find(|&pixel| clipped(pixel))?;
        let mut search = ComponentSearch::new(width, height, Connectivity::Eight);
        let mut owners = Raster::filled(width, height, 0u32);
        let mut profiles = Vec::new();
        for start in first..owners.len() {
            let Some(area) = search.component_at(start, clipped) else { continue };
            let mut profile = Profile::default();
            for &pixel in area {
                owners[pixel] = profiles.len() as u32 + 1;
                let color = image.pixels[pixel];
                profile.area.add(color);
                profile.saturated += usize::from(color.iter().all(|&band| f64::from(band) >= clip_threshold));
            }
            profiles.push(profile);
        }
        Some(Self { owners, is_edge: Raster::filled(width, height, false), profiles })
    }

    /// Finds the rings of all areas. A pixel that is as near to two areas belongs to the ring of one of them.
    fn find_rings(&mut self, image: &LinearImage, masks: &Masks) {
        let mut ring: Vec<usize> = (0..self.owners.len()).filter(|&pixel| self.owners[pixel] != 0).collect();
        for number in 0..RINGS {
            let mut next = Vec::new();
            for pixel in ring {
                let owner = self.owners[pixel];
                for near in self.owners.around(pixel) {
                    if self.owners[near] == 0 && !masks.clipped(near) && masks.has_value(near) {
                        self.owners[near] = owner;
                        self.is_edge[near] = number < EDGE_RINGS;
                        self.profiles[owner as usize - 1].rings[number].add(image.pixels[near]);
                        next.push(near);
                    }
                }
            }
            ring = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::MaskLimits;

    const LIMITS: MaskLimits = MaskLimits { min_intensity: 5.0, clip_threshold: 250.0, bloom_density: 1 };
    const SIZE: usize = 120;
    const BODY: [f64; 3] = [150.0, 60.0, 20.0];

    /// The areas of a picture whose color at a place is `color`, clipped at 255 counts.
    fn areas(color: impl Fn(f64, f64) -> [f64; 3]) -> Vec<ClippedArea> {
        let at = |pixel: usize| color((pixel % SIZE) as f64, (pixel / SIZE) as f64);
        let data = (0..SIZE * SIZE).map(|pixel| at(pixel).map(|value| value.min(255.0) as f32)).collect();
        let image = LinearImage::new(Raster::from_vec(SIZE, SIZE, data).unwrap(), Some(255.0));
        clipped_areas(&image, &Masks::new(&image, &LIMITS), LIMITS.clip_threshold)
    }

    /// Body reflection and a Gaussian lobe of surface reflection with this peak, counts, and standard deviation, pixels.
    fn lobe(peak: f64, width_px: f64) -> impl Fn(f64, f64) -> [f64; 3] {
        move |x, y| {
            let surface =
                peak * (-((x - 60.0).powi(2) + (y - 60.0).powi(2)) / (2.0 * width_px.powi(2))).exp();
            BODY.map(|body| body + surface)
        }
    }

    /// White of this brightness, counts, in a disk with this radius, pixels, before body reflection. The edge is mixed over `blur_px` to either side.
    fn disk(white: f64, radius_px: f64, blur_px: f64) -> impl Fn(f64, f64) -> [f64; 3] {
        move |x, y| {
            let inside = radius_px - (x - 60.0).hypot(y - 60.0);
            let share = (0.5 + 0.5 * inside / blur_px).clamp(0.0, 1.0);
            BODY.map(|body| share * white + (1.0 - share) * body)
        }
    }

    #[test]
    fn a_lobe_of_any_size_may_be_a_highlight() {
        for (peak, width_px) in [(400.0, 2.5), (400.0, 12.0), (1500.0, 3.0), (3000.0, 8.0)] {
            let found = areas(lobe(peak, width_px));
            assert_eq!(found.len(), 1, "peak {peak}, width {width_px}");
            assert_eq!(
                found[0].verdict,
                ClippedAreaVerdict::MayBeHighlight,
                "{} of {}",
                found[0].left,
                found[0].most_left
            );
        }
    }

    #[test]
    fn a_white_disk_of_any_size_is_an_object() {
        for (white, radius_px, blur_px) in [(300.0, 6.0, 0.7), (300.0, 30.0, 0.7), (500.0, 12.0, 1.2)] {
            let found = areas(disk(white, radius_px, blur_px));
            assert_eq!(found.len(), 1);
            assert_eq!(
                found[0].verdict,
                ClippedAreaVerdict::Object,
                "{} of {}",
                found[0].left,
                found[0].most_left
            );
            let expected = std::f64::consts::PI * radius_px.powi(2);
            assert!((found[0].clipped as f64 / expected - 1.0).abs() < 0.2, "{} pixels", found[0].clipped);
            assert!(found[0].pixels.is_sorted() && found[0].pixels.len() > found[0].clipped);
        }
    }

    #[test]
    fn a_large_white_area_is_an_object_with_a_wider_edge_than_a_colored_one() {
        let blurred = |color: [f64; 3]| {
            move |x: f64, y: f64| {
                let inside = 30.0 - (x - 60.0).hypot(y - 60.0);
                let share = 1.0 / (1.0 + (-inside / 1.2).exp());
                std::array::from_fn(|band| share * color[band] + (1.0 - share) * BODY[band])
            }
        };
        let white = areas(blurred([400.0; 3]));
        assert_eq!(white.len(), 1);
        assert!(white[0].left > MOST_LEFT_OF_AN_EDGE, "{}", white[0].left);
        assert_eq!(
            white[0].verdict,
            ClippedAreaVerdict::Object,
            "{} of {}",
            white[0].left,
            white[0].most_left
        );
        let red = areas(blurred([400.0, 140.0, 140.0]));
        assert_eq!(red.len(), 1);
        assert!(red[0].most_left <= MOST_LEFT_OF_AN_EDGE, "{}", red[0].most_left);
        assert_eq!(red[0].verdict, ClippedAreaVerdict::MayBeHighlight, "{}", red[0].left);
    }

    #[test]
    fn a_small_abrupt_area_beside_large_highlights_is_few() {
        let (highlight, white) = (lobe(1500.0, 12.0), disk(300.0, 5.0, 0.7));
        let found =
            areas(|x, y| if x < 15.0 && y < 15.0 { white(x + 52.0, y + 52.0) } else { highlight(x, y) });
        let verdicts: Vec<_> = found.iter().map(|area| area.verdict).collect();
        assert_eq!(verdicts, [ClippedAreaVerdict::Few, ClippedAreaVerdict::MayBeHighlight]);
    }

    #[test]
    fn a_narrow_area_beside_an_object_is_one_too() {
        let white = disk(300.0, 20.0, 0.7);
        let found = areas(|x, y| if (x - 5.0).abs() < 1.0 { [300.0; 3] } else { white(x, y) });
        let verdicts: Vec<_> = found.iter().map(|area| area.verdict).collect();
        assert_eq!(verdicts, [ClippedAreaVerdict::Object; 2]);
    }

    #[test]
    fn narrow_areas_alone_tell_nothing_and_areas_of_the_color_around_them_are_not_judged() {
        let line = |x: f64, _| if (x - 60.0).abs() < 1.0 { [300.0; 3] } else { BODY };
        assert!(areas(line).iter().all(|area| area.verdict == ClippedAreaVerdict::MayBeHighlight));
        let red = disk(0.0, 20.0, 0.7);
        assert_eq!(
            areas(|x, y| {
                let [r, g, b] = red(x, y);
                [if r < 75.0 { 300.0 } else { r }, g + 60.0, b + 20.0]
            }),
            []
        );
        assert_eq!(areas(|_, _| [300.0; 3]), [], "nothing is around");
        assert_eq!(areas(|_, _| BODY), []);
    }
}
