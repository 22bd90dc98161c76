//! Which lamp lights each pixel, and the factor that makes that lamp white.

use crate::color::Vec3;
use crate::raster::Mask;
use crate::reflection::WhiteningGain;
use crate::segment::LightFindings;
use std::sync::Arc;

/// One lamp: its color, and the factor that makes the color white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// The factor that makes the lamp white.
    pub gain: WhiteningGain,
    /// Surface reflection per count of J in each band.
    pub per_amount: [f32; 3],
}

impl Lamp {
    /// The lamp with the color `light`, unit; none where the light lacks a band.
    pub fn new(light: &Vec3) -> Option<Self> {
        let gain = WhiteningGain::new(light)?;
        Some(Self { gain, per_amount: std::array::from_fn(|band| (3f64.sqrt() * light[band]) as f32) })
    }
}

/// The lamps of the scene, and the pixels that each lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamps {
    first: Lamp,
    /// The second lamp and the pixels that it lights; `None` with one lamp.
    second: Option<(Lamp, Arc<Mask>)>,
}

impl Lamps {
    /// The lamps of a picture with this light, `second_lamp_mask` the pixels that the second lamp lights; none where no light is known or the
    /// light lacks a band.
    pub fn new(light: &LightFindings, second_lamp_mask: Option<&Arc<Mask>>) -> Option<Self> {
        let first = Lamp::new(&light.direction?.into())?;
        let second = light.second.and_then(|second| Lamp::new(&second.direction.into()));
        Some(Self { first, second: second.zip(second_lamp_mask.cloned()) })
    }

    /// The lamps of a picture that one lamp with the color `light`, unit, lights; none where the light lacks a band.
    #[cfg(test)]
    pub fn one(light: &Vec3) -> Option<Self> {
        Some(Self { first: Lamp::new(light)?, second: None })
    }

    /// Whether the second lamp lights the pixel.
    #[inline]
    pub fn is_second(&self, pixel: usize) -> bool {
        self.second.as_ref().is_some_and(|(_, mask)| mask[pixel])
    }

    /// The lamp that lights the pixel.
    #[inline]
    pub fn of(&self, pixel: usize) -> &Lamp {
        match &self.second {
            Some((lamp, mask)) if mask[pixel] => lamp,
            _ => &self.first,
        }
    }
}
