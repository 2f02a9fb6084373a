//! The linear interpolant: what VTK contours.

use super::TriangleCubics;
use crate::bernstein::TriangleCubic;
use crate::mesh::TriangleMesh;

/// The linear interpolant of values at the points, for comparison.
#[derive(Clone, Copy, Debug)]
pub struct Linear<'a> {
    mesh: &'a TriangleMesh,
    values: &'a [f64],
}

impl<'a> Linear<'a> {
    /// The linear interpolant of one value a point.
    pub fn new(mesh: &'a TriangleMesh, values: &'a [f64]) -> Self {
        Self { mesh, values }
    }
}

impl TriangleCubics for Linear<'_> {
    fn mesh(&self) -> &TriangleMesh {
        self.mesh
    }

    fn cubic(&self, triangle: usize) -> TriangleCubic {
        let corners = self.mesh.triangles()[triangle];
        TriangleCubic::linear(corners.map(|point| self.values[point as usize]))
    }
}
