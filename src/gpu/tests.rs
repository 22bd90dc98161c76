//! Tests of pictures of small scenes, by the colors of the pixels to which the camera projects points.

mod speed;

use super::*;
use std::sync::OnceLock;

const SIZE: [u32; 2] = [160, 120];

/// The device that all tests share; `None` where there is no device.
fn device() -> Option<&'static Headless> {
    static DEVICE: OnceLock<Result<Headless, NoAdapter>> = OnceLock::new();
    let device = DEVICE.get_or_init(Headless::new);
    let required = std::env::var("DICHROSCOPE_REQUIRE_GPU").is_ok_and(|value| value == "1");
    match device {
        Ok(device) => Some(device),
        Err(reason) if required => panic!("{reason}"),
        Err(reason) => {
            eprintln!("SKIP: {reason}");
            None
        }
    }
}

/// A picture and the camera that it was drawn with.
struct Picture {
    rgba: Vec<u8>,
    size_px: [u32; 2],
    camera: Orbit,
}

impl Picture {
    #[track_caller]
    fn of(scene: &Scene, camera: &Orbit) -> Option<Self> {
        Self::sized(scene, camera, SIZE, 1.0)
    }

    #[track_caller]
    fn sized(scene: &Scene, camera: &Orbit, size_px: [u32; 2], scale: f32) -> Option<Self> {
        let Headless { device, queue, .. } = device()?;
        let mut renderer = Renderer::new(device);
        assert!(renderer.draw(device, queue, scene, camera, size_px, scale));
        let rgba = renderer.read_back(device, queue).expect("the device is there");
        assert_eq!(rgba.len() as u32, 4 * size_px[0] * size_px[1]);
        Some(Self { rgba, size_px, camera: *camera })
    }

    fn at(&self, x: usize, y: usize) -> [u8; 4] {
        self.rgba.as_chunks::<4>().0[y * self.size_px[0] as usize + x]
    }

    /// The color of the pixel to which a world point is projected.
    #[track_caller]
    fn at_world(&self, world: [f32; 3]) -> [u8; 4] {
        let [x, y] = self.place_px(world);
        self.at(x as usize, y as usize)
    }

    #[track_caller]
    fn place_px(&self, world: [f32; 3]) -> [f32; 2] {
        let size = self.size_px.map(|length| length as f32);
        self.camera.screen_from_world(world, size).expect("in view").at
    }

    /// Sum of channel `c` over all pixels, and the center of that sum, pixels.
    fn mass_and_center(&self, c: usize) -> (f32, [f32; 2]) {
        let (mut mass, mut x_sum, mut y_sum) = (0.0, 0.0, 0.0);
        for (index, pixel) in self.rgba.as_chunks::<4>().0.iter().enumerate() {
            let amount = f32::from(pixel[c]) / 255.0;
            let [x, y] = [index as u32 % self.size_px[0], index as u32 / self.size_px[0]];
            mass += amount;
            x_sum += amount * (x as f32 + 0.5);
            y_sum += amount * (y as f32 + 0.5);
        }
        (mass, [x_sum / mass, y_sum / mass])
    }
}

/// A camera that looks along green at the center of the cube, with red to the right and blue up.
fn front(projection: Projection) -> Orbit {
    let mut camera = Orbit { projection, ..Orbit::default() };
    camera.preset(Preset::Green);
    camera
}

fn orthographic() -> Orbit {
    front(Projection::Orthographic)
}

fn dot(position: [f32; 3], color: [u8; 4], size_px: f32) -> Point {
    Point { position, color, size_px }
}

fn scene_of(points: Vec<Point>) -> Scene {
    Scene { points: vec![Batch::new(points)], ..Scene::default() }
}

fn line(a: [f32; 3], b: [f32; 3], overlay: Overlay) -> Line {
    Line { a, b, color: GREEN, width_px: 5.0, dash_px: 0.0, overlay }
}

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];
const BLACK: [u8; 4] = [0, 0, 0, 255];

#[track_caller]
fn assert_color(found: [u8; 4], expected: [u8; 4], tolerance: u8) {
    let near = found.iter().zip(expected).all(|(&found, expected)| found.abs_diff(expected) <= tolerance);
    assert!(near, "found {found:?}, expected {expected:?} ± {tolerance}");
}

#[test]
fn every_shader_is_valid() {
    for text in [pipelines::POINTS_WGSL, pipelines::LINES_WGSL, pipelines::SOLIDS_WGSL] {
        let module = wgpu::naga::front::wgsl::parse_str(text)
            .unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)));
        let capabilities = wgpu::naga::valid::Capabilities::empty();
        let mut validator =
            wgpu::naga::valid::Validator::new(wgpu::naga::valid::ValidationFlags::all(), capabilities);
        if let Err(error) = validator.validate(&module) {
            panic!("{}", error.emit_to_string(text));
        }
    }
}

