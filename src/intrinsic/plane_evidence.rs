//! The evidence that what the plane of a region takes for surface reflection is a highlight (refinement `plane_evidence`, beyond the
//! paper).
//!
//! In a photograph that was compressed or demosaiced a plane fits where its pixels lie within 3 σ, and many colors do: gray hair, a
//! gray wall and skin lie in one plane with black, and the hair is taken for skin under an even highlight. Texture finds no such
//! region, as the colors do not vary from pixel to pixel. The observations of the local split (`local/evidence`) tell highlights
//! from white print without any plane. They are made in the picture with the bands that were restored by hue. Their mean
//! probability of a highlight, weighted by the square of the surface reflection of the plane, is near 1 on highlights. Where the
//! mean is below .3 the model does not fit the region, and the local split takes its pixels.
//!
//! Pictures without such errors are not tested: there a fit within 1.5 σ is the better evidence, and metal would lose its plane. The
//! exceptions are regions with a doubtful plane, which fit where the mean probability is at least .8. One kind has a small misfit: the
//! mean of several pixels has so little noise that errors of the model itself (inter-reflection, a light that is not one color)
//! exceed 1.5 σ at one count. A cup in a scene of 1536 × 1440 pixels: 17.8 → 37.7 dB. The other kind has a light whose interval exceeds two
//! fifths of the angle between body and surface vector. The plane of white paper, 5° from the light, turns whatever is whiter than the
//! paper into highlight: a white blade became gray, and the paper got blocks of windows, where another cut of the photograph moved the
//! light by some degrees (15.9 dB between both results, now 35.6). In 22 photographs three regions are rejected, one of white foil (new
//! edges on 6.8 → 1.8 % of the border of the split) and two of a bottle (2.5 → 2.0 %). Of 37 rendered scenes one loses more than .05 dB:
//! hard_limits 21.0 → 20.7 dB (doing nothing: 16.8).
//!
//! Measured on 82 rendered scenes at JPEG 92: the mean is below .3 for 3 regions, whose planes gained −1.1, .2 and .4 dB against
//! doing nothing; body of other kinds than plain objects 32.78 → 33.00 dB (doing nothing: 23.9), all else unchanged; demosaiced
//! with JPEG 92 32.39 → 32.38 dB. In 20 photographs the mean is below .3 for 4 of 10 regions; share of border pixels of the
//! split with a new edge 2.1 → 1.2 %, of a portrait 17.6 → 0 %.

use super::images::Images;
use super::local::{Lamps, Observations, Regions};
use super::region_plan::RegionPlan;
use crate::raster::RegionId;
use crate::segment::{AnalysisInput, Pixels};
use rayon::prelude::*;

/// Fewest pixels with surface reflection that are judged.
const LEAST_PIXELS: usize = 20;

/// Measures the evidence of each region that the model fits, and rejects the regions with too little. `observed`: the picture with the
/// bands that were restored by hue, in which highlights are observed. Returns the observations, which the local split needs as well; none
/// where no region was tested.
pub(super) fn reject_regions_without_evidence<'a>(
    input: &AnalysisInput,
    observed: &AnalysisInput,
    lamps: Option<&Lamps>,
    regions: &Regions<'a>,
    images: &Images,
    plans: &mut [RegionPlan],
) -> Option<Observations<'a>> {
    let refine = input.refine;
    if !refine.region_holds || input.is_marked() {
        return None;
    }
    let is_judged = refine.plane_evidence && refine.local_split;
    let is_doubtful = |plan: &RegionPlan| {
        plan.fit.has_small_misfit() || (is_judged && (input.extended || plan.fit.has_doubtful_light()))
    };
    let is_tested = |plan: &RegionPlan| plan.model_fits() && plan.transform().is_some() && is_doubtful(plan);
    if !plans.iter().any(is_tested) {
        return None;
    }
    let observations = observations(observed, lamps, regions);
    let tested = plans.par_iter_mut().enumerate().filter(|(_, plan)| is_tested(plan));
    tested.for_each(|(index, plan)| {
        let pixels = regions.members.region(RegionId::from_index(index));
        let measured = observations
            .as_ref()
            .and_then(|observations| mean_probability(input, observations, images, pixels));
        // Where nothing tells of highlights, a small misfit counts against the region.
        plan.fit.highlights = measured.or(plan.fit.has_small_misfit().then_some(0.0));
        plan.judge_again();
    });
    observations
}

