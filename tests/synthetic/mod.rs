//! Test images with ground truth: shiny balls, ray-cast analytically, whose colors form skewed T's.
//!
//! Each ball is a sphere under parallel light, seen along −z by an orthographic camera: x runs right, y down, z towards
//! the camera, in pixels. Where the light reaches, its color is C = m_b·C_b + m_s·C_s with a Lambertian body
//! m_b = cos i and a Beckmann lobe m_s = exp(−tan²δ/m²), δ the angle between the normal and the bisector of light and
//! view. Every pixel is sampled at its center, so that no pixel mixes two objects and the model holds exactly before
//! noise, clipping and rounding. No cast shadows, no inter-reflection. The same scene gives the same bytes everywhere.
//!
//! A test includes this module with `mod synthetic;`, a benchmark with `#[path]`.

#![allow(dead_code, reason = "each test binary that includes this file uses a part of it")]

use dichroscope::photo::LinearImage;
use dichroscope::raster::{LabelMap, Raster, UNASSIGNED};

/// Counts at which the camera is saturated.
pub const FULL_SCALE: f64 = 255.0;

/// A shiny sphere in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Column and row of the center. All centers have the same depth, so that a larger ball covers a smaller one.
    pub center_px: [f64; 2],
    /// Radius, pixels.
    pub radius_px: f64,
    /// Body reflection vector C_b, unit length.
    pub body: [f64; 3],
    /// Length of the body reflection where m_b = 1, counts.
    pub body_counts: f64,
    /// Length of the surface reflection where m_s = 1, counts.
    pub surface_counts: f64,
    /// Beckmann's m, the root mean square slope of the surface: 0.1 is glossy, 0.4 dull.
    pub roughness: f64,
}

/// The objects in front of the camera, the light, and the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Columns and rows of the image.
    pub size_px: [usize; 2],
    /// The objects; ball `i` carries the label `i + 1`.
    pub balls: Vec<Ball>,
    /// Direction towards the light, unit length.
    pub light: [f64; 3],
    /// Surface reflection vector C_s, which is the color of the light, unit length.
    pub illuminant: [f64; 3],
    /// Standard deviation of the camera's Gaussian noise, counts.
    pub noise_sigma: f64,
    /// Whether the camera has 8 bits, i.e. rounds to whole counts and clips to 0…255. Otherwise it clips above 255
    /// only.
    pub eight_bit: bool,
    /// Seed of the random noise.
    pub seed: u64,
}

/// The image and its ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// The photograph, with noise, clipping and rounding.
    pub image: LinearImage,
    /// Label of the object at each pixel, lit or not; 0 for the black background.
    pub labels: LabelMap,
    /// Body reflection m_b·C_b, counts, without noise, clipping and rounding.
    pub body: Raster<[f32; 3]>,
    /// Surface reflection m_s·C_s, counts, without noise, clipping and rounding.
    pub surface: Raster<[f32; 3]>,
}

/// Least angle between the body colors of two balls of [`Scene::grid_of_balls`], degrees.
const LEAST_COLOR_ANGLE_DEG: f64 = 4.0;

impl Scene {
    /// One plastic ball in the middle, lit from the upper left, 45° from the camera, by white light; no noise.
    pub fn one_ball(size_px: [usize; 2], body: [f64; 3]) -> Self {
        let [width, height] = size_px.map(|n| n as f64);
        let ball = Ball {
            center_px: [width / 2.0, height / 2.0],
            radius_px: 0.4 * width.min(height),
            body: unit(body),
            body_counts: 180.0,
            surface_counts: 200.0,
            roughness: 0.15,
        };
        Self {
            size_px,
            balls: vec![ball],
            light: unit([-0.5, -0.5, 0.5_f64.sqrt()]),
            illuminant: unit([1.0; 3]),
            noise_sigma: 0.0,
            eight_bit: false,
            seed: 1,
        }
    }

    /// Like [`Scene::one_ball`], but with `columns × rows` balls of random color, size, strength and gloss, and an
    /// 8-bit camera with noise. Body colors are at least [`LEAST_COLOR_ANGLE_DEG`] apart: the method takes neighboring
    /// balls of nearly the same color for one object behind a shadow, and says so.
    pub fn grid_of_balls(size_px: [usize; 2], columns: usize, rows: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let cell_px = [size_px[0] as f64 / columns as f64, size_px[1] as f64 / rows as f64];
        let mut colors: Vec<[f64; 3]> = Vec::new();
        let mut color_apart = |random: &mut Random| loop {
            let color = random.saturated_color();
            let cosine = LEAST_COLOR_ANGLE_DEG.to_radians().cos();
            if colors.iter().all(|other| dot(*other, color) < cosine) {
                colors.push(color);
                return color;
            }
        };
        let balls = (0..columns * rows)
            .map(|i| Ball {
                center_px: [
                    ((i % columns) as f64 + 0.5) * cell_px[0],
                    ((i / columns) as f64 + 0.5) * cell_px[1],
                ],
                radius_px: cell_px[0].min(cell_px[1]) * random.between(0.35, 0.5),
                body: color_apart(&mut random),
                body_counts: random.between(120.0, 240.0),
                surface_counts: random.between(120.0, 300.0),
                roughness: random.between(0.1, 0.25),
            })
            .collect();
        Self { balls, noise_sigma: 1.25, eight_bit: true, seed, ..Self::one_ball(size_px, [1.0; 3]) }
    }

