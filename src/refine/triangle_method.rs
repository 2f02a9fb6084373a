//! Ways to refine triangles.

use super::centroid::centroid;
use super::longest_edge::longest_edge;
use super::newest_vertex::newest_vertex;
use super::red_green::red_green;
use super::{Marks, RefineError, Refinement};
use crate::mesh::TriangleMesh;

/// A way to refine triangles, in the plane or on a surface in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TriangleMethod {
    /// Bisection across the longest edge: no angle falls below half of the smallest of the
    /// first mesh. The bound on points is met exactly.
    #[default]
    LongestEdge,
    /// Bisection opposite the newest point: triangles of four shapes for each of the first mesh,
    /// and no angle below half of its smallest. The bound on points is met exactly.
    NewestVertex,
    /// Division in four: triangles similar to those of the first mesh, or halves of such. For
    /// the last points under a bound, single edges of marked triangles are halved, so that it is
    /// met exactly but on meshes of a few triangles.
    RedGreen,
    /// A point in the middle of each triangle: angles become ever smaller.
    Centroid,
}

impl TriangleMethod {
    /// Refines the marked triangles.
    ///
    /// # Errors
    /// If a mark is no triangle of the mesh, the state is not that of this mesh, or a triangle
    /// has points that are not finite or one of them twice.
    pub fn refine(self, mesh: &TriangleMesh, marks: &Marks) -> Result<Refinement<3>, RefineError> {
        match self {
            Self::LongestEdge => longest_edge(mesh, marks),
            Self::NewestVertex => newest_vertex(mesh, marks),
            Self::RedGreen => red_green(mesh, marks),
            Self::Centroid => centroid(mesh, marks),
        }
    }
}
