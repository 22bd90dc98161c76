//! Writing matte pictures and reading them: unchanged pixels keep their bytes.

use crate::files::{self, Png, curv, rgb_icc};
use crate::tiffs::{self, Page};
use crate::{pixels, read_with};
use dichroscope::export::write_matte;
use dichroscope::intrinsic::{Ambient, Intrinsic, PixelKind, Reason};
use dichroscope::photo::{Layout, LinearImage, Photo, ReadOptions, decode, read};
use dichroscope::raster::{Mask, Raster};
use exr::image::FlatSamples;
use image::ExtendedColorType::{L8, Rgb8, Rgba8};
use png::ColorType::{Grayscale, GrayscaleAlpha, Rgba};
use tiff::encoder::colortype;
use tiff::tags::ExtraSamples;

/// Writes `body` as the matte picture of `photo` and reads the file; returns the picture and the file name.
fn written(photo: &Photo, body: &Raster<[f32; 3]>, options: &ReadOptions) -> (Photo, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = write_matte(photo, &split(body, [0.0; 3]), 0.0, folder.path()).unwrap();
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    (read(&path, options).unwrap(), name)
}

/// The result of an analysis with this body and surface reflection, counts, in which all pixels are matte.
fn split(body: &Raster<[f32; 3]>, surface: [f32; 3]) -> Intrinsic {
    let (width, height) = (body.width(), body.height());
    Intrinsic {
        body: body.clone(),
        surface: Raster::filled(width, height, surface),
        noise: Raster::filled(width, height, 0.0),
        kinds: Raster::filled(width, height, PixelKind::Matte),
        confidence: Raster::filled(width, height, 1.0),
        reasons: Raster::filled(width, height, Reason::Explained),
        ambient: Ambient::default(),
        regions: Vec::new(),
    }
}

fn shorts(n: u32) -> Vec<u16> {
    (0..n).map(|i| (i.wrapping_mul(2_654_435_761) >> 16) as u16).collect()
}

fn bytes(n: u32) -> Vec<u8> {
    shorts(n).iter().map(|v| (v >> 8) as u8).collect()
}

/// Files of lossless formats, with the file names of their matte pictures.
fn lossless() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let profile = rgb_icc(&curv(&[0, 100, 20000, 65535]));
    let exif = files::exif(5);
    let (size, tiny) = ((5, 3), (5, 3));
    let deep: Vec<u8> = shorts(60).iter().flat_map(|v| v.to_be_bytes()).collect();
    let png = |color, bits, data: &[u8], chunks: &[([u8; 4], &[u8])], icc: Option<&[u8]>| {
        Png { size, color: Some(color), bits, data, chunks, icc, exif: Some(&exif), ..Png::default() }.bytes()
    };
    let cicp: [u8; 4] = [1, 13, 0, 1];
    let floats: Vec<f32> = shorts(60).iter().map(|&v| f32::from(v) / 30000.0).collect();
    let channel =
        |name, scale: f32| (name, FlatSamples::F32(floats[..15].iter().map(|v| v * scale).collect()));
    let mut nan = floats.clone();
    nan[4] = f32::NAN;
    let alpha = [ExtraSamples::UnassociatedAlpha];
    let mut ppm = b"P6\n5 3\n51\n".to_vec();
    ppm.extend(bytes(45).iter().map(|v| v % 52));
    vec![
        ("png rgb8", files::rgb8_png(size, &bytes(45)), "matte.png"),
        ("png gray 2", png(Grayscale, 2, &bytes(6), &[], None), "matte.png"),
        (
            "png gray 16",
            png(Grayscale, 16, &deep[..30], &[(*b"gAMA", &100_000u32.to_be_bytes())], None),
            "matte.png",
        ),
        ("png gray alpha", png(GrayscaleAlpha, 8, &bytes(30), &[(*b"cICP", &cicp)], None), "matte.png"),
        ("png rgba16", png(Rgba, 16, &deep, &[(*b"sRGB", &[1])], Some(&profile)), "matte.png"),
        ("bmp", files::bmp(tiny, Rgb8, &bytes(45)), "matte.png"),
        ("webp", files::webp(tiny, Rgba8, &bytes(60)), "matte.png"),
        ("heic", crate::heif::PLAIN.to_vec(), "matte.png"),
        ("ppm", ppm, "matte.png"),
        (
            "tiff 8",
            files::tiff::<colortype::RGB8>(size, &bytes(45), &[], &[(274, 8)], Some(&profile)),
            "matte.tif",
        ),
        ("tiff 16a", files::tiff::<colortype::Gray16>(size, &shorts(30), &alpha, &[], None), "matte.tif"),
        ("tiff f", files::tiff::<colortype::RGB32Float>(size, &nan[..45], &[], &[], None), "matte.tif"),
        (
            "tiff 32",
            files::tiff::<colortype::Gray32>(
                size,
                &shorts(15).iter().map(|&v| u32::from(v) << 15 | 1).collect::<Vec<_>>(),
                &[],
                &[],
                None,
            ),
            "matte.tif",
        ),
        (
            "exr",
            files::exr((5, 3), &[channel("R", 1.0), channel("G", 0.5), channel("B", 0.1), channel("A", 0.3)]),
            "matte.tif",
        ),
        (
            "hdr",
            files::hdr((5, 3), &floats[..45].chunks(3).map(|c| [c[0], c[1], c[2]]).collect::<Vec<_>>()),
            "matte.tif",
        ),
    ]
}

