//! The difference between two documents in words, for the list of the history.

use super::Document;
use crate::describe::counted;
use crate::raster::Mask;
use crate::view::{Item, NamedMarks, SettingChange, setting_changes};
use std::sync::Arc;

/// What changed from one document to the next; `width` is the photograph's, pixels.
pub fn document_change(before: &Document, after: &Document, width: usize) -> String {
    let mut parts = Vec::new();
    let settings = setting_changes(&before.params, &after.params);
    if settings.len() > 3 {
        parts.push(many_settings(&settings));
    } else {
        let change = settings.into_iter();
        parts.extend(
            change.map(|change| format!("{}: {} \u{2192} {}", change.name, change.pinned, change.newest)),
        );
    }
    if !same_mask(before.area.as_ref(), after.area.as_ref()) {
        parts.push(after.area.as_ref().map_or_else(
            || "the whole picture analyzed".to_owned(),
            |area| format!("analysis restricted to {}", counted(area.count(), "pixel")),
        ));
    }
    let (old, new) = (&before.selection, &after.selection);
    if old.item != new.item {
        parts.push(new.item.map_or_else(
            || "nothing selected".to_owned(),
            |item| format!("{} selected", item_name(item, width)),
        ));
    }
    if !same_mask(old.marked.as_ref(), new.marked.as_ref()) {
        parts.push(new.marked.as_ref().map_or_else(
            || "no pixels marked".to_owned(),
            |mask| format!("{} marked", counted(mask.count(), "pixel")),
        ));
    }
    parts.extend(named_change(&old.named, &new.named));
    if parts.is_empty() { "no change".to_owned() } else { parts.join("; ") }
}

/// Says of many changed settings how many there are. Where the method is one of them it is named: the others go with it.
fn many_settings(settings: &[SettingChange]) -> String {
    let method = settings.iter().find(|change| change.name == "method");
    let Some(method) = method else { return format!("{} settings changed", settings.len()) };
    let others = counted(settings.len() - 1, "other setting");
    format!("method: {} \u{2192} {}, and {others}", method.pinned, method.newest)
}

/// What changed in the named marks; none where nothing did.
fn named_change(old: &NamedMarks, new: &NamedMarks) -> Option<String> {
    if old.marks.len() < new.marks.len() {
        return new.marks.last().map(|mark| format!("{} kept", mark.name));
    }
    if old.marks.len() > new.marks.len() {
        return Some("a named mark removed".to_owned());
    }
    let changed = old.marks.iter().zip(&new.marks).find(|(old, new)| old != new);
    changed.map(|(old, new)| {
        if old.name == new.name {
            format!("{} changed", new.name)
        } else {
            format!("{} renamed {}", old.name, new.name)
        }
    })
}

/// The name of an item in a sentence; `width` is the photograph's, pixels.
fn item_name(item: Item, width: usize) -> String {
    match item {
        Item::Pixel(pixel) => {
            let [x, y] = pixel.position(width.max(1));
            format!("pixel {x}, {y}")
        }
        Item::Window(window) => format!("window {}", window + 1),
        Item::Region(region) => format!("region {region}"),
        Item::Bin(bin) => format!("color {}", bin + 1),
    }
}

fn same_mask(a: Option<&Arc<Mask>>, b: Option<&Arc<Mask>>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Parameter, Setting};
    use crate::raster::{PixelIndex, Raster};

    #[test]
    fn every_part_of_a_document_is_named_when_it_changes() {
        let before = Document::default();
        let change = |change: &dyn Fn(&mut Document)| {
            let mut after = before.clone();
            change(&mut after);
            document_change(&before, &after, 10)
        };
        assert_eq!(change(&|_| ()), "no change");
        let sigma = change(&|document| *document.params.slot(Parameter::CameraNoise) = Setting::Value(4.0));
        assert_eq!(sigma, "camera_noise: auto \u{2192} 4");
        let item = change(&|document| document.selection.item = Some(Item::Pixel(PixelIndex::new(23))));
        assert_eq!(item, "pixel 3, 2 selected");
        let mask = Arc::new(Raster::from_vec(2, 1, vec![true, false]).unwrap());
        assert_eq!(
            change(&|document| document.area = Some(Arc::clone(&mask))),
            "analysis restricted to 1 pixel"
        );
        assert_eq!(change(&|document| document.selection.marked = Some(Arc::clone(&mask))), "1 pixel marked");
        let paper = change(&|document| document.params = crate::params::Params::paper());
        assert!(
            paper.starts_with("method: refined \u{2192} paper, and ") && paper.ends_with(" other settings"),
            "{paper}"
        );
    }
}
