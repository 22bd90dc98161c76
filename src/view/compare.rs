//! Two results of one photograph side by side.

use super::ResultSnapshot;
use super::compare_figures::{Figure, figures};
use super::snapshot::{best_overlaps, overlaps};
use crate::params::{Method, Parameter, Params, PhoenixParameter, Reading, Switch};
use crate::raster::RegionId;
use crate::truth::angle_deg;
use rayon::prelude::*;

/// A body reflection that differs by more than this in some band has changed, counts.
const CHANGED_COUNTS: f32 = 1.0;

/// What changed from a pinned result to the newest one.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The settings that differ.
    pub settings: Vec<SettingChange>,
    /// Figures of both results, side by side.
    pub figures: Vec<Figure>,
    /// Angle between the two illuminants, degrees; none where a result has no illuminant.
    pub illuminant_deg: Option<f64>,
    /// The fates of the regions: those of the newest result by number, then those that are lost.
    pub regions: Vec<ComparedRegion>,
    /// The fates of the pixels.
    pub pixels: PixelChanges,
    /// The change of the body reflection.
    pub body: BodyChange,
}

/// A parameter, switch or restriction that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingChange {
    /// Name of the setting.
    pub name: &'static str,
    /// In the pinned result.
    pub pinned: String,
    /// In the newest result.
    pub newest: String,
}

/// The difference between a region of one result and the same region of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionChange {
    /// The region has the same pixels.
    Kept,
    /// The region has other pixels, but is still the same region.
    Changed,
    /// The region is in the newest result only.
    Gained,
    /// The region is in the pinned result only.
    Lost,
}

/// A region of the pinned result and the same region of the newest result. Two regions are the same where each covers
/// most of the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ComparedRegion {
    /// The difference between the two.
    pub change: RegionChange,
    /// The region in the pinned result.
    pub pinned: Option<RegionId>,
    /// The region in the newest result.
    pub newest: Option<RegionId>,
    /// Number of pixels in the pinned result.
    pub pixels_pinned: usize,
    /// Number of pixels in the newest result.
    pub pixels_newest: usize,
    /// Number of pixels in both results.
    pub pixels_shared: usize,
}

/// Numbers of pixels that kept or changed their region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelChanges {
    /// Pixels in the same region, or in no region, in both results.
    pub kept: usize,
    /// Pixels in no region of the pinned result and in a region of the newest.
    pub gained: usize,
    /// Pixels in a region of the pinned result and in no region of the newest.
    pub lost: usize,
    /// Pixels in different regions.
    pub changed: usize,
}

/// The change of the body reflection: per pixel the largest difference of a band, counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyChange {
    /// Share of the pixels that changed by more than one count, 0…1.
    pub share: f64,
    /// Mean change over all pixels, counts.
    pub mean_counts: f64,
    /// Largest change of a pixel, counts.
    pub most_counts: f64,
}

