//! What most pixels of each bin are.

use super::cloud::pixels_of_window;
use crate::trace::Class;
use crate::workbench::{Picture, Shown};
use std::sync::Arc;

/// The majority of each bin's pixels, in the order of the histogram.
#[derive(Default)]
pub struct Tally {
    of: Option<(Arc<Picture>, Option<Arc<Shown>>)>,
    /// Their region; 0 is none.
    pub regions: Vec<u16>,
    /// The class of their windows.
    pub classes: Vec<Option<Class>>,
}

impl Tally {
    /// Counts anew where picture or result are others.
    pub fn update(&mut self, picture: &Arc<Picture>, shown: Option<&Arc<Shown>>) {
        let same = self.of.as_ref().is_some_and(|(counted, result)| {
            Arc::ptr_eq(counted, picture)
                && match (result, shown) {
                    (None, None) => true,
                    (Some(a), Some(b)) => Arc::ptr_eq(a, b),
                    _ => false,
                }
        });
        if same {
            return;
        }
        (self.regions, self.classes) = match shown {
            Some(shown) => (regions(picture, shown), classes(picture, shown)),
            None => Default::default(),
        };
        self.of = Some((Arc::clone(picture), shown.cloned()));
    }
}

fn regions(picture: &Picture, shown: &Shown) -> Vec<u16> {
    let labels = shown.labels().as_slice();
    let kinds = shown.analysis.intrinsic.regions.len() + 1;
    let of = |pixel: u32| labels.get(pixel as usize).map_or(0, |&label| usize::from(label));
    majority(picture, kinds, of).into_iter().map(|region| region as u16).collect()
}

fn classes(picture: &Picture, shown: &Shown) -> Vec<Option<Class>> {
    const CLASSES: [Option<Class>; 5] =
        [None, Some(Class::Point), Some(Class::Line), Some(Class::Plane), Some(Class::Volume)];
    let windows = &shown.analysis.windows;
    // A number for each pixel once, instead of a division for each.
    let mut numbers = vec![0u8; shown.labels().len()];
    for (window, class) in windows.classes.as_slice().iter().enumerate() {
        let number = CLASSES.iter().position(|known| known == class).unwrap_or(0) as u8;
        for pixel in pixels_of_window(shown, picture, window as u32) {
            numbers[pixel] = number;
        }
    }
    let of = |pixel: u32| numbers.get(pixel as usize).map_or(0, |&number| usize::from(number));
    majority(picture, CLASSES.len(), of).into_iter().map(|number| CLASSES[number]).collect()
}

/// The most frequent kind of each bin's pixels; of equals the smallest. Kinds beyond `kinds` count as 0.
fn majority(picture: &Picture, kinds: usize, of: impl Fn(u32) -> usize) -> Vec<usize> {
    let mut counts = vec![0u32; kinds.max(1)];
    (0..picture.histogram.bins.len() as u32)
        .map(|bin| {
            let pixels = picture.histogram.pixels_of(bin);
            let kind = |pixel: u32| Some(of(pixel)).filter(|&kind| kind < kinds).unwrap_or(0);
            let mut best = 0;
            for &pixel in &pixels {
                let kind = kind(pixel);
                counts[kind] += 1;
                if (counts[kind], std::cmp::Reverse(kind)) > (counts[best], std::cmp::Reverse(best)) {
                    best = kind;
                }
            }
            for &pixel in &pixels {
                counts[kind(pixel)] = 0;
            }
            best
        })
        .collect()
}
