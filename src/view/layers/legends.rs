//! Colors of the layers, with their names and meanings.

use crate::describe::{reason_label, reason_meaning};
use crate::intrinsic::Reason;
use crate::view::LegendEntry;

/// Names, colors and meanings of the classes (section 5.2.1), in the paper's colors.
pub(super) const CLASSES: [LegendEntry; 4] = [
    LegendEntry::new("point", [255, 255, 0], "5.2.1: no variation beyond the noise, a flat matte patch"),
    LegendEntry::new("line", [255, 0, 0], "5.2.1: one direction of variation, matte or highlight pixels"),
    LegendEntry::new(
        "plane",
        [0, 255, 0],
        "5.2.1: two directions, matte and highlight pixels or two objects",
    ),
    LegendEntry::new("volume", [0, 0, 255], "5.2.1: three directions, clipping or several objects"),
];

/// Color of the pixels outside the area.
const OUTSIDE_COLOR: [u8; 3] = [96, 96, 96];
/// Color of the pixels of clipped objects.
const CLIPPED_OBJECT_COLOR: [u8; 3] = [120, 200, 120];
/// Color of the pixels without a value.
const NO_VALUE_COLOR: [u8; 3] = [210, 59, 214];

/// Names, colors and meanings of the masks (section 4). A pixel has the color of the last mask that holds the pixel.
pub(super) const MASKS: [LegendEntry; 6] = [
    LegendEntry::new("dark", [74, 111, 212], "4: too near to black, its color is mostly noise"),
    LegendEntry::new("bloomed", [240, 128, 32], "4: charge spilled over from clipped neighbors"),
    LegendEntry::new("clipped", [250, 226, 70], "4: a band at or above the clipping threshold"),
    reason(Reason::ClippedObject, CLIPPED_OBJECT_COLOR),
    reason(Reason::NoValue, NO_VALUE_COLOR),
    reason(Reason::OutsideArea, OUTSIDE_COLOR),
];

/// The grays of ε (section 6), whose scale is the half width of the slice.
pub(super) const NOISE: [LegendEntry; 3] = [
    LegendEntry::new("behind", [1, 1, 1], "6: on the face of the slice opposite to the plane's normal"),
    LegendEntry::new("in the plane", [128, 128, 128], "6: on the dichromatic plane, \u{3b5} = 0"),
    LegendEntry::new(
        "before",
        [255, 255, 255],
        "6: on the face of the slice that the plane's normal points to",
    ),
];

/// The grays of the difference of two body reflections, whose scale is [`super::DIFFERENCE_COUNTS`].
pub(super) const DIFFERENCE: [LegendEntry; 3] = [
    LegendEntry::new("darker", [1, 1, 1], "body reflection 64 counts below the pinned result's"),
    LegendEntry::new("same", [128, 128, 128], "body reflection as in the pinned result"),
    LegendEntry::new("brighter", [255, 255, 255], "body reflection 64 counts above the pinned result's"),
];

/// The grays of a diffuse picture minus body reflection, whose scale is [`super::DIFFERENCE_COUNTS`].
pub(super) const OTHER_DIFFERENCE: [LegendEntry; 3] = [
    LegendEntry::new("darker", [1, 1, 1], "the diffuse picture is 64 counts below body reflection"),
    LegendEntry::new("same", [128, 128, 128], "the diffuse picture is as body reflection"),
    LegendEntry::new("brighter", [255, 255, 255], "the diffuse picture is 64 counts above body reflection"),
];

/// The colors of borders, in the order of their kinds from 1 on.
pub(super) const BORDERS: [LegendEntry; 3] = [
    LegendEntry::new("both", [240, 240, 240], "a border of a region and of a label, up to two pixels apart"),
    LegendEntry::new(
        "regions only",
        [64, 160, 255],
        "a border of a region, where the other program has none",
    ),
    LegendEntry::new(
        "other only",
        [255, 96, 64],
        "a border of the other program's label, where no region ends",
    ),
];

/// The grays of the confidence, 0…1.
pub(super) const CONFIDENCE: [LegendEntry; 2] = [
    LegendEntry::new("not at all", [1, 1, 1], "the split of this pixel is not to be believed"),
    LegendEntry::new(
        "fully",
        [255, 255, 255],
        "the split of this pixel is to be believed as far as the model goes",
    ),
];

/// The reasons why pixels are not explained, in the order of [`Reason::ALL`] from its second entry on.
pub(super) const REASONS: [LegendEntry; Reason::ALL.len() - 1] = [
    reason(Reason::Shadow, [74, 111, 212]),
    reason(Reason::NoMatteLine, [160, 120, 220]),
    reason(Reason::MixedBoundary, [120, 190, 200]),
    reason(Reason::InterReflection, [90, 180, 110]),
    reason(Reason::Texture, [232, 120, 90]),
    reason(Reason::PartOfObject, [200, 170, 90]),
    reason(Reason::OtherObject, [220, 140, 190]),
    reason(Reason::Collinear, [170, 170, 170]),
    reason(Reason::ClippedAllBands, [250, 226, 70]),
    reason(Reason::ClippedObject, CLIPPED_OBJECT_COLOR),
    reason(Reason::OutsideArea, OUTSIDE_COLOR),
    reason(Reason::NoValue, NO_VALUE_COLOR),
];

/// The entry of a reason.
const fn reason(reason: Reason, color: [u8; 3]) -> LegendEntry {
    LegendEntry::new(reason_label(reason), color, reason_meaning(reason))
}

/// The lamps, in the order of [`crate::view::Lamp`]. The colors are not those of lamps, so that either lamp may have either.
pub(super) const LAMPS: [LegendEntry; 2] = [
    LegendEntry::new("first lamp", [90, 174, 97], "7.5: split with the color of the light"),
    LegendEntry::new("second lamp", [190, 130, 220], "7.5: split with the color of the second lamp"),
];

/// The colors of the classes in the order point, line, plane, volume.
pub fn class_entries() -> [LegendEntry; 4] {
    CLASSES
}

/// The color, name and meaning of a reason why a pixel is not explained; none for an explained pixel.
pub fn reason_entry(reason: Reason) -> Option<LegendEntry> {
    let index = Reason::ALL.iter().position(|known| *known == reason)?;
    REASONS.get(index.checked_sub(1)?).copied()
}