/// Compares two results; none for pictures of different sizes. Takes a few passes over the picture.
pub fn compare(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> Option<Comparison> {
    if pinned.picture.size() != newest.picture.size() {
        return None;
    }
    let light = |shown: &ResultSnapshot| shown.analysis.illuminant.map(|light| light.direction);
    let (regions, pixels) = changes(pinned, newest);
    Some(Comparison {
        settings: settings(pinned, newest),
        figures: figures(pinned, newest),
        illuminant_deg: light(pinned).zip(light(newest)).map(|(a, b)| angle_deg(a, b)),
        regions,
        pixels,
        body: body_change(pinned, newest),
    })
}

/// The settings that differ between two sets of parameters.
pub fn setting_changes(before: &Params, after: &Params) -> Vec<SettingChange> {
    let mut changes = Vec::new();
    let mut add = |name, pinned: String, newest: String| {
        if pinned != newest {
            let (short_pinned, short_newest) = (shortened(&pinned), shortened(&newest));
            let is_told_apart = short_pinned != short_newest;
            let (pinned, newest) =
                if is_told_apart { (short_pinned, short_newest) } else { (pinned, newest) };
            changes.push(SettingChange { name, pinned, newest });
        }
    };
    let method = |params: &Params| params.method.name().to_owned();
    add("method", method(before), method(after));
    for parameter in Parameter::ALL {
        let asked = |params: &Params| params.get(parameter).to_string();
        add(parameter.spec().name, asked(before), asked(after));
    }
    add("illuminant", before.illuminant.to_string(), after.illuminant.to_string());
    add("second_illuminant", before.second_illuminant.to_string(), after.second_illuminant.to_string());
    add("ambient", before.ambient.to_string(), after.ambient.to_string());
    let word = |on: bool| if on { "on" } else { "off" }.to_owned();
    let (old, new) = (before.refinements(), after.refinements());
    for switch in Switch::ALL {
        add(switch.name(), word(old.get(switch)), word(new.get(switch)));
    }
    if before.method == Method::Phoenix && after.method == Method::Phoenix {
        add("features", before.phoenix.features.to_string(), after.phoenix.features.to_string());
        for parameter in PhoenixParameter::ALL {
            let value = |params: &Params| parameter.get(&params.phoenix).to_string();
            add(parameter.name(), value(before), value(after));
        }
    }
    let (old, new) = (before.rules().readings, after.rules().readings);
    if before.method == Method::Paper && after.method == Method::Paper {
        for reading in Reading::ALL {
            add(reading.name(), word(old.get(reading)), word(new.get(reading)));
        }
    }
    changes
}

/// A setting whose numbers have four digits, or all digits before the point: a light that was found has sixteen.
fn shortened(setting: &str) -> String {
    let number = |text: &str| match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value != 0.0 => {
            let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 12);
            let scale = 10_f64.powi(decimals);
            ((value * scale).round() / scale).to_string()
        }
        _ => text.to_owned(),
    };
    setting.split(',').map(number).collect::<Vec<_>>().join(", ")
}

