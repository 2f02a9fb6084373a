//! Meshes made finer where that is asked for.
//!
//! Which cells are to be divided is decided elsewhere; here they are, with as many of their
//! neighbours as it takes for all cells to fit together again. The result says where every
//! cell and every point comes from ([`Refinement`]).

mod refinement;

pub use refinement::{NewPoint, Refinement};
