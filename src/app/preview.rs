//! The result for the working picture of a large photograph, shown until the pass at full resolution has ended.

use crate::raster::Blocks;
use crate::view::ResultSnapshot;
use std::sync::Arc;

/// The result for the working picture.
#[derive(Clone, Debug)]
pub struct Preview {
    /// The result, in working pixels.
    pub shown: Arc<ResultSnapshot>,
    /// The blocks of the photograph that are the working pixels.
    pub blocks: Blocks,
}
