//! Running the library beside the interpreter.

use std::sync::OnceLock;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use pyo3::prelude::*;
use vtu2contour::filter::FilterError;
use vtu2contour::interruption::{self, Interrupted, interruptible};

use crate::error::exception;

/// How often the interpreter is asked whether Ctrl-C was pressed.
const PATIENCE: Duration = Duration::from_millis(50);

/// Runs a computation while other Python threads go on; Ctrl-C ends it.
///
/// # Errors
/// The computation's own, as a Python exception; `KeyboardInterrupt`.
pub fn run<T: Send>(
    py: Python,
    computation: impl FnOnce() -> Result<T, FilterError> + Send,
) -> PyResult<T> {
    py.detach(|| {
        // in a thread of the pool: from outside, each of many small parallel loops would wait for
        // one to wake; this one answers to signals, as the interpreter asks of it
        rayon::in_place_scope(|scope| {
            let (sender, receiver) = channel();
            scope.spawn(move |_| {
                // nobody waits for the result of a computation that was interrupted
                let _ = sender.send(interruptible(computation));
            });
            let mut signal = Ok(());
            loop {
                match receiver.recv_timeout(PATIENCE) {
                    Ok(Ok(result)) => return signal.and(result.map_err(|e| exception(&e))),
                    Ok(Err(Interrupted)) | Err(RecvTimeoutError::Disconnected) => {
                        return Err(signal.err().unwrap_or_else(interrupted));
                    }
                    Err(RecvTimeoutError::Timeout) if signal.is_ok() => {
                        signal = Python::attach(|py| py.check_signals());
                        if signal.is_err() {
                            interruption::request();
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                }
            }
        })
    })
}

/// Another thread's Ctrl-C ended this one's computation too.
fn interrupted() -> PyErr {
    pyo3::exceptions::PyKeyboardInterrupt::new_err(())
}

/// What is computed by the first job that needs it, and kept.
///
/// Jobs that need it at the same time compute it each: if others waited for the first, a thread of
/// the pool that helps the first could take up one of them, and wait for itself.
pub fn kept<T>(slot: &OnceLock<T>, compute: impl FnOnce() -> T) -> &T {
    slot.get().unwrap_or_else(|| {
        let computed = compute();
        slot.get_or_init(|| computed)
    })
}
