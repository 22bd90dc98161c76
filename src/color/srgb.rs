//! The tone curve of sRGB (IEC 61966-2-1).

/// Linear light of a coded value; both are 0 for black and 1 for white. The curve is defined above 1 too.
pub fn linear_from_srgb(coded: f64) -> f64 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// Coded value of linear light; both are 0 for black and 1 for white.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coding_and_decoding_are_inverse_and_keep_black_and_white() {
        for step in 0..=1000 {
            let linear = f64::from(step) / 1000.0;
            let back = linear_from_srgb(f64::from(srgb_from_linear(linear as f32)));
            assert!((back - linear).abs() < 1e-5, "{linear} comes back as {back}");
        }
        assert!(linear_from_srgb(0.0).abs() < 1e-12 && (linear_from_srgb(1.0) - 1.0).abs() < 1e-12);
        // Middle gray of the standard: code 188 is half of the light of white.
        assert!((linear_from_srgb(188.0 / 255.0) - 0.5).abs() < 0.01);
    }
}
