//! The plane view: the pixels of a region by their amounts of body and surface reflection, the skewed T of figure 2.

mod cursor;

pub use cursor::{growing_plane, test_plane};

use super::shapes::{across, hypothesis, starts};
use super::{Meaning, Point, ResultSnapshot};
use crate::color::{Vec3, rgb};
use crate::raster::{LabelMap, PixelIndex, RegionId};
use crate::reflection::{Components, ReflectionTransform};
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Largest number of points of a region. In a region with more pixels each point stands for the pixels of a cell.
pub const MOST_PLANE_POINTS: usize = 20_000;
/// Cells of the finest grid along each side; a power of two.
const CELLS: usize = 1024;
/// Number of kinds of pixels; each kind has cells of its own.
const KINDS: usize = 5;

/// A region in its dichromatic plane.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionPlane {
    /// The region; none at a cursor where nothing is left of the hypothesis in the result.
    pub region: Option<RegionId>,
    /// C_b, unit: the direction of m_b.
    pub body: Point,
    /// C_s, unit: the direction of m_s. Without a plane, a direction across the matte line.
    pub surface: Point,
    /// Whether the region has a dichromatic plane, so that m_s is an amount of surface reflection.
    pub has_plane: bool,
    /// Angle between both directions, degrees.
    pub angle_deg: f32,
    /// The pixels of the region in row order, or their cells in the order of the cells.
    pub points: Vec<PlanePixel>,
    /// m_b of the brightest matte point, counts.
    pub matte_length: f32,
    /// The highlight lines, the strongest first; none without a plane.
    pub branches: Vec<PlaneBranch>,
    /// Distance from the plane within which the slice claims colors, counts.
    pub slice_half_width: f32,
    /// Radius of the cylinder around the matte line, counts.
    pub radius: f32,
    /// Smallest and largest m_b and m_s of the points, counts.
    pub extent: [[f32; 2]; 2],
    transform: ReflectionTransform,
    /// The color from which the amounts are measured, counts: black, or the ambient light.
    origin: Point,
}

/// A highlight line in a dichromatic plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneBranch {
    /// m_b of the point where the line leaves the matte line, counts.
    pub meeting_point: f32,
    /// m_s of the brightest highlight pixel of the line, counts; 0 without one.
    pub length: f32,
}

/// A pixel, or the pixels of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePixel {
    /// m_b, counts; the mean of a cell.
    pub body: f32,
    /// m_s, counts; the mean of a cell.
    pub surface: f32,
    /// The color as measured, counts; the mean of a cell.
    pub color: Point,
    /// Kind of the pixels; all pixels of a cell are of one kind.
    pub kind: PixelKind,
    /// What the step at the debugger's cursor did with the pixel; none in a result.
    pub meaning: Option<Meaning>,
    /// The pixel, or the first pixel of the cell.
    pub pixel: PixelIndex,
    /// Number of pixels that the point stands for.
    pub count: u32,
}

/// The plane of a region; none where there is no such region.
///
/// The place of a pixel is that of its measured color, also for clipped pixels.
pub fn region_plane(shown: &ResultSnapshot, region: RegionId) -> Option<RegionPlane> {
    let hypothesis = hypothesis(shown, region)?;
    let reflection = shown.analysis.intrinsic.regions.get(region.index())?;
    let body = Vec3::from(reflection.body);
    let made = reflection.surface.and_then(|surface| ReflectionTransform::new(&body, &surface.into()));
    let stand_in = || {
        let aside = across(hypothesis);
        let square = (aside - body * aside.dot(&body)).normalize();
        ReflectionTransform::new(&body, &square)
    };
    let has_plane = made.is_some();
    let transform = made.or_else(stand_in)?;
    let origin = shown.analysis.intrinsic.ambient.subtracted.unwrap_or_default().map(|band| band as f32);
    let points = points(shown, region, &|color| transform.split(from(origin, color)));
    let amount = |color: Vec3| transform.split(from(origin, rgb(&color))).body;
    let brightest = hypothesis.matte.foot() + hypothesis.matte.direction * hypothesis.matte_length;
    let starts = starts(reflection, hypothesis).into_iter().filter(|_| has_plane);
    let meeting_points: Vec<f32> = starts.map(amount).collect();
    Some(RegionPlane {
        region: Some(region),
        body: transform.body(),
        surface: transform.surface(),
        has_plane,
        angle_deg: angle_deg(&transform),
        matte_length: amount(brightest),
        branches: branches(&meeting_points, &points),
        slice_half_width: shown.analysis.used.slice_half_width_counts() as f32,
        radius: shown.analysis.used.radius_counts() as f32,
        extent: extent(&points),
        points,
        transform,
        origin,
    })
}

