//! A measurement beside its limit.

/// A measured value and its limit, in one unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured<T> {
    /// The measured value.
    pub value: T,
    /// The limit that decided: the value had to stay below it, or reach it, as the field's documentation says.
    pub limit: T,
}

impl<T> Measured<T> {
    /// A value beside its limit.
    pub const fn new(value: T, limit: T) -> Self {
        Self { value, limit }
    }
}
