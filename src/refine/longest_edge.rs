//! Longest-edge bisection of triangles.
//!
//! M.-C. Rivara, Algorithms for refining triangular grids suitable for adaptive and multigrid
//! techniques (1984), in the variant in which a half whose whole side is marked is bisected
//! there (thesis, A.1.2): each step divides a triangle into two to four. Angles stay above half
//! of the smallest of the first mesh, however many steps follow (Rosenberg, Stenger 1975).

use rayon::prelude::*;

use super::triangle_bisection::bisect;
use super::{Marks, RefineError, Refinement};
use crate::mesh::TriangleMesh;

/// Bisects the marked triangles across their longest edges. Needs no state.
///
/// # Errors
/// If a mark is no triangle of the mesh, or a triangle cannot be divided.
pub fn longest_edge(mesh: &TriangleMesh, marks: &Marks) -> Result<Refinement<3>, RefineError> {
    Marks { state: &[], ..*marks }.check(mesh)?;
    Ok(Refinement { state: Vec::new(), ..bisect(mesh, &corners_opposite_longest(mesh), marks) })
}

/// The corner opposite the longest edge of each triangle. Of equally long ones that between the
/// greater points is taken, so that triangles never wait for each other in a ring.
pub fn corners_opposite_longest(mesh: &TriangleMesh) -> Vec<u8> {
    let opposite = |points: &[u32; 3]| {
        let rank = |corner: &usize| {
            let [a, b] = [points[(corner + 1) % 3], points[(corner + 2) % 3]];
            let ends = [a.min(b), a.max(b)];
            let [from, to] = ends.map(|end| mesh.points()[end as usize]);
            ((to - from).norm_squared(), ends)
        };
        let longest = (0..3).max_by(|one, other| {
            let (one, other) = (rank(one), rank(other));
            one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
        });
        longest.unwrap_or(0) as u8
    };
    mesh.triangles().par_iter().map(opposite).collect()
}
