//! What the command line tells people: on standard error, a line each.

use std::fmt::Display;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Tells why a job failed.
pub fn error(error: &dyn Display) {
    eprintln!("vtu2contour: error: {error}");
}

/// Warnings, details and progress, as far as they are wanted.
pub struct Messages {
    warnings: bool,
    details: bool,
    progress: ProgressBar,
}

impl Messages {
    /// Messages for a job. Progress is shown on a terminal only.
    pub fn new(quiet: bool, verbose: bool, progress: bool) -> Self {
        let progress = if quiet || !progress {
            ProgressBar::hidden()
        } else {
            // indicatif draws nothing where standard error is no terminal
            let bar = ProgressBar::new_spinner();
            if let Ok(style) = ProgressStyle::with_template("{spinner:.green} {msg} {elapsed:.dim}")
            {
                bar.set_style(style);
            }
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        };
        Self { warnings: !quiet, details: verbose, progress }
    }

    /// Tells what is being done now.
    pub fn stage(&self, text: &str) {
        self.progress.set_message(text.to_owned());
    }

    /// Takes the progress off the terminal.
    pub fn finish(&self) {
        self.progress.finish_and_clear();
    }

    /// Tells what people should know.
    pub fn warning(&self, text: &str) {
        if self.warnings {
            self.progress.suspend(|| eprintln!("vtu2contour: warning: {text}"));
        }
    }

    /// Tells what some people want to know.
    pub fn detail(&self, text: &str) {
        if self.details {
            self.progress.suspend(|| eprintln!("{text}"));
        }
    }
}
