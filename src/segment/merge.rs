//! Section 5.2.2: two neighboring areas of one class are merged if their union has the same class.
//!
//! Pairs of neighboring windows are tested in row-major order until no pair merges any more. Areas of class *volume* never
//! merge. Each area has moments, so that a union is tested without another pass over the pixels.

use super::classify::{Classifier, Windows};
use crate::color::Moments;
use crate::raster::Raster;
use crate::trace::{Class, MergeTried, Recorder};

/// Merged areas: disjoint sets of windows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Areas {
    /// Area of each window (the index of its first window).
    pub of_window: Raster<u32>,
    /// Moments of each area, at the index of its first window; meaningless at other indices.
    pub moments: Vec<Moments>,
    /// Class of each area, at the index of its first window; meaningless at other indices.
    pub classes: Vec<Option<Class>>,
}

/// Merges neighboring windows into areas.
pub fn merge<R: Recorder>(windows: &Windows, classifier: &mut Classifier, recorder: &mut R) -> Areas {
    let (columns, count) = (windows.classes.width(), windows.classes.len());
    let mut forest = Forest::new(windows);
    loop {
        let mut merged = false;
        for window in 0..count {
            let right = (window + 1) % columns.max(1) != 0;
            let neighbors = [right.then_some(window + 1), Some(window + columns)];
            for neighbor in neighbors.into_iter().flatten().filter(|&n| n < count) {
                merged |= forest.try_union(window, neighbor, classifier, recorder);
            }
        }
        if !merged {
            break;
        }
    }
    let of_window = (0..count).map(|window| forest.root(window) as u32).collect();
    Areas {
        of_window: Raster::from_vec(columns, windows.classes.height(), of_window).unwrap_or_default(),
        moments: forest.moments,
        classes: windows.classes.as_slice().to_vec(),
    }
}

/// A disjoint-set forest of windows; the root of a set is its first window.
struct Forest {
    parent: Vec<u32>,
    moments: Vec<Moments>,
    classes: Vec<Option<Class>>,
    /// Number of times that each root has grown. A refused pair is tested again only after one of its sets has grown.
    version: Vec<u32>,
    /// Pairs of roots that were refused, with the versions of both at that time.
    refused: std::collections::HashMap<(u32, u32), (u32, u32)>,
}

impl Forest {
    fn new(windows: &Windows) -> Self {
        let count = windows.classes.len();
        Self {
            parent: (0..count as u32).collect(),
            moments: windows.moments.as_slice().to_vec(),
            classes: windows.classes.as_slice().to_vec(),
            version: vec![0; count],
            refused: std::collections::HashMap::new(),
        }
    }

    /// The root of a window's set; shortens the path to it.
    fn root(&mut self, window: usize) -> usize {
        let mut at = window;
        while self.parent[at] as usize != at {
            let up = self.parent[at] as usize;
            self.parent[at] = self.parent[up];
            at = up;
        }
        at
    }

    /// Merges the sets of two windows if the union keeps their class. Returns whether they were merged.
    fn try_union<R: Recorder>(
        &mut self,
        one: usize,
        other: usize,
        classifier: &mut Classifier,
        recorder: &mut R,
    ) -> bool {
        let (one, other) = (self.root(one), self.root(other));
        let (into, from) = (one.min(other), one.max(other));
        let Some(class) = self.classes[into] else { return false };
        if into == from || class == Class::Volume || self.classes[from] != Some(class) {
            return false;
        }
        let pair = (into as u32, from as u32);
        let versions = (self.version[into], self.version[from]);
        if self.refused.get(&pair) == Some(&versions) {
            return false;
        }
        let both = self.moments[into].merged(&self.moments[from]);
        let (union, eigenvalues) = classifier.classify(&both);
        if R::KEEPS {
            recorder.record(MergeTried {
                into: pair.0,
                from: pair.1,
                pixels: [into, from].map(|part| self.moments[part].n as u32),
                eigenvalues: eigenvalues.map(|variance| variance as f32),
                chi_square: classifier.decided_by(both.n, eigenvalues),
                class,
                union,
            });
        }
        if union != class {
            self.refused.insert(pair, versions);
            return false;
        }
        self.parent[from] = pair.0;
        self.moments[into] = both;
        self.version[into] += 1;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::segment::classify::classify;
    use crate::trace::NoopRecorder;

    /// The areas of a picture of windows of 5×5 pixels, drawn as letters: each letter is a matte line of its own color, `.` is
    /// dark. Returns the areas as digits, in rows.
    fn areas_of(grid: &[&str]) -> String {
        let (columns, rows) = (grid[0].len(), grid.len());
        let mut image = Raster::filled(columns * 5, rows * 5, [0.0f32; 3]);
        for pixel in 0..image.len() {
            let (x, y) = (pixel % (columns * 5), pixel / (columns * 5));
            let color = match grid[y / 5].as_bytes()[x / 5] {
                b'r' => Vec3::new(0.9, 0.3, 0.1),
                b'g' => Vec3::new(0.1, 0.9, 0.3),
                _ => continue,
            };
            image[pixel] = crate::color::rgb(&(color * (80.0 + 4.0 * ((x * 3 + y * 5) % 17) as f64)));
        }
        let mut classifier = Classifier::new(2.5, true);
        let windows =
            classify(&image, |pixel| image[pixel][0] > 0.0, 5, 12, &mut classifier, &mut NoopRecorder);
        let areas = merge(&windows, &mut classifier, &mut NoopRecorder);
        let mut names = std::collections::BTreeMap::new();
        let mut text = String::new();
        for (window, &area) in areas.of_window.as_slice().iter().enumerate() {
            let next = char::from(b'1' + names.len() as u8);
            let classed = areas.classes[area as usize].is_some();
            text.push(if classed { *names.entry(area).or_insert(next) } else { '.' });
            if (window + 1) % columns == 0 {
                text.push('\n');
            }
        }
        text
    }

    #[test]
    fn windows_of_one_matte_line_merge_and_materials_stay_apart() {
        assert_eq!(areas_of(&["rrg", "rgg", "..r"]), "112\n122\n..3\n");
    }

    #[test]
    fn areas_that_meet_late_still_merge() {
        assert_eq!(areas_of(&["r.r", "rrr", "r.r"]), "1.1\n111\n1.1\n");
    }
}
