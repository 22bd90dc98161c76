//! Masks as text: lengths of runs, for files that people may read.

use crate::raster::{Mask, Raster};
use serde::{Deserialize, Serialize};

/// A mask by the lengths of its runs in row order, unset and set in turn, the first unset (and maybe of length 0).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MaskRuns {
    width: usize,
    height: usize,
    /// The lengths, pixels, separated by blanks.
    runs: String,
}

impl MaskRuns {
    /// The run lengths of a mask.
    pub fn of(mask: &Mask) -> Self {
        let mut lengths = Vec::new();
        let (mut value, mut length) = (false, 0usize);
        for &pixel in mask.as_slice() {
            if pixel != value {
                lengths.push(length.to_string());
                (value, length) = (pixel, 0);
            }
            length += 1;
        }
        lengths.push(length.to_string());
        Self { width: mask.width(), height: mask.height(), runs: lengths.join(" ") }
    }

    /// Number of columns and number of rows.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The mask; none where the text holds anything but numbers, or the lengths do not add up to the number of pixels.
    pub fn mask(&self) -> Option<Mask> {
        let pixels = self.width.checked_mul(self.height)?;
        let lengths: Vec<usize> =
            self.runs.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
        // The sum is checked before memory is allocated.
        let sum = lengths.iter().try_fold(0usize, |sum, &length| sum.checked_add(length))?;
        if sum != pixels {
            return None;
        }
        let mut data = Vec::with_capacity(pixels);
        for (index, length) in lengths.into_iter().enumerate() {
            data.resize(data.len() + length, index % 2 == 1);
        }
        Raster::from_vec(self.width, self.height, data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn runs_begin_with_what_is_unset() {
        let mask = Raster::from_vec(3, 2, vec![true, false, false, true, true, true]).unwrap();
        assert_eq!(MaskRuns::of(&mask).runs, "0 1 2 3");
        let broken = |runs: &str| MaskRuns { width: 3, height: 2, runs: runs.into() }.mask();
        assert_eq!(broken("0 1 2 3"), Some(mask));
        for text in ["", "0 1 2", "7", "0 1 2 x", "99999999999999999999", "18446744073709551615 7"] {
            assert_eq!(broken(text), None, "{text}");
        }
    }

    proptest! {
        #[test]
        fn every_mask_comes_back(width in 0usize..9, data in proptest::collection::vec(any::<bool>(), 0..60)) {
            let height = data.len().checked_div(width).unwrap_or(0);
            let mask = Raster::from_vec(width, height, data[..width * height].to_vec()).unwrap();
            prop_assert_eq!(MaskRuns::of(&mask).mask(), Some(mask));
        }
    }
}
