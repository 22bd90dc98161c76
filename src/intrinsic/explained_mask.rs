//! The pixels that the skewed T of their region explains, and that therefore keep the split by the region's plane (refinement
//! `region_holds`).
//!
//! Not explained are the pixels of a region whose skewed T does not fit (see [`crate::segment::RegionFit`]); a separate part of a
//! region with hardly any matte pixel (clipped highlights of a white cup fit the plane of a teal jug, 21.8 → 34.4 dB on the jug's
//! region, but no object consists of highlight alone); a clipped blob that is mostly surrounded by other regions, which the
//! region reached over a bridge of bright pixels; a blob that mostly clips in every band where the body reflection around it is nearly white,
//! as on the back of a white dog in the sun, which became gray; a clipped highlight with hardly any matte pixels of its region around,
//! which the region reached by brightness alone (section 5.5): behind a red mast a white sky became black and red; and a highlight under which the
//! body reflection is much weaker than beside it: a highlight lies on the body around it, and where white replaces the body, as the sky does behind
//! a wall, the plane leaves black. The pixels of such a highlight keep their color.

use super::images::Images;
use crate::color::Moments;
use crate::raster::{Border, ComponentSearch, Connectivity, LabelMap, Mask, Raster, RegionId, pixels_where};
use crate::segment::{AnalysisInput, FinalRegions, Members, parts};
use crate::trace::PixelKind;

/// Least share of matte pixels in a part of a region that is explained.
const LEAST_MATTE: f64 = 0.1;
/// Least share of a clipped blob's own region in the assigned pixels around the blob.
const LEAST_OWN: f64 = 0.5;
/// Least band of a body reflection that is nearly white, as a share of the clip threshold.
const LEAST_WHITE: f32 = 0.6;
/// Least share of clipped and bloomed pixels in a highlight that is tested for matte pixels around.
const LEAST_DISTORTED: f64 = 0.2;
/// Least share of matte pixels of its own region in the lit pixels around a highlight.
const LEAST_OWN_MATTE: f64 = 0.4;
/// Surface reflection from which on a pixel belongs to the core of a highlight, as a share of the largest of the highlight.
const CORE: f32 = 0.7;
/// Fewest pixels of a highlight whose body reflection is compared with that beside it.
const LEAST_JUDGED: usize = 20;
/// The same in a demosaiced picture, where the core of a small highlight is mixed with what is around.
const LEAST_JUDGED_INTERPOLATED: usize = 100;
/// Least mean body reflection of the core of a highlight, as a share of that of the matte pixels next to the highlight. Of 619 such
/// highlights of 148 rendered pictures (overexposed, the same at JPEG 92, demosaiced) none has less than .75.
const LEAST_CORE_BODY: f64 = 0.5;

/// What the planes of the regions explain.
pub struct Explained {
    /// The pixels that the skewed T of their region explains.
    pub mask: Mask,
    /// The pixels in which another color replaces the body reflection of their region. They keep their color, and have no surface reflection; none
    /// where there is no such pixel.
    pub replaced: Option<Mask>,
}

/// The pixels that the skewed T of their region explains. `model_fits`: whether the skewed T
/// fits each region, by [`RegionId::index`]. `images`: the split by the planes. Parts and blobs are not looked at where a person marked the area: a person has said that
/// all of it is one object.
pub fn explained_mask(
    input: &AnalysisInput,
    regions: &FinalRegions,
    members: &Members,
    model_fits: &[bool],
    images: &Images,
) -> Explained {
    let kinds = &images.kinds;
    let mut mask =
        regions.labels.par_map(|&label| RegionId::from_label(label).is_some_and(|id| model_fits[id.index()]));
    if !input.refine.region_holds || input.is_marked() {
        return Explained { mask, replaced: None };
    }
    let width = regions.labels.width();
    for id in RegionId::all(model_fits.len()).filter(|id| model_fits[id.index()]) {
        for part in parts(width, members.region(id)) {
            let matte = part.iter().filter(|&&pixel| kinds[pixel as usize] == PixelKind::Matte).count();
            if (matte as f64) < LEAST_MATTE * part.len() as f64 {
                for &pixel in &part {
                    mask[pixel as usize] = false;
                }
            }
        }
    }
    let labels = &regions.labels;
    remove_components(
        labels,
        &mut mask,
        |pixel| input.masks.distorted(pixel),
        |_, blob| {
            is_of_another_object(input, labels, blob) || is_overexposed_body(input, labels, images, blob)
        },
    );
    let is_bright = |pixel: usize| is_bright(input, kinds, pixel);
    let mut replaced = None;
    remove_components(labels, &mut mask, is_bright, |explained, highlight| {
        if lacks_body(input, labels, kinds, explained, highlight) {
            return true;
        }
        let is_weak = has_weak_body(input, labels, images, explained, highlight);
        if is_weak {
            let replaced = replaced.get_or_insert_with(|| labels.map(|_| false));
            for &pixel in highlight {
                replaced[pixel] = true;
            }
        }
        is_weak
    });
    Explained { mask, replaced }
}

