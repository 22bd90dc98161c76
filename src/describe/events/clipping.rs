//! Holes, and which hypotheses become regions (section 5.5).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, nothing};
use crate::describe::names::percent;
use crate::describe::{Names, counted};
use crate::raster::RegionId;
use crate::trace::{ComponentSplit, Dropped, HoleFilled, Renumbered};
use serde_json::json;

impl Describe for HoleFilled {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, pixel, pixels, border_share } = self;
        format!(
            "a hole of {} at {} goes to {}, which holds {} of its border",
            counted(*pixels, "pixel"),
            names.pixel(*pixel),
            names.hypothesis(*hypothesis),
            percent(*border_share)
        )
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "pixel": names.position(self.pixel)}),
            json!({"pixels": self.pixels, "border_share": self.border_share}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            hypothesis: hypothesis(1),
            pixel: crate::raster::PixelIndex::new(23),
            pixels: 9,
            border_share: 0.75,
        }
    }
}

impl Describe for Dropped {
    fn sentence(&self, names: &Names) -> String {
        format!(
            "{} is dropped, too small: {}",
            names.hypothesis(self.hypothesis),
            counted(self.pixels, "pixel")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(json!({"region": self.hypothesis}), json!({"pixels": self.pixels}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(2), pixels: 14 }
    }
}

impl Describe for ComponentSplit {
    fn sentence(&self, names: &Names) -> String {
        format!(
            "{} of {} lie apart and become {}",
            counted(self.pixels, "pixel"),
            names.hypothesis(self.hypothesis),
            names.hypothesis(self.part)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "part": self.part}),
            json!({"pixels": self.pixels}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(1), part: hypothesis(4), pixels: 80 }
    }
}

impl Describe for Renumbered {
    fn sentence(&self, _names: &Names) -> String {
        let kept = self.regions.iter().flatten().count();
        format!("of {} hypotheses {kept} are regions, numbered by size", self.regions.len())
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let regions: Vec<u16> = self.regions.iter().map(|&region| RegionId::label(region)).collect();
        LineObjects::new(nothing(), json!({"regions": regions}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { regions: [2, 0, 1].map(RegionId::from_label).into() }
    }
}
