//! Does the model fit a region: is the region one object with one skewed T, as section 3 assumes? (refinement `region_holds`)
//!
//! Five measures decide. The first is the root mean square distance of the pixels from the dichromatic plane. Let σ be the distance that
//! the noise and the error of the file's values explain at the region's intensity. The distance is about 1 σ on plastic and 2–16 σ
//! on prints, wood and leaves. The limit is 1.5 σ, and 3 σ where compression or demosaicing mixed the colors at the rims of
//! highlights and objects. A distance of up to 1.9 counts from a plane is no misfit, however small σ is, where the plane finds clear
//! highlights.
//!
//! The second measure is texture. A pattern of two colors lies in one plane as exactly as a highlight does (distance 1.0 σ, but the
//! body image is 13 dB worse than the input). Within a few pixels of such a pattern the surface reflection rises where the body
//! reflection falls (`segment/texture`).
//!
//! The third measure is the interval of the light as a share of the angle between body and surface vector. Where the interval is the
//! larger one, the region has the color of the light as far as is known: paper, white tiles, plastic foil. The light, whose interval is
//! known when the pixels are split, gives this measure to `intrinsic/region_plan`. Of 20 photographs two lose three regions of pale
//! paper and foil by this measure (mean share of border pixels with a new edge 2.5 → 2.1 %). Of the regions of 82 rendered scenes none
//! is lost as the scenes are, and 9 of 274 at JPEG 92: body of plain objects 39.68 dB as before, of other kinds 32.98 → 32.78 dB;
//! demosaiced with JPEG 92 32.22 → 32.39 dB (doing nothing: 23.9 dB).
//!
//! The fourth measure is taken after the pixels are split: the new edges at the border of the region (`intrinsic/border_edges`).
//! The fifth is taken in compressed and demosaiced photographs, and of doubtful planes: whether what the plane takes for surface
//! reflection looks like highlights or like print (`intrinsic/plane_evidence`).
//!
//! Measured on 25 rendered scenes of plain objects, regions that the model fits and body: 92 of 96 and 44.4 dB as the scenes are, 82 of 92 and
//! 38.1 dB at JPEG 92, 83 of 91 and 38.6 dB demosaiced (doing nothing: 22.7 dB). With σ of the noise alone: 87, 13 and 37 regions, 44.2, 36.8 and
//! 38.5 dB. Of 157 regions of printed scenes 84 instead of 79 fit; body 29.7 instead of 29.1 dB (doing nothing: 22.9 dB).

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use super::texture::Texture;
use crate::color::{Vec3, dot, rgb, vec3};
use crate::raster::LabelMap;
use crate::reflection::ReflectionTransform;
use crate::trace::{FitFigures, FitLimits};

/// Largest root mean square distance from plane or line that noise and coding explain, σ.
const MAX_RMS_SIGMAS: f64 = 1.5;
/// Root mean square distance from a plane that is no misfit, however little noise the mean of several pixels has, counts: the limit of
/// a camera with the σ0 of the paper, 2.5 counts. Of a line it is a misfit, as the split by a line moves colors onto the line.
const NO_MISFIT_COUNTS: f64 = 1.875;
/// Largest root mean square distance where the errors of neighboring pixels are alike, σ: compression and demosaicing mix the colors at the
/// rims of highlights and objects.
const MAX_RMS_SIGMAS_EXTENDED: f64 = 3.0;
/// Anticorrelation of body and surface reflection that a textured region exceeds; the slope has to exceed [`TEXTURE_SLOPE`] as well.
const TEXTURE_CORRELATION: f64 = 0.35;
/// Decrease of body reflection per increase of surface reflection that a textured region exceeds.
const TEXTURE_SLOPE: f64 = 0.35;
/// Share of new edges at its border that a region of a part of an object exceeds.
const MAX_NEW_EDGES: f64 = 0.12;
/// Light error, as a share of the angle between body and surface vector, that a region of the light's color exceeds.
const MAX_LIGHT_SHARE: f64 = 1.0;
/// Least mean probability of a highlight in the surface reflection of a region that the model fits.
const MIN_HIGHLIGHTS: f64 = 0.3;
/// The same of a region whose plane is doubtful: with a small misfit, or with a light that is hardly told from the body.
const MIN_HIGHLIGHTS_DOUBTFUL: f64 = 0.8;
/// Light error, as a share of the angle between body and surface vector, that makes the plane of a region doubtful.
const DOUBTFUL_LIGHT_SHARE: f64 = 0.4;
/// Fewest sides of a border that is judged.
const LEAST_SIDES: u32 = 24;
/// Largest number of pixels whose distance from the plane is measured, evenly chosen.
const SAMPLES: usize = 6000;