/// Whether a pixel is a highlight pixel, clipped or bloomed.
fn is_bright(input: &AnalysisInput, kinds: &Raster<PixelKind>, pixel: usize) -> bool {
    input.masks.distorted(pixel) || kinds[pixel] == PixelKind::Highlight
}

/// Removes from `mask` the components of its pixels of one region for which `is_wrong`, given the mask and the component, is true. A component
/// consists of pixels for which `belongs` is true.
fn remove_components(
    labels: &LabelMap,
    mask: &mut Mask,
    belongs: impl Fn(usize) -> bool + Sync,
    mut is_wrong: impl FnMut(&Mask, &[usize]) -> bool,
) {
    let mut search = ComponentSearch::new(labels.width(), labels.height(), Connectivity::Four);
    for start in pixels_where(labels.len(), |pixel| mask[pixel] && belongs(pixel)) {
        let member = |pixel: usize| mask[pixel] && labels[pixel] == labels[start] && belongs(pixel);
        let found = search.component_at(start, member).filter(|component| is_wrong(mask, component));
        for &pixel in found.into_iter().flatten() {
            mask[pixel] = false;
        }
    }
}

/// Whether a clipped blob is mostly surrounded by other regions than its own.
fn is_of_another_object(input: &AnalysisInput, labels: &LabelMap, blob: &[usize]) -> bool {
    let border = Border::of(labels, blob, |pixel| !input.masks.distorted(pixel));
    let own = blob.first().map_or(0, |&pixel| border.sides(labels[pixel]));
    (own as f64) < LEAST_OWN * border.assigned_sides() as f64
}

/// Whether a blob mostly clips in every band, and the body reflection of its region around it is nearly white: there the body itself may be
/// overexposed, and nothing tells of a highlight.
fn is_overexposed_body(input: &AnalysisInput, labels: &LabelMap, images: &Images, blob: &[usize]) -> bool {
    let lost = blob.iter().filter(|&&pixel| images.kinds[pixel] == PixelKind::Lost).count();
    if 2 * lost < blob.len() {
        return false;
    }
    let least_band = LEAST_WHITE * input.used.clip_threshold as f32;
    let is_white = |pixel: usize| images.body[pixel].iter().all(|band| *band >= least_band);
    let (mut own, mut white) = (0usize, 0usize);
    for &pixel in blob {
        labels.for_each_neighbor(pixel, |near| {
            let is_own = labels[near] == labels[pixel] && !input.masks.distorted(near);
            own += usize::from(is_own);
            white += usize::from(is_own && is_white(near));
        });
    }
    own > 0 && 2 * white >= own
}

/// Whether enough of the pixels of a highlight are clipped or bloomed that what is around is looked at.
fn is_clipped_highlight(input: &AnalysisInput, highlight: &[usize]) -> bool {
    let distorted = highlight.iter().filter(|&&pixel| input.masks.distorted(pixel)).count();
    distorted as f64 >= LEAST_DISTORTED * highlight.len() as f64
}

