//! The votes for the light, which are kept while the picture and its masks stay.

use crate::params::Baseline;
use crate::segment::{AnalysisInput, PictureVotes};
use std::sync::{Arc, OnceLock};

/// The last votes.
pub(super) struct VotesSlot<K> {
    /// What the votes were cast from, and the votes; `None` before the first run.
    last: Option<(K, KeptVotes)>,
}

impl<K> Default for VotesSlot<K> {
    fn default() -> Self {
        Self { last: None }
    }
}

impl<K: PartialEq> VotesSlot<K> {
    /// The votes for `key`: the last ones, or votes that are still to be cast. An earlier method asks for none.
    pub(super) fn get(&mut self, key: K, input: &AnalysisInput, baseline: Option<&Baseline>) -> KeptVotes {
        if baseline.is_some() || !PictureVotes::are_asked(input) {
            return KeptVotes { are_asked: false, votes: Arc::default() };
        }
        match &self.last {
            Some((made_from, votes)) if *made_from == key => votes.clone(),
            _ => {
                let votes = KeptVotes { are_asked: true, votes: Arc::default() };
                self.last = Some((key, votes.clone()));
                votes
            }
        }
    }
}

/// Votes that are cast once, when they are first used.
#[derive(Clone)]
pub(super) struct KeptVotes {
    are_asked: bool,
    votes: Arc<OnceLock<Option<PictureVotes>>>,
}

impl KeptVotes {
    /// The votes of the picture `input`; none where none are asked for, or too few pixels can vote.
    pub(super) fn cast(&self, input: &AnalysisInput) -> Option<&PictureVotes> {
        if !self.are_asked {
            return None;
        }
        self.votes.get_or_init(|| PictureVotes::of(input)).as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::segment::testing::Drawing;

    #[test]
    fn votes_are_cast_once_for_a_key_and_never_where_none_are_asked() {
        let light = Vec3::new(0.65, 0.57, 0.5).normalize();
        let mut drawing = Drawing::by_place(60, |x, y| {
            let from_center2 = ((x % 30.0) - 15.0).powi(2) + ((y % 30.0) - 15.0).powi(2);
            Vec3::new(0.8, 0.3, 0.2) * (80.0 + 0.3 * y) + light * (150.0 * (-from_center2 / 8.0).exp())
        });
        let mut slot = VotesSlot::default();
        let first = slot.get(1, &drawing.input(), None);
        assert!(first.cast(&drawing.input()).is_some());
        assert!(Arc::ptr_eq(&first.votes, &slot.get(1, &drawing.input(), None).votes), "the key is the same");
        assert!(!Arc::ptr_eq(&first.votes, &slot.get(2, &drawing.input(), None).votes), "another picture");
        let of_earlier_method = slot.get(2, &drawing.input(), Some(&Baseline::TopDown));
        assert_eq!(of_earlier_method.cast(&drawing.input()), None);
        drawing.used.illuminant = Some([0.6, 0.6, 0.5]);
        assert_eq!(slot.get(2, &drawing.input(), None).cast(&drawing.input()), None, "the light is given");
    }
}
