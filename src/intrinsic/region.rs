//! What is told of each region, in numbers and in words.

use super::RegionReflection;
use super::confidence::of_region;
use super::split::Splitter;
use crate::raster::Raster;
use crate::segment::{POOR_FIT, Pixels, RegionFit, Scene};
use crate::trace::PixelKind;

/// Below this angle body and surface reflection cannot be told apart at all, degrees.
pub const MIN_ANGLE_DEG: f64 = 3.0;
/// Below this angle they can, with noise amplified more than four times.
const SMALL_ANGLE_DEG: f64 = 14.0;

/// A region, split.
pub struct Known<'a> {
    /// Its label, from 1.
    pub id: u16,
    /// Its pixels.
    pub pixels: Pixels<'a>,
    /// How well they bear out its vectors.
    pub fit: RegionFit,
    /// What each pixel of the picture is to its region.
    pub kinds: &'a Raster<PixelKind>,
}

impl Known<'_> {
    /// What is known of the region.
    pub fn report(&self, scene: &Scene, splitter: &Splitter, neighbours: Vec<u16>) -> RegionReflection {
        let pixels = self.pixels;
        let count = |test: &dyn Fn(usize) -> bool| pixels.iter().filter(|&p| test(p as usize)).count();
        let matte_pixels = count(&|pixel| self.kinds[pixel] == PixelKind::Matte);
        let highlight_pixels = pixels.len() - matte_pixels;
        let vectors = &splitter.vectors;
        let surface = vectors.surface;
        let angle_deg = surface.map(|surface| crate::color::axis_angle_deg(&vectors.body, &surface));
        let separable = splitter.transform.is_some();
        let holds = !scene.refine.region_holds || self.fit.holds(scene.sigma());
        RegionReflection {
            id: self.id,
            pixels: pixels.len(),
            matte_pixels,
            highlight_pixels,
            clipped_pixels: count(&|pixel| scene.masks.clipped(pixel)),
            body: vectors.body.into(),
            surface: surface.map(Into::into),
            matte_mean: vectors.matte_mean.into(),
            highlight_start: surface.map(|_| splitter.hypothesis.start.into()),
            plane_normal: splitter.transform.map(|t| t.normal().map(f64::from)),
            angle_deg,
            fit_rms_counts: self.fit.rms_counts,
            holds,
            confidence: of_region(&self.fit, holds, angle_deg.filter(|_| separable), scene.sigma()),
            texture: self.fit.texture,
            separable,
            neighbours,
            warnings: self.warnings(scene, splitter, angle_deg, holds),
        }
    }

    fn warnings(
        &self,
        scene: &Scene,
        splitter: &Splitter,
        angle_deg: Option<f64>,
        holds: bool,
    ) -> Vec<String> {
        let mut warnings = Vec::new();
        match angle_deg {
            None => warnings.push("no dichromatic plane: everything counts as body reflection".to_owned()),
            Some(angle) if angle < MIN_ANGLE_DEG => warnings.push(format!(
                "body and surface vector are collinear ({angle:.1}\u{b0}): everything counts as body reflection"
            )),
            Some(angle) if angle < SMALL_ANGLE_DEG => warnings.push(format!(
                "body and surface vector are only {angle:.1}\u{b0} apart: the split amplifies noise {:.0} times",
                1.0 / angle.to_radians().sin()
            )),
            Some(_) => {}
        }
        if self.fit.poor(scene.sigma()) {
            let what = if splitter.transform.is_some() { "plane" } else { "matte line" };
            let (rms, limit) = (self.fit.rms_counts, POOR_FIT * scene.sigma());
            warnings.push(format!(
                "poor fit: pixels lie {rms:.1} counts from the {what} (rms), {limit:.1} is noise"
            ));
        }
        if self.fit.textured() {
            warnings.push(format!(
                "texture: surface and body vary against each other (correlation \u{2212}{:.2})",
                self.fit.texture.min(1.0)
            ));
        }
        if !holds {
            warnings.push(
                "the model does not hold: the plane is not used, what stands out locally is all that is split"
                    .to_owned(),
            );
        }
        let foot = splitter.hypothesis.matte.foot().norm();
        if foot > scene.sigma() {
            warnings.push(format!(
                "the matte line misses black by {foot:.1} counts: ambient light, inter-reflection or no single material"
            ));
        }
        let lost = self.pixels.iter().filter(|&p| self.kinds[p as usize] == PixelKind::Lost).count();
        if lost > 0 {
            warnings.push(format!("{lost} pixels are clipped in every band: their split is a guess"));
        }
        warnings
    }
}
