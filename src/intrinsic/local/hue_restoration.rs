//! Rule `hue_restoration`: the only clipped band of a pixel, from the other two bands and the hue around.
//!
//! The red of an orange or of skin reaches the largest value of a file long before green and blue do, with and without a
//! highlight. Surface reflection leaves the chromatic part of J as it is, so that the hue h of a material, the unit
//! vector of the chromatic part, is the same in and beside highlights: J = a + c·h. Two bands of J give a and c, and these
//! the third band. A pixel whose only clipped band is restored is judged by the local split like any other.
//!
//! h is the chromatic part of J of the unclipped pixels around a blob of clipped pixels, continued into the blob harmonically.
//! It must be certain: the length of the mean chromatic part around a blob is at least a quarter of the mean of J there, and so
//! is that of h before it is made a unit vector. White paper and metal, and a blob between materials of opposite hues, have no hue that could
//! be continued. The two known bands of h must differ (a pure red does not tell mean from chromatic part), c must be
//! positive, and the restored band not much darker than a clipped band is: a band that comes out darker by noise keeps its clipped value.
//! The interval of the light is at most 15°: under a lamp that was hardly known a carpet whose red clips lost its pattern.

use super::desaturation_map::DesaturationMap;
use super::lamps::{Lamp, Lamps};
use super::surroundings::{Surroundings, harmonic};
use crate::color::length;
use crate::photo::Masks;
use crate::raster::{ComponentSearch, Connectivity, PixelIndex, Raster, Roi, pixels_where};
use crate::segment::{AnalysisInput, LightFindings};
use crate::trace::{LocalLimits, RestoredBand};
use rayon::prelude::*;

/// Largest interval of the light, degrees: surface reflection leaves the hue under the right light only.
const MOST_INTERVAL_DEG: f64 = 15.0;
/// Most pixels of a blob whose pixels are restored.
const MOST_PIXELS: usize = 40_000;
/// Least length of the chromatic part of J that is continued into a blob, as a share of the mean of J around the blob.
const LEAST_CHROMA: f32 = 0.25;
/// Least value of the largest band of a pixel around a blob that tells whether the blob has a hue, as a share of the clip threshold.
const LEAST_AROUND: f32 = 0.5;
/// Least difference of the two known bands of the unit vector h: the noise of a and c is the noise of a band divided by it.
const LEAST_DIFFERENCE: f32 = 0.2;
/// Least restored value, as a share of the clipped value.
const LEAST_VALUE: f32 = 0.7;

/// The colors and the masks of a picture in which bands were restored by hue.
pub struct HueRestored {
    pixels: Raster<[f32; 3]>,
    masks: Masks,
    /// The restored bands, by pixel.
    pub bands: Vec<RestoredBand>,
}

impl HueRestored {
    /// Restores the bands of the lit pixels with one clipped band; `None` where there is no such band, the rule is off, or the light is not
    /// known well enough. `origin`: the ambient light that was subtracted, counts.
    pub fn new(
        input: &AnalysisInput,
        origin: &[f64; 3],
        light: &LightFindings,
        lamps: Option<&Lamps>,
    ) -> Option<Self> {
        let is_known = light.interval_deg.is_none_or(|interval_deg| interval_deg <= MOST_INTERVAL_DEG);
        let is_wanted = is_known && input.refine.hue_restoration && input.refine.local_split;
        let lamps = lamps.filter(|_| is_wanted)?;
        let mut bands = restored_bands(input, &input.clip_thresholds(origin), lamps);
        if bands.is_empty() {
            return None;
        }
        bands.sort_unstable_by_key(|restored| restored.pixel);
        let mut pixels = input.pixels.clone();
        for restored in &bands {
            pixels[restored.pixel.index()][usize::from(restored.band)] = restored.value;
        }
        let masks = input.masks.with_restored(bands.iter().map(|restored| restored.pixel.index()));
        Some(Self { pixels, masks, bands })
    }

    /// The picture `input` with the restored bands.
    pub fn input<'a>(&'a self, input: &AnalysisInput<'a>) -> AnalysisInput<'a> {
        input.with_picture(&self.pixels, &self.masks)
    }
}

/// The hues of the working pixels of a window, by which clipped bands of the photograph's pixels are restored.
pub struct Hues {
    /// The window.
    roi: Roi,
    /// The hue of each pixel, a unit vector; zeros where the color tells no hue.
    of: Raster<[f32; 3]>,
}

impl Hues {
    /// The hues of the usable pixels of `map` whose chromatic part exceeds the limit.
    pub fn new(map: &DesaturationMap, limits: &LocalLimits) -> Self {
        let of = map.raster(|index| {
            let color = map.colors[index];
            let is_certain = map.usable[index] > 0.0 && color.chroma > limits.chroma;
            if is_certain { color.hue() } else { [0.0; 3] }
        });
        Self { roi: map.roi, of }
    }

