//! Section 7.2: the patches of a region, connected pixels of one interval of a feature, and small patches absorbed by others.

use crate::raster::Raster;

/// The number of a pixel that lies in no patch.
const NONE: u32 = u32::MAX;

/// Buffers of one entry per pixel of the picture, used again for every region.
pub struct Buffers {
    /// Interval of each pixel of the region at work.
    interval: Raster<u8>,
    /// Patch of each pixel of the region at work; [`NONE`] elsewhere.
    patch: Raster<u32>,
}

/// The patches of one region.
#[derive(Clone, Debug, PartialEq)]
pub struct Patches {
    /// The patches, in the order of their first pixels.
    pub list: Vec<Patch>,
    /// Number of pixels in patches that are smaller than the limit.
    pub noise_px: u32,
    /// Number of patches that are not.
    pub large: usize,
}

/// A patch.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Number of the interval of its pixels, from 0; of absorbed pixels another one.
    pub interval: u8,
    /// Its pixels, ascending.
    pub pixels: Vec<u32>,
    /// Number of pixels that were absorbed.
    pub absorbed: u32,
}

impl Buffers {
    /// Buffers for a picture of `width` × `height` pixels.
    pub fn new(width: usize, height: usize) -> Self {
        Self { interval: Raster::filled(width, height, 0), patch: Raster::filled(width, height, NONE) }
    }

    /// The patches of a region of `pixels` (ascending), 4-connected pixels of one interval. `interval_of` is the interval of a pixel;
    /// patches of fewer than `noise` pixels are small.
    pub fn patches(&mut self, pixels: &[u32], interval_of: impl Fn(u32) -> u8, noise: u32) -> Patches {
        // The region's pixels are marked with a number that no patch has.
        const WAITING: u32 = NONE - 1;
        for &pixel in pixels {
            self.interval[pixel as usize] = interval_of(pixel);
            self.patch[pixel as usize] = WAITING;
        }
        let mut list = Vec::new();
        for &first in pixels {
            if self.patch[first as usize] == WAITING {
                let interval = self.interval[first as usize];
                let number = list.len() as u32;
                list.push(Patch { interval, pixels: self.component(first, number, WAITING), absorbed: 0 });
            }
        }
        for &pixel in pixels {
            self.patch[pixel as usize] = NONE;
        }
        let small = |patch: &&Patch| (patch.pixels.len() as u32) < noise;
        let noise_px = list.iter().filter(small).map(|patch| patch.pixels.len() as u32).sum();
        let large = list.len() - list.iter().filter(small).count();
        Patches { list, noise_px, large }
    }

    /// The pixels connected to `first`, which get the `number` of their patch.
    fn component(&mut self, first: u32, number: u32, waiting: u32) -> Vec<u32> {
        let interval = self.interval[first as usize];
        let mut component = vec![first];
        self.patch[first as usize] = number;
        let mut next = 0;
        while let Some(&pixel) = component.get(next) {
            next += 1;
            let Self { interval: intervals, patch } = self;
            intervals.for_each_neighbor(pixel as usize, |near| {
                if patch[near] == waiting && intervals[near] == interval {
                    patch[near] = number;
                    component.push(near as u32);
                }
            });
        }
        component.sort_unstable();
        component
    }

