//! Signals that end the program: it leaves no unfinished file behind.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;
use signal_hook::{flag, low_level};
use vtu2contour::vtk::abandon_unfinished_files;

/// Watches for Ctrl-C and `kill`: the program then ends by the same signal as if it had not
/// watched, but without its temporary files.
///
/// # Errors
/// If the system refuses.
pub fn watch() -> io::Result<()> {
    // a file beyond `ulimit -f` is then an error of writing, and no end without a word
    flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    thread::spawn(move || {
        for signal in signals.forever() {
            abandon_unfinished_files();
            let _ = low_level::emulate_default_handler(signal);
        }
    });
    Ok(())
}
