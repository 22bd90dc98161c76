//! What is known of one pixel: place, color, class, kind, region and amounts, in the result or at the debugger's cursor. The readout and
//! the inspector show the same reading.

use super::{ElsewherePixel, Lamp, LampOfPixels, Picture, PixelAmounts, RegionNames, ResultSnapshot};
use crate::intrinsic::{PixelKind, Reason};
use crate::raster::{HypothesisId, PixelIndex};
use crate::trace::{Class, Replay};

/// Values of a pixel.
pub struct PixelReading {
    /// Column and row.
    pub at: [usize; 2],
    /// Linear counts of red, green and blue.
    pub color: [f32; 3],
    /// The values of the result; none before a result.
    pub analyzed: Option<AnalyzedPixel>,
    /// Color of the region or hypothesis, sRGB.
    pub chip: Option<[u8; 3]>,
    /// The values of another program; none where no picture of another program is open.
    pub elsewhere: Option<ElsewherePixel>,
}

/// Values of a pixel in a result.
pub struct AnalyzedPixel {
    /// Class of the pixel's window.
    pub class: Option<Class>,
    /// Kind of the pixel: matte, highlight and so on.
    pub kind: PixelKind,
    /// Reason why the pixel is not explained; none at the debugger's cursor.
    pub reason: Option<Reason>,
    /// Number of the region; at the debugger's cursor, of the hypothesis.
    pub region: Option<u16>,
    /// The amounts; none in no region.
    pub amounts: Option<PixelAmounts>,
    /// The lamp that the pixel is split with; none in a result with one lamp, and where the pixel is not split.
    pub lamp: Option<Lamp>,
}

impl PixelReading {
    /// The values of a pixel in the photograph and its result. `None` outside of the photograph.
    pub fn of(picture: &Picture, shown: Option<&ResultSnapshot>, pixel: usize) -> Option<Self> {
        let image = &picture.photo.image;
        let color = *image.pixels.as_slice().get(pixel)?;
        let at = [pixel % image.width(), pixel / image.width()];
        let analyzed = shown.map(|shown| AnalyzedPixel::of(shown, pixel, at));
        let chip =
            analyzed.as_ref().and_then(|analyzed| analyzed.region).zip(shown).and_then(|(region, shown)| {
                shown.region_colors.get(usize::from(region).wrapping_sub(1)).copied()
            });
        Some(Self { at, color, analyzed, chip, elsewhere: None })
    }

    /// Values at the debugger's cursor; the region is a hypothesis id. `None` outside of the photograph.
    pub fn at_cursor(picture: &Picture, replay: &Replay, names: &RegionNames, pixel: usize) -> Option<Self> {
        let image = &picture.photo.image;
        let color = *image.pixels.as_slice().get(pixel)?;
        let working_pixel = replay.trace().working_pixel(PixelIndex::from_index(pixel)).index();
        let class = replay.first_grid().and_then(|grid| {
            let window = grid.window_of(working_pixel, replay.trace().width());
            grid.classes.as_slice().get(window).copied().flatten().flatten()
        });
        let hypothesis = HypothesisId::from_label(*replay.labels().as_slice().get(working_pixel)?);
        let region = hypothesis.map(HypothesisId::get);
        let kind = replay.kind(working_pixel);
        let analyzed = AnalyzedPixel { class, kind, reason: None, region, amounts: None, lamp: None };
        let chip = hypothesis.map(|hypothesis| names.color(hypothesis));
        let at = [pixel % image.width(), pixel / image.width()];
        Some(Self { at, color, analyzed: Some(analyzed), chip, elsewhere: None })
    }
}

impl AnalyzedPixel {
    fn of(shown: &ResultSnapshot, pixel: usize, [x, y]: [usize; 2]) -> Self {
        let intrinsic = &shown.analysis.intrinsic;
        let label = shown.labels()[pixel];
        let has_region = usize::from(label).wrapping_sub(1) < intrinsic.regions.len();
        Self {
            class: shown.classes().get(x / shown.window_px(), y / shown.window_px()).copied().flatten(),
            kind: intrinsic.kinds[pixel],
            reason: Some(intrinsic.reasons[pixel]),
            region: has_region.then_some(label),
            amounts: PixelAmounts::of(shown, PixelIndex::from_index(pixel)),
            lamp: LampOfPixels::of(&shown.analysis).and_then(|lamps| lamps.at(pixel)),
        }
    }
}