/// What an image says of its pixels. Files of another format may store the same values with another rounding.
fn values(image: &LinearImage) -> (&Raster<[f32; 3]>, &Mask) {
    (&image.pixels, &image.invalid)
}

#[test]
fn an_unchanged_photograph_comes_back_exactly() {
    for full_scale in [None, Some(2040.0)] {
        let options = ReadOptions { full_scale, ..ReadOptions::default() };
        for (name, bytes, expected) in lossless() {
            let photo = read_with(&bytes, &options);
            let (reread, file) = written(&photo, &photo.image.pixels, &options);
            assert_eq!(file, expected, "{name}");
            assert_eq!(values(&reread.image), values(&photo.image), "{name}");
            assert_eq!(reread.source.layout, photo.source.layout, "{name}");
            assert_eq!(
                (&reread.source.icc, reread.source.png),
                (&photo.source.icc, photo.source.png),
                "{name}"
            );
        }
    }
}

#[test]
fn changed_pixels_are_read_within_half_a_code() {
    // The PNM is left out: its codes are five counts apart.
    for (name, bytes, _) in lossless().into_iter().filter(|(name, ..)| *name != "ppm") {
        let options = ReadOptions::default();
        let photo = read_with(&bytes, &options);
        let body = photo.image.pixels.map(|pixel| pixel.map(|counts| counts * 0.7));
        let (reread, _) = written(&photo, &body, &options);
        for (found, wanted) in pixels(&reread).iter().flatten().zip(body.as_slice().iter().flatten()) {
            // Half a code is less than 1.5 counts: the steepest of these tone curves has a slope below 3.
            assert!((found - wanted).abs() < 1.5, "{name}: {found} instead of {wanted}");
        }
    }
}

#[test]
fn what_says_how_to_show_the_picture_is_kept() {
    let written_again = |bytes: &[u8]| {
        let photo = read_with(bytes, &ReadOptions::default());
        let (reread, _) = written(&photo, &photo.image.pixels.clone(), &ReadOptions::default());
        assert_eq!(reread.encoding.curves, photo.encoding.curves);
        assert_eq!(values(&reread.image), values(&photo.image));
        (photo.source, reread.source)
    };
    let chrm: Vec<u8> = (1..=8u32).flat_map(|value| (value * 1000).to_be_bytes()).collect();
    let density = [&2000u32.to_be_bytes()[..], &1000u32.to_be_bytes(), &[1]].concat();
    let chunks: &[([u8; 4], &[u8])] =
        &[(*b"cHRM", &chrm), (*b"gAMA", &50_000u32.to_be_bytes()), (*b"pHYs", &density)];
    let exif = files::exif(6);
    let png = Png { size: (2, 1), bits: 8, data: &bytes(6), chunks, exif: Some(&exif), ..Png::default() };
    let (before, after) = written_again(&png.bytes());
    assert_eq!((after.png.chrm.unwrap()[7], after.png), (8000, before.png));
    assert_eq!(after.density.unwrap().axes, [(1000, 1), (2000, 1)], "turned with the picture");

    let squares: Vec<u16> = (0..256u32).map(|code| (code * code) as u16).collect();
    let page = Page::new((2, 1), 8, 2, &bytes(6)).with(301, &squares).with(296, &[3]);
    let page = Page {
        fractions: vec![(282, vec![118, 1]), (283, vec![118, 1]), (318, vec![31, 100, 32, 100])],
        ..page
    };
    let (before, after) = written_again(&tiffs::file(&[page], false));
    assert_eq!((&after.tiff_color, after.density), (&before.tiff_color, before.density));
    assert_eq!(after.tiff_color.white_point, [(31, 100), (32, 100)]);
    assert!(after.transfer.is_some());
}

