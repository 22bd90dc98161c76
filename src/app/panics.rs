//! Panics of workers and of the window, caught where they happen, and turned into sentences.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The result of `work`, or the text of the panic that ended `work`.
///
/// # Errors
/// The text of the panic. Data that `work` was changing may be incomplete: the caller drops such data or makes them anew.
pub fn catch_panic<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| panic_text(&*payload))
}

/// The message of a panic.
fn panic_text(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown reason".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_its_text() {
        assert_eq!(catch_panic(|| 3), Ok(3));
        assert_eq!(catch_panic(|| std::panic::resume_unwind(Box::new("a"))), Err::<(), _>("a".to_owned()));
        let owned = || std::panic::resume_unwind(Box::new("b".to_owned()));
        assert_eq!(catch_panic(owned), Err::<(), _>("b".to_owned()));
        assert_eq!(
            catch_panic(|| std::panic::resume_unwind(Box::new(7))),
            Err::<(), _>("unknown reason".to_owned())
        );
    }
}
