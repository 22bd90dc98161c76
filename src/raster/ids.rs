//! Numbers of hypotheses, regions and pixels as types of their own, so that the compiler refuses one in the place of another.
//!
//! A label map keeps plain numbers, 0 for none. [`HypothesisId::from_label`] and [`RegionId::from_label`] read such a number;
//! `Option<HypothesisId>` and `Option<RegionId>` take two bytes each, as the number does.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::num::NonZeroU16;

/// Makes the type of a number that counts from 1 and fits into a label map.
macro_rules! label_id {
    ($(#[$doc:meta])+ $name:ident) => {
        $(#[$doc])+
        #[repr(transparent)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(NonZeroU16);

        impl $name {
            /// The largest number of ids: as many as a label map can tell apart.
            pub const MOST: usize = u16::MAX as usize;

            /// The id in a label map; none for the label 0 ([`UNASSIGNED`](super::UNASSIGNED)).
            #[inline]
            pub const fn from_label(label: u16) -> Option<Self> {
                match NonZeroU16::new(label) {
                    Some(number) => Some(Self(number)),
                    None => None,
                }
            }

            /// The label of an id in a label map; 0 for none.
            #[inline]
            pub const fn label(id: Option<Self>) -> u16 {
                match id {
                    Some(id) => id.get(),
                    None => 0,
                }
            }

            /// The id whose place in a list is `index`, from 0. Places from [`Self::MOST`] on have no id of their own: they
            /// get the last one.
            #[inline]
            pub const fn from_index(index: usize) -> Self {
                let most = Self::MOST - 1;
                Self(NonZeroU16::MIN.saturating_add(if index < most { index } else { most } as u16))
            }

            /// The ids of a list of `count` entries, in order.
            pub fn all(count: usize) -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator + Clone {
                (0..count).map(Self::from_index)
            }

            /// The place in a list, from 0.
            #[inline]
            pub const fn index(self) -> usize {
                self.0.get() as usize - 1
            }

            /// The number, from 1.
            #[inline]
            pub const fn get(self) -> u16 {
                self.0.get()
            }
        }

        impl From<$name> for u16 {
            #[inline]
            fn from(id: $name) -> Self {
                id.get()
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_u16(self.get())
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let number = u16::deserialize(deserializer)?;
                Self::from_label(number).ok_or_else(|| D::Error::custom("ids count from 1"))
            }
        }
    };
}

label_id! {
    /// A hypothesis, by its place in the order in which hypotheses were made, from 1.
    HypothesisId
}

label_id! {
    /// A region of the result, from 1 for the largest.
    RegionId
}

/// A pixel, by its place in the row-major order of its picture: `y · width + x`.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PixelIndex(u32);

impl PixelIndex {
    /// The pixel at a place in the row-major order, from 0. Pictures have fewer than 2³² pixels.
    #[inline]
    pub const fn from_index(index: usize) -> Self {
        Self(index as u32)
    }

    /// The pixel by its number, from 0.
    #[inline]
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// The place in the row-major order, from 0.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The number, from 0.
    #[inline]
    pub const fn get(self) -> u32 {
        self.0
    }

    /// Column and row in a picture `width` pixels wide.
    #[inline]
    pub fn position(self, width: usize) -> [usize; 2] {
        [self.index() % width.max(1), self.index() / width.max(1)]
    }
}

impl fmt::Display for PixelIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_counts_from_one_and_its_index_from_zero() {
        let third = RegionId::from_index(2);
        assert_eq!((third.index(), third.get(), third.to_string()), (2, 3, "3".to_owned()));
        assert_eq!((RegionId::from_label(3), RegionId::from_label(0)), (Some(third), None));
        assert_eq!((RegionId::label(Some(third)), RegionId::label(None)), (3, 0));
        assert_eq!(RegionId::all(3).collect::<Vec<_>>(), [1, 2, 3].map(|n| RegionId::from_label(n).unwrap()));
        assert_eq!(HypothesisId::from_index(usize::MAX).get(), u16::MAX);
        assert_eq!(size_of::<Option<HypothesisId>>(), 2);
    }

    #[test]
    fn a_pixel_lies_in_a_column_and_a_row() {
        let pixel = PixelIndex::from_index(7);
        assert_eq!((pixel.position(3), pixel.get(), pixel.index()), ([1, 2], 7, 7));
        assert_eq!(pixel.position(0), [0, 7]);
    }
}
