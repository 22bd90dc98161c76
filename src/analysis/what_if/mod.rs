//! What if: how far each parameter would have to move for a pixel to change its fate.
//!
//! Where one threshold decided, the trace holds the number that it decided on: a pixel 12.4 counts from an axis joins at a
//! cylinder width of 12.4/σ0. Such guesses are tried first. Where they do not hold, because lines are fitted to other
//! pixels or another region comes first, and where there is none, the parameter is moved in ever larger steps until the
//! fate changes, and the place is narrowed down. Every value told has been analyzed, and so has the one on its near side.
//!
//! A fate may change back further on, and a change that lies between two steps of the search and changes back there is
//! missed: "nearest" means nearest of what was tried.

mod guess;
mod ladder;
#[cfg(test)]
mod tests;

use super::{Analysis, Cancelled, Observer, Session};
use crate::params::{Parameter, Params, Setting};
use crate::raster::{LabelMap, PixelIndex, RegionId, UNASSIGNED};
use crate::trace::{PixelKind, pixel_history};
use guess::{Guess, guesses};
use ladder::Ladder;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// Region and kind of a pixel in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Fate {
    /// The pixel's region.
    pub home: Home,
    /// The pixel's kind in that region.
    pub kind: PixelKind,
}

/// A pixel's region, named by the regions of the unchanged result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Home {
    /// In no region.
    Nowhere,
    /// In what overlaps this region of the unchanged result most.
    Region(RegionId),
    /// In a region where the unchanged result has none.
    New,
}

/// Which way a parameter is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// To smaller values.
    Down,
    /// To larger values.
    Up,
}

/// A parameter's nearest value at which a pixel's fate is another.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct WhatIf {
    /// The parameter.
    pub parameter: Parameter,
    /// Which way it was moved.
    pub direction: Direction,
    /// The value that the unchanged result was made with, in the parameter's unit.
    pub now: f64,
    /// The fate changes here.
    pub at: f64,
    /// The nearest value tried on the near side, at which the fate is unchanged.
    pub unchanged_at: f64,
    /// The pixel's fate in the unchanged result.
    pub before: Fate,
    /// Its fate at [`WhatIf::at`].
    pub after: Fate,
    /// Whether the recorded numbers told where; else it was searched.
    pub predicted: bool,
}

/// Receives the progress of a search, and may stop it.
pub trait WhatIfObserver: Sync {
    /// `done` of `of` searches are finished; there is one for each parameter and direction.
    fn progress(&mut self, _done: usize, _of: usize) {}
    /// A value at which the fate changes was found.
    fn found(&mut self, _what_if: &WhatIf) {}
    /// Asked often, from any thread; the search stops soon after it turns true.
    fn cancelled(&self) -> bool {
        false
    }
}

/// An observer that ignores everything.
impl WhatIfObserver for () {}

/// For each parameter and direction the nearest value found at which the pixel's fate is another, in the order of table 6,
/// down before up. Nothing where no value tried changes it, and for a pixel outside the picture.
///
/// The area that `session` is restricted to holds here too. Afterwards the session keeps the outputs of the last value
/// tried: use one that nobody else waits for.
///
/// # Errors
/// [`Cancelled`] when the observer asks for it.
pub fn what_if(
    session: &mut Session,
    params: &Params,
    pixel: PixelIndex,
    observer: &mut impl WhatIfObserver,
) -> Result<Vec<WhatIf>, Cancelled> {
    if pixel.index() >= session.image.pixels.len() {
        return Ok(Vec::new());
    }
    let (analysis, trace) = session.run_traced(params, &mut Quiet(observer))?;
    let history = pixel_history(&trace, &session.image, &analysis.masks, pixel);
    let pixel = pixel.index();
    let guesses = guesses(&history, params, &analysis.used);
    let movable = movable(params, &analysis, pixel);
    let before = Fate {
        home: RegionId::from_label(analysis.finals.labels[pixel]).map_or(Home::Nowhere, Home::Region),
        kind: analysis.intrinsic.kinds[pixel],
    };
    let mut search = Search { session, params, pixel, unchanged: analysis, before };
    let mut found = Vec::new();
    let of = 2 * movable.len();
    for (index, &parameter) in movable.iter().enumerate() {
        for (turn, direction) in [Direction::Down, Direction::Up].into_iter().enumerate() {
            let own =
                guesses.iter().filter(|guess| (guess.parameter, guess.direction) == (parameter, direction));
            if let Some(what_if) = search.run((parameter, direction), own, observer)? {
                observer.found(&what_if);
                found.push(what_if);
            }
            observer.progress(2 * index + turn + 1, of);
        }
    }
    let place = |parameter| Parameter::ALL.iter().position(|&other| other == parameter);
    found.sort_by_key(|what_if| (place(what_if.parameter), what_if.direction));
    Ok(found)
}

