//! The windows and their merged areas, of the working picture and of the second look.

use super::working_outputs::MergedAreas;
use crate::raster::Raster;
use crate::segment::{AnalysisInput, Areas, Classifier, Windows, classify, merge};
use crate::trace::{NoopRecorder, Recorder};
use std::sync::Arc;

/// Windows of which none has a class: the earlier methods know no windows.
pub(super) fn windows_without_class(input: &AnalysisInput) -> Windows {
    let size_px = input.used.window_size as usize;
    let mut classifier = Classifier::new(input.used.camera_noise, false);
    classify(input.pixels, |_| false, size_px, 1, &mut classifier, &mut NoopRecorder)
}

/// The classified windows. In the paper every pixel counts; with `tail_test` only usable pixels count, and a window gets a class
/// only if at least half of its pixels are usable.
pub(super) fn classify_windows<R: Recorder>(input: &AnalysisInput, recorder: &mut R) -> Windows {
    let size_px = input.used.window_size as usize;
    let mut classifier = Classifier::new(input.used.camera_noise, input.refine.tail_test);
    if input.refine.tail_test {
        let valid = |pixel| input.masks.usable(pixel);
        classify(input.pixels, valid, size_px, size_px * size_px / 2, &mut classifier, recorder)
    } else {
        let valid = |pixel| !input.masks.invalid(pixel) && !input.masks.outside(pixel);
        classify(input.pixels, valid, size_px, 2, &mut classifier, recorder)
    }
}

/// The merged areas of the windows.
pub(super) fn merged_areas<R: Recorder>(
    input: &AnalysisInput,
    windows: &Windows,
    recorder: &mut R,
) -> MergedAreas {
    let mut classifier = Classifier::new(input.used.camera_noise, input.refine.tail_test);
    let areas = merge(windows, &mut classifier, recorder);
    let map = area_map(&areas, windows, input.pixels.width(), input.pixels.height());
    MergedAreas { areas, map: Arc::new(map) }
}

/// The merged area of each pixel, from 1; 0 where the window has no class.
fn area_map(areas: &Areas, windows: &Windows, width: usize, height: usize) -> Raster<u32> {
    let size_px = windows.size_px;
    let number = |&area: &u32| if areas.classes[area as usize].is_some() { area + 1 } else { 0 };
    let mut map = Vec::with_capacity(width * height);
    for y in 0..height {
        if y % size_px > 0 {
            map.extend_from_within((y - 1) * width..y * width);
            continue;
        }
        for (column, area) in areas.of_window.row(y / size_px).iter().enumerate() {
            let end = y * width + ((column + 1) * size_px).min(width);
            map.resize(end, number(area));
        }
    }
    Raster::from_vec(width, height, map).unwrap_or_default()
}
