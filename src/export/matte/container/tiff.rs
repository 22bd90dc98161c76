//! Encodes samples as TIFF.

use crate::photo::{AlphaKind, Density, DensityUnit, Layout, Samples, Source, ToneCurve};
use std::io::{Cursor, Seek, Write};
use tiff::TiffResult;
use tiff::encoder::{Rational, TiffEncoder, TiffValue, colortype};
use tiff::tags::{ExtraSamples, ResolutionUnit, Tag};

/// What the file says besides its samples.
pub(super) struct Fields<'a> {
    source: &'a Source,
    alpha: Option<ExtraSamples>,
    icc: Option<&'a [u8]>,
    /// Whether the tone curves of the source apply to the samples that are written.
    keeps_curves: bool,
}

impl<'a> Fields<'a> {
    /// The fields for a picture of a layout; `icc`: the profile that fits the picture.
    pub(super) fn of(source: &'a Source, layout: Layout, icc: Option<&'a [u8]>) -> Self {
        let alpha = layout.has_alpha().then_some(match source.alpha {
            AlphaKind::Straight => ExtraSamples::UnassociatedAlpha,
            AlphaKind::Associated => ExtraSamples::AssociatedAlpha,
        });
        let keeps_curves = source.max == source.samples.type_max() && source.layout == layout;
        Self { source, alpha, icc, keeps_curves }
    }

    fn write<W: Write + Seek, C: colortype::ColorType, K: tiff::encoder::TiffKind>(
        &self,
        image: &mut tiff::encoder::ImageEncoder<'_, W, C, K>,
    ) -> TiffResult<()> {
        if let Some(alpha) = self.alpha {
            image.extra_samples(&[alpha])?;
        }
        if let Some(density) = self.source.density {
            let (unit, axes) = tiff_density(density);
            image.resolution_unit(unit);
            image.x_resolution(axes[0].clone());
            image.y_resolution(axes[1].clone());
        }
        let encoder = image.encoder();
        if let Some(profile) = self.icc {
            encoder.write_tag(Tag::IccProfile, profile)?;
        }
        let color = &self.source.tiff_color;
        for (tag, fractions) in [(318, &color.white_point), (319, &color.primaries)] {
            if !fractions.is_empty() {
                let fractions: Vec<Rational> = fractions.iter().map(|&(n, d)| Rational { n, d }).collect();
                encoder.write_tag(Tag::from_u16_exhaustive(tag), &fractions[..])?;
            }
        }
        if let Some(curves) = self.source.transfer.as_ref().filter(|_| self.keeps_curves) {
            let tables = curves.iter().filter_map(|curve| match curve {
                ToneCurve::Table(values) => Some(&values[..]),
                _ => None,
            });
            let tables: Vec<&[u16]> = tables.take(if self.source.layout.is_gray() { 1 } else { 3 }).collect();
            encoder.write_tag(Tag::from_u16_exhaustive(301), &tables.concat()[..])?;
        }
        Ok(())
    }
}

/// Unit and numbers of pixels per unit.
fn tiff_density(density: Density) -> (ResolutionUnit, [Rational; 2]) {
    let exact = density.axes.map(|(n, d)| Rational { n, d });
    match density.unit {
        DensityUnit::Ratio => (ResolutionUnit::None, exact),
        DensityUnit::Inch => (ResolutionUnit::Inch, exact),
        DensityUnit::Centimeter => (ResolutionUnit::Centimeter, exact),
        DensityUnit::Meter => {
            let hundredths = density.per_unit().map(|pixels| Rational { n: pixels.round() as u32, d: 100 });
            (ResolutionUnit::Centimeter, hundredths)
        }
    }
}

/// The bytes of a TIFF. Samples from 0 to the maximum of the source are scaled to the range of their type.
pub(super) fn encode(
    size: (u32, u32),
    layout: Layout,
    samples: Samples,
    fields: &Fields,
) -> TiffResult<Vec<u8>> {
    let max = fields.source.max.unwrap_or(1);
    let spread = |sample: u32, full: u32| {
        let (sample, full, max) = (u64::from(sample.min(max)), u64::from(full), u64::from(max));
        ((sample * full + max / 2) / max) as u32
    };
    match (samples, layout.is_gray()) {
        (Samples::U8(samples), gray) => {
            let samples: Vec<u8> = samples.into_iter().map(|v| spread(v.into(), 255) as u8).collect();
            if gray {
                encode_as::<colortype::Gray8>(size, &samples, fields)
            } else {
                encode_as::<colortype::RGB8>(size, &samples, fields)
            }
        }
        (Samples::U16(samples), gray) => {
            let samples: Vec<u16> = samples.into_iter().map(|v| spread(v.into(), 65535) as u16).collect();
            if gray {
                encode_as::<colortype::Gray16>(size, &samples, fields)
            } else {
                encode_as::<colortype::RGB16>(size, &samples, fields)
            }
        }
        (Samples::U32(samples), gray) => {
            let samples: Vec<u32> = samples.into_iter().map(|v| spread(v, u32::MAX)).collect();
            if gray {
                encode_as::<colortype::Gray32>(size, &samples, fields)
            } else {
                encode_as::<colortype::RGB32>(size, &samples, fields)
            }
        }
        (Samples::F32(v), true) => encode_as::<colortype::Gray32Float>(size, &v, fields),
        (Samples::F32(v), false) => encode_as::<colortype::RGB32Float>(size, &v, fields),
    }
}

fn encode_as<C: colortype::ColorType>(
    (width, height): (u32, u32),
    samples: &[C::Inner],
    fields: &Fields,
) -> TiffResult<Vec<u8>>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes)?;
    let mut image = encoder.new_image::<C>(width, height)?;
    fields.write(&mut image)?;
    image.write_data(samples)?;
    Ok(bytes.into_inner())
}
