//! Files whose header changes how the samples are to be read: every arrangement is read rightly, or refused by name.

use crate::files::{self, Png};
use crate::tiffs::{self, Page};
use crate::{gray, linear, pixels, read_linear};
use dichroscope::photo::{Layout, Photo, ReadOptions, Samples, decode};

const LSB_FIRST: u16 = 266;
const COMPRESSION: u16 = 259;
const PLANES: u16 = 284;
const FORMAT: u16 = 339;

fn read_page(page: &Page) -> Photo {
    read_linear(&tiffs::file(std::slice::from_ref(page), false))
}

/// The error of a file, which is one line and names the file.
fn refused(bytes: &[u8]) -> String {
    let message = decode(bytes, "it.tif", &linear()).unwrap_err().to_string();
    assert!(message.starts_with("it.tif: not supported: ") && !message.contains('\n'), "{message}");
    message
}

#[test]
fn tiff_samples_of_any_number_of_bits_follow_one_another() {
    let twelve = Page::new((1, 1), 12, 2, &[0x52, 0xAA, 0x43, 0x5D, 0x20]);
    let photo = read_page(&twelve);
    assert_eq!(photo.source.samples, Samples::U16(vec![0x52A, 0xA43, 0x5D2]));
    assert_eq!(photo.source.max, Some(4095));
    let ten = read_page(&Page::new((2, 1), 10, 1, &[0xFF, 0xC0, 0x10]));
    assert_eq!(pixels(&ten), gray(&[255.0, 255.0f32 / 1023.0]));
    let fourteen = read_page(&Page::new((1, 2), 14, 1, &[0xFF, 0xFC, 0, 0x04]));
    assert_eq!(fourteen.source.samples, Samples::U16(vec![16383, 1]));
    let triples = [Page::new((1, 1), 24, 1, &[1, 2, 3])];
    assert_eq!(read_linear(&tiffs::file(&triples, false)).source.samples, Samples::U32(vec![0x03_02_01]));
    assert_eq!(read_linear(&tiffs::file(&triples, true)).source.samples, Samples::U32(vec![0x01_02_03]));
    assert_eq!(read_page(&Page::new((1, 1), 3, 1, &[0b1010_0000])).source.samples, Samples::U8(vec![5]));
}

#[test]
fn signed_tiff_samples_end_at_half_the_range_and_have_no_value_below_zero() {
    let data: Vec<u8> = [16_000i16, -1, 0, 32767].iter().flat_map(|value| value.to_le_bytes()).collect();
    let photo = read_page(&Page::new((4, 1), 16, 1, &data).with(FORMAT, &[2]).with(274, &[2]));
    assert_eq!(photo.source.max, Some(32767));
    assert_eq!(photo.source.samples, Samples::U16(vec![32767, 0, 0, 16_000]), "mirrored");
    assert_eq!(photo.image.invalid.as_slice(), [false, false, true, false]);
    assert!(
        photo.warnings[0].starts_with("1 of 4 pixels have values that are negative"),
        "{:?}",
        photo.warnings
    );
}

#[test]
fn the_lowest_bit_may_be_the_first() {
    let reversed: Vec<u8> = [7u8, 130, 255].iter().map(|byte| byte.reverse_bits()).collect();
    let page = Page::new((3, 1), 8, 1, &reversed).with(LSB_FIRST, &[2]);
    assert_eq!(pixels(&read_page(&page)), gray(&[7.0, 130.0, 255.0]));
    // PackBits: three literal bytes.
    let packed = [&[2u8.reverse_bits()], &reversed[..]].concat();
    let page = Page::new((3, 1), 8, 1, &packed).with(LSB_FIRST, &[2]).with(COMPRESSION, &[32773]);
    assert_eq!(pixels(&read_page(&page)), gray(&[7.0, 130.0, 255.0]));
}

#[test]
fn planes_of_tiles_are_cut_at_the_pictures_border() {
    // Tiles of 2 × 2 in a picture of 3 × 3: four of each band, filled with 10 × band + the tile's number.
    let tiles = (0..12u8).map(|index| vec![10 * (index / 4) + index % 4; 4]).collect();
    let page = Page { size: (3, 3), tile: Some((2, 2)), chunks: tiles, ..Page::new((3, 3), 8, 2, &[]) };
    let photo = read_page(&page.with(PLANES, &[2]));
    let at = |x: usize, y: usize| pixels(&photo)[3 * y + x];
    assert_eq!([at(0, 0), at(2, 0)], [[0.0, 10.0, 20.0], [1.0, 11.0, 21.0]]);
    assert_eq!([at(1, 2), at(2, 2)], [[2.0, 12.0, 22.0], [3.0, 13.0, 23.0]]);
}

