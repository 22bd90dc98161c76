//! Decoder of TIFF 6.0 and `BigTIFF`: gray, palette, RGB and YCbCr of 1 to 32 bits, floats of 16 to 64 bits, in strips or
//! tiles, interleaved or in planes.
//!
//! The `tiff` crate reads too few arrangements of samples (none of 10, 12, 14 or 24 bits, no reversed order of bits, no YCbCr),
//! so that this decoder reads directories, strips and samples itself, and uses libraries for the compressions.

mod choice;
mod chunks;
mod compression;
mod page;
mod palette;
mod raster;
mod samples;
mod ycbcr;

use super::exif::{density_of, orientation_of};
use super::ifd::{Directory, IfdFile};
use super::{Budget, Decoded};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{AlphaKind, Layout, Samples, TiffColor};
use image::metadata::Orientation;
use page::{Kind, Page};

/// Photometric interpretations (tag 262).
mod photometric {
    pub(super) const WHITE_IS_ZERO: u64 = 0;
    pub(super) const BLACK_IS_ZERO: u64 = 1;
    pub(super) const RGB: u64 = 2;
    pub(super) const PALETTE: u64 = 3;
    pub(super) const MASK: u64 = 4;
    pub(super) const YCBCR: u64 = 6;
    pub(super) const MOSAIC: u64 = 32803;
    pub(super) const LINEAR_RAW: u64 = 34892;
}

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let file = IfdFile::of(bytes)?;
    let chosen = choice::main_picture(&file)?;
    let mut warnings = chosen.warnings;
    let page = Page::of(&chosen.directory, budget, &mut warnings)?;
    let mut decoded = match &chosen.planes[..] {
        [] => picture(&page, &mut warnings)?,
        others => of_planes(&page, others, budget)?,
    };
    let directory = &chosen.directory;
    decoded.icc = directory.bytes(page::ICC_PROFILE).map(<[u8]>::to_vec);
    decoded.orientation = orientation_of(directory).unwrap_or(Orientation::NoTransforms);
    decoded.density = density_of(directory);
    decoded.tiff_color = TiffColor::of(directory);
    warnings.extend(page.warnings_of_values(directory));
    decoded.transfer = page.transfer_curves(directory)?;
    decoded.warnings = warnings;
    Ok(decoded)
}

/// The picture of one page.
fn picture(page: &Page, warnings: &mut Vec<String>) -> Result<Decoded, Fault> {
    let size = (page.width, page.height);
    let mut decoded = match page.photometric {
        photometric::PALETTE => {
            warn_of_bands(page, 1, "the index of its palette is", warnings);
            let (samples, eight_bits) = palette::look_up(page)?;
            if eight_bits {
                warnings.push("the TIFF's color map ends at 255 instead of 65535: read as 8 bits".into());
            }
            Decoded::plain(size, Layout::Rgb, samples)
        }
        photometric::YCBCR if page.compression != compression::JPEG => {
            warn_of_bands(page, 3, "red, green and blue are", warnings);
            Decoded::plain(size, Layout::Rgb, Samples::U8(ycbcr::samples(page)?))
        }
        _ => of_bands(page, warnings)?,
    };
    decoded.compression = compression::of_page(page)?;
    Ok(decoded)
}

/// Gray or RGB, with the first further band that the page calls alpha.
fn of_bands(page: &Page, warnings: &mut Vec<String>) -> Result<Decoded, Fault> {
    let is_gray = matches!(page.photometric, photometric::WHITE_IS_ZERO | photometric::BLACK_IS_ZERO);
    let colors = if is_gray { 1 } else { 3 };
    if page.bands < colors {
        return Err(Fault::damaged("it has too few bands for RGB"));
    }
    // Value 1 is associated alpha, 2 is unassociated. Extra samples that are not declared are not taken for alpha.
    let alpha =
        page.extra.iter().position(|&kind| matches!(kind, 1 | 2)).filter(|at| colors + at < page.bands);
    let mut channels: Vec<usize> = (0..colors).collect();
    channels.extend(alpha.map(|at| colors + at));
    let names = match (is_gray, alpha.is_some()) {
        (true, false) => "the first is",
        (true, true) => "the first and alpha are",
        (false, false) => "red, green and blue are",
        (false, true) => "red, green, blue and alpha are",
    };
    warn_of_bands(page, channels.len(), names, warnings);
    let layout = match (is_gray, alpha.is_some()) {
        (true, false) => Layout::Gray,
        (true, true) => Layout::GrayAlpha,
        (false, false) => Layout::Rgb,
        (false, true) => Layout::Rgba,
    };
    let mut decoded = raster::of_channels(page, &channels, layout)?;
    if alpha.is_some_and(|at| page.extra[at] == 1) {
        decoded.alpha = AlphaKind::Associated;
    }
    Ok(decoded)
}

/// The samples of three bands, pixel by pixel.
fn joined<T: Copy>(bands: [&[T]; 3]) -> Vec<T> {
    (0..bands[0].len()).flat_map(|pixel| bands.map(|band| band[pixel])).collect()
}

fn warn_of_bands(page: &Page, read: usize, names: &str, warnings: &mut Vec<String>) {
    if page.bands > read {
        warnings.push(format!("the TIFF holds {} bands: only {names} read", page.bands));
    }
}

/// Red, green and blue from three gray pages of one size and type.
fn of_planes(first: &Page, others: &[Directory], budget: Budget) -> Result<Decoded, Fault> {
    let gray = |page: &Page| raster::of_channels(page, &[0], Layout::Gray);
    let mut planes = vec![gray(first)?];
    for directory in others {
        planes.push(gray(&Page::of(directory, budget, &mut Vec::new())?)?);
    }
    let unequal = || Fault::unsupported("channels of different sizes or types", CONVERT);
    let [red, green, blue] = &planes[..] else { return Err(unequal()) };
    if red.size != green.size || red.size != blue.size {
        return Err(unequal());
    }
    let samples = match (&red.samples, &green.samples, &blue.samples) {
        (Samples::U8(r), Samples::U8(g), Samples::U8(b)) => Samples::U8(joined([r, g, b])),
        (Samples::U16(r), Samples::U16(g), Samples::U16(b)) => Samples::U16(joined([r, g, b])),
        (Samples::F32(r), Samples::F32(g), Samples::F32(b)) => Samples::F32(joined([r, g, b])),
        _ => return Err(unequal()),
    };
    Ok(Decoded { max: red.max, ..Decoded::plain(red.size, Layout::Rgb, samples) })
}

impl TiffColor {
    /// White point and primaries of a directory.
    fn of(directory: &Directory) -> Self {
        Self { white_point: directory.fractions(318), primaries: directory.fractions(319) }
    }
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Unsigned => "unsigned integers",
            Self::Signed => "signed integers",
            Self::Float => "floats",
        }
    }
}
