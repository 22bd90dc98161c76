//! Section 6: every pixel's amounts of body and surface reflection, by its region's T.

use super::restore::Distorted;
use super::vectors::{Vectors, fit_rms, fit_vectors};
use super::{Intrinsic, RegionReflection};
use crate::color::{dot, rgb};
use crate::raster::{Raster, UNASSIGNED};
use crate::reflection::{Components, HighlightTest, ReflectionTransform};
use crate::segment::{FinalRegions, Members, Pixels, PlanarHypothesis, Scene, members, neighbours};
use crate::trace::{Event, Pass, PixelKind, Recorder, VectorsFitted};
use rayon::prelude::*;

/// Below this angle body and surface reflection cannot be told apart at all, degrees.
const MIN_ANGLE_DEG: f64 = 3.0;
/// Below this angle they can, with noise amplified more than four times.
const SMALL_ANGLE_DEG: f64 = 14.0;
/// A fit worse than this many σ of a band's noise is worth a warning.
pub const POOR_FIT: f64 = 1.5;

/// Splits the picture.
pub fn split<R: Recorder>(scene: &Scene, regions: &FinalRegions, recorder: &mut R) -> Intrinsic {
    let members = members(regions);
    let splitters: Vec<Splitter> = regions
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| Splitter::new(scene, hypothesis, members.region(index as u16 + 1)))
        .collect();
    if R::KEEPS {
        recorder.record(Event::PassBegan { pass: Pass::Vectors });
        for (region, splitter) in (1..).zip(&splitters) {
            recorder.record(Event::VectorsFitted(Box::new(splitter.vectors_fitted(region))));
        }
    }
    let mut images = Images::split_undistorted(scene, regions, &splitters);
    if scene.stopped() {
        return images.with_regions(Vec::new());
    }
    images.restore(scene, regions, &splitters, &members);
    if R::KEEPS {
        recorder.record(Event::PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let touching = neighbours(&regions.labels, regions.hypotheses.len());
    let reflections = splitters
        .par_iter()
        .zip(touching)
        .enumerate()
        .map(|(index, (splitter, neighbours))| {
            let id = index as u16 + 1;
            splitter.report(scene, id, members.region(id), &images.kinds, neighbours)
        })
        .collect();
    images.with_regions(reflections)
}

/// How one region's pixels are split.
struct Splitter {
    hypothesis: PlanarHypothesis,
    vectors: Vectors,
    /// None where the region has no plane: then all is body reflection.
    transform: Option<ReflectionTransform>,
    test: Option<HighlightTest>,
    /// Amount of body reflection where the highlight line starts, counts.
    start_body: f32,
    /// Surface reflection that lies less than this off the body line is none, counts; negative infinity: any is some.
    least_offset: f32,
}

impl Splitter {
    fn new(scene: &Scene, hypothesis: &PlanarHypothesis, pixels: Pixels) -> Self {
        let vectors = fit_vectors(scene, hypothesis, pixels);
        let transform = vectors
            .surface
            .filter(|surface| crate::color::axis_angle_deg(&vectors.body, surface) >= MIN_ANGLE_DEG)
            .and_then(|surface| ReflectionTransform::new(&vectors.body, &surface));
        let start_body = transform.map_or(0.0, |t| t.split(rgb(&hypothesis.start)).body.max(0.0));
        let least_offset =
            if scene.refine.no_negative_surface { scene.used.camera_noise as f32 } else { f32::NEG_INFINITY };
        let test = hypothesis.highlight_test().filter(|_| transform.is_some());
        Self { hypothesis: *hypothesis, vectors, transform, test, start_body, least_offset }
    }

    /// The components of an undistorted pixel.
    #[inline]
    fn split(&self, color: [f32; 3]) -> Components {
        let Some(transform) = &self.transform else {
            return Components { body: dot(color, rgb(&self.vectors.body)), surface: 0.0, noise: 0.0 };
        };
        let components = transform.split(color);
        if components.surface * transform.sine() < self.least_offset {
            return Components { body: dot(color, transform.body()), surface: 0.0, ..components };
        }
        components
    }

    fn vectors_fitted(&self, region: u16) -> VectorsFitted {
        VectorsFitted {
            region,
            body: self.vectors.body,
            surface: self.transform.and(self.vectors.surface),
            matte: self.hypothesis.matte,
            start: self.hypothesis.start,
            highlight: self.hypothesis.plane.map(|plane| plane.surface),
            least_offset: self.least_offset,
        }
    }

    fn kind(&self, color: [f32; 3]) -> PixelKind {
        if self.test.is_some_and(|test| test.is_highlight(color)) {
            PixelKind::Highlight
        } else {
            PixelKind::Matte
        }
    }

    fn report(
        &self,
        scene: &Scene,
        id: u16,
        pixels: Pixels,
        kinds: &Raster<PixelKind>,
        neighbours: Vec<u16>,
    ) -> RegionReflection {
        let count = |test: &dyn Fn(usize) -> bool| pixels.iter().filter(|&p| test(p as usize)).count();
        let matte_pixels = count(&|pixel| kinds[pixel] == PixelKind::Matte);
        let highlight_pixels = pixels.len() - matte_pixels;
        let surface = self.vectors.surface;
        let angle_deg = surface.map(|surface| crate::color::axis_angle_deg(&self.vectors.body, &surface));
        let fit_rms_counts = fit_rms(scene, &self.vectors, pixels);
        RegionReflection {
            id,
            pixels: pixels.len(),
            matte_pixels,
            highlight_pixels,
            clipped_pixels: count(&|pixel| scene.masks.clipped(pixel)),
            body: self.vectors.body.into(),
            surface: surface.map(Into::into),
            matte_mean: self.vectors.matte_mean.into(),
            highlight_start: surface.map(|_| self.hypothesis.start.into()),
            plane_normal: self.transform.map(|t| t.normal().map(f64::from)),
            angle_deg,
            fit_rms_counts,
            separable: self.transform.is_some(),
            neighbours,
            warnings: self.warnings(scene, angle_deg, fit_rms_counts, pixels, kinds),
        }
    }

    fn warnings(
        &self,
        scene: &Scene,
        angle_deg: Option<f64>,
        fit_rms_counts: f64,
        pixels: Pixels,
        kinds: &Raster<PixelKind>,
    ) -> Vec<String> {
        let mut warnings = Vec::new();
        match angle_deg {
            None => warnings.push("no dichromatic plane: everything counts as body reflection".to_owned()),
            Some(angle) if angle < MIN_ANGLE_DEG => warnings.push(format!(
                "body and surface vector are collinear ({angle:.1}\u{b0}): everything counts as body reflection"
            )),
            Some(angle) if angle < SMALL_ANGLE_DEG => warnings.push(format!(
                "body and surface vector are only {angle:.1}\u{b0} apart: the split amplifies noise {:.0} times",
                1.0 / angle.to_radians().sin()
            )),
            Some(_) => {}
        }
        let limit = POOR_FIT * scene.sigma();
        if fit_rms_counts > limit {
            // Only a region with a surface vector has a plane to lie off.
            let what = if angle_deg.is_some() { "plane" } else { "matte line" };
            warnings.push(format!(
                "poor fit: pixels lie {fit_rms_counts:.1} counts from the {what} (rms), {limit:.1} is noise"
            ));
        }
        let foot = self.hypothesis.matte.foot().norm();
        if foot > scene.sigma() {
            warnings.push(format!(
                "the matte line misses black by {foot:.1} counts: ambient light, inter-reflection or no single material"
            ));
        }
        let lost = pixels.iter().filter(|&pixel| kinds[pixel as usize] == PixelKind::Lost).count();
        if lost > 0 {
            warnings.push(format!("{lost} pixels are clipped in every band: their split is a guess"));
        }
        warnings
    }
}

/// A pixel, its body and surface colour, and whether they are restored or lost.
type RestoredPixel = (u32, [[f32; 3]; 2], PixelKind);

/// The intrinsic images while they are made.
struct Images {
    body: Raster<[f32; 3]>,
    surface: Raster<[f32; 3]>,
    noise: Raster<f32>,
    kinds: Raster<PixelKind>,
}

impl Images {
    /// Splits undistorted pixels; rows in parallel.
    fn split_undistorted(scene: &Scene, regions: &FinalRegions, splitters: &[Splitter]) -> Self {
        let (width, height) = (scene.pixels.width(), scene.pixels.height());
        let mut images = Self {
            body: Raster::filled(width, height, [0.0; 3]),
            surface: Raster::filled(width, height, [0.0; 3]),
            noise: Raster::filled(width, height, 0.0),
            kinds: Raster::filled(width, height, PixelKind::Unassigned),
        };
        let rows = (
            images.body.as_mut_slice().par_chunks_mut(width.max(1)),
            images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
            images.noise.as_mut_slice().par_chunks_mut(width.max(1)),
            images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        );
        rows.into_par_iter().enumerate().for_each(|(y, (body, surface, noise, kinds))| {
            if scene.stopped() {
                return;
            }
            // Copied here and not all at once before, so that threads share the cost of fresh memory.
            body.copy_from_slice(scene.pixels.row(y));
            for (x, &label) in regions.labels.row(y).iter().enumerate() {
                if label == UNASSIGNED || scene.masks.distorted(y * width + x) {
                    continue;
                }
                let splitter = &splitters[usize::from(label) - 1];
                let color = body[x];
                let components = splitter.split(color);
                kinds[x] = splitter.kind(color);
                (body[x], surface[x]) = splitter.colors(components);
                noise[x] = components.noise;
            }
        });
        images
    }

    /// The images, finished, with what is known of each region.
    fn with_regions(self, regions: Vec<RegionReflection>) -> Intrinsic {
        let Self { body, surface, noise, kinds } = self;
        Intrinsic { body, surface, noise, kinds, regions }
    }

    /// Restores distorted pixels from their good bands and their surroundings.
    fn restore(&mut self, scene: &Scene, regions: &FinalRegions, splitters: &[Splitter], members: &Members) {
        let distorted = Distorted {
            pixels: scene.pixels,
            masks: scene.masks,
            labels: &regions.labels,
            clip_threshold: scene.used.clip_threshold as f32,
            sigma: scene.sigma() as f32,
        };
        let restored: Vec<Vec<RestoredPixel>> = splitters
            .par_iter()
            .enumerate()
            .map(|(index, splitter)| {
                let pixels = members.region(index as u16 + 1);
                splitter.restore(scene, &distorted, pixels)
            })
            .collect();
        for (pixel, [body, surface], kind) in restored.into_iter().flatten() {
            let pixel = pixel as usize;
            self.body[pixel] = body;
            self.surface[pixel] = surface;
            self.kinds[pixel] = kind;
        }
    }
}

impl Splitter {
    /// The body and surface colours of components.
    #[inline]
    fn colors(&self, components: Components) -> ([f32; 3], [f32; 3]) {
        let body = self.transform.map_or_else(|| rgb(&self.vectors.body), |t| t.body());
        let surface = self.transform.map_or([0.0; 3], |t| t.surface());
        (body.map(|b| b * components.body), surface.map(|s| s * components.surface))
    }

    /// Colours and kinds of the region's distorted pixels.
    fn restore(&self, scene: &Scene, distorted: &Distorted, pixels: Pixels) -> Vec<RestoredPixel> {
        let waiting: Vec<u32> =
            pixels.iter().filter(|&pixel| scene.masks.distorted(pixel as usize)).collect();
        let priors = distorted.priors(&waiting, |color| self.split(color).body);
        waiting
            .into_iter()
            .zip(priors)
            .map(|(pixel, prior)| {
                let Some(transform) = &self.transform else {
                    let color = scene.pixels[pixel as usize];
                    return (pixel, [color, [0.0; 3]], PixelKind::Lost);
                };
                let restored = if scene.refine.restore_prior {
                    let prior = if prior.is_nan() { self.start_body } else { prior };
                    distorted.most_probable(pixel as usize, transform, prior)
                } else {
                    distorted.smallest_band(pixel as usize, transform, self.test.as_ref(), self.start_body)
                };
                let (body, surface) = self.colors(restored.components);
                let kind = if restored.lost { PixelKind::Lost } else { PixelKind::Restored };
                (pixel, [body, surface], kind)
            })
            .collect()
    }
}