/// The plane that a region's pixels are compared with; a line where there is no surface vector.
#[derive(Clone, Copy, Debug)]
pub struct FittedPlane<'a> {
    /// A point of the plane, counts.
    pub origin: &'a Vec3,
    /// Unit vector of body reflection.
    pub body: &'a Vec3,
    /// Unit vector of surface reflection; `None`: the pixels are compared with the line along `body`.
    pub surface: Option<&'a Vec3>,
}

/// How well the reflection vectors of a region explain the region's pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RegionFit {
    /// Root mean square distance of the undistorted pixels from the plane, counts. Where there is no plane: from the line, per
    /// perpendicular axis, which compares with σ as the distance from a plane does.
    pub rms_counts: f64,
    /// What the noise and the error of the file's values explain of it (σ), counts.
    pub sigma_counts: f64,
    /// Largest `rms_counts` of a region that the model fits, σ.
    pub limit_sigmas: f64,
    /// Root mean square distance that is no misfit, counts.
    pub least_limit_counts: f64,
    /// Anticorrelation of body and surface reflection from pixel to pixel: 1 for a print, about 0 for highlights.
    pub texture: f64,
    /// Decrease of body reflection per increase of surface reflection from pixel to pixel.
    pub texture_slope: f64,
    /// Interval of the light as a share of the angle between body and surface vector; 0 where no light is known or there is
    /// no plane.
    pub light_share: f64,
    /// The edges that the split would make at the border of the region; counted after the pixels are split.
    pub new_edges: NewEdges,
    /// Mean probability of a highlight in the surface reflection of the plane, 0…1; none where it was not measured. 0 for a region
    /// with a small misfit and too little surface reflection to be judged.
    pub highlights: Option<f64>,
}

/// Whether the model fits a region, and where not, which measure decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RegionVerdict {
    /// One skewed T explains the region, or the run does not ask (refinement `region_holds`).
    #[default]
    Fits,
    /// Body and surface reflection have one color as far as the light is known.
    ColorOfLight,
    /// Body and surface reflection vary against each other from pixel to pixel.
    Texture,
    /// The pixels lie farther from the plane, without a plane from the matte line, than noise and coding explain.
    OffPlane,
    /// The split would make edges at the border of the region that the photograph does not have, as of a part of an object.
    NewEdges,
    /// What the plane takes for surface reflection looks like print or another color.
    NoHighlights,
}

impl RegionVerdict {
    /// Whether the skewed T of the region is used.
    pub fn fits(self) -> bool {
        self == Self::Fits
    }
}

/// The sides of the pixels of a region against lit pixels outside, and how many of the sides have an edge in the body image that the
/// photograph does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NewEdges {
    /// Number of the sides.
    pub sides: u32,
    /// Number of the sides with a new edge.
    pub new: u32,
}

impl NewEdges {
    /// Share of the sides with a new edge, 0…1; 0 for a border too short to be judged.
    pub fn share(self) -> f64 {
        if self.sides < LEAST_SIDES { 0.0 } else { f64::from(self.new) / f64::from(self.sides) }
    }
}

impl RegionFit {
    /// Measures how well a plane fits the pixels of region `id` in `labels`.
    pub fn new(
        input: &AnalysisInput,
        labels: &LabelMap,
        id: u16,
        pixels: Pixels,
        plane: &FittedPlane,
    ) -> Self {
        let FittedPlane { origin, body, surface } = *plane;
        let transform = surface.and_then(|surface| ReflectionTransform::new(body, surface));
        let (from, along) = (rgb(origin), rgb(body));
        let (mut squares, mut sum, mut count) = (0.0, Vec3::zeros(), 0usize);
        for pixel in pixels.sample(SAMPLES).filter(|&pixel| input.is_fitted(pixel as usize)) {
            let color = input.pixels[pixel as usize];
            let v = std::array::from_fn(|band| color[band] - from[band]);
            let distance2 = match &transform {
                Some(transform) => dot(v, transform.normal()).powi(2),
                // A line has two perpendicular axes.
                None => (dot(v, v) - dot(v, along).powi(2)).max(0.0) / 2.0,
            };
            squares += f64::from(distance2);
            sum += vec3(color);
            count += 1;
        }
        let pixel_count = count.max(1) as f64;
        let texture = transform.map_or_else(Texture::default, |transform| {
            Texture::of_region(input, labels, id, pixels, &transform)
        });
        Self {
            rms_counts: (squares / pixel_count).sqrt(),
            sigma_counts: input.fit_sigma(&(sum / pixel_count)),
            least_limit_counts: if transform.is_some() { NO_MISFIT_COUNTS } else { 0.0 },
            limit_sigmas: if input.extended { MAX_RMS_SIGMAS_EXTENDED } else { MAX_RMS_SIGMAS },
            texture: texture.anticorrelation,
            texture_slope: texture.slope,
            light_share: 0.0,
            new_edges: NewEdges::default(),
            highlights: None,
        }
    }

