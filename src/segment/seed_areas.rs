//! The merged areas from which linear hypotheses start (section 5.3.1): always the one with the most unclaimed pixels.

use super::classify::Windows;
use super::input::AnalysisInput;
use super::merge::Areas;
use super::recorded_labels::RecordedLabels;
use crate::raster::UNASSIGNED;
use crate::trace::{Class, PassedOver, Recorder};

/// Which areas may become hypotheses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeedAreaRules {
    /// Fewest unclaimed pixels of an area.
    pub min_area_px: usize,
    /// Whether areas of class *point* count too; the axis of such a hypothesis is the line from black through the mean.
    pub points: bool,
    /// Whether the axis must pass black within the cylinder's radius, and growing must claim the minimal area.
    pub through_black: bool,
}

/// The areas that may still become hypotheses; every list has one entry per area.
pub struct SeedAreas<'a> {
    areas: &'a Areas,
    windows: &'a Windows,
    /// Number of pixels that no region has claimed; 0 for an examined area.
    unclaimed: Vec<u32>,
    /// Windows of the area.
    members: Vec<Vec<u32>>,
    /// Whether the area has been examined.
    examined: Vec<bool>,
}

impl<'a> SeedAreas<'a> {
    /// The areas of the classes that `rules` name.
    pub fn new<R: Recorder>(
        input: &AnalysisInput,
        windows: &'a Windows,
        areas: &'a Areas,
        rules: &SeedAreaRules,
        recorded_labels: &RecordedLabels<R>,
    ) -> Self {
        let mut unclaimed = vec![0u32; areas.classes.len()];
        let mut members = vec![Vec::new(); areas.classes.len()];
        for (window, &area) in areas.of_window.as_slice().iter().enumerate() {
            let class = areas.classes[area as usize];
            if class == Some(Class::Line) || (rules.points && class == Some(Class::Point)) {
                members[area as usize].push(window as u32);
                unclaimed[area as usize] += windows.moments[window].n as u32;
            }
        }
        let examined = vec![false; members.len()];
        let mut seed_areas = Self { areas, windows, unclaimed, members, examined };
        // The moments of windows count valid pixels, of which fewer may be claimable and unassigned.
        for area in 0..seed_areas.members.len() {
            if seed_areas.unclaimed[area] as usize >= rules.min_area_px {
                seed_areas.unclaimed[area] =
                    seed_areas.free_pixels(input, area, recorded_labels).count() as u32;
            }
        }
        seed_areas
    }

    /// The area with the most unclaimed pixels, the first one of equals; `None` where it is smaller than `min_area_px`.
    pub fn largest(&self, min_area_px: usize) -> Option<usize> {
        let best = (0..self.unclaimed.len()).rev().max_by_key(|&area| self.unclaimed[area])?;
        (self.unclaimed[best] as usize >= min_area_px.max(1)).then_some(best)
    }

    /// The areas that were never examined, each with its number of unclaimed pixels and the reason: other regions consumed the
    /// area, or the area never had `least` valid pixels.
    pub fn never_examined(&self, least: u32) -> impl Iterator<Item = (u32, u32, PassedOver)> + '_ {
        let left =
            (0..self.members.len()).filter(|&area| !self.members[area].is_empty() && !self.examined[area]);
        left.map(move |area| {
            let was_large = self.areas.moments[area].n >= f64::from(least);
            let reason = if was_large { PassedOver::Consumed } else { PassedOver::TooSmall };
            (area as u32, self.unclaimed[area], reason)
        })
    }

    /// The claimable pixels of an area that belong to no region.
    pub fn free_pixels<'b, R: Recorder>(
        &'b self,
        input: &'b AnalysisInput,
        area: usize,
        recorded_labels: &'b RecordedLabels<R>,
    ) -> impl Iterator<Item = u32> + 'b {
        let (width, height) = (input.pixels.width(), input.pixels.height());
        let (size, columns) = (self.windows.size_px, self.windows.classes.width());
        self.members[area].iter().flat_map(move |&window| {
            let (left, top) = (window as usize % columns * size, window as usize / columns * size);
            (top..(top + size).min(height))
                .flat_map(move |y| y * width + left..y * width + (left + size).min(width))
                .filter(|&pixel| recorded_labels.labels[pixel] == UNASSIGNED && input.claimable(pixel))
                .map(|pixel| pixel as u32)
        })
    }

    /// Takes an area out of those that may still become hypotheses.
    pub fn mark_examined(&mut self, area: usize) {
        self.examined[area] = true;
        self.unclaimed[area] = 0;
    }

    /// Subtracts the pixels that a region has claimed from the areas' numbers of unclaimed pixels.
    pub fn subtract(&mut self, claimed: &[u32], windows: &Windows, width: usize) {
        for &pixel in claimed {
            let area = self.areas.of_window[windows.window_of(pixel as usize, width)] as usize;
            self.unclaimed[area] = self.unclaimed[area].saturating_sub(1);
        }
    }
}
