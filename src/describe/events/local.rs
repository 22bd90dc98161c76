//! The local split, where no region explains the pixels (beyond section 6).

use super::{Describe, LineObjects, nothing};
use crate::describe::Names;
use crate::describe::names::short;
use crate::describe::names::{count, percent, tenths};
use crate::trace::{
    BlobJudged, BlobsCounted, LocalBegan, LocalStart, PlausibilityTested, RejectReason, RepairTried,
    RepairVerdict,
};
use serde_json::json;

impl Describe for LocalBegan {
    fn sentence(&self, _names: &Names) -> String {
        let Self { start, pixels, lit, least, .. } = self;
        let outside = format!("{pixels} of {} lie outside of what holds", count(*lit, "lit pixel"));
        match start {
            LocalStart::Begins => {
                format!("{outside}: they are split by how much paler they are than their hue around them")
            }
            LocalStart::Off if *pixels == 0 => outside,
            LocalStart::Off => format!("{outside}: they keep their colors, as the local split is off"),
            LocalStart::Few => format!("{outside}, fewer than {least}: they keep their colors"),
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
                "origin": self.origin,
                "texture_test": self.texture_test,
                "hysteresis": self.hysteresis,
                "clip_repair": self.clip_repair,
            }),
            json!({
                "pixels": self.least,
                "mean": short(limits.mean),
                "chroma": short(limits.chroma),
                "texture": limits.texture.ends().map(short),
                "core_texture": short(limits.core_texture),
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
            origin: [0.0; 3],
            limits: crate::trace::LocalLimits::default(),
            texture_test: true,
            hysteresis: true,
            clip_repair: true,
        }
    }
}

impl Describe for BlobsCounted {
    fn sentence(&self, _names: &Names) -> String {
        format!(
            "{}, of which {} have fewer than {} pixels ({} in all) and are none",
            count(self.found, "candidate highlight"),
            self.small,
            self.least,
            self.small_pixels
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"found": self.found, "small": self.small, "small_pixels": self.small_pixels}),
            json!({"pixels": self.least}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { found: 12, small: 7, small_pixels: 20, least: 8 }
    }
}

impl Describe for BlobJudged {
    fn sentence(&self, names: &Names) -> String {
        let Self { pixel, pixels, clipped, strong, calm, core, kept, .. } = *self;
        let blob = format!("the candidate highlight of {} at {}", count(pixels, "pixel"), names.pixel(pixel));
        match (kept, core, clipped) {
            (true, 0, _) => {
                format!("{blob} passes: it has no strong core, but {} in it", count(clipped, "clipped pixel"))
            }
            (true, ..) => {
                format!("{blob} passes: {core} of them are a strong core, paler than their hue varies")
            }
            _ if strong == 0 => {
                format!("{blob} fails: no pixel of it is paler than its hue varies")
            }
            _ if calm == 0 => format!(
                "{blob} fails: {strong} of them are paler than their hue varies, but all these look like texture"
            ),
            _ => format!(
                "{blob} fails: {calm} of them are paler than their hue varies and no texture, but nowhere do 3 \u{d7} 3 \
                 of these lie together"
            ),
        }
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"blob": self.blob, "pixel": names.position(self.pixel)}),
            json!({
                "pixels": self.pixels,
                "clipped": self.clipped,
                "strong": self.strong,
                "calm": self.calm,
                "core": self.core,
                "kept": self.kept,
            }),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            blob: 3,
            pixel: crate::raster::PixelIndex::new(23),
            pixels: 60,
            clipped: 0,
            strong: 30,
            calm: 20,
            core: 9,
            kept: true,
        }
    }
}

impl Describe for PlausibilityTested {
    fn sentence(&self, _names: &Names) -> String {
        let Self { share, surface, outshining, limits, reject_reason } = self;
        let light = share.map(|share| {
            format!("{} of the votes are for the light (at least {})", tenths(share), tenths(limits.share))
        });
        let amount = surface.map(|share| {
            format!(
                "{} of the light there would be surface reflection (at most {})",
                tenths(share),
                percent(limits.surface)
            )
        });
        let bright = outshining.map(|(share, strong)| {
            format!(
                "{} of {} outshine the body under them (at most {})",
                percent(share),
                count(strong, "strong highlight pixel"),
                percent(limits.outshining)
            )
        });
        let failed = match reject_reason {
            None => {
                let found: Vec<String> = [light, amount, bright].into_iter().flatten().collect();
                return format!("highlights are believed: {}", found.join("; "));
            }
            Some(RejectReason::NoVote) => light,
            Some(RejectReason::TooMuch) => amount,
            Some(RejectReason::Outshining) => bright,
        };
        format!("no highlight is believed, nothing is split locally: {}", failed.unwrap_or_default())
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let limits = self.limits;
        LineObjects::new(
            nothing(),
            json!({
                "share": self.share,
                "surface": self.surface,
                "outshining": self.outshining.map(|(share, _)| share),
                "strong": self.outshining.map(|(_, strong)| strong),
                "doubt": self.reject_reason.map(RejectReason::name),
            }),
            json!({
                "share": limits.share,
                "surface": limits.surface,
                "outshining": limits.outshining,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            share: Some(0.01),
            surface: None,
            outshining: None,
            limits: crate::trace::PlausibilityLimits { share: 0.02, surface: 0.25, outshining: 0.5 },
            reject_reason: Some(RejectReason::NoVote),
        }
    }
}

impl Describe for RepairTried {
    fn sentence(&self, names: &Names) -> String {
        let Self { pixel, pixels, ring, inner, outer, verdict, .. } = *self;
        let blob = format!("the blob of {} at {}", count(pixels, "clipped pixel"), names.pixel(pixel));
        let [share, least] = [ring.value, ring.limit].map(|share| percent(f64::from(share)));
        match verdict {
            RepairVerdict::Filled => format!(
                "{blob} is filled with the body around it: {share} of its ring of 2 px are highlight (at least {least}), {inner:.1} \
                 counts next to it, {outer:.1} farther out"
            ),
            RepairVerdict::TooLarge => format!("{blob} is left: it is as large as a window or the sky"),
            RepairVerdict::NoRing => format!("{blob} is left: no ring of unclipped pixels lies around it"),
            RepairVerdict::NoHighlight => format!(
                "{blob} is left: {share} of its ring of 2 px are highlight, at least {least} are needed"
            ),
            RepairVerdict::NoRise => format!(
                "{blob} is left: the highlight does not rise towards it, {inner:.1} counts next to it, {outer:.1} farther out"
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
                "verdict": self.verdict.name(),
            }),
            json!({"ring": short(self.ring.limit)}),
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
            verdict: RepairVerdict::Filled,
        }
    }
}
