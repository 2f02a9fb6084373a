//! Meshes made finer where that is asked for.

mod marks;
mod refinement;

pub use marks::{Marks, RefineError};
pub use refinement::{NewPoint, Refinement};