/// A color measured from `origin`, counts.
fn from(origin: Point, color: Point) -> Point {
    std::array::from_fn(|band| color[band] - origin[band])
}

/// The highlight lines that start at some m_b, counts; each highlight pixel belongs to the line of the nearest m_b.
fn branches(meeting_points: &[f32], points: &[PlanePixel]) -> Vec<PlaneBranch> {
    let line = |&meeting_point: &f32| PlaneBranch { meeting_point, length: 0.0 };
    let mut branches: Vec<PlaneBranch> = meeting_points.iter().map(line).collect();
    for point in points.iter().filter(|point| point.kind == PixelKind::Highlight) {
        let off = |branch: &PlaneBranch| (point.body - branch.meeting_point).abs();
        if let Some(nearest) = branches.iter_mut().min_by(|a, b| off(a).total_cmp(&off(b))) {
            nearest.length = nearest.length.max(point.surface);
        }
    }
    branches
}

/// Smallest and largest m_b and m_s of the points, counts.
fn extent(points: &[PlanePixel]) -> [[f32; 2]; 2] {
    let range = |of: fn(&PlanePixel) -> f32| {
        points
            .iter()
            .map(of)
            .fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    };
    [range(|point| point.body), range(|point| point.surface)]
}

fn angle_deg(transform: &ReflectionTransform) -> f32 {
    transform.sine().atan2(crate::color::dot(transform.body(), transform.surface())).to_degrees()
}

impl RegionPlane {
    /// The amounts of body and surface reflection of a color and its distance from the plane, counts.
    pub fn amounts(&self, color: Point) -> Components {
        self.transform.split(from(self.origin, color))
    }

    /// The color of amounts of body and surface reflection, counts: the inverse of [`Self::amounts`] in the plane.
    pub fn color(&self, body: f32, surface: f32) -> Point {
        std::array::from_fn(|band| self.origin[band] + body * self.body[band] + surface * self.surface[band])
    }

    /// The place of m_b and m_s in oblique coordinates, counts: the first axis along C_b, C_s at its true angle to C_b.
    pub fn oblique(&self, body: f32, surface: f32) -> [f32; 2] {
        let (sine, cosine) = self.angle_deg.to_radians().sin_cos();
        [body + surface * cosine, surface * sine]
    }

    /// m_b and m_s of a place in oblique coordinates, counts: the inverse of [`Self::oblique`].
    pub fn from_oblique(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let (sine, cosine) = self.angle_deg.to_radians().sin_cos();
        let surface = y / sine;
        [x - surface * cosine, surface]
    }

    /// The matte line, as m_b and m_s of its ends.
    pub fn matte_line(&self) -> [[f32; 2]; 2] {
        [[0.0, 0.0], [self.matte_length, 0.0]]
    }

    /// The highlight lines, as m_b and m_s of their ends: those that have highlight pixels.
    pub fn highlight_lines(&self) -> impl Iterator<Item = [[f32; 2]; 2]> {
        let drawn = self.branches.iter().filter(|branch| branch.length > 0.0);
        drawn.map(|branch| [[branch.meeting_point, 0.0], [branch.meeting_point, branch.length]])
    }

    /// The point nearest to a place in oblique coordinates; none within `within_counts` counts.
    pub fn nearest(&self, place: [f32; 2], within_counts: f32) -> Option<&PlanePixel> {
        let off2 = |point: &PlanePixel| {
            let [x, y] = self.oblique(point.body, point.surface);
            (x - place[0]).powi(2) + (y - place[1]).powi(2)
        };
        let nearest = self.points.iter().min_by(|a, b| off2(a).total_cmp(&off2(b)))?;
        (off2(nearest) <= within_counts * within_counts).then_some(nearest)
    }
}

