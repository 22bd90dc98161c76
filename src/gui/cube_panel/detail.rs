//! The unique colors of a photograph, found on a thread of its own when they are first needed.

use crate::gui::task::Task;
use crate::view::{Picture, UniqueColor};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The camera is at rest when it has not moved for this time.
pub const REST: Duration = Duration::from_millis(200);

/// The unique colors of one photograph, and when the camera last moved.
#[derive(Default)]
pub struct Detail {
    of: Option<Arc<Picture>>,
    found: Option<Arc<[UniqueColor]>>,
    search: Option<Task<Arc<[UniqueColor]>>>,
    moved: Option<Instant>,
}

impl Detail {
    /// Notes that the camera has moved.
    pub fn stir(&mut self) {
        self.moved = Some(Instant::now());
    }

    /// The colors, once they are known and the camera is at rest; with `swift`, for a fast graphics device, also while it
    /// moves.
    pub fn get(
        &mut self,
        ctx: &egui::Context,
        picture: &Arc<Picture>,
        swift: bool,
    ) -> Option<Arc<[UniqueColor]>> {
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture)) {
            *self = Self { of: Some(Arc::clone(picture)), ..Self::default() };
            let picture = Arc::clone(picture);
            let find = move || picture.histogram.unique(&picture.photo.image).into();
            self.search = Task::start(ctx, "unique colors", find);
        }
        if let Some(found) = Task::take(&mut self.search) {
            self.found = Some(found);
        }
        if let Some(moved) = self.moved.filter(|moved| !swift && moved.elapsed() < REST) {
            ctx.request_repaint_after(REST.saturating_sub(moved.elapsed()));
            return None;
        }
        self.found.clone()
    }
}