#[test]
fn points_are_drawn_where_the_camera_projects_them() {
    let mut askew = Orbit::default();
    askew.look_along([-0.7, 0.6, -0.35], [0.2, 0.1, 1.0]);
    for camera in [orthographic(), front(Projection::Perspective), askew] {
        for world in [[0.5; 3], [0.1, 0.2, 0.3], [0.9, 0.0, 0.2], [0.4, 1.0, 0.9]] {
            let Some(picture) = Picture::of(&scene_of(vec![dot(world, RED, 7.0)]), &camera) else { return };
            let (_, [x, y]) = picture.mass_and_center(0);
            let [x_expected, y_expected] = picture.place_px(world);
            assert!(
                (x - x_expected).abs() < 0.1 && (y - y_expected).abs() < 0.1,
                "({x}, {y}), expected ({x_expected}, {y_expected})"
            );
            assert_eq!(picture.at_world(world), RED);
        }
    }
}

#[test]
fn dots_are_round_and_have_their_diameter() {
    for (size_px, scale) in [(3.0, 1.0), (10.0, 1.0), (24.0, 1.0), (7.0, 2.0)] {
        let scene = scene_of(vec![dot([0.5; 3], RED, size_px)]);
        let Some(picture) = Picture::sized(&scene, &orthographic(), SIZE, scale) else { return };
        let radius_px = 0.5 * size_px * scale;
        let (area, [x, y]) = picture.mass_and_center(0);
        let expected = std::f32::consts::PI * radius_px * radius_px;
        assert!((area / expected - 1.0).abs() < 0.06, "area {area}, expected {expected}");
        for step in 0..16 {
            let angle = std::f32::consts::TAU * step as f32 / 16.0;
            let along =
                |radius: f32| ((x + radius * angle.cos()) as usize, (y + radius * angle.sin()) as usize);
            let (inside, outside) = (along(radius_px - 1.3), along(radius_px + 1.3));
            assert_eq!(picture.at(inside.0, inside.1), RED);
            assert_eq!(picture.at(outside.0, outside.1), BLACK);
        }
    }
}

#[test]
fn rims_are_soft() {
    let Some(picture) = Picture::of(&scene_of(vec![dot([0.5; 3], RED, 21.0)]), &orthographic()) else {
        return;
    };
    let between =
        picture.rgba.as_chunks::<4>().0.iter().filter(|pixel| (30..225).contains(&pixel[0])).count();
    assert!(between > 30, "{between} pixels between dot and background");
}

#[test]
fn a_dot_smaller_than_a_pixel_is_fainter() {
    let Some(picture) = Picture::of(&scene_of(vec![dot([0.5; 3], RED, 0.5)]), &orthographic()) else {
        return;
    };
    let (mass, _) = picture.mass_and_center(0);
    assert!((0.2..0.8).contains(&mass), "{mass}");
}

#[test]
fn nearer_dots_hide_farther_ones_whatever_the_order() {
    let near = dot([0.5, 0.1, 0.5], RED, 20.0);
    let far = dot([0.5, 0.9, 0.5], BLUE, 20.0);
    for camera in [orthographic(), front(Projection::Perspective)] {
        for points in [vec![near, far], vec![far, near]] {
            let Some(picture) = Picture::of(&scene_of(points), &camera) else { return };
            assert_eq!(picture.at_world([0.5; 3]), RED);
            let (blue, _) = picture.mass_and_center(2);
            // Where two soft rims coincide, both colors are visible a little.
            assert!(blue < 15.0, "{blue} pixels of the dot behind shine around the one in front");
        }
    }
}

#[test]
fn batches_share_one_depth() {
    let batch = |y, color| Batch::new(vec![dot([0.5, y, 0.5], color, 20.0)]);
    let scene = Scene { points: vec![batch(0.1, RED), batch(0.9, BLUE)], ..Scene::default() };
    let Some(picture) = Picture::of(&scene, &orthographic()) else { return };
    assert_eq!(picture.at_world([0.5; 3]), RED);
}

