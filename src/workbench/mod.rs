//! The application without a screen.
//!
//! A [`State`] is all there is to show. A [`Command`] is the only way to change it, and [`reduce()`] the only function that
//! does; it is pure but for the [`Effect`]s it asks for, and is tested without a window. A [`Workbench`] carries the effects
//! out: on a named worker where the newest request wins, or inline in tests. Panels read the state and return commands.

mod accuracy;
mod analyst;
mod axes;
mod colours;
mod command;
mod command_line;
mod compare;
mod curves;
mod debugger;
mod desk;
mod document;
mod histogram;
mod inquiry;
mod item;
mod jobs;
mod layers;
pub mod marking;
mod picture;
mod plane_points;
mod profile;
mod read;
mod reduce;
mod runs;
mod selected;
mod settings;
mod shapes;
mod shown;
mod solid;
mod space;
mod state;
mod statistics;
mod table;
#[cfg(test)]
mod testing;
mod vector;
mod view;
mod workspace;
mod write;

pub use accuracy::{Accuracy, RegionAccuracy};
pub use analyst::Request;
pub use axes::{Axis, Tick};
pub use command::{Combine, Command, Gesture};
pub use command_line::analyze_call;
pub use compare::{BodyChange, Comparison, Fate, Figure, PixelFates, RegionFate, SettingChange, compare};
pub use debugger::{
    Account, AxisDistance, Breakpoint, CandidateCheck, Condition, Current, DebugCommand, DebugSettings,
    Debugger, Difference, Direction, Goal, Grain, Growth, RegionNames, SavedClass, TimelineAxis,
    TimelineSection, Watch, WatchedPixel, Why, growth, timeline_density, watch, why,
};
pub use debugger::{
    Check, HypothesisRow, Instant, InstantView, LookedAt, Role, Status, Tee, WindowCounts, candidate_name,
    candidate_pixels, candidate_reach, cursor_place, hypothesis_rows, looked_at, measured_and_ignored,
    pixels_of_region, sampled, tee, test_at_cursor, tracks, window_counts,
};
pub use desk::{Executor, Workbench};
pub use document::{Document, History};
pub use histogram::{BINS_PER_BAND, ColourBin, Histogram, UniqueColour};
pub use inquiry::{Ask, Asked, Inquiry, InquiryNews};
pub use item::{Item, Selection};
pub use jobs::{Export, Job, JobState};
pub use layers::{
    ACCENT, DIFFERENCE_COUNTS, LegendEntry, Look, beside_colour, class_entries, instant_legend, legend,
    marks, paint, paint_instant, pyramid,
};
pub use picture::{Origin, Picture};
pub use plane_points::{
    MOST_PLANE_POINTS, PlaneBranch, PlanePixel, RegionPlane, growing_plane, region_plane, test_plane,
};
pub use profile::{ProfileSample, profile, profile_csv, profile_ends};
pub use reduce::{Effect, reduce};
pub use runs::MaskRuns;
pub use settings::Settings;
pub use shapes::{
    CursorShapes, PlaneDirections, RegionShapes, cluster_ellipsoid, cursor_shapes, dark_sphere,
    illuminant_line, plane_directions, region_shapes, window_ellipsoid,
};
pub use shown::Shown;
pub use solid::{Mesh, Solid};
pub use state::{Notice, Severity, State};
pub use statistics::{Band, Bounds, STATISTICS_BINS, Statistics, statistics, statistics_of};
pub use table::regions_text;
pub use vector::Point;
pub use view::{
    Arrangement, ColourBy, ColourSpace, CubeSettings, Fill, ImageSettings, Layer, PlaneSettings, ProfileLine,
    Theme, Tool, View,
};
pub use workspace::Workspace;
