//! The local split, where no region explains the pixels (beyond section 6).

use super::{Describe, LineObjects, nothing};
use crate::describe::names::short;
use crate::describe::names::{percent, signed, tenths};
use crate::describe::{Names, counted, grouped, grouped_decimals};
use crate::trace::{
    LocalBegan, LocalStart, PictureOddsFound, PlausibilityTested, RepairTried, RepairVerdict,
};
use serde_json::json;

impl Describe for LocalBegan {
    fn sentence(&self, _names: &Names) -> String {
        let Self { start, pixels, lit, least, .. } = self;
        let all = counted(*lit, "lit pixel");
        let outside = format!("{} of {all} lie outside of what holds", grouped(*pixels));
        match start {
            LocalStart::Begins => {
                format!("{outside}: they are split by how much paler they are than their hue around them")
            }
            LocalStart::Off if *pixels == 0 => outside,
            LocalStart::Off => format!("{outside}: they keep their colors, as the local split is off"),
            LocalStart::Few => {
                format!("{outside}, fewer than {}: they keep their colors", grouped(*least))
            }
            LocalStart::NoLight => format!("{outside}: they keep their colors, as the light is not known"),
        }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let start = match self.start {
            LocalStart::Begins => "begins",
            LocalStart::Off => "off",
            LocalStart::Few => "few",
            LocalStart::NoLight => "no_light",
        };
        let limits = self.limits;
        LineObjects::new(
            nothing(),
            json!({
                "start": start,
                "pixels": self.pixels,
                "lit": self.lit,
                "light": self.light,
                "second_light": self.second_light,
                "origin": self.origin,
                "highlight_evidence": self.highlight_evidence,
                "guided_amount": self.guided_amount,
                "clip_repair": self.clip_repair,
            }),
            json!({
                "pixels": self.least,
                "mean": short(limits.mean),
                "chroma": short(limits.chroma),
                "log_odds": [short(limits.odds.start), short(limits.odds.end)],
                "ratio": [short(limits.ratio.start), short(limits.ratio.end)],
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            start: LocalStart::Begins,
            pixels: 900,
            lit: 4000,
            least: 200,
            light: Some([0.6, 0.0, 0.8]),
            second_light: None,
            origin: [0.0; 3],
            limits: crate::trace::LocalLimits::default(),
            highlight_evidence: true,
            guided_amount: true,
            clip_repair: true,
        }
    }
}

impl Describe for PictureOddsFound {
    fn sentence(&self, _names: &Names) -> String {
        let Self { pixels, log_odds, .. } = *self;
        let most = if log_odds > 0.0 { "highlight" } else { "print" };
        format!(
            "of {} paler than their hue most is {most}: {} is added to the log odds of each pixel",
            counted(pixels, "pixel"),
            signed(log_odds, 1)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"pixels": self.pixels, "log_odds": short(self.log_odds)}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { pixels: 600, log_odds: 1.5 }
    }
}

impl Describe for PlausibilityTested {
    fn sentence(&self, _names: &Names) -> String {
        let Some(share) = self.share else {
            return "highlights are believed: the light needs no votes".to_owned();
        };
        let votes = format!(
            "{} of the votes are for the light (at least {})",
            tenths(share),
            tenths(self.least_share)
        );
        if self.plausible() {
            format!("highlights are believed: {votes}")
        } else {
            format!("no highlight is believed, nothing is split locally: {votes}")
        }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"share": self.share, "plausible": self.plausible()}),
            json!({"share": self.least_share}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { share: Some(0.01), least_share: 0.02 }
    }
}

impl Describe for RepairTried {
    fn sentence(&self, names: &Names) -> String {
        let Self { pixel, pixels, ring, inner, outer, spread, around, verdict, .. } = *self;
        let blob = format!("the blob of {} at {}", counted(pixels, "clipped pixel"), names.pixel(pixel));
        let [share, least] = [ring.value, ring.limit].map(|share| percent(f64::from(share)));
        match verdict {
            RepairVerdict::Filled => format!(
                "{blob} is filled with the body around it: {share} of its ring of 2 px are highlight (at least {least}), {inner:.1} \
                 counts next to it, {outer:.1} farther out"
            ),
            RepairVerdict::TooLarge => format!("{blob} is not filled: it is as large as a window or the sky"),
            RepairVerdict::NoRing => {
                format!("{blob} is not filled: no ring of unclipped pixels lies around it")
            }
            RepairVerdict::NoHighlight => format!(
                "{blob} is not filled: {share} of its ring of 2 px are highlight, at least {least} are needed"
            ),
            RepairVerdict::Uneven => format!(
                "{blob} is not filled: the body around it varies by {} of its mean (at most {}), so that it is of several materials",
                percent(f64::from(spread.value)),
                percent(f64::from(spread.limit))
            ),
            RepairVerdict::TooSmall => format!(
                "{blob} is not filled: {} highlight pixels lie around it, at least {} are needed",
                grouped_decimals(around.value.into(), 0),
                grouped_decimals(around.limit.into(), 0)
            ),
            RepairVerdict::NoRise => format!(
                "{blob} is not filled: the highlight does not rise towards it, {inner:.1} counts next to it, {outer:.1} farther out"
            ),
        }
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"blob": self.blob, "pixel": names.position(self.pixel)}),
            json!({
                "pixels": self.pixels,
                "ring": short(self.ring.value),
                "inner": short(self.inner),
                "outer": short(self.outer),
                "spread": short(self.spread.value),
                "around": short(self.around.value),
                "verdict": self.verdict.name(),
            }),
            json!({
                "ring": short(self.ring.limit),
                "spread": short(self.spread.limit),
                "around": short(self.around.limit),
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            blob: 4,
            pixel: crate::raster::PixelIndex::new(23),
            pixels: 12,
            ring: crate::trace::Measured::new(0.75, 0.5),
            inner: 40.0,
            outer: 20.0,
            spread: crate::trace::Measured::new(0.25, 0.5),
            around: crate::trace::Measured::new(20.0, 6.0),
            verdict: RepairVerdict::Filled,
        }
    }
}
