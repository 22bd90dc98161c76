//! The clusters of colors that a step of the classification (section 5.2.1) or of the merging (section 5.2.2) tested, in the plane of the
//! two largest axes of all their colors, with the limits that decide the class.

use super::{Limits, Meaning, Point, ThresholdTest, step_pixels};
use crate::color::{ClusterTest, Moments, Trial, Vec3, principal_axes, rgb, vec3};
use crate::photo::WorkingPicture;
use crate::raster::PixelIndex;
use crate::trace::{Class, Event, MergeTried, Replay, Step, WindowsLaid};

/// Number of standard deviations at which ellipses are drawn.
pub const ELLIPSE_DEVIATIONS: f32 = 2.0;
/// Largest number of points of a cluster.
const MOST_POINTS: usize = 5_000;

/// The clusters of a step in a plane. Coordinates are counts from the mean of all colors, along the two largest axes.
#[derive(Clone, Debug, PartialEq)]
pub struct ClusterPlane {
    /// What was tested, and the verdict.
    pub title: String,
    /// The window; or both areas, and their union at the end.
    pub clusters: Vec<Cluster>,
    /// The axes of all colors, unit, the largest first.
    pub axes: [Point; 2],
    /// For the first and the second axis, the largest standard deviation that the noise explains, counts; none where the test was not
    /// made. Below the first limit the cluster is a point, below the second a line.
    pub limits: [Option<f32>; 2],
    /// Every test that was made, in order.
    pub tests: Vec<ThresholdTest>,
    /// The class of all colors; none for too few.
    pub class: Option<Class>,
}

/// A cluster of colors.
#[derive(Clone, Debug, PartialEq)]
pub struct Cluster {
    /// What the step did with the cluster; none for the union of both areas.
    pub meaning: Option<Meaning>,
    /// The colors: place in the plane, color as measured in counts, and pixel of the photograph.
    pub points: Vec<([f32; 2], Point, PixelIndex)>,
    /// Mean, counts.
    pub mean: [f32; 2],
    /// The two axes of the ellipse of one standard deviation, counts.
    pub ellipse: [[f32; 2]; 2],
}

/// The clusters that the step taken last tested; none where that step is about no window and no pair of areas.
pub fn cluster_plane(replay: &Replay, working: &WorkingPicture) -> Option<ClusterPlane> {
    match replay.last()? {
        Step::Event(Event::WindowClassified(found)) => {
            let class = found.class;
            let verdict = class.map_or("too few for a class", Class::name);
            let title = format!("window {}: {verdict}", found.window);
            let groups = pixels_at(replay, working).into_iter().map(|pixels| (None, pixels)).collect();
            Some(plane_of(replay, working, title, groups, class))
        }
        Step::Event(Event::MergeTried(tried)) => {
            let MergeTried { into, from, class, union, .. } = tried;
            let is_merged = class == union;
            let verdict = if is_merged { "they merge" } else { "they stay apart" };
            let title = format!("areas {into} and {from}, union {}: {verdict}", union.name());
            // Before the step, the areas are apart even where the step merged them.
            let mut before = replay.clone();
            before.back();
            let areas = before.grid()?.areas();
            let second = if is_merged { Meaning::JustTaken } else { Meaning::Refused };
            let group = |window: &u32, meaning: Meaning| {
                let root = *areas.get(*window as usize)?;
                Some((Some(meaning), windows_of(&before, working, |at| areas.get(at) == Some(&root))))
            };
            let groups = [group(into, Meaning::Taken)?, group(from, second)?].into();
            Some(plane_of(replay, working, title, groups, Some(*union)))
        }
        _ => None,
    }
}

/// The pixels of the window at the cursor.
fn pixels_at(replay: &Replay, working: &WorkingPicture) -> Vec<Vec<u32>> {
    let groups = step_pixels(replay, None, &working.image.pixels, &working.masks, usize::MAX);
    groups.into_iter().map(|(_, pixels)| pixels).collect()
}

