//! One entry of a legend.

/// A color of a view and its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LegendEntry {
    /// The name, a word or two.
    pub name: &'static str,
    /// The color, sRGB.
    pub color: [u8; 3],
    /// The meaning, with the section of the paper.
    pub tooltip: &'static str,
}

impl LegendEntry {
    pub(super) const fn new(name: &'static str, color: [u8; 3], tooltip: &'static str) -> Self {
        Self { name, color, tooltip }
    }
}
