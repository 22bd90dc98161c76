//! Time of the analysis, compared with the least time that any analysis needs: `cargo bench`.
//!
//! For each image size it prints the best of several runs of
//! (a) a copy of the image, f32 RGB;
//! (b) the floor: one fused pass over it on one thread, mean and covariance of every 10×10 window, which is the least
//!     that any analysis of color clusters has to do. With the vector instructions that every x86-64 has it takes
//!     five to ten copies: (a) stands beside it to show how far away memory itself is;
//! (c) the whole analysis, masks to split, with default parameters and all threads;
//! (c) as a multiple of (b), and (c) per pixel. A ratio travels between machines better than a time; nothing here passes or
//! fails. The larger sizes, up to 96 megapixels, are measured by `cargo bench` alone.
//!
//! Then, for the embedded sample and for a tiling of it, what one movement of a slider costs: a session that holds the
//! result of the default parameters runs again after one parameter or switch has changed. Best and median of several runs,
//! and the best as a multiple of (b). For the largest tiling, the stages of a first run, also with the bands exchanged from cell to cell, so that
//! most pixels are split locally, and what one movement of a slider costs
//! until the result for the working picture is there, which the window shows at once, and until all of it is there.
//!
//! Last, the cost of recording every decision: time of a recorded run as a multiple of an unrecorded one, bytes per
//! pixel,
//! and the time to restore the state at a step.
//!
//! `cargo record` (an alias of `cargo bench --bench pipeline -- --record`) prints the first table alone and appends its ratios
//! to `benches/history.csv`, with the version and the revision that they were measured at.

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use dichroscope::analysis::{Analysis, Observer, Session, Stage};
use dichroscope::params::{IlluminantSetting, Parameter, Params, Setting, Switch};
use dichroscope::photo::{LinearImage, ReadOptions, read};
use dichroscope::raster::{Blocks, Raster};
use dichroscope::trace::Replay;
use std::fs::OpenOptions;
use std::hint::black_box;
use std::io::Write as _;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

const WINDOW_PX: usize = 10;
/// Number of values in one row of a window: three bands per pixel.
const LANES: usize = 3 * WINDOW_PX;
/// Sizes of pictures for the comparison with the floor, pixels.
const SMALL_PX: [[usize; 2]; 2] = [[580, 432], [1160, 864]];
/// Sizes of pictures of cameras, pixels.
const LARGE_PX: [[usize; 2]; 3] = [[4000, 3000], [6000, 4000], [12_000, 8000]];

fn main() {
    // As the program does at its start (`keep_freed_memory`), so that a run does not wait for fresh memory.
    drop(black_box(Vec::<u8>::with_capacity(6 << 20)));
    // `cargo bench` passes `--bench`. Without it (`cargo test --benches`), one run shows that the benchmark works.
    let asked = |name: &str| std::env::args().any(|argument| argument == name);
    let runs = if asked("--bench") { 15 } else { 1 };
    println!(
        "{:>10}  {:>9}  {:>9}  {:>10}  {:>7}  {:>9}",
        "size", "copy", "floor", "analysis", "ratio", "per pixel"
    );
    let mut ratios = Vec::new();
    let large: &[[usize; 2]] = if asked("--bench") { &LARGE_PX } else { &[] };
    for &size_px in SMALL_PX.iter().chain(large) {
        let runs = if large.contains(&size_px) { runs.min(5) } else { runs };
        let image = Arc::new(synthetic::Scene::grid_of_balls(size_px, 4, 3, 1).render().image);
        let copy = best_of(runs, || image.pixels.clone());
        let floor = best_of(runs, || window_moments(&image.pixels));
        let analysis = best_of(runs, || Session::new(image.clone()).run(&Params::default(), &mut ()));
        let (megapixels, ratio) =
            (image.pixels.len() as f64 / 1e6, analysis.as_secs_f64() / floor.as_secs_f64());
        println!(
            "{megapixels:>7.2} MP  {}  {}  {}  {ratio:>6.1}×  {:>6.1} ns",
            milliseconds(copy),
            milliseconds(floor),
            milliseconds(analysis),
            1e3 * analysis.as_secs_f64() / megapixels,
        );
        ratios.push((megapixels, ratio));
    }
    if asked("--record") {
        record(&ratios).expect("benches/history.csv can be written");
        return;
    }
    let runs = runs.min(7);
    sliders(1, runs);
    sliders(2, runs);
    stages("plain", &sample(7), runs.min(3));
    stages("checks", &checks(7), runs.min(3));
    previews(7, runs);
    println!(
        "\n{:>10}  {:>9}  {:>7}  {:>8}  {:>9}  {:>9}",
        "trace", "recorded", "ratio", "bytes/px", "seek", "worst"
    );
    for tiles in [1, 2, 7] {
        traces(tiles, if tiles > 2 { runs.min(3) } else { runs });
    }
}

