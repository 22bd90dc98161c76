//! The values of a parameter that a what-if search tries, and their spacing.

use super::Direction;
use crate::params::{Parameter, ParameterSpec};
use crate::photo::LinearImage;

/// Factors by which a parameter is multiplied (or divided) in turn.
const FACTORS: [f64; 6] = [1.1, 1.25, 1.5, 2.0, 3.0, 5.0];
/// Relative precision of the value at which a fate changes.
const PRECISION: f64 = 0.01;

/// Values of a parameter above or below its current value.
pub(super) struct ValueSteps {
    spec: ParameterSpec,
    direction: Direction,
    /// The current value.
    now: f64,
    /// Spacing of all values that are tried: the third significant digit of the current value, or 1.
    grid: f64,
    /// The farthest value that makes sense.
    limit: f64,
    /// The values to try, nearest to the current one first.
    values: Vec<f64>,
}

impl ValueSteps {
    pub(super) fn new(parameter: Parameter, direction: Direction, now: f64, image: &LinearImage) -> Self {
        let spec = parameter.spec();
        let limit = match (parameter, direction) {
            // No pixel is clipped by a threshold above the largest value of the picture.
            (Parameter::ClipThreshold, Direction::Up) => {
                largest_band(image).clamp(spec.range[0], spec.range[1]) * 1.01
            }
            (_, Direction::Up) => spec.range[1],
            (_, Direction::Down) => spec.range[0],
        };
        // A threshold that is off (infinite) starts from the largest value of the picture.
        let start = if now.is_finite() { now } else { largest_band(image) };
        // A factor leaves 0 at 0.
        let start = if direction == Direction::Up { start.max(spec.paper / 8.0) } else { start };
        let grid = if spec.whole { 1.0 } else { 10f64.powf(start.max(1e-3).log10().floor() - 2.0) };
        let mut steps = Self { spec, direction, now, grid, limit, values: Vec::new() };
        for factor in FACTORS {
            let value = if direction == Direction::Up { start * factor } else { start / factor };
            if let Some(value) = steps.beyond(value)
                && steps.values.last() != Some(&value)
            {
                steps.values.push(value);
            }
        }
        steps
    }

    /// The values to try, nearest to the current one first.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The nearest value of the grid that is at least as far from the current value as `value`, up to the limit; `None` for a
    /// value on the wrong side.
    pub(super) fn beyond(&self, value: f64) -> Option<f64> {
        let steps = value / self.grid;
        let snapped = match self.direction {
            Direction::Up => self.tidy(steps.ceil()).min(self.limit),
            Direction::Down => self.tidy(steps.floor()).max(self.limit),
        };
        let outward = match self.direction {
            Direction::Up => snapped > self.now && value <= self.limit * (1.0 + PRECISION),
            Direction::Down => snapped < self.now && value >= self.limit * (1.0 - PRECISION),
        };
        let inside = (self.spec.range[0]..=self.spec.range[1]).contains(&snapped);
        (outward && inside && (!self.spec.whole || snapped.fract() == 0.0)).then_some(snapped)
    }

    /// The next value of the grid towards the current value, or the current value.
    pub(super) fn step_back(&self, value: f64) -> f64 {
        let steps = (value / self.grid).round();
        match self.direction {
            Direction::Up => self.tidy(steps - 1.0).max(self.now),
            Direction::Down => self.tidy(steps + 1.0).min(self.now),
        }
    }

    /// A value of the grid in the middle between two values; `None` where the two differ by no more than the precision.
    pub(super) fn between(&self, near: f64, far: f64) -> Option<f64> {
        // A threshold that is off (infinite) lies above every value.
        let near = if near.is_finite() { near } else { far + 4.0 * self.grid.max(PRECISION * far) };
        let apart = (near - far).abs();
        if apart <= self.grid * 1.5 && self.spec.whole && apart <= 1.0 {
            return None;
        }
        if !self.spec.whole && apart <= self.grid.max(PRECISION * far.abs()) * 1.000_001 {
            return None;
        }
        let middle = self.tidy((f64::midpoint(near, far) / self.grid).round());
        let (low, high) = (near.min(far), near.max(far));
        (middle > low && middle < high).then_some(middle)
    }

    /// `steps` times the grid spacing, rounded to the nearest decimal fraction.
    fn tidy(&self, steps: f64) -> f64 {
        if self.grid >= 1.0 { steps * self.grid } else { steps / (1.0 / self.grid).round() }
    }
}

fn largest_band(image: &LinearImage) -> f64 {
    let largest = image.pixels.as_slice().iter().flatten().fold(0.0f32, |most, &band| most.max(band));
    f64::from(largest)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use proptest::prelude::*;

    fn image() -> LinearImage {
        LinearImage::new(Raster::filled(2, 2, [200.0, 90.0, 30.0]), None)
    }

    fn steps(parameter: Parameter, direction: Direction, now: f64) -> ValueSteps {
        ValueSteps::new(parameter, direction, now, &image())
    }

    #[test]
    fn values_go_outward_in_round_steps_and_end_at_the_limits_of_the_parameter() {
        assert_eq!(
            steps(Parameter::CylinderWidth, Direction::Up, 4.0).values(),
            [4.4, 5.0, 6.0, 8.0, 12.0, 20.0]
        );
        assert_eq!(steps(Parameter::WindowSize, Direction::Down, 10.0).values(), [9.0, 8.0, 6.0, 5.0, 3.0]);
        assert!(steps(Parameter::BloomDensity, Direction::Down, 1.0).values().is_empty());
        assert_eq!(steps(Parameter::MinIntensity, Direction::Up, 0.0).values().len(), 6);
        // The largest value of the picture is 200 counts.
        assert!(steps(Parameter::ClipThreshold, Direction::Up, 240.0).values().is_empty());
        assert_eq!(steps(Parameter::ClipThreshold, Direction::Down, f64::INFINITY).values()[0], 181.0);
    }

    proptest! {
        #[test]
        fn halving_ends_and_stays_between(
            which in 0..Parameter::ALL.len(), up: bool, now in 0.6f64..400.0, share in 0f64..1.0,
        ) {
            let parameter = Parameter::ALL[which];
            let spec = parameter.spec();
            let now = now.clamp(spec.range[0], spec.range[1]);
            let now = if spec.whole { now.round() } else { now };
            let direction = if up { Direction::Up } else { Direction::Down };
            let steps = steps(parameter, direction, now);
            let mut last = now;
            for &value in steps.values() {
                prop_assert!(if up { value > last } else { value < last }, "{last} {value}");
                prop_assert!((spec.range[0]..=spec.range[1]).contains(&value));
                let (mut near, mut far) = (last, value);
                let sought = near + share * (far - near);
                let mut halvings = 0;
                while let Some(middle) = steps.between(near, far) {
                    if (middle < sought) == up { near = middle } else { far = middle }
                    halvings += 1;
                    prop_assert!(halvings < 12, "{near} {far}");
                }
                last = value;
            }
        }
    }
}
