//! Section 6: every pixel's amounts of body and surface reflection, by its region's T.

use super::ambient::ambient;
use super::confidence::ConfidenceInput;
use super::explained_mask::explained_mask;
use super::local::split_locally;
use super::reason::{Reason, ReasonInput};
use super::region::RegionSummary;
use super::restore::Distorted;
use super::vectors::{Vectors, fit_vectors, matte_mean};
use super::{Intrinsic, RegionReflection};
use crate::color::{Vec3, dot, rgb};
use crate::raster::{Raster, UNASSIGNED};
use crate::reflection::{Components, HighlightTest, MIN_ANGLE_DEG, ReflectionTransform};
use crate::segment::{
    AnalysisInput, BranchSearch, Branches, FinalRegions, Members, Pixels, PlanarHypothesis, RegionFit,
    members, neighbors,
};
use crate::trace::{Ambient, BranchesSought, Pass, PassBegan, PixelKind, Recorder, VectorsFitted};
use rayon::prelude::*;

/// Splits the picture, without its ambient light.
pub fn split<R: Recorder>(input: &AnalysisInput, regions: &FinalRegions, recorder: &mut R) -> Intrinsic {
    let members = members(regions);
    let ambient = ambient(input, regions, &members);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Ambient });
        recorder.record(ambient);
    }
    let Some(counts) = ambient.subtracted else {
        return Intrinsic { ambient, ..split_from(&[0.0; 3], input, regions, &members, recorder) };
    };
    let less = counts.map(|band| band as f32);
    let pixels = input.pixels.map(|&color| std::array::from_fn(|band| color[band] - less[band]));
    let shifted = FinalRegions {
        labels: regions.labels.clone(),
        hypotheses: regions
            .hypotheses
            .iter()
            .map(|hypothesis| hypothesis.from_origin(&counts.into()))
            .collect(),
        light: regions.light,
    };
    let mut result = split_from(&counts, &input.with_pixels(&pixels), &shifted, &members, recorder);
    result.ambient = ambient;
    for color in result.body.as_mut_slice() {
        *color = std::array::from_fn(|band| color[band] + less[band]);
    }
    for region in &mut result.regions {
        let starts = region.highlight_branches.iter_mut().map(|branch| &mut branch.start);
        let moved = std::iter::once(&mut region.matte_mean).chain(&mut region.highlight_start).chain(starts);
        moved.for_each(|color| *color = std::array::from_fn(|band| color[band] + counts[band]));
    }
    result
}

/// Splits a picture whose colors were measured from `origin`, counts.
fn split_from<R: Recorder>(
    origin: &[f64; 3],
    input: &AnalysisInput,
    regions: &FinalRegions,
    members: &Members,
    recorder: &mut R,
) -> Intrinsic {
    let splitters: Vec<Splitter> = regions
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| {
            let id = index as u16 + 1;
            Splitter::new(input, regions, hypothesis, (id, members.region(id)))
        })
        .collect();
    let mut images = Images::split_undistorted(input, regions, &splitters);
    if input.stopped() {
        return images.unfinished();
    }
    images.restore(origin, input, regions, (&splitters, members));
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Vectors });
        for (region, splitter) in (1..).zip(&splitters) {
            let Branches { cores, gaps } = splitter.branches.clone();
            if !cores.is_empty() {
                recorder.record(BranchesSought { region, cores, gaps });
            }
            recorder.record(splitter.vectors_fitted(input, region, origin));
        }
    }
    let fits: Vec<RegionFit> = splitters.iter().map(|splitter| splitter.fit).collect();
    let explained_mask = explained_mask(input, regions, members, &fits, &images.kinds);
    let local = split_locally((input, origin), regions, &explained_mask, &mut images, recorder);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let touching = neighbors(&regions.labels, regions.hypotheses.len());
    let reflections: Vec<RegionReflection> = splitters
        .par_iter()
        .zip(touching)
        .enumerate()
        .map(|(index, (splitter, neighbors))| {
            let id = index as u16 + 1;
            let known = RegionSummary { id, pixels: members.region(id), kinds: &images.kinds };
            known.report(input, splitter, neighbors)
        })
        .collect();
    let grounds = ConfidenceInput {
        labels: &regions.labels,
        explained_mask: &explained_mask,
        kinds: &images.kinds,
        noise: &images.noise,
        regions: &reflections,
        sigma: input.sigma() as f32,
    };
    let confidence = grounds.confidence(local.as_ref());
    let case = ReasonInput {
        masks: input.masks,
        labels: &regions.labels,
        explained_mask: &explained_mask,
        kinds: &images.kinds,
        noise: &images.noise,
        regions: &reflections,
        light: regions.light.direction,
        sigma: input.sigma() as f32,
    };
    let reasons = case.reasons();
    let Images { body, surface, noise, kinds } = images;
    let ambient = Ambient::default();
    Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: reflections }
}

