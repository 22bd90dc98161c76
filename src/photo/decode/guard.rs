//! Turns panics of decoding libraries into errors.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether this thread decodes a file, so that its panic is reported as an error of the file.
    static DECODES: Cell<bool> = const { Cell::new(false) };
}

/// Runs `work`; a panic becomes its message, and the usual report of the panic is left out.
pub(super) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    static QUIET_HOOK: Once = Once::new();
    QUIET_HOOK.call_once(|| {
        let previous = take_hook();
        set_hook(Box::new(move |panic| {
            if !DECODES.get() {
                previous(panic);
            }
        }));
    });
    DECODES.set(true);
    // `work` owns what it changes, so that no half-changed value outlives a panic.
    let result = catch_unwind(AssertUnwindSafe(work));
    DECODES.set(false);
    result.map_err(|payload| message(&*payload))
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "no message".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_its_message_and_the_next_work_is_not_affected() {
        let empty: &[u8] = &[];
        assert!(caught(|| empty[0]).unwrap_err().contains("out of bounds"));
        assert_eq!(caught(|| 5), Ok(5));
        assert!(!DECODES.get());
    }
}
