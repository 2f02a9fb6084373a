//! Ending a long computation from outside.
//!
//! A program that is interrupted ends as a whole; an interpreter goes on, and what it called
//! has to come to an end. Whoever calls the library there runs it by [`interruptible`], and
//! asks for the end by [`request`], from another thread. Long loops pass a checkpoint now and
//! then: one relaxed read of a flag. Where an end is asked for, it unwinds to
//! [`interruptible`], through rayon too, which then starts no other part of the loop.
//!
//! There is one flag for all threads: an interruption ends all computations that run at the
//! time, as Ctrl-C ends all of a program. So whoever calls [`request`] runs all of them by
//! [`interruptible`]: one that is not has nothing to catch the end.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Whether computations are to end.
static IS_REQUESTED: AtomicBool = AtomicBool::new(false);

/// How many are running.
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// A computation was ended by [`request`] before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted;

/// Asks all computations that run by [`interruptible`] to end soon.
pub fn request() {
    IS_REQUESTED.store(true, Ordering::Relaxed);
}

/// Runs a computation that [`request`] can end.
///
/// # Errors
/// [`Interrupted`] if it was ended. A panic goes on as it is.
pub fn interruptible<T>(computation: impl FnOnce() -> T) -> Result<T, Interrupted> {
    RUNNING.fetch_add(1, Ordering::Relaxed);
    let result = catch_unwind(AssertUnwindSafe(computation));
    // the last one to end makes way for those to come
    if RUNNING.fetch_sub(1, Ordering::Relaxed) == 1 {
        IS_REQUESTED.store(false, Ordering::Relaxed);
    }
    result.map_err(|payload| match payload.downcast::<Interrupted>() {
        Ok(interrupted) => *interrupted,
        Err(panic) => resume_unwind(panic),
    })
}

/// Ends the computation here if that was asked for.
pub(crate) fn checkpoint() {
    // nothing runs that could catch the end: a request that came too late
    if IS_REQUESTED.load(Ordering::Relaxed) && RUNNING.load(Ordering::Relaxed) > 0 {
        // this calls no panic hook: nothing is wrong
        resume_unwind(Box::new(Interrupted));
    }
}