#[test]
fn a_color_map_of_eight_bits_is_recognized() {
    let map: Vec<u16> = (0..768).map(|at| (at * 7 % 256) as u16).collect();
    let photo = read_page(&Page::new((2, 1), 8, 3, &[3, 7]).with(320, &map));
    let color = |index: usize| [0, 1, 2].map(|band| f32::from(map[256 * band + index]));
    assert_eq!(pixels(&photo), [color(3), color(7)]);
    assert!(photo.warnings[0].contains("color map ends at 255"), "{:?}", photo.warnings);
}

#[test]
fn luminance_and_color_differences_are_converted() {
    // A unit of 2 × 2 pixels: four luminances, Cb, Cr.
    let page = Page::new((2, 2), 8, 6, &[100, 150, 200, 250, 128, 128]);
    let photo = read_page(&page);
    assert_eq!(pixels(&photo), gray(&[100.0, 150.0, 200.0, 250.0]));
    let red = read_page(&Page::new((1, 1), 8, 6, &[76, 85, 255]).with(530, &[1, 1]));
    let [r, g, b] = pixels(&red)[0];
    assert!(r > 250.0 && g < 5.0 && b < 5.0, "{r} {g} {b}");
}

#[test]
fn bands_that_are_not_colors_are_left_out_with_a_warning() {
    let bands = |bits: Vec<u16>, photometric, data: &[u8]| Page {
        bits,
        photometric,
        ..Page::new((1, 1), 8, photometric, data)
    };
    let five = read_page(&bands(vec![8; 5], 1, &[82, 1, 2, 3, 4]));
    assert_eq!(pixels(&five), gray(&[82.0]));
    assert_eq!(five.warnings, ["the TIFF holds 5 bands: only the first is read"]);
    let infrared = read_page(&bands(vec![8; 4], 2, &[1, 2, 3, 99]));
    assert_eq!((pixels(&infrared)[0], infrared.source.layout), ([1.0, 2.0, 3.0], Layout::Rgb));
    assert_eq!(infrared.warnings, ["the TIFF holds 4 bands: only red, green and blue are read"]);
    let late_alpha = read_page(&bands(vec![8; 5], 2, &[10, 20, 30, 99, 51]).with(338, &[0, 2]));
    assert_eq!(pixels(&late_alpha), [[2.0, 4.0, 6.0]]);
}

#[test]
fn the_main_picture_is_neither_a_preview_nor_a_mask() {
    let preview = Page::new((1, 1), 8, 1, &[9]).with(254, &[1]);
    let main = Page::new((2, 1), 8, 1, &[1, 2]);
    let photo = read_linear(&tiffs::file(&[preview.clone(), main.clone()], false));
    assert_eq!(pixels(&photo), gray(&[1.0, 2.0]));
    assert_eq!(photo.warnings, ["the TIFF begins with a preview: its main picture is read"]);
    let photo = read_linear(&tiffs::file(&[main.clone(), preview], true));
    assert!(photo.warnings.is_empty(), "{:?}", photo.warnings);
    let photo = read_linear(&tiffs::file(&[main.clone(), main], false));
    assert_eq!(photo.warnings, ["the TIFF holds several pictures (2): only the first is read"]);
}

#[test]
fn three_channels_of_imagej_are_red_green_and_blue() {
    let text = "ImageJ=1.54f\nimages=3\nchannels=3\nhyperstack=true\nmode=composite\n";
    let channel = |value: u8| Page::new((2, 1), 8, 1, &[value, value + 1]);
    let first = Page { texts: vec![(270, text)], ..channel(10) };
    let photo = read_linear(&tiffs::file(&[first.clone(), channel(20), channel(30)], false));
    assert_eq!(pixels(&photo), [[10.0, 20.0, 30.0], [11.0, 21.0, 31.0]]);
    assert!(photo.warnings[0].contains("three channels"), "{:?}", photo.warnings);
    let photo = read_linear(&tiffs::file(&[first, channel(20)], false));
    assert_eq!(pixels(&photo), gray(&[10.0, 11.0]));
    assert!(photo.warnings[0].contains("(3): only the first"), "{:?}", photo.warnings);
}

#[test]
fn what_is_not_supported_in_a_tiff_is_named() {
    let plain = || Page::new((1, 1), 8, 1, &[1]);
    for (page, name) in [
        (plain().with(COMPRESSION, &[34925]), "the compression LZMA"),
        (plain().with(COMPRESSION, &[6]), "old-style JPEG"),
        (plain().with(FORMAT, &[6]), "complex numbers"),
        (plain().with(317, &[2]), "predictor 2"),
        (plain().with(50706, &[1, 4]), "raw data"),
        (Page { photometric: 32803, ..plain() }, "raw data"),
        (Page { photometric: 8, ..plain() }, "L*a*b*"),
        (Page { photometric: 5, bits: vec![8; 4], ..plain() }, "CMYK"),
        (Page { photometric: 2, bits: vec![5, 6, 5], ..plain() }, "different depths"),
        (Page { bits: vec![64], ..plain() }, "unsigned integers of 64 bits"),
    ] {
        let message = refused(&tiffs::file(&[page], false));
        assert!(message.contains(name), "{message}");
    }
    let mut canon = tiffs::file(&[plain()], false);
    canon.splice(8..8, *b"CR\x02\0");
    assert!(refused(&canon).contains("raw data"));
}

