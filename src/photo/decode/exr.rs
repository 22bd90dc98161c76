//! Decoder of `OpenEXR`: reads the first layer with R, G and B, or else the first with Y. Half, float and integer
//! channels are converted to 32-bit floats.

use super::{Budget, Decoded};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{AlphaKind, Density, Layout, Samples, TiffColor};
use exr::image::read::specific_channels::ReadSpecificChannel as _;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, Chromaticities};
use exr::meta::header::Header;
use exr::prelude::{ReadChannels as _, ReadLayers as _, read};
use std::io::Cursor;

type Chunks<'a> = exr::block::reader::Reader<Cursor<&'a [u8]>>;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let chunks = exr::block::read(Cursor::new(bytes), false)?;
    for header in chunks.headers() {
        budget.admit(header.layer_size.x(), header.layer_size.y())?;
    }
    let flat = |header: &&Header| !header.deep;
    let layer = |wanted: &[&str]| {
        chunks.headers().iter().filter(flat).find(|header| wanted.iter().all(|name| has(header, name)))
    };
    let (header, gray) = match (layer(&["R", "G", "B"]), layer(&["Y"])) {
        (Some(header), _) => (header, false),
        (None, Some(header)) if !has(header, "RY") => (header, true),
        _ => {
            let hint = "export its picture as one flat layer with channels R, G and B, or Y";
            return Err(Fault::unsupported(channel_names(chunks.headers()), hint));
        }
    };
    let size = (header.layer_size.x(), header.layer_size.y());
    let with_alpha = has(header, "A");
    let picture: Vec<_> = header.channels.list.iter().filter(|channel| is_read(channel, gray)).collect();
    if picture.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(Fault::unsupported("channels with fewer samples than pixels", CONVERT));
    }
    let mut warnings = Vec::new();
    if header.channels.list.len() > picture.len() {
        let (all, names) = (header.channels.list.len(), if gray { "Y" } else { "R, G and B" });
        warnings.push(format!(
            "the OpenEXR file holds {all} channels: only {names} are read, and A where present"
        ));
    }
    let color = TiffColor::of_chromaticities(header.shared_attributes.chromaticities);
    let density = Density::of_pixel_aspect(header.shared_attributes.pixel_aspect);
    if chunks.headers().len() > 1 {
        let layers = chunks.headers().len();
        warnings
            .push(format!("the OpenEXR file holds {layers} layers: only the first with a picture is read"));
    }
    if header.shared_attributes.display_window.size != header.layer_size {
        warnings
            .push("the OpenEXR file's data window differs from its display window: the data are read".into());
    }
    let (layout, data) = match (gray, with_alpha) {
        (false, false) => (Layout::Rgb, rgb(chunks)?),
        (false, true) => (Layout::Rgba, rgba(chunks)?),
        (true, false) => (Layout::Gray, luminance(chunks)?),
        (true, true) => (Layout::GrayAlpha, luminance_alpha(chunks)?),
    };
    if data.len() != size.0 * size.1 * layout.channels() {
        return Err(Fault::damaged("its pixels do not fill its size"));
    }
    // "Technical Introduction to OpenEXR", premultiplied vs. un-premultiplied: the color is multiplied by alpha.
    let alpha = AlphaKind::Associated;
    let plain = Decoded::plain(size, layout, Samples::F32(data));
    Ok(Decoded { alpha, warnings, tiff_color: color, density, ..plain })
}

/// Whether a channel is one of the picture.
fn is_read(channel: &ChannelDescription, gray: bool) -> bool {
    let names: &[&str] = if gray { &["Y", "A"] } else { &["R", "G", "B", "A"] };
    names.iter().any(|name| channel.name.eq(name))
}

impl TiffColor {
    /// The chromaticities of an `OpenEXR` file, in units of 1/100 000. None where a coordinate is negative, as of the imaginary
    /// primaries of ACES: the unsigned fractions of TIFF cannot hold it.
    fn of_chromaticities(points: Option<Chromaticities>) -> Self {
        let Some(Chromaticities { red, green, blue, white }) = points else { return Self::default() };
        let points = [white, red, green, blue];
        if points.iter().any(|point| !(point.x() >= 0.0 && point.y() >= 0.0)) {
            return Self::default();
        }
        let fraction = |value: f32| ((f64::from(value) * 1e5).round() as u32, 100_000);
        let pair = |point: Vec2<f32>| [fraction(point.x()), fraction(point.y())];
        Self { white_point: pair(white).to_vec(), primaries: [red, green, blue].map(pair).concat() }
    }
}

fn has(header: &Header, name: &str) -> bool {
    header.channels.list.iter().any(|channel| channel.name.eq(name))
}

fn channel_names(headers: &[Header]) -> String {
    let mut names: Vec<String> =
        headers.iter().flat_map(|h| &h.channels.list).take(9).map(|c| c.name.to_string()).collect();
    if names.len() == 9 {
        names[8] = "\u{2026}".into();
    }
    format!("the channels {}", names.join(", "))
}

/// Samples of one layer, which the `exr` crate delivers in any order of the pixels.
struct Pixels {
    width: usize,
    data: Vec<f32>,
}

impl Pixels {
    fn new(size: Vec2<usize>, channels: usize) -> Self {
        Self { width: size.x(), data: vec![0.0; size.area() * channels] }
    }

    fn set<const CHANNELS: usize>(&mut self, position: Vec2<usize>, pixel: [f32; CHANNELS]) {
        let first = (position.y() * self.width + position.x()) * CHANNELS;
        self.data[first..first + CHANNELS].copy_from_slice(&pixel);
    }
}

/// One reader per set of channels, because the `exr` crate needs the number of channels at compile time.
macro_rules! channel_reader {
    ($name:ident, $count:literal, [$($channel:literal),+], $pixel:pat => $values:expr, $tuple:ty) => {
        fn $name(chunks: Chunks) -> Result<Vec<f32>, Fault> {
            let image = read()
                .no_deep_data()
                .largest_resolution_level()
                .specific_channels()
                $(.required($channel))+
                .collect_pixels(
                    |size, _channels| Pixels::new(size, $count),
                    |pixels: &mut Pixels, position, $pixel: $tuple| pixels.set(position, $values),
                )
                .first_valid_layer()
                .all_attributes()
                .from_chunks(chunks)?;
            Ok(image.layer_data.channel_data.pixels.data)
        }
    };
}

channel_reader!(rgb, 3, ["R", "G", "B"], (r, g, b) => [r, g, b], (f32, f32, f32));
channel_reader!(rgba, 4, ["R", "G", "B", "A"], (r, g, b, a) => [r, g, b, a], (f32, f32, f32, f32));
channel_reader!(luminance, 1, ["Y"], (y,) => [y], (f32,));
channel_reader!(luminance_alpha, 2, ["Y", "A"], (y, a) => [y, a], (f32, f32));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chromaticities_that_fractions_of_tiff_cannot_hold_are_left_out() {
        let of_blue = |blue| {
            let [red, green, white] = [Vec2(0.64, 0.33), Vec2(0.3, 0.6), Vec2(0.3127, 0.329)];
            TiffColor::of_chromaticities(Some(Chromaticities { red, green, blue, white }))
        };
        let ordinary = of_blue(Vec2(0.15, 0.06));
        assert_eq!((ordinary.white_point[0], ordinary.primaries[5]), ((31_270, 100_000), (6_000, 100_000)));
        for imaginary in [Vec2(0.0001, -0.077), Vec2(f32::NAN, 0.06)] {
            assert_eq!(of_blue(imaginary), TiffColor::default());
        }
    }
}