/// The parameters that can change the pixel's fate at all, those of late stages first: what they leave as it is need not
/// run again.
fn movable(params: &Params, analysis: &Analysis, pixel: usize) -> Vec<Parameter> {
    let masks = &analysis.masks;
    if masks.invalid(pixel) || masks.outside(pixel) {
        return Vec::new();
    }
    if masks.dark(pixel) {
        // No stage reads a dark pixel; an automatic limit of darkness follows the noise.
        return match params.min_intensity {
            Setting::Auto => vec![Parameter::CameraNoise, Parameter::MinIntensity],
            Setting::Value(_) => vec![Parameter::MinIntensity],
        };
    }
    let mut all = Parameter::ALL.to_vec();
    all.sort_by_key(|parameter| Reverse(parameter.spec().first_stage));
    all
}

struct Search<'a> {
    session: &'a mut Session,
    params: &'a Params,
    pixel: usize,
    unchanged: Analysis,
    before: Fate,
}

/// The fates seen of one parameter, by the bits of its value.
type Seen = BTreeMap<u64, Fate>;

impl Search<'_> {
    fn run<'g>(
        &mut self,
        (parameter, direction): (Parameter, Direction),
        guesses: impl Iterator<Item = &'g Guess>,
        observer: &impl WhatIfObserver,
    ) -> Result<Option<WhatIf>, Cancelled> {
        let now = self.unchanged.used.get(parameter);
        let ladder = Ladder::new(parameter, direction, now, &self.session.image);
        let mut seen = Seen::from([(now.to_bits(), self.before)]);
        let mut guessed: Vec<f64> = guesses.filter_map(|guess| ladder.beyond(guess.value)).collect();
        guessed.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        guessed.dedup();
        let mut bracket = None;
        for &value in &guessed {
            let after = self.fate(parameter, value, &mut seen, observer)?;
            if after == self.before {
                continue;
            }
            // The guess is right if the fate is unchanged one step before.
            let near = ladder.step_back(value);
            if self.fate(parameter, near, &mut seen, observer)? == self.before {
                return Ok(Some(self.told((parameter, direction), [near, value], after, true)));
            }
            bracket = Some([now, near]);
            break;
        }
        if bracket.is_none() {
            let mut last = now;
            for &rung in ladder.rungs() {
                if self.fate(parameter, rung, &mut seen, observer)? != self.before {
                    bracket = Some([last, rung]);
                    break;
                }
                last = rung;
            }
        }
        let Some([mut near, mut far]) = bracket else { return Ok(None) };
        while let Some(middle) = ladder.between(near, far) {
            if self.fate(parameter, middle, &mut seen, observer)? == self.before {
                near = middle;
            } else {
                far = middle;
            }
        }
        let after = self.fate(parameter, far, &mut seen, observer)?;
        Ok(Some(self.told((parameter, direction), [near, far], after, false)))
    }

    fn told(
        &self,
        (parameter, direction): (Parameter, Direction),
        [unchanged_at, at]: [f64; 2],
        after: Fate,
        predicted: bool,
    ) -> WhatIf {
        let now = self.unchanged.used.get(parameter);
        WhatIf { parameter, direction, now, at, unchanged_at, before: self.before, after, predicted }
    }

    /// The pixel's fate at a value of a parameter.
    fn fate(
        &mut self,
        parameter: Parameter,
        value: f64,
        seen: &mut Seen,
        observer: &impl WhatIfObserver,
    ) -> Result<Fate, Cancelled> {
        if let Some(&fate) = seen.get(&value.to_bits()) {
            return Ok(fate);
        }
        let mut params = *self.params;
        *params.slot(parameter) = Setting::Value(value);
        let analysis = self.session.run(&params, &mut Quiet(observer))?;
        let home = home(&self.unchanged.finals.labels, &analysis.finals.labels, self.pixel);
        let fate = Fate { home, kind: analysis.intrinsic.kinds[self.pixel] };
        seen.insert(value.to_bits(), fate);
        Ok(fate)
    }
}

/// Where a pixel of the label map `after` belongs, by the regions of `before`: the one with most of its region's pixels, the
/// first of equals.
fn home(before: &LabelMap, after: &LabelMap, pixel: usize) -> Home {
    let own = after[pixel];
    if own == UNASSIGNED {
        return Home::Nowhere;
    }
    let mut overlap: BTreeMap<RegionId, usize> = BTreeMap::new();
    for (&old, &new) in before.as_slice().iter().zip(after.as_slice()) {
        if new == own
            && let Some(old) = RegionId::from_label(old)
        {
            *overlap.entry(old).or_default() += 1;
        }
    }
    let most = overlap.into_iter().max_by_key(|&(region, pixels)| (pixels, Reverse(region)));
    most.map_or(Home::New, |(region, _)| Home::Region(region))
}

/// Passes only the question for cancellation on to the search's observer.
struct Quiet<'a, W>(&'a W);

impl<W: WhatIfObserver> Observer for Quiet<'_, W> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
