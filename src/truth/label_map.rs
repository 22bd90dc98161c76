//! Label maps that other programs wrote.

use super::TruthError;
use super::pictures::{decode_labels, read_file};
use crate::raster::{LabelMap, Raster, UNASSIGNED};
use image::DynamicImage;
use std::collections::BTreeMap;
use std::path::Path;

/// Number of labels, that for no label included.
const LABELS: usize = 1 << 16;
/// Least number of labels that look like mixtures of their neighbors in a picture that was smoothed.
const LEAST_MIXTURES: usize = 8;

/// Reads a label map that was made elsewhere: integer labels of a gray picture of 8 or 16 bits, 0 for none, or a color picture in which
/// each color is a label, in the order in which they come, and black is none.
///
/// # Errors
/// When the file cannot be read or decoded, its samples are no integers, it has more colors than a label map holds, it is a JPEG, or the
/// borders of its regions were smoothed.
pub fn read_label_map(path: &Path) -> Result<LabelMap, TruthError> {
    let bytes = read_file(path)?;
    let inexact = |why| TruthError::InexactLabels { path: path.to_owned(), why };
    if image::guess_format(&bytes).is_ok_and(|format| format == image::ImageFormat::Jpeg) {
        return Err(inexact("is a JPEG, which changes the numbers of a label map"));
    }
    let picture = image::load_from_memory(&bytes)
        .map_err(|source| TruthError::Labels { path: path.to_owned(), source })?;
    if let DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) = picture {
        return Err(TruthError::LabelType {
            path: path.to_owned(),
            found: "floating-point numbers".to_owned(),
        });
    }
    let is_gray = !picture.color().has_color();
    let colors = picture.to_rgb8();
    let (labels, palette) = if is_gray || colors.pixels().all(|color| is_gray_color(color.0)) {
        let grays = (0..=u16::MAX).map(|gray| [gray; 3]).collect();
        (decode_labels(&bytes, path)?, grays)
    } else {
        labels_of_colors(&colors).ok_or_else(|| TruthError::ManyLabels { path: path.to_owned() })?
    };
    if is_smoothed(&labels, &palette) {
        return Err(inexact(
            "has smoothed borders: between its regions lie mixtures of their numbers or colors",
        ));
    }
    Ok(labels)
}

fn is_gray_color([r, g, b]: [u8; 3]) -> bool {
    r == g && g == b
}

/// The label map of a picture with one color for each label, and the color of each label; none where there are more colors than labels.
fn labels_of_colors(colors: &image::RgbImage) -> Option<(LabelMap, Vec<[u16; 3]>)> {
    let mut known: BTreeMap<[u8; 3], u16> = BTreeMap::from([([0; 3], UNASSIGNED)]);
    let mut palette = vec![[0; 3]];
    let mut labels = Vec::with_capacity(colors.as_raw().len() / 3);
    for color in colors.pixels() {
        if let Some(&label) = known.get(&color.0) {
            labels.push(label);
            continue;
        }
        let label = u16::try_from(palette.len()).ok()?;
        known.insert(color.0, label);
        palette.push(color.0.map(u16::from));
        labels.push(label);
    }
    let map = Raster::from_vec(colors.width() as usize, colors.height() as usize, labels)?;
    Some((map, palette))
}

/// Whether the borders between regions were smoothed (antialiasing, scaling): most pixels belong to labels that have a pixel inside, with
/// four neighbors of the same label, and most of the labels without one lie between two other labels in the picture and in color.
/// `palette` holds the color of each label.
fn is_smoothed(labels: &LabelMap, palette: &[[u16; 3]]) -> bool {
    let (mut has_inside, mut pixels, mut mixed) =
        (vec![false; LABELS], vec![0u32; LABELS], vec![0u32; LABELS]);
    let (width, height) = (labels.width(), labels.height());
    for y in 0..height {
        for x in 0..width {
            let at = |x: usize, y: usize| labels.get(x, y).copied();
            let here = labels.row(y)[x];
            let row = [at(x.wrapping_sub(1), y), at(x + 1, y)];
            let column = [at(x, y.wrapping_sub(1)), at(x, y + 1)];
            let label = usize::from(here);
            has_inside[label] |= row.iter().chain(&column).all(|&other| other == Some(here));
            pixels[label] += 1;
            mixed[label] += u32::from([row, column].into_iter().any(|pair| is_mixture(here, pair, palette)));
        }
    }
    let in_regions: u64 =
        (0..LABELS).filter(|&label| has_inside[label]).map(|label| u64::from(pixels[label])).sum();
    if 2 * in_regions < labels.len() as u64 {
        return false;
    }
    let outside = (1..LABELS).filter(|&label| pixels[label] > 0 && !has_inside[label]);
    let is_mixed = |label: usize| 2 * mixed[label] >= pixels[label];
    let (mixtures, others): (Vec<usize>, Vec<usize>) = outside.partition(|&label| is_mixed(label));
    mixtures.len() >= LEAST_MIXTURES && mixtures.len() > 2 * others.len()
}

