//! The unique colors of a photograph, found on a thread of its own when they are first needed.

use crate::gui::task::Task;
use crate::view::{Picture, UniqueColor};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A camera that has not moved for this time is at rest.
pub const REST_TIME: Duration = Duration::from_millis(200);

/// The unique colors of one photograph, and when the camera last moved.
#[derive(Default)]
pub struct UniqueColors {
    of: Option<Arc<Picture>>,
    colors: Option<Arc<[UniqueColor]>>,
    search: Option<Task<Arc<[UniqueColor]>>>,
    moved_at: Option<Instant>,
}

impl UniqueColors {
    /// Notes that the camera has moved.
    pub fn note_camera_moved(&mut self) {
        self.moved_at = Some(Instant::now());
    }

    /// The colors, once they are known and the camera is at rest; with `fast_device`, for a fast graphics device,
    /// also while the camera moves.
    pub fn get(
        &mut self,
        ctx: &egui::Context,
        picture: &Arc<Picture>,
        fast_device: bool,
    ) -> Option<Arc<[UniqueColor]>> {
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture)) {
            *self = Self { of: Some(Arc::clone(picture)), ..Self::default() };
            let picture = Arc::clone(picture);
            let find = move || picture.histogram.unique(&picture.photo.image).into();
            self.search = Task::start(ctx, "unique colors", find);
        }
        if let Some(colors) = Task::take(&mut self.search) {
            self.colors = Some(colors);
        }
        if let Some(moved_at) =
            self.moved_at.filter(|moved_at| !fast_device && moved_at.elapsed() < REST_TIME)
        {
            ctx.request_repaint_after(REST_TIME.saturating_sub(moved_at.elapsed()));
            return None;
        }
        self.colors.clone()
    }
}
