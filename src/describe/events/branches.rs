//! Highlight branches (section 7.4).

use super::{Describe, LineObjects};
use crate::describe::Names;
use crate::describe::names::short;
use crate::trace::{BranchesSought, HighlightCore, Measured};
use serde_json::{Value, json};

impl Describe for BranchesSought {
    fn sentence(&self, _names: &Names) -> String {
        let cores = self.cores.iter().map(|core| format!("{:.0} \u{b1} {:.0}", core.body, core.deviation));
        let cores: Vec<String> = cores.collect();
        let gap = |&Measured { value: difference, limit }: &Measured<f32>| {
            let relation = if difference > limit { '>' } else { '\u{2264}' };
            format!("{difference:.0} {relation} {limit:.0}")
        };
        let gaps: Vec<String> = self.gaps.iter().map(gap).collect();
        let apart = if gaps.is_empty() { String::new() } else { format!(", apart {}", gaps.join(", ")) };
        format!(
            "region {}: m_b under its {} {} counts{apart}: {}",
            self.region,
            if cores.len() == 1 { "highlight is" } else { "highlights is" },
            cores.join(", "),
            match self.branches() {
                1 => "one highlight branch".to_owned(),
                n => format!("{n} highlight branches"),
            }
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let core = |core: &HighlightCore| {
            json!({
                "body": short(core.body),
                "deviation": short(core.deviation),
                "surface": short(core.surface),
                "pixels": core.pixels,
                "span": core.span_px,
                "branch": core.branch + 1,
            })
        };
        let cores: Vec<Value> = self.cores.iter().map(core).collect();
        let differences: Vec<Value> = self.gaps.iter().map(|gap| short(gap.value)).collect();
        let limits: Vec<Value> = self.gaps.iter().map(|gap| short(gap.limit)).collect();
        LineObjects::new(
            json!({"final": self.region}),
            json!({"branches": self.branches(), "cores": cores, "differences": differences}),
            json!({"differences": limits}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let core = |body, branch| HighlightCore {
            body,
            deviation: 4.0,
            surface: 60.0,
            pixels: 30,
            span_px: [1, 2, 8, 9],
            branch,
        };
        let gaps = vec![Measured::new(40.0, 15.0)];
        Self {
            region: crate::raster::RegionId::from_index(0),
            cores: vec![core(80.0, 1), core(120.0, 0)],
            gaps,
        }
    }
}
