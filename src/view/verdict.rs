//! The verdict on a result: one sentence of clauses, each about something that can be shown.

use super::{Layer, ResultSnapshot};
use crate::describe::counted;
use crate::intrinsic::{RegionReflection, RegionVerdict};
use crate::params::Baseline;
use crate::raster::RegionId;
use crate::segment::{LightBasis, LightFindings};

/// Half the interval of the light's direction from which the light counts as uncertain, degrees.
pub const WIDE_INTERVAL_DEG: f64 = 10.0;

/// What a clause is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClauseSubject {
    /// All regions.
    Regions,
    /// One region.
    Region(RegionId),
    /// The light.
    Light,
    /// The pixels of a layer.
    Layer(Layer),
}

/// A part of the verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clause {
    /// The part of the sentence.
    pub text: String,
    /// What the part is about.
    pub subject: ClauseSubject,
    /// Whether the part says that something is bad.
    pub is_bad: bool,
}

/// The verdict on a result. Its clauses, joined by semicolons, are a sentence.
pub fn verdict(shown: &ResultSnapshot) -> Vec<Clause> {
    let regions = &shown.analysis.intrinsic.regions;
    if regions.is_empty() {
        let reason = shown.analysis.warnings.first();
        let text = reason.map_or_else(|| "no region was found".to_owned(), ToString::to_string);
        return vec![Clause { text, subject: ClauseSubject::Layer(Layer::Classes), is_bad: true }];
    }
    let misfits: Vec<&RegionReflection> = regions.iter().filter(|region| !region.model_fits()).collect();
    let is_asked = shown.params.refinements().region_holds;
    let text = if is_asked { fitting_text(regions.len(), misfits.len()) } else { number_text(regions.len()) };
    let mut clauses =
        vec![Clause { text, subject: ClauseSubject::Regions, is_bad: 2 * misfits.len() > regions.len() }];
    clauses.extend(misfit_clause(&misfits));
    clauses.push(light_clause(shown));
    clauses.extend(score_clause(shown));
    clauses
}

/// How many regions there are, where whether they fit the model is not asked.
fn number_text(regions: usize) -> String {
    if regions == 1 { "one region was found".to_owned() } else { format!("{regions} regions were found") }
}

/// How many of the regions fit the model.
fn fitting_text(regions: usize, misfits: usize) -> String {
    match (regions, misfits) {
        (1, 0) => "the only region fits".to_owned(),
        (1, _) => "the only region does not fit".to_owned(),
        (2, 0) => "both regions fit".to_owned(),
        (2, 2) => "neither region fits".to_owned(),
        (_, 0) => format!("all {regions} regions fit"),
        _ if misfits == regions => format!("none of {regions} regions fits"),
        _ if regions - misfits == 1 => format!("1 of {regions} regions fits"),
        _ => format!("{} of {regions} regions fit", regions - misfits),
    }
}

/// Why a region does not fit, as a phrase; none of a region that fits.
fn misfit_phrase(region: &RegionReflection) -> Option<String> {
    let phrase = match region.verdict {
        RegionVerdict::ColorOfLight => "its color is the light's as far as is known",
        RegionVerdict::Texture => "a print",
        RegionVerdict::NewEdges => "only a part of an object",
        RegionVerdict::NoHighlights => "a print or another color",
        RegionVerdict::OffPlane => {
            return Some(format!("its colors lie {:.1} counts off its plane", region.fit_rms_counts));
        }
        RegionVerdict::Fits => return None,
    };
    Some(phrase.to_owned())
}

/// What is the matter with the regions that do not fit; none where all fit. The clause is about the largest of them.
fn misfit_clause(misfits: &[&RegionReflection]) -> Option<Clause> {
    let largest = misfits.iter().max_by_key(|region| region.pixels)?;
    let with = |verdict| misfits.iter().filter(|region| region.verdict == verdict).count();
    let prints = with(RegionVerdict::Texture);
    let text = match (misfits.len(), prints) {
        (1, _) => format!("region {} is split locally: {}", largest.id, misfit_phrase(largest)?),
        (all, 0) if with(RegionVerdict::OffPlane) == all => {
            format!("{all} are split locally: their colors lie off their planes")
        }
        (all, 0) => format!("{all} are split locally"),
        (all, prints) if all == prints => format!("{all} are split locally: prints"),
        (all, 1) => format!("{all} are split locally, 1 of them a print"),
        (all, prints) => format!("{all} are split locally, {prints} of them prints"),
    };
    Some(Clause { text, subject: ClauseSubject::Region(largest.id), is_bad: true })
}

