//! Differential equations given as text.
// Used by the next commits.
#![allow(dead_code)]

mod error;
mod names;
mod operation;
mod parser;
mod token;
mod tree;

pub use error::{PdeError, Problem};
