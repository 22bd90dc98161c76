//! Who listens to the decisions while they are made.

use super::{Event, PixelKind};
use crate::raster::{LabelMap, Raster, UNASSIGNED};

/// Takes decisions in their order. Stages are generic over it, so that [`Silent`] costs nothing.
pub trait Recorder {
    /// Whether anything is kept: what is recorded is put together only then.
    const KEEPS: bool;

    /// A decision.
    fn record(&mut self, event: Event);

    /// A pixel changed hands.
    fn claim(&mut self, pixel: u32, before: u16, after: u16);

    /// A pixel's final role was decided.
    fn label(&mut self, pixel: u32, kind: PixelKind);
}

/// Keeps nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Recorder for Silent {
    const KEEPS: bool = false;

    #[inline]
    fn record(&mut self, _event: Event) {}

    #[inline]
    fn claim(&mut self, _pixel: u32, _before: u16, _after: u16) {}

    #[inline]
    fn label(&mut self, _pixel: u32, _kind: PixelKind) {}
}

/// One entry of a [`Log`].
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    /// A decision with its numbers.
    Event(Event),
    /// A pixel went from region `before` to region `after`.
    Claim {
        /// The pixel, `y · width + x`.
        pixel: u32,
        /// The region that had it.
        before: u16,
        /// The region that has it now.
        after: u16,
    },
    /// A pixel's final role.
    Label {
        /// The pixel.
        pixel: u32,
        /// Its role.
        kind: PixelKind,
    },
}

/// Keeps everything, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// What was recorded so far.
    pub entries: Vec<Entry>,
}

impl Recorder for Log {
    const KEEPS: bool = true;

    fn record(&mut self, event: Event) {
        self.entries.push(Entry::Event(event));
    }

    fn claim(&mut self, pixel: u32, before: u16, after: u16) {
        self.entries.push(Entry::Claim { pixel, before, after });
    }

    fn label(&mut self, pixel: u32, kind: PixelKind) {
        self.entries.push(Entry::Label { pixel, kind });
    }
}

/// What a picture of `width × height` pixels looks like after a record has been played from the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Replayed {
    /// Region of each pixel.
    pub labels: LabelMap,
    /// Role of each pixel.
    pub kinds: Raster<PixelKind>,
}

impl Log {
    /// Plays the record from the empty picture to its end.
    ///
    /// # Errors
    /// The index of the first entry that contradicts what went before it: a claim on a pixel that was in other hands,
    /// or outside the picture.
    pub fn replay(&self, width: usize, height: usize) -> Result<Replayed, usize> {
        let mut labels = LabelMap::filled(width, height, UNASSIGNED);
        let mut kinds = Raster::filled(width, height, PixelKind::Unassigned);
        for (index, entry) in self.entries.iter().enumerate() {
            match entry {
                Entry::Claim { pixel, before, after } => {
                    let label = labels.as_mut_slice().get_mut(*pixel as usize).ok_or(index)?;
                    if *label != *before {
                        return Err(index);
                    }
                    *label = *after;
                }
                Entry::Label { pixel, kind } => {
                    *kinds.as_mut_slice().get_mut(*pixel as usize).ok_or(index)? = *kind;
                }
                Entry::Event(Event::Renumbered { finals }) => {
                    for label in labels.as_mut_slice().iter_mut().filter(|label| **label != UNASSIGNED) {
                        *label = *finals.get(usize::from(*label) - 1).ok_or(index)?;
                    }
                }
                Entry::Event(_) => {}
            }
        }
        Ok(Replayed { labels, kinds })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replay_follows_claims_and_new_numbers() {
        let mut log = Log::default();
        log.claim(1, 0, 1);
        log.claim(2, 0, 2);
        log.claim(1, 1, 2);
        log.record(Event::Renumbered { finals: vec![0, 1] });
        log.label(2, PixelKind::Matte);
        let end = log.replay(3, 1).unwrap();
        assert_eq!(end.labels.as_slice(), [0, 1, 1]);
        assert_eq!(end.kinds[2], PixelKind::Matte);
    }

    #[test]
    fn a_record_that_contradicts_itself_is_found_out() {
        let mut log = Log::default();
        log.claim(0, 0, 1);
        log.claim(0, 0, 2);
        assert_eq!(log.replay(1, 1), Err(1));
        log.entries.truncate(1);
        log.claim(5, 0, 1);
        assert_eq!(log.replay(1, 1), Err(1));
    }
}