#[test]
fn lines_have_their_width() {
    let lines = vec![line([0.2, 0.5, 0.3], [0.8, 0.5, 0.7], Overlay::Hidden)];
    let scene = Scene { lines: Batch::new(lines), ..Scene::default() };
    let Some(picture) = Picture::of(&scene, &front(Projection::Perspective)) else { return };
    let [a, b] = [[0.2, 0.5, 0.3], [0.8, 0.5, 0.7]].map(|end| picture.place_px(end));
    let length_px = (b[0] - a[0]).hypot(b[1] - a[1]);
    let (area, center) = picture.mass_and_center(1);
    let expected = 5.0 * length_px + std::f32::consts::PI * 2.5 * 2.5;
    assert!((area / expected - 1.0).abs() < 0.02, "area {area}, expected {expected}");
    assert!((center[0] - 80.0).abs() < 0.1 && (center[1] - 60.0).abs() < 0.1, "{center:?}");
    assert_eq!(picture.at_world([0.35, 0.5, 0.4]), GREEN);
    assert_eq!(picture.at_world([0.5, 0.5, 0.4]), BLACK);
}

#[test]
fn dashes_leave_half_of_the_line() {
    let dashed =
        Line { dash_px: 6.0, width_px: 1.0, ..line([0.0, 0.5, 0.5], [1.0, 0.5, 0.5], Overlay::Hidden) };
    let [whole, half] = [0.0, 6.0].map(|dash_px| {
        let scene = Scene { lines: Batch::new(vec![Line { dash_px, ..dashed }]), ..Scene::default() };
        Picture::of(&scene, &orthographic()).map(|picture| picture.mass_and_center(1).0)
    });
    let (Some(whole), Some(half)) = (whole, half) else { return };
    let share = half / whole;
    assert!((0.5..0.7).contains(&share), "{share}");
}

#[test]
fn hidden_lines_are_faint_or_visible_by_their_overlay() {
    for (overlay, expected) in
        [(Overlay::Hidden, RED), (Overlay::Faint, [178, 77, 0, 255]), (Overlay::Over, GREEN)]
    {
        let mut scene = scene_of(vec![dot([0.5, 0.2, 0.5], RED, 20.0)]);
        scene.lines = Batch::new(vec![line([0.0, 0.8, 0.5], [1.0, 0.8, 0.5], overlay)]);
        let Some(picture) = Picture::of(&scene, &orthographic()) else { return };
        assert_color(picture.at_world([0.5; 3]), expected, 2);
        assert_eq!(picture.at_world([0.2, 0.5, 0.5]), GREEN, "{overlay:?} where nothing hides it");
    }
}

#[test]
fn a_line_from_behind_the_viewer_is_cut() {
    let camera = front(Projection::Perspective);
    let [x, y, z] = camera.eye();
    let lines = vec![
        line([x - 0.1, y - 1.0, z - 0.2], [0.5, 0.8, 0.5], Overlay::Hidden),
        line([x, y - 1.0, z], [x, y - 2.0, z + 1.0], Overlay::Hidden),
    ];
    let scene = Scene { lines: Batch::new(lines), ..Scene::default() };
    let Some(picture) = Picture::of(&scene, &camera) else { return };
    assert_eq!(picture.at_world([0.498, 0.79, 0.496]), GREEN);
    assert_eq!(picture.at_world([0.9, 0.8, 0.9]), BLACK, "no mirror image of what is behind");
}

/// A square perpendicular to the direction of view, at depth `y`.
fn sheet(y: f32, color: [u8; 4]) -> Mesh {
    let polygon = [[0.3, y, 0.3], [0.7, y, 0.3], [0.7, y, 0.7], [0.3, y, 0.7]];
    Mesh::new(shapes::slab(&polygon, 0.0, color))
}

#[test]
fn a_sheet_tints_what_is_behind_it_by_its_alpha() {
    let translucent_blue = [0, 0, 255, 102];
    let behind = scene_of(vec![dot([0.5; 3], RED, 20.0)]);
    for (y, expected) in [(0.2, [153, 0, 102, 255]), (0.8, RED)] {
        for turned in [false, true] {
            let mut triangles =
                shapes::slab(&[[0.3, y, 0.3], [0.7, y, 0.3], [0.7, y, 0.7]], 0.0, translucent_blue);
            if turned {
                triangles.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(1, 2));
            }
            let scene = Scene { meshes: vec![Mesh::new(triangles)], ..behind.clone() };
            let Some(picture) = Picture::of(&scene, &orthographic()) else { return };
            assert_color(picture.at_world([0.52, 0.5, 0.48]), expected, 1);
            assert_color(picture.at_world([0.65, 0.5, 0.35]), [0, 0, 102, 255], 1);
        }
    }
}

#[test]
fn sheets_cover_each_other_from_far_to_near() {
    let [near, far] = [sheet(0.2, [255, 0, 0, 128]), sheet(0.8, [0, 0, 255, 128])];
    for meshes in [vec![near.clone(), far.clone()], vec![far, near]] {
        let Some(picture) = Picture::of(&Scene { meshes, ..Scene::default() }, &orthographic()) else {
            return;
        };
        assert_color(picture.at_world([0.5; 3]), [128, 0, 64, 255], 2);
    }
}