    /// The hue at a pixel of the picture, a unit vector; none where the color tells no hue.
    pub fn at(&self, pixel: usize) -> Option<[f32; 3]> {
        let hue = *self.of.as_slice().get(self.roi.index(pixel)?)?;
        hue.iter().any(|band| *band != 0.0).then_some(hue)
    }
}

fn restored_bands(input: &AnalysisInput, thresholds: &[f32; 3], lamps: &Lamps) -> Vec<RestoredBand> {
    let blobs = blobs_to_restore(input, thresholds);
    let restored = |surroundings: &mut Surroundings, blob: &Vec<usize>| {
        if input.stopped() {
            Vec::new()
        } else {
            restored_in_blob(input, thresholds, lamps, surroundings, blob)
        }
    };
    blobs.par_iter().map_init(|| Surroundings::new(input.masks), restored).flatten_iter().collect()
}

/// The blobs of clipped pixels of at most [`MOST_PIXELS`] of which one has a single clipped band.
fn blobs_to_restore(input: &AnalysisInput, thresholds: &[f32; 3]) -> Vec<Vec<usize>> {
    let clipped = |pixel: usize| input.masks.clipped(pixel) && !input.masks.dark(pixel);
    let has_single = |&pixel: &usize| only_clipped_band(input.pixels[pixel], thresholds).is_some();
    let mut search = ComponentSearch::new(input.pixels.width(), input.pixels.height(), Connectivity::Eight);
    let mut blobs = Vec::new();
    for start in pixels_where(input.pixels.len(), clipped) {
        let blob = search.component_at(start, clipped);
        blobs.extend(
            blob.filter(|blob| blob.len() <= MOST_PIXELS && blob.iter().any(has_single)).map(<[_]>::to_vec),
        );
    }
    blobs
}

/// The restored bands of a blob; none where the pixels around have no hue that could be continued.
fn restored_in_blob(
    input: &AnalysisInput,
    thresholds: &[f32; 3],
    lamps: &Lamps,
    surroundings: &mut Surroundings,
    blob: &[usize],
) -> Vec<RestoredBand> {
    let rings = surroundings.rings(blob, |_, _| false);
    let chromatic = |pixel: usize| lamps.of(pixel).gain.chromatic_part(input.pixels[pixel]);
    // Darker pixels around are another material or in shadow.
    let bright = rings.iter().flatten().copied().filter(|&pixel| {
        let color = input.pixels[pixel];
        (0..3).any(|band| color[band] >= LEAST_AROUND * thresholds[band])
    });
    let (mut sum, mut mean, mut count) = ([0.0f32; 3], 0.0f32, 0.0f32);
    for pixel in bright {
        let part = chromatic(pixel);
        sum = std::array::from_fn(|band| sum[band] + part[band]);
        mean += lamps.of(pixel).gain.mean(input.pixels[pixel]);
        count += 1.0;
    }
    let least_chroma = LEAST_CHROMA * mean / count;
    // The comparison is false where no pixel around is bright.
    let has_hue = length(sum) / count > least_chroma;
    if !has_hue {
        return Vec::new();
    }
    let chromatic = harmonic(input.masks.shape(), blob, &rings, chromatic);
    let restored = blob.iter().zip(chromatic).filter_map(|(&pixel, chromatic)| {
        let color = input.pixels[pixel];
        let band = only_clipped_band(color, thresholds).filter(|_| length(chromatic) > least_chroma)?;
        let value = by_hue(color, band, chromatic, lamps.of(pixel))?;
        Some(RestoredBand { pixel: PixelIndex::from_index(pixel), band: band as u8, value })
    });
    restored.collect()
}

/// The only band of a color that is clipped; none where no band is, or several are.
pub fn only_clipped_band(color: [f32; 3], thresholds: &[f32; 3]) -> Option<usize> {
    let mut clipped = (0..3).filter(|&band| color[band] >= thresholds[band]);
    clipped.next().filter(|_| clipped.next().is_none())
}