fn points(
    shown: &ResultSnapshot,
    region: RegionId,
    amounts_of: &(dyn Fn(Point) -> Components + Sync),
) -> Vec<PlanePixel> {
    let colors = shown.picture.photo.image.pixels.as_slice();
    let kinds = shown.analysis.intrinsic.kinds.as_slice();
    let place = |pixel: u32| {
        let color = colors[pixel as usize];
        let Components { body, surface, .. } = amounts_of(color);
        PlanePixel {
            body,
            surface,
            color,
            kind: kinds[pixel as usize],
            meaning: None,
            pixel: PixelIndex::new(pixel),
            count: 1,
        }
    };
    let pixels = pixels_of(shown.labels(), region);
    if pixels.len() <= MOST_PLANE_POINTS {
        return pixels.into_iter().map(place).collect();
    }
    let amounts: Vec<[f32; 2]> = pixels
        .par_iter()
        .with_min_len(1 << 14)
        .map(|&pixel| {
            let Components { body, surface, .. } = amounts_of(colors[pixel as usize]);
            [body, surface]
        })
        .collect();
    cell_means(&pixels, &amounts, colors, kinds)
}

/// One point for each cell of the plane that contains pixels of one kind: the mean of these pixels. The cells are as small as the largest number
/// of points allows. `amounts`: m_b and m_s of the region's `pixels`; `colors` and `kinds` are those of all pixels of the picture.
fn cell_means(
    pixels: &[u32],
    amounts: &[[f32; 2]],
    colors: &[Point],
    kinds: &[PixelKind],
) -> Vec<PlanePixel> {
    let grid = Grid::new(amounts);
    let cell_of = |i: usize| grid.cell(amounts[i], kinds[pixels[i] as usize]);
    let mut taken = vec![false; CELLS * CELLS * KINDS];
    for i in 0..pixels.len() {
        taken[cell_of(i)] = true;
    }
    let (numbers, shift, count) = number_cells(&taken);
    let mut sums = vec![([0.0f64; 5], 0u32, 0u32); count];
    for (i, &pixel) in pixels.iter().enumerate() {
        let (sum, count, first) = &mut sums[numbers[coarse(cell_of(i), shift)] as usize];
        if *count == 0 {
            *first = pixel;
        }
        *count += 1;
        let ([body, surface], [r, g, b]) = (amounts[i], colors[pixel as usize]);
        for (sum, v) in sum.iter_mut().zip([body, surface, r, g, b]) {
            *sum += f64::from(v);
        }
    }
    let point = |(sum, count, pixel): ([f64; 5], u32, u32)| {
        let [body, surface, r, g, b] = sum.map(|v| (v / f64::from(count)) as f32);
        PlanePixel {
            body,
            surface,
            color: [r, g, b],
            kind: kinds[pixel as usize],
            meaning: None,
            pixel: PixelIndex::new(pixel),
            count,
        }
    };
    sums.into_iter().map(point).collect()
}

/// The pixels of a region, in row order.
fn pixels_of(labels: &LabelMap, region: RegionId) -> Vec<u32> {
    let labels = labels.as_slice().par_iter().with_min_len(1 << 14).enumerate();
    labels.filter(|(_, label)| **label == region.get()).map(|(pixel, _)| pixel as u32).collect()
}

/// Square cells over all amounts.
struct Grid {
    low: [f32; 2],
    per_count: f32,
}

impl Grid {
    fn new(amounts: &[[f32; 2]]) -> Self {
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for amount in amounts {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(amount[k]), high[k].max(amount[k]));
            }
        }
        let span = (high[0] - low[0]).max(high[1] - low[1]).max(1e-3);
        Self { low, per_count: CELLS as f32 / span }
    }

    fn cell(&self, amount: [f32; 2], kind: PixelKind) -> usize {
        let at = |k: usize| (((amount[k] - self.low[k]) * self.per_count) as usize).min(CELLS - 1);
        (kind as usize * CELLS + at(1)) * CELLS + at(0)
    }
}

/// Numbers the taken cells of the finest grid that has few enough; with the halvings of that grid, and how many there are.
fn number_cells(taken: &[bool]) -> (Vec<u32>, usize, usize) {
    let mut shift = 0;
    loop {
        let side = CELLS >> shift;
        let mut numbers = vec![u32::MAX; side * side * KINDS];
        for (cell, _) in taken.iter().enumerate().filter(|(_, taken)| **taken) {
            numbers[coarse(cell, shift)] = 0;
        }
        let mut count = 0;
        for number in numbers.iter_mut().filter(|number| **number == 0) {
            *number = count;
            count += 1;
        }
        if count as usize <= MOST_PLANE_POINTS {
            return (numbers, shift, count as usize);
        }
        shift += 1;
    }
}