#[test]
fn a_cylinder_reads_as_round() {
    let triangles = shapes::cylinder([0.5, 0.5, 0.1], [0.5, 0.5, 0.9], 0.2, 48, [255, 255, 255, 60]);
    let scene = Scene { meshes: vec![Mesh::new(triangles)], ..Scene::default() };
    let Some(picture) = Picture::of(&scene, &orthographic()) else { return };
    let profile = [0.5, 0.6, 0.64, 0.67].map(|x| picture.at_world([x, 0.5, 0.5])[0]);
    assert!(profile.is_sorted_by(|a, b| a < b), "denser towards the silhouette: {profile:?}");
    let through = 1.0 - (1.0_f32 - 60.0 / 255.0).powi(2);
    assert!(profile[0].abs_diff((255.0 * through) as u8) < 4, "two skins in the middle: {profile:?}");
    let mirrored = [0.4, 0.36, 0.33].map(|x| picture.at_world([x, 0.5, 0.5])[0]);
    assert!(mirrored.iter().zip(&profile[1..]).all(|(a, b)| a.abs_diff(*b) < 12), "{mirrored:?} {profile:?}");
}

#[test]
fn a_transparent_background_stays_transparent() {
    let mut scene = scene_of(vec![dot([0.5; 3], [200, 100, 40, 128], 20.0)]);
    scene.background = [0; 4];
    let Some(picture) = Picture::of(&scene, &orthographic()) else { return };
    assert_eq!(picture.at(2, 2), [0; 4]);
    assert_color(picture.at_world([0.5; 3]), [200, 100, 40, 128], 2);
}

#[test]
fn the_empty_scene_is_its_background() {
    let scene = Scene { background: [23, 24, 26, 255], ..Scene::default() };
    let Some(picture) = Picture::of(&scene, &Orbit::default()) else { return };
    assert!(picture.rgba.as_chunks::<4>().0.iter().all(|&pixel| pixel == [23, 24, 26, 255]));
}

#[test]
fn a_picture_is_drawn_only_when_something_changed() {
    let Some(Headless { device, queue, .. }) = device() else { return };
    let mut renderer = Renderer::new(device);
    let mut scene = scene_of(vec![dot([0.5; 3], RED, 9.0)]);
    let mut camera = orthographic();
    let mut draw =
        |scene: &Scene, camera: &Orbit, size_px| renderer.draw(device, queue, scene, camera, size_px, 1.0);
    assert!(draw(&scene, &camera, SIZE));
    assert!(!draw(&scene, &camera, SIZE));
    assert!(!draw(&scene.clone(), &camera, SIZE), "a clone is the same scene");
    assert!(!draw(&scene, &camera, [0, 50]), "nowhere to draw");
    camera.orbit([1.0, 0.0]);
    assert!(draw(&scene, &camera, SIZE));
    scene.lines = Batch::new(vec![line([0.0; 3], [1.0; 3], Overlay::Over)]);
    assert!(draw(&scene, &camera, SIZE));
    scene.points[0] = Batch::new(scene.points[0].to_vec());
    assert!(draw(&scene, &camera, SIZE), "a new list is a change, whatever it holds");
    assert!(!draw(&scene, &camera, SIZE));
}

#[test]
fn resizing_makes_a_new_texture_once() {
    let Some(Headless { device, queue, .. }) = device() else { return };
    let mut renderer = Renderer::new(device);
    let scene = scene_of(vec![dot([0.5; 3], RED, 9.0)]);
    let mut generations = vec![renderer.generation()];
    for size_px in [[100, 80], [100, 80], [301, 7], [1, 1], [100, 80]] {
        renderer.draw(device, queue, &scene, &orthographic(), size_px, 1.0);
        assert_eq!(renderer.size_px(), size_px);
        let bytes = renderer.read_back(device, queue).expect("the device is there");
        assert_eq!(bytes.len() as u32, 4 * size_px[0] * size_px[1]);
        let middle = (size_px[1] / 2 * size_px[0] + size_px[0] / 2) as usize;
        assert_eq!(bytes.as_chunks::<4>().0[middle], RED);
        generations.push(renderer.generation());
    }
    assert_eq!(generations, [0, 1, 1, 2, 3, 4]);
}

#[test]
fn a_size_beyond_the_device_is_reduced_in_shape() {
    let Some(Headless { device, queue, .. }) = device() else { return };
    let limit = device.limits().max_texture_dimension_2d;
    let mut renderer = Renderer::new(device);
    assert!(renderer.draw(device, queue, &Scene::default(), &Orbit::default(), [4 * limit, 64], 1.0));
    assert_eq!(renderer.size_px(), [limit, 16]);
}
