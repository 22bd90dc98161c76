//! The colors of what a step of the debugger did with pixels: one table for the picture, the color space, the plane, their legends
//! and the inspector.
//!
//! Pixels of a hypothesis have the color of the hypothesis. The other colors are darker than every color of a region
//! (`OKLab` lightness 0.5 to 0.6 against 0.64 to 0.84), and have a contrast of at least 3 on the panels of both themes.

use super::LegendEntry;

/// Color of the cursor and of everything selected, sRGB.
pub const ACCENT: [u8; 3] = [0xE8, 0xA3, 0x3D];

/// What a step did with pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Meaning {
    /// The hypothesis holds the pixels, or a test was passed.
    Taken,
    /// The hypothesis took the pixels in the ring of this step.
    JustTaken,
    /// The hypothesis did not take the pixels, or a test was failed.
    Refused,
    /// The pixels of the cluster that is tested as the highlight of a hypothesis.
    Candidate,
    /// Pixels that a test leaves out.
    Ignored,
}

impl Meaning {
    /// All meanings, in the order of legends.
    pub const ALL: [Self; 5] = [Self::Taken, Self::JustTaken, Self::Refused, Self::Candidate, Self::Ignored];

    /// The color, sRGB. `own` is the color of the hypothesis; none where the step is about no hypothesis.
    pub const fn color(self, own: Option<[u8; 3]>) -> [u8; 3] {
        match (self, own) {
            (Self::Taken, Some(own)) => own,
            (Self::Taken, None) => ACCENT,
            (Self::JustTaken, _) => [0x10, 0x80, 0xE6],
            (Self::Refused, _) => [0xE0, 0x2D, 0x74],
            (Self::Candidate, _) => [0x8F, 0x5C, 0xF0],
            (Self::Ignored, _) => [0x80, 0x82, 0x86],
        }
    }

    /// The legend of the meaning.
    pub const fn legend(self, own: Option<[u8; 3]>) -> LegendEntry {
        let (name, tooltip) = match self {
            Self::Taken => ("its pixels", "5.3.2, 5.4.2: what the region holds at the cursor"),
            Self::JustTaken => {
                ("just taken", "5.3.2, 5.4.2: the pixels that the region took in the ring of this step")
            }
            Self::Refused => ("not taken", "5.3.2, 5.4.2: neighbors of the region that it did not take"),
            Self::Candidate => {
                ("candidate", "5.4.1: the neighboring cluster that is tested as its highlight")
            }
            Self::Ignored => (
                "ignored",
                "5.4.1: pixels on the inside of the matte line, where highlights grow, ignored for its length",
            ),
        };
        LegendEntry::new(name, self.color(own), tooltip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::Palette;

    /// Relative luminance of an sRGB color by WCAG 2.
    fn luminance(color: [u8; 3]) -> f32 {
        let linear = color.map(|code| {
            let value = f32::from(code) / 255.0;
            if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    fn contrast(a: [u8; 3], b: [u8; 3]) -> f32 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn colors_of_meanings_differ_from_one_another_and_from_every_region() {
        let palette = Palette::new();
        let fixed = &Meaning::ALL[1..];
        for (index, meaning) in fixed.iter().enumerate() {
            let color = meaning.color(None);
            let apart = |other: [u8; 3]| -> u32 {
                (0..3).map(|band| u32::from(color[band].abs_diff(other[band])).pow(2)).sum()
            };
            assert!(fixed[..index].iter().all(|other| apart(other.color(None)) > 60 * 60), "{meaning:?}");
            assert!(palette.colors().iter().all(|&region| apart(region) > 45 * 45), "{meaning:?}");
            for panel in [[0x17, 0x18, 0x1A], [0xF2, 0xF2, 0xF2]] {
                assert!(contrast(color, panel) >= 3.0, "{meaning:?}: {}", contrast(color, panel));
            }
        }
        assert_eq!(Meaning::Taken.color(Some([1, 2, 3])), [1, 2, 3], "a region keeps its color");
    }
}