#[test]
fn a_tiffs_transfer_function_is_undone() {
    let squares: Vec<u16> = (0..256u32).map(|code| (code * code * 65535 / 65025) as u16).collect();
    let page = Page::new((1, 1), 8, 1, &[128]).with(301, &squares);
    let photo = decode(&tiffs::file(&[page], false), "x.tif", &ReadOptions::default()).unwrap();
    assert!((pixels(&photo)[0][0] - 255.0 * (128.0f32 / 255.0).powi(2)).abs() < 0.01);
    assert!(photo.encoding.to_string().contains("TIFF tone curve"), "{}", photo.encoding);
}

/// Files that `cjpeg` wrote, and the pixels that `djpeg` read.
#[test]
fn jpegs_of_every_arrangement_of_scans_and_samples() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/photo/data");
    for name in ["scans_2x2", "luma_below_chroma", "thirds", "rgb_ids", "progressive"] {
        let file = |extension| std::fs::read(folder.join(format!("{name}.{extension}"))).unwrap();
        let (photo, expected) = (read_linear(&file("jpg")), read_linear(&file("ppm")));
        let bands = pixels(&photo).iter().flatten().zip(pixels(&expected).iter().flatten());
        for (found, right) in bands {
            assert!((found - right).abs() <= 4.0, "{name}: {found} instead of {right}");
        }
    }
    for (name, feature) in [
        ("arithmetic", "arithmetic coding"),
        ("twelve_bits", "12 bits"),
        ("lossless", "lossless coding"),
        ("between", "scans of their own"),
    ] {
        let message = refused(&std::fs::read(folder.join(format!("{name}.jpg"))).unwrap());
        assert!(message.contains(feature), "{message}");
    }
}

#[test]
fn exif_may_say_adobe_rgb() {
    let mut jpeg = files::jpeg((8, 8), image::ExtendedColorType::Rgb8, &[128; 192], None);
    let exif = files::ADOBE_RGB_EXIF;
    let mut segment = vec![0xFF, 0xE1];
    segment.extend_from_slice(&(exif.len() as u16 + 8).to_be_bytes());
    segment.extend_from_slice(b"Exif\0\0");
    segment.extend_from_slice(exif);
    jpeg.splice(2..2, segment);
    let photo = decode(&jpeg, "x.jpg", &ReadOptions::default()).unwrap();
    assert_eq!(photo.encoding.to_string(), "gamma 2.199 (EXIF says Adobe RGB)");
}

#[test]
fn radiance_pictures_are_turned_upright() {
    // Two scanlines of three pixels, red 1/8 to 6/8.
    let data: Vec<u8> = (1..=6).flat_map(|step| [step * 16, 0, 0, 128]).collect();
    let read = |resolution: &str| {
        let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
        bytes.extend_from_slice(&data);
        let photo = read_linear(&bytes);
        let red: Vec<u8> =
            pixels(&photo).iter().map(|color| (color[0] / 255.0 * 16.0).round() as u8).collect();
        (photo.image.width(), red)
    };
    assert_eq!(read("-Y 2 +X 3"), (3, vec![1, 2, 3, 4, 5, 6]));
    assert_eq!(read("+Y 2 +X 3"), (3, vec![4, 5, 6, 1, 2, 3]));
    assert_eq!(read("-Y 2 -X 3"), (3, vec![3, 2, 1, 6, 5, 4]));
    assert_eq!(read("+Y 2 -X 3"), (3, vec![6, 5, 4, 3, 2, 1]));
    // Scanlines are columns: the first is the left one, and begins at the top.
    assert_eq!(read("+X 2 -Y 3"), (2, vec![1, 4, 2, 5, 3, 6]));
    assert_eq!(read("+X 2 +Y 3"), (2, vec![3, 6, 2, 5, 1, 4]));
    assert_eq!(read("-X 2 -Y 3"), (2, vec![4, 1, 5, 2, 6, 3]));
    assert_eq!(read("-X 2 +Y 3"), (2, vec![6, 3, 5, 2, 4, 1]));
}

