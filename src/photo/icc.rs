//! Reads the tone curves of an ICC profile (ICC.1:2022, 9.2, 10.6 and 10.18). Primaries and white point are not used.

use super::curve::ToneCurve;
use moxcms::{ColorProfile, ToneReprCurve};

/// The curves of the red, green and blue band; three equal curves for a gray picture.
///
/// # Errors
/// The reason, within a sentence, why the profile's tone curves cannot be used.
pub(super) fn tone_curves(profile: &[u8], gray: bool) -> Result<[ToneCurve; 3], String> {
    let parsed = ColorProfile::new_from_slice(profile)
        .map_err(|error| format!("the ICC profile is broken ({error})"))?;
    let bands = if gray {
        // Some programs embed an RGB profile in gray pictures.
        let band = parsed.gray_trc.as_ref().or(parsed.green_trc.as_ref());
        [band, band, band]
    } else {
        [parsed.red_trc.as_ref(), parsed.green_trc.as_ref(), parsed.blue_trc.as_ref()]
    };
    let [Some(red), Some(green), Some(blue)] = bands else {
        let has_lookup_table =
            [&parsed.lut_a_to_b_perceptual, &parsed.lut_a_to_b_colorimetric, &parsed.lut_a_to_b_saturation];
        return Err(if has_lookup_table.iter().any(|table| table.is_some()) {
            "the ICC profile is a color lookup table, not tone curves".into()
        } else if gray {
            "the ICC profile has no tone curve for a gray picture".into()
        } else {
            "the ICC profile has no tone curves for an RGB picture".into()
        });
    };
    Ok([curve(red)?, curve(green)?, curve(blue)?])
}

fn curve(coded: &ToneReprCurve) -> Result<ToneCurve, String> {
    let curve = match coded {
        ToneReprCurve::Lut(values) => match values[..] {
            [] => ToneCurve::Linear,
            // The value has the type u8Fixed8Number.
            [exponent] => gamma(f64::from(exponent) / 256.0),
            _ => ToneCurve::Table(values.clone()),
        },
        ToneReprCurve::Parametric(parameters) => parametric(parameters)?,
    };
    if curve.is_usable() {
        Ok(curve)
    } else {
        Err("the ICC profile has a tone curve that cannot be undone".into())
    }
}

/// The five function types of `parametricCurveType`, recognized by their number of parameters.
fn parametric(parameters: &[f32]) -> Result<ToneCurve, String> {
    let p: Vec<f64> = parameters.iter().map(|&v| f64::from(v)).collect();
    Ok(match p[..] {
        [g] => gamma(g),
        [g, a, b] => ToneCurve::Parametric { g, a, b, c: 0.0, d: -b / a, e: 0.0, f: 0.0 },
        [g, a, b, c] => ToneCurve::Parametric { g, a, b, c: 0.0, d: -b / a, e: c, f: c },
        [g, a, b, c, d] => ToneCurve::Parametric { g, a, b, c, d, e: 0.0, f: 0.0 },
        [g, a, b, c, d, e, f] => ToneCurve::Parametric { g, a, b, c, d, e, f },
        _ => return Err("the ICC profile has a tone curve of an unknown kind".into()),
    })
}

#[allow(clippy::float_cmp, reason = "1.0 is coded exactly")]
fn gamma(exponent: f64) -> ToneCurve {
    if exponent == 1.0 { ToneCurve::Linear } else { ToneCurve::Gamma(exponent) }
}
