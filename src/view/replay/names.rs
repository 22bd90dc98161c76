//! What the regions of a trace are called and colored: by what became of them.

use crate::trace::{End, Replay};

/// The final number and color of each region, by its number of birth.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RegionNames {
    finals: Vec<u16>,
    colors: Vec<[u8; 3]>,
}

impl RegionNames {
    /// The names, from a cursor at the end of its trace; `colors` are the final regions'.
    pub fn new(end: &Replay, colors: &[[u8; 3]]) -> Self {
        let count = end.hypotheses().len() as u16;
        let finals: Vec<u16> = (1..=count).map(|region| final_of(end, region)).collect();
        let mut orphans = super::super::colors::orphan_colors(colors, usize::from(count)).into_iter();
        let color = |&region: &u16| {
            let kept = usize::from(region).checked_sub(1).and_then(|index| colors.get(index)).copied();
            kept.or_else(|| orphans.next()).unwrap_or([128; 3])
        };
        let colors = finals.iter().map(color).collect();
        Self { finals, colors }
    }

    /// The final region that a region became part of; 0 where nothing is left of it.
    pub fn final_number(&self, region: u16) -> u16 {
        usize::from(region).checked_sub(1).and_then(|index| self.finals.get(index)).copied().unwrap_or(0)
    }

    /// Its color, sRGB: that of the final region, where it became part of one.
    pub fn color(&self, region: u16) -> [u8; 3] {
        usize::from(region)
            .checked_sub(1)
            .and_then(|index| self.colors.get(index))
            .copied()
            .unwrap_or([128; 3])
    }

    /// The regions that became part of a final one, by their numbers of birth: the one that gave it its number first.
    pub fn births_of(&self, final_number: u16) -> impl Iterator<Item = u16> + '_ {
        (1..).zip(&self.finals).filter(move |&(_, &found)| found == final_number).map(|(region, _)| region)
    }
}

/// The final number of a region, or of the one that it became part of.
fn final_of(end: &Replay, region: u16) -> u16 {
    let mut at = region;
    // Each region ends in one that still stood; more turns than regions would be a circle.
    for _ in 0..=end.hypotheses().len() {
        let own = end.final_number(at).unwrap_or(0);
        if own != 0 {
            return own;
        }
        match end.hypothesis(at).and_then(crate::trace::Hypothesis::end) {
            Some(End::Merged(into) | End::Absorbed(into)) => at = into,
            _ => return 0,
        }
    }
    0
}
