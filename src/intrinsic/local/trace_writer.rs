//! What is recorded of the local split; nothing where no record is kept.

use super::blobs::{CORE_TEXTURE, Judged, TEXTURE_LIMITS};
use super::shade::{LEAST_CHROMA, LEAST_MEAN, Shades};
use super::{LEAST_PIXELS, LEAST_SHARE};
use crate::raster::{Mask, Raster};
use crate::segment::AnalysisInput;
use crate::trace::{
    BlobsCounted, Event, LocalBegan, LocalLimits, LocalPoint, LocalPoints, LocalRecord, LocalStart, Pass,
    PassBegan, PlausibilityTested, Recorder, RepairTried,
};
use rayon::prelude::*;

/// Tells a recorder of each decision, and collects what each pixel was judged by.
pub struct LocalTraceWriter<'a, R> {
    recorder: &'a mut R,
    /// The ambient light that was subtracted, counts.
    origin: [f64; 3],
    points: Option<LocalPoints>,
    /// Blobs that have a number.
    numbered: u16,
}

impl<'a, R: Recorder> LocalTraceWriter<'a, R> {
    pub fn new(recorder: &'a mut R, origin: [f64; 3]) -> Self {
        Self { recorder, origin, points: None, numbered: 0 }
    }

    fn record(&mut self, decision: impl Into<Event>) {
        self.recorder.record(decision);
    }

    /// It begins, or not. `pixels` lie outside of what holds, of `lit` ones.
    pub fn began(
        &mut self,
        input: &AnalysisInput,
        start: LocalStart,
        [pixels, lit]: [usize; 2],
        light: Option<[f64; 3]>,
    ) {
        if !R::KEEPS {
            return;
        }
        self.recorder.record(PassBegan { pass: Pass::LocalSplit });
        let refine = input.refine;
        let limits = LocalLimits {
            mean: LEAST_MEAN,
            chroma: LEAST_CHROMA * input.sigma() as f32,
            texture: TEXTURE_LIMITS,
            core_texture: CORE_TEXTURE,
            sigma: input.sigma() as f32,
        };
        self.record(LocalBegan {
            start,
            pixels: pixels as u32,
            lit: lit as u32,
            least: LEAST_PIXELS.max((LEAST_SHARE * lit as f64).ceil() as usize) as u32,
            light,
            origin: self.origin,
            limits,
            texture_test: refine.texture_test,
            hysteresis: refine.hysteresis,
            clip_repair: refine.clip_repair,
        });
    }

    /// Each candidate highlight.
    pub fn judged(
        &mut self,
        input: &AnalysisInput,
        shades: &Shades,
        texture: Option<&Raster<f32>>,
        outside: &Mask,
        judged: &Judged,
    ) {
        if !R::KEEPS {
            return;
        }
        let mut of = points(input, shades, texture, outside);
        for &(index, blob) in &judged.of {
            of[index].blob = blob;
        }
        self.points = Some(LocalPoints { roi: shades.roi, of });
        self.numbered = judged.blobs.len() as u16;
        if input.refine.hysteresis {
            let Judged { found, small, small_pixels, .. } = *judged;
            self.record(BlobsCounted { found, small, small_pixels, least: Judged::LEAST });
        }
        for &blob in &judged.blobs {
            self.record(blob);
        }
    }

    /// Whether highlights are believed.
    pub fn believed(&mut self, tested: PlausibilityTested) {
        if R::KEEPS {
            self.record(tested);
        }
    }

    /// What follows is the repair of clipped blobs.
    pub fn repairs(&mut self) {
        if R::KEEPS {
            self.recorder.record(PassBegan { pass: Pass::ClipRepair });
        }
    }

    /// A clipped blob was filled, or not.
    pub fn repair(&mut self, tried: RepairTried, blob: &[usize]) {
        if !R::KEEPS || self.numbered >= LocalPoint::MOST_BLOBS {
            return;
        }
        self.numbered += 1;
        if let Some(LocalPoints { roi, of }) = &mut self.points {
            for index in blob.iter().filter_map(|&pixel| roi.index(pixel)) {
                of[index].blob = self.numbered;
            }
        }
        self.record(RepairTried { blob: self.numbered, ..tried });
    }

    /// That was all; `outside`: what lies outside of what holds.
    pub fn finish(self, outside: Mask) {
        if R::KEEPS {
            self.recorder.local(self.points.map_or(LocalRecord::Outside(outside), LocalRecord::Points));
        }
    }
}

/// What each pixel of the window is judged by.
fn points(
    input: &AnalysisInput,
    shades: &Shades,
    texture: Option<&Raster<f32>>,
    outside: &Mask,
) -> Raster<LocalPoint> {
    let width = shades.roi.width;
    let mut points = Raster::filled(width, shades.roi.height, LocalPoint::default());
    points.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(row, points)| {
        for (column, point) in points.iter_mut().enumerate() {
            let index = row * width + column;
            let pixel = shades.roi.pixel(index);
            if !input.masks.dark(pixel) {
                let texture = texture.map_or(0.0, |texture| texture[index]);
                *point = LocalPoint::new(outside[pixel], shades.ratios(input, index), texture);
            }
        }
    });
    points
}
