//! Work on a thread of its own, whose result a panel takes in when it is drawn.

use crate::app::catch_panic;
use egui::{Context, Id};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Work under way. A task that is dropped runs to its end, and its result is discarded.
pub struct Task<T>(Receiver<T>);

impl<T: Send + 'static> Task<T> {
    /// Starts `work` on a thread called `name`; the window is drawn again when the work has ended. A panic of `work` ends the
    /// task without a result, and [`take_panics`] returns a sentence about the panic. None where the system gives no thread.
    pub fn start(ctx: &Context, name: &str, work: impl FnOnce() -> T + Send + 'static) -> Option<Self> {
        let (send, receive) = channel();
        let ctx = ctx.clone();
        let thread_name = name.to_owned();
        let run = move || {
            match catch_panic(work) {
                Ok(result) => {
                    // The task may have been dropped by now.
                    let _ = send.send(result);
                }
                Err(reason) => note_panic(&ctx, &thread_name, &reason),
            }
            // Disconnected before the window is drawn, so that the task counts as ended.
            drop(send);
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

/// The id under which the sentences about panics wait in the context's memory. A panel that starts a task has a context at
/// hand when the task ends, but no [`super::PanelContext`].
fn panics_id() -> Id {
    Id::unique("panics of tasks")
}

/// Keeps a sentence about the panic of the task called `name` until [`take_panics`] is called.
fn note_panic(ctx: &Context, name: &str, reason: &str) {
    let sentence = format!(
        "the task \"{name}\" was ended by an error of the program ({reason}); please report the error, and go on"
    );
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<String>>(panics_id()).push(sentence));
}

/// Sentences about the tasks that panicked since the last call.
pub fn take_panics(ctx: &Context) -> Vec<String> {
    ctx.data_mut(|data| data.remove_temp(panics_id())).unwrap_or_default()
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
    fn a_result_is_taken_once_and_a_panic_leaves_a_sentence() {
        let ctx = Context::default();
        let (go, wait) = channel::<()>();
        let mut slot = Task::start(&ctx, "slow", move || wait.recv().is_err());
        assert!(Task::take(&mut slot).is_none() && slot.is_some(), "the task is under way");
        drop(go);
        assert_eq!(wait_for(&mut slot), Some(true));
        assert_eq!(Task::take(&mut slot), None);
        assert!(take_panics(&ctx).is_empty());
        let mut failed = Task::<u8>::start(&ctx, "failing", || std::panic::resume_unwind(Box::new("broken")));
        assert_eq!(wait_for(&mut failed), None);
        let sentences = take_panics(&ctx);
        assert!(sentences.len() == 1 && sentences[0].contains("\"failing\" was ended"), "{sentences:?}");
        assert!(sentences[0].contains("(broken)") && take_panics(&ctx).is_empty());
    }
}
