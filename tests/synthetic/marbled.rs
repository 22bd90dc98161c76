//! A test image: a marbled sheet under small highlights, some of them clipped, with gray specks printed along its
//! lower edge.
//! The skewed T explains no region of this image, so that every rule of the local split has something to decide.

/// Columns and rows of the image.
pub const SIZE_PX: [usize; 2] = [240, 160];

/// The image: 8-bit RGB, row-major. `body_share` scales the body reflection; the noise is a fixed pattern.
pub fn marbled(body_share: f64) -> Vec<[u8; 3]> {
    let [width, height] = SIZE_PX;
    (0..width * height).map(|pixel| color(pixel % width, pixel / width, body_share)).collect()
}

fn color(x: usize, y: usize, body_share: f64) -> [u8; 3] {
    let light = [0.633, 0.576, 0.518];
    let (u, v) = (x as f64, y as f64);
    let share = 0.5 + 0.5 * (u / 9.0 + 2.0 * (v / 17.0).sin()).sin();
    let mut body = [0, 1, 2].map(|k| share * [0.85, 0.35, 0.2][k] + (1.0 - share) * [0.35, 0.55, 0.25][k]);
    if y >= 128 && (x / 4).is_multiple_of(2) && (y / 4).is_multiple_of(2) {
        let gray = body.iter().sum::<f64>() / 3.0;
        body = body.map(|band| 0.4 * band + 0.6 * gray);
    }
    let shade = body_share * (90.0 + 0.2 * u + 0.2 * v);
    let mut surface = 0.0;
    for middle_y in [20, 60, 100usize] {
        for middle_x in (20..240usize).step_by(40) {
            let peak = 80 + (7 * middle_x + 3 * middle_y) / 20 % 5 * 80;
            let distance2 = (u - middle_x as f64).powi(2) + (v - middle_y as f64).powi(2);
            surface += peak as f64 * (-distance2 / 24.0).exp();
        }
    }
    [0, 1, 2].map(|k| {
        let noise = ((31 * x + 17 * y + 7 * k) * 7919 % 13) as f64 - 6.0;
        (body[k] * shade + light[k] * surface + 0.3 * noise).round().clamp(0.0, 255.0) as u8
    })
}
