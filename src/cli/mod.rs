//! The command line: one file a subcommand.
//!
//! Exit codes: 0 done, 1 the job failed (one line on standard error says why),
//! 2 wrong usage.

mod arguments;
mod cell_numbers;
mod contour;
mod csv;
mod info;
mod input;
mod interpolate;
#[cfg(unix)]
mod interruptions;
mod messages;
mod monitor;
mod output;
mod plan;
mod refine;
mod running;
mod solver;
mod stats;
mod warnings;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use arguments::{Cli, Command};

/// Runs the command line of this process.
pub fn run() -> ExitCode {
    let cli = Cli::parse();
    #[cfg(unix)]
    if let Err(error) = interruptions::watch() {
        messages::error(&error);
        return ExitCode::FAILURE;
    }
    let done = match cli.command {
        None => contour::run(&cli.contour),
        Some(Command::Contour(arguments)) => contour::run(&arguments),
        Some(Command::Info(arguments)) => info::run(&arguments),
        Some(Command::Interpolate(arguments)) => interpolate::run(&arguments),
        Some(Command::Monitor(arguments)) => monitor::run(&arguments),
        Some(Command::Refine(arguments)) => refine::run(&arguments),
        Some(Command::Completions { shell }) => {
            let name = env!("CARGO_PKG_NAME");
            clap_complete::generate(shell, &mut Cli::command(), name, &mut std::io::stdout());
            Ok(())
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            messages::error(&error);
            ExitCode::FAILURE
        }
    }
}
