//! Which information about the tone curve takes precedence.

use crate::files::{self, Png, curv, icc, para, rgb_icc};
use crate::{pixels, read_with};
use dichroscope::photo::{EncodingChoice, Photo, ReadOptions, ToneCurve};
use image::ExtendedColorType::{L8, Rgb8};
use tiff::encoder::colortype;

fn auto(bytes: &[u8]) -> Photo {
    read_with(bytes, &ReadOptions::default())
}

/// A PNG of one mid-gray pixel with these color chunks.
fn tagged(chunks: &[([u8; 4], &[u8])], icc: Option<&[u8]>) -> Photo {
    auto(&Png { size: (1, 1), bits: 8, data: &[128; 3], chunks, icc, ..Png::default() }.bytes())
}

fn srgb(code: f64) -> f32 {
    (255.0 * ((code / 255.0 + 0.055) / 1.055).powf(2.4)) as f32
}

#[test]
fn a_file_that_says_nothing_is_srgb_and_the_photo_says_so() {
    let photo = tagged(&[], None);
    assert_eq!(photo.encoding.to_string(), "sRGB (assumed: the file does not say)");
    assert_eq!(pixels(&photo)[0], [srgb(128.0); 3]);
    assert!(photo.warnings.is_empty());
}

#[test]
fn the_user_overrides_the_file() {
    let bytes = Png {
        size: (1, 1),
        bits: 8,
        data: &[128; 3],
        chunks: &[(*b"gAMA", &100_000u32.to_be_bytes())],
        ..Png::default()
    }
    .bytes();
    let with = |encoding| read_with(&bytes, &ReadOptions { encoding, ..ReadOptions::default() });
    assert_eq!(pixels(&with(EncodingChoice::Srgb))[0], [srgb(128.0); 3]);
    let photo = with(EncodingChoice::Gamma(2.0));
    assert_eq!(pixels(&photo)[0], [(255.0 * (128.0f64 / 255.0).powi(2)) as f32; 3]);
    assert_eq!(photo.encoding.to_string(), "gamma 2 (as asked)");
    assert_eq!(pixels(&with(EncodingChoice::Auto))[0], [128.0; 3]);
}

#[test]
fn png_chunks_count_in_the_order_of_the_specification() {
    let gama = 100_000u32.to_be_bytes();
    let (linear, srgb_chunk, gama): (_, _, ([u8; 4], &[u8])) =
        ([1, 8, 0, 1], (*b"sRGB", &[0u8][..]), (*b"gAMA", &gama));
    let cicp: ([u8; 4], &[u8]) = (*b"cICP", &linear);
    let profile = rgb_icc(&curv(&[512]));
    assert_eq!(tagged(&[gama], None).encoding.to_string(), "linear (PNG gAMA 1.0)");
    assert_eq!(tagged(&[srgb_chunk, gama], None).encoding.to_string(), "sRGB (PNG sRGB chunk)");
    assert_eq!(tagged(&[gama], Some(&profile)).encoding.to_string(), "gamma 2 (ICC profile)");
    assert_eq!(tagged(&[gama, srgb_chunk], Some(&profile)).encoding.to_string(), "gamma 2 (ICC profile)");
    assert_eq!(
        tagged(&[cicp, gama, srgb_chunk], Some(&profile)).encoding.to_string(),
        "linear (PNG cICP transfer 8)"
    );
    let photo = tagged(&[(*b"gAMA", &45455u32.to_be_bytes())], None);
    assert_eq!(photo.encoding.to_string(), "gamma 2.2 (PNG gAMA 0.45455)");
    let unspecified: [u8; 4] = [2, 2, 0, 1];
    assert_eq!(tagged(&[(*b"cICP", &unspecified), gama], None).encoding.to_string(), "linear (PNG gAMA 1.0)");
}

