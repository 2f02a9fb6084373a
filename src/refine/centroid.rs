//! Points in the middles of triangles.

use super::{Marks, NewPoint, RefineError, Refinement};
use crate::mesh::TriangleMesh;

/// Joins the centroid of each marked triangle to its corners (thesis, A.1.1): nothing spreads to
/// neighbours, but angles become smaller with every step, and edges are never divided. Needs
/// no state.
///
/// # Errors
/// If a mark is no triangle of the mesh, or a triangle cannot be divided.
pub fn centroid(mesh: &TriangleMesh, marks: &Marks) -> Result<Refinement<3>, RefineError> {
    Marks { state: &[], ..*marks }.check(mesh)?;
    let mut is_divided = vec![false; mesh.triangles().len()];
    let mut room = marks.room(mesh.points().len());
    for &triangle in marks.cells {
        let already = std::mem::replace(&mut is_divided[triangle as usize], room > 0);
        is_divided[triangle as usize] |= already;
        room = room.saturating_sub(usize::from(!already));
    }
    let mut refined = Refinement { points: mesh.points().to_vec(), ..Refinement::default() };
    for (cell, &[a, b, c]) in mesh.triangles().iter().enumerate() {
        let parent = cell as u32;
        if is_divided[cell] {
            let middle = refined.points.len() as u32;
            let at = [1.0 / 3.0; 3];
            refined.points.push(mesh.position(cell, &at));
            refined.new_points.push(NewPoint::Inside { cell: parent, at });
            refined.cells.extend([[a, b, middle], [middle, b, c], [a, middle, c]]);
            refined.parents.extend([parent; 3]);
        } else {
            refined.cells.push([a, b, c]);
            refined.parents.push(parent);
        }
    }
    Ok(refined)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Vector;

    #[test]
    fn one_of_two_by_hand() {
        let points = vec![Vector::zeros(), Vector::x() * 3.0, Vector::y() * 3.0, Vector::x() * 9.0];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [2, 1, 3]]).unwrap();
        let refined = centroid(&mesh, &Marks::all(&[0, 0])).unwrap();
        assert_eq!(refined.cells, [[0, 1, 4], [4, 1, 2], [0, 4, 2], [2, 1, 3]]);
        assert_eq!(refined.parents, [0, 0, 0, 1]);
        assert!((refined.points[4] - Vector::new(1.0, 1.0, 0.0)).norm() < 1e-15);
        let bounded = Marks { max_points: 5, ..Marks::all(&[1, 0]) };
        assert_eq!(centroid(&mesh, &bounded).unwrap().parents, [0, 1, 1, 1]);
    }
}