#[test]
fn a_tiff_of_twelve_bits_becomes_one_of_sixteen() {
    let photo = read_with(
        &tiffs::file(&[Page::new((1, 1), 12, 2, &[0x52, 0xAA, 0x43, 0x5D, 0x20])], false),
        &crate::linear(),
    );
    let (reread, _) = written(&photo, &photo.image.pixels.clone(), &crate::linear());
    assert_eq!(reread.source.max, Some(65535));
    for (found, wanted) in pixels(&reread)[0].iter().zip(pixels(&photo)[0]) {
        assert!((found - wanted).abs() < 0.005, "{found} instead of {wanted}");
    }
}

/// A JPEG of Adobe RGB without a profile, as cameras write it, has a matte picture of the same color space and density.
#[test]
fn a_matte_jpeg_keeps_adobe_rgb_and_density() {
    let mut jpeg = files::jpeg((8, 8), Rgb8, &[100; 192], None);
    let mut segment = vec![0xFF, 0xE1, 0, 80];
    segment.extend_from_slice(b"Exif\0\0");
    segment.extend_from_slice(files::ADOBE_RGB_EXIF);
    segment.resize(82, 0);
    let jfif = jpeg.windows(5).position(|window| window == b"JFIF\0").unwrap();
    jpeg[jfif + 7..jfif + 12].copy_from_slice(&[1, 0, 72, 0, 72]);
    jpeg.splice(2..2, segment);
    let photo = read_with(&jpeg, &ReadOptions::default());
    assert!(photo.source.is_adobe_rgb);
    let (reread, file) = written(&photo, &photo.image.pixels.clone(), &ReadOptions::default());
    assert_eq!((file.as_str(), reread.source.is_adobe_rgb), ("matte.jpg", true));
    assert_eq!(reread.source.density, photo.source.density);
    assert_eq!(reread.source.density.unwrap().axes, [(72, 1), (72, 1)]);
}

#[test]
fn jpegs_stay_jpegs() {
    let profile = rgb_icc(&curv(&[]));
    for (color, data, layout) in [(L8, bytes(64), Layout::Gray), (Rgb8, bytes(192), Layout::Rgb)] {
        let smooth: Vec<u8> = data.iter().map(|v| 100 + v / 32).collect();
        let icc = (layout == Layout::Rgb).then_some(&profile[..]);
        let photo = read_with(&files::jpeg((8, 8), color, &smooth, icc), &ReadOptions::default());
        let (reread, file) = written(&photo, &photo.image.pixels, &ReadOptions::default());
        assert_eq!((file.as_str(), reread.source.layout), ("matte.jpg", layout));
        assert_eq!(reread.source.icc, photo.source.icc);
        for (a, b) in pixels(&reread).iter().flatten().zip(pixels(&photo).iter().flatten()) {
            assert!((a - b).abs() < 6.0, "{a} {b}");
        }
    }
}

