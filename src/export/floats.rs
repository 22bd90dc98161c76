//! Writes pictures as `OpenEXR` 2.0 with 32-bit floats, compressed by ZIP in blocks of 16 lines.
//!
//! The writer is not that of the `exr` library, which compresses with a slower implementation of Deflate and copies the picture
//! twice. The files of a photograph of 12 megapixels take a third less time to write; their values are the same.

use super::ExportError;
use crate::photo::COUNTS_PER_UNIT;
use crate::raster::Raster;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Number of lines of a block, which the compression ZIP prescribes.
const LINES: usize = 16;
/// Level of Deflate. Higher ones take twice the time for a twentieth of the size.
const LEVEL: Compression = Compression::new(3);
/// Number of the compression ZIP in a header.
const ZIP: u8 = 3;
/// Number of the sample type of 32-bit floats in a header.
const FLOAT: u32 = 2;

/// Writes counts as channels R, G and B.
pub(super) fn write_rgb(path: &Path, counts: &Raster<[f32; 3]>) -> Result<(), ExportError> {
    rgb_picture(counts).write_to(path)
}

fn rgb_picture(counts: &Raster<[f32; 3]>) -> Picture<impl Fn(usize, usize, &mut Vec<f32>) + Sync> {
    Picture {
        size: (counts.width(), counts.height()),
        // A file holds its channels in alphabetical order.
        channels: &["B", "G", "R"],
        line: |y: usize, channel: usize, line: &mut Vec<f32>| {
            line.extend(counts.row(y).iter().map(|color| color[2 - channel]));
        },
    }
}

/// Writes counts as the single channel Y.
pub(super) fn write_single(path: &Path, counts: &Raster<f32>) -> Result<(), ExportError> {
    single_picture(counts).write_to(path)
}

fn single_picture(counts: &Raster<f32>) -> Picture<impl Fn(usize, usize, &mut Vec<f32>) + Sync> {
    Picture {
        size: (counts.width(), counts.height()),
        channels: &["Y"],
        line: |y: usize, _: usize, line: &mut Vec<f32>| line.extend_from_slice(counts.row(y)),
    }
}

/// The bytes of a file with counts as channels R, G and B.
pub(super) fn rgb_bytes(counts: &Raster<[f32; 3]>) -> Vec<u8> {
    rgb_picture(counts).bytes()
}

/// The bytes of a file with counts as the single channel Y.
pub(super) fn single_bytes(counts: &Raster<f32>) -> Vec<u8> {
    single_picture(counts).bytes()
}

/// A picture to be written.
struct Picture<L> {
    /// Number of columns and rows.
    size: (usize, usize),
    /// Names of the channels, in alphabetical order.
    channels: &'static [&'static str],
    /// Appends the counts of a row in a channel.
    line: L,
}

impl<L: Fn(usize, usize, &mut Vec<f32>) + Sync> Picture<L> {
    fn write_to(&self, path: &Path) -> Result<(), ExportError> {
        let failed = |source| ExportError::Io { path: path.to_owned(), source };
        let mut file = BufWriter::new(File::create(path).map_err(failed)?);
        self.write(&mut file).and_then(|()| file.flush()).map_err(failed)
    }

