//! Section 6: every pixel's amounts of body and surface reflection, by its region's T.

use super::ambient::Ambient;
use super::confidence::Grounds;
use super::holding::holding;
use super::local::split_locally;
use super::reason::{Case, Reason};
use super::region::{Known, MIN_ANGLE_DEG};
use super::restore::Distorted;
use super::vectors::{Vectors, fit_vectors};
use super::{Intrinsic, RegionReflection};
use crate::color::{Vec3, dot, rgb};
use crate::raster::{Raster, UNASSIGNED};
use crate::reflection::{Components, HighlightTest, ReflectionTransform};
use crate::segment::{
    FinalRegions, Members, Pixels, PlanarHypothesis, RegionFit, Scene, members, neighbours,
};
use crate::trace::{Event, Pass, PixelKind, Recorder, VectorsFitted};
use rayon::prelude::*;

/// Splits the picture, without its ambient light.
pub fn split<R: Recorder>(scene: &Scene, regions: &FinalRegions, recorder: &mut R) -> Intrinsic {
    let members = members(regions);
    let ambient = Ambient::new(scene, regions, &members);
    let Some(counts) = ambient.subtracted else {
        return Intrinsic { ambient, ..split_from(&[0.0; 3], scene, regions, &members, recorder) };
    };
    let less = counts.map(|band| band as f32);
    let pixels = scene.pixels.map(|&color| std::array::from_fn(|band| color[band] - less[band]));
    let shifted = FinalRegions {
        labels: regions.labels.clone(),
        hypotheses: regions
            .hypotheses
            .iter()
            .map(|hypothesis| hypothesis.from_origin(&counts.into()))
            .collect(),
        light: regions.light,
    };
    let mut result = split_from(&counts, &scene.with_pixels(&pixels), &shifted, &members, recorder);
    result.ambient = ambient;
    for color in result.body.as_mut_slice() {
        *color = std::array::from_fn(|band| color[band] + less[band]);
    }
    for region in &mut result.regions {
        let moved = std::iter::once(&mut region.matte_mean).chain(&mut region.highlight_start);
        moved.for_each(|color| *color = std::array::from_fn(|band| color[band] + counts[band]));
    }
    result
}

/// Splits a picture whose colours were measured from `origin`, counts.
fn split_from<R: Recorder>(
    origin: &[f64; 3],
    scene: &Scene,
    regions: &FinalRegions,
    members: &Members,
    recorder: &mut R,
) -> Intrinsic {
    let splitters: Vec<Splitter> = regions
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| Splitter::new(scene, hypothesis, members.region(index as u16 + 1)))
        .collect();
    let mut images = Images::split_undistorted(scene, regions, &splitters);
    if scene.stopped() {
        return images.unfinished();
    }
    images.restore(origin, scene, regions, (&splitters, members));
    let fits: Vec<RegionFit> = splitters
        .par_iter()
        .enumerate()
        .map(|(index, splitter)| {
            let id = index as u16 + 1;
            let (body, surface) = (&splitter.vectors.body, splitter.vectors.surface.as_ref());
            RegionFit::new(scene, &regions.labels, (id, members.region(id)), (&Vec3::zeros(), body, surface))
        })
        .collect();
    if R::KEEPS {
        recorder.record(Event::PassBegan { pass: Pass::Vectors });
        for (region, (splitter, fit)) in (1..).zip(splitters.iter().zip(&fits)) {
            recorder
                .record(Event::VectorsFitted(Box::new(splitter.vectors_fitted(scene, region, origin, fit))));
        }
    }
    let holding = holding(scene, regions, members, &fits, &images.kinds);
    let local = split_locally((scene, origin), regions, &holding, &mut images, recorder);
    if R::KEEPS {
        recorder.record(Event::PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let touching = neighbours(&regions.labels, regions.hypotheses.len());
    let reflections: Vec<RegionReflection> = splitters
        .par_iter()
        .zip(touching)
        .enumerate()
        .map(|(index, (splitter, neighbours))| {
            let id = index as u16 + 1;
            let known = Known { id, pixels: members.region(id), fit: fits[index], kinds: &images.kinds };
            known.report(scene, splitter, neighbours)
        })
        .collect();
    let grounds = Grounds {
        labels: &regions.labels,
        holding: &holding,
        kinds: &images.kinds,
        noise: &images.noise,
        regions: &reflections,
        sigma: scene.sigma() as f32,
    };
    let confidence = grounds.confidence(local.as_ref());
    let case = Case {
        masks: scene.masks,
        labels: &regions.labels,
        holding: &holding,
        kinds: &images.kinds,
        noise: &images.noise,
        regions: &reflections,
        light: regions.light.direction,
        sigma: scene.sigma() as f32,
    };
    let reasons = case.reasons();
    let Images { body, surface, noise, kinds } = images;
    let ambient = Ambient::default();
    Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: reflections }
}

/// How one region's pixels are split.
pub(super) struct Splitter {
    pub(super) hypothesis: PlanarHypothesis,
    pub(super) vectors: Vectors,
    /// None where the region has no plane: then all is body reflection.
    pub(super) transform: Option<ReflectionTransform>,
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

    fn vectors_fitted(
        &self,
        scene: &Scene,
        region: u16,
        origin: &[f64; 3],
        fit: &RegionFit,
    ) -> VectorsFitted {
        let PlanarHypothesis { matte, start, .. } = self.hypothesis.from_origin(&-Vec3::from(*origin));
        VectorsFitted {
            region,
            body: self.vectors.body,
            surface: self.transform.and(self.vectors.surface),
            matte,
            start,
            highlight: self.hypothesis.plane.map(|plane| plane.surface),
            least_offset: self.least_offset,
            rms_counts: fit.rms_counts,
            texture: fit.texture,
            texture_slope: fit.texture_slope,
            limits: RegionFit::limits(scene.sigma()),
            holds: !scene.refine.region_holds || fit.holds(scene.sigma()),
            origin: *origin,
        }
    }

    fn kind(&self, color: [f32; 3]) -> PixelKind {
        if self.test.is_some_and(|test| test.is_highlight(color)) {
            PixelKind::Highlight
        } else {
            PixelKind::Matte
        }
    }
}

/// A pixel, its body and surface colour, and whether they are restored or lost.
type RestoredPixel = (u32, [[f32; 3]; 2], PixelKind);

/// The intrinsic images while they are made.
pub(super) struct Images {
    pub(super) body: Raster<[f32; 3]>,
    pub(super) surface: Raster<[f32; 3]>,
    pub(super) noise: Raster<f32>,
    pub(super) kinds: Raster<PixelKind>,
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

    /// What there is when the run is stopped.
    fn unfinished(self) -> Intrinsic {
        let Self { body, surface, noise, kinds } = self;
        let confidence = Raster::filled(body.width(), body.height(), 0.0);
        let reasons = confidence.map(|_| Reason::default());
        let ambient = Ambient::default();
        Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: Vec::new() }
    }

    /// Restores distorted pixels from their good bands and their surroundings.
    fn restore(
        &mut self,
        origin: &[f64; 3],
        scene: &Scene,
        regions: &FinalRegions,
        (splitters, members): (&[Splitter], &Members),
    ) {
        let distorted = Distorted {
            pixels: scene.pixels,
            masks: scene.masks,
            labels: &regions.labels,
            clip_thresholds: origin.map(|band| (scene.used.clip_threshold - band) as f32),
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
