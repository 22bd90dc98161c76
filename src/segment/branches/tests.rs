use super::*;
use crate::color::Vec3;
use crate::raster::RegionId;
use crate::segment::Members;
use crate::segment::testing::Drawing;
use proptest::prelude::*;

const SIDE_PX: usize = 96;
const LENGTH: f64 = 180.0;

/// A highlight of the lamp: its center (pixels), the square of its width (pixels²), and its strength (counts).
type Lamp = ([f64; 2], f64, f64);

/// The branches of a picture of one region, in which `body` gives the body reflection of each pixel and `lamps` the surface
/// reflection. The noise has σ 1.25.
fn found(body: impl Fn(f64, f64) -> f64, lamps: &[Lamp], seed: u64) -> Branches {
    search(|x, y| (body(x, y), shine(lamps, x, y)), seed, |_| 1)
}

fn shine(lamps: &[Lamp], x: f64, y: f64) -> f64 {
    let one = |&([u, v], width2, strength): &Lamp| {
        strength * (-((x - u).powi(2) + (y - v).powi(2)) / (2.0 * width2)).exp()
    };
    lamps.iter().map(one).sum()
}

/// The branches of region 1, where `amounts` gives the body and surface reflection of each pixel and `label` its region.
fn search(amounts: impl Fn(f64, f64) -> (f64, f64), seed: u64, label: impl Fn(usize) -> u16) -> Branches {
    let (body, surface) = (Vec3::new(0.8, 0.5, 0.3).normalize(), Vec3::repeat(1.0).normalize());
    let noise = std::cell::Cell::new(seed);
    let drawing = Drawing::by_place(SIDE_PX, |x, y| {
        let (b, s) = amounts(x, y);
        body * b + surface * s + Vec3::from_fn(|_, _| 1.25 * gauss(&noise))
    });
    let input = drawing.input();
    let labels: Vec<u16> = (0..SIDE_PX * SIDE_PX).map(label).collect();
    let labels = LabelMap::from_vec(SIDE_PX, SIDE_PX, labels).unwrap();
    let search = BranchSearch {
        input: &input,
        labels: &labels,
        region: RegionId::from_index(0),
        transform: &ReflectionTransform::new(&body, &surface).unwrap(),
        matte_length: LENGTH,
        light_interval_deg: None,
    };
    search.run(Members::of(&labels, 2).region(1u16))
}

