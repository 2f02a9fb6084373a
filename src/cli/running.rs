//! A job while it runs: its threads and its messages.

use anyhow::Result;

use super::arguments::RunArguments;
use super::messages::Messages;

/// Runs a job.
pub fn run(
    arguments: &RunArguments,
    job: impl FnOnce(&Messages) -> Result<()> + Send,
) -> Result<()> {
    arguments.start_threads()?;
    let messages = Messages::new(arguments.quiet, arguments.verbose, !arguments.no_progress);
    // in a thread of the pool: from outside, each of many small parallel loops would wait for one to
    // wake
    let result = rayon::scope(|_| job(&messages));
    messages.finish();
    result
}
