//! What the pixels of a window are judged by: their desaturation, and the evidence of highlights.

use super::desaturation_map::DesaturationMap;
use super::evidence::Evidence;
use super::lamps::Lamps;
use super::limits::limits;
use super::region_ratios::Regions;
use crate::raster::Roi;
use crate::segment::AnalysisInput;

/// How far around the wanted pixels the window reaches, pixels.
const MARGIN_PX: usize = 24;

/// What the pixels of a window are judged by, whether a region explains them or not.
pub struct Observations<'a> {
    /// The desaturation of each pixel.
    pub map: DesaturationMap<'a>,
    /// The evidence of a highlight in each pixel; none without refinement `highlight_evidence`.
    pub evidence: Option<Evidence>,
}

impl<'a> Observations<'a> {
    /// The observations in a window around the pixels for which `wanted` is true, under the light of `lamps`; none where there is no
    /// such pixel. `regions`: the regions of the picture, which may have ratios of their own.
    pub fn around(
        input: &AnalysisInput,
        lamps: &Lamps,
        regions: &Regions<'a>,
        wanted: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let size = (input.pixels.width(), input.pixels.height());
        let roi = Roi::around(size, MARGIN_PX, wanted)?;
        let limits = limits(input);
        let map = DesaturationMap::new(input, &limits, lamps, roi, regions);
        let evidence = input.refine.highlight_evidence.then(|| Evidence::new(&limits, &map));
        Some(Self { map, evidence })
    }
}
