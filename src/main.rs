//! The command line `vtu2contour`.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