    /// Whether the pixels lie farther from the plane than noise and coding explain.
    pub fn poor(&self) -> bool {
        self.rms_counts > self.limit_counts()
    }

    /// Whether noise and coding alone do not explain the distance from the plane, but the distance is too small to be a misfit.
    pub fn has_small_misfit(&self) -> bool {
        self.rms_counts > self.limit_sigmas * self.sigma_counts && !self.poor()
    }

    /// Largest distance from the plane that is no misfit, counts.
    fn limit_counts(&self) -> f64 {
        (self.limit_sigmas * self.sigma_counts).max(self.least_limit_counts)
    }

    /// Whether anticorrelation and slope both exceed the limits of a texture.
    pub fn textured(&self) -> bool {
        self.texture > TEXTURE_CORRELATION && self.texture_slope > TEXTURE_SLOPE
    }

    /// Whether the split would make more new edges at the border of the region than a region of one object has.
    pub fn has_new_edges(&self) -> bool {
        self.new_edges.share() > MAX_NEW_EDGES
    }

    /// Whether the body vector lies within the interval of the light, so that body and surface reflection are one color as
    /// far as is known.
    pub fn has_color_of_light(&self) -> bool {
        self.light_share > MAX_LIGHT_SHARE
    }

    /// Whether the body vector lies so near to the light that an error of the light within its interval divides the colors of the region
    /// otherwise.
    pub fn has_doubtful_light(&self) -> bool {
        self.light_share > DOUBTFUL_LIGHT_SHARE
    }

    /// Whether what the plane takes for surface reflection has been found to look like print or another color.
    pub fn lacks_highlights(&self) -> bool {
        self.highlights.is_some_and(|highlights| highlights < self.least_highlights())
    }

    /// Least mean probability of a highlight of a region that the model fits.
    fn least_highlights(&self) -> f64 {
        let is_doubtful = self.has_small_misfit() || self.has_doubtful_light();
        if is_doubtful { MIN_HIGHLIGHTS_DOUBTFUL } else { MIN_HIGHLIGHTS }
    }

    /// The measures that decide.
    pub fn figures(&self) -> FitFigures {
        FitFigures {
            rms_counts: self.rms_counts,
            texture: self.texture,
            texture_slope: self.texture_slope,
            light_share: self.light_share,
            new_edges: self.new_edges.share(),
            highlights: self.highlights,
        }
    }

    /// Largest measures of a region that the model fits.
    pub fn limits(&self) -> FitLimits {
        FitLimits {
            rms_counts: self.limit_counts(),
            rms_sigmas: (10.0 * self.limit_counts() / self.sigma_counts.max(1e-9)).round() / 10.0,
            texture: TEXTURE_CORRELATION,
            texture_slope: TEXTURE_SLOPE,
            light_share: MAX_LIGHT_SHARE,
            new_edges: MAX_NEW_EDGES,
            highlights: self.least_highlights(),
        }
    }

    /// Whether the model fits the region: one skewed T explains the pixels.
    pub fn model_fits(&self) -> bool {
        self.verdict().fits()
    }

    /// Whether the model fits the region, and where not, the most specific of the measures beyond their limits. A print of several colors
    /// lies off its plane as well; texture is the more specific reason.
    pub fn verdict(&self) -> RegionVerdict {
        if self.has_color_of_light() {
            RegionVerdict::ColorOfLight
        } else if self.textured() {
            RegionVerdict::Texture
        } else if self.poor() {
            RegionVerdict::OffPlane
        } else if self.has_new_edges() {
            RegionVerdict::NewEdges
        } else if self.lacks_highlights() {
            RegionVerdict::NoHighlights
        } else {
            RegionVerdict::Fits
        }
    }

