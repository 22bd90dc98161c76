//! Named marks: several selections of pixels, each with a name and a color.

use crate::raster::Mask;
use std::sync::Arc;

/// Marked pixels with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMark {
    /// The name, which a person chooses.
    pub name: String,
    /// The color of outline and fill, sRGB.
    pub color: [u8; 3],
    /// The pixels.
    pub mask: Arc<Mask>,
    /// Number of the pixels.
    pub pixels: usize,
}

/// All named marks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedMarks {
    /// The marks, the oldest first.
    pub marks: Vec<NamedMark>,
    /// The mark that the tools change, by its index; none: the tools change the marked pixels alone.
    pub active: Option<usize>,
}

impl NamedMark {
    /// A mark of the pixels of a mask.
    pub fn new(name: String, color: [u8; 3], mask: Arc<Mask>) -> Self {
        let pixels = mask.count();
        Self { name, color, mask, pixels }
    }

    /// Replaces the pixels.
    pub fn set_mask(&mut self, mask: Arc<Mask>) {
        (self.pixels, self.mask) = (mask.count(), mask);
    }
}

impl NamedMarks {
    /// The newest mark that a pixel is in, by row-major index.
    pub fn at(&self, pixel: usize) -> Option<&NamedMark> {
        self.marks.iter().rev().find(|mark| mark.mask.as_slice().get(pixel) == Some(&true))
    }

    /// A name that no mark has: "mark 1" and so on.
    pub fn free_name(&self) -> String {
        let taken = |name: &String| self.marks.iter().any(|mark| mark.name == *name);
        (1..=self.marks.len() + 1)
            .map(|number| format!("mark {number}"))
            .find(|name| !taken(name))
            .unwrap_or_default()
    }

    /// A color that no mark has, as long as there is one.
    pub fn free_color(&self) -> [u8; 3] {
        let colors = crate::export::Palette::new().colors().to_vec();
        let is_free = |color: &[u8; 3]| self.marks.iter().all(|mark| mark.color != *color);
        let next = colors[self.marks.len() % colors.len().max(1)];
        colors.into_iter().find(is_free).unwrap_or(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;

    #[test]
    fn names_and_colors_are_not_repeated_and_the_newest_mark_is_on_top() {
        let mask = |on: [bool; 3]| Arc::new(Raster::from_vec(3, 1, on.to_vec()).unwrap());
        let mut marks = NamedMarks::default();
        for on in [[true, true, false], [false, true, false]] {
            let mark = NamedMark::new(marks.free_name(), marks.free_color(), mask(on));
            marks.marks.push(mark);
        }
        let [first, second] = &marks.marks[..] else { panic!("two marks") };
        assert_eq!((first.name.as_str(), second.name.as_str()), ("mark 1", "mark 2"));
        assert_ne!(first.color, second.color);
        assert_eq!((first.pixels, second.pixels), (2, 1));
        let name = |pixel| marks.at(pixel).map(|mark| mark.name.as_str());
        assert_eq!([name(0), name(1), name(2)], [Some("mark 1"), Some("mark 2"), None]);
    }
}