/// Appends a line to the history for each picture size: version, revision of the sources, threads, megapixels, and the
/// analysis as a multiple of the floor.
fn record(ratios: &[(f64, f64)]) -> std::io::Result<()> {
    let folder = env!("CARGO_MANIFEST_DIR");
    let revision = Command::new("git").args(["-C", folder, "describe", "--always", "--dirty"]).output();
    let revision = revision.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    let revision = revision.unwrap_or_default();
    let threads = std::thread::available_parallelism()?;
    let mut history = OpenOptions::new().append(true).open(Path::new(folder).join("benches/history.csv"))?;
    for (megapixels, ratio) in ratios {
        let version = env!("CARGO_PKG_VERSION");
        writeln!(history, "{version},{revision},{threads},{megapixels:.2},{ratio:.1}")?;
    }
    Ok(())
}

/// The sample scene, repeated `tiles` times in both directions.
fn sample(tiles: usize) -> Arc<LinearImage> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/plastic8_white/camera8.png"));
    let one =
        read(path, &ReadOptions::default()).expect("invariant: the sample is part of the repository").image;
    let mut pixels = Vec::with_capacity(one.pixels.len() * tiles * tiles);
    for y in 0..one.height() * tiles {
        for _ in 0..tiles {
            pixels.extend_from_slice(one.pixels.row(y % one.height()));
        }
    }
    let pixels = Raster::from_vec(one.width() * tiles, one.height() * tiles, pixels);
    Arc::new(LinearImage::new(pixels.expect("invariant: the tiles fill it"), one.saturation))
}

/// The sample scene, repeated like [`sample`], with the bands exchanged from cell to cell: as in a photograph of prints, leaves and text, the model fits
/// hardly any region, and most pixels are split locally.
fn checks(tiles: usize) -> Arc<LinearImage> {
    const CELL_PX: [usize; 2] = [45, 35];
    let plain = sample(tiles);
    let width = plain.width();
    let exchanged = plain.pixels.as_slice().iter().enumerate().map(|(pixel, &color)| {
        let cell = pixel % width / CELL_PX[0] + 5 * (pixel / width / CELL_PX[1]);
        std::array::from_fn(|band| color[(band + cell) % 3])
    });
    let pixels = Raster::from_vec(width, plain.height(), exchanged.collect());
    Arc::new(LinearImage::new(pixels.expect("invariant: as many pixels"), plain.saturation))
}

