//! Writes the photograph without highlights, in the format of the photograph's file.

mod container;

use super::choice::MATTE;
use crate::intrinsic::{Intrinsic, PixelKind};
use crate::photo::{AlphaKind, Layout, Photo, Samples, nearest_code};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Why the matte picture could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MatteError {
    /// The body image and the photograph differ in size.
    #[error("the body image has {} \u{d7} {} pixels, the photograph {} \u{d7} {}", body.0, body.1, photo.0, photo.1)]
    Shape {
        /// Width and height of the body image.
        body: (usize, usize),
        /// Width and height of the photograph.
        photo: (usize, usize),
    },
    /// The picture does not fit its file format.
    #[error("{}: cannot be encoded: {reason}", path.display())]
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// The encoder's error.
        reason: String,
    },
    /// The file could not be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file that was to be written.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
}

/// Writes the body reflection and a share `keep_surface` (clamped to 0…1) of the other light to `folder`, and returns the path of
/// the file: `matte.jpg` for a JPEG photograph, `matte.tif` for a TIFF or a photograph with floats, otherwise `matte.png`.
///
/// Tone curve, depth, profile and alpha are those of the photograph, with these exceptions: floats are written linear and
/// 32 bits wide, samples of less than 8 bits and palettes as 8 bits, and a PNM whose maximum fits no PNG as 16 bits.
/// At 0 the picture is `intrinsic.body`, at 1 it is the photograph. Between them restored pixels have a share of their restored
/// surface reflection, limited to the range of the file.
/// A pixel whose color equals the photograph keeps its samples exactly. A gray photograph stays gray if the body is.
///
/// # Errors
/// [`MatteError`]: sizes that differ, or a file that cannot be encoded or written.
pub fn write_matte(
    photo: &Photo,
    intrinsic: &Intrinsic,
    keep_surface: f64,
    folder: &Path,
) -> Result<PathBuf, MatteError> {
    let (extension, bytes) = matte_bytes(photo, intrinsic, keep_surface).map_err(|error| match error {
        MatteError::Encode { path, reason } => MatteError::Encode { path: folder.join(path), reason },
        other => other,
    })?;
    let path = folder.join(MATTE).with_extension(extension);
    std::fs::write(&path, bytes).map_err(|cause| MatteError::Write { path: path.clone(), cause })?;
    Ok(path)
}

/// The picture that [`write_matte`] writes, as its usual extension (`jpg`, `tif` or `png`) and its bytes.
///
/// # Errors
/// [`MatteError`]: sizes that differ, or a picture that cannot be encoded.
pub fn matte_bytes(
    photo: &Photo,
    intrinsic: &Intrinsic,
    keep_surface: f64,
) -> Result<(&'static str, Vec<u8>), MatteError> {
    let body = &intrinsic.body;
    let size = (photo.image.width(), photo.image.height());
    let body_size = (body.width(), body.height());
    if body_size != size {
        return Err(MatteError::Shape { body: body_size, photo: size });
    }
    let picture = coded(photo, intrinsic, keep_surface.clamp(0.0, 1.0) as f32);
    let (format, encoded) = container::encode(photo, picture);
    let extension = format.extension();
    let path = Path::new(MATTE).with_extension(extension);
    encoded.map(|bytes| (extension, bytes)).map_err(|reason| MatteError::Encode { path, reason })
}

/// Samples for a file, and their layout.
struct Picture {
    layout: Layout,
    samples: Samples,
}

/// The picture in the sample type of the photograph.
fn coded(photo: &Photo, intrinsic: &Intrinsic, keep_surface: f32) -> Picture {
    let (source, curves, full_scale) = (&photo.source, &photo.encoding.curves, photo.full_scale);
    let max = source.max.unwrap_or(1);
    let matte = Matte { photo, intrinsic, keep_surface, keep_unchanged: true };
    match &source.samples {
        Samples::U8(samples) => {
            let tables = curves.each_ref().map(|curve| curve.table(1 << 8, max, full_scale));
            let code = |band: usize, counts| nearest_code(counts, max, |c| tables[band][c as usize]) as u8;
            matte.picture(samples, code, |alpha| f32::from(alpha) / max as f32, Samples::U8)
        }
        Samples::U16(samples) => {
            let tables = curves.each_ref().map(|curve| curve.table(1 << 16, max, full_scale));
            let code = |band: usize, counts| nearest_code(counts, max, |c| tables[band][c as usize]) as u16;
            matte.picture(samples, code, |alpha| f32::from(alpha) / max as f32, Samples::U16)
        }
        Samples::U32(samples) => {
            let code =
                |band: usize, counts| nearest_code(counts, max, |c| curves[band].counts(c, max, full_scale));
            matte.picture(samples, code, |alpha| alpha as f32 / max as f32, Samples::U32)
        }
        Samples::F32(samples) => {
            let code = |_band, counts: f32| (f64::from(counts) / full_scale) as f32;
            // Floats are written linear, whatever tone curve the photograph's file had.
            let matte = Matte { keep_unchanged: photo.encoding.is_linear(), ..matte };
            matte.picture(samples, code, |alpha| alpha, Samples::F32)
        }
    }
}

