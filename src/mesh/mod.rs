//! Points and triangles, their geometry and their neighbours.
//!
//! A mesh is plain data: points in space and simplices of point indices. The
//! triangles may lie in any plane or form a curved surface. Everything else
//! (frames, neighbours, boundary edges) is computed from these when needed.

mod boundary;
mod frame;
mod neighbours;
mod simplex_mesh;

pub use boundary::boundary_edges;
pub use frame::{TriangleFrame, plane_axes};
pub use neighbours::PointNeighbours;
pub use simplex_mesh::{MeshError, SimplexMesh, TetrahedronMesh, TriangleMesh};

/// A point or a vector in space, in the mesh's unit of length.
pub type Vector = nalgebra::Vector3<f64>;
