//! What values and gradients say of the cubic on a tetrahedron: 16 of its 20
//! coefficients, and a first value for the other four.

use crate::bernstein::{SegmentCubic, TetrahedronCubic, joined};
use crate::field::Field;
use crate::mesh::{TetrahedronMesh, Vector, ascending_corners};

/// What values and gradients at the corners of a tetrahedron say of its cubic: 16 of the 20
/// coefficients.
pub(super) struct Known {
    /// The values at the corners.
    vertices: [f64; 4],
    /// The coefficient beside a corner on its edge to another.
    toward: [[f64; 4]; 4],
}

impl Known {
    /// Between points in any order.
    pub fn new(points: &[u32; 4], positions: &[Vector], field: &Field) -> Self {
        let points = points.map(|point| point as usize);
        let vertices = points.map(|point| field.values[point]);
        let corners = points.map(|point| positions[point]);
        let mut toward = [[0.0; 4]; 4];
        for (from, row) in toward.iter_mut().enumerate() {
            let gradient = &field.gradients[points[from]];
            for to in (0..4).filter(|&to| to != from) {
                row[to] = beside(vertices[from], gradient, &(corners[to] - corners[from]));
            }
        }
        Self { vertices, toward }
    }

    /// The coefficient amid the face between three corners that reproduces quadratics: a quarter
    /// of its edges' coefficients less a sixth of its vertices'. Its bits depend on the order.
    pub fn amid(&self, [a, b, c]: [usize; 3]) -> f64 {
        let edge = |i: usize, j: usize| self.toward[i][j] + self.toward[j][i];
        let edges = edge(a, b) + edge(b, c) + edge(c, a);
        let vertices = self.vertices[a] + self.vertices[b] + self.vertices[c];
        edges / 4.0 - vertices / 6.0
    }

    /// The least and the greatest of the coefficients between two corners; any, if one is not a
    /// number.
    pub fn range_on_edge(&self, i: usize, j: usize) -> [f64; 2] {
        let ends = range_of_two(self.vertices[i], self.vertices[j]);
        joined(ends, range_of_two(self.toward[i][j], self.toward[j][i]))
    }

    /// The cubic with the given coefficients amid the faces opposite to the corners.
    fn cubic(&self, faces: [f64; 4]) -> TetrahedronCubic {
        TetrahedronCubic::assemble(self.vertices, |from, to| self.toward[from][to], faces)
    }
}

/// The lesser and the greater of two numbers.
fn range_of_two(a: f64, b: f64) -> [f64; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The cubic with the field's values and gradients at the vertices, and the given
/// coefficients amid the faces opposite to them.
pub(super) fn hermite(
    mesh: &TetrahedronMesh,
    field: &Field,
    tetrahedron: usize,
    faces: [f64; 4],
) -> TetrahedronCubic {
    Known::new(&mesh.tetrahedra()[tetrahedron], mesh.points(), field).cubic(faces)
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
    // a division takes as long as all the rest, and this is what is computed most
    const THIRD: f64 = 1.0 / 3.0;
    value + gradient.dot(edge) * THIRD
}

/// The cubic that reproduces quadratics.
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
    let known = Known::new(points, positions, field);
    known.cubic(ascending_faces(points).map(|face| known.amid(face)))
}

/// The corners of the face opposite each corner, in ascending order of their points:
/// sums taken in this order have the same bits in both tetrahedra of a face.
pub(super) fn ascending_faces(points: &[u32; 4]) -> [[usize; 3]; 4] {
    let (order, _) = ascending_corners(points);
    let mut faces = [[0; 3]; 4];
    for (opposite, face) in order.into_iter().zip(TetrahedronCubic::FACE_VERTICES) {
        faces[opposite] = face.map(|place| order[place]);
    }
    faces
}
