//! Interpolants: values, gradients and the PDE become one cubic a cell.
//!
//! Whatever interpolant is chosen, what the floors above read are Bernstein
//! coefficients, by the traits [`TriangleCubics`] and [`TetrahedronCubics`].

mod bent_edges;
mod completion;
mod equation;
mod face_completion;
mod face_equations;
pub mod family;
mod hermite;
mod joint_reach;
mod least_squares;
mod limit;
mod linear;
mod pci;
mod pde_fit;
mod per_cell;
mod pieces;
mod reach;
mod tricubic;

pub use bent_edges::{bent_edges_of_tetrahedron, bent_edges_of_triangle};
pub(crate) use equation::{Collocation, Place};
pub use equation::{Equation, Predictor};
pub use joint_reach::JointReach;
pub use linear::Linear;
pub use pci::{Centres, Pci};
pub use pde_fit::PdeFit;
pub use pieces::{Pieces, Taylor};
pub use reach::{reach_in_tetrahedron, reach_on_triangle};
pub use tricubic::{FaceCoefficients, Tricubic};

use crate::bernstein::{SegmentCubic, TetrahedronCubic, TriangleCubic};
use crate::mesh::{TetrahedronMesh, TriangleMesh};

/// One cubic a triangle, continuous from each triangle to the next.
///
/// The contract that contours rely on: the four coefficients of an edge are the
/// same numbers, to the last bit, in both triangles that share it.
pub trait TriangleCubics: Sync {
    /// The triangles.
    fn mesh(&self) -> &TriangleMesh<'_>;

    /// The cubic on a triangle.
    fn cubic(&self, triangle: usize) -> TriangleCubic;

    /// The values at the corners of a triangle: as [`TriangleCubics::cubic`] has them, to the
    /// last bit.
    fn vertices(&self, triangle: usize) -> [f64; 3] {
        self.cubic(triangle).vertices()
    }
}

/// One cubic a tetrahedron, continuous from each tetrahedron to the next.
///
/// The contract that surfaces rely on: the ten coefficients of a face are the same
/// numbers, to the last bit, in both tetrahedra that share it.
pub trait TetrahedronCubics: Sync {
    /// The tetrahedra.
    fn mesh(&self) -> &TetrahedronMesh<'_>;

    /// The cubic on a tetrahedron, its coefficients in the order of the mesh's corners.
    fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic;

    /// The values at the corners of a tetrahedron: as [`TetrahedronCubics::cubic`] has them, to
    /// the last bit.
    fn vertices(&self, tetrahedron: usize) -> [f64; 4] {
        self.cubic(tetrahedron).vertices()
    }

    /// The cubic on an edge of a tetrahedron, from one corner to another: as
    /// [`TetrahedronCubics::cubic`] has it, to the last bit.
    fn edge(&self, tetrahedron: usize, edge: [usize; 2]) -> SegmentCubic {
        self.cubic(tetrahedron).edge(edge)
    }
}