/// One of several highlight lines begins so far off the matte line, σ0.
const CLEAR: f64 = 2.0;

/// How one region's pixels are split.
pub(super) struct Splitter {
    pub(super) hypothesis: PlanarHypothesis,
    pub(super) vectors: Vectors,
    /// None where the region has no plane: then all is body reflection.
    pub(super) transform: Option<ReflectionTransform>,
    /// How well its pixels bear out its vectors.
    pub(super) fit: RegionFit,
    /// Its highlights, held against one another; empty where that was not asked.
    pub(super) branches: Branches,
    /// Where the highlight lines leave the matte line, counts, the strongest branch first.
    pub(super) starts: Vec<Vec3>,
    /// Where the lines begin that highlight pixels are told by, counts. Of several lines only what is clear of the noise counts:
    /// the matte pixels of every shade on which some highlight lies would else be taken for its pixels.
    line_starts: Vec<Vec3>,
    pub(super) test: Option<HighlightTest>,
    /// Amount of body reflection where each highlight line starts, counts.
    pub(super) start_bodies: Vec<f32>,
    /// Surface reflection that lies less than this off the body line is none, counts; negative infinity: any is some.
    least_offset: f32,
}

impl Splitter {
    fn new(
        input: &AnalysisInput,
        regions: &FinalRegions,
        hypothesis: &PlanarHypothesis,
        (region, pixels): (u16, Pixels),
    ) -> Self {
        let least_offset =
            if input.refine.no_negative_surface { input.used.camera_noise as f32 } else { f32::NEG_INFINITY };
        let vectors = fit_vectors(input, hypothesis, pixels);
        let transform = vectors
            .surface
            .filter(|surface| crate::color::axis_angle_deg(&vectors.body, surface) >= MIN_ANGLE_DEG)
            .and_then(|surface| ReflectionTransform::new(&vectors.body, &surface));
        let origin = (&Vec3::zeros(), &vectors.body, vectors.surface.as_ref());
        let fit = RegionFit::new(input, &regions.labels, (region, pixels), origin);
        let start_body = transform.map_or(0.0, |t| t.split(rgb(&hypothesis.start)).body.max(0.0));
        let splitter = Self {
            hypothesis: *hypothesis,
            vectors,
            transform,
            fit,
            branches: Branches::default(),
            starts: vec![hypothesis.start],
            line_starts: vec![hypothesis.start],
            test: hypothesis.highlight_test().filter(|_| transform.is_some()),
            start_bodies: vec![start_body],
            least_offset,
        };
        let wanted = input.refine.second_branch && fit.holds(input.sigma()) && !input.stopped();
        let Some(transform) = transform.as_ref().filter(|_| wanted) else { return splitter };
        let search = BranchSearch {
            input,
            labels: &regions.labels,
            region,
            transform,
            matte_length: hypothesis.matte_length,
            light_doubt_deg: regions.light.interval_deg,
        };
        splitter.with_branches(input, search.run(pixels), pixels)
    }

