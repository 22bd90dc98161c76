//! Every format, depth and layout is read to exact counts.

use crate::files::{self, Png};
use crate::{gray, pixels, read_linear, read_with};
use dichroscope::photo::{Format, Layout, ReadOptions, Samples, decode};
use exr::image::FlatSamples;
use exr::prelude::f16;
use image::ExtendedColorType::{L8, Rgb8, Rgba8};
use png::ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
use tiff::encoder::colortype;
use tiff::tags::ExtraSamples;

#[test]
fn png_of_every_depth() {
    let read = |color, bits, data: &[u8]| {
        let photo =
            read_linear(&Png { size: (2, 1), color: Some(color), bits, data, ..Png::default() }.bytes());
        assert_eq!((photo.image.width(), photo.image.height()), (2, 1));
        assert_eq!(photo.image.saturation, Some(255.0));
        assert_eq!(photo.source.format, Format::Png);
        pixels(&photo).to_vec()
    };
    assert_eq!(read(Grayscale, 1, &[0b1000_0000]), gray(&[255.0, 0.0]));
    assert_eq!(read(Grayscale, 2, &[0b0110_0000]), gray(&[85.0, 170.0]));
    assert_eq!(read(Grayscale, 4, &[0x1F]), gray(&[17.0, 255.0]));
    assert_eq!(read(Grayscale, 8, &[37, 255]), gray(&[37.0, 255.0]));
    assert_eq!(read(Grayscale, 16, &[1, 1, 255, 255]), gray(&[1.0, 255.0]));
    assert_eq!(read(GrayscaleAlpha, 8, &[9, 255, 8, 255]), gray(&[9.0, 8.0]));
    assert_eq!(read(Rgb, 8, &[1, 2, 3, 4, 5, 6]), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(read(Rgba, 8, &[1, 2, 3, 255, 4, 5, 6, 255]), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let deep = read(Rgb, 16, &[0, 0, 1, 1, 2, 2, 0, 1, 0x80, 0, 255, 255]);
    assert_eq!(deep[0], [0.0, 1.0, 2.0]);
    assert_eq!(deep[1], [(1.0 / 257.0) as f32, (32768.0 / 257.0) as f32, 255.0]);
}

#[test]
fn palettes_are_looked_up() {
    let palette = [10, 20, 30, 40, 50, 60];
    let png = Png {
        size: (2, 1),
        color: Some(Indexed),
        bits: 1,
        data: &[0b0100_0000],
        palette: Some(&palette),
        ..Png::default()
    };
    assert_eq!(pixels(&read_linear(&png.bytes())), [[10.0, 20.0, 30.0], [40.0, 50.0, 60.0]]);
    let see_through = Png { trns: Some(&[255, 51]), ..png };
    let photo = read_linear(&see_through.bytes());
    assert_eq!(pixels(&photo), [[10.0, 20.0, 30.0], [8.0, 10.0, 12.0]]);
    assert_eq!(photo.source.layout, Layout::Rgba);

    let map = [0, 257 * 7, 257, 257 * 8, 257 * 2, 257 * 9];
    let mut wide = [0u16; 48];
    wide[..2].copy_from_slice(&map[..2]);
    wide[16..18].copy_from_slice(&map[2..4]);
    wide[32..34].copy_from_slice(&map[4..]);
    let photo = read_linear(&files::raw_tiff((3, 1), 4, 3, &wide, &[0x01, 0x00]));
    assert_eq!(pixels(&photo), [[0.0, 1.0, 2.0], [7.0, 8.0, 9.0], [0.0, 1.0, 2.0]]);
    assert!(matches!(photo.source.samples, Samples::U8(_)));
    wide[0] = 1;
    let photo = read_linear(&files::raw_tiff((3, 1), 4, 3, &wide, &[0x01, 0x00]));
    assert!(matches!(photo.source.samples, Samples::U16(_)));
}

#[test]
fn transparency_is_composited_on_black_and_mentioned() {
    let rgba = |data: &[u8]| {
        read_with(
            &Png { size: (2, 1), color: Some(Rgba), bits: 8, data, ..Png::default() }.bytes(),
            &ReadOptions::default(),
        )
    };
    assert!(rgba(&[1, 2, 3, 255, 4, 5, 6, 255]).warnings.is_empty());
    let photo = rgba(&[255, 255, 255, 51, 9, 9, 9, 0]);
    assert_eq!(pixels(&photo), gray(&[51.0, 0.0]), "linear light × alpha");
    assert!(photo.warnings[0].starts_with("2 of 2 pixels are not fully opaque"), "{:?}", photo.warnings);
    let photo = read_linear(&files::webp((1, 1), Rgba8, &[200, 100, 50, 102]));
    assert_eq!(pixels(&photo), [[200.0f32 * 0.4, 100.0 * 0.4, 50.0 * 0.4]]);

    // Colors with associated alpha are already composited with black.
    let straight = files::tiff::<colortype::RGB8>(
        (1, 1),
        &[100, 50, 25, 51],
        &[ExtraSamples::UnassociatedAlpha],
        &[],
        None,
    );
    assert_eq!(pixels(&read_linear(&straight)), [[20.0, 10.0, 5.0]]);
    let multiplied = files::tiff::<colortype::RGB8>(
        (1, 1),
        &[100, 50, 25, 51],
        &[ExtraSamples::AssociatedAlpha],
        &[],
        None,
    );
    assert_eq!(pixels(&read_linear(&multiplied)), [[100.0, 50.0, 25.0]]);
}

#[test]
fn pnm_keeps_its_own_maximum() {
    assert_eq!(pixels(&read_linear(b"P1\n2 1\n1 0\n")), gray(&[0.0, 255.0]));
    assert_eq!(pixels(&read_linear(b"P4\n2 1\n\x80")), gray(&[0.0, 255.0]));
    assert_eq!(pixels(&read_linear(b"P2\n# a comment\n2 1 100\n100 20\n")), gray(&[255.0, 51.0]));
    assert_eq!(pixels(&read_linear(b"P3\n1 1\n15\n15 1 0\n")), [[255.0, 17.0, 0.0]]);
    assert_eq!(pixels(&read_linear(b"P5\n1 1\n255\n\x25")), gray(&[37.0]));
    assert_eq!(pixels(&read_linear(b"P5\n2 1\n1023\n\x03\xff\x00\x00")), gray(&[255.0, 0.0]));
    assert_eq!(pixels(&read_linear(b"P6\n1 1\n65535\n\x01\x01\x02\x02\xff\xff")), [[1.0, 2.0, 255.0]]);
    let pam = b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 4\nMAXVAL 100\nTUPLTYPE RGB_ALPHA\nENDHDR\n\x64\x14\x00\x64";
    assert_eq!(pixels(&read_linear(pam)), [[255.0, 51.0, 0.0]]);
    let pam = b"P7\nWIDTH 2\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE BLACKANDWHITE\nENDHDR\n\x01\x00";
    assert_eq!(pixels(&read_linear(pam)), gray(&[255.0, 0.0]));
    assert_eq!(pixels(&read_linear(b"P5\n1 1\n100\n\xC8")), gray(&[255.0]), "above its own maximum");
}

#[test]
fn every_sample_of_a_pnm_is_kept() {
    for max in [1u16, 2, 3, 100, 254, 255, 256, 1023, 4095, 40000, 65534, 65535] {
        let wide = max > 255;
        let mut bytes = format!("P5\n{} 1\n{max}\n", u32::from(max) + 1).into_bytes();
        bytes.extend((0..=max).flat_map(|v| if wide { v.to_be_bytes().to_vec() } else { vec![v as u8] }));
        let photo = read_linear(&bytes);
        assert_eq!(photo.source.max, Some(u32::from(max)));
        match photo.source.samples {
            Samples::U8(samples) => assert!(samples.iter().copied().eq(0..=max as u8), "{max}"),
            Samples::U16(samples) => assert!(samples.iter().copied().eq(0..=max), "{max}"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn bmp_webp_and_jpeg() {
    assert_eq!(
        pixels(&read_linear(&files::bmp((2, 1), Rgb8, &[1, 2, 3, 4, 5, 6]))),
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    );
    assert_eq!(pixels(&read_linear(&files::bmp((2, 1), L8, &[7, 9]))), gray(&[7.0, 9.0]));
    assert_eq!(
        pixels(&read_linear(&files::webp((1, 2), Rgb8, &[1, 2, 3, 4, 5, 6]))),
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    );
    let photo = read_linear(&files::jpeg((8, 8), L8, &[128; 64], None));
    assert_eq!(photo.source.layout, Layout::Gray);
    assert_eq!(pixels(&photo), gray(&[128.0; 64]));
    let photo = read_linear(&files::jpeg((8, 8), Rgb8, &[90; 192], None));
    assert_eq!(photo.source.layout, Layout::Rgb);
    assert!(pixels(&photo).iter().flatten().all(|c| (c - 90.0).abs() <= 1.0));
}

#[test]
fn tiff_of_every_depth() {
    let size = (2, 1);
    let alpha = [ExtraSamples::UnassociatedAlpha];
    assert_eq!(
        pixels(&read_linear(&files::raw_tiff((3, 2), 1, 1, &[], &[0b1010_0000, 0b0100_0000]))),
        gray(&[255.0, 0.0, 255.0, 0.0, 255.0, 0.0])
    );
    assert_eq!(pixels(&read_linear(&files::raw_tiff((2, 1), 4, 1, &[], &[0x1F]))), gray(&[17.0, 255.0]));
    assert_eq!(
        pixels(&read_linear(&files::raw_tiff((2, 1), 8, 0, &[], &[255, 5]))),
        gray(&[0.0, 250.0]),
        "white is zero"
    );
    let gray8 = files::tiff::<colortype::Gray8>(size, &[7, 9], &[], &[], None);
    assert_eq!(pixels(&read_linear(&gray8)), gray(&[7.0, 9.0]));
    let gray_alpha = files::tiff::<colortype::Gray8>(size, &[7, 255, 10, 51], &alpha, &[], None);
    assert_eq!(pixels(&read_linear(&gray_alpha)), gray(&[7.0, 2.0]));
    let gray16 = files::tiff::<colortype::Gray16>(size, &[257, 65535], &[], &[], None);
    assert_eq!(pixels(&read_linear(&gray16)), gray(&[1.0, 255.0]));
    let gray32 = files::tiff::<colortype::Gray32>(size, &[u32::MAX / 255, u32::MAX], &[], &[], None);
    assert_eq!(pixels(&read_linear(&gray32)), gray(&[1.0, 255.0]));
    let rgb16 = files::tiff::<colortype::RGB16>(size, &[0, 257, 514, 65535, 0, 0], &[], &[], None);
    assert_eq!(pixels(&read_linear(&rgb16)), [[0.0, 1.0, 2.0], [255.0, 0.0, 0.0]]);
    let unspecified = [ExtraSamples::Unspecified];
    let with_depth_map = files::tiff::<colortype::RGB8>((1, 1), &[1, 2, 3, 0], &unspecified, &[], None);
    assert_eq!(pixels(&read_linear(&with_depth_map)), [[1.0, 2.0, 3.0]], "no alpha: left out");
}

#[test]
fn floats_are_linear_and_know_no_saturation() {
    let default = ReadOptions::default();
    let tiff = files::tiff::<colortype::RGB32Float>((2, 1), &[0.0, 0.5, 1.0, 2.0, -1.0, 0.0], &[], &[], None);
    let photo = read_with(&tiff, &default);
    assert_eq!(pixels(&photo), [[0.0, 127.5, 255.0], [0.0; 3]]);
    assert_eq!(photo.image.saturation, None);
    assert_eq!(photo.image.invalid.as_slice(), [false, true]);
    assert!(photo.warnings[0].starts_with("1 of 2 pixels"), "{:?}", photo.warnings);
    let tiff = files::tiff::<colortype::Gray64Float>((2, 1), &[0.5, f64::NAN], &[], &[], None);
    assert_eq!(pixels(&read_with(&tiff, &default)), gray(&[127.5, 0.0]));

    let half = |values: [f32; 2]| FlatSamples::F16(values.map(f16::from_f32).to_vec());
    let exr = files::exr(
        (2, 1),
        &[("R", half([1.0, 0.0])), ("G", half([0.5, 4.0])), ("B", half([0.25, f32::INFINITY]))],
    );
    let photo = read_with(&exr, &default);
    assert_eq!(pixels(&photo), [[255.0, 127.5, 63.75], [0.0; 3]]);
    assert_eq!(photo.encoding.to_string(), "linear (OpenEXR is linear light)");
    let float = |values: [f32; 2]| FlatSamples::F32(values.to_vec());
    let exr = files::exr((2, 1), &[("Y", float([1.0, 0.2]))]);
    assert_eq!(pixels(&read_with(&exr, &default)), gray(&[255.0, 51.0]));
    let exr = files::exr((2, 1), &[("Y", float([1.0, 0.2])), ("A", float([1.0, 0.5]))]);
    let photo = read_with(&exr, &default);
    assert_eq!(pixels(&photo), gray(&[255.0, 51.0]), "OpenEXR is multiplied by alpha already");
    assert!(photo.warnings[0].contains("opaque"));
    let exr = files::exr((2, 1), &[("depth", float([1.0, 0.2]))]);
    let message = decode(&exr, "d.exr", &default).unwrap_err().to_string();
    assert!(message.contains("the channels depth"), "{message}");

    let (red, green) = (float([1e30, 1.0]), float([1.0, f32::INFINITY]));
    let exr = files::exr((2, 1), &[("R", red), ("G", green), ("B", float([0.5, 1.0]))]);
    let photo = read_with(&exr, &default);
    assert_eq!(photo.image.invalid.as_slice(), [true, true]);
    assert_eq!(
        photo.warnings,
        [
            "1 of 2 pixels have values up to 1.0e30 times full scale, which no light has: they are left out",
            "1 of 2 pixels have values that are negative or not finite: they are left out",
        ]
    );

    let photo = read_with(&files::hdr((2, 1), &[[1.0, 0.5, 0.0], [16.0, 2.0, 0.0]]), &default);
    assert_eq!(pixels(&photo), [[255.0, 127.5, 0.0], [16.0 * 255.0, 510.0, 0.0]]);
    let rgbe = b"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x00\x81";
    assert_eq!(pixels(&read_with(rgbe, &default)), [[255.0, 127.5, 0.0]]);
}

#[test]
fn the_user_can_choose_the_full_scale() {
    let options = ReadOptions { full_scale: Some(2040.0), ..crate::linear() };
    let photo = read_with(
        &Png { size: (1, 1), color: Some(Grayscale), bits: 16, data: &[255; 2], ..Png::default() }.bytes(),
        &options,
    );
    assert_eq!(
        (pixels(&photo)[0], photo.image.saturation, photo.full_scale),
        ([2040.0; 3], Some(2040.0), 2040.0)
    );
    let photo = read_with(&files::hdr((1, 1), &[[1.0, 0.5, 0.0]]), &options);
    assert_eq!(pixels(&photo), [[2040.0, 1020.0, 0.0]]);
}

#[test]
fn pictures_are_turned_upright() {
    let (stored, upright) = ([1, 2, 3, 4, 5, 6], gray(&[5.0, 3.0, 1.0, 6.0, 4.0, 2.0]));
    let check = |bytes: &[u8]| {
        let photo = read_linear(bytes);
        assert_eq!((photo.image.width(), photo.image.height()), (3, 2));
        assert_eq!(pixels(&photo), upright);
    };
    check(&files::tiff::<colortype::Gray8>((2, 3), &stored, &[], &[(274, 6)], None));
    let exif = files::exif(6);
    check(
        &Png {
            size: (2, 3),
            color: Some(Grayscale),
            bits: 8,
            data: &stored,
            exif: Some(&exif),
            ..Png::default()
        }
        .bytes(),
    );

    let mut data = [0; 8 * 16];
    data[8 * 8..].fill(255);
    let mut jpeg = files::jpeg((8, 16), L8, &data, None);
    let mut segment = vec![0xFF, 0xE1];
    segment.extend_from_slice(&(exif.len() as u16 + 8).to_be_bytes());
    segment.extend_from_slice(b"Exif\0\0");
    segment.extend_from_slice(&exif);
    jpeg.splice(2..2, segment);
    let photo = read_linear(&jpeg);
    assert_eq!((photo.image.width(), photo.image.height()), (16, 8));
    assert_eq!((pixels(&photo)[0], pixels(&photo)[15]), ([255.0; 3], [0.0; 3]));
}

#[test]
fn a_wrong_extension_opens_with_a_warning() {
    let photo = decode(&files::bmp((1, 1), L8, &[7]), "some/photo.JPG", &crate::linear()).unwrap();
    assert_eq!(pixels(&photo), gray(&[7.0]));
    assert!(photo.warnings[0].contains(".jpg") && photo.warnings[0].contains("BMP"), "{:?}", photo.warnings);
}

#[test]
fn the_number_of_threads_does_not_show() {
    let data: Vec<u8> = (0..200 * 301 * 4u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let bytes = Png { size: (200, 301), color: Some(Rgba), bits: 8, data: &data, ..Png::default() }.bytes();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| read_with(&bytes, &ReadOptions::default()))
    };
    assert_eq!(with(1), with(5));
}
