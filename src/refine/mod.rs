//! Meshes made finer where that is asked for.

pub mod delaunay;
mod marks;
mod refinement;

pub use marks::{Marks, RefineError};
pub use refinement::{NewPoint, Refinement};
