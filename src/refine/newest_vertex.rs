//! Newest-vertex bisection of triangles.
//!
//! E. G. Sewell (1972), with the closure of W. F. Mitchell (1991) (thesis, A.1.4). A triangle is
//! bisected opposite its newest point, so all triangles that come of one have one of four shapes.
//! At the beginning the corner opposite the longest edge counts as the newest.

use super::longest_edge::corners_opposite_longest;
use super::triangle_bisection::bisect;
use super::{Marks, RefineError, Refinement};
use crate::mesh::TriangleMesh;

/// Bisects the marked triangles opposite their newest points.
///
/// The state is the newest corner of each triangle. Without it the step begins anew with
/// longest edges: then angles may be halved once more than the first time.
///
/// # Errors
/// If a mark is no triangle of the mesh, the state does not fit it, or a triangle cannot be
/// divided.
pub fn newest_vertex(mesh: &TriangleMesh, marks: &Marks) -> Result<Refinement<3>, RefineError> {
    marks.check(mesh)?;
    if marks.state.is_empty() {
        return Ok(bisect(mesh, &corners_opposite_longest(mesh), marks));
    }
    let corner = |&state: &u16| u8::try_from(state).ok().filter(|&corner| corner < 3);
    let newest: Option<Vec<u8>> = marks.state.iter().map(corner).collect();
    Ok(bisect(mesh, &newest.ok_or(RefineError::State)?, marks))
}