    /// The patches of at least `noise` pixels, with the pixels of the small patches: each small patch joins the large patch with most
    /// of its border, smallest patches first, again and again until none has a neighbor. A small patch without any large patch beside it
    /// stays a patch.
    pub fn absorbed(&mut self, patches: Patches, noise: u32) -> Vec<Patch> {
        let mut list = patches.list;
        for (number, patch) in list.iter().enumerate() {
            for &pixel in &patch.pixels {
                self.patch[pixel as usize] = number as u32;
            }
        }
        let is_small = |patch: &Patch| (patch.pixels.len() as u32) < noise;
        let mut owner: Vec<usize> = (0..list.len()).collect();
        let mut waiting: Vec<usize> = (0..list.len()).filter(|&number| is_small(&list[number])).collect();
        waiting.sort_by_key(|&number| list[number].pixels.len());
        let mut is_open: Vec<bool> = list.iter().map(is_small).collect();
        loop {
            let before = waiting.len();
            waiting.retain(|&number| {
                let Some(into) = self.neighbor(&list[number].pixels, &owner, &is_open) else { return true };
                (owner[number], is_open[number]) = (into, false);
                false
            });
            if waiting.is_empty() || waiting.len() == before {
                break;
            }
        }
        for patch in &list {
            for &pixel in &patch.pixels {
                self.patch[pixel as usize] = NONE;
            }
        }
        for number in 0..list.len() {
            let into = owner[number];
            if into != number {
                let pixels = std::mem::take(&mut list[number].pixels);
                list[into].absorbed += pixels.len() as u32;
                list[into].pixels.extend(pixels);
            }
        }
        list.retain(|patch| !patch.pixels.is_empty());
        list.iter_mut().filter(|patch| patch.absorbed > 0).for_each(|patch| patch.pixels.sort_unstable());
        list
    }

    /// The large patch that most of the border of `pixels` belongs to, the first of equals; none without one. `owner`: the large patch
    /// that each patch has joined; `is_open`: whether it is a small patch that has joined none.
    fn neighbor(&self, pixels: &[u32], owner: &[usize], is_open: &[bool]) -> Option<usize> {
        let mut shares: Vec<(usize, u32)> = Vec::new();
        for &pixel in pixels {
            self.patch.for_each_neighbor(pixel as usize, |near| {
                let number = self.patch[near];
                if number == NONE || is_open[number as usize] {
                    return;
                }
                let into = owner[number as usize];
                match shares.iter_mut().find(|(known, _)| *known == into) {
                    Some((_, share)) => *share += 1,
                    None => shares.push((into, 1)),
                }
            });
        }
        shares.into_iter().max_by_key(|&(into, share)| (share, std::cmp::Reverse(into))).map(|(into, _)| into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The patches of a picture drawn as rows of digits, each an interval; a space is outside the region. Returned as a picture of
    /// letters, a for the first patch.
    fn drawn(rows: &[&str], noise: u32) -> (Vec<String>, u32) {
        let width = rows[0].len();
        let codes: Vec<u8> = rows.concat().bytes().collect();
        let pixels: Vec<u32> =
            (0..codes.len() as u32).filter(|&pixel| codes[pixel as usize] != b' ').collect();
        let mut buffers = Buffers::new(width, rows.len());
        let patches = buffers.patches(&pixels, |pixel| codes[pixel as usize], noise);
        let noise_px = patches.noise_px;
        let mut letters = vec![b' '; codes.len()];
        for (number, patch) in buffers.absorbed(patches, noise).iter().enumerate() {
            for &pixel in &patch.pixels {
                letters[pixel as usize] = b'a' + number as u8;
            }
        }
        assert!(buffers.patch.as_slice().iter().all(|&patch| patch == NONE), "the buffers are clean");
        (letters.chunks(width).map(|row| String::from_utf8(row.to_vec()).unwrap()).collect(), noise_px)
    }

    #[test]
    fn patches_are_connected_pixels_of_one_interval() {
        let (found, noise_px) = drawn(&["00110", "00110", "11000"], 0);
        assert_eq!(found, ["aabbc", "aabbc", "ddccc"]);
        assert_eq!(noise_px, 0);
    }

    #[test]
    fn a_small_patch_joins_the_patch_with_most_of_its_border_and_islands_follow() {
        let (found, noise_px) = drawn(&["0000011", "0120011", "0000011"], 3);
        assert_eq!(found, ["aaaaabb", "aaaaabb", "aaaaabb"]);
        assert_eq!(noise_px, 2);
        // A patch without a neighbor in the region stays.
        let (found, _) = drawn(&["000 1", "000 1"], 4);
        assert_eq!(found, ["aaa b", "aaa b"]);
    }
}