    /// The same with what its highlights say. Only more than one branch changes anything: how pixels are told apart, and the mean
    /// of the matte ones. The body vector rests on the outer edge of the cluster, where there is no highlight.
    fn with_branches(mut self, input: &AnalysisInput, branches: Branches, pixels: Pixels) -> Self {
        let bodies = branches.bodies();
        self.branches = branches;
        let Some(plane) = self.hypothesis.plane.filter(|_| bodies.len() > 1) else { return self };
        self.starts = bodies.iter().map(|&body| self.vectors.body * f64::from(body)).collect();
        self.start_bodies = bodies;
        let clear = CLEAR * input.used.camera_noise / plane.angle_rad.sin();
        self.line_starts = self.starts.iter().map(|start| start + plane.surface * clear).collect();
        let test = HighlightTest::of_lines(&self.hypothesis.matte, &self.line_starts, &plane.surface);
        self.vectors.matte_mean = matte_mean(input, pixels, &test).unwrap_or(self.vectors.matte_mean);
        self.test = Some(test);
        self
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

    fn vectors_fitted(&self, input: &AnalysisInput, region: u16, origin: &[f64; 3]) -> VectorsFitted {
        let PlanarHypothesis { matte, start, .. } = self.hypothesis.from_origin(&-Vec3::from(*origin));
        VectorsFitted {
            region,
            body: self.vectors.body,
            surface: self.transform.and(self.vectors.surface),
            matte,
            start,
            starts: self.line_starts.iter().map(|start| start + Vec3::from(*origin)).collect(),
            highlight: self.hypothesis.plane.map(|plane| plane.surface),
            least_offset: self.least_offset,
            rms_counts: self.fit.rms_counts,
            texture: self.fit.texture,
            texture_slope: self.fit.texture_slope,
            limits: RegionFit::limits(input.sigma()),
            holds: !input.refine.region_holds || self.fit.holds(input.sigma()),
            origin: *origin,
        }
    }

    fn kind(&self, color: [f32; 3]) -> PixelKind {
        if self.test.as_ref().is_some_and(|test| test.is_highlight(color)) {
            PixelKind::Highlight
        } else {
            PixelKind::Matte
        }
    }
}

/// A pixel, its body and surface color, and whether they are restored or lost.
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
    fn split_undistorted(input: &AnalysisInput, regions: &FinalRegions, splitters: &[Splitter]) -> Self {
        let (width, height) = (input.pixels.width(), input.pixels.height());
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
            if input.stopped() {
                return;
            }
            // Copied here and not all at once before, so that threads share the cost of fresh memory.
            body.copy_from_slice(input.pixels.row(y));
            for (x, &label) in regions.labels.row(y).iter().enumerate() {
                if label == UNASSIGNED || input.masks.distorted(y * width + x) {
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
        input: &AnalysisInput,
        regions: &FinalRegions,
        (splitters, members): (&[Splitter], &Members),
    ) {
        let distorted = Distorted {
            pixels: input.pixels,
            masks: input.masks,
            labels: &regions.labels,
            clip_thresholds: origin.map(|band| (input.used.clip_threshold - band) as f32),
            sigma: input.sigma() as f32,
        };
        let restored: Vec<Vec<RestoredPixel>> = splitters
            .par_iter()
            .enumerate()
            .map(|(index, splitter)| {
                let pixels = members.region(index as u16 + 1);
                splitter.restore(input, &distorted, pixels)
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
    /// The body and surface colors of components.
    #[inline]
    fn colors(&self, components: Components) -> ([f32; 3], [f32; 3]) {
        let body = self.transform.map_or_else(|| rgb(&self.vectors.body), |t| t.body());
        let surface = self.transform.map_or([0.0; 3], |t| t.surface());
        (body.map(|b| b * components.body), surface.map(|s| s * components.surface))
    }

    /// The branch of the highlight that a pixel lies in or nearest to.
    pub(super) fn branch_near(&self, input: &AnalysisInput, pixel: u32) -> usize {
        let width = input.pixels.width() as u32;
        if self.starts.len() > 1 { self.branches.nearest(pixel % width, pixel / width) } else { 0 }
    }

    /// Colors and kinds of the region's distorted pixels.
    fn restore(&self, input: &AnalysisInput, distorted: &Distorted, pixels: Pixels) -> Vec<RestoredPixel> {
        let waiting: Vec<u32> =
            pixels.iter().filter(|&pixel| input.masks.distorted(pixel as usize)).collect();
        let priors = distorted.priors(&waiting, |color| self.split(color).body);
        waiting
            .into_iter()
            .zip(priors)
            .map(|(pixel, prior)| {
                let Some(transform) = &self.transform else {
                    let color = input.pixels[pixel as usize];
                    return (pixel, [color, [0.0; 3]], PixelKind::Lost);
                };
                let start_body = self.start_bodies[self.branch_near(input, pixel)];
                let restored = if input.refine.restore_prior {
                    let prior = if prior.is_nan() { start_body } else { prior };
                    distorted.most_probable(pixel as usize, transform, prior)
                } else {
                    distorted.smallest_band(pixel as usize, transform, self.test.as_ref(), start_body)
                };
                let (body, surface) = self.colors(restored.components);
                let kind = if restored.lost { PixelKind::Lost } else { PixelKind::Restored };
                (pixel, [body, surface], kind)
            })
            .collect()
    }
}
