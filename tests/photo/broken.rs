//! Broken files give an error of one helpful line or a picture, but never a panic or an endless loop.

use crate::files::{self, Png, curv, rgb_icc};
use crate::{linear, pixels};
use dichroscope::photo::{Format, ReadError, ReadOptions, decode, read};
use exr::image::FlatSamples;
use image::ExtendedColorType::{L8, Rgb8, Rgba8};
use tiff::encoder::colortype;

/// One intact file of each format, with a header that is not trivial.
pub fn intact() -> Vec<(&'static str, Vec<u8>)> {
    let noise = |n: u32| (0..n).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect::<Vec<u8>>();
    let floats: Vec<f32> = noise(17 * 13).iter().map(|&v| f32::from(v) / 255.0).collect();
    let profile = rgb_icc(&curv(&[0, 20000, 65535]));
    let exif = files::exif(8);
    let png = Png {
        size: (17, 13),
        bits: 8,
        data: &noise(17 * 13 * 3),
        icc: Some(&profile),
        exif: Some(&exif),
        ..Png::default()
    };
    let channel = |name| (name, FlatSamples::F32(floats.clone()));
    let shorts: Vec<u16> = noise(17 * 13 * 3).iter().map(|&v| u16::from(v) * 257).collect();
    let hdr: Vec<[f32; 3]> = floats.iter().map(|&v| [v, 1.0 - v, 0.5]).collect();
    let mut ppm = b"P6\n17 13\n255\n".to_vec();
    ppm.extend(noise(17 * 13 * 3));
    let palette: Vec<u16> = (0..768).map(|i| i * 85).collect();
    vec![
        ("a.png", png.bytes()),
        ("a.jpg", files::jpeg((17, 13), Rgb8, &noise(17 * 13 * 3), Some(&profile))),
        ("a.tif", files::tiff::<colortype::RGB16>((17, 13), &shorts, &[], &[(274, 3)], Some(&profile))),
        ("p.tif", files::raw_tiff((17, 13), 8, 3, &palette, &noise(17 * 13))),
        ("a.bmp", files::bmp((17, 13), Rgb8, &noise(17 * 13 * 3))),
        ("g.bmp", files::bmp((17, 13), L8, &noise(17 * 13))),
        ("a.ppm", ppm),
        ("a.pgm", b"P2\n3 2 255\n1 2 3\n4 5 60".to_vec()),
        ("a.webp", files::webp((17, 13), Rgba8, &noise(17 * 13 * 4))),
        ("a.exr", files::exr((17, 13), &[channel("R"), channel("G"), channel("B"), channel("A")])),
        ("y.exr", files::exr((17, 13), &[channel("Y")])),
        ("a.hdr", files::hdr((17, 13), &hdr)),
        ("a.heic", crate::heif::PLAIN.to_vec()),
    ]
}

/// Reads the bytes, and checks that an error is one line that names the file.
pub fn error_of(bytes: &[u8], name: &str) -> Option<String> {
    let options = ReadOptions { max_megapixels: 1.0, ..ReadOptions::default() };
    let message = decode(bytes, name, &options).err()?.to_string();
    assert!(message.starts_with(name) && !message.contains(char::is_control), "{message:?}");
    assert!(message.chars().count() < 500, "{message:?}");
    assert!(!message.contains("failed on it"), "a panic of a decoder: {message:?}");
    Some(message)
}

#[test]
fn intact_files_are_read() {
    for (name, bytes) in intact() {
        assert_eq!(error_of(&bytes, name), None);
    }
}

#[test]
fn every_truncation_is_an_error() {
    for (name, bytes) in intact() {
        for length in 0..bytes.len() {
            let found = error_of(&bytes[..length], name);
            // A PNG is complete without the chunks after its picture; a text file may end within its last number.
            let complete_before_end = match name {
                "a.png" => 16,
                "a.pgm" | "a.webp" => 1,
                _ => 0,
            };
            assert!(found.is_some() || length + complete_before_end >= bytes.len(), "{name} cut to {length}");
        }
    }
}