/// The pixels of the windows of the grid that are wanted.
fn windows_of(replay: &Replay, working: &WorkingPicture, wanted: impl Fn(usize) -> bool) -> Vec<u32> {
    let Some(grid) = replay.grid() else { return Vec::new() };
    let width = working.image.pixels.width();
    (0..working.image.pixels.len())
        .filter(|&pixel| wanted(grid.window_of(pixel, width)))
        .map(|pixel| pixel as u32)
        .collect()
}

fn plane_of(
    replay: &Replay,
    working: &WorkingPicture,
    title: String,
    groups: Vec<(Option<Meaning>, Vec<u32>)>,
    class: Option<Class>,
) -> ClusterPlane {
    let laid: Option<&WindowsLaid> = replay.grid().map(|grid| &grid.laid);
    let is_counted = |pixel: &u32| {
        let pixel = *pixel as usize;
        let refined = laid.is_some_and(|laid| laid.tail_test);
        let masks = &working.masks;
        if refined { masks.usable(pixel) } else { !masks.invalid(pixel) && !masks.outside(pixel) }
    };
    let groups: Vec<(Option<Meaning>, Vec<u32>)> = groups
        .into_iter()
        .map(|(meaning, pixels)| (meaning, pixels.into_iter().filter(&is_counted).collect()))
        .collect();
    let color = |pixel: u32| working.image.pixels[pixel as usize];
    let all: Moments =
        groups.iter().flat_map(|(_, pixels)| pixels.iter().map(|&pixel| color(pixel))).collect();
    let (variances, axes) = principal_axes(&all.covariance());
    let projection = Projection { mean: all.mean(), axes: [axes[0], axes[1]] };
    let several = groups.len() > 1;
    let mut clusters: Vec<Cluster> = groups
        .iter()
        .map(|(meaning, pixels)| {
            let moments: Moments = pixels.iter().map(|&pixel| color(pixel)).collect();
            let points = super::sampled(pixels, MOST_POINTS).map(|pixel| {
                let middle = PixelIndex::from_index(working.blocks.middle(pixel as usize));
                (projection.place(color(pixel)), color(pixel), middle)
            });
            projection.cluster(*meaning, points.collect(), &moments)
        })
        .collect();
    if several {
        clusters.push(projection.cluster(None, Vec::new(), &all));
    }
    let trials = laid.map_or_else(Vec::new, |laid| {
        ClusterTest::new(laid.camera_noise, laid.tail_test).trials(all.n, variances)
    });
    let freedom = (all.n - 1.0).max(1.0);
    let limit = |axis: usize| trials.get(axis).map(|trial: &Trial| (trial.limit / freedom).sqrt() as f32);
    let limits = [limit(0), limit(1)];
    let tests = trials.iter().map(|trial| trial_test(trial, freedom, laid)).collect();
    ClusterPlane { title, clusters, axes: projection.axes.map(|axis| rgb(&axis)), limits, tests, class }
}

/// A χ² test as standard deviation and limit, counts.
fn trial_test(trial: &Trial, freedom: f64, laid: Option<&WindowsLaid>) -> ThresholdTest {
    let is_tail_test = laid.is_some_and(|laid| laid.tail_test);
    let name = match (is_tail_test, trial.directions) {
        (true, 0) => "deviation: a point",
        (true, 1) => "beyond the 1st axis: a line",
        (true, _) => "beyond the 2nd axis: a plane",
        (false, 0) => "along the 1st axis: a point",
        (false, 1) => "along the 2nd axis: a line",
        (false, _) => "along the 3rd axis: a plane",
    };
    ThresholdTest {
        name,
        value: (trial.spread / freedom).sqrt(),
        limits: Limits::AtMost((trial.limit / freedom).sqrt()),
        unit: "counts",
        passed: trial.is_noise(),
        tip: "Standard deviation against the largest that noise explains; the first test that noise explains gives the class, \
              and none of them a volume (section 5.2.1, table 1).",
    }
}

/// The plane of two axes through a mean.
struct Projection {
    mean: Vec3,
    axes: [Vec3; 2],
}

