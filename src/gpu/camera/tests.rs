use super::*;

const SIZE: [f32; 2] = [800.0, 600.0];
const BOTH: [Projection; 2] = [Projection::Perspective, Projection::Orthographic];

/// A camera whose axes are parallel to no axis of the world.
fn askew(projection: Projection) -> Orbit {
    let mut camera = Orbit { projection, target: [0.4, 0.55, 0.3], distance: 2.5, ..Orbit::default() };
    camera.look_along([-0.7, 0.6, -0.35], [0.2, 0.1, 1.0]);
    camera
}

#[track_caller]
fn screen(camera: &Orbit, world: [f32; 3]) -> [f32; 2] {
    camera.screen_from_world(world, SIZE).expect("in front of the camera").at
}

#[track_caller]
fn assert_near<const N: usize>(found: [f32; N], expected: [f32; N], tolerance: f32) {
    let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= tolerance);
    assert!(near, "found {found:?}, expected {expected:?} ± {tolerance}");
}

#[test]
fn the_target_is_in_the_middle_and_its_plane_to_scale() {
    for camera in BOTH.map(askew) {
        assert_near(screen(&camera, camera.target), [400.0, 300.0], 1e-2);
        let [right, up, _] = camera.right_up_forward().map(Vector3::from);
        let corner = Vector3::from(camera.target) + (right * (4.0 / 3.0) + up) * camera.half_height();
        assert_near(screen(&camera, corner.into()), [800.0, 0.0], 1e-2);
    }
}

#[test]
fn switching_the_projection_keeps_the_target_plane() {
    let [perspective, orthographic] = BOTH.map(askew);
    let [right, up, forward] = perspective.right_up_forward().map(Vector3::from);
    let on_plane = Vector3::from(perspective.target) + right * 0.3 - up * 0.2;
    assert_near(screen(&perspective, on_plane.into()), screen(&orthographic, on_plane.into()), 1e-2);
    // Halfway to the eye, perspective doubles lengths that the orthographic projection does not change.
    let nearer = (on_plane - forward * 0.5 * perspective.distance).into();
    let [x, y] = screen(&orthographic, nearer);
    let doubled = [400.0 + 2.0 * (x - 400.0), 300.0 + 2.0 * (y - 300.0)];
    assert_near(screen(&perspective, nearer), doubled, 2e-2);
}

#[test]
fn rays_pass_through_what_is_seen_there() {
    for camera in BOTH.map(askew) {
        for world in [[0.0; 3], [1.0; 3], [0.9, 0.1, 0.4], [0.0, 1.0, 0.5]] {
            let ray = camera.ray_from_screen(screen(&camera, world), SIZE);
            assert!(ray.distance(world) < 1e-5, "{world:?} {ray:?}");
            let met = ray.meet_plane(world, [0.3, -0.5, 0.8]).expect("not along the plane");
            assert_near(met, world, 1e-4);
        }
        let ray = camera.ray_from_screen([123.0, 456.0], SIZE);
        let along = Vector3::from(ray.origin) + Vector3::from(ray.direction) * 3.0;
        assert_near(screen(&camera, along.into()), [123.0, 456.0], 1e-2);
    }
}

#[test]
fn a_ray_along_a_plane_does_not_meet_it() {
    let ray = Ray { origin: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    assert_eq!(ray.meet_plane([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]), None);
}

#[test]
fn depth_runs_from_near_to_far() {
    for camera in BOTH.map(askew) {
        let forward = Vector3::from(camera.right_up_forward()[2]);
        let depths = [-2.3, -1.0, 0.0, 1.0, 10.0].map(|along| {
            let world = Vector3::from(camera.target) + forward * along;
            camera.screen_from_world(world.into(), SIZE).expect("in front of the camera").depth
        });
        assert!(depths.is_sorted() && depths[0] >= 0.0 && depths[4] <= 1.0, "{depths:?}");
    }
    let perspective = askew(Projection::Perspective);
    let behind = Vector3::from(perspective.eye()) - Vector3::from(perspective.right_up_forward()[2]);
    assert_eq!(perspective.screen_from_world(behind.into(), SIZE), None);
}

#[test]
fn zooming_keeps_the_place_of_the_point_under_the_cursor() {
    for mut camera in BOTH.map(askew) {
        let cursor = [650.0, 120.0];
        let ray = camera.ray_from_screen(cursor, SIZE);
        let [_, _, forward] = camera.right_up_forward();
        let held = ray.meet_plane(camera.target, forward).expect("across");
        for factor in [1.2, 3.0, 0.1, 2.0] {
            let before = camera.distance;
            camera.zoom_at(factor, cursor, SIZE);
            assert!((camera.distance * factor / before - 1.0).abs() < 1e-5);
            assert_near(screen(&camera, held), cursor, 0.05);
        }
    }
}

#[test]
fn zooming_keeps_the_place_of_a_point_at_any_depth() {
    for mut camera in BOTH.map(askew) {
        let held = [0.9, 0.2, 0.7];
        let before = screen(&camera, held);
        camera.zoom_about(1.7, held);
        assert_near(screen(&camera, held), before, 0.02);
    }
}

#[test]
fn zooming_stays_within_the_range_of_distances() {
    let mut camera = askew(Projection::Perspective);
    for _ in 0..100 {
        camera.zoom_at(2.0, [0.0, 0.0], SIZE);
    }
    assert!(camera.distance <= DISTANCE_RANGE[0]);
    assert_eq!(camera.checked(), camera);
    let still = camera;
    for useless in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        camera.zoom_at(useless, [10.0, 10.0], SIZE);
        assert_eq!(camera, still);
    }
}

