//! Holes, and which hypotheses become regions (section 5.5).

use super::{Describe, LineObjects, nothing, place};
use crate::describe::Names;
use crate::describe::names::{count, percent};
use crate::trace::{ComponentSplit, Dropped, HoleFilled, Renumbered};
use serde_json::json;

impl Describe for HoleFilled {
    fn sentence(&self, names: &Names) -> String {
        let Self { region, pixel, pixels, border_share } = self;
        format!(
            "a hole of {} at {} goes to {}, which holds {} of its border",
            count(*pixels, "pixel"),
            names.pixel(*pixel),
            names.region(*region),
            percent(*border_share)
        )
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.region, "pixel": place(names, self.pixel)}),
            json!({"pixels": self.pixels, "border_share": self.border_share}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { region: 1, pixel: 23, pixels: 9, border_share: 0.75 }
    }
}

impl Describe for Dropped {
    fn sentence(&self, names: &Names) -> String {
        format!("{} is dropped, too small: {}", names.region(self.region), count(self.pixels, "pixel"))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(json!({"region": self.region}), json!({"pixels": self.pixels}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { region: 2, pixels: 14 }
    }
}

impl Describe for ComponentSplit {
    fn sentence(&self, names: &Names) -> String {
        format!(
            "{} of {} lie apart and become {}",
            count(self.pixels, "pixel"),
            names.region(self.region),
            names.region(self.part)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.region, "part": self.part}),
            json!({"pixels": self.pixels}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { region: 1, part: 4, pixels: 80 }
    }
}

impl Describe for Renumbered {
    fn sentence(&self, _names: &Names) -> String {
        let kept = self.finals.iter().filter(|&&number| number > 0).count();
        format!("of {} hypotheses {kept} are regions, numbered by size", self.finals.len())
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(nothing(), json!({"regions": self.finals}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { finals: [2, 0, 1].into() }
    }
}
