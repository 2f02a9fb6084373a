//! A solution at the points of a mesh: values and gradients.
//!
//! Gradients come from the solver, or are recovered from the values
//! ([`recover_gradients`]) where the file has none.

mod patch;
mod patch_frame;
mod polynomial_fit;
mod recovery;

pub use recovery::{RecoveryDegree, recover_gradients};

use crate::mesh::Vector;

/// Values and gradients at the points of a mesh, one of each a point.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// The value at each point, in the solution's unit.
    pub values: &'a [f64],
    /// The gradient at each point, per unit of length. On a surface in space
    /// only its tangential part is used.
    pub gradients: &'a [Vector],
}