/// What the light's color was found by, and how well.
fn light_clause(shown: &ResultSnapshot) -> Clause {
    let findings = &shown.analysis.finals.light;
    let subject = ClauseSubject::Light;
    let Some(light) = &shown.analysis.illuminant else {
        let is_sought = findings.basis != LightBasis::NotSought;
        let text = match findings.basis {
            LightBasis::NotSought => "the method seeks no light, and all is body reflection",
            LightBasis::ByHand => "the light's color is unknown: the marked pixels have no skewed T",
            LightBasis::Nothing if findings.planes.is_some() || findings.votes.is_some() => {
                "the light's color is unknown: neither planes nor small highlights agree on a usual one"
            }
            _ => "the light's color is unknown: no highlight was found",
        };
        return Clause { text: text.to_owned(), subject, is_bad: is_sought };
    };
    let from = |what: &str| counted(light.objects, what);
    let text = match findings.basis {
        LightBasis::Given => "the light's color was given".to_owned(),
        LightBasis::Average => {
            format!("the light is the average of {}", from("highlight direction"))
        }
        LightBasis::ByHand => "the light is the highlight line of the marked pixels".to_owned(),
        LightBasis::Votes => format!("the light comes from {}", from("small highlight")),
        LightBasis::Planes | LightBasis::Nothing | LightBasis::NotSought => {
            format!("the light comes from {}", from("plane"))
        }
    };
    let interval = findings
        .claimed_interval_deg()
        .map_or_else(String::new, |degrees| format!(", \u{b1}{degrees:.1}\u{b0}"));
    let is_bad = findings.claimed_interval_deg().is_some_and(|degrees| degrees >= WIDE_INTERVAL_DEG);
    let second = second_lamp_words(findings).unwrap_or_default();
    Clause { text: format!("{text}{interval}{second}"), subject, is_bad }
}

/// What the second lamp does, as the end of a clause; none with one lamp.
fn second_lamp_words(findings: &LightFindings) -> Option<String> {
    let (second, degrees) = (findings.second?, findings.lamps_angle_deg()?);
    let given = if second.given { ", given" } else { "" };
    let lights = if second.given && second.regions == 0 { "no region" } else { "a part of the scene" };
    Some(format!("; a second lamp{given}, {degrees:.0}\u{b0} from the first, lights {lights}"))
}

/// How much nearer to the truth the body image is than the photograph, where the truth is known and the method has a body image of its
/// own.
fn score_clause(shown: &ResultSnapshot) -> Option<Clause> {
    if shown.params.baseline().is_some_and(Baseline::finds_regions_alone) {
        return None;
    }
    let scores = &shown.accuracy()?.scores;
    let gain = scores.psnr_body? - scores.psnr_nothing?;
    let text = if gain < 0.0 {
        format!("the body image is {:.1} dB worse than the photograph", -gain)
    } else {
        format!("the body image is {gain:.1} dB better than the photograph")
    };
    Some(Clause { text, subject: ClauseSubject::Layer(Layer::Body), is_bad: gain < 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_fitting_regions_is_a_clause() {
        for ((regions, misfits), text) in [
            ((1, 0), "the only region fits"),
            ((1, 1), "the only region does not fit"),
            ((8, 0), "all 8 regions fit"),
            ((2, 0), "both regions fit"),
            ((2, 2), "neither region fits"),
            ((7, 1), "6 of 7 regions fit"),
            ((2, 1), "1 of 2 regions fits"),
            ((3, 3), "none of 3 regions fits"),
        ] {
            assert_eq!(fitting_text(regions, misfits), text);
        }
    }

    #[test]
    fn regions_that_do_not_fit_are_told_with_the_reason() {
        let region = |label: u16, pixels: usize, verdict: RegionVerdict| {
            let id = RegionId::from_label(label).unwrap();
            RegionReflection { fit_rms_counts: 5.12, verdict, ..crate::view::testing::region(id, pixels) }
        };
        let print = region(4, 900, RegionVerdict::Texture);
        let rough = region(2, 400, RegionVerdict::OffPlane);
        let white = region(3, 100, RegionVerdict::ColorOfLight);
        let text = |misfits: &[&RegionReflection]| misfit_clause(misfits).map(|clause| clause.text);
        assert_eq!(text(&[]), None);
        assert_eq!(text(&[&print]).unwrap(), "region 4 is split locally: a print");
        assert_eq!(
            text(&[&rough]).unwrap(),
            "region 2 is split locally: its colors lie 5.1 counts off its plane"
        );
        let both = misfit_clause(&[&rough, &print]).unwrap();
        assert_eq!(both.text, "2 are split locally, 1 of them a print");
        assert_eq!(both.subject, ClauseSubject::Region(print.id), "the largest");
        assert_eq!(text(&[&print, &print]).unwrap(), "2 are split locally: prints");
        assert_eq!(
            text(&[&white]).unwrap(),
            "region 3 is split locally: its color is the light's as far as is known"
        );
        assert_eq!(
            text(&[&rough, &rough]).unwrap(),
            "2 are split locally: their colors lie off their planes"
        );
        assert_eq!(text(&[&white, &rough]).unwrap(), "2 are split locally", "different reasons");
    }
}
