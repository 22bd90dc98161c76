//! What the panels show at the debugger's cursor in a trace.

mod growth;
mod instant;
mod looked_at;
mod names;
mod rings;
mod rows;
mod skewed_t_view;
mod timeline_axis;
mod tracks;
mod watch;
mod why;

pub use growth::{Growth, growth, rings};
pub use instant::{Instant, InstantView, RegionsView, RolesView, WindowsView, cursor_place};
pub use looked_at::{LookedAt, Role, looked_at};
pub use names::RegionNames;
pub use rows::{HypothesisRow, Status, WindowCounts, hypothesis_rows, window_counts};
pub use skewed_t_view::{Check, SkewedTView, candidate_name, candidate_reach, skewed_t_view};
pub use timeline_axis::{TimelineAxis, TimelineSection, timeline_density};
pub use tracks::{candidate_pixels, measured_and_ignored, pixels_of_region, sampled, test_at_cursor, tracks};
pub use watch::{AxisDistance, Current, Watch, WatchedPixel, watch};
pub use why::{Account, Why, why};
