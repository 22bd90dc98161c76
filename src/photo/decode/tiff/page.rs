//! The fields of a page that say how its samples are stored (TIFF 6.0, sections 3 to 22).

use super::{compression, photometric};
use crate::photo::curve::ToneCurve;
use crate::photo::decode::Budget;
use crate::photo::decode::ifd::Directory;
use crate::photo::error::{CONVERT, Fault};

/// Tags from this number on belong to other standards than TIFF 6.0.
const FIRST_REGISTERED_TAG: u16 = 700;
pub(super) const ICC_PROFILE: u16 = 34675;

/// Type of the samples (tag 339).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Unsigned,
    Signed,
    Float,
}

/// How the samples of a page are stored.
#[derive(Debug)]
pub(super) struct Page<'a> {
    /// All bytes of the file.
    pub bytes: &'a [u8],
    pub big_endian: bool,
    pub width: usize,
    pub height: usize,
    /// Bits of each sample.
    pub bits: u32,
    pub kind: Kind,
    /// Samples of each pixel.
    pub bands: usize,
    /// Meaning of the bands after those of the photometric interpretation.
    pub extra: Vec<u64>,
    pub photometric: u64,
    pub compression: u64,
    /// 1 none, 2 horizontal differences, 3 differences of floats.
    pub predictor: u64,
    /// Whether each band is stored apart.
    pub in_planes: bool,
    /// Whether the first pixel of a byte is in its lowest bit.
    pub reversed_bits: bool,
    /// Columns and rows of a strip or tile.
    pub chunk: (usize, usize),
    pub offsets: Vec<u64>,
    /// Numbers of bytes of the strips or tiles; empty where the page does not say.
    pub counts: Vec<u64>,
    /// Tables that all JPEG strips or tiles share.
    pub jpeg_tables: Option<&'a [u8]>,
    /// Pixels across and down that share a pair of color differences.
    pub subsampling: (usize, usize),
    /// Shares of red, green and blue in luminance.
    pub luma: Vec<f64>,
    /// Code values of black and white of Y, Cb and Cr.
    pub reference: Vec<f64>,
    /// Colors of a palette: all reds, all greens, all blues.
    pub color_map: Vec<u64>,
}

impl<'a> Page<'a> {
    /// Reads and checks the fields. Statements that are guessed are added to `warnings`.
    pub(super) fn of(
        directory: &Directory<'a>,
        budget: Budget,
        warnings: &mut Vec<String>,
    ) -> Result<Self, Fault> {
        // Private fields may hold positions of another file, which is no fault of this one.
        directory.expect_inside(|tag| tag < FIRST_REGISTERED_TAG || tag == ICC_PROFILE)?;
        let size = |tag| directory.integer(tag).ok_or_else(|| Fault::damaged("it does not state its size"));
        let (width, height) = budget.admit(size(256)?, size(257)?)?;
        let bands = number(directory.integer(277).unwrap_or(1));
        let subsampling = directory.integers(530);
        let mut page = Self {
            bytes: directory.file.bytes,
            big_endian: directory.file.big_endian,
            width,
            height,
            bits: bits(directory)?,
            kind: kind(directory)?,
            bands,
            extra: directory.integers(338),
            photometric: interpretation(directory, bands, warnings)?,
            compression: directory.integer(259).unwrap_or(compression::NONE),
            predictor: directory.integer(317).unwrap_or(1),
            in_planes: bands > 1 && directory.integer(284) == Some(2),
            reversed_bits: directory.integer(266) == Some(2),
            chunk: (width, height),
            offsets: Vec::new(),
            counts: Vec::new(),
            jpeg_tables: directory.bytes(347),
            subsampling: match subsampling[..] {
                [across, down, ..] => (number(across), number(down)),
                _ => (2, 2),
            },
            luma: directory.quotients(529),
            reference: directory.quotients(532),
            color_map: directory.integers(320),
        };
        page.find_chunks(directory)?;
        page.expect_supported()?;
        Ok(page)
    }

    /// Finds the strips or tiles. Some old files have the offsets of their tiles in the field of strips.
    fn find_chunks(&mut self, directory: &Directory) -> Result<(), Fault> {
        let tiles = (directory.integer(322), directory.integer(323));
        let first_of = |tags: [u16; 2]| {
            let found = tags.map(|tag| directory.integers(tag));
            found.into_iter().find(|values| !values.is_empty()).unwrap_or_default()
        };
        if let (Some(columns), Some(rows)) = tiles {
            self.chunk = (number(columns), number(rows));
            self.offsets = first_of([324, 273]);
            self.counts = first_of([325, 279]);
        } else {
            let rows = number(directory.integer(278).unwrap_or(u64::MAX));
            self.chunk = (self.width, rows.min(self.height));
            self.offsets = directory.integers(273);
            self.counts = directory.integers(279);
        }
        // A tile is not larger than the largest possible picture, so that its bytes can be counted.
        let sides_fit = [self.chunk.0, self.chunk.1].iter().all(|side| (1..=1 << 24).contains(side));
        let planes = if self.in_planes { self.bands } else { 1 };
        let needed = sides_fit.then(|| self.chunks_across() * self.chunks_down() * planes);
        if needed.is_none_or(|needed| self.offsets.len() < needed) {
            return Err(Fault::damaged("it lacks strips or tiles"));
        }
        Ok(())
    }

    pub(super) fn chunks_across(&self) -> usize {
        self.width.div_ceil(self.chunk.0)
    }

    pub(super) fn chunks_down(&self) -> usize {
        self.height.div_ceil(self.chunk.1)
    }

