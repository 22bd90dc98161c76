//! The window that a pixel lies in, and its area.

use super::{HistoryKind, MergeRefusal, MergeStory, WindowStory};
use crate::color::ClusterTest;
use crate::trace::{Class, Event, MergeTried, WindowClassified, WindowsLaid};

/// The pixel's window in one grid.
pub(super) struct Patch<'a> {
    laid: &'a WindowsLaid,
    test: ClusterTest,
    window: u32,
    /// First window of the area that it belongs to.
    area: u32,
    class: Option<Class>,
    merging: Option<(usize, MergeStory)>,
}

impl<'a> Patch<'a> {
    pub(super) fn new(laid: &'a WindowsLaid, pixel: usize, width: usize) -> Self {
        let window = laid.window_of(pixel, width) as u32;
        let test = ClusterTest::new(laid.camera_noise, laid.tail_test);
        Self { laid, test, window, area: window, class: None, merging: None }
    }

    /// Whether an area, by its first window, is the pixel's.
    pub(super) fn is_area(&self, area: u32) -> bool {
        self.class.is_some() && self.area == area
    }

    /// What an event says about the window.
    pub(super) fn hear(&mut self, step: usize, event: &Event) -> Option<HistoryKind> {
        match event {
            Event::WindowClassified(WindowClassified { window, pixels, eigenvalues, class, .. })
                if *window == self.window =>
            {
                self.class = *class;
                let trials = match class {
                    Some(_) => self.test.trials(f64::from(*pixels), eigenvalues.map(f64::from)),
                    None => Vec::new(),
                };
                Some(HistoryKind::Window(Box::new(WindowStory {
                    size_px: self.laid.size_px,
                    pixels: [*pixels, self.laid.least_pixels],
                    eigenvalues: *eigenvalues,
                    trials,
                    tail_test: self.laid.tail_test,
                    class: *class,
                })))
            }
            Event::MergeTried(MergeTried { into, from, .. }) if *into == self.area || *from == self.area => {
                self.tried(step, event);
                None
            }
            _ => None,
        }
    }

    fn tried(&mut self, step: usize, event: &Event) {
        let Event::MergeTried(MergeTried { into, from, pixels, eigenvalues, class, union, .. }) = event
        else {
            return;
        };
        let own = usize::from(*from == self.area);
        let (last, story) = self.merging.get_or_insert_with(|| {
            let pixels = pixels[own];
            (step, MergeStory { tried: 0, joined: 0, pixels, refusal: None, class: *class })
        });
        *last = step;
        story.tried += 1;
        let both = pixels[0] + pixels[1];
        if class == union {
            self.area = *into;
            story.joined += 1;
            story.pixels = both;
        } else {
            let trials = self.test.trials(f64::from(both), eigenvalues.map(f64::from));
            story.refusal = Some(MergeRefusal {
                step,
                neighbor_pixels: pixels[1 - own],
                union: *union,
                trial: trials.into_iter().rev().find(|trial| !trial.is_noise()),
            });
        }
    }

    /// How the area grew, once that is over, and the last step of it.
    pub(super) fn merged(&mut self) -> Option<(usize, HistoryKind)> {
        self.merging.take().map(|(step, story)| (step, HistoryKind::Merging(Box::new(story))))
    }
}
