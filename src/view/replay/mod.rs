//! The data that panels show at the debugger's cursor in a trace.

mod growth;
mod growth_pixels;
mod instant;
mod names;
mod rings;
mod rows;
mod skewed_t_view;
mod step_pixels;
mod timeline_axis;
mod watch;
mod why;

pub use growth::{Growth, growth, rings};
pub use growth_pixels::{
    candidate_pixels, growth_pixels, measured_and_ignored, pixels_of_region, sampled, test_at_cursor,
};
pub use instant::{Instant, InstantView, RegionsView, RolesView, WindowsView, cursor_place};
pub use names::RegionNames;
pub use rows::{HypothesisRow, Status, WindowCounts, hypothesis_rows, window_counts};
pub use skewed_t_view::{SkewedTView, candidate_name, candidate_reach, skewed_t_view};
pub use step_pixels::{Role, StepPixels, step_pixels};
pub use timeline_axis::{TimelineAxis, TimelineSection, timeline_density};
pub use watch::{AxisDistance, CurrentHypothesis, Watch, WatchedPixel, watch};
pub use why::{Why, WhySentence, why};