    /// Samples of each pixel of a strip or tile.
    pub(super) fn bands_of_chunk(&self) -> usize {
        if self.in_planes { 1 } else { self.bands }
    }

    fn expect_supported(&self) -> Result<(), Fault> {
        compression::expect_supported(self.compression)?;
        if self.bands == 0 || self.bands > 65535 {
            return Err(Fault::damaged("it states no bands"));
        }
        let is_entropy_coded =
            !matches!(self.compression, compression::NONE | compression::PACK_BITS | compression::FAX_4);
        let fits = match self.predictor {
            1 => true,
            2 => matches!(self.bits, 8 | 16 | 32 | 64),
            other => (other, self.kind) == (3, Kind::Float),
        };
        if !fits || (self.predictor != 1 && !is_entropy_coded) {
            let found = format!("predictor {} for samples of {} bits", self.predictor, self.bits);
            return Err(Fault::unsupported(found, CONVERT));
        }
        let eight_bits = (self.bits, self.kind) == (8, Kind::Unsigned);
        let is_jpeg = self.compression == compression::JPEG;
        if is_jpeg && !eight_bits {
            return Err(Fault::unsupported(format!("JPEG with samples of {} bits", self.bits), CONVERT));
        }
        if self.compression == compression::FAX_4 && (self.bits, self.bands) != (1, 1) {
            return Err(Fault::damaged("its compression is for one bit a pixel"));
        }
        if self.photometric == photometric::YCBCR && (self.bands < 3 || self.in_planes || !eight_bits) {
            return Err(Fault::unsupported("YCbCr in planes or not of 8 bits", CONVERT));
        }
        Ok(())
    }

    /// Warnings of fields that other programs use to change the values, and that are not applied here.
    pub(super) fn warnings_of_values(&self, directory: &Directory) -> Vec<String> {
        let mut warnings = Vec::new();
        let full = 1u64.checked_shl(self.bits).map_or(u64::MAX, |codes| codes - 1);
        if let Some(max) = directory.integer(281)
            && self.kind == Kind::Unsigned
            && self.bits > 8
            && (1..full).contains(&max)
            && (max + 1).is_power_of_two()
        {
            warnings.push(format!(
                "the TIFF says that its values end at {max} of {full}: read as {full}; --full-scale changes that"
            ));
        }
        if self.photometric != photometric::PALETTE && directory.has(291) {
            warnings.push("the TIFF's gray response curve is not applied".into());
        }
        warnings
    }

    /// The tone curves of tag 301: equally spaced linear intensities, one table for all bands or one a band.
    pub(super) fn transfer_curves(&self, directory: &Directory) -> Result<Option<[ToneCurve; 3]>, Fault> {
        let values = directory.integers(301);
        let codes = 1usize.checked_shl(self.bits).unwrap_or(0);
        if values.is_empty() || self.kind != Kind::Unsigned || !(2..=16).contains(&self.bits) {
            return Ok(None);
        }
        let table = |values: &[u64]| ToneCurve::Table(values.iter().map(|&value| value as u16).collect());
        let tables: Vec<ToneCurve> = values.chunks_exact(codes).map(table).collect();
        let curves = match &tables[..] {
            [one] => [one.clone(), one.clone(), one.clone()],
            [red, green, blue, ..] => [red.clone(), green.clone(), blue.clone()],
            _ => return Err(Fault::damaged("its transfer function does not fit its samples")),
        };
        Ok(Some(curves))
    }
}

/// A count or size; what no memory could hold becomes the largest number.
fn number(value: u64) -> usize {
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn bits(directory: &Directory) -> Result<u32, Fault> {
    let bits = directory.integers(258);
    let first = bits.first().copied().unwrap_or(1);
    if bits.iter().any(|&other| other != first) {
        return Err(Fault::unsupported(format!("bands of different depths {bits:?}"), CONVERT));
    }
    match u32::try_from(first) {
        Ok(bits @ 1..=64) => Ok(bits),
        _ => Err(Fault::unsupported(format!("samples of {first} bits"), CONVERT)),
    }
}

fn kind(directory: &Directory) -> Result<Kind, Fault> {
    let formats = directory.integers(339);
    let first = formats.first().copied().unwrap_or(1);
    if formats.iter().any(|&other| other != first) {
        return Err(Fault::unsupported("bands of different types", CONVERT));
    }
    match first {
        // 4: undefined, which readers take for unsigned integers.
        1 | 4 => Ok(Kind::Unsigned),
        2 => Ok(Kind::Signed),
        3 => Ok(Kind::Float),
        5 | 6 => Err(Fault::unsupported("complex numbers", CONVERT)),
        other => Err(Fault::unsupported(format!("samples of format {other}"), CONVERT)),
    }
}

fn interpretation(directory: &Directory, bands: usize, warnings: &mut Vec<String>) -> Result<u64, Fault> {
    let Some(said) = directory.integer(262) else {
        let (guess, name) =
            if bands >= 3 { (photometric::RGB, "RGB") } else { (photometric::BLACK_IS_ZERO, "gray") };
        warnings.push(format!("the TIFF does not say what its samples mean: read as {name}"));
        return Ok(guess);
    };
    let found = match said {
        photometric::WHITE_IS_ZERO..=photometric::PALETTE | photometric::YCBCR => return Ok(said),
        photometric::MASK => "a transparency mask",
        5 => return Err(Fault::unsupported("CMYK, the colors of a printing press", "convert it to RGB")),
        8..=10 => "CIE L*a*b* colors",
        32844 | 32845 => "LogLuv colors",
        other => {
            return Err(Fault::unsupported(format!("photometric interpretation {other}"), CONVERT));
        }
    };
    Err(Fault::unsupported(found, CONVERT))
}
