//! A parameter outside the values that it accepts, as a sentence that says the value, what was expected and what to do.

use super::method::Method;
use super::phoenix::PhoenixParameter;
use super::table::Parameter;

/// Most ambient light that may be given, counts a band.
pub(super) const MOST_AMBIENT: f64 = 200.0;
/// Least angle between the colors of two lamps, degrees: nearer colors are those of one lamp.
pub(crate) const LEAST_LAMPS_ANGLE_DEG: f64 = 1.0;

/// A parameter outside the values that it accepts.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InvalidParameter {
    /// A number outside its range.
    #[error("{} = {value}: expected `auto` or a {} from {} to {} {}", parameter.spec().name,
        if parameter.spec().whole { "whole number" } else { "number" },
        parameter.spec().range[0], parameter.spec().range[1], parameter.spec().unit)]
    Number {
        /// The parameter.
        parameter: Parameter,
        /// The value that the parameter does not accept.
        value: f64,
    },
    /// A parameter of Phoenix outside its range.
    #[error("phoenix {} = {value}: expected a whole number from {} to {} {}", parameter.name(), parameter.range()[0],
        parameter.range()[1], parameter.unit())]
    Phoenix {
        /// The parameter.
        parameter: PhoenixParameter,
        /// The value that the parameter does not accept.
        value: u32,
    },
    /// A light with a negative or infinite band, or with all bands 0.
    #[error("illuminant = {0:?}: expected `auto` or three numbers from 0 on, not all of them 0")]
    Illuminant([f64; 3]),
    /// A second lamp with a band that is not positive or not finite.
    #[error(
        "second_illuminant = {0:?}: expected `auto` or three numbers above 0, the color of the second lamp"
    )]
    SecondIlluminant([f64; 3]),
    /// A second lamp under a method that splits with one lamp.
    #[error("second_illuminant = {color:?} with method = {}: expected `auto`, as only the refined method splits with two lamps; set \
        method = refined or second_illuminant = auto", method.name())]
    SecondIlluminantMethod {
        /// The color of the second lamp.
        color: [f64; 3],
        /// The method.
        method: Method,
    },
    /// A second lamp of the color of the first light.
    #[error(
        "second_illuminant = {color:?}: expected a color at least {LEAST_LAMPS_ANGLE_DEG}\u{b0} from illuminant = {first:?}, it is \
        {angle_deg:.2}\u{b0} from that; set second_illuminant = auto where one lamp lights the scene"
    )]
    SecondIlluminantNear {
        /// The color of the second lamp.
        color: [f64; 3],
        /// The color of the first light.
        first: [f64; 3],
        /// The angle between both, degrees.
        angle_deg: f64,
    },
    /// Ambient light with a band outside its range.
    #[error("ambient = {0:?}: expected `auto`, `off` or three numbers from 0 to {MOST_AMBIENT} counts")]
    Ambient([f64; 3]),
}
