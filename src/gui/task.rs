//! Work on a thread of its own, whose result a panel takes in when it is drawn.

use egui::Context;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Work under way. A task that is dropped runs to its end, and its result is discarded.
pub struct Task<T>(Receiver<T>);

impl<T: Send + 'static> Task<T> {
    /// Starts `work` on a thread called `name`; the window is drawn again when the work has ended. None where the
    /// system gives no thread.
    pub fn start(ctx: &Context, name: &str, work: impl FnOnce() -> T + Send + 'static) -> Option<Self> {
        let (send, receive) = channel();
        let ctx = ctx.clone();
        let run = move || {
            // The task may have been dropped by now.
            let _ = send.send(work());
            ctx.request_repaint();
        };
        std::thread::Builder::new().name(name.to_owned()).spawn(run).ok().map(|_| Self(receive))
    }

    /// The result of the task in `slot`, once. The slot is empty afterwards; also after a task that ended without a result.
    pub fn take(slot: &mut Option<Self>) -> Option<T> {
        let result = match slot.as_ref()?.0.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => None,
            Ok(result) => Some(result),
        };
        *slot = None;
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes until the slot is empty.
    fn wait_for<T: Send + 'static>(slot: &mut Option<Task<T>>) -> Option<T> {
        let mut result = None;
        while slot.is_some() {
            result = Task::take(slot);
            std::thread::yield_now();
        }
        result
    }

    #[test]
    fn a_result_is_taken_once_and_a_panic_leaves_none() {
        let ctx = Context::default();
        let (go, wait) = channel::<()>();
        let mut slot = Task::start(&ctx, "slow", move || wait.recv().is_err());
        assert!(Task::take(&mut slot).is_none() && slot.is_some(), "the task is under way");
        drop(go);
        assert_eq!(wait_for(&mut slot), Some(true));
        assert_eq!(Task::take(&mut slot), None);
        let mut failed = Task::<u8>::start(&ctx, "failing", || std::panic::resume_unwind(Box::new(())));
        assert_eq!(wait_for(&mut failed), None);
    }
}
