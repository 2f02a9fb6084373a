//! The linear interpolant: what VTK contours.

use super::hermite::ascending_faces;
use super::{TetrahedronCubics, TriangleCubics};
use crate::bernstein::{TetrahedronCubic, TriangleCubic};
use crate::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh};

/// The linear interpolant of values at the points of triangles or tetrahedra, for
/// comparison.
#[derive(Clone, Copy, Debug)]
pub struct Linear<'a, const CORNERS: usize> {
    mesh: &'a SimplexMesh<'a, CORNERS>,
    values: &'a [f64],
}

impl<'a, const CORNERS: usize> Linear<'a, CORNERS> {
    /// The linear interpolant of one value a point.
    pub fn new(mesh: &'a SimplexMesh<'a, CORNERS>, values: &'a [f64]) -> Self {
        Self { mesh, values }
    }

    /// The values at the corners of a simplex.
    fn corner_values(&self, simplex: usize) -> [f64; CORNERS] {
        self.mesh.simplices()[simplex].map(|point| self.values[point as usize])
    }
}

impl TriangleCubics for Linear<'_, 3> {
    fn mesh(&self) -> &TriangleMesh<'_> {
        self.mesh
    }

    fn cubic(&self, triangle: usize) -> TriangleCubic {
        TriangleCubic::linear(self.corner_values(triangle))
    }

    fn vertices(&self, triangle: usize) -> [f64; 3] {
        self.corner_values(triangle)
    }
}

impl TetrahedronCubics for Linear<'_, 4> {
    fn mesh(&self) -> &TetrahedronMesh<'_> {
        self.mesh
    }

    fn cubic(&self, tetrahedron: usize) -> TetrahedronCubic {
        let values = self.corner_values(tetrahedron);
        let toward = |i: usize, j: usize| (2.0 * values[i] + values[j]) / 3.0;
        let faces = ascending_faces(&self.mesh.tetrahedra()[tetrahedron])
            .map(|[a, b, c]| (values[a] + values[b] + values[c]) / 3.0);
        TetrahedronCubic::assemble(values, toward, faces)
    }

    fn vertices(&self, tetrahedron: usize) -> [f64; 4] {
        self.corner_values(tetrahedron)
    }
}
