//! Every unique color, found on a thread of its own when it is first asked for.

use crate::view::{Picture, UniqueColor};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// The camera rests when it has not moved for this long.
pub const REST: Duration = Duration::from_millis(200);

/// The unique colors of one photograph.
#[derive(Default)]
pub struct Detail {
    of: Option<Arc<Picture>>,
    found: Option<Arc<[UniqueColor]>>,
    coming: Option<Receiver<Arc<[UniqueColor]>>>,
    moved: Option<Instant>,
}

impl Detail {
    /// The camera has moved.
    pub fn stir(&mut self) {
        self.moved = Some(Instant::now());
    }

    /// The colors, once they are known and the camera rests; `swift`: the graphics device need not wait for that.
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
        // Another photograph may have been opened by now.
        let _ = send.send(picture.histogram.unique(&picture.photo.image).into());
        ctx.request_repaint();
    };
    std::thread::Builder::new().name("unique colors".to_owned()).spawn(find).ok().map(|_| receive)
}