    /// The verdict on a region that a person has marked as one object: the distance from the plane alone decides.
    pub fn verdict_of_marked(&self) -> RegionVerdict {
        if self.poor() { RegionVerdict::OffPlane } else { RegionVerdict::Fits }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::Members;
    use crate::segment::testing::Drawing;

    /// The fit of the true reflection vectors to a picture in which `amounts` gives the body and surface reflection of each
    /// pixel.
    fn fit(amounts: impl Fn(f64, f64) -> (f64, f64)) -> RegionFit {
        let (body, surface) = (Vec3::new(0.9, 0.4, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let drawing = Drawing::by_place(40, |x, y| {
            let (b, s) = amounts(x, y);
            body * b + surface * s
        });
        let labels = LabelMap::filled(40, 40, 1);
        let members = Members::of(&labels, 1);
        let input = drawing.input();
        let plane = FittedPlane { origin: &Vec3::zeros(), body: &body, surface: Some(&surface) };
        RegionFit::new(&input, &labels, 1, members.region(1u16), &plane)
    }

    #[test]
    fn a_highlight_on_a_slope_is_no_texture() {
        let found = fit(|x, y| {
            let d2 = (x - 20.0).powi(2) + (y - 20.0).powi(2);
            (60.0 + x, 120.0 * (-d2 / 30.0).exp())
        });
        assert!(found.model_fits() && found.texture < 0.2, "{found:?}");
    }

    #[test]
    fn a_checkerboard_of_two_colors_in_one_plane_is_texture() {
        let found = fit(|x, y| {
            if (x as usize / 5 + y as usize / 5).is_multiple_of(2) { (100.0, 0.0) } else { (50.0, 60.0) }
        });
        assert!(found.textured() && !found.poor() && !found.model_fits(), "{found:?}");
        assert!((found.texture - 1.0).abs() < 0.1, "{found:?}");
        assert!((found.texture_slope - 50.0 / 60.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn the_model_fits_shading_alone() {
        let found = fit(|x, y| (60.0 + x + (y / 6.0).sin() * y, 0.0));
        assert!(found.model_fits(), "{found:?}");
    }

    #[test]
    fn the_verdict_names_the_most_specific_measure_beyond_its_limit() {
        use RegionVerdict::{ColorOfLight, Fits, NewEdges as NewEdgesFound, NoHighlights, OffPlane, Texture};
        let fits = RegionFit { sigma_counts: 1.0, limit_sigmas: 1.5, ..RegionFit::default() };
        let off = RegionFit { rms_counts: 4.0, ..fits };
        let print = RegionFit { texture: 0.9, texture_slope: 0.9, ..off };
        let part = RegionFit { new_edges: NewEdges { sides: 100, new: 50 }, ..fits };
        let white = RegionFit { highlights: Some(0.1), ..fits };
        assert_eq!(
            [fits, off, print, part, white].map(|fit| fit.verdict()),
            [Fits, OffPlane, Texture, NewEdgesFound, NoHighlights]
        );
        let small_slope = RegionFit { texture_slope: 0.1, ..print };
        assert_eq!(small_slope.verdict(), OffPlane, "texture needs both limits");
        let like_light = RegionFit { light_share: 1.5, ..print };
        assert_eq!(like_light.verdict(), ColorOfLight);
        assert_eq!((like_light.verdict_of_marked(), part.verdict_of_marked()), (OffPlane, Fits));
    }

    #[test]
    fn a_light_near_the_body_needs_clear_highlights() {
        let near =
            RegionFit { sigma_counts: 1.0, limit_sigmas: 1.5, light_share: 0.5, ..RegionFit::default() };
        assert!(near.has_doubtful_light() && near.model_fits(), "not judged");
        let judged = |highlights| RegionFit { highlights: Some(highlights), ..near };
        assert!(!judged(0.7).model_fits() && judged(0.9).model_fits());
        let far = RegionFit { light_share: 0.3, ..judged(0.7) };
        assert!(!far.has_doubtful_light() && far.model_fits());
    }

    #[test]
    fn a_small_misfit_needs_clear_highlights_and_a_line_has_none() {
        let plane = RegionFit {
            rms_counts: 1.6,
            sigma_counts: 0.75,
            limit_sigmas: 1.5,
            least_limit_counts: NO_MISFIT_COUNTS,
            ..RegionFit::default()
        };
        assert!(plane.has_small_misfit() && plane.model_fits());
        let with = |highlights| RegionFit { highlights, ..plane };
        assert!(with(Some(0.9)).model_fits());
        assert!(!with(Some(0.5)).model_fits() && !with(Some(0.0)).model_fits());
        let line = RegionFit { least_limit_counts: 0.0, ..plane };
        assert!(line.poor() && !line.has_small_misfit());
        let exact = RegionFit { rms_counts: 0.8, ..with(Some(0.5)) };
        assert!(exact.model_fits(), "without a misfit .3 is enough");
        assert!(
            RegionFit { highlights: None, ..exact }.model_fits(),
            "too little surface reflection to be judged"
        );
        assert!(!RegionFit { highlights: Some(0.2), ..exact }.model_fits());
        assert!(
            (plane.limits().rms_counts - 1.875).abs() < 1e-9
                && (plane.limits().rms_sigmas - 2.5).abs() < 1e-9
        );
    }
}