#[test]
fn a_radiance_header_is_honored_or_mentioned() {
    let with = |line: &str| format!("#?RADIANCE\n{line}\n\n-Y 1 +X 1\n\u{10}\u{10}\u{10}\u{7f}").into_bytes();
    let photo = read_linear(&with("EXPOSURE=2.0"));
    assert!(photo.warnings[0].contains("EXPOSURE 2.0"), "{:?}", photo.warnings);
    assert!(read_linear(&with("EXPOSURE=1.0")).warnings.is_empty());
    let message = decode(&with("FORMAT=32-bit_rle_xyze"), "x.hdr", &linear()).unwrap_err().to_string();
    assert!(message.contains("not supported") && message.contains("xyze"), "{message}");
}

/// A BMP of two pixels of 32 bits with a header of version 5.
fn bmp_v5(pixels: &[u8], color_space: u32, gamma: u32) -> Vec<u8> {
    let mut bytes = b"BM\0\0\0\0\0\0\0\0\x8A\0\0\0".to_vec();
    let mut header = vec![0u8; 124];
    let mut put = |at: usize, value: u32| header[at..at + 4].copy_from_slice(&value.to_le_bytes());
    for (at, value) in
        [(0, 124), (4, 2), (8, 1), (12, 1 | 32 << 16), (16, 3), (20, 8), (24, 2000), (28, 4000)]
    {
        put(at, value);
    }
    for (at, value) in [(40, 0xFF_0000), (44, 0xFF00), (48, 0xFF), (52, 0xFF00_0000), (56, color_space)] {
        put(at, value);
    }
    for at in [96, 100, 104] {
        put(at, gamma);
    }
    bytes.extend(header);
    bytes.extend_from_slice(pixels);
    bytes
}

#[test]
fn a_bmps_header_says_alpha_gamma_and_density() {
    let srgb = u32::from_be_bytes(*b"sRGB");
    let photo = read_linear(&bmp_v5(&[3, 2, 1, 0, 6, 5, 4, 0], srgb, 0));
    assert_eq!(
        pixels(&photo),
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        "alpha that is zero everywhere is not used"
    );
    assert_eq!(photo.source.density.unwrap().pixel_aspect(), 2.0);
    assert!(photo.warnings[0].contains("2.00 times as wide as high"), "{:?}", photo.warnings);
    let photo = read_linear(&bmp_v5(&[3, 2, 1, 255, 6, 5, 4, 0], srgb, 0));
    assert_eq!(pixels(&photo), [[1.0, 2.0, 3.0], [0.0; 3]]);
    let calibrated = bmp_v5(&[128, 128, 128, 255, 0, 0, 0, 255], 0, 2 << 16);
    let photo = decode(&calibrated, "x.bmp", &ReadOptions::default()).unwrap();
    assert_eq!(photo.encoding.to_string(), "gamma 2 (BMP tone curve)");
}

#[test]
fn what_other_formats_hold_is_named() {
    let mut apple = Png { size: (1, 1), bits: 8, data: &[1, 2, 3], ..Png::default() }.bytes();
    apple.splice(8..8, *b"\0\0\0\x04CgBI\x50\0\x20\x02\x2B\xD5\xB3\x7F");
    assert!(refused(&apple).contains("CgBI"));
    let mut inner_jpeg = bmp_v5(&[0; 8], 0, 0);
    inner_jpeg[14 + 16] = 4;
    assert!(refused(&inner_jpeg).contains("JPEG data"));
    let pam = b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 3\nMAXVAL 255\nTUPLTYPE YCBCR\nENDHDR\n\x01\x02\x03";
    assert!(refused(pam).contains("YCBCR"));
    let two = read_linear(b"P5\n1 1\n255\n\x25P5\n1 1\n255\n\x26");
    assert_eq!(two.warnings, ["the PNM file holds several pictures: only the first is read"]);
    for (magic, name) in [(&b"qoif"[..], "a QOI"), (b"\0\0\0\x0cjP  \r\n", "a JPEG 2000"), (b"PF\n", "a PFM")]
    {
        let message = decode(&[magic, &[0; 20]].concat(), "x", &linear()).unwrap_err().to_string();
        assert!(message.contains(&format!("{name} cannot be read")), "{message}");
    }
}

#[test]
fn more_pixels_than_a_file_can_hold_are_not_believed() {
    let mut webp = files::webp((1, 1), image::ExtendedColorType::Rgb8, &[1, 2, 3]);
    // Width − 1 and height − 1, of 14 bits each, behind the signature of the lossless picture.
    let at = webp.windows(4).position(|window| window == b"VP8L").unwrap() + 9;
    webp[at..at + 4].copy_from_slice(&(0x270F_u32 | 0x270F << 14).to_le_bytes());
    let message = decode(&webp, "x.webp", &ReadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("it declares 100.0 megapixels in"), "{message}");
}
