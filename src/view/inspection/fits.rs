//! The figures by which a region was judged (section 6), with their limits.

use super::ThresholdTest;
use crate::intrinsic::RegionReflection;
use crate::trace::{Event, Measured, Trace, VectorsFitted};

/// The tests of a region: from the recorded decision, otherwise the distance from the plane alone.
pub(super) fn region_tests(region: &RegionReflection, trace: Option<&Trace>) -> Vec<ThresholdTest> {
    let fitted = trace.and_then(|trace| {
        trace.events().rev().find_map(|(_, event)| match event {
            Event::VectorsFitted(fitted) if fitted.region == region.id => Some(fitted),
            _ => None,
        })
    });
    match fitted {
        Some(fitted) => fit_tests(fitted),
        None => vec![distance(Measured::new(region.fit_rms_counts, region.fit_limit_counts))],
    }
}

/// The tests of a recorded fit.
pub(super) fn fit_tests(fitted: &VectorsFitted) -> Vec<ThresholdTest> {
    let VectorsFitted { figures, limits, .. } = fitted;
    let highlights = figures.highlights.map(|highlights| {
        ThresholdTest::at_least(
            "highlights",
            Measured::new(highlights, limits.highlights),
            "",
            "Mean probability that what the plane takes for surface reflection is a highlight and no print (section 7.5).",
        )
    });
    let mut tests = vec![
        distance(Measured::new(figures.rms_counts, limits.rms_counts)),
        ThresholdTest::at_most(
            "body against surface",
            Measured::new(figures.texture, limits.texture),
            "",
            "Anticorrelation of body and surface reflection from pixel to pixel: 1 for a print (section 7.5).",
        ),
        ThresholdTest::at_most(
            "body lost per surface",
            Measured::new(figures.texture_slope, limits.texture_slope),
            "",
            "Body reflection lost per surface reflection gained; a print exceeds this and the anticorrelation (section 7.5).",
        ),
        ThresholdTest::at_most(
            "light",
            Measured::new(figures.light_share, limits.light_share),
            "of the angle",
            "Interval of the light as a share of the angle between body and surface vector: beyond 1 both are one color as far as is known (section 7.5).",
        ),
        ThresholdTest::at_most(
            "new edges",
            Measured::new(100.0 * figures.new_edges, 100.0 * limits.new_edges),
            "%",
            "Share of the border at which the split makes an edge that the photograph does not have (section 3).",
        ),
    ];
    tests.extend(highlights);
    tests
}

fn distance(measured: Measured<f64>) -> ThresholdTest {
    let tip = "Root mean square distance of its pixels from the plane, against what noise and coding explain (section 6).";
    ThresholdTest::at_most("rms from the plane", measured, "counts", tip)
}
