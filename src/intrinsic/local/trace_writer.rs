//! The record of the local split. Nothing is computed where no record is kept.

use super::chromaticity::ChromaticityChanges;
use super::desaturation_map::DesaturationMap;
use super::evidence::Evidence;
use super::hue_restoration::HueRestored;
use super::least_pixels;
use crate::raster::{Mask, Raster};
use crate::segment::{AnalysisInput, LightFindings};
use crate::trace::{
    Event, LocalBegan, LocalFigures, LocalLimits, LocalPoint, LocalPoints, LocalRecord, LocalStart, Pass,
    PassBegan, PictureOddsFound, PlausibilityTested, Recorder, RepairTried,
};
use rayon::prelude::*;

/// Records each decision of the local split, and collects what each pixel was judged by.
pub struct LocalTraceWriter<'a, R> {
    recorder: &'a mut R,
    /// The ambient light that was subtracted, counts.
    origin: [f64; 3],
    /// The lit pixels that no region explains.
    unexplained: &'a Mask,
    points: Option<LocalPoints>,
    /// Number of blobs that have a number.
    numbered: u16,
}

impl<'a, R: Recorder> LocalTraceWriter<'a, R> {
    /// A writer to `recorder`. `origin`: the ambient light that was subtracted, counts. `unexplained`: the lit pixels that no region explains.
    pub fn new(recorder: &'a mut R, origin: [f64; 3], unexplained: &'a Mask) -> Self {
        Self { recorder, origin, unexplained, points: None, numbered: 0 }
    }

    fn record(&mut self, decision: impl Into<Event>) {
        self.recorder.record(decision);
    }

    /// Records that the local split begins, or why not. `pixels`: number of unexplained lit pixels; `lit`: number of lit pixels;
    /// `light`: the light.
    pub fn began(
        &mut self,
        input: &AnalysisInput,
        limits: &LocalLimits,
        start: LocalStart,
        pixels: usize,
        lit: usize,
        light: &LightFindings,
    ) {
        if !R::KEEPS {
            return;
        }
        self.recorder.record(PassBegan { pass: Pass::LocalSplit });
        let refine = input.refine;
        self.record(LocalBegan {
            start,
            pixels: pixels as u32,
            lit: lit as u32,
            least: least_pixels(lit) as u32,
            light: light.direction,
            second_light: light.second.map(|second| second.direction),
            origin: self.origin,
            limits: *limits,
            highlight_evidence: refine.highlight_evidence,
            guided_amount: refine.guided_amount,
            clip_repair: refine.clip_repair,
        });
    }

    /// Records what each pixel of the window is judged by, and the bands that were `restored` before.
    pub fn judged(
        &mut self,
        input: &AnalysisInput,
        map: &DesaturationMap,
        evidence: Option<(&Evidence, PictureOddsFound)>,
        restored: Option<&HueRestored>,
    ) {
        if !R::KEEPS {
            return;
        }
        let restored = restored.map_or(Vec::new(), |restored| restored.bands.clone());
        let terms = evidence.map(|(terms, _)| terms);
        let of = points(input, map, terms, self.unexplained);
        self.points = Some(LocalPoints { roi: map.roi, of, restored });
        if let Some((_, picture)) = evidence {
            self.record(picture);
        }
    }

    /// Records the amount of surface reflection that each pixel of the window got, counts of J.
    pub fn amounts(&mut self, amounts: &Raster<f32>) {
        if let Some(LocalPoints { of, .. }) = &mut self.points {
            of.as_mut_slice()
                .iter_mut()
                .zip(amounts.as_slice())
                .for_each(|(point, &amount)| point.amount = amount);
        }
    }

    /// Records how far the chromaticity of the body reflection of each pixel of the window changed.
    pub fn chromaticity(&mut self, changes: &ChromaticityChanges) {
        if let Some(LocalPoints { of, .. }) = &mut self.points {
            let points = of.as_mut_slice().iter_mut().enumerate();
            points.for_each(|(index, point)| point.set_turn(changes.angle_deg(index)));
        }
    }

    /// Records whether highlights are plausible under the light.
    pub fn plausibility(&mut self, tested: PlausibilityTested) {
        if R::KEEPS {
            self.record(tested);
        }
    }

    /// Records that the repair of clipped blobs begins.
    pub fn repairs_began(&mut self) {
        if R::KEEPS {
            self.recorder.record(PassBegan { pass: Pass::ClipRepair });
        }
    }

    /// Records that a clipped blob with the pixels `blob` was filled, or why not, and numbers the blob from 1. Blobs
    /// after the first `LocalPoint::MOST_BLOBS` are not recorded.
    pub fn repair(&mut self, tried: RepairTried, blob: &[usize]) {
        if !R::KEEPS || self.numbered >= LocalPoint::MOST_BLOBS {
            return;
        }
        self.numbered += 1;
        if let Some(LocalPoints { roi, of, .. }) = &mut self.points {
            for index in blob.iter().filter_map(|&pixel| roi.index(pixel)) {
                of[index].set_blob(self.numbered);
            }
        }
        self.record(RepairTried { blob: self.numbered, ..tried });
    }

    /// Records what the pixels were judged by; of a split that did not begin, which pixels are unexplained.
    pub fn finish(self) {
        if R::KEEPS {
            let outside = || LocalRecord::Outside(self.unexplained.clone());
            self.recorder.local(self.points.map_or_else(outside, LocalRecord::Points));
        }
    }
}

/// What each pixel of the window is judged by; dark pixels have the default.
fn points(
    input: &AnalysisInput,
    map: &DesaturationMap,
    evidence: Option<&Evidence>,
    unexplained: &Mask,
) -> Raster<LocalPoint> {
    let width = map.roi.width;
    let mut points = Raster::filled(width, map.roi.height, LocalPoint::default());
    points.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(row, points)| {
        for (column, point) in points.iter_mut().enumerate() {
            let index = row * width + column;
            let pixel = map.roi.pixel(index);
            if !input.masks.dark(pixel) {
                let (terms, odds) = evidence.map_or_else(Default::default, |evidence| {
                    (evidence.terms[index], evidence.log_odds[index])
                });
                let figures =
                    LocalFigures { ratios: map.ratios(input, index), terms, odds, ..LocalFigures::default() };
                *point = LocalPoint::new(unexplained[pixel], &figures);
                point.set_second_lamp(map.lamps.is_second(pixel));
            }
        }
    });
    points
}