/// Whether a clipped highlight mostly borders on other things than matte pixels of its own region that are `explained`: a white sky, whose color is
/// that of the light, is no highlight of the red mast in front of it.
fn lacks_body(
    input: &AnalysisInput,
    labels: &LabelMap,
    kinds: &Raster<PixelKind>,
    explained: &Mask,
    highlight: &[usize],
) -> bool {
    if !is_clipped_highlight(input, highlight) {
        return false;
    }
    let (mut own, mut others) = (0usize, 0usize);
    for &pixel in highlight {
        labels.for_each_neighbor(pixel, |near| {
            let is_own = explained[near] && labels[near] == labels[pixel];
            let is_of_highlight = is_own && is_bright(input, kinds, near);
            if is_of_highlight || input.masks.dark(near) {
                return;
            }
            own += usize::from(is_own);
            others += usize::from(!is_own);
        });
    }
    (own as f64) < LEAST_OWN_MATTE * (own + others) as f64
}

/// Whether the body reflection in the core of a clipped highlight is much weaker than that of the matte pixels of its region that are `explained` and next to
/// the highlight. The highlight of a plane that explains what it claims lies on the body around it.
fn has_weak_body(
    input: &AnalysisInput,
    labels: &LabelMap,
    images: &Images,
    explained: &Mask,
    highlight: &[usize],
) -> bool {
    let least = if input.is_only_interpolated() { LEAST_JUDGED_INTERPOLATED } else { LEAST_JUDGED };
    if highlight.len() < least || !is_clipped_highlight(input, highlight) {
        return false;
    }
    let surface = |pixel: usize| images.surface[pixel].iter().sum::<f32>();
    let least_surface = CORE * highlight.iter().map(|&pixel| surface(pixel)).fold(0.0, f32::max);
    let (mut core, mut beside) = (Moments::default(), Moments::default());
    for &pixel in highlight {
        if surface(pixel) >= least_surface {
            core.add(images.body[pixel]);
        }
        labels.for_each_neighbor(pixel, |near| {
            let is_own = explained[near] && labels[near] == labels[pixel];
            if is_own && !is_bright(input, &images.kinds, near) && !input.masks.dark(near) {
                beside.add(images.body[near]);
            }
        });
    }
    let beside = beside.mean().sum();
    beside > 0.0 && core.mean().sum() < LEAST_CORE_BODY * beside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::segment::testing::Drawing;

    /// The explained pixels of a region of matte pixels (m), highlights (h) and clipped pixels (w) in front of something else (o) and of the
    /// dark (.); a point is a pixel that is not explained.
    fn explained(rows: &[&str]) -> Vec<String> {
        let body = Vec3::new(0.9, 0.3, 0.2).normalize();
        let drawing = Drawing::new(rows, |c| match c {
            'm' => body * 120.0,
            'h' => body * 120.0 + Vec3::repeat(60.0),
            'w' => Vec3::repeat(255.0),
            'o' => Vec3::new(40.0, 60.0, 150.0),
            _ => Vec3::zeros(),
        });
        let letters: Vec<u8> = rows.concat().into_bytes();
        let raster = |of: &dyn Fn(u8) -> bool| {
            let values = letters.iter().map(|&letter| of(letter)).collect();
            Mask::from_vec(rows[0].len(), rows.len(), values).unwrap()
        };
        let mut mask = raster(&|letter| b"mhw".contains(&letter));
        let labels = mask.map(|&is_member| u16::from(is_member));
        let is_highlight = raster(&|letter| letter == b'h');
        let kinds = is_highlight.map(|&is| if is { PixelKind::Highlight } else { PixelKind::Matte });
        let input = drawing.input();
        let is_bright = |pixel: usize| input.masks.distorted(pixel) || is_highlight[pixel];
        remove_components(&labels, &mut mask, is_bright, |explained, highlight| {
            lacks_body(&input, &labels, &kinds, explained, highlight)
        });
        let letter = |&is_explained: &bool| if is_explained { 'x' } else { '.' };
        mask.as_slice().chunks(rows[0].len()).map(|row| row.iter().map(letter).collect()).collect()
    }

    #[test]
    fn an_overexposed_white_body_is_no_highlight_and_the_core_of_a_highlight_is() {
        let kept = |body: [f32; 3]| {
            let rows = ["aaaaa", "aawaa", "aaaaa"];
            let drawing = Drawing::new(&rows, |c| Vec3::repeat(if c == 'w' { 255.0 } else { 200.0 }));
            let mut images = Images {
                body: Raster::filled(5, 3, body),
                surface: Raster::filled(5, 3, [0.0; 3]),
                noise: Raster::filled(5, 3, 0.0),
                kinds: Raster::filled(5, 3, PixelKind::Highlight),
            };
            images.kinds[7] = PixelKind::Lost;
            !is_overexposed_body(&drawing.input(), &LabelMap::filled(5, 3, 1), &images, &[7])
        };
        assert!(!kept([190.0, 180.0, 170.0]), "a white body");
        assert!(kept([80.0, 70.0, 60.0]), "a highlight on a gray body");
        assert!(kept([190.0, 60.0, 50.0]), "a highlight on a red body");
    }

    #[test]
    fn a_highlight_lies_on_the_body_around_it() {
        let edge = ["mmmmmmmmmmmmmmmm", "mhhhhhhhhhhhhhhm"];
        let mut rows = vec!["mhhwwwwwwwwwwhhm"; 10];
        rows.splice(0..2, edge);
        rows.splice(8..10, [edge[1], edge[0], "................"]);
        let letters = rows.concat().into_bytes();
        let drawing = Drawing::new(&rows, |c| Vec3::repeat(if c == 'w' { 255.0 } else { 100.0 }));
        let highlight: Vec<usize> =
            (0..letters.len()).filter(|&pixel| b"hw".contains(&letters[pixel])).collect();
        // Whether the highlight is weak where its core has the share `core` of the body reflection of the matte pixels, `beside` counts in each band.
        let is_weak = |core: f32, beside: f32| {
            let raster = |of: &dyn Fn(u8) -> f32| {
                Raster::from_vec(16, 11, letters.iter().map(|&letter| [of(letter); 3]).collect()).unwrap()
            };
            let images = Images {
                body: raster(&|letter| if letter == b'w' { core * beside } else { beside }),
                surface: raster(&|letter| {
                    f32::from(letter == b'w') * 150.0 + f32::from(letter == b'h') * 50.0
                }),
                noise: Raster::filled(16, 11, 0.0),
                kinds: Raster::from_vec(16, 11, letters.iter().map(|&letter| kind(letter)).collect())
                    .unwrap(),
            };
            let labels = images.kinds.map(|&kind| u16::from(kind != PixelKind::Unassigned));
            let explained = labels.map(|&label| label > 0);
            has_weak_body(&drawing.input(), &labels, &images, &explained, &highlight)
        };
        assert!(!is_weak(1.1, 80.0) && !is_weak(0.6, 80.0), "the body of the core is that around it");
        assert!(is_weak(0.4, 80.0) && is_weak(0.0, 20.0), "white replaces the body");
        assert!(!is_weak(1.0, 0.0), "a black body");
    }

    fn kind(letter: u8) -> PixelKind {
        match letter {
            b'm' => PixelKind::Matte,
            b'.' => PixelKind::Unassigned,
            _ => PixelKind::Highlight,
        }
    }

    #[test]
    fn a_white_sky_is_no_highlight_of_the_mast_in_front_of_it() {
        let rows = ["wwwwwwwwwww", "wwwwwmwwwww", "hhhhhmhhhhh", "ooooomooooo", "ooooomooooo"];
        let mast = ".....x.....";
        assert_eq!(explained(&rows), ["...........", mast, mast, mast, mast]);
    }

    #[test]
    fn a_highlight_stays_within_its_object_and_at_the_edge_of_its_object_before_the_dark() {
        assert_eq!(explained(&["mmmmm", "mhwhm", "mmmmm"]), ["xxxxx", "xxxxx", "xxxxx"]);
        assert_eq!(explained(&[".....", "mhwhm", "mmmmm"]), [".....", "xxxxx", "xxxxx"]);
    }

    #[test]
    fn a_highlight_of_which_hardly_any_pixel_clips_is_left_to_the_other_tests() {
        assert_eq!(
            explained(&["hhhhhhh", "hhhwhhh", "hhhhhhh", "ooooooo"]).concat().matches('x').count(),
            21
        );
    }
}
