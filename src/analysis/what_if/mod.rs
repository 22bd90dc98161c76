//! What if: for each parameter, the nearest value at which a pixel's fate (its region and kind) changes.
//!
//! Where one threshold decided, the trace contains the compared number: a pixel 12.4 counts from an axis is claimed at a
//! cylinder width of 12.4/σ0. Such guesses are tried first. A guess can be wrong because lines are then fitted to other
//! pixels or another region grows first. Where no guess is right, the parameter is changed in increasing steps until the fate
//! changes, and the value is narrowed down by halving. Every value that is returned has been analyzed, and so has the nearest
//! value at which the fate is unchanged.
//!
//! The fate may change back at a farther value. A change between two steps of the search that is undone between the same two
//! steps is missed: "nearest" means the nearest value that was tried.

mod guess;
mod steps;
#[cfg(test)]
mod tests;

use super::{Analysis, Cancelled, Observer, Session};
use crate::params::{Parameter, Params, Setting};
use crate::raster::{LabelMap, PixelIndex, RegionId, UNASSIGNED};
use crate::trace::PixelKind;
use guess::{Guess, guesses};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use steps::ValueSteps;

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
    /// The pixel belongs to no region.
    Nowhere,
    /// Of all regions of the unchanged result, the pixel's region has most pixels in common with this one.
    Region(RegionId),
    /// The pixel's region has no pixel in common with a region of the unchanged result.
    New,
}

/// Direction in which a parameter is changed.
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
    /// Direction in which the parameter was changed.
    pub direction: Direction,
    /// Value of the parameter in the unchanged result, in the parameter's unit.
    pub now: f64,
    /// Value at which the fate is another.
    pub at: f64,
    /// The tried value nearest to [`WhatIf::at`], on the side of [`WhatIf::now`], at which the fate is unchanged.
    pub unchanged_at: f64,
    /// The pixel's fate in the unchanged result.
    pub before: Fate,
    /// The pixel's fate at [`WhatIf::at`].
    pub after: Fate,
    /// Whether the value follows from a recorded threshold; else it was found by search.
    pub predicted: bool,
}

/// Receives the progress of a search, and may stop the search.
pub trait WhatIfObserver: Sync {
    /// `done` of `of` searches are finished; there is one search for each parameter and direction.
    fn progress(&mut self, _done: usize, _of: usize) {}
    /// A value was found at which the fate changes.
    fn found(&mut self, _what_if: &WhatIf) {}
    /// Whether to stop the search. The function is called often, from any thread; the search stops soon after it returns true.
    fn cancelled(&self) -> bool {
        false
    }
}

/// An observer that observes nothing and never cancels.
impl WhatIfObserver for () {}

/// For each parameter and direction, the nearest value found at which the pixel's fate is another, in the order of table 6,
/// down before up. A parameter without such a value is left out. The list is empty for a pixel outside the picture.
///
/// The search runs in the area that `session` is restricted to. Afterwards the session contains the outputs of the last value
/// tried: pass a session that no other code uses.
///
/// # Errors
/// [`Cancelled`] when the observer cancels.
pub fn what_if(
    session: &mut Session,
    params: &Params,
    pixel: PixelIndex,
    observer: &mut impl WhatIfObserver,
) -> Result<Vec<WhatIf>, Cancelled> {
    if pixel.index() >= session.image.pixels.len() {
        return Ok(Vec::new());
    }
    let (analysis, trace) = session.run_traced(params, &mut CancellationOnly(observer))?;
    let history = analysis.pixel_history(&trace, pixel);
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
            if let Some(what_if) = search.run(parameter, direction, own, observer)? {
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

/// The parameters that can change the pixel's fate, those of late stages first: the stages before them need not run again.
fn movable(params: &Params, analysis: &Analysis, pixel: usize) -> Vec<Parameter> {
    let masks = &analysis.masks;
    if masks.invalid(pixel) || masks.outside(pixel) {
        return Vec::new();
    }
    if masks.dark(pixel) {
        // No stage reads a dark pixel; an automatic minimal intensity is proportional to the noise.
        return match params.min_intensity {
            Setting::Auto => vec![Parameter::CameraNoise, Parameter::MinIntensity],
            Setting::Value(_) => vec![Parameter::MinIntensity],
        };
    }
    // The scale is no threshold that the pixel's color lies above or below: at another scale there is another picture.
    let mut all: Vec<Parameter> =
        Parameter::ALL.into_iter().filter(|&parameter| parameter != Parameter::Scale).collect();
    all.sort_by_key(|parameter| Reverse(parameter.spec().first_stage));
    all
}

/// The search for one pixel.
struct Search<'a> {
    session: &'a mut Session,
    params: &'a Params,
    pixel: usize,
    unchanged: Analysis,
    before: Fate,
}

/// The pixel's fate at each analyzed value of one parameter, by the bits of the value.
type Seen = BTreeMap<u64, Fate>;

impl Search<'_> {
    /// The nearest value of a parameter in one direction at which the fate changes; `None` where no value tried changes it.
    fn run<'g>(
        &mut self,
        parameter: Parameter,
        direction: Direction,
        guesses: impl Iterator<Item = &'g Guess>,
        observer: &impl WhatIfObserver,
    ) -> Result<Option<WhatIf>, Cancelled> {
        let now = self.unchanged.used.get(parameter);
        let steps = ValueSteps::new(parameter, direction, now, &self.session.image);
        let mut seen = Seen::from([(now.to_bits(), self.before)]);
        let mut guessed: Vec<f64> = guesses.filter_map(|guess| steps.beyond(guess.value)).collect();
        guessed.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        guessed.dedup();
        // Two values between which the fate changes.
        let mut bracket = None;
        for &value in &guessed {
            let after = self.fate(parameter, value, &mut seen, observer)?;
            if after == self.before {
                continue;
            }
            // The guess is right if the fate is unchanged one step before.
            let near = steps.step_back(value);
            if self.fate(parameter, near, &mut seen, observer)? == self.before {
                return Ok(Some(self.what_if(parameter, direction, [near, value], after, true)));
            }
            bracket = Some([now, near]);
            break;
        }
        if bracket.is_none() {
            let mut last = now;
            for &value in steps.values() {
                if self.fate(parameter, value, &mut seen, observer)? != self.before {
                    bracket = Some([last, value]);
                    break;
                }
                last = value;
            }
        }
        let Some([mut near, mut far]) = bracket else { return Ok(None) };
        while let Some(middle) = steps.between(near, far) {
            if self.fate(parameter, middle, &mut seen, observer)? == self.before {
                near = middle;
            } else {
                far = middle;
            }
        }
        let after = self.fate(parameter, far, &mut seen, observer)?;
        Ok(Some(self.what_if(parameter, direction, [near, far], after, false)))
    }

    fn what_if(
        &self,
        parameter: Parameter,
        direction: Direction,
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
        let analysis = self.session.run(&params, &mut CancellationOnly(observer))?;
        let home = home(&self.unchanged.finals.labels, &analysis.finals.labels, self.pixel);
        let fate = Fate { home, kind: analysis.intrinsic.kinds[self.pixel] };
        seen.insert(value.to_bits(), fate);
        Ok(fate)
    }
}

/// The region of a pixel in the label map `after`, named by the region of `before` that has most pixels in common with it (the
/// smallest number among equals).
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

/// The observer of the search as the observer of a run: only cancellation is passed on.
struct CancellationOnly<'a, W>(&'a W);

impl<W: WhatIfObserver> Observer for CancellationOnly<'_, W> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
