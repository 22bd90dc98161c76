//! The unique colors of a photograph, found on a background thread when first requested.

use crate::view::{Picture, UniqueColor};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Time without movement after which the camera counts as at rest.
pub const REST: Duration = Duration::from_millis(200);

/// The unique colors of one photograph, and when the camera last moved.
#[derive(Default)]
pub struct Detail {
    of: Option<Arc<Picture>>,
    found: Option<Arc<[UniqueColor]>>,
    coming: Option<Receiver<Arc<[UniqueColor]>>>,
    moved: Option<Instant>,
}

impl Detail {
    /// Records that the camera has moved now.
    pub fn stir(&mut self) {
        self.moved = Some(Instant::now());
    }

    /// The unique colors; `None` until they are found, and while the camera moves. With `swift` (a fast graphics
    /// device) they
    /// are returned while the camera moves, too.
    pub fn get(
        &mut self,
        ctx: &egui::Context,
        picture: &Arc<Picture>,
        swift: bool,
    ) -> Option<Arc<[UniqueColor]>> {
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, picture)) {
            *self = Self { of: Some(Arc::clone(picture)), ..Self::default() };
            self.coming = ask(ctx, picture);
        }
        if let Some(coming) = &self.coming {
            match coming.try_recv() {
                Ok(found) => (self.found, self.coming) = (Some(found), None),
                Err(TryRecvError::Disconnected) => self.coming = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        if let Some(moved) = self.moved.filter(|moved| !swift && moved.elapsed() < REST) {
            ctx.request_repaint_after(REST.saturating_sub(moved.elapsed()));
            return None;
        }
        self.found.clone()
    }
}

fn ask(ctx: &egui::Context, picture: &Arc<Picture>) -> Option<Receiver<Arc<[UniqueColor]>>> {
    let (send, receive) = channel();
    let (ctx, picture) = (ctx.clone(), Arc::clone(picture));
    let find = move || {
        // The receiver is gone when another photograph has been opened meanwhile.
        let _ = send.send(picture.histogram.unique(&picture.photo.image).into());
        ctx.request_repaint();
    };
    std::thread::Builder::new().name("unique colors".to_owned()).spawn(find).ok().map(|_| receive)
}
