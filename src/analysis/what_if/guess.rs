//! Parameter values at which a pixel's fate may change, computed from the recorded decisions about the pixel.

use super::Direction;
use crate::params::{Parameter, Params, UsedParams};
use crate::reflection::{SliceBound, SliceMiss};
use crate::trace::{Barrier, HistoryEntry, HistoryKind, MaskVerdict, PassedOver, Reach, Release};

/// A parameter value at which one recorded threshold would decide the other way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Guess {
    pub(super) parameter: Parameter,
    pub(super) direction: Direction,
    pub(super) value: f64,
}

/// Relative distance of a guess beyond the threshold: thresholds are compared in the precision of pixels.
const BEYOND: f64 = 1e-6;

/// The guesses that follow from a pixel's history.
pub(super) fn guesses(history: &[HistoryEntry], params: &Params, used: &UsedParams) -> Vec<Guess> {
    let mut found =
        Guesses { used, noise_moves_width: params.cylinder_width.value().is_some(), list: Vec::new() };
    for entry in history {
        found.add_of_entry(&entry.what);
    }
    found.list
}

struct Guesses<'a> {
    used: &'a UsedParams,
    /// Whether the cylinder's radius is proportional to the camera noise (the width in σ0 is set).
    noise_moves_width: bool,
    list: Vec<Guess>,
}

impl Guesses<'_> {
    fn up(&mut self, parameter: Parameter, value: f64) {
        let value = value * (1.0 + BEYOND);
        self.list.push(Guess { parameter, direction: Direction::Up, value });
    }

    fn down(&mut self, parameter: Parameter, value: f64) {
        let value = value * (1.0 - BEYOND);
        self.list.push(Guess { parameter, direction: Direction::Down, value });
    }

    /// Adds guesses at which the cylinder's radius is just above `distance`, counts.
    fn wider(&mut self, distance: f64) {
        self.up(Parameter::CylinderWidth, distance / self.used.camera_noise);
        if self.noise_moves_width {
            self.up(Parameter::CameraNoise, distance / self.used.cylinder_width);
        }
    }

    /// Adds the guesses that follow from one entry of the history.
    fn add_of_entry(&mut self, what: &HistoryKind) {
        match what {
            HistoryKind::Masked(verdict) => self.add_of_mask(verdict),
            HistoryKind::Seeded { reach, .. } | HistoryKind::Claimed { reach, .. } => {
                self.add_of_reach(*reach);
            }
            HistoryKind::Released { why: Release::Refit { distance, .. }, .. }
            | HistoryKind::Refused { barrier: Barrier::Cylinder { distance, .. }, .. } => {
                self.wider(f64::from(*distance));
            }
            HistoryKind::Refused { barrier: Barrier::Slice(SliceMiss { bound, value, .. }), .. } => {
                match bound {
                    SliceBound::Height => {
                        self.up(Parameter::SliceWidth, f64::from(*value) / self.used.camera_noise);
                    }
                    SliceBound::Surface => self.wider(f64::from(-*value)),
                    SliceBound::Black | SliceBound::MatteEnd => {}
                }
            }
            HistoryKind::AreaPassedOver {
                pixels,
                reason: PassedOver::TooSmall | PassedOver::Consumed,
                ..
            } => {
                self.list.push(Guess {
                    parameter: Parameter::MinArea,
                    direction: Direction::Down,
                    value: f64::from(*pixels),
                });
            }
            HistoryKind::AreaChosen { pixels, .. } => self.list.push(Guess {
                parameter: Parameter::MinArea,
                direction: Direction::Up,
                value: f64::from(*pixels) + 1.0,
            }),
            _ => {}
        }
    }

    fn add_of_mask(&mut self, verdict: &MaskVerdict) {
        match *verdict {
            MaskVerdict::Believed { brightness: [from_black, _], largest: [largest, _] } => {
                self.up(Parameter::MinIntensity, from_black);
                // A band at the threshold is clipped.
                let (parameter, direction) = (Parameter::ClipThreshold, Direction::Down);
                self.list.push(Guess { parameter, direction, value: largest });
            }
            MaskVerdict::Dark { brightness: [from_black, _] } => {
                self.down(Parameter::MinIntensity, from_black);
            }
            MaskVerdict::Clipped { largest: [largest, _] } => self.up(Parameter::ClipThreshold, largest),
            MaskVerdict::Bloomed { neighbors: [clipped, _] } => self.list.push(Guess {
                parameter: Parameter::BloomDensity,
                direction: Direction::Up,
                value: clipped as f64 + 1.0,
            }),
            MaskVerdict::Outside | MaskVerdict::Invalid | MaskVerdict::ClippedObject { .. } => {}
        }
    }

    fn add_of_reach(&mut self, reach: Reach) {
        let noise = self.used.camera_noise;
        match reach {
            Reach::Axis { distance, .. } => self.down(Parameter::CylinderWidth, f64::from(distance) / noise),
            Reach::Plane { distance, .. } => self.down(Parameter::SliceWidth, f64::from(distance) / noise),
            Reach::Brightness { .. } => {}
        }
    }
}