/// Whether the color of a label lies between the colors of the labels at both sides.
fn is_mixture(here: u16, sides: [Option<u16>; 2], palette: &[[u16; 3]]) -> bool {
    let [Some(a), Some(b)] = sides else { return false };
    let color = |label: u16| palette.get(usize::from(label)).copied().unwrap_or_default();
    let (here_color, a_color, b_color) = (color(here), color(a), color(b));
    let between = |band: usize| {
        let (low, high) = (a_color[band].min(b_color[band]), a_color[band].max(b_color[band]));
        (low..=high).contains(&here_color[band])
    };
    here != a && here != b && (0..3).all(between)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, Luma, Rgb, RgbImage};

    fn saved(name: &str, picture: &image::DynamicImage) -> Result<LabelMap, TruthError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        picture.save(&path).unwrap();
        read_label_map(&path)
    }

    /// Disks of the grays 60, 120, …, whose borders are smoothed or not.
    fn disks(smooth: bool) -> GrayImage {
        GrayImage::from_fn(160, 40, |x, y| {
            let center = (f64::from(x / 40) * 40.0 + 20.0, 20.0);
            let inside = 12.5 - (f64::from(x) - center.0).hypot(f64::from(y) - center.1);
            let share =
                if smooth { (inside + 0.5).clamp(0.0, 1.0) } else { f64::from(u8::from(inside > 0.0)) };
            Luma([(share * f64::from(60 * (x / 40 + 1))).round() as u8])
        })
    }

    #[test]
    fn a_map_with_smoothed_borders_is_refused_and_one_without_is_read() {
        let labels = saved("labels.png", &disks(false).into()).unwrap();
        assert_eq!((labels[20 * 160 + 20], labels[20 * 160 + 60], labels[0]), (60, 120, 0));
        let error = saved("labels.png", &disks(true).into()).unwrap_err().to_string();
        assert!(error.contains("smoothed borders") && error.contains("PNG"), "{error}");
        let error = saved("labels.jpg", &disks(false).into()).unwrap_err().to_string();
        assert!(error.contains("is a JPEG"), "{error}");
    }

    #[test]
    fn a_picture_of_floats_is_no_label_map() {
        let picture = image::Rgb32FImage::from_pixel(4, 3, Rgb([1.0, 0.5, 0.0]));
        let error = saved("labels.exr", &picture.into()).unwrap_err().to_string();
        assert!(error.contains("holds floating-point numbers: expected labels as 8- or 16-bit"), "{error}");
    }

    #[test]
    fn colors_are_labels_in_the_order_in_which_they_come() {
        let colors = [[0, 0, 0], [200, 0, 0], [0, 0, 90], [200, 0, 0]];
        let picture = RgbImage::from_fn(4, 1, |x, _| Rgb(colors[x as usize]));
        assert_eq!(saved("labels.png", &picture.into()).unwrap().as_slice(), [0, 1, 2, 1]);
    }

    #[test]
    fn as_many_colors_as_labels_are_read_and_one_more_is_refused() {
        let color = |number: u32| Rgb([(number >> 16) as u8 + 1, (number >> 8) as u8, number as u8]);
        let full = RgbImage::from_fn(256, 257, |x, y| color((y * 256 + x) % 65535));
        let labels = saved("labels.png", &full.into()).unwrap();
        assert_eq!(labels.as_slice().iter().max(), Some(&u16::MAX));
        let more = RgbImage::from_fn(256, 256, |x, y| color(y * 256 + x));
        let error = saved("labels.png", &more.into()).unwrap_err().to_string();
        assert!(error.contains("more than 65535"), "{error}");
    }

    #[test]
    fn specks_and_thin_regions_are_no_smoothing() {
        // Specks of one pixel, each with a label of its own, and stripes one pixel wide in no order.
        let specks = GrayImage::from_fn(90, 30, |x, y| {
            let speck = x % 6 == 3 && y % 6 == 3;
            Luma([if speck { (10 + x / 6 + 15 * (y / 6)) as u8 } else { 1 + u8::from(x > 44) }])
        });
        assert!(saved("labels.png", &specks.into()).is_ok());
        let stripes = GrayImage::from_fn(60, 5, |x, _| Luma([(x * 37 % 251) as u8]));
        assert!(saved("labels.png", &stripes.into()).is_ok());
    }
}
