//! HEIF: the photographs of phones. The files under `data` were written by libheif from the picture that [`written`] describes.

use crate::{linear, pixels, read_linear, read_with};
use dichroscope::photo::{Format, Layout, Photo, ReadOptions, Samples, decode};

pub const PLAIN: &[u8] = include_bytes!("data/plain.heic");
const TURNED: &[u8] = include_bytes!("data/turned.heic");
const TEN_BITS: &[u8] = include_bytes!("data/ten_bits.heic");
const ALPHA: &[u8] = include_bytes!("data/alpha.heic");
const GRAY: &[u8] = include_bytes!("data/gray.heic");

/// Width and height of the picture: no multiples of the coder's blocks, so that the files ask for a part of what they hold.
const SIZE: (usize, usize) = (61, 45);

/// The pixel in column `x` and row `y` of the picture before its compression.
fn written(x: usize, y: usize) -> [f32; 3] {
    let (x, y) = (x as f32, y as f32);
    [40.0 + 3.0 * x, 210.0 - 4.0 * y, 30.0 + x + 2.0 * y]
}

/// Fails where a pixel is more than `tolerance` counts away from what `expected` says of its column and row.
fn assert_near(photo: &Photo, tolerance: f32, expected: impl Fn(usize, usize) -> [f32; 3]) {
    let width = photo.image.width();
    for (at, found) in pixels(photo).iter().enumerate() {
        let expected = expected(at % width, at / width);
        let far = found.iter().zip(expected).any(|(found, expected)| (found - expected).abs() > tolerance);
        assert!(!far, "column {}, row {}: {found:?}, expected {expected:?}", at % width, at / width);
    }
}

fn size(photo: &Photo) -> (usize, usize) {
    (photo.image.width(), photo.image.height())
}

#[test]
fn the_part_that_the_file_shows_is_read() {
    let photo = read_linear(PLAIN);
    assert_eq!((photo.source.format, size(&photo), photo.source.max), (Format::Heif, SIZE, Some(255)));
    assert_eq!(photo.warnings, [""; 0]);
    assert_near(&photo, 3.0, written);
}

#[test]
fn the_picture_is_turned_upright_and_its_profile_kept() {
    let photo = read_linear(TURNED);
    assert_eq!(size(&photo), (SIZE.1, SIZE.0));
    assert!(photo.source.icc.is_some() && photo.source.cicp.is_none());
    assert_near(&photo, 3.0, |x, y| written(y, SIZE.1 - 1 - x));
}

#[test]
fn ten_bits_stay_ten_bits() {
    let photo = read_linear(TEN_BITS);
    assert_eq!((size(&photo), photo.source.max), (SIZE, Some(1023)));
    assert!(matches!(photo.source.samples, Samples::U16(_)));
    assert_near(&photo, 2.0, written);
}

#[test]
fn alpha_and_gray_are_read() {
    let photo = read_linear(ALPHA);
    assert_eq!((photo.source.layout, size(&photo)), (Layout::Rgba, SIZE));
    assert_near(&photo, 1.0, |x, y| written(x, y).map(|count| count * 0.2));
    let photo = read_linear(GRAY);
    assert_eq!((photo.source.layout, size(&photo)), (Layout::Gray, SIZE));
    assert_near(&photo, 2.0, |x, y| [written(x, y)[1]; 3]);
}

#[test]
fn the_code_points_name_the_tone_curve() {
    let photo = read_with(PLAIN, &ReadOptions::default());
    assert_eq!(photo.encoding.to_string(), "sRGB (HEIF nclx transfer 13)");
    let photo = read_with(TURNED, &ReadOptions::default());
    assert_eq!(photo.encoding.reason, "ICC profile");

    let at = PLAIN.windows(4).position(|window| window == b"nclx").unwrap();
    let mut hdr = PLAIN.to_vec();
    hdr[at + 7] = 16;
    let photo = read_with(&hdr, &ReadOptions::default());
    let says =
        "HEIF nclx says PQ (SMPTE ST 2084), which is not supported: read as sRGB; --encoding says otherwise";
    assert_eq!(photo.warnings, [says]);
}

#[test]
fn pictures_of_another_coder_are_refused_by_name() {
    let mut avif = PLAIN.to_vec();
    let at = avif.windows(4).position(|window| window == b"hvcC").unwrap();
    avif[at..at + 4].copy_from_slice(b"av1C");
    let message = decode(&avif, "x.heic", &linear()).unwrap_err().to_string();
    let says = "not supported: this HEIF file holds a picture that is not coded as HEVC";
    assert!(message.contains(says), "{message}");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let read = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| read_linear(TURNED)).source.samples
    };
    assert_eq!(read(1), read(3));
}
