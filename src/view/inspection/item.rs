//! The findings about an item of a result: a pixel, a region, a window or a color, and about marked pixels.

use super::fits::region_tests;
use super::step::{holds_verdict, window_tests};
use super::{Inspection, ThresholdTest, Tone};
use crate::color::vec3;
use crate::describe::{counted, grouped, grouped_sentences, reason_label, reason_meaning};
use crate::intrinsic::Reason;
use crate::params::Baseline;
use crate::raster::{Mask, PixelIndex, RegionId, UNASSIGNED};
use crate::trace::{Class, Event, Measured};
use crate::view::shapes::hypothesis;
use crate::view::{Item, OwnersAtCursor, PixelAmounts, ResultSnapshot, reason_entry};

/// The findings about an item; none where the result has no such item.
pub fn inspect_item(shown: &ResultSnapshot, item: Item) -> Option<Inspection> {
    match item {
        Item::Pixel(pixel) => of_pixel(shown, pixel),
        Item::Region(region) => of_region(shown, region),
        Item::Window(window) => of_window(shown, window),
        Item::Bin(bin) => of_bin(shown, bin),
    }
}

fn of_pixel(shown: &ResultSnapshot, pixel: PixelIndex) -> Option<Inspection> {
    let analysis = &shown.analysis;
    let color = *shown.picture.photo.image.pixels.as_slice().get(pixel.index())?;
    let [x, y] = pixel.position(shown.picture.size().0);
    let subject = format!("Pixel {x}, {y}");
    if let Some(found) = left_out(shown, pixel, &subject) {
        return Some(found);
    }
    let reason = *analysis.intrinsic.reasons.as_slice().get(pixel.index())?;
    let label = *shown.labels().as_slice().get(pixel.index())?;
    let region = RegionId::from_label(label).filter(|id| id.index() < analysis.intrinsic.regions.len());
    let kind = analysis.intrinsic.kinds.as_slice().get(pixel.index())?.name();
    let amounts = PixelAmounts::of(shown, pixel);
    let mut tests = mask_tests(color, analysis.used.min_intensity, analysis.used.clip_threshold).to_vec();
    // A method that finds regions alone has no cylinders.
    let has_cylinders = !shown.params.baseline().is_some_and(Baseline::finds_regions_alone);
    if let Some(found) = region.filter(|_| has_cylinders).and_then(|region| hypothesis(shown, region)) {
        let distance = found.matte.distance(&vec3(color));
        tests.push(ThresholdTest::at_most(
            "from the matte line",
            Measured::new(distance, analysis.used.radius_counts()),
            "counts",
            "Distance of the color from the matte line, against the radius of the cylinder: beyond it, the color is no matte pixel (section 5.3.2).",
        ));
        if let Some(amounts) = amounts.filter(|amounts| amounts.result.surface.is_some()) {
            let off =
                f64::from(amounts.measured.map_or(amounts.result.noise, |measured| measured.noise).abs());
            tests.push(ThresholdTest::at_most(
                "from the plane",
                Measured::new(off, analysis.used.slice_half_width_counts()),
                "counts",
                "Distance of the color from the dichromatic plane, against half the slice's thickness (section 5.4.2).",
            ));
        }
    }
    let (verdict, tone, sentence) = match (reason_entry(reason), region) {
        (None, Some(region)) => {
            ("Explained".to_owned(), Tone::Good, format!("{kind} pixel of region {region}"))
        }
        (None, None) => ("In no region".to_owned(), Tone::Neutral, String::new()),
        (Some(entry), region) => {
            let of = region.map_or_else(String::new, |region| format!("region {region}, {kind}; "));
            (format!("Not explained: {}", entry.name), Tone::Bad, format!("{of}{}", entry.tooltip))
        }
    };
    let of_region = region.and_then(|region| failed_region(shown, region));
    Some(Inspection { subject, verdict, tone, sentence, tests, of_region, section: "6" })
}

/// The findings about a pixel that the analysis leaves out from its first stage on; none where it does not.
pub(super) fn left_out(shown: &ResultSnapshot, pixel: PixelIndex, subject: &str) -> Option<Inspection> {
    let reason = *shown.analysis.intrinsic.reasons.as_slice().get(pixel.index())?;
    matches!(reason, Reason::OutsideArea | Reason::NoValue | Reason::ClippedObject).then(|| Inspection {
        subject: subject.to_owned(),
        verdict: format!("Left out: {}", reason_label(reason)),
        tone: Tone::Neutral,
        sentence: format!("{}; the pixel stays as it is", reason_meaning(reason)),
        tests: Vec::new(),
        of_region: None,
        section: "4",
    })
}

/// A region that does not hold, with its values and limits; none where it holds or nobody asks.
fn failed_region(shown: &ResultSnapshot, id: RegionId) -> Option<(RegionId, Vec<ThresholdTest>)> {
    let region = shown.analysis.intrinsic.regions.get(id.index())?;
    let is_judged = shown.params.refinements().region_holds;
    let fails = is_judged && !region.model_fits();
    fails.then(|| (id, region_tests(region, shown.trace().map(|trace| &**trace))))
}