/// A nearly normal random number of variance 1: the sum of twelve uniform numbers (xorshift) less 6.
fn gauss(state: &std::cell::Cell<u64>) -> f64 {
    let uniform = |_| {
        let mut at = state.get() | 1;
        at ^= at << 13;
        at ^= at >> 7;
        at ^= at << 17;
        state.set(at);
        (at >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..12).map(uniform).sum::<f64>() - 6.0
}

/// Two faces of a convex object that meet at the middle column.
fn faces(left: f64, right: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| if x < 48.0 { left + 0.05 * y } else { right + 0.05 * y }
}

const LEFT: Lamp = ([24.0, 40.0], 20.0, 90.0);
const RIGHT: Lamp = ([72.0, 56.0], 20.0, 90.0);

#[test]
fn two_faces_of_a_convex_object_show_two_branches() {
    let branches = found(faces(60.0, 120.0), &[LEFT, RIGHT], 7);
    let bodies = branches.bodies();
    assert_eq!((branches.cores.len(), bodies.len()), (2, 2), "{branches:?}");
    let mut shades = bodies.clone();
    shades.sort_by(f32::total_cmp);
    // 0.05 counts per row under highlights in rows 40 and 56.
    assert!((shades[0] - 62.0).abs() < 1.0 && (shades[1] - 122.8).abs() < 1.0, "{shades:?}");
    let Measured { value: gap, limit } = branches.gaps[0];
    assert!((gap - (shades[1] - shades[0])).abs() < 1e-3 && limit < gap);
    // The nearest branch of a place is the branch of the highlight beside the place.
    let shade_at = |x, y| bodies[branches.nearest(x, y)];
    assert!(shade_at(0, 95) < 70.0 && shade_at(24, 40) < 70.0 && shade_at(95, 0) > 110.0);
}

#[test]
fn faces_of_one_shade_show_one_branch() {
    let branches = found(faces(100.0, 103.0), &[LEFT, RIGHT], 3);
    assert_eq!((branches.cores.len(), branches.bodies().len()), (2, 1), "{branches:?}");
    assert!((branches.bodies()[0] - 104.0).abs() < 2.0);
}

#[test]
fn one_highlight_that_sweeps_over_the_shades_is_one_branch() {
    // The body reflection under the core spans 25 counts, more than the least difference of two branches.
    let slope = found(|x, _| 30.0 + 1.4 * x, &[([48.0, 48.0], 60.0, 110.0)], 11);
    assert_eq!((slope.cores.len(), slope.bodies().len()), (1, 1), "{slope:?}");
    assert!(slope.cores[0].deviation > 5.0, "{slope:?}");
    // A highlight across an edge, whose halves lie on two shades, has no line of its own.
    let edge = found(faces(50.0, 130.0), &[([48.0, 48.0], 60.0, 80.0)], 11);
    assert!(edge.bodies().len() <= 1, "{edge:?}");
}

#[test]
fn clipped_pixels_of_a_core_count_by_the_ring_around_them() {
    let strong = [([24.0, 40.0], 30.0, 400.0), ([72.0, 56.0], 30.0, 400.0)];
    let branches = found(faces(60.0, 130.0), &strong, 5);
    assert_eq!(branches.bodies().len(), 2, "{branches:?}");
    let mut shades = branches.bodies();
    shades.sort_by(f32::total_cmp);
    assert!((shades[0] - 62.0).abs() < 3.0 && (shades[1] - 132.8).abs() < 3.0, "{shades:?}");
    // Clipped pixels without undistorted highlight pixels around them are no highlight of the region.
    let hole = |x: f64, y: f64| (x - 72.0).abs() < 8.0 && (y - 56.0).abs() < 8.0;
    let amounts = |x: f64, y: f64| {
        let s = if hole(x, y) { 500.0 } else { shine(&[LEFT], x, y) };
        (faces(60.0, 130.0)(x, y), s)
    };
    let without_ring = search(amounts, 5, |_| 1);
    assert_eq!((without_ring.cores.len(), without_ring.bodies().len()), (1, 1), "{without_ring:?}");
}

#[test]
fn specks_sheen_and_mixed_borders_are_no_highlights() {
    let speck = found(faces(60.0, 120.0), &[LEFT, ([72.0, 56.0], 1.2, 120.0)], 5);
    assert_eq!(speck.cores.len(), 1, "{speck:?}");
    // A sheen of a fifth of the highlight's strength, over a part of a face.
    let sheen = |x: f64, y: f64| {
        let ambient = if x > 80.0 { 30.0 } else { 0.0 };
        (faces(60.0, 130.0)(x, y), shine(&[(LEFT.0, LEFT.1, 150.0)], x, y) + ambient)
    };
    assert_eq!(search(sheen, 5, |_| 1).cores.len(), 1);
    // The same beside a clipped highlight, of which no undistorted pixel is much stronger than the sheen.
    let veiled = |x: f64, y: f64| {
        let ambient = if x > 80.0 { 40.0 } else { 0.0 };
        (faces(170.0, 110.0)(x, y), shine(&[(LEFT.0, LEFT.1, 300.0)], x, y) + ambient)
    };
    assert_eq!(search(veiled, 5, |_| 1).cores.len(), 1);
    // A column of mixed colors beside another region.
    let mixed = |x: f64, y: f64| {
        let s = if (79.0..80.0).contains(&x) { 90.0 } else { shine(&[LEFT], x, y) };
        (faces(60.0, 130.0)(x, y), s)
    };
    let label = |pixel: usize| if pixel % SIDE_PX < 80 { 1 } else { 2 };
    assert_eq!(search(mixed, 5, label).cores.len(), 1);
}

#[test]
fn without_a_highlight_there_is_no_branch() {
    let branches = found(faces(60.0, 130.0), &[], 9);
    assert_eq!(branches, Branches::default());
    assert_eq!((branches.bodies().len(), branches.nearest(3, 4)), (0, 0));
}

#[test]
fn at_most_four_branches_are_found_the_strongest_ones() {
    // Five columns of ascending shades, each with a highlight; the highlight of the fourth column is the smallest.
    let body = |x: f64, _: f64| 20.0 + 35.0 * (x / 20.0).floor();
    let widths = [9.0, 12.0, 10.0, 6.0, 11.0];
    let lamps: Vec<Lamp> =
        widths.iter().enumerate().map(|(i, &width2)| ([9.5 + 20.0 * i as f64, 48.0], width2, 90.0)).collect();
    let branches = found(body, &lamps[..4], 2);
    assert_eq!((branches.cores.len(), branches.bodies().len()), (4, 4), "{branches:?}");
    let branches = found(|x, y| body(x, y) * 0.9, &lamps, 2);
    assert_eq!((branches.cores.len(), branches.bodies().len()), (5, 4), "{branches:?}");
    let pixels = |branch| {
        branches.cores.iter().filter(|core| core.branch == branch).map(|core| core.pixels).sum::<u32>()
    };
    assert!((1..4).all(|branch| pixels(branch - 1) >= pixels(branch)), "{branches:?}");
    assert!(
        branches.cores[3].branch == branches.cores[2].branch
            || branches.cores[3].branch == branches.cores[4].branch
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// A ball under one lamp shows one branch at any position of the lamp and with any noise.
    #[test]
    fn a_ball_under_one_lamp_shows_one_branch(
        lamp in (-0.5f64..0.5, -0.5f64..0.5), rough in 0.02f64..0.12, strength in 40f64..400.0, seed in 1u64..u64::MAX,
    ) {
        let light = Vec3::new(lamp.0, lamp.1, (1.0 - lamp.0 * lamp.0 - lamp.1 * lamp.1).sqrt());
        let halfway = (light + Vec3::z()).normalize();
        let label = |pixel: usize| {
            let (x, y) = ((pixel % SIDE_PX) as f64 - 47.5, (pixel / SIDE_PX) as f64 - 47.5);
            u16::from(x.hypot(y) < 44.0)
        };
        let amounts = |x: f64, y: f64| {
            let (u, v) = ((x - 47.5) / 45.0, (y - 47.5) / 45.0);
            let up = 1.0 - u * u - v * v;
            if up <= 0.0 {
                return (0.0, 0.0);
            }
            let normal = Vec3::new(u, v, up.sqrt());
            let off = normal.dot(&halfway).clamp(-1.0, 1.0).acos();
            (LENGTH * normal.dot(&light).max(0.0), strength * (-(off / rough).powi(2)).exp())
        };
        prop_assert!(search(amounts, seed, label).bodies().len() <= 1);
    }

    /// Two faces are two branches exactly where their shades differ by more than the recorded limit, which is at least a tenth
    /// of the matte line.
    #[test]
    fn a_branch_is_a_difference_beyond_its_limit(
        left in 40f64..120.0, apart in 0f64..60.0, strength in 50f64..110.0, seed in 1u64..u64::MAX,
    ) {
        let branches =
            found(faces(left, left + apart), &[(LEFT.0, LEFT.1, strength), (RIGHT.0, RIGHT.1, strength)], seed);
        prop_assert_eq!(branches.cores.len(), 2);
        let Measured { value: gap, limit } = branches.gaps[0];
        prop_assert!(limit >= 0.1 * LENGTH as f32 && limit < 0.16 * LENGTH as f32, "{:?}", branches);
        prop_assert!((f64::from(gap) - apart - 0.8).abs() < 2.5, "{} for {}", gap, apart);
        prop_assert_eq!(branches.bodies().len(), if gap > limit { 2 } else { 1 });
    }
}
