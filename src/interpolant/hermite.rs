//! What values and gradients say of the cubic on a tetrahedron: 16 of its 20
//! coefficients, and a first value for the other four.

use crate::bernstein::{SegmentCubic, TetrahedronCubic};
use crate::field::Field;
use crate::mesh::{TetrahedronMesh, Vector};

/// The cubic with the field's values and gradients at the vertices, and the given
/// coefficients amid the faces opposite to them.
pub(super) fn hermite(
    mesh: &TetrahedronMesh,
    field: &Field,
    tetrahedron: usize,
    faces: [f64; 4],
) -> TetrahedronCubic {
    hermite_of(&mesh.tetrahedra()[tetrahedron], mesh.points(), field, faces)
}

/// The same between points in any order.
fn hermite_of(
    points: &[u32; 4],
    positions: &[Vector],
    field: &Field,
    faces: [f64; 4],
) -> TetrahedronCubic {
    let points = points.map(|point| point as usize);
    let values = points.map(|point| field.values[point]);
    let corners = points.map(|point| positions[point]);
    let toward = |i: usize, j: usize| {
        let edge = corners[j] - corners[i];
        beside(values[i], &field.gradients[points[i]], &edge)
    };
    TetrahedronCubic::assemble(values, toward, faces)
}

/// The cubic on the edge between two points.
pub(super) fn hermite_on_edge(
    points: [u32; 2],
    positions: &[Vector],
    field: &Field,
) -> SegmentCubic {
    let [a, b] = points.map(|point| point as usize);
    let edge = positions[b] - positions[a];
    SegmentCubic::new([
        field.values[a],
        beside(field.values[a], &field.gradients[a], &edge),
        beside(field.values[b], &field.gradients[b], &-edge),
        field.values[b],
    ])
}

/// The coefficient beside a vertex on an edge that leads away from it.
pub(super) fn beside(value: f64, gradient: &Vector, edge: &Vector) -> f64 {
    value + gradient.dot(edge) / 3.0
}

/// The cubic that reproduces quadratics: amid a face it has a quarter of the face's
/// edge coefficients less a sixth of its vertex coefficients.
pub(super) fn quadratic_precision(
    mesh: &TetrahedronMesh,
    field: &Field,
    tetrahedron: usize,
) -> TetrahedronCubic {
    quadratic_precision_of(&mesh.tetrahedra()[tetrahedron], mesh.points(), field)
}

/// The same between points in any order.
pub(super) fn quadratic_precision_of(
    points: &[u32; 4],
    positions: &[Vector],
    field: &Field,
) -> TetrahedronCubic {
    let mut cubic = hermite_of(points, positions, field, [0.0; 4]);
    let vertex = cubic.vertices();
    for (position, [a, b, c]) in TetrahedronCubic::FACES.into_iter().zip(ascending_faces(points)) {
        let edge = |i: usize, j: usize| {
            let [_, near, far, _] = cubic.edge([i, j]).coefficients;
            near + far
        };
        let edges = edge(a, b) + edge(b, c) + edge(c, a);
        let vertices = vertex[a] + vertex[b] + vertex[c];
        cubic.coefficients[position] = edges / 4.0 - vertices / 6.0;
    }
    cubic
}

/// The corners of the face opposite each corner, in ascending order of their points:
/// sums taken in this order have the same bits in both tetrahedra of a face.
pub(super) fn ascending_faces(points: &[u32; 4]) -> [[usize; 3]; 4] {
    let mut order = [0, 1, 2, 3];
    order.sort_unstable_by_key(|&corner| points[corner]);
    let mut faces = [[0; 3]; 4];
    for (opposite, face) in order.into_iter().zip(TetrahedronCubic::FACE_VERTICES) {
        faces[opposite] = face.map(|place| order[place]);
    }
    faces
}