fn settings(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> Vec<SettingChange> {
    let mut changes = setting_changes(&pinned.params, &newest.params);
    let area = |shown: &ResultSnapshot| {
        shown.area.as_ref().map_or_else(|| "all".to_owned(), |area| format!("{} px", area.count()))
    };
    let (pinned, newest) = (area(pinned), area(newest));
    if pinned != newest {
        changes.push(SettingChange { name: "area", pinned, newest });
    }
    changes
}

fn changes(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> (Vec<ComparedRegion>, PixelChanges) {
    let shared = overlaps(pinned.labels(), newest.labels());
    let (into, from) =
        (best_overlaps(pinned.labels(), newest.labels()), best_overlaps(newest.labels(), pinned.labels()));
    let sum = |covers: &[(u16, usize)]| covers.iter().map(|cover| cover.1).sum::<usize>();
    // By label: of unassigned pixels first.
    let sizes_pinned: Vec<usize> = shared.iter().map(|covers| sum(covers)).collect();
    let mut sizes_newest = vec![0; from.len()];
    for &(label, pixels) in shared.iter().flatten() {
        sizes_newest[usize::from(label)] += pixels;
    }
    let pair = |old: RegionId| into[old.index() + 1].filter(|new| from[new.index() + 1] == Some(old));
    let mut regions = Vec::new();
    for new in RegionId::all(from.len().saturating_sub(1)) {
        let pixels_newest = sizes_newest[new.index() + 1];
        if pixels_newest == 0 {
            continue;
        }
        let old = from[new.index() + 1].filter(|&old| pair(old) == Some(new));
        let pixels_pinned = old.map_or(0, |old| sizes_pinned[old.index() + 1]);
        let covers = old.map_or(&[][..], |old| &shared[old.index() + 1]);
        let pixels_shared = covers.iter().find(|cover| cover.0 == new.get()).map_or(0, |cover| cover.1);
        let change = match old {
            None => RegionChange::Gained,
            Some(_) if pixels_shared == pixels_pinned && pixels_shared == pixels_newest => RegionChange::Kept,
            Some(_) => RegionChange::Changed,
        };
        regions.push(ComparedRegion {
            change,
            pinned: old,
            newest: Some(new),
            pixels_pinned,
            pixels_newest,
            pixels_shared,
        });
    }
    let lost = RegionId::all(into.len().saturating_sub(1))
        .filter(|&old| sizes_pinned[old.index() + 1] > 0 && pair(old).is_none());
    regions.extend(lost.map(|old| ComparedRegion {
        change: RegionChange::Lost,
        pinned: Some(old),
        newest: None,
        pixels_pinned: sizes_pinned[old.index() + 1],
        pixels_newest: 0,
        pixels_shared: 0,
    }));
    let mut pixels = PixelChanges::default();
    for (old, covers) in (0u16..).zip(&shared) {
        for &(new, count) in covers {
            match (RegionId::from_label(old), RegionId::from_label(new)) {
                (None, None) => pixels.kept += count,
                (None, Some(_)) => pixels.gained += count,
                (Some(_), None) => pixels.lost += count,
                (Some(old), new) if pair(old) == new => pixels.kept += count,
                _ => pixels.changed += count,
            }
        }
    }
    (regions, pixels)
}

fn body_change(pinned: &ResultSnapshot, newest: &ResultSnapshot) -> BodyChange {
    const ROW: usize = 1 << 13;
    let (a, b) = (&pinned.analysis.intrinsic.body, &newest.analysis.intrinsic.body);
    // Chunks are added up in their order: the sum is the same with any number of threads.
    let chunks: Vec<(usize, f64, f32)> = a
        .as_slice()
        .par_chunks(ROW)
        .zip(b.as_slice().par_chunks(ROW))
        .map(|(a, b)| {
            a.iter().zip(b).fold((0, 0.0, 0.0f32), |(changed, sum, most), (a, b)| {
                let apart = (0..3).map(|band| (a[band] - b[band]).abs()).fold(0.0, f32::max);
                (changed + usize::from(apart > CHANGED_COUNTS), sum + f64::from(apart), most.max(apart))
            })
        })
        .collect();
    let pixels = a.len().max(1) as f64;
    let changed: usize = chunks.iter().map(|chunk| chunk.0).sum();
    BodyChange {
        share: changed as f64 / pixels,
        mean_counts: chunks.iter().map(|chunk| chunk.1).sum::<f64>() / pixels,
        most_counts: f64::from(chunks.iter().map(|chunk| chunk.2).fold(0.0, f32::max)),
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::intrinsic::Intrinsic;
    use crate::params::{IlluminantSetting, Params, Setting};
    use crate::segment::Illuminant;
    use crate::view::testing::{divided, gray};
    use std::sync::Arc;

    /// Regions of two results of one gray picture, as (pinned, newest, shared pixels), and the pixels' fates.
    #[track_caller]
    fn check(
        before: &[&str],
        after: &[&str],
        regions: &[(RegionChange, u16, u16, usize)],
        pixels: [usize; 4],
    ) {
        let picture = gray(before, 90);
        let found = compare(&divided(&picture, before), &divided(&picture, after)).unwrap();
        let plain = |change: &ComparedRegion| {
            (
                change.change,
                RegionId::label(change.pinned),
                RegionId::label(change.newest),
                change.pixels_shared,
            )
        };
        assert_eq!(found.regions.iter().map(plain).collect::<Vec<_>>(), regions);
        let PixelChanges { kept, gained, lost, changed } = found.pixels;
        assert_eq!([kept, gained, lost, changed], pixels);
        assert_eq!(kept + gained + lost + changed, picture.size().0 * picture.size().1);
    }

    #[test]
    fn regions_are_known_by_their_overlap_and_not_by_their_numbers() {
        let before = ["1112", "1112", "3..."];
        check(
            &before,
            &before,
            &[(RegionChange::Kept, 1, 1, 6), (RegionChange::Kept, 2, 2, 2), (RegionChange::Kept, 3, 3, 1)],
            [12, 0, 0, 0],
        );
        let after = ["2221", "2211", ".333"];
        let regions = [
            (RegionChange::Changed, 2, 1, 2),
            (RegionChange::Changed, 1, 2, 5),
            (RegionChange::Gained, 0, 3, 0),
            (RegionChange::Lost, 3, 0, 0),
        ];
        check(&before, &after, &regions, [7, 3, 1, 1]);
    }

    #[test]
    fn a_region_that_falls_apart_is_changed_and_gained() {
        let regions = [(RegionChange::Changed, 1, 1, 3), (RegionChange::Gained, 0, 2, 0)];
        check(&["11111"], &["11122"], &regions, [3, 0, 0, 2]);
    }

    #[test]
    fn settings_figures_and_bodies_that_differ_are_listed() {
        let rows = ["1122"];
        let picture = gray(&rows, 90);
        let (pinned, mut newest) = (divided(&picture, &rows), divided(&picture, &rows));
        let same = compare(&pinned, &newest).unwrap();
        assert_eq!((same.settings.len(), same.body, same.illuminant_deg), (0, BodyChange::default(), None));
        newest.params = Params { camera_noise: Setting::Value(3.0), ..newest.params };
        newest.area = Some(Arc::new(crate::raster::Raster::filled(4, 1, true)));
        let mut body = newest.analysis.intrinsic.body.clone();
        (body[0], body[3]) = ([90.0, 94.0, 89.0], [90.5, 90.0, 90.0]);
        newest.analysis.intrinsic =
            Arc::new(Intrinsic { body, ..Intrinsic::clone(&newest.analysis.intrinsic) });
        let found = compare(&pinned, &newest).unwrap();
        let plain: Vec<_> =
            found.settings.iter().map(|c| (c.name, c.pinned.as_str(), c.newest.as_str())).collect();
        assert_eq!(plain, [("camera_noise", "2.5", "3"), ("area", "all", "4 px")]);
        assert_eq!(found.body, BodyChange { share: 0.25, mean_counts: 4.5 / 4.0, most_counts: 4.0 });
        let fit = found.figures.iter().find(|figure| figure.words.name == "fit error").unwrap();
        assert_eq!((fit.pinned, fit.newest, fit.words.unit), (Some(1.5), Some(1.5), "counts"));
        assert!(compare(&pinned, &divided(&gray(&["1"], 9), &["1"])).is_none());
    }

    #[test]
    fn the_angle_between_two_lights_is_computed() {
        let picture = gray(&["11"], 90);
        let lit = |direction| {
            let mut shown = divided(&picture, &["11"]);
            shown.analysis.illuminant = Some(Illuminant { direction, objects: 1, given: false });
            shown
        };
        let found = compare(&lit([1.0, 0.0, 0.0]), &lit([0.5f64.sqrt(), 0.5f64.sqrt(), 0.0])).unwrap();
        assert!((found.illuminant_deg.unwrap() - 45.0).abs() < 1e-9);
    }

    #[test]
    fn settings_have_as_many_digits_as_can_be_read_unless_these_are_equal() {
        let given = |light| Params { illuminant: IlluminantSetting::Given(light), ..Params::default() };
        let found = given([0.583, 0.569_466_109_448_656_4, 0.000_123_456_789]);
        let told = |before: &Params, after: &Params| {
            let [change] = &setting_changes(before, after)[..] else { panic!("one setting") };
            format!("{}: {} \u{2192} {}", change.name, change.pinned, change.newest)
        };
        let text = told(&found, &Params::default());
        assert_eq!(text, "illuminant: 0.583, 0.5695, 0.0001235 \u{2192} auto");
        let nearly = given([0.583, 0.569_466_1, 0.000_123_456_789]);
        assert!(told(&found, &nearly).contains("0.5694661094486564"), "they differ");
        let area = |pixels| Params { min_area: Setting::Value(pixels), ..Params::default() };
        assert_eq!(told(&area(12345.0), &area(-0.5)), "min_area: 12345 \u{2192} -0.5");
    }
}
