//! The words in which decisions are recorded.

/// Class of a colour cluster by its number of significant eigenvalues (section 5.2.1, table 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// None: no variation beyond the noise.
    Point,
    /// One: matte or highlight line.
    Line,
    /// Two: a dichromatic plane, or two objects.
    Plane,
    /// Three: clipping, or several objects.
    Volume,
}