/// A type of sample that can be compared.
trait Sample: Copy + Send + Sync {
    /// Whether two samples are the same color.
    fn same(self, other: Self) -> bool;
}

macro_rules! integer_sample {
    ($($integer:ty),+) => {
        $(impl Sample for $integer {
            fn same(self, other: Self) -> bool {
                self == other
            }
        })+
    };
}

integer_sample!(u8, u16, u32);

impl Sample for f32 {
    /// Whether two floats differ by rounding only; NaN, the value of a masked pixel, is the same as any other value.
    fn same(self, other: Self) -> bool {
        let apart = (self - other).abs() > 1e-5 * self.abs().max(other.abs());
        !apart
    }
}

/// Pixels per parallel task: enough to make the cost of distributing tasks negligible.
const CHUNK: usize = 1 << 13;

/// A photograph, its intrinsic images, and the share of the surface reflection to keep.
struct Matte<'a> {
    photo: &'a Photo,
    intrinsic: &'a Intrinsic,
    /// Share of the surface reflection to keep, 0…1.
    keep_surface: f32,
    /// Whether unchanged pixels keep the samples of the photograph.
    keep_unchanged: bool,
}

impl Matte<'_> {
    /// The color that is written for a pixel, counts. An undistorted pixel keeps the same share of noise as of surface
    /// reflection.
    fn color(&self, index: usize) -> [f32; 3] {
        let (body, share) = (self.intrinsic.body[index], self.keep_surface);
        if share <= 0.0 {
            return body;
        }
        let photo = self.photo.image.pixels[index];
        if share >= 1.0 {
            return photo;
        }
        if matches!(self.intrinsic.kinds[index], PixelKind::Restored | PixelKind::Lost) {
            let surface = self.intrinsic.surface[index];
            return std::array::from_fn(|band| body[band] + share * surface[band]);
        }
        std::array::from_fn(|band| (1.0 - share) * body[band] + share * photo[band])
    }

    /// The picture in the sample type `T`. `code` makes a sample from a band and counts, `opacity` a share from an alpha sample, and
    /// `wrap` the samples of a picture.
    fn picture<T: Sample + Default>(
        &self,
        samples: &[T],
        code: impl Fn(usize, f32) -> T + Sync,
        opacity: impl Fn(T) -> f32 + Sync,
        wrap: impl Fn(Vec<T>) -> Samples,
    ) -> Picture {
        let layout = self.photo.source.layout;
        let (stored, written) = (layout.channels(), layout.colored().channels());
        let mut colored = vec![T::default(); self.intrinsic.body.len() * written];
        colored.par_chunks_mut(CHUNK * written).enumerate().for_each(|(chunk, out)| {
            for (offset, pixel) in out.chunks_exact_mut(written).enumerate() {
                let index = chunk * CHUNK + offset;
                self.write_pixel(
                    index,
                    &samples[index * stored..(index + 1) * stored],
                    pixel,
                    &code,
                    &opacity,
                );
            }
        });
        let gray =
            layout.is_gray() && colored.chunks_exact(written).all(|p| p[0].same(p[1]) && p[1].same(p[2]));
        if gray {
            let samples = colored.chunks_exact(written).flat_map(|pixel| &pixel[2..]).copied().collect();
            // A gray pixel has the last of the three equal bands, and alpha.
            return Picture { layout, samples: wrap(samples) };
        }
        Picture { layout: layout.colored(), samples: wrap(colored) }
    }

    /// Writes pixel `index` to `pixel` as three bands and alpha, if the layout has alpha. `stored`: the pixel's samples in the
    /// photograph.
    #[allow(clippy::float_cmp, reason = "only a color that is exactly the same is unchanged")]
    fn write_pixel<T: Sample>(
        &self,
        index: usize,
        stored: &[T],
        pixel: &mut [T],
        code: impl Fn(usize, f32) -> T,
        opacity: impl Fn(T) -> f32,
    ) {
        let source = &self.photo.source;
        let alpha = source.layout.has_alpha().then(|| stored[stored.len() - 1]);
        // A fully transparent pixel keeps its samples.
        let weight = match alpha {
            Some(alpha) if source.alpha == AlphaKind::Straight => opacity(alpha),
            _ => 1.0,
        };
        let color = self.color(index);
        let is_photo = self.keep_surface >= 1.0 || color == self.photo.image.pixels[index];
        let unchanged = self.keep_unchanged && is_photo;
        for band in 0..3 {
            pixel[band] = if unchanged || weight == 0.0 {
                if source.layout.is_gray() { stored[0] } else { stored[band] }
            } else {
                code(band, color[band] / weight)
            };
        }
        if let Some(alpha) = alpha {
            pixel[3] = alpha;
        }
    }
}