/// The cell of a grid, halved `shift` times, that holds a cell of the finest one.
fn coarse(cell: usize, shift: usize) -> usize {
    let (kind, y, x) = (cell / (CELLS * CELLS), cell / CELLS % CELLS, cell % CELLS);
    let side = CELLS >> shift;
    (kind * side + (y >> shift)) * side + (x >> shift)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::super::vector::distance;
    use super::*;
    use crate::view::testing::tiny;

    #[test]
    fn every_pixel_of_a_region_has_its_place() {
        let shown = tiny();
        for reflection in &shown.analysis.intrinsic.regions {
            let plane = region_plane(&shown, reflection.id).unwrap();
            assert_eq!(plane.points.iter().map(|p| p.count as usize).sum::<usize>(), reflection.pixels);
            assert_eq!(plane.has_plane, reflection.surface.is_some());
            if let Some(angle_deg) = reflection.angle_deg {
                assert!((f64::from(plane.angle_deg) - angle_deg).abs() < 0.01);
            }
            for point in plane.points.iter().step_by(97) {
                let amounts = plane.amounts(point.color);
                assert_eq!((amounts.body, amounts.surface), (point.body, point.surface));
                let in_plane: Point =
                    std::array::from_fn(|k| plane.body[k] * point.body + plane.surface[k] * point.surface);
                assert!((distance(in_plane, point.color) - amounts.noise.abs()).abs() < 1e-2);
                // Lengths in the drawing are lengths in the cube.
                let [x, y] = plane.oblique(point.body, point.surface);
                assert!((x.hypot(y) - distance(in_plane, [0.0; 3])).abs() < 1e-2);
                let [body, surface] = plane.from_oblique([x, y]);
                assert!((body - point.body).abs() < 0.02 && (surface - point.surface).abs() < 0.02);
                let nearest = plane.nearest([x, y], 1.0).unwrap();
                assert_eq!((nearest.body, nearest.surface), (point.body, point.surface));
            }
            assert!(plane.nearest([-1e6, 0.0], 10.0).is_none());
            assert!(plane.matte_length > 0.0 && plane.branches.is_empty() != plane.has_plane);
        }
        assert!(region_plane(&shown, RegionId::from_index(998)).is_none());
    }

    #[test]
    fn each_highlight_line_reaches_to_its_own_brightest_pixel() {
        let pixel = |body: f32, surface: f32, kind: PixelKind| PlanePixel {
            body,
            surface,
            color: [0.0; 3],
            kind,
            meaning: None,
            pixel: PixelIndex::new(0),
            count: 1,
        };
        let points = [
            pixel(118.0, 70.0, PixelKind::Highlight),
            pixel(64.0, 30.0, PixelKind::Highlight),
            pixel(61.0, 45.0, PixelKind::Highlight),
            pixel(60.0, 90.0, PixelKind::Lost),
        ];
        let lengths = |starts: &[f32]| branches(starts, &points).iter().map(|b| b.length).collect::<Vec<_>>();
        assert_eq!(lengths(&[120.0, 60.0]), [70.0, 45.0]);
        assert_eq!(lengths(&[120.0]), [70.0]);
        assert!(lengths(&[]).is_empty() && branches(&[9.0], &[])[0].length == 0.0);
    }

    #[test]
    fn many_cells_become_fewer_larger_ones() {
        let mut taken = vec![false; CELLS * CELLS * KINDS];
        taken[5] = true;
        assert_eq!((number_cells(&taken).1, number_cells(&taken).2), (0, 1));
        taken[..CELLS * CELLS].fill(true);
        let (numbers, shift, count) = number_cells(&taken);
        assert_eq!((shift, count), (3, 128 * 128));
        assert_eq!(numbers[coarse(CELLS * CELLS - 1, shift)] as usize, count - 1);
        assert_eq!(coarse(9 * CELLS + 17, 3), 128 + 2);
    }

    #[test]
    fn a_cell_holds_pixels_near_one_another() {
        let amounts: Vec<[f32; 2]> = (0..1000).map(|i| [i as f32 * 0.2, (i % 10) as f32]).collect();
        let grid = Grid::new(&amounts);
        let cell = 199.8 / CELLS as f32;
        for pair in amounts.windows(2) {
            let same = grid.cell(pair[0], PixelKind::Matte) == grid.cell(pair[1], PixelKind::Matte);
            assert!(!same || (pair[1][0] - pair[0][0]).abs() <= cell);
        }
        assert_ne!(grid.cell(amounts[0], PixelKind::Matte), grid.cell(amounts[0], PixelKind::Highlight));
    }
}
