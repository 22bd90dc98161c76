//! The contents of the panels as plain data: layers, histogram, solids, plane points, profiles, statistics, and the state of the
//! analysis at an instant of a trace.
//!
//! Everything here is computed from a photograph, a result or a trace, without application state and without a screen.

mod accuracy;
mod axes;
mod cluster_plane;
mod colors;
mod compare;
mod compare_figures;
mod curves;
mod elsewhere;
mod elsewhere_paths;
mod figure_words;
mod geometry;
mod histogram;
mod inspection;
mod item;
mod lamps;
mod layers;
mod legend_entry;
pub mod marking;
mod meaning;
mod named_marks;
mod owners;
mod picture;
mod pixel_amounts;
mod pixel_reading;
mod plane_marks;
mod plane_points;
mod profile;
mod replay;
mod runs;
pub(crate) mod selected;
mod settings;
mod shapes;
mod snapshot;
mod solid;
mod space;
mod statistics;
mod table;
#[cfg(test)]
pub(crate) mod testing;
mod vector;
mod verdict;

pub use accuracy::{Accuracy, RegionAccuracy};
pub use axes::{Axis, Tick};
pub use cluster_plane::{Cluster, ClusterPlane, ELLIPSE_DEVIATIONS, cluster_plane};
pub(crate) use colors::{colors_with_further_regions, region_colors};
pub use compare::{
    BodyChange, ComparedRegion, Comparison, PixelChanges, RegionChange, SettingChange, compare,
    setting_changes,
};
pub use compare_figures::Figure;
pub use elsewhere::{Elsewhere, ElsewherePixel, Held, HeldFigure, held_against, label_count};
pub use elsewhere_paths::{ElsewhereKind, ElsewherePaths};
pub use figure_words::{FigureWords, setting_meaning};
pub use geometry::{GeometrySettings, SPHERE_DISTANCES, meeting_share, sphere_colors, sphere_in_plane};
pub use histogram::{BINS_PER_BAND, ColorBin, Histogram, UniqueColor};
pub use inspection::{
    Inspection, Limits, ThresholdTest, Tone, candidate_tests, histograms_at_cursor, inspect_beginning,
    inspect_item, inspect_item_at, inspect_marked, inspect_step, step_verdict,
};
pub use item::{Item, Selection};
pub use lamps::{Lamp, LampOfPixels};
pub(crate) use layers::layer_floats;
pub use layers::{
    Against, DIFFERENCE_COUNTS, Fill, Layer, LayerNeed, LayerPixels, Look, class_entries, instant_legend,
    legend, marks, paint, paint_against, paint_instant, pyramid, reason_entry,
};
pub use legend_entry::LegendEntry;
pub use meaning::{ACCENT, Meaning};
pub use named_marks::{NamedMark, NamedMarks};
pub use owners::{OwnerKind, OwnersAtCursor};
pub use picture::{Origin, Picture};
pub use pixel_amounts::{Amounts, PixelAmounts};
pub use pixel_reading::{AnalyzedPixel, PixelReading};
pub use plane_marks::plane_mask;
pub use plane_points::{
    MOST_PLANE_POINTS, PlaneBranch, PlanePixel, RegionPlane, growing_plane, region_plane, test_plane,
};
pub(crate) use profile::profile_csv;
pub use profile::{ProfileSample, profile, profile_ends};
pub use replay::{
    AxisDistance, CurrentHypothesis, Growth, HypothesisRow, Instant, InstantView, RegionNames, RegionsView,
    Role, RolesView, SkewedTView, Status, StepPixels, TimelineAxis, TimelineSection, Watch, WatchedPixel,
    Why, WhySentence, WindowCounts, WindowsView, candidate_name, candidate_reach, cursor_place, growth,
    hypothesis_rows, sampled, skewed_t_view, step_pixels, test_at_cursor, timeline_density, watch, why,
    window_counts,
};
pub(crate) use replay::{candidate_pixels, growth_pixels, measured_and_ignored, pixels_of_region, rings};
pub(crate) use runs::MaskRuns;
pub use settings::{
    Arrangement, ArrangementKind, ColorBy, ColorSpace, CubeSettings, ImageSettings, PlaneSettings,
    ProfileLine, Theme, Tool,
};
pub use shapes::{
    CursorShapes, RegionShapes, cluster_ellipsoid, cursor_shapes, dark_sphere, illuminant_line,
    region_shapes, second_lamp_line, window_ellipsoid,
};
pub use snapshot::ResultSnapshot;
pub(crate) use snapshot::{best_overlap, best_overlaps};
pub use solid::{Mesh, Solid};
pub use statistics::{Band, Bounds, STATISTICS_BINS, Statistics, statistics, statistics_of};
pub use table::{Separator, regions_text};
pub use vector::Point;
pub use verdict::{Clause, ClauseSubject, WIDE_INTERVAL_DEG, verdict};
