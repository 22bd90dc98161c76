//! The local split: surface reflection of pixels that no region explains, from their surroundings (beyond the paper).
//!
//! In real photographs, printed cups, fruit and skin break "one object, one skewed T", and a plane fitted to such a
//! region makes the body image worse than the input. The dichromatic model still applies to each pixel: surface
//! reflection adds the light's color, and so lowers a pixel's saturation below the saturation of the same hue around
//! the pixel. J = I / (√3 s) is the color under a white light, with the unit vector s of the light; a is the mean of J,
//! c the length of its chromatic part, κ the ratio a/c of body reflection, and m_s = max(a − κc, 0) the excess
//! (`hue_ratios`, and `region_ratios` for pale regions). `hue_restoration` gives J a band that alone is clipped, `desaturation_map` measures the excess, `evidence` tells highlights from white print, `plausibility`
//! whether the light is known well enough, `guided` makes the amounts follow the edges of the picture, and `repair`
//! fills clipped pixels, and `fade` leaves no edge around those that are not filled.
//!
//! Body reflection is the input minus the surface reflection found; inside highlights its chromaticity is taken from around, as far as errors
//! explain the change (`chromaticity`), and body ≤ input. On a rendered scene of printed objects the body image goes from 19.6 dB (planes alone; doing nothing: 30.2 dB) to 41 dB.

mod chromaticity;
mod desaturation_map;
mod evidence;
mod fade;
mod full_resolution;
mod guided;
mod hue_ratios;
mod hue_restoration;
mod lamps;
mod limits;
mod linear_weights;
mod observations;
mod plausibility;
mod region_ratios;
mod repair;
mod surroundings;
mod trace_writer;

pub use full_resolution::{LocalWorkingSplit, split_locally_at_full_resolution};
pub use hue_restoration::HueRestored;
pub use lamps::Lamps;
pub use observations::Observations;
pub use region_ratios::Regions;

use super::confidence::LOCAL;
use super::images::Images;
use crate::raster::{Mask, Raster};
use crate::segment::{AnalysisInput, LightFindings};
use crate::trace::{LocalLimits, LocalStart, PictureOddsFound, PixelKind, Recorder};
use chromaticity::ChromaticityChanges;
use desaturation_map::DesaturationMap;
use evidence::Evidence;
use guided::AmountLines;
use hue_restoration::Hues;
use rayon::prelude::*;
use trace_writer::LocalTraceWriter;

/// Fewest unexplained pixels for which the local split begins.
const LEAST_PIXELS: usize = 64;
/// Least share of unexplained pixels among lit pixels for which the local split begins.
const LEAST_SHARE: f64 = 0.01;

/// The picture whose unexplained pixels are split locally.
pub struct LocalInput<'a> {
    /// The picture, colors in counts above the ambient light.
    pub input: &'a AnalysisInput<'a>,
    /// The bands that were restored by hue; none where there are none.
    pub restored: Option<&'a HueRestored>,
    /// The light, and the evidence of it.
    pub light: LightFindings,
    /// The lamps; none where no light is known or a band of the light is zero.
    pub lamps: Option<&'a Lamps>,
    /// The pixels that the skewed T of their region explains.
    pub explained_mask: &'a Mask,
    /// The observations in a window around all lit pixels, where they were made before.
    pub observations: Option<Observations<'a>>,
    /// The regions.
    pub regions: Regions<'a>,
}

/// What the local split found.
pub struct LocalSplit {
    /// The amounts of surface reflection, as linear functions of a, the mean of J.
    lines: AmountLines,
    /// The lamps of the working picture.
    lamps: Lamps,
    /// Confidence of the pixels that were split locally, 0 for others.
    pub confidence: Raster<f32>,
    /// The pixels of clipped blobs that were filled from around.
    filled: Mask,
    /// The hues by which clipped bands of the photograph are restored; none where no band of the working picture was restored.
    hues: Option<Hues>,
    /// The changes of the chromaticity of body reflection.
    chromaticity: ChromaticityChanges,
}

/// Undoes the split of pixels that their region does not explain, and splits these pixels locally. Returns what was
/// found; `None` where the local split did not begin or highlights are not plausible under the light. `origin`: the
/// ambient light that was subtracted, counts.
pub fn split_locally<R: Recorder>(
    local: &LocalInput,
    origin: &[f64; 3],
    images: &mut Images,
    recorder: &mut R,
) -> Option<LocalSplit> {
    let unexplained = undo_unexplained(local.input, local.explained_mask, images);
    let mut trace_writer = LocalTraceWriter::new(recorder, *origin);
    let found = split_unexplained(local, &unexplained, images, &mut trace_writer);
    trace_writer.finish(unexplained);
    found
}