#[test]
fn a_gray_photograph_becomes_colored_only_with_its_body() {
    let bytes =
        Png { size: (2, 1), color: Some(Grayscale), bits: 8, data: &[40, 80], ..Png::default() }.bytes();
    let photo = decode(&bytes, "x.png", &crate::linear()).unwrap();
    let body = Raster::from_vec(2, 1, vec![[40.0; 3], [79.9, 80.1, 80.0]]).unwrap();
    assert_eq!(written(&photo, &body, &crate::linear()).0.source.layout, Layout::Gray);
    let body = Raster::from_vec(2, 1, vec![[40.0; 3], [10.0, 20.0, 30.0]]).unwrap();
    let (reread, _) = written(&photo, &body, &crate::linear());
    assert_eq!(reread.source.layout, Layout::Rgb);
    assert_eq!(pixels(&reread), body.as_slice());
}

#[test]
fn transparent_pixels_keep_their_hidden_samples() {
    let bytes = Png {
        size: (2, 1),
        color: Some(Rgba),
        bits: 8,
        data: &[9, 8, 7, 0, 200, 100, 50, 51],
        ..Png::default()
    }
    .bytes();
    let photo = decode(&bytes, "x.png", &crate::linear()).unwrap();
    let body = Raster::from_vec(2, 1, vec![[0.0; 3], [20.0, 10.0, 5.0]]).unwrap();
    let (reread, _) = written(&photo, &body, &crate::linear());
    assert_eq!(reread.source.samples, dichroscope::photo::Samples::U8(vec![9, 8, 7, 0, 100, 50, 25, 51]));
}

#[test]
fn the_surface_reflection_that_is_kept_runs_from_the_body_to_the_photograph() {
    for (name, bytes, _) in lossless() {
        let options = ReadOptions::default();
        let photo = read_with(&bytes, &options);
        let body = photo.image.pixels.map(|pixel| pixel.map(|counts| counts * 0.7));
        let intrinsic = split(&body, [5.0; 3]);
        let kept = |share| {
            let folder = tempfile::tempdir().unwrap();
            read(&write_matte(&photo, &intrinsic, share, folder.path()).unwrap(), &options).unwrap()
        };
        assert_eq!(values(&kept(0.0).image), values(&written(&photo, &body, &options).0.image), "{name}");
        assert_eq!(values(&kept(1.0).image), values(&photo.image), "{name}");
        let (half, none) = (kept(0.5), kept(0.0));
        for ((half, none), all) in pixels(&half).iter().zip(pixels(&none)).zip(pixels(&photo)) {
            assert!((0..3).all(|band| none[band] <= half[band] && half[band] <= all[band]), "{name}");
        }
    }
}

#[test]
fn a_restored_pixel_keeps_a_share_of_its_restored_surface_reflection_and_at_most_the_photograph() {
    let photo = read_with(&files::rgb8_png((2, 1), &[255, 250, 200, 90, 80, 70]), &crate::linear());
    let body = Raster::from_vec(2, 1, vec![[100.0, 50.0, 20.0], [60.0, 50.0, 40.0]]).unwrap();
    let mut intrinsic = split(&body, [200.0, 180.0, 160.0]);
    intrinsic.kinds[0] = PixelKind::Restored;
    let kept = |share| {
        let folder = tempfile::tempdir().unwrap();
        read(&write_matte(&photo, &intrinsic, share, folder.path()).unwrap(), &crate::linear()).unwrap()
    };
    assert_eq!(pixels(&kept(0.5)), [[200.0, 140.0, 100.0], [75.0, 65.0, 55.0]]);
    assert_eq!(pixels(&kept(0.9)), [[255.0, 212.0, 164.0], [87.0, 77.0, 67.0]]);
    assert_eq!(pixels(&kept(1.0)), pixels(&photo));
}

#[test]
fn a_body_of_another_size_is_refused() {
    let photo = read_with(&files::rgb8_png((1, 1), &[1, 2, 3]), &ReadOptions::default());
    let error = write_matte(
        &photo,
        &split(&Raster::filled(2, 1, [0.0; 3]), [0.0; 3]),
        0.0,
        std::path::Path::new("/nowhere"),
    )
    .unwrap_err();
    assert_eq!(error.to_string(), "the body image has 2 \u{d7} 1 pixels, the photograph 1 \u{d7} 1");
    let same = split(&photo.image.pixels, [0.0; 3]);
    let error = write_matte(&photo, &same, 0.0, std::path::Path::new("/nowhere")).unwrap_err();
    assert!(error.to_string().starts_with("/nowhere/matte.png: cannot be written"));
}