/// The value of the clipped `band` of a color, counts, by the other two bands and a vector along the hue, `chromatic`; none where
/// these do not tell the value, or contradict that the band is clipped.
pub fn by_hue(color: [f32; 3], band: usize, chromatic: [f32; 3], lamp: &Lamp) -> Option<f32> {
    let hue = chromatic.map(|part| part / length(chromatic).max(f32::MIN_POSITIVE));
    let (one, other) = ((band + 1) % 3, (band + 2) % 3);
    let difference = hue[one] - hue[other];
    if difference.abs() < LEAST_DIFFERENCE {
        return None;
    }
    let j = |band: usize| color[band] / lamp.per_amount[band];
    let c = (j(one) - j(other)) / difference;
    let a = j(one) - c * hue[one];
    let value = (a + c * hue[band]) * lamp.per_amount[band];
    (c > 0.0 && value >= LEAST_VALUE * color[band]).then(|| value.max(color[band]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Vec3, rgb};
    use crate::params::{Params, UsedParams};
    use crate::photo::{LinearImage, MaskLimits};
    use proptest::prelude::*;

    const CLIP: f32 = 240.0;

    fn light() -> Vec3 {
        Vec3::new(0.6, 0.58, 0.55).normalize()
    }

    proptest! {
        #[test]
        fn the_third_band_of_a_body_color_under_a_highlight_follows_from_the_hue(
            body in prop::array::uniform3(0.05f64..1.0), surface in 0.0f64..2.0, band in 0usize..3,
        ) {
            let (lamp, body) = (Lamp::new(&light()).unwrap(), Vec3::from(body));
            let hue = lamp.gain.chromatic_part(rgb(&body));
            let known = [hue[(band + 1) % 3], hue[(band + 2) % 3]];
            prop_assume!((known[0] - known[1]).abs() > 0.4 * length(hue) && length(hue) > 0.05);
            let color = rgb(&((body + light() * surface) * 100.0));
            let mut clipped = color;
            clipped[band] *= 0.8;
            let value = by_hue(clipped, band, hue, &lamp).unwrap();
            prop_assert!((value - color[band]).abs() < 0.05 + 1e-3 * color[band], "{value} {color:?}");
        }
    }

    #[test]
    fn a_hue_that_does_not_tell_or_contradicts_restores_nothing() {
        let lamp = Lamp::new(&Vec3::repeat(1.0).normalize()).unwrap();
        assert_eq!(by_hue([250.0, 90.0, 90.0], 0, [0.8, -0.4, -0.4], &lamp), None, "a pure red");
        assert_eq!(by_hue([250.0, 40.0, 120.0], 0, [0.7, 0.0, -0.7], &lamp), None, "another hue");
        assert_eq!(by_hue([250.0, 90.0, 85.0], 0, [0.7, 0.0, -0.7], &lamp), None, "the band would be dark");
        assert_eq!(by_hue([250.0, 90.0, 85.0], 0, [0.0; 3], &lamp), None, "no hue");
        assert_eq!(only_clipped_band([250.0, 90.0, 30.0], &[CLIP; 3]), Some(0));
        assert_eq!(only_clipped_band([250.0, 241.0, 30.0], &[CLIP; 3]), None);
        assert_eq!(only_clipped_band([20.0, 90.0, 30.0], &[CLIP; 3]), None);
    }

    /// The bands restored in a picture of 40 × 40 pixels with a bright spot in the middle.
    fn restored(body: Vec3) -> (Vec<RestoredBand>, Vec<Vec3>) {
        let spot = |i: usize| {
            let (x, y) = ((i % 40) as f64 - 20.0, (i / 40) as f64 - 20.0);
            body * (200.0 + 120.0 * (-(x * x + y * y) / 60.0).exp())
        };
        let truth: Vec<Vec3> = (0..1600).map(spot).collect();
        let data = truth.iter().map(|color| rgb(color).map(|band| band.min(255.0))).collect();
        let image = LinearImage::new(Raster::from_vec(40, 40, data).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 20.0, clip_threshold: f64::from(CLIP), bloom_density: 1 };
        let masks = Masks::new(&image, &limits);
        let used = UsedParams { clip_threshold: f64::from(CLIP), ..UsedParams::paper() };
        let input = AnalysisInput::new(&image, &masks, &used, Params::default().refinements());
        let lamps = Lamps::one(&light()).unwrap();
        let found = HueRestored::new(&input, &[0.0; 3], &LightFindings::default(), Some(&lamps));
        let kept = found.as_ref().map(|found| {
            let view = found.input(&input);
            found.bands.iter().all(|band| !view.masks.clipped(band.pixel.index()))
        });
        assert_ne!(kept, Some(false), "a restored pixel counts as unclipped");
        (found.map_or(Vec::new(), |found| found.bands), truth)
    }

    #[test]
    fn the_clipped_red_of_an_orange_is_restored_and_that_of_white_paper_is_not() {
        let (bands, truth) = restored(Vec3::new(1.0, 0.45, 0.12));
        assert!(bands.len() > 100, "{}", bands.len());
        for found in &bands {
            let expected = truth[found.pixel.index()].x as f32;
            assert!(
                found.band == 0 && (found.value - expected.max(240.0)).abs() < 1.0,
                "{found:?} {expected}"
            );
        }
        assert!(restored(Vec3::new(1.0, 0.9, 0.85)).0.is_empty());
    }
}
