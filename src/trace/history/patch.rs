//! The window that a pixel lies in, and the area of the window, in a grid that is classified and merged step by step.

use super::{HistoryKind, MergeRefusal, MergeStory, WindowStory};
use crate::color::ClusterTest;
use crate::trace::{Event, Grid, MergeTried, WindowClassified, WindowsLaid};

/// The window of a pixel in one grid.
pub(super) struct Patch<'a> {
    laid: &'a WindowsLaid,
    test: ClusterTest,
    /// Index of the window, row-major.
    window: u32,
    /// The unions that were tried with the window's area, and the step of the last one.
    merging: Option<(usize, MergeStory)>,
}

impl<'a> Patch<'a> {
    pub(super) fn new(laid: &'a WindowsLaid, pixel: usize, width: usize) -> Self {
        let window = laid.window_of(pixel, width) as u32;
        let test = ClusterTest::new(laid.camera_noise, laid.tail_test);
        Self { laid, test, window, merging: None }
    }

    /// Whether an area, by its first window, is the classified area of the pixel.
    pub(super) fn is_area(&self, grid: &Grid, area: u32) -> bool {
        let class = grid.classes.as_slice().get(self.window as usize).copied().flatten().flatten();
        class.is_some() && grid.area_of(self.window as usize) == area
    }

    /// The history entry of an event about the window; `grid` is the grid before the event.
    pub(super) fn entry(&mut self, grid: &Grid, step: usize, event: &Event) -> Option<HistoryKind> {
        match event {
            Event::WindowClassified(classified) if classified.window == self.window => {
                Some(HistoryKind::Window(Box::new(self.window_story(classified))))
            }
            Event::MergeTried(tried) => {
                let area = grid.area_of(self.window as usize);
                if [tried.into, tried.from].contains(&area) {
                    self.take_merge(area, step, tried);
                }
                None
            }
            _ => None,
        }
    }

    fn window_story(&mut self, classified: &WindowClassified) -> WindowStory {
        let WindowClassified { pixels, eigenvalues, class, .. } = *classified;
        let trials = match class {
            Some(_) => self.test.trials(f64::from(pixels), eigenvalues.map(f64::from)),
            None => Vec::new(),
        };
        WindowStory {
            size_px: self.laid.size_px,
            pixels: [pixels, self.laid.least_pixels],
            eigenvalues,
            trials,
            tail_test: self.laid.tail_test,
            class,
        }
    }

    /// Adds a union that was tried with the window's area.
    fn take_merge(&mut self, area: u32, step: usize, tried: &MergeTried) {
        let MergeTried { from, pixels, eigenvalues, class, union, .. } = *tried;
        let own = usize::from(from == area);
        let (last, story) = self.merging.get_or_insert_with(|| {
            let pixels = pixels[own];
            (step, MergeStory { tried: 0, joined: 0, pixels, refusal: None, class })
        });
        *last = step;
        story.tried += 1;
        let both = pixels[0] + pixels[1];
        if class == union {
            story.joined += 1;
            story.pixels = both;
        } else {
            let trials = self.test.trials(f64::from(both), eigenvalues.map(f64::from));
            story.refusal = Some(MergeRefusal {
                step,
                neighbor_pixels: pixels[1 - own],
                union,
                trial: trials.into_iter().rev().find(|trial| !trial.is_noise()),
            });
        }
    }

    /// How the area grew, once merging is over, and the step of the last union that was tried.
    pub(super) fn merged(&mut self) -> Option<(usize, HistoryKind)> {
        self.merging.take().map(|(step, story)| (step, HistoryKind::Merging(Box::new(story))))
    }
}
