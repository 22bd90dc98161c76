//! Decoder of Radiance HDR. The `image` crate decodes the pixels, but only of pictures whose resolution line is `-Y …
//! +X …`; the header is read here.

use super::{Budget, Decoded, simple};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::Density;
use image::codecs::hdr::HdrDecoder;
use image::metadata::Orientation;
use std::io::{Cursor, Read};

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let header = Header::of(bytes)?;
    let (columns, rows) = header.resolution.stored_size();
    // The scanlines are decoded behind a header of their own, as if they were rows from the top.
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {rows} +X {columns}\n");
    let picture = Cursor::new(plain).chain(&bytes[header.length..]);
    let mut decoded = simple::read(HdrDecoder::new(picture)?, budget)?;
    decoded.orientation = header.resolution.orientation();
    decoded.density = header.density;
    decoded.warnings.extend(header.warnings);
    Ok(decoded)
}

/// What the header says.
struct Header {
    /// Number of bytes up to the pixels.
    length: usize,
    resolution: Resolution,
    density: Option<Density>,
    warnings: Vec<String>,
}

impl Header {
    fn of(bytes: &[u8]) -> Result<Self, Fault> {
        let mut lines = Lines { bytes, at: 0 };
        let mut warnings = Vec::new();
        let mut density = None;
        loop {
            let line = lines.next_line().ok_or_else(|| Fault::damaged("its header is cut short"))?;
            let line = line.trim();
            if line.is_empty() {
                break;
            }
            let Some((name, value)) = line.split_once('=').filter(|_| !line.starts_with('#')) else {
                continue;
            };
            let (name, value) = (name.trim(), value.trim());
            let is_one = |number: &str| number.parse::<f64>().is_ok_and(|number| (number - 1.0).abs() < 1e-6);
            match name {
                "FORMAT" if value == "32-bit_rle_rgbe" => {}
                "FORMAT" => return Err(Fault::unsupported(format!("pixels of {value}"), CONVERT)),
                "EXPOSURE" | "COLORCORR" | "GAMMA" if !value.split_whitespace().all(is_one) => {
                    let line = format!("the Radiance HDR says {name} {value}: its values are read as stored");
                    warnings.push(line);
                }
                // Height of a pixel divided by its width.
                "PIXASPECT" => {
                    density = value
                        .parse()
                        .ok()
                        .and_then(|height_per_width: f32| Density::of_pixel_aspect(1.0 / height_per_width));
                }
                _ => {}
            }
        }
        let line = lines.next_line().ok_or_else(|| Fault::damaged("it states no size"))?;
        let resolution = Resolution::of(&line).ok_or_else(|| Fault::damaged("it states no size"))?;
        Ok(Self { length: lines.at, resolution, density, warnings })
    }
}

/// Lines of a text that is followed by other bytes.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Lines<'_> {
    /// The next line without its end; `None` behind the last line that has an end.
    fn next_line(&mut self) -> Option<String> {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&byte| byte == b'\n')?;
        self.at += length + 1;
        Some(String::from_utf8_lossy(&rest[..length]).into_owned())
    }
}

/// The line of the size, as in `-Y 480 +X 640`: the axis of the scanlines first; `-Y` from the top, `+X` from the left.
struct Resolution {
    /// Whether a scanline is a column.
    scanlines_are_columns: bool,
    scanlines: usize,
    pixels_per_scanline: usize,
    from_top: bool,
    from_left: bool,
}

impl Resolution {
    fn of(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [first, scanlines, second, pixels] = words[..] else { return None };
        let has_direction = |axis| [first, second].contains(&axis);
        let scanlines_are_columns = first.ends_with('X');
        let others = if scanlines_are_columns { ["-Y", "+Y"] } else { ["-X", "+X"] };
        if !["-Y", "+Y", "-X", "+X"].contains(&first) || !others.contains(&second) {
            return None;
        }
        Some(Self {
            scanlines_are_columns,
            scanlines: scanlines.parse().ok()?,
            pixels_per_scanline: pixels.parse().ok()?,
            from_top: has_direction("-Y"),
            from_left: has_direction("+X"),
        })
    }

    /// Columns and rows of the picture whose rows are the scanlines.
    const fn stored_size(&self) -> (usize, usize) {
        (self.pixels_per_scanline, self.scanlines)
    }

    const fn orientation(&self) -> Orientation {
        match (self.scanlines_are_columns, self.from_top, self.from_left) {
            (false, true, true) => Orientation::NoTransforms,
            (false, true, false) => Orientation::FlipHorizontal,
            (false, false, true) => Orientation::FlipVertical,
            (false, false, false) => Orientation::Rotate180,
            (true, true, true) => Orientation::Rotate90FlipH,
            (true, true, false) => Orientation::Rotate90,
            (true, false, true) => Orientation::Rotate270,
            (true, false, false) => Orientation::Rotate270FlipH,
        }
    }
}