#[test]
fn panning_moves_the_plane_of_the_target() {
    for mut camera in BOTH.map(askew) {
        let [right, _, _] = camera.right_up_forward().map(Vector3::from);
        let grabbed = (Vector3::from(camera.target) + right * 0.2).into();
        let [x, y] = screen(&camera, grabbed);
        camera.pan([31.0, -17.0], SIZE[1]);
        assert_near(screen(&camera, grabbed), [x + 31.0, y - 17.0], 1e-2);
    }
}

#[test]
fn a_plane_seen_face_on_projects_its_normal_to_a_point() {
    let (normal, up) = ([0.3, -0.8, 0.52], [0.4, 0.6, 0.5]);
    let mut camera = askew(Projection::Orthographic);
    camera.face(normal, up);
    let along_normal: [f32; 3] = std::array::from_fn(|axis| camera.target[axis] + normal[axis]);
    assert_near(screen(&camera, along_normal), screen(&camera, camera.target), 1e-2);
    let along_up: [f32; 3] = std::array::from_fn(|axis| camera.target[axis] + 0.5 * up[axis]);
    let [x, y] = screen(&camera, along_up);
    assert!((x - 400.0).abs() < 1e-2 && y < 300.0, "{x} {y}");
    let nearer = camera.screen_from_world(along_normal, SIZE).expect("in front of the camera");
    assert!(nearer.depth < camera.screen_from_world(camera.target, SIZE).expect("in view").depth);
}

#[test]
fn a_plane_seen_edge_on_is_an_upright_line() {
    let (normal, up) = (Vector3::<f32>::new(0.6, -0.64, 0.48), Vector3::new(0.8, 0.48, -0.36));
    assert!(normal.dot(&up).abs() < 1e-6, "up lies in the plane");
    let mut camera = askew(Projection::Orthographic);
    camera.edge_on(normal.into(), up.into());
    let across = normal.cross(&up);
    for in_plane in [across, up, across * 0.3 - up * 0.5] {
        let [x, _] = screen(&camera, (Vector3::from(camera.target) + in_plane * 0.4).into());
        assert!((x - 400.0).abs() < 1e-2, "{x}");
    }
    assert!(screen(&camera, (Vector3::from(camera.target) + normal * 0.1).into())[0] > 410.0);
}