/// For each parameter and switch: its name, and the default parameters with a slightly changed value of it.
fn movements(image: &Arc<LinearImage>) -> Vec<(&'static str, Params)> {
    let base = Params::default();
    let used = Session::new(image.clone()).run(&base, &mut ()).expect("invariant: nobody cancels").used;
    let mut all: Vec<(&'static str, Params)> = Vec::new();
    for parameter in Parameter::ALL {
        let (spec, number) = (parameter.spec(), used.get(parameter));
        let mut moved = base;
        *moved.slot(parameter) = Setting::Value(if spec.whole { number + 1.0 } else { number * 1.05 });
        all.push((spec.name, moved));
    }
    all.push(("illuminant", Params { illuminant: IlluminantSetting::Given([1.0, 1.0, 0.9]), ..base }));
    for switch in Switch::ALL {
        let mut moved = base;
        moved.refine.set(switch, false);
        all.push((switch.name(), moved));
    }
    all
}

fn sliders(tiles: usize, runs: usize) {
    let image = sample(tiles);
    let floor = best_of(runs, || window_moments(&image.pixels));
    let pixels = image.pixels.len() as f64 / 1e6;
    println!("\n{pixels:>7.2} MP  {:>19}  {:>9}  {:>9}  {:>7}", "moved", "best", "median", "ratio");
    for (name, moved) in movements(&image) {
        let mut session = Session::new(image.clone());
        let mut times: Vec<Duration> = (0..runs)
            .map(|_| {
                let _ = session.run(&Params::default(), &mut ());
                best_of(1, || session.run(&moved, &mut ()))
            })
            .collect();
        times.sort_unstable();
        let (best, median) = (times[0], times[runs / 2]);
        let ratio = best.as_secs_f64() / floor.as_secs_f64();
        println!("{name:>31}  {}  {}  {ratio:>6.1}\u{d7}", milliseconds(best), milliseconds(median));
    }
}

/// The shortest time of each stage.
#[derive(Default)]
struct StageTimes {
    begun: Option<Instant>,
    best: [Option<Duration>; Stage::ALL.len()],
}

impl Observer for StageTimes {
    fn started(&mut self, _stage: Stage) {
        self.begun = Some(Instant::now());
    }

    fn finished(&mut self, stage: Stage, _reused: bool) {
        let took = self.begun.take().map(|begun| begun.elapsed());
        let best = &mut self.best[stage as usize];
        *best = [*best, took].into_iter().flatten().min();
    }
}

fn stages(name: &str, image: &Arc<LinearImage>, runs: usize) {
    let mut times = StageTimes::default();
    let whole = best_of(runs, || Session::new(image.clone()).run(&Params::default(), &mut times));
    let floor = best_of(runs, || window_moments(&image.pixels));
    let ratio = whole.as_secs_f64() / floor.as_secs_f64();
    let megapixels = image.pixels.len() as f64 / 1e6;
    println!("\n{megapixels:>7.2} MP  {:>19}  {}  {ratio:>6.1}\u{d7}", name, milliseconds(whole));
    for stage in Stage::ALL {
        println!("{:>31}  {}", stage.name(), milliseconds(times.best[stage as usize].unwrap_or_default()));
    }
}

/// The times of one run until the result for the working picture was there.
#[derive(Default)]
struct PreviewTime {
    begun: Option<Instant>,
    working: Option<Duration>,
}

impl Observer for PreviewTime {
    fn working_made(&mut self, _analysis: &Analysis, _blocks: &Blocks) {
        self.working = self.begun.map(|begun| begun.elapsed());
    }
}

fn previews(tiles: usize, runs: usize) {
    let image = sample(tiles);
    let floor = best_of(runs.min(3), || window_moments(&image.pixels)).as_secs_f64();
    let megapixels = image.pixels.len() as f64 / 1e6;
    println!("\n{megapixels:>7.2} MP  {:>19}  {:>9}  {:>9}  {:>7}", "moved", "working", "whole", "ratio");
    for (name, moved) in movements(&image).into_iter().take(Parameter::ALL.len() + 1) {
        let mut session = Session::new(image.clone());
        let mut times: Vec<(Duration, Duration)> = (0..runs)
            .map(|_| {
                let _ = session.run(&Params::default(), &mut ());
                let mut time = PreviewTime { begun: Some(Instant::now()), working: None };
                let whole = best_of(1, || session.run(&moved, &mut time));
                (time.working.unwrap_or(whole), whole)
            })
            .collect();
        times.sort_unstable();
        let (working, whole) = times[runs / 2];
        let ratio = whole.as_secs_f64() / floor;
        println!("{name:>31}  {}  {}  {ratio:>6.1}\u{d7}", milliseconds(working), milliseconds(whole));
    }
}

fn traces(tiles: usize, runs: usize) {
    let (image, params) = (sample(tiles), Params::default());
    let plain = best_of(runs, || Session::new(image.clone()).run(&params, &mut ()));
    let recorded = best_of(runs, || Session::new(image.clone()).run_traced(&params, &mut ()));
    let (_, trace) =
        Session::new(image.clone()).run_traced(&params, &mut ()).expect("invariant: nobody cancels");
    let trace = Arc::new(trace);
    let mut replay = Replay::new(Arc::clone(&trace));
    replay.prepare();
    // Multiplicative hashing gives steps spread evenly over the trace, the same on every run.
    let places = (1..=100u64).map(|i| (i.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11) as usize % trace.len());
    let mut seeks: Vec<Duration> = places.map(|place| best_of(1, || replay.seek(place))).collect();
    seeks.sort_unstable();
    let pixels = image.pixels.len() as f64;
    println!(
        "{:>7.2} MP  {}  {:>6.2}\u{d7}  {:>8.1}  {}  {}",
        pixels / 1e6,
        milliseconds(recorded),
        recorded.as_secs_f64() / plain.as_secs_f64(),
        (trace.bytes() + replay.bytes()) as f64 / pixels,
        milliseconds(seeks[seeks.len() / 2]),
        milliseconds(seeks[seeks.len() - 1]),
    );
}

fn milliseconds(time: Duration) -> String {
    format!("{:>6.2} ms", time.as_secs_f64() * 1e3)
}

/// The shortest time of `runs` runs: other work on the machine only makes runs longer.
fn best_of<T>(runs: usize, mut work: impl FnMut() -> T) -> Duration {
    let timed = (0..runs).map(|_| {
        let started = Instant::now();
        black_box(work());
        started.elapsed()
    });
    timed.min().unwrap_or_default()
}

/// Mean and covariance (rr, gg, bb, rg, gb, rb) of a window, in counts.
type Moments = ([f32; 3], [f32; 6]);

/// The moments of every whole window, row-major.
fn window_moments(pixels: &Raster<[f32; 3]>) -> Vec<Moments> {
    let (columns, rows) = (pixels.width() / WINDOW_PX, pixels.height() / WINDOW_PX);
    let mut moments = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            moments.push(moments_of(std::array::from_fn(|line| {
                let whole_row = pixels.row(row * WINDOW_PX + line).as_flattened();
                whole_row[column * LANES..].first_chunk().expect("invariant: the window is whole")
            })));
        }
    }
    moments
}