/// Fewest unexplained pixels for which the local split begins, in a picture with `lit` lit pixels.
fn least_pixels(lit: usize) -> usize {
    LEAST_PIXELS.max((LEAST_SHARE * lit as f64).ceil() as usize)
}

/// Splits the lit pixels that no region explains. Returns what [`split_locally`] returns.
fn split_unexplained<R: Recorder>(
    LocalInput { input: original, restored, light: findings, lamps, observations, regions, .. }: &LocalInput,
    unexplained: &Mask,
    images: &mut Images,
    trace_writer: &mut LocalTraceWriter<R>,
) -> Option<LocalSplit> {
    let input = &restored.map_or(**original, |restored| restored.input(original));
    let pixels = unexplained.count();
    let lit = (0..unexplained.len()).filter(|&pixel| !input.masks.dark(pixel)).count();
    let few = pixels < least_pixels(lit);
    let limits = limits::limits(input);
    let wanted = input.refine.local_split && !few && !input.stopped();
    let made = lamps
        .filter(|_| wanted && observations.is_none())
        .and_then(|lamps| Observations::around(input, lamps, regions, |pixel| unexplained[pixel]));
    let observed = observations.as_ref().filter(|_| wanted).or(made.as_ref());
    let start = match observed {
        Some(_) => LocalStart::Begins,
        None if !input.refine.local_split => LocalStart::Off,
        None if few => LocalStart::Few,
        None => LocalStart::NoLight,
    };
    trace_writer.began(input, &limits, start, pixels, lit, findings);
    let Observations { map, evidence, .. } = observed?;
    let judged = evidence.as_ref().map(|evidence| (evidence, evidence.picture_odds(map, unexplained)));
    trace_writer.judged(input, map, judged, unexplained, *restored);
    if input.refine.belief {
        let tested = plausibility::test(input, findings);
        let is_plausible = tested.plausible();
        trace_writer.plausibility(tested);
        if !is_plausible {
            return None;
        }
    }
    let weights = weights(&limits, map, judged, unexplained);
    let amounts = map.raster(|index| weights[index] * map.points[index].surface);
    let (mut fills, mut kept_shares) = (Vec::new(), None);
    if input.refine.clip_repair {
        trace_writer.repairs_began();
        let found = repair::LocalAmounts { map, weights: &weights, amounts: &amounts };
        fills = repair::fills(original, input, unexplained, &found, |tried, blob| {
            trace_writer.repair(tried, blob);
        });
        kept_shares = fade::kept_shares(&repair::unfilled(input, unexplained, &map.roi, &fills));
    }
    let lines = amount_lines(input, map, &amounts, kept_shares.as_ref(), limits.sigma);
    let amounts = map.raster(|index| {
        let pixel = map.roi.pixel(index);
        let line = lines.line(index).filter(|_| unexplained[pixel] && !input.masks.clipped(pixel));
        line.map_or(0.0, |line| line.amount(map.colors[index].mean))
    });
    trace_writer.amounts(&amounts);
    let mut confidence = move_surface(original, input, map, &amounts, &weights, images);
    let chromaticity = ChromaticityChanges::around_highlights(input, map, unexplained, images);
    chromaticity.apply(original, images);
    trace_writer.chromaticity(&chromaticity);
    let filled = repair::fill(input, &fills, images, &mut confidence);
    let hues = restored.map(|_| Hues::new(map, &limits));
    Some(LocalSplit { lines, lamps: map.lamps.clone(), confidence, filled, hues, chromaticity })
}

/// The lines that give the `amounts` of the window, counts of J, of which each pixel keeps its share in `kept_shares`, 0…1, before the guided
/// filter and again after it (`fade`). `sigma`: standard deviation of the noise of a band, counts.
fn amount_lines(
    input: &AnalysisInput,
    map: &DesaturationMap,
    amounts: &Raster<f32>,
    kept_shares: Option<&Raster<f32>>,
    sigma: f32,
) -> AmountLines {
    let kept = kept_shares.map(|shares| map.raster(|index| amounts[index] * shares[index]));
    let amounts = kept.as_ref().unwrap_or(amounts);
    if !input.refine.guided_amount {
        return AmountLines::constant(map, amounts);
    }
    let lines = AmountLines::guided(map, amounts, sigma);
    match kept_shares {
        Some(shares) => lines.faded(shares),
        None => lines,
    }
}