#[test]
fn presets_show_the_axes_in_the_documented_directions() {
    // The axis that points right and the axis that points up on the screen.
    for (preset, right, up) in [
        (Preset::Red, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        (Preset::Green, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        (Preset::Blue, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        (
            Preset::Gray,
            [-0.5_f32.sqrt(), 0.5_f32.sqrt(), 0.0],
            [-1.0, -1.0, 2.0].map(|c: f32| c / 6_f32.sqrt()),
        ),
    ] {
        let mut camera = askew(Projection::Orthographic);
        camera.preset(preset);
        let [right_found, up_found, _] = camera.right_up_forward();
        assert_near(right_found, right, 1e-5);
        assert_near(up_found, up, 1e-5);
    }
    let mut camera = Orbit { projection: Projection::Orthographic, ..Orbit::default() };
    camera.preset(Preset::Gray);
    assert_near(screen(&camera, [0.0; 3]), screen(&camera, [1.0; 3]), 1e-2);
}

#[test]
fn a_direction_without_length_changes_nothing() {
    let mut camera = askew(Projection::Perspective);
    let before = camera;
    camera.look_along([0.0; 3], [0.0, 0.0, 1.0]);
    assert_eq!(camera, before);
    // Where up is parallel to the direction, the view is still along the direction.
    camera.look_along([0.0, 0.0, 2.0], [0.0, 0.0, 1.0]);
    assert_near(camera.right_up_forward()[2], [0.0, 0.0, 1.0], 1e-5);
}

#[test]
fn orbiting_keeps_blue_up_and_the_distance() {
    let mut camera = Orbit::default();
    for step in 0..500 {
        camera.orbit([7.0, 5.0 * (step as f32 * 0.05).sin()]);
        let [right, up, _] = camera.right_up_forward();
        assert!(right[2].abs() < 1e-4, "the horizon is level: {right:?}");
        assert!(up[2] > -1e-4);
        assert_near(screen(&camera, camera.target), [400.0, 300.0], 0.05);
    }
    assert!(camera == camera.checked(), "still a unit quaternion");
}

#[test]
fn orbiting_moves_the_scene_with_the_drag() {
    // Points in front of the target move with the drag, to the right and down.
    let mut camera = Orbit::default();
    let front: [f32; 3] = {
        let forward = camera.right_up_forward()[2];
        std::array::from_fn(|axis| camera.target[axis] - 0.5 * forward[axis])
    };
    camera.orbit([10.0, 6.0]);
    let [x, y] = screen(&camera, front);
    assert!(x > 405.0 && y > 303.0, "{x} {y}");
}

#[test]
fn orbiting_stops_at_the_poles_and_comes_back() {
    let mut camera = Orbit::default();
    let heading = camera.yaw_pitch_roll()[0];
    camera.orbit([0.0, 1000.0]);
    assert_near(camera.right_up_forward()[2], [0.0, 0.0, -1.0], 1e-5);
    camera.orbit([0.0, -100.0]);
    let [yaw, pitch, roll] = camera.yaw_pitch_roll();
    assert_near([yaw, pitch.to_degrees(), roll], [heading, 100.0 * TURN_DEG_PER_PX - 90.0, 0.0], 1e-3);
    camera.orbit([0.0, -1000.0]);
    assert_near(camera.right_up_forward()[2], [0.0, 0.0, 1.0], 1e-5);
    camera.orbit([0.0, 100.0]);
    assert!((camera.yaw_pitch_roll()[0] - heading).abs() < 1e-3);
}

#[test]
fn orbiting_levels_a_tilted_view_without_a_jump() {
    let mut camera = Orbit::default();
    camera.face([0.2, -0.9, 0.3], [0.8, 0.2, 0.1]);
    let tilt = |camera: &Orbit| camera.yaw_pitch_roll()[2].to_degrees().abs();
    let mut before = tilt(&camera);
    assert!(before > 45.0, "{before}");
    camera.orbit([0.0, 0.0]);
    assert!((tilt(&camera) - before).abs() < 1e-2, "no motion, no leveling");
    for _ in 0..400 {
        camera.orbit([2.0, 0.0]);
        let now = tilt(&camera);
        assert!(now <= before + 1e-3 && before - now < 4.0, "{before}° → {now}°");
        before = now;
    }
    assert!(before < 0.1, "{before}");
}

#[test]
fn fitting_shows_the_whole_cube_and_fills_the_screen() {
    for projection in BOTH {
        for size in [[600.0, 600.0], [900.0, 300.0], [200.0, 700.0]] {
            let mut camera = askew(projection);
            camera.fit(size[0] / size[1]);
            let mut furthest = 0.0_f32;
            for corner in 0..8 {
                let world = [0, 1, 2].map(|axis| (corner >> axis & 1) as f32);
                let [x, y] = camera.screen_from_world(world, size).expect("in view").at;
                furthest = furthest.max((x / size[0] - 0.5).abs()).max((y / size[1] - 0.5).abs());
            }
            assert!((0.35..0.5).contains(&furthest), "{projection:?} {size:?}: {furthest}");
        }
    }
}

#[test]
fn stored_and_read_again() {
    let camera = askew(Projection::Orthographic);
    let text = serde_json::to_string(&camera).expect("plain numbers");
    assert!(text.contains("\"orthographic\""), "{text}");
    let read: Orbit = serde_json::from_str(&text).expect("what was written");
    assert_eq!(read.checked(), camera);
    for broken in [
        Orbit { distance: 0.0, ..camera },
        Orbit { target: [f32::NAN, 0.0, 0.0], ..camera },
        Orbit { orientation: [0.0; 4], ..camera },
    ] {
        assert_eq!(broken.checked(), Orbit::default());
    }
}