    /// Renders the scene, and simulates the camera.
    pub fn render(&self) -> Rendered {
        let [width, height] = self.size_px;
        let mut labels = Raster::filled(width, height, UNASSIGNED);
        let mut body = Raster::filled(width, height, [0.0; 3]);
        let mut surface = body.clone();
        let mut photograph = body.clone();
        let mut noise = Random::new(self.seed);
        for index in 0..labels.len() {
            let center_px = [(index % width) as f64 + 0.5, (index / width) as f64 + 0.5];
            let mut seen = [[0.0; 3]; 2];
            if let Some((number, normal)) = self.hit(center_px) {
                labels[index] = number as u16 + 1;
                seen = self.reflection(&self.balls[number], normal);
            }
            body[index] = seen[0].map(|v| v as f32);
            surface[index] = seen[1].map(|v| v as f32);
            photograph[index] =
                [0, 1, 2].map(|band| self.expose(seen[0][band] + seen[1][band], &mut noise) as f32);
        }
        Rendered { image: LinearImage::new(photograph, Some(FULL_SCALE as f32)), labels, body, surface }
    }

    /// The foremost ball at a pixel, and the ball's normal there; `None` for the background.
    fn hit(&self, at_px: [f64; 2]) -> Option<(usize, [f64; 3])> {
        let hits = self.balls.iter().enumerate().filter_map(|(number, ball)| {
            let [x, y] = [0, 1].map(|axis| (at_px[axis] - ball.center_px[axis]) / ball.radius_px);
            let z_squared = 1.0 - x * x - y * y;
            (z_squared > 0.0).then(|| (number, [x, y, z_squared.sqrt()]))
        });
        hits.max_by(|a, b| {
            let height_px = |hit: &(usize, [f64; 3])| hit.1[2] * self.balls[hit.0].radius_px;
            height_px(a).total_cmp(&height_px(b))
        })
    }

    /// Body reflection m_b·C_b and surface reflection m_s·C_s, counts.
    fn reflection(&self, ball: &Ball, normal: [f64; 3]) -> [[f64; 3]; 2] {
        let cos_incidence = dot(normal, self.light);
        if cos_incidence <= 0.0 {
            return [[0.0; 3]; 2];
        }
        let [x, y, z] = self.light;
        let cos_squared = dot(normal, unit([x, y, z + 1.0])).powi(2);
        let tan_squared = (1.0 - cos_squared) / cos_squared;
        let lobe = (-tan_squared / ball.roughness.powi(2)).exp();
        [
            ball.body.map(|c| c * ball.body_counts * cos_incidence),
            self.illuminant.map(|c| c * ball.surface_counts * lobe),
        ]
    }

    /// The camera's value of one band: noise, clipping and rounding.
    fn expose(&self, counts: f64, noise: &mut Random) -> f64 {
        let noisy = counts + self.noise_sigma * noise.normal();
        if self.eight_bit { noisy.round().clamp(0.0, FULL_SCALE) } else { noisy.min(FULL_SCALE) }
    }
}

/// A deterministic random number generator: the upper bits of Knuth's MMIX linear congruential generator.
pub struct Random(u64);

impl Random {
    /// A generator that depends on `seed` alone.
    pub fn new(seed: u64) -> Self {
        let mut random = Self(seed);
        // Neighboring seeds differ in their low bits, which reach the upper bits after one step.
        random.unit();
        random.unit();
        random
    }

    /// A number uniform in 0…1, 1 excluded.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // An f64 has a significand of 53 bits.
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number uniform in `low…high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A normally distributed number with mean 0 and standard deviation 1 (Box–Muller, the cosine half).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// A unit vector with one strong, one medium and one weak band in random order.
    pub fn saturated_color(&mut self) -> [f64; 3] {
        let mut bands = [self.between(0.8, 1.0), self.between(0.25, 0.7), self.between(0.05, 0.2)];
        bands.rotate_left((self.unit() * 3.0) as usize);
        if self.unit() < 0.5 {
            bands.swap(0, 1);
        }
        unit(bands)
    }
}

/// `vector` scaled to unit length.
pub fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = dot(vector, vector).sqrt();
    vector.map(|v| v / length)
}

/// Inner product of two vectors.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