/// The share of the excess m_s of each pixel of the window that is surface reflection, 0…1; 0 for pixels that a region
/// explains.
fn weights(
    limits: &LocalLimits,
    map: &DesaturationMap,
    evidence: Option<(&Evidence, PictureOddsFound)>,
    unexplained: &Mask,
) -> Raster<f32> {
    map.raster(|index| {
        let found = &map.points[index];
        if !unexplained[map.roi.pixel(index)] {
            return 0.0;
        }
        let ratio = found.body / map.colors[index].chroma.max(f32::MIN_POSITIVE);
        let odds = evidence.map(|(evidence, picture)| evidence.log_odds[index] + picture.log_odds);
        limits.weight(found, ratio, odds)
    })
}

/// Resets pixels that no region explains to body = input, surface = 0, noise = 0. Returns the lit pixels among them, with the
/// lit pixels that are in no region.
fn undo_unexplained(input: &AnalysisInput, explained_mask: &Mask, images: &mut Images) -> Mask {
    let (width, height) = (explained_mask.width(), explained_mask.height());
    let mut unexplained = Raster::filled(width, height, false);
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.noise.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        unexplained.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    rows.into_par_iter().enumerate().for_each(|(y, (body, surface, noise, kinds, unexplained))| {
        for x in 0..width {
            let pixel = y * width + x;
            if explained_mask[pixel] {
                continue;
            }
            unexplained[x] = !input.masks.dark(pixel);
            if kinds[x] == PixelKind::Unassigned {
                continue;
            }
            (body[x], surface[x], noise[x]) = (input.pixels[pixel], [0.0; 3], 0.0);
            // The kind of an undistorted pixel says which line of its region is nearer, also after its split is undone. Restored
            // components are gone.
            if kinds[x] == PixelKind::Restored {
                kinds[x] = PixelKind::Lost;
            }
        }
    });
    unexplained
}

/// Moves the `amounts` of surface reflection, counts of J, from the body image to the surface image. Body reflection is what remains of
/// the color with its restored bands (`input`), at most the color of the file (`original`). Returns the confidence of each pixel by its
/// weight, 0 where nothing was moved.
fn move_surface(
    original: &AnalysisInput,
    input: &AnalysisInput,
    map: &DesaturationMap,
    amounts: &Raster<f32>,
    weights: &Raster<f32>,
    images: &mut Images,
) -> Raster<f32> {
    let width = images.body.width();
    let mut confidence = Raster::filled(width, images.body.height(), 0.0);
    let roi = map.roi;
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        confidence.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    let rows = rows.into_par_iter().skip(roi.top).take(roi.height);
    rows.enumerate().for_each(|(row, (body, surface, kinds, confidence))| {
        let found = weights.row(row).iter().zip(amounts.row(row));
        for (x, (&weight, &amount)) in (roi.left..).zip(found).filter(|(_, (_, amount))| **amount > 0.0) {
            let pixel = (roi.top + row) * width + x;
            let moved = Moved::new(input.pixels[pixel], amount, &map.lamps.of(pixel).per_amount);
            (body[x], surface[x]) = (moved.body_below(original.pixels[pixel]), moved.surface);
            if weight > 0.0 && kinds[x] != PixelKind::Unassigned {
                let is_restored = original.masks.clipped(pixel);
                kinds[x] = if is_restored { PixelKind::Restored } else { PixelKind::Highlight };
            }
            confidence[x] = LOCAL * weight;
        }
    });
    confidence
}

/// A color without the surface reflection that was found in the pixel.
struct Moved {
    /// Surface reflection, counts: in a band at most the color in that band.
    surface: [f32; 3],
    /// Body reflection, counts.
    body: [f32; 3],
}

impl Moved {
    /// The split of a `color` with the `amount` of surface reflection, counts of J. `per_amount`: surface reflection in each band per count.
    #[inline]
    fn new(color: [f32; 3], amount: f32, per_amount: &[f32; 3]) -> Self {
        let surface: [f32; 3] =
            std::array::from_fn(|band| (amount * per_amount[band]).min(color[band].max(0.0)));
        Self { surface, body: std::array::from_fn(|band| color[band] - surface[band]) }
    }

