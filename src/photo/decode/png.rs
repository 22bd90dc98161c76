//! Decoder of PNG (3rd edition), based on the `png` crate, because the `image` crate does not return the color chunks.

use super::{Budget, Decoded};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Density, DensityUnit, Layout, PngColor, Samples};
use image::metadata::Orientation;
use png::{BitDepth, ColorType, Decoder, Info, Limits, Transformations};
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    if bytes.get(12..16) == Some(b"CgBI") {
        return Err(Fault::unsupported("Apple's variant of PNG (CgBI)", CONVERT));
    }
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: budget.working_bytes() });
    decoder.set_ignore_text_chunk(true);
    // The crate replaces palette indices by colors, converts tRNS to alpha, and scales 1, 2 and 4 bits to 8, which is
    // exact.
    decoder.set_transformations(Transformations::EXPAND);
    let header = decoder.read_header_info()?;
    let size = budget.admit(header.width, header.height)?;

    let mut reader = decoder.read_info()?;
    let length = reader.output_buffer_size().ok_or_else(|| Fault::damaged("its rows are too long"))?;
    let mut data = vec![0; length];
    reader.next_frame(&mut data)?;

    let (color, depth) = reader.output_color_type();
    let layout = match color {
        ColorType::Grayscale => Layout::Gray,
        ColorType::GrayscaleAlpha => Layout::GrayAlpha,
        ColorType::Rgb => Layout::Rgb,
        ColorType::Rgba => Layout::Rgba,
        ColorType::Indexed => return Err(Fault::damaged("its palette is missing")),
    };
    let samples = if depth == BitDepth::Sixteen {
        Samples::U16(data.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect())
    } else {
        Samples::U8(data)
    };
    let info = reader.info();
    let mut decoded = Decoded::plain(size, layout, samples);
    decoded.cicp = info.coding_independent_code_points.map(|points| {
        let range = u8::from(points.is_video_full_range_image);
        [points.color_primaries, points.transfer_function, points.matrix_coefficients, range]
    });
    decoded.png = color_chunks(info);
    decoded.icc = info.icc_profile.as_ref().map(|profile| profile.to_vec());
    decoded.orientation = info
        .exif_metadata
        .as_ref()
        .and_then(|exif| Orientation::from_exif_chunk(exif))
        .unwrap_or(Orientation::NoTransforms);
    decoded.density = info.pixel_dims.and_then(|dimensions| {
        let unit = match dimensions.unit {
            png::Unit::Meter => DensityUnit::Meter,
            png::Unit::Unspecified => DensityUnit::Ratio,
        };
        Density::new([(dimensions.xppu, 1), (dimensions.yppu, 1)], unit)
    });
    if info.animation_control.is_some() {
        decoded.warnings.push("the PNG is animated: only its still picture is read".into());
    }
    Ok(decoded)
}

fn color_chunks(info: &Info) -> PngColor {
    PngColor {
        srgb: info.srgb.map(|intent| intent as u8),
        gama: info.gama_chunk.map(png::ScaledFloat::into_scaled),
        chrm: info.chrm_chunk.map(|chunk| {
            let points = [chunk.white, chunk.red, chunk.green, chunk.blue];
            let [[wx, wy], [rx, ry], [gx, gy], [bx, by]] =
                points.map(|(x, y)| [x.into_scaled(), y.into_scaled()]);
            [wx, wy, rx, ry, gx, gy, bx, by]
        }),
    }
}
