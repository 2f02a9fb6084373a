//! Points, triangles and tetrahedra, their geometry and their neighbours.
//!
//! A mesh is plain data: points in space and simplices of point indices. The
//! triangles may lie in any plane or form a curved surface. Everything else
//! (frames, neighbours, boundary edges) is computed from these when needed.

mod boundary;
mod bounding_box;
mod closest_point;
mod corner_order;
mod edges;
mod faces;
mod frame;
mod neighbours;
mod numbered_edges;
mod point_locator;
mod random;
mod refined_mesh;
mod simplex_mesh;
mod subset;
mod tetrahedron_frame;

pub use boundary::boundary_edges;
pub use bounding_box::BoundingBox;
pub(crate) use corner_order::ascending_corners;
pub use edges::Edges;
pub use faces::{Faces, Side};
pub use frame::{TriangleFrame, plane_axes};
pub use neighbours::PointNeighbours;
pub use numbered_edges::NumberedEdges;
pub use point_locator::{Location, PointLocator};
pub(crate) use random::Random;
pub use refined_mesh::{PieceEdge, RefinedMesh, RefinedPiece, RefinedPlace, piece_edges};
pub use simplex_mesh::{MeshError, SimplexMesh, TetrahedronMesh, TriangleMesh};
pub use subset::Subset;
pub use tetrahedron_frame::TetrahedronFrame;

/// A point or a vector in space, in the mesh's unit of length.
pub type Vector = nalgebra::Vector3<f64>;
