//! Recognizes the format of a file by its first bytes.

use std::fmt;
use std::path::Path;

/// The supported file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// PNG, Portable Network Graphics.
    Png,
    /// JPEG (ITU-T T.81) with gray or RGB colors.
    Jpeg,
    /// TIFF and `BigTIFF`.
    Tiff,
    /// BMP, the Windows bitmap.
    Bmp,
    /// PNM, the netpbm formats PBM, PGM, PPM and PAM.
    Pnm,
    /// WebP; of an animation the first frame.
    WebP,
    /// `OpenEXR`; the first flat layer with R, G and B, or Y.
    Exr,
    /// Radiance HDR, also called RGBE.
    Hdr,
    /// HEIF with HEVC pictures (HEIC, HIF).
    Heif,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Format {
    /// Names of all formats as a list within a sentence.
    pub const NAMES: &'static str = "PNG, JPEG, TIFF, BMP, PNM, WebP, HEIF, OpenEXR or Radiance HDR";

    /// Number of first bytes that [`Format::of_content`] needs.
    pub(super) const MAGIC_BYTES: usize = 16;

    /// Usual name of the format.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Tiff => "TIFF",
            Self::Bmp => "BMP",
            Self::Pnm => "PNM",
            Self::WebP => "WebP",
            Self::Exr => "OpenEXR",
            Self::Hdr => "Radiance HDR",
            Self::Heif => "HEIF",
        }
    }

    /// Usual file name extensions of the format, in lower case.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png", "apng"],
            Self::Jpeg => &["jpg", "jpeg", "jpe", "jfif"],
            Self::Tiff => &["tif", "tiff"],
            Self::Bmp => &["bmp", "dib"],
            Self::Pnm => &["pnm", "pbm", "pgm", "ppm", "pam"],
            Self::WebP => &["webp"],
            Self::Exr => &["exr"],
            Self::Hdr => &["hdr", "pic", "rgbe"],
            Self::Heif => &["heic", "heif", "hif"],
        }
    }

    /// Whether the extension of `path` belongs to a supported format.
    pub fn known_extension(path: &Path) -> bool {
        let extension = extension_of(path);
        Self::ALL.iter().any(|format| format.extensions().contains(&extension.as_str()))
    }

    /// All supported formats.
    pub const ALL: [Self; 9] = [
        Self::Png,
        Self::Jpeg,
        Self::Tiff,
        Self::Bmp,
        Self::Pnm,
        Self::WebP,
        Self::Heif,
        Self::Exr,
        Self::Hdr,
    ];

    /// Recognizes the format by the first bytes of a file, whatever the file's name.
    ///
    /// # Errors
    /// Name of the unsupported format, or the first bytes, within a sentence.
    pub(super) fn of_content(bytes: &[u8]) -> Result<Self, String> {
        let starts = |magic: &[u8]| bytes.starts_with(magic);
        let riff = |kind: &[u8]| starts(b"RIFF") && bytes.get(8..12) == Some(kind);
        let media = |brands: &[&[u8]]| {
            bytes.get(4..8) == Some(b"ftyp") && bytes.get(8..12).is_some_and(|brand| brands.contains(&brand))
        };
        if starts(b"\x89PNG\r\n\x1a\n") {
            Ok(Self::Png)
        } else if starts(b"\xff\xd8\xff") {
            Ok(Self::Jpeg)
        } else if [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| starts(*magic)) {
            Ok(Self::Tiff)
        } else if starts(b"v/1\x01") {
            Ok(Self::Exr)
        } else if starts(b"#?RADIANCE") || starts(b"#?RGBE") {
            Ok(Self::Hdr)
        } else if riff(b"WEBP") {
            Ok(Self::WebP)
        } else if matches!(bytes, [b'P', b'1'..=b'7', space, ..] if space.is_ascii_whitespace() || *space == b'#')
        {
            Ok(Self::Pnm)
        } else if starts(b"BM") {
            Ok(Self::Bmp)
        } else if media(&[b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"mif1", b"msf1"]) {
            Ok(Self::Heif)
        } else if starts(b"GIF8") {
            Err("a GIF".into())
        } else if starts(b"8BPS") {
            Err("a Photoshop document".into())
        } else if media(&[b"avif", b"avis"]) {
            Err("an AVIF".into())
        } else if media(&[b"crx "]) || starts(b"FUJIFILM") || starts(b"IIU\0") || starts(b"IIRO") {
            Err("a camera raw file".into())
        } else if starts(b"\xff\x0a") || starts(b"\0\0\0\x0cJXL ") {
            Err("a JPEG XL".into())
        } else if starts(b"\0\0\0\x0cjP  ") || starts(b"\xff\x4f\xff\x51") {
            Err("a JPEG 2000".into())
        } else if starts(b"qoif") {
            Err("a QOI".into())
        } else if starts(b"II\xbc\x01") {
            Err("a JPEG XR".into())
        } else if matches!(bytes, [b'P', b'F' | b'f', space, ..] if space.is_ascii_whitespace()) {
            Err("a PFM".into())
        } else if starts(b"\x8aMNG") || starts(b"\x8bJNG") {
            Err("an MNG or JNG".into())
        } else if starts(b"SIMPLE  =") {
            Err("a FITS".into())
        } else if starts(b"%PDF") {
            Err("a PDF".into())
        } else if starts(b"\0\0\x01\0") {
            Err("an icon".into())
        } else {
            let first = &bytes[..bytes.len().min(8)];
            Err(format!("a file that starts with \u{201c}{}\u{201d}", first.escape_ascii()))
        }
    }

    /// A warning when the extension of `name` does not belong to this format; `None` when it does or there is no
    /// extension.
    pub(super) fn extension_warning(self, name: &str) -> Option<String> {
        let extension = extension_of(Path::new(name));
        let belongs = extension.is_empty() || self.extensions().contains(&extension.as_str());
        (!belongs).then(|| format!("the name ends in .{extension}, but the file is a {self}: read as {self}"))
    }
}

fn extension_of(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides_and_a_wrong_name_is_mentioned() {
        assert_eq!(Format::of_content(b"\x89PNG\r\n\x1a\n...."), Ok(Format::Png));
        assert_eq!(Format::of_content(b"P6\n1 1 255\n"), Ok(Format::Pnm));
        assert_eq!(Format::of_content(b"RIFF\0\0\0\0WEBPVP8 "), Ok(Format::WebP));
        assert_eq!(Format::of_content(b"GIF89a"), Err("a GIF".to_owned()));
        assert!(Format::of_content(b"Pardon?").unwrap_err().contains("Pardon?"));
        assert!(Format::of_content(b"").is_err());
        assert_eq!(Format::Png.extension_warning("a/b.PNG"), None);
        assert_eq!(Format::Png.extension_warning("b"), None);
        let warning = Format::Png.extension_warning("b.jpg").unwrap();
        assert!(warning.contains(".jpg") && warning.contains("PNG"));
        assert!(Format::known_extension(Path::new("x.TIFF")) && !Format::known_extension(Path::new("x.txt")));
    }
}
