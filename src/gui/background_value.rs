//! A value of a panel whose computation takes longer than a frame: a thread computes the value, and the panel shows the former
//! value of the same subject until then.

use super::task::Task;
use egui::Context;

/// Largest number of pixels of work that is done within a frame, without a thread.
pub const SYNCHRONOUS_PX: usize = 400_000;

/// A value computed from a key, and the computation of the next value. A key is a subject `S`, what the value is about, and a version `V`.
pub struct BackgroundValue<S, V, T> {
    /// The last value, with the key of the value.
    value: Option<((S, V), T)>,
    /// The key of the value that `task` computes.
    pending_key: Option<(S, V)>,
    /// The key whose value could not be computed because of a panic: the value is not tried again until the key changes.
    failed_key: Option<(S, V)>,
    task: Option<Task<T>>,
}

impl<S, V, T> Default for BackgroundValue<S, V, T> {
    fn default() -> Self {
        Self { value: None, pending_key: None, failed_key: None, task: None }
    }
}

impl<S: PartialEq + Clone, V: PartialEq + Clone, T: Send + 'static> BackgroundValue<S, V, T> {
    /// The value of `key`; while it is being computed, the value of an earlier version of the same subject, otherwise `None`. At most one value is computed at a time. With `synchronous`, the value is computed in this call. A panic of `make`
    /// on the thread becomes a notice (see [`super::task::take_panics`]), and the former value stays.
    pub fn get(
        &mut self,
        ctx: &Context,
        key: (S, V),
        synchronous: bool,
        make: impl FnOnce() -> T + Send + 'static,
    ) -> Option<&T> {
        let result = Task::take(&mut self.task);
        if self.task.is_none()
            && let Some(key) = self.pending_key.take()
        {
            match result {
                Some(value) => self.value = Some((key, value)),
                None => self.failed_key = Some(key),
            }
        }
        self.failed_key.take_if(|failed| *failed != key);
        let subject = key.0.clone();
        let stale = self.value.as_ref().is_none_or(|(value, _)| *value != key);
        if stale && self.task.is_none() && self.failed_key.is_none() {
            if synchronous {
                self.value = Some((key, make()));
            } else {
                self.task = Task::start(ctx, "panel", make);
                self.pending_key = self.task.is_some().then_some(key);
            }
        }
        self.value.as_ref().filter(|((of, _), _)| *of == subject).map(|(_, value)| value)
    }

    /// The value of `key`, if it is the last one that was computed.
    pub fn known(&self, key: &(S, V)) -> Option<&T> {
        self.value.as_ref().filter(|(of, _)| of == key).map(|(_, value)| value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn the_former_value_stays_until_the_new_value_is_computed() {
        let (ctx, mut background_value) = (Context::default(), BackgroundValue::default());
        assert_eq!(background_value.get(&ctx, ((), 1), true, || "one"), Some(&"one"));
        let (go, wait) = channel::<()>();
        let slow = move || {
            let _ = wait.recv();
            "two"
        };
        assert_eq!(background_value.get(&ctx, ((), 2), false, slow), Some(&"one"));
        assert_eq!(background_value.get(&ctx, ((), 3), true, || "three"), Some(&"one"), "one at a time");
        drop(go);
        while background_value.get(&ctx, ((), 2), true, || "again") == Some(&"one") {
            std::thread::yield_now();
        }
        assert_eq!(background_value.get(&ctx, ((), 2), true, || "again"), Some(&"two"));
        assert_eq!(
            (background_value.known(&((), 2)), background_value.known(&((), 3))),
            (Some(&"two"), None)
        );
    }

    #[test]
    fn a_panic_leaves_the_former_value_and_is_not_repeated_for_the_same_key() {
        let (ctx, mut background_value) = (Context::default(), BackgroundValue::default());
        assert_eq!(background_value.get(&ctx, ((), 1), true, || "one"), Some(&"one"));
        let fail = || std::panic::resume_unwind(Box::new("broken"));
        while background_value.failed_key.is_none() {
            assert_eq!(background_value.get(&ctx, ((), 2), false, fail), Some(&"one"));
        }
        assert_eq!(crate::gui::task::take_panics(&ctx).len(), 1);
        assert_eq!(
            background_value.get(&ctx, ((), 2), true, || "two"),
            Some(&"one"),
            "key 2 is not tried again"
        );
        assert_eq!(background_value.get(&ctx, ((), 3), true, || "three"), Some(&"three"));
        assert_eq!(background_value.get(&ctx, ((), 2), true, || "two"), Some(&"two"));
    }

    #[test]
    fn the_former_value_of_another_subject_is_not_shown() {
        let (ctx, mut background_value) = (Context::default(), BackgroundValue::default());
        assert_eq!(background_value.get(&ctx, ("cup", 1), true, || "red"), Some(&"red"));
        let (go, wait) = channel::<()>();
        let slow = move || {
            let _ = wait.recv();
            "blue"
        };
        assert_eq!(background_value.get(&ctx, ("jug", 2), false, slow), None);
        assert_eq!(background_value.get(&ctx, ("cup", 1), true, || "again"), Some(&"red"));
        drop(go);
        while background_value.get(&ctx, ("jug", 2), true, || "again").is_none() {
            std::thread::yield_now();
        }
        assert_eq!(background_value.get(&ctx, ("jug", 2), true, || "again"), Some(&"blue"));
    }
}