    /// The body reflection, in each band at most the color `limit` of the file: what a restored band has beyond it belongs to no file.
    #[inline]
    fn body_below(&self, limit: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|band| self.body[band].min(limit[band]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Vec3, vec3};
    use crate::intrinsic::split;
    use crate::params::{Params, Refine, UsedParams};
    use crate::photo::{LinearImage, MaskLimits, Masks};
    use crate::raster::LabelMap;
    use crate::segment::{FinalRegions, LightBasis};
    use crate::trace::NoopRecorder;
    use proptest::prelude::*;

    const SIDE_PX: usize = 96;
    const SIGMA: f64 = 1.25;
    const CLIP_THRESHOLD: f32 = 240.0;

    fn light() -> Vec3 {
        Vec3::new(0.62, 0.57, 0.54).normalize()
    }

    fn used_params() -> UsedParams {
        UsedParams { camera_noise: 2.0 * SIGMA, ..UsedParams::paper() }
    }

    /// The split of a picture in which no region was found, under a known light.
    fn local(color: impl Fn(f64, f64) -> Vec3) -> (LinearImage, crate::intrinsic::Intrinsic) {
        local_by_votes(0.1, color)
    }

    /// The same where a share of the votes is for the light.
    fn local_by_votes(
        share: f64,
        color: impl Fn(f64, f64) -> Vec3,
    ) -> (LinearImage, crate::intrinsic::Intrinsic) {
        local_refined(share, Params::default().refinements(), color)
    }

    /// The same with the refinements `refine`.
    fn local_refined(
        share: f64,
        refine: Refine,
        color: impl Fn(f64, f64) -> Vec3,
    ) -> (LinearImage, crate::intrinsic::Intrinsic) {
        let place = |i: usize| ((i % SIDE_PX) as f64, (i / SIDE_PX) as f64);
        let data = (0..SIDE_PX * SIDE_PX).map(|i| {
            let color = color(place(i).0, place(i).1);
            // A fixed pattern instead of noise: smaller than the noise, and the same in every run.
            let noise = ((i * 7919 % 13) as f32 - 6.0) * 0.15;
            crate::color::rgb(&color).map(|band| (band + noise).clamp(0.0, 255.0))
        });
        let pixels = Raster::from_vec(SIDE_PX, SIDE_PX, data.collect()).unwrap();
        let image = LinearImage::new(pixels, Some(255.0));
        let limits =
            MaskLimits { min_intensity: 23.0, clip_threshold: f64::from(CLIP_THRESHOLD), bloom_density: 1 };
        let masks = Masks::new(&image, &limits);
        let used = used_params();
        let input = AnalysisInput::new(&image, &masks, &used, refine);
        let light = LightFindings {
            direction: Some(light().into()),
            basis: LightBasis::Votes,
            share,
            ..LightFindings::default()
        };
        let labels = LabelMap::filled(SIDE_PX, SIDE_PX, 0);
        let regions = FinalRegions { labels, hypotheses: Vec::new(), light, second_lamp_mask: None };
        let result =
            crate::intrinsic::Intrinsic::clone(&split(&input, &regions, &mut NoopRecorder).intrinsic);
        (image, result)
    }

    fn slope(x: f64, y: f64) -> Vec3 {
        Vec3::new(0.75, 0.4, 0.25) * (90.0 + 0.4 * x + 0.2 * y)
    }

    /// The surface reflection at (x, y) of a Gaussian highlight of width 4 px at (48, 40), counts.
    fn highlight(x: f64, y: f64, amount: f64) -> Vec3 {
        light() * (amount * (-((x - 48.0).powi(2) + (y - 40.0).powi(2)) / 32.0).exp())
    }

    #[test]
    fn a_gaussian_highlight_on_a_matte_slope_is_found() {
        let (_, result) = local(|x, y| slope(x, y) + highlight(x, y, 120.0));
        let error =
            |x: usize, y: usize| (vec3(result.body[y * SIDE_PX + x]) - slope(x as f64, y as f64)).norm();
        assert!(error(48, 40) < 8.0, "the peak of the highlight, 120 counts high: {}", error(48, 40));
        assert!(error(52, 42) < 8.0, "the flank of the highlight: {}", error(52, 42));
        let found = result.surface[40 * SIDE_PX + 48];
        assert!(crate::color::axis_angle_deg(&vec3(found), &light()) < 0.01);
        assert!(result.confidence[40 * SIDE_PX + 48] > 0.2);
        assert!(result.surface[80 * SIDE_PX + 10].iter().all(|band| *band == 0.0));
    }

    #[test]
    fn nothing_is_split_under_a_light_with_too_few_votes() {
        let (image, result) = local_by_votes(0.001, |x, y| slope(x, y) + highlight(x, y, 120.0));
        assert_eq!(result.body.as_slice(), image.pixels.as_slice());
        assert!(result.confidence.as_slice().iter().all(|&confidence| confidence == 0.0));
    }

    #[test]
    fn a_clipped_core_takes_the_body_around_it() {
        let (_, result) = local(|x, y| slope(x, y) + highlight(x, y, 420.0));
        let error = (vec3(result.body[40 * SIDE_PX + 48]) - slope(48.0, 40.0)).norm();
        assert!(error < 20.0, "{error}");
        assert_eq!(result.kinds[40 * SIDE_PX + 48], PixelKind::Unassigned);
    }

    #[test]
    fn no_surface_reflection_is_taken_beside_clipped_pixels_that_are_not_filled() {
        // A pale strip of 8 px beside clipped pixels of a much larger area, which are no core of so small a highlight.
        let (_, result) = local(|x, y| {
            let sheen = light() * (40.0 * (1.0 - (60.0 - x) / 8.0).clamp(0.0, 1.0));
            if x > 60.0 { Vec3::repeat(255.0) } else { slope(x, y) + sheen }
        });
        let surface = |x: usize| result.surface[48 * SIDE_PX + x].iter().sum::<f32>();
        assert!(
            (50..58).any(|x| surface(x) > 1.0),
            "the strip is split: {:?}",
            (50..61).map(surface).collect::<Vec<_>>()
        );
        assert!(surface(60) < 1e-3, "beside the clipped pixels: {}", surface(60));
        assert!(surface(70) < 1e-3, "the clipped pixels are not filled");
    }

    #[test]
    fn a_print_without_highlights_is_left_alone() {
        let check = |x: f64, y: f64| ((x / 9.0).floor() + (y / 9.0).floor()) as i64 % 2 == 0;
        let colors = [Vec3::new(0.8, 0.3, 0.2), Vec3::new(0.6, 0.5, 0.45)];
        let (image, result) = local(|x, y| colors[usize::from(check(x, y))] * (110.0 + 0.5 * x));
        let changed = result.surface.as_slice().iter().filter(|s| s.iter().sum::<f32>() > 6.0).count();
        assert!(changed < image.pixels.len() / 200, "{changed} pixels");
        let (image, result) = local(slope);
        assert_eq!(result.body.as_slice(), image.pixels.as_slice(), "shading alone is no highlight");
    }

    #[test]
    fn under_a_light_slightly_off_body_reflection_takes_the_chromaticity_around() {
        let true_light = (light() + Vec3::new(0.03, -0.03, 0.0)).normalize();
        let blob =
            |x: f64, y: f64| true_light * (60.0 * (-((x - 48.0).powi(2) + (y - 40.0).powi(2)) / 32.0).exp());
        let worst_deg = |chromaticity_prior: bool| {
            let refine = Refine { chromaticity_prior, ..Params::default().refinements() };
            let (_, result) = local_refined(0.1, refine, |x, y| slope(x, y) + blob(x, y));
            let error = |x: usize, y: usize| {
                crate::color::axis_angle_deg(&vec3(result.body[y * SIDE_PX + x]), &slope(0.0, 0.0))
            };
            (44..53).map(|x| error(x, 40)).fold(0.0, f64::max)
        };
        let (with, without) = (worst_deg(true), worst_deg(false));
        assert!(with < 0.6 * without && without > 0.5, "{with}\u{b0} with the rule, {without}\u{b0} without");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn body_is_never_more_than_the_input_and_surface_is_the_rest(
            colors in prop::array::uniform2(prop::array::uniform3(0.05f64..1.0)), period in 3.0f64..20.0, peak in 0.0f64..500.0,
        ) {
            let color = |x: f64, y: f64| {
                let first = ((x / period).floor() + (y / period).floor()) as i64 % 2 == 0;
                Vec3::from(colors[usize::from(first)]) * (60.0 + x) + highlight(x, y, peak)
            };
            let refine = Refine { chromaticity_prior: false, ..Params::default().refinements() };
            let (_, plain) = local_refined(0.1, refine, color);
            let (image, result) = local(color);
            for (pixel, input) in image.pixels.as_slice().iter().enumerate() {
                let is_clipped = input.iter().any(|band| *band >= CLIP_THRESHOLD);
                if !is_clipped {
                    let change = vec3(result.surface[pixel]) - vec3(plain.surface[pixel]);
                    prop_assert!(change.norm() < 1e-9, "an unclipped pixel keeps its surface reflection");
                }
                for (band, input) in input.iter().enumerate() {
                    let (body, surface) = (result.body[pixel][band], result.surface[pixel][band]);
                    prop_assert!(body >= 0.0 && surface >= 0.0 && body <= *input);
                    let rest = plain.body[pixel][band] + plain.surface[pixel][band] - input;
                    // A band that was restored has more light than the file keeps.
                    prop_assert!(rest.abs() < 1e-3 || (is_clipped && rest > 0.0), "body and surface reflection are the input without the rule");
                }
                prop_assert!((0.0..=1.0).contains(&result.confidence[pixel]));
            }
        }
    }
}