    /// The bytes of the file.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Writing to a vector cannot fail.
        let _ = self.write(&mut bytes);
        bytes
    }

    /// Writes header, table of the blocks' places, and blocks.
    fn write(&self, file: &mut impl Write) -> io::Result<()> {
        let blocks: Vec<Vec<u8>> =
            (0..self.size.1.div_ceil(LINES)).into_par_iter().map(|block| self.block(block * LINES)).collect();
        let header = self.header();
        file.write_all(&header)?;
        let mut place = header.len() + 8 * blocks.len();
        for block in &blocks {
            file.write_all(&(place as u64).to_le_bytes())?;
            place += block.len();
        }
        blocks.iter().try_for_each(|block| file.write_all(block))
    }

    fn header(&self) -> Vec<u8> {
        let mut channels = Vec::new();
        for name in self.channels {
            channels.extend([name.as_bytes(), &[0], &FLOAT.to_le_bytes(), &[0; 4]].concat());
            // A sample for each pixel, across and down.
            channels.extend([1u32.to_le_bytes(), 1u32.to_le_bytes()].concat());
        }
        channels.push(0);
        // Left, top, right and bottom, the last ones inside.
        let ends = [0, 0, self.size.0 as i32 - 1, self.size.1 as i32 - 1];
        let window = ends.map(i32::to_le_bytes).concat();
        let mut header = b"\x76\x2f\x31\x01\x02\0\0\0".to_vec();
        for (name, kind, value) in [
            ("channels", "chlist", &channels[..]),
            ("compression", "compression", &[ZIP]),
            ("dataWindow", "box2i", &window),
            ("displayWindow", "box2i", &window),
            // From the top to the bottom.
            ("lineOrder", "lineOrder", &[0]),
            ("pixelAspectRatio", "float", &1f32.to_le_bytes()),
            ("screenWindowCenter", "v2f", &[0; 8]),
            ("screenWindowWidth", "float", &1f32.to_le_bytes()),
        ] {
            let size = (value.len() as u32).to_le_bytes();
            header.extend([name.as_bytes(), &[0], kind.as_bytes(), &[0], &size, value].concat());
        }
        header.push(0);
        header
    }

    /// The block that begins with the row `first`: row, size, and the compressed samples, row by row and channel by channel.
    fn block(&self, first: usize) -> Vec<u8> {
        let rows = LINES.min(self.size.1 - first);
        let mut values = Vec::with_capacity(rows * self.size.0 * self.channels.len());
        for y in first..first + rows {
            for channel in 0..self.channels.len() {
                (self.line)(y, channel, &mut values);
            }
        }
        let samples: Vec<u8> =
            values.iter().flat_map(|count| (count / COUNTS_PER_UNIT).to_le_bytes()).collect();
        let packed = deflated(&differences(&samples));
        // A block that would grow is stored as it is.
        let data = packed.filter(|packed| packed.len() < samples.len()).unwrap_or(samples);
        [&(first as u32).to_le_bytes()[..], &(data.len() as u32).to_le_bytes(), &data].concat()
    }
}

/// The bytes at even places, then those at odd places, each as its difference to the byte before, plus 128.
fn differences(samples: &[u8]) -> Vec<u8> {
    let sorted = || samples.iter().step_by(2).chain(samples.iter().skip(1).step_by(2)).copied();
    let mut bytes: Vec<u8> = Vec::with_capacity(samples.len());
    bytes.extend(sorted());
    let mut before = bytes.first().copied().unwrap_or_default();
    for byte in bytes.iter_mut().skip(1) {
        (before, *byte) = (*byte, byte.wrapping_sub(before).wrapping_add(128));
    }
    bytes
}

/// The bytes as a zlib stream; `None` where the library fails, which it does not in memory.
fn deflated(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::with_capacity(bytes.len() / 2), LEVEL);
    encoder.write_all(bytes).ok()?;
    encoder.finish().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::read_first_flat_layer_from_file;

    /// Reads the channels of a file with the `exr` library.
    fn channels(path: &Path) -> Vec<(String, Vec<f32>)> {
        let image = read_first_flat_layer_from_file(path).unwrap();
        let channels = image.layer_data.channel_data.list.into_iter();
        channels
            .map(|channel| (channel.name.to_string(), channel.sample_data.values_as_f32().collect()))
            .collect()
    }

    #[test]
    fn another_library_reads_the_same_values() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        // Sizes below, at and beyond a block; values that compress and values that do not.
        for (width, height) in [(1, 1), (3, 16), (50, 35)] {
            let mut state = 1u32;
            let mut any = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f32::from_bits((state >> 2) | 0x3000_0000)
            };
            let colors =
                (0..width * height).map(|at| [at as f32, any(), if at % 7 == 0 { -0.5 } else { 90.0 }]);
            let colors = Raster::from_vec(width, height, colors.collect()).unwrap();
            write_rgb(&path, &colors).unwrap();
            let band = |band: usize| colors.as_slice().iter().map(|color| color[band] / 255.0).collect();
            let expected: [(&str, Vec<f32>); 3] = [("B", band(2)), ("G", band(1)), ("R", band(0))];
            assert_eq!(channels(&path), expected.map(|(name, values)| (name.to_owned(), values)));
            let single = colors.map(|color| color[0]);
            write_single(&path, &single).unwrap();
            assert_eq!(channels(&path), [("Y".to_owned(), band(0))]);
        }
    }

    #[test]
    fn bytes_are_sorted_and_subtracted() {
        assert_eq!(differences(&[1, 10, 3, 20, 2]), [1, 130, 127, 136, 138]);
        assert!(differences(&[]).is_empty());
    }
}