#[test]
fn flipped_bytes_never_panic() {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    for (name, bytes) in intact() {
        for _ in 0..600 {
            let mut broken = bytes.clone();
            for _ in 0..=random(3) {
                // Half of the changes are in the first 200 bytes, the header, where most checks are.
                let at = if random(2) == 0 { random(bytes.len().min(200)) } else { random(bytes.len()) };
                broken[at] = [0, 1, 0x7F, 0x80, 0xFF, random(256) as u8][random(6)];
            }
            error_of(&broken, name);
        }
    }
}

#[test]
fn strangers_are_named() {
    assert_eq!(
        error_of(b"", "void.png").unwrap(),
        format!("void.png: the file is empty; expected a picture ({})", Format::NAMES)
    );
    assert!(error_of(b"GIF89a....", "x.png").unwrap().contains("a GIF cannot be read"));
    assert!(error_of(b"Dear diary", "x.txt").unwrap().contains("Dear dia"));
    let garbage: Vec<u8> = (0..100_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    assert!(error_of(&garbage, "x").is_some());
    for magic in [
        &b"\x89PNG\r\n\x1a\n"[..],
        b"\xff\xd8\xff",
        b"II*\0",
        b"BM",
        b"P6 ",
        b"RIFF\0\0\0\0WEBP",
        b"v/1\x01",
        b"#?RADIANCE\n",
    ] {
        assert!(error_of(&[magic, &garbage].concat(), "x").is_some());
        assert!(error_of(magic, "x").is_some());
    }
}

#[test]
fn zero_pixels_and_one_pixel() {
    for bytes in [&b"P6\n0 5\n255\n"[..], b"P5\n3 0\n255\n"] {
        assert!(error_of(bytes, "x.ppm").unwrap().contains("expected at least one of each"));
    }
    assert_eq!(
        pixels(&decode(&files::rgb8_png((1, 1), &[1, 2, 3]), "x", &linear()).unwrap()),
        [[1.0, 2.0, 3.0]]
    );
}

#[test]
fn enormous_headers_are_refused_before_memory_is_taken() {
    let huge = Png { size: (1, 1), bits: 8, data: &[1, 2, 3], ..Png::default() }.bytes();
    let mut png = huge.clone();
    png[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let error = decode(&png, "big.png", &ReadOptions::default()).unwrap_err();
    // The header's checksum is wrong too: the error depends on whether checksum or size is checked first.
    assert!(matches!(error, ReadError::Damaged { .. } | ReadError::TooLarge { .. }), "{error}");
    let error =
        decode(b"P6\n100000 50000\n255\n", "big.ppm", &ReadOptions::default()).unwrap_err().to_string();
    assert_eq!(
        error,
        "big.ppm: the PNM file declares 100000 \u{d7} 50000 = 5000 megapixels, more than the limit of 100; if that \
         is right, raise it with --max-megapixels"
    );
    let options = ReadOptions { max_megapixels: 6e-6, ..ReadOptions::default() };
    assert!(decode(b"P2\n3 2 255\n1 2 3 4 5 6", "x", &options).is_ok());
    assert!(decode(b"P2\n7 1 255\n1 2 3 4 5 6 7", "x", &options).is_err());
}

#[test]
fn options_must_make_sense() {
    let bytes = files::rgb8_png((1, 1), &[1, 2, 3]);
    for full_scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = ReadOptions { full_scale: Some(full_scale), ..ReadOptions::default() };
        assert!(decode(&bytes, "x", &options).unwrap_err().to_string().starts_with("full scale = "));
        let options = ReadOptions { max_megapixels: full_scale, ..ReadOptions::default() };
        assert!(decode(&bytes, "x", &options).unwrap_err().to_string().starts_with("max megapixels = "));
    }
}

#[test]
fn files_are_read_from_disk_or_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.png");
    let message = read(&path, &linear()).unwrap_err().to_string();
    assert!(message.contains("one.png: cannot be read"), "{message}");
    assert!(read(folder.path(), &linear()).is_err());
    std::fs::write(&path, files::rgb8_png((1, 1), &[1, 2, 3])).unwrap();
    let photo = read(&path, &linear()).unwrap();
    assert_eq!(pixels(&photo), [[1.0, 2.0, 3.0]]);
    assert!(photo.name.ends_with("one.png"));
}
