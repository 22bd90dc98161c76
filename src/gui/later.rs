//! Values of a panel that take longer than a frame: computed on a background thread, while the previous value is
//! shown.

use egui::Context;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Largest number of pixels of work that is done within the frame, without a thread.
pub const AT_ONCE_PX: usize = 400_000;

/// A value computed from a key, and the computation of the next value.
pub struct Later<K, T> {
    made: Option<(K, T)>,
    making: Option<(K, Receiver<T>)>,
}

impl<K, T> Default for Later<K, T> {
    fn default() -> Self {
        Self { made: None, making: None }
    }
}

impl<K: PartialEq + Clone, T: Send + 'static> Later<K, T> {
    /// The value of `key`; the value of an earlier key while the new value is being computed; `None` before the first
    /// value. At
    /// most one value is computed at a time. With `at_once`, the value is computed in this call.
    pub fn get(
        &mut self,
        ctx: &Context,
        key: K,
        at_once: bool,
        make: impl FnOnce() -> T + Send + 'static,
    ) -> Option<&T> {
        if let Some((making, receiver)) = &self.making {
            match receiver.try_recv() {
                Ok(value) => {
                    self.made = Some((making.clone(), value));
                    self.making = None;
                }
                Err(TryRecvError::Disconnected) => self.making = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        let stale = self.made.as_ref().is_none_or(|(made, _)| *made != key);
        if stale && self.making.is_none() {
            if at_once {
                self.made = Some((key, make()));
            } else {
                self.begin(ctx, key, make);
            }
        }
        self.made.as_ref().map(|(_, value)| value)
    }

    fn begin(&mut self, ctx: &Context, key: K, make: impl FnOnce() -> T + Send + 'static) {
        let (send, receive) = channel();
        let ctx = ctx.clone();
        let work = move || {
            // The receiver is gone when the panel was closed meanwhile.
            let _ = send.send(make());
            ctx.request_repaint();
        };
        if std::thread::Builder::new().name("panel".to_owned()).spawn(work).is_ok() {
            self.making = Some((key, receive));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_former_value_stays_until_the_new_one_is_there() {
        let (ctx, mut later) = (Context::default(), Later::default());
        assert_eq!(later.get(&ctx, 1, true, || "one"), Some(&"one"));
        let (go, wait) = channel::<()>();
        let slow = move || {
            let _ = wait.recv();
            "two"
        };
        assert_eq!(later.get(&ctx, 2, false, slow), Some(&"one"));
        assert_eq!(later.get(&ctx, 3, true, || "three"), Some(&"one"), "one at a time");
        drop(go);
        while later.get(&ctx, 2, true, || "again") == Some(&"one") {
            std::thread::yield_now();
        }
        assert_eq!(later.get(&ctx, 2, true, || "again"), Some(&"two"));
    }
}