/// The observations around all lit pixels; none without the refinements that they belong to, and where no light is known.
fn observations<'a>(
    input: &AnalysisInput,
    lamps: Option<&Lamps>,
    regions: &Regions<'a>,
) -> Option<Observations<'a>> {
    let refine = input.refine;
    let lamps = lamps.filter(|_| refine.plane_evidence && refine.local_split)?;
    Observations::around(input, lamps, regions, |pixel| !input.masks.dark(pixel))
}

/// The mean probability of a highlight in the undistorted pixels of a region with surface reflection, weighted by the square of the
/// surface reflection; none for fewer than [`LEAST_PIXELS`] pixels, and without refinement `highlight_evidence`.
fn mean_probability(
    input: &AnalysisInput,
    observations: &Observations,
    images: &Images,
    pixels: Pixels,
) -> Option<f64> {
    let evidence = observations.evidence.as_ref()?;
    let (mut sum, mut total, mut count) = (0.0f64, 0.0f64, 0usize);
    for pixel in pixels.iter().map(|pixel| pixel as usize) {
        let surface = f64::from(images.surface[pixel].iter().sum::<f32>()) / 3.0;
        let index = observations.map.roi.index(pixel).filter(|_| surface > 0.0 && input.masks.usable(pixel));
        let Some(index) = index else { continue };
        let probability = 1.0 / (1.0 + f64::from(-evidence.log_odds[index]).exp());
        sum += surface * surface * probability;
        total += surface * surface;
        count += 1;
    }
    (count >= LEAST_PIXELS).then(|| sum / total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Vec3, rgb};
    use crate::raster::{LabelMap, Raster};
    use crate::segment::Members;
    use crate::segment::testing::Drawing;
    use crate::trace::PixelKind;

    const SIDE_PX: usize = 96;

    fn light() -> Vec3 {
        Vec3::repeat(1.0).normalize()
    }

    /// Surface reflection at (x, y), counts: a highlight at (24, 40) on the left half, an even amount on the right half.
    fn surface(x: f64, y: f64) -> Vec3 {
        let highlight = 130.0 * (-((x - 24.0).powi(2) + (y - 40.0).powi(2)) / 60.0).exp();
        light() * if x < 48.0 { highlight } else { 50.0 }
    }

    /// The mean probabilities of a highlight in the left half, skin, and in the right half, gray hair in the same plane.
    fn probabilities(highlight_evidence: bool) -> [Option<f64>; 2] {
        let body = |x: f64, y: f64| {
            let shading = if x < 48.0 { 110.0 + 0.3 * y } else { 40.0 + 0.1 * y + (x / 3.0).sin() };
            Vec3::new(0.75, 0.4, 0.25) * shading
        };
        let mut drawing = Drawing::by_place(SIDE_PX, |x, y| body(x, y) + surface(x, y));
        drawing.refine.highlight_evidence = highlight_evidence;
        let input = drawing.input();
        let place = |pixel: usize| ((pixel % SIDE_PX) as f64, (pixel / SIDE_PX) as f64);
        let surface = (0..SIDE_PX * SIDE_PX).map(|pixel| rgb(&surface(place(pixel).0, place(pixel).1)));
        let surface = Raster::from_vec(SIDE_PX, SIDE_PX, surface.collect()).unwrap();
        let images = Images {
            body: input.pixels.clone(),
            surface,
            noise: Raster::filled(SIDE_PX, SIDE_PX, 0.0),
            kinds: Raster::filled(SIDE_PX, SIDE_PX, PixelKind::Matte),
        };
        let labels = (0..SIDE_PX * SIDE_PX).map(|pixel| if pixel % SIDE_PX < 48 { 1 } else { 2 });
        let labels = LabelMap::from_vec(SIDE_PX, SIDE_PX, labels.collect()).unwrap();
        let members = Members::of(&labels, 2);
        let regions = Regions { labels: &labels, members: &members, matte: &[] };
        let lamps = Lamps::one(&light()).unwrap();
        let observations = Observations::around(&input, &lamps, &regions, |_| true).unwrap();
        [1u16, 2].map(|id| mean_probability(&input, &observations, &images, members.region(id)))
    }

    #[test]
    fn a_highlight_is_probable_and_a_gray_material_in_the_same_plane_is_not() {
        let [skin, hair] = probabilities(true).map(Option::unwrap);
        assert!(skin > 0.8 && hair < 0.3, "{skin} and {hair}");
        assert_eq!(probabilities(false), [None, None], "nothing is measured without the observations");
    }
}
