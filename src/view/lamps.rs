//! The lamp that each pixel is split with, where a second lamp lights a part of the scene (section 7.5).

use crate::analysis::Analysis;
use crate::color::{Vec3, axis_angle_deg};
use crate::intrinsic::{PixelKind, Reason, RegionReflection};
use crate::raster::{LabelMap, Mask, RegionId};

/// One of the two lamps of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lamp {
    /// The light of the scene.
    First,
    /// The second lamp.
    Second,
}

impl Lamp {
    /// The name in the readout.
    pub const fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Second => "second",
        }
    }
}

/// The lamps of the pixels of a result with two lamps.
pub struct LampOfPixels<'a> {
    analysis: &'a Analysis,
    labels: &'a LabelMap,
    /// The pixels that the second lamp lights where no region explains them.
    second_lamp_mask: &'a Mask,
    /// The lamp of each region's dichromatic plane, by [`RegionId::index`]; none without a plane.
    of_regions: Vec<Option<Lamp>>,
}

impl<'a> LampOfPixels<'a> {
    /// The lamps of the pixels of a result; none where the result has one lamp or none.
    pub fn of(analysis: &'a Analysis) -> Option<Self> {
        let light = &analysis.finals.light;
        let (first, second) = (Vec3::from(light.direction?), Vec3::from(light.second?.direction));
        let second_lamp_mask: &Mask = analysis.finals.second_lamp_mask.as_ref()?;
        let nearer = |surface: &Vec3| {
            let is_second = axis_angle_deg(surface, &second) < axis_angle_deg(surface, &first);
            if is_second { Lamp::Second } else { Lamp::First }
        };
        let hypotheses = &analysis.finals.hypotheses;
        let of_regions = hypotheses
            .iter()
            .map(|hypothesis| hypothesis.plane.map(|plane| nearer(&plane.surface)))
            .collect();
        Some(Self { analysis, labels: &analysis.finals.labels, second_lamp_mask, of_regions })
    }

    /// The lamp that a pixel is split with: that of the region that explains the pixel, else that of the surface reflection that the local
    /// split took from it. None where a pixel is not split.
    pub fn at(&self, pixel: usize) -> Option<Lamp> {
        let intrinsic = &self.analysis.intrinsic;
        let region = RegionId::from_label(self.labels[pixel]).map(RegionId::index);
        let fits =
            region.and_then(|region| intrinsic.regions.get(region)).is_some_and(RegionReflection::model_fits);
        let is_own = intrinsic.kinds[pixel] != PixelKind::Unassigned
            && intrinsic.reasons[pixel] != Reason::OtherObject;
        if fits && is_own {
            return self.of_regions.get(region?).copied().flatten();
        }
        let has_surface = intrinsic.surface[pixel].iter().any(|&band| band > 0.0);
        let lamp = if self.second_lamp_mask[pixel] { Lamp::Second } else { Lamp::First };
        has_surface.then_some(lamp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{IlluminantSetting, Params};
    use crate::view::testing::tiny_picture;

    #[test]
    fn a_pixel_has_the_lamp_of_its_regions_surface_vector_and_one_lamp_is_no_layer() {
        let image = std::sync::Arc::clone(&tiny_picture().photo.image);
        let analyze = |params: &Params| {
            crate::analysis::Session::new(std::sync::Arc::clone(&image)).run(params, &mut ()).unwrap()
        };
        let one = analyze(&Params::default());
        assert!(LampOfPixels::of(&one).is_none());
        let mut two = one.clone();
        let second_illuminant = IlluminantSetting::Given([0.2, 0.3, 1.0]);
        two.finals = analyze(&Params { second_illuminant, ..Params::default() }).finals;
        let mut finals = (*two.finals).clone();
        let second = Vec3::from(finals.light.second.unwrap().direction);
        finals.hypotheses[0].plane.as_mut().unwrap().surface = second;
        finals.second_lamp_mask = Some(std::sync::Arc::new(finals.labels.map(|_| true)));
        two.finals = std::sync::Arc::new(finals);
        let lamps = LampOfPixels::of(&two).unwrap();
        let labels = &two.finals.labels;
        let expected = |pixel: usize| match labels[pixel] {
            1 => Some(Lamp::Second),
            _ => Some(Lamp::First),
        };
        let explained = |pixel: usize| {
            let region = two.intrinsic.regions.get(usize::from(labels[pixel]).wrapping_sub(1));
            let is_own = two.intrinsic.reasons[pixel] != Reason::OtherObject;
            is_own && region.is_some_and(|region| region.model_fits() && region.surface.is_some())
        };
        let of_regions: Vec<usize> = (0..labels.len()).filter(|&pixel| explained(pixel)).collect();
        assert!(
            of_regions.iter().any(|&pixel| labels[pixel] == 1)
                && of_regions.iter().any(|&pixel| labels[pixel] > 1)
        );
        assert!(of_regions.iter().all(|&pixel| lamps.at(pixel) == expected(pixel)));
        let is_split = |pixel: usize| two.intrinsic.surface[pixel].iter().any(|&band| band > 0.0);
        let mut others = (0..labels.len()).filter(|&pixel| labels[pixel] == 0);
        assert!(others.all(|pixel| lamps.at(pixel) == is_split(pixel).then_some(Lamp::Second)));
    }
}
