//! Differential equations given as text.
// Used by the next commits.
#![allow(dead_code)]

mod derivative;
mod error;
mod graph;
mod names;
mod operation;
mod parser;
mod sample;
mod tape;
mod token;
mod tree;

pub use error::{PdeError, Problem};
pub use sample::{Batch, LANES, Sample};