impl Projection {
    fn place(&self, color: [f32; 3]) -> [f32; 2] {
        let off = vec3(color) - self.mean;
        self.axes.map(|axis| axis.dot(&off) as f32)
    }

    fn cluster(
        &self,
        meaning: Option<Meaning>,
        points: Vec<([f32; 2], Point, PixelIndex)>,
        moments: &Moments,
    ) -> Cluster {
        let covariance = moments.covariance();
        let [a, b] = self.axes;
        let (aa, ab, bb) = ((covariance * a).dot(&a), (covariance * a).dot(&b), (covariance * b).dot(&b));
        let mean = if moments.n > 0.0 { self.place(rgb(&moments.mean())) } else { [0.0; 2] };
        Cluster { meaning, points, mean, ellipse: ellipse_axes(aa, ab, bb) }
    }
}

/// The axes of the ellipse of one standard deviation of a covariance matrix with these entries, counts.
fn ellipse_axes(aa: f64, ab: f64, bb: f64) -> [[f32; 2]; 2] {
    let angle = 0.5 * (2.0 * ab).atan2(aa - bb);
    let half = (0.25 * (aa - bb).powi(2) + ab * ab).sqrt();
    let middle = 0.5 * (aa + bb);
    let [long, short] = [middle + half, middle - half].map(|variance| variance.max(0.0).sqrt());
    let (sin, cos) = angle.sin_cos();
    [[long * cos, long * sin], [-short * sin, short * cos]].map(|axis| axis.map(|counts| counts as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::tiny;
    use std::sync::Arc;

    fn replay_at(wanted: impl Fn(&Event) -> bool) -> Replay {
        let shown = tiny();
        let trace = shown.trace().unwrap();
        let (step, _) = trace.events().find(|(_, event)| wanted(event)).unwrap();
        let mut replay = Replay::new(Arc::clone(trace));
        replay.seek(step + 1);
        replay
    }

    #[test]
    fn the_ellipse_of_a_diagonal_covariance_has_its_deviations() {
        let [long, short] = ellipse_axes(9.0, 0.0, 4.0);
        assert!((long[0] - 3.0).abs() < 1e-5 && long[1].abs() < 1e-5, "{long:?}");
        assert!((short[1] - 2.0).abs() < 1e-5 && short[0].abs() < 1e-5, "{short:?}");
        let [long, _] = ellipse_axes(4.0, 0.0, 9.0);
        assert!((long[1].abs() - 3.0).abs() < 1e-5, "{long:?}");
    }

    #[test]
    fn a_window_has_one_cluster_and_the_tests_of_its_class() {
        let shown = tiny();
        for (class, tests) in [(Class::Point, 1), (Class::Line, 2), (Class::Plane, 3)] {
            let replay = replay_at(
                |event| matches!(event, Event::WindowClassified(found) if found.class == Some(class)),
            );
            let plane = cluster_plane(&replay, &shown.analysis.working).unwrap();
            assert_eq!((plane.clusters.len(), plane.class), (1, Some(class)));
            assert_eq!(plane.tests.len(), tests, "{class:?}: {:?}", plane.tests);
            assert!(plane.tests.last().unwrap().passed && !plane.clusters[0].points.is_empty());
        }
    }

    #[test]
    fn a_pair_of_areas_has_both_clusters_and_their_union_whatever_the_verdict() {
        let shown = tiny();
        for merged in [true, false] {
            let replay = replay_at(
                |event| matches!(event, Event::MergeTried(tried) if (tried.class == tried.union) == merged),
            );
            let plane = cluster_plane(&replay, &shown.analysis.working).unwrap();
            let meanings: Vec<Option<Meaning>> =
                plane.clusters.iter().map(|cluster| cluster.meaning).collect();
            let second = if merged { Meaning::JustTaken } else { Meaning::Refused };
            assert_eq!(meanings, [Some(Meaning::Taken), Some(second), None]);
            assert!(plane.clusters[..2].iter().all(|cluster| !cluster.points.is_empty()));
        }
    }
}