/// Mean and covariance of one window. Sums are taken per lane (value of a row), so that the compiler can use vector
/// instructions, and added per band at the end. Of the products of neighboring lanes, only those within a pixel are
/// used.
#[expect(clippy::needless_range_loop, reason = "each lane is read together with its neighbors")]
fn moments_of(lines: [&[f32; LANES]; WINDOW_PX]) -> Moments {
    // Values are relative to the window's first pixel, because the covariance would lose too much precision in `f32`
    // otherwise.
    let origin: [f32; LANES] = std::array::from_fn(|lane| lines[0][lane % 3]);
    let mut sums = [[0.0_f32; LANES]; 4];
    let [plain, squares, next, after_next] = &mut sums;
    for line in lines {
        let value = |lane: usize| line[lane] - origin[lane];
        for lane in 0..LANES {
            plain[lane] += value(lane);
            squares[lane] += value(lane) * value(lane);
        }
        for lane in 0..LANES - 1 {
            next[lane] += value(lane) * value(lane + 1);
        }
        for lane in 0..LANES - 2 {
            after_next[lane] += value(lane) * value(lane + 2);
        }
    }
    let n = (WINDOW_PX * WINDOW_PX) as f32;
    let over_window = |kind: usize, band: usize| {
        let (pixels, _) = sums[kind].as_chunks::<3>();
        pixels.iter().map(|bands| bands[band]).sum::<f32>() / n
    };
    let offset = [0, 1, 2].map(|band| over_window(0, band));
    let products = [(1, 0, 0), (1, 1, 1), (1, 2, 2), (2, 0, 1), (2, 1, 2), (3, 0, 2)];
    let covariance = products.map(|(kind, a, b)| over_window(kind, a) - offset[a] * offset[b]);
    ([0, 1, 2].map(|band| origin[band] + offset[band]), covariance)
}