#[test]
fn unsupported_color_information_is_read_as_srgb_with_a_warning() {
    let pq: [u8; 4] = [9, 16, 0, 1];
    let photo = tagged(&[(*b"cICP", &pq)], None);
    assert_eq!(photo.encoding.curves[0], ToneCurve::Srgb);
    assert!(
        photo.warnings[0].contains("PQ") && photo.warnings[0].contains("--encoding"),
        "{:?}",
        photo.warnings
    );
    let empty = icc(*b"RGB ", &[]);
    let table = icc(*b"RGB ", &[(*b"A2B0", files::mft1())]);
    for (profile, word) in [
        (&b"no profile"[..], "broken"),
        (&empty, "no tone curves"),
        (&table, "lookup table"),
        (&rgb_icc(&curv(&[65535, 0])), "cannot be undone"),
        (&rgb_icc(b"oops\0\0\0\0\0\0\0\0"), "broken"),
    ] {
        let photo = tagged(&[], Some(profile));
        assert_eq!(pixels(&photo)[0], [srgb(128.0); 3]);
        assert!(photo.warnings[0].contains(word), "{:?}", photo.warnings);
    }
}

#[test]
fn icc_curves_of_every_kind() {
    let x = 128.0 / 255.0;
    let check = |curve: &[u8], expected: f64| {
        let photo = tagged(&[], Some(&rgb_icc(curve)));
        let found = f64::from(pixels(&photo)[0][1]);
        // The curve's parameters are rounded to multiples of 1/65536.
        assert!((found - 255.0 * expected).abs() < 1e-2, "{}: {found}", photo.encoding);
        assert!(photo.warnings.is_empty(), "{:?}", photo.warnings);
    };
    check(&curv(&[]), x);
    check(&curv(&[256]), x);
    check(&curv(&[0x0233]), x.powf(2.0 + 51.0 / 256.0));
    check(&curv(&[0, 13107, 65535]), 0.2 + 0.8 * (2.0 * x - 1.0));
    check(&para(0, &[2.2]), x.powf(2.2));
    check(&para(1, &[2.0, 0.9, 0.1]), (0.9 * x + 0.1).powi(2));
    check(&para(2, &[2.0, 0.8, 0.1, 0.1]), (0.8 * x + 0.1).powi(2) + 0.1);
    check(&para(3, &[2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045]), f64::from(srgb(128.0)) / 255.0);
    check(&para(4, &[2.0, 0.9, 0.05, 0.2, 0.1, 0.01, 0.0]), (0.9 * x + 0.05).powi(2) + 0.01);
}

#[test]
fn bands_may_have_curves_of_their_own() {
    let profile = icc(*b"RGB ", &[(*b"rTRC", curv(&[])), (*b"gTRC", curv(&[512])), (*b"bTRC", curv(&[768]))]);
    let x = 128.0f64 / 255.0;
    assert_eq!(
        pixels(&tagged(&[], Some(&profile)))[0],
        [128.0, (255.0 * x.powf(2.0)) as f32, (255.0 * x.powf(3.0)) as f32]
    );
}

#[test]
fn profiles_are_found_in_other_formats() {
    let linear = rgb_icc(&curv(&[]));
    let jpeg = auto(&files::jpeg((8, 8), Rgb8, &[128; 192], Some(&linear)));
    assert_eq!(jpeg.encoding.to_string(), "linear (ICC profile)");
    assert_eq!(pixels(&jpeg)[0], [128.0; 3]);
    let gray_profile = icc(*b"GRAY", &[(*b"kTRC", curv(&[]))]);
    let jpeg = auto(&files::jpeg((8, 8), L8, &[128; 64], Some(&gray_profile)));
    assert_eq!(pixels(&jpeg)[0], [128.0; 3]);
    let tiff = auto(&files::tiff::<colortype::RGB16>((1, 1), &[257, 514, 771], &[], &[], Some(&linear)));
    assert_eq!(pixels(&tiff)[0], [1.0, 2.0, 3.0]);
    assert_eq!(tiff.source.icc.as_deref(), Some(&linear[..]));
    let float = auto(&files::tiff::<colortype::Gray32Float>((1, 1), &[0.5], &[], &[], None));
    assert_eq!(float.encoding.to_string(), "linear (assumed: a float file that does not say)");
}
