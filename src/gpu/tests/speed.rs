//! Prints the duration of a frame and of a search; checks nothing.

use super::*;
use std::time::{Duration, Instant};

/// `cargo test --release frame_times -- --ignored --nocapture`: prints the duration of a frame and of a search on this
/// machine.
#[test]
#[ignore = "measures, and judges nothing"]
fn frame_times() {
    let Some(device) = device() else { return };
    let adapter = device.adapter.get_info();
    println!("{}, {:?}, 800×600, best and median of 15", adapter.name, adapter.backend);
    for (side, size_px) in [(31, 3.0), (64, 1.5), (64, 3.0)] {
        let points = lattice(side, size_px);
        let name = format!("{} points of {size_px} px", points.len());
        let mut scene = scene_of(points.clone());
        report_frames(&name, device, &scene);
        let tube = shapes::cylinder([0.0; 3], [0.9, 0.4, 0.2], 0.04, 48, [255, 160, 60, 70]);
        let slice =
            shapes::slab(&shapes::plane_in_cube([0.5; 3], [0.5, -0.7, 0.1]), 0.02, [80, 160, 255, 50]);
        scene.meshes = vec![Mesh::new(tube), Mesh::new(slice)];
        scene.lines = Batch::new(shapes::cube_edges().map(|[a, b]| line(a, b, Overlay::Faint)).to_vec());
        report_frames(&format!("{name}, solids and lines"), device, &scene);
        let projector = Orbit::default().projector([800.0, 600.0]);
        report(&format!("{name}: nearest"), |turn| {
            let started = Instant::now();
            let cursor = [400.0 + turn as f32, 300.0];
            assert!(pick::nearest(&points, &projector, cursor, 8.0).is_some());
            started.elapsed()
        });
    }
}

/// Points on a lattice through the whole cube, `side` points along each axis.
fn lattice(side: usize, size_px: f32) -> Vec<Point> {
    let at = |index: usize| (index % side) as f32 / (side - 1) as f32;
    let place = |index: usize| [at(index), at(index / side), at(index / side / side)];
    let colored = |p: [f32; 3]| dot(p, [p[0], p[1], p[2], 1.0].map(|c| (255.0 * c) as u8), size_px);
    (0..side.pow(3)).map(|index| colored(place(index))).collect()
}

/// Measures frames while the camera turns, with the work of the device and without the uploads of the first frame.
fn report_frames(name: &str, Headless { device, queue, .. }: &Headless, scene: &Scene) {
    let mut renderer = Renderer::new(device);
    let mut camera = Orbit::default();
    let mut frame = |_| {
        camera.orbit([5.0, 0.0]);
        let started = Instant::now();
        assert!(renderer.draw(device, queue, scene, &camera, [800, 600], 1.0));
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the device is there");
        started.elapsed()
    };
    frame(0);
    report(name, frame);
}

fn report(name: &str, run: impl FnMut(usize) -> Duration) {
    let mut times: Vec<_> = (0..15).map(run).collect();
    times.sort();
    println!("{name:>45}: {:7.2} {:7.2} ms", times[0].as_secs_f64() * 1e3, times[7].as_secs_f64() * 1e3);
}
