//! The decisions of the earlier methods (sections 5.1 and 7.2).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, nothing};
use crate::describe::{Names, counted, grouped, grouped_decimals};
use crate::trace::{
    CodeInterval, ColorPeak, ColorPeaksFound, FeatureHistogram, FeatureVerdict, HistogramsSearched, PatchMade,
};
use serde_json::{Value, json};

impl Describe for HistogramsSearched {
    fn sentence(&self, names: &Names) -> String {
        let region = names.hypothesis(self.hypothesis);
        let others: Vec<String> = self
            .features
            .iter()
            .filter(|feature| feature.verdict != FeatureVerdict::Chosen)
            .map(refusal)
            .collect();
        let others = others.join("; ");
        let Some(chosen) = self.chosen() else {
            return format!("{region} ({} px) is homogeneous: {others}", grouped(self.pixels));
        };
        let cuts: Vec<String> = chosen.cuts.iter().map(ToString::to_string).collect();
        let decision = format!(
            "{region} ({} px) is split by {} at {}: score {} of {}, {} in small patches",
            grouped(self.pixels),
            chosen.feature.name(),
            cuts.join(", "),
            grouped_decimals(chosen.score.value.into(), 0),
            grouped(1000),
            counted(chosen.noise_px.unwrap_or(0), "pixel"),
        );
        if others.is_empty() { decision } else { format!("{decision}; {others}") }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let value = |feature: &FeatureHistogram| {
            json!({
                "feature": feature.feature.letter().to_string(),
                "cuts": feature.cuts,
                "score": feature.score.value,
                "noise_px": feature.noise_px,
                "verdict": feature.verdict.name(),
                "smoothed": feature.smoothed.iter().map(|&height| f64::from(height).round()).collect::<Vec<_>>(),
            })
        };
        let limits =
            |feature: &FeatureHistogram| (feature.feature.letter().to_string(), json!(feature.score.limit));
        LineObjects::new(
            json!({"region": self.hypothesis}),
            json!({
                "pixels": self.pixels,
                "chosen": self.chosen().map(|chosen| chosen.feature.letter().to_string()),
                "features": self.features.iter().map(value).collect::<Vec<_>>(),
            }),
            json!({"score": self.features.iter().map(limits).collect::<serde_json::Map<_, _>>()}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let feature = |feature, verdict| FeatureHistogram {
            feature,
            smoothed: vec![0.0; 256],
            cuts: vec![80],
            score: crate::trace::Measured::new(900.0, 700.0),
            noise_px: Some(12),
            verdict,
        };
        Self {
            hypothesis: hypothesis(1),
            pixels: 900,
            features: vec![
                feature(crate::params::Feature::Intensity, FeatureVerdict::Chosen),
                feature(crate::params::Feature::Hue, FeatureVerdict::NoValley),
            ],
        }
    }
}

/// Why a region is not split by a feature.
fn refusal(feature: &FeatureHistogram) -> String {
    let name = feature.feature.name();
    let (value, limit) = (feature.score.value, feature.score.limit);
    let noise = counted(feature.noise_px.unwrap_or(0), "pixel");
    match feature.verdict {
        FeatureVerdict::NoValley => format!("{name} has no valley"),
        FeatureVerdict::LowScore => format!("{name}: score {value:.0}, at least {limit:.0} needed"),
        FeatureVerdict::BelowBest => {
            format!("{name}: score {value:.0}, below {limit:.0}, the share of the best that is needed")
        }
        FeatureVerdict::NotTried => format!("{name}: score {value:.0}, others are better"),
        FeatureVerdict::TooNoisy => format!("{name} leaves {noise} in small patches, too many"),
        FeatureVerdict::OnePatch => format!("{name} makes a single patch"),
        FeatureVerdict::Noisier => {
            format!("{name} leaves {noise} in small patches, no fewer than the chosen one")
        }
        FeatureVerdict::Chosen => format!("{name} is chosen"),
    }
}

impl Describe for PatchMade {
    fn sentence(&self, names: &Names) -> String {
        let of = self.of.map_or_else(|| "the picture".to_owned(), |of| names.hypothesis(of));
        let codes =
            self.interval.map_or_else(String::new, |interval| format!(", {}", interval_text(interval)));
        let absorbed = if self.absorbed == 0 {
            String::new()
        } else {
            format!(", {} of small patches absorbed", counted(self.absorbed, "pixel"))
        };
        format!(
            "{} is a part of {of}: {}{codes}{absorbed}",
            names.hypothesis(self.hypothesis),
            counted(self.pixels, "pixel")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let interval = self.interval.map(|CodeInterval { feature, low, high }| {
            json!({"feature": feature.letter().to_string(), "low": low, "high": high})
        });
        LineObjects::new(
            json!({"region": self.of, "part": self.hypothesis}),
            json!({"pixels": self.pixels, "absorbed": self.absorbed, "interval": interval}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            hypothesis: hypothesis(2),
            of: Some(hypothesis(1)),
            pixels: 450,
            absorbed: 3,
            interval: Some(CodeInterval { feature: crate::params::Feature::Hue, low: 80, high: 255 }),
        }
    }
}

/// The codes of a feature in words.
pub(in crate::describe) fn interval_text(interval: CodeInterval) -> String {
    format!("{} from {} to {}", interval.feature.name(), interval.low, interval.high)
}

impl Describe for ColorPeaksFound {
    fn sentence(&self, _names: &Names) -> String {
        format!(
            "the histogram of the picture ({}) has {} with at least {} px; {} absorbed",
            counted(self.pixels, "pixel"),
            counted(self.peaks.len(), "peak"),
            grouped(self.least),
            counted(self.absorbed, "smaller one"),
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let peak = |peak: &ColorPeak| -> Value { json!({"color": peak.color, "pixels": peak.pixels}) };
        LineObjects::new(
            nothing(),
            json!({
                "pixels": self.pixels,
                "bin": self.bin_counts,
                "absorbed": self.absorbed,
                "peaks": self.peaks.iter().map(peak).collect::<Vec<_>>(),
            }),
            json!({"pixels": self.least}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            bin_counts: 8.0,
            pixels: 900,
            absorbed: 4,
            least: 9,
            peaks: vec![ColorPeak { color: [60.0, 20.0, 12.0], pixels: 500 }],
        }
    }
}