/// The tests of the masks (section 4): brightness, and the largest band.
fn mask_tests(color: [f32; 3], least: f64, clip: f64) -> [ThresholdTest; 2] {
    let brightness = vec3(color).norm();
    let largest = color.iter().fold(f64::NEG_INFINITY, |most, &band| most.max(f64::from(band)));
    [
        ThresholdTest::at_least(
            "from black",
            Measured::new(brightness, least),
            "counts",
            "Distance of the color from black: nearer colors are mostly noise and not analyzed (section 4).",
        ),
        ThresholdTest {
            passed: largest < clip,
            ..ThresholdTest::at_most(
                "largest band",
                Measured::new(largest, clip),
                "counts",
                "A pixel with a band at the clipping threshold is not believed (section 4).",
            )
        },
    ]
}

fn of_region(shown: &ResultSnapshot, id: RegionId) -> Option<Inspection> {
    let region = shown.analysis.intrinsic.regions.get(id.index())?;
    let is_judged = shown.params.refinements().region_holds;
    let tests =
        if is_judged { region_tests(region, shown.trace().map(|trace| &**trace)) } else { Vec::new() };
    let (verdict, tone) = holds_verdict(is_judged, region.model_fits());
    let angle = region.angle_deg.map_or_else(
        || "no dichromatic plane".to_owned(),
        |angle| format!("{angle:.1}\u{b0} between body and surface vector"),
    );
    // Without a highlight line the other pixels are no highlights.
    let others = if region.surface.is_some() { "highlight or clipped" } else { "clipped or bloomed" };
    // The first warning of a region that the model does not fit says why.
    let why =
        grouped_sentences(&region.warnings).into_iter().next().filter(|_| is_judged && !region.model_fits());
    let why = why.map_or_else(String::new, |why| format!("{why}. "));
    let sentence = format!(
        "{why}{}, {} of them matte and {} {others}; {angle}; confidence {:.2}",
        counted(region.pixels, "pixel"),
        grouped(region.matte_pixels),
        grouped(region.highlight_pixels),
        region.confidence
    );
    Some(Inspection {
        subject: format!("Region {id}"),
        verdict,
        tone,
        sentence,
        tests,
        of_region: None,
        section: "6",
    })
}

fn of_window(shown: &ResultSnapshot, window: u32) -> Option<Inspection> {
    let class = *shown.classes().as_slice().get(window as usize)?;
    let classified = shown.trace().and_then(|trace| {
        trace.events().find_map(|(_, event)| match event {
            Event::WindowClassified(found) if found.window == window => Some(found),
            _ => None,
        })
    });
    Some(Inspection {
        subject: format!("Window {}", window + 1),
        verdict: class.map_or("No class", Class::name).to_owned(),
        tone: Tone::Neutral,
        sentence: "by the number of directions in which its colors vary beyond the noise".to_owned(),
        tests: classified.map_or_else(Vec::new, |found| window_tests(found, None)),
        of_region: None,
        section: "5.2.1",
    })
}

fn of_bin(shown: &ResultSnapshot, bin: u32) -> Option<Inspection> {
    let found = shown.picture.histogram.bins.get(bin as usize)?;
    let tests = mask_tests(found.mean, shown.analysis.used.min_intensity, shown.analysis.used.clip_threshold);
    let [r, g, b] = found.mean;
    Some(Inspection {
        subject: format!("Color {r:.0} {g:.0} {b:.0}"),
        verdict: counted(found.count, "pixel"),
        tone: Tone::Neutral,
        sentence: "of this color, within a 64th of full scale in each band".to_owned(),
        tests: tests.to_vec(),
        of_region: None,
        section: "4",
    })
}

/// The findings about marked pixels; none where no pixel of the picture is marked. `cursor`: the owners at the debugger's cursor, where
/// that is followed.
pub fn inspect_marked(
    shown: &ResultSnapshot,
    mask: &Mask,
    cursor: Option<&OwnersAtCursor>,
) -> Option<Inspection> {
    let found = crate::view::statistics(shown, mask, cursor)?;
    let class = found.class.map_or("of no class", Class::name);
    let share = |n: usize| 100.0 * n as f64 / found.pixels.max(1) as f64;
    let kind = found.owner_kind.name();
    let owners = found.owners.iter().take(3).map(|&(label, n)| match label {
        UNASSIGNED => format!("no {kind} {:.0} %", share(n)),
        _ => format!("{kind} {label} {:.0} %", share(n)),
    });
    let owners = owners.collect::<Vec<_>>().join(", ");
    let most = |name, n: usize, tip| ThresholdTest::at_most(name, Measured::new(share(n), 50.0), "%", tip);
    Some(Inspection {
        subject: "Marked pixels".to_owned(),
        verdict: class.to_owned(),
        tone: Tone::Neutral,
        sentence: format!("{}: {owners}", counted(found.pixels, "pixel")),
        tests: vec![
            most(
                "clipped",
                found.clipped,
                "Share of the pixels with a clipped band: a majority has little color to go by (section 4).",
            ),
            most("dark", found.dark, "Share of the pixels that are not analyzed (section 4)."),
        ],
        of_region: None,
        section: "5.2.1",
    })
}
