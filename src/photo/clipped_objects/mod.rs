//! Rule `clipped_objects`: a clipped area with an abrupt edge is a thing that clips, and no highlight (no counterpart in the paper).
//!
//! The sky between leaves, a lamp, white paint and white letters clip like highlights do. At their edges a pixel mixes two things: the body reflection
//! behind is replaced, where surface reflection would be added to it. Neither regions nor the local split can tell such a mixture from a highlight by its color.
//! The shape tells them apart. The surface reflection around the clipped core of a highlight falls off gradually, the more so the larger the
//! core: around a core of radius R pixels of a Gaussian lobe whose peak is P times as bright as the clip threshold, exp(−2 ln P / R) of the
//! surface reflection is left one pixel farther out. An edge is as narrow as the blur of lens and file, however large the area is.
//!
//! The clipped areas of the working picture are judged by their smallest band, in which surface reflection differs most from colored body reflection: by
//! its means over the area's outermost pixels and over the rings of 1 px around the area. What is left one pixel farther out is the mean of two shares: that of the
//! rise of one ring above the darkest ring that the next ring has, and that of the fall from one ring to the next that follows from the next to the one after it.
//! It is measured from the outermost pixels to the first ring and from the first ring to the second, and the smaller share counts: where pixels were averaged, a
//! pixel on the edge is clipped, and the edge lies within the area. R is twice the number of the area's pixels divided by that of the first ring, which for a disk is
//! its radius.
//!
//! Where body reflection clips one band alone, the edge of the area is not that of the core, and may be as abrupt as a border of body colors. The limit of white
//! areas, whose smallest band nearly clips on average, is higher therefore, and that of saturated areas, in most pixels of which all bands clip, is higher still.
//!
//! The highlight of a facet ends at the edges of the facet, and a highlight may be hidden in part by another object. Such areas are few and small, so that areas
//! with abrupt edges are objects only where they are a good part of what clips, and of the picture, or where several of them are saturated: letters, windows.
//! In a picture with objects, an area of any size whose edge is as narrow as theirs is one too.
//! The pixels of an object and of its edge are not analyzed: they keep the colors of the photograph.

use super::{LinearImage, Masks};
use crate::raster::{ComponentSearch, Connectivity, Mask, Raster, pixels_where};

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
const MOST_LEFT_OF_WHITE: f64 = 0.55;
/// Least share of the pixels of a saturated area in which all bands clip.
const LEAST_SATURATED: f64 = 0.8;
/// Least number of pixels of a saturated area that tells of objects whatever its radius is.
const LEAST_PIXELS_OF_SATURATED: usize = 25;
/// Number of saturated areas with abrupt edges that are objects, however few pixels they have: letters, windows. A facet is one area.
const LEAST_SATURATED_AREAS: usize = 3;
/// Most that the edge of a saturated area leaves, as a share of what the brightest highlight leaves.
const MOST_LEFT_OF_SATURATED: f64 = 0.7;
/// The same of a saturated area of any radius, as a share of the surface reflection.
const MOST_LEFT_OF_SMALL_SATURATED: f64 = 0.1;
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
    let (mut judged, mut saturated) = (Vec::new(), 0);
    for (profile, place) in found.profiles.iter().zip(&mut judged_of) {
        let Some((left, most_left)) = profile.left(clip_threshold) else { continue };
        *place = Some(judged.len());
        let verdict = ClippedAreaVerdict::MayBeHighlight;
        let clipped = profile.area.pixels;
        let area = ClippedArea { pixels: Vec::new(), clipped, left, most_left, verdict };
        saturated += usize::from(area.is_abrupt() && profile.is_saturated());
        judged.push(area);
    }
    judge(&mut judged, saturated, (0..found.owners.len()).filter(|&pixel| masks.has_value(pixel)).count());
    for pixel in 0..found.owners.len() {
        let owner = (found.owners[pixel] as usize).checked_sub(1);
        let place = owner.and_then(|area| judged_of[area]);
        if let Some(place) = place.filter(|_| masks.clipped(pixel) || found.is_edge[pixel]) {
            judged[place].pixels.push(pixel);
        }
    }
    judged
}

/// Sets the verdicts on the areas of a picture of `pixels` pixels. `saturated`: how many saturated areas have abrupt edges.
fn judge(areas: &mut [ClippedArea], saturated: usize, pixels: usize) {
    let clipped = |area: &ClippedArea| area.clipped as f64;
    let abrupt: f64 = areas.iter().filter(|area| area.is_abrupt()).map(clipped).sum();
    let all: f64 = areas.iter().map(clipped).sum();
    let are_many = abrupt >= LEAST_OF_CLIPPED * all && abrupt >= LEAST_OF_PICTURE * pixels as f64;
    let are_objects = abrupt > 0.0 && (are_many || saturated >= LEAST_SATURATED_AREAS);
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
    /// The area's pixels next to unclipped ones.
    outermost: Sum,
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
        let left = |inner: Sum, ring: Sum, outer: Sum| {
            let (inner, ring, outer) = (inner.mean(), ring.mean(), outer.mean());
            0.5 * ((ring - foot) / fall(inner, foot) + (ring - outer) / fall(inner, ring))
        };
        let left = left(self.outermost, first, second).min(left(first, second, third));
        Some((left, self.most_left(radius_px, clip_threshold)))
    }

    /// Whether all bands clip in most pixels of the area, and the area is large enough to tell of objects.
    fn is_saturated(&self) -> bool {
        self.area.pixels >= LEAST_PIXELS_OF_SATURATED
            && self.saturated as f64 >= LEAST_SATURATED * self.area.pixels as f64
    }

    /// The share below which the edge of the area of this radius is abrupt.
    fn most_left(&self, radius_px: f64, clip_threshold: f64) -> f64 {
        let left_of_highlight = (-FALL / radius_px).exp();
        let tells = radius_px >= LEAST_TELLING_RADIUS_PX;
        let of_any_color = if tells { MOST_LEFT_OF_AN_EDGE.min(left_of_highlight) } else { 0.0 };
        let of_white = if self.is_saturated() {
            MOST_LEFT_OF_SMALL_SATURATED.max(MOST_LEFT_OF_SATURATED * left_of_highlight)
        } else if tells && self.area.mean() >= LEAST_OF_WHITE * clip_threshold {
            MOST_LEFT_OF_WHITE * left_of_highlight
        } else {
            0.0
        };
        of_any_color.max(of_white)
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
        let all_clipped = pixels_where(width * height, clipped);
        if all_clipped.is_empty() {
            return None;
        }
        let mut search = ComponentSearch::new(width, height, Connectivity::Eight);
        let mut owners = Raster::filled(width, height, 0u32);
        let mut profiles = Vec::new();
        for &start in &all_clipped {
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
                let profile = &mut self.profiles[owner as usize - 1];
                let is_unclipped = |near: usize| !masks.clipped(near) && masks.has_value(near);
                if number == 0 && self.owners.around(pixel).any(is_unclipped) {
                    profile.outermost.add(image.pixels[pixel]);
                }
                for near in self.owners.around(pixel) {
                    if self.owners[near] == 0 && is_unclipped(near) {
                        self.owners[near] = owner;
                        self.is_edge[near] = number < EDGE_RINGS;
                        profile.rings[number].add(image.pixels[near]);
                        next.push(near);
                    }
                }
            }
            ring = next;
        }
    }
}

#[cfg(test)]
mod tests;
