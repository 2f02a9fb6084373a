//! Where the cubics of several cells together may go, in a fraction of the time that the reach of
//! each takes ([`super::reach_in_tetrahedron`]).
//!
//! Along an edge a gradient says no more than the sum of its components times those of the edge, all
//! taken absolute. So the greatest components of gradients and of edges bound all coefficients.
//! What is left to do for a cell is to look for the greatest.
//!
//! Source: ours.

use std::ops::Range;

use crate::bernstein::{TetrahedronCubic, TriangleCubic, joined, value_bounds};
use crate::field::Field;
use crate::mesh::SimplexMesh;

/// What bounds the cubics of some triangles or tetrahedra together.
#[derive(Clone, Copy, Debug)]
pub struct JointReach {
    /// Between which numbers the cubics of all are; beyond by some units, where these are smaller than
    /// normal numbers.
    pub range: [f64; 2],
    /// The least and the greatest value at a vertex.
    pub at_vertices: [f64; 2],
}

/// Numbers below this stay finite in all that is computed of them.
const LARGE: f64 = 1e300;

/// What is computed of values and differences, in another order, differs by less than this part of
/// the greatest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl JointReach {
    /// That of the given cells; nothing if the cubic of any of them may not be finite.
    pub fn new<const CORNERS: usize>(
        mesh: &SimplexMesh<CORNERS>,
        field: &Field,
        cells: Range<usize>,
    ) -> Option<Self> {
        let mut greatest = Greatest::none();
        for corners in &mesh.simplices()[cells] {
            greatest.include(mesh, field, corners.map(|point| point as usize));
        }
        let range = greatest.range(match CORNERS {
            3 => TriangleCubic::SHARE_OF_CENTRE,
            _ => TetrahedronCubic::SHARE_OF_FACES,
        });
        let is_finite = greatest.sum.iter().all(|sum| sum.is_finite());
        (is_finite && range[0] > -LARGE && range[1] < LARGE)
            .then_some(Self { range, at_vertices: greatest.vertices })
    }
}

/// What is greatest in some cells.
struct Greatest {
    /// The least and the greatest value at a vertex.
    vertices: [f64; 2],
    /// The most that the values at the vertices of one cell differ by.
    difference: f64,
    /// The greatest extent of a cell along each axis.
    extents: [f64; 3],
    /// The greatest component of a gradient along each axis.
    gradients: [f64; 3],
    /// Not finite if anything is not, which comparisons do not tell.
    sum: [f64; 3],
}

impl Greatest {
    fn none() -> Self {
        Self {
            vertices: [f64::INFINITY, f64::NEG_INFINITY],
            difference: 0.0,
            extents: [0.0; 3],
            gradients: [0.0; 3],
            sum: [0.0; 3],
        }
    }

    #[inline]
    fn include<const CORNERS: usize>(
        &mut self,
        mesh: &SimplexMesh<CORNERS>,
        field: &Field,
        corners: [usize; CORNERS],
    ) {
        let [mut least, mut greatest] = [field.values[corners[0]]; 2];
        let [mut lower, mut upper] = [mesh.points()[corners[0]]; 2];
        for point in corners {
            let (value, position) = (field.values[point], &mesh.points()[point]);
            let gradient = &field.gradients[point];
            [least, greatest] = joined([least, greatest], [value, value]);
            for axis in 0..3 {
                let (x, slope) = (position[axis], gradient[axis].abs());
                [lower[axis], upper[axis]] = joined([lower[axis], upper[axis]], [x, x]);
                self.gradients[axis] = greater(self.gradients[axis], slope);
                self.sum[axis] += slope + x + value;
            }
        }
        self.vertices = joined(self.vertices, [least, greatest]);
        self.difference = greater(self.difference, greatest - least);
        for axis in 0..3 {
            self.extents[axis] = greater(self.extents[axis], upper[axis] - lower[axis]);
        }
    }

    /// Between which numbers the cubics are, where coefficients amid triangles count for no more than
    /// a `share`.
    fn range(&self, share: f64) -> [f64; 2] {
        let [low, high] = self.vertices;
        // by how much a coefficient beside a vertex differs from it
        let step = (0..3).map(|axis| self.gradients[axis] * self.extents[axis]).sum::<f64>() / 3.0;
        // The coefficient amid a triangle is the mean of its vertices and a quarter of six steps, and
        // neighbours move it by no more than the others differ by.
        let amid = 1.5 * step + (self.difference + 2.0 * step);
        let [low, high] = value_bounds([low - step, high + step], [low - amid, high + amid], share);
        let rounding = ROUNDING * low.abs().max(high.abs());
        [low - rounding, high + rounding]
    }
}

/// The greater of two numbers.
fn greater(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{TetrahedronMesh, TriangleMesh, Vector};

    /// Unit right-angled simplices side by side, with these values and one gradient.
    fn reach<const CORNERS: usize>(
        simplices: Vec<[u32; CORNERS]>,
        values: [f64; 5],
        gradient: Vector,
    ) -> Option<JointReach> {
        let units = [Vector::zeros(), Vector::x(), Vector::y(), Vector::z(), -Vector::x()];
        let mesh = SimplexMesh::new(units.to_vec(), simplices).unwrap();
        let field = Field { values: &values, gradients: &[gradient; 5] };
        JointReach::new(&mesh, &field, 0..mesh.simplices().len())
    }

    fn is_near([low, high]: [f64; 2], expected: [f64; 2]) -> bool {
        (low - expected[0]).abs() < 1e-12 && (high - expected[1]).abs() < 1e-12
    }

    #[test]
    fn reaches_by_hand() {
        let values = [1.0, 3.0, 2.0, 0.0, 5.0];
        let gradient = Vector::new(3.0, -6.0, 1.5);
        // a step is 3; values of one triangle differ by 4; amid it are 4 + 3.5 times 3 beyond
        let plane = reach(vec![[0, 1, 2], [0, 2, 4]], values, gradient).unwrap();
        assert_eq!(plane.at_vertices, [1.0, 5.0]);
        let beyond = 3.0 + 0.2223 * (4.0 + 2.5 * 3.0);
        assert!(is_near(plane.range, [1.0 - beyond, 5.0 + beyond]), "{plane:?}");
        // a step is 3.5; values of one tetrahedron differ by 5
        let solid = reach(vec![[0, 1, 2, 3], [0, 2, 4, 3]], values, gradient).unwrap();
        let beyond = 3.5 + 0.375 * (5.0 + 2.5 * 3.5);
        assert!(is_near(solid.range, [-beyond, 5.0 + beyond]), "{solid:?}");
    }

    #[test]
    fn there_is_none_where_a_number_is_not_finite() {
        let ones = [1.0; 5];
        assert!(reach(vec![[0, 1, 2]], ones, Vector::x()).is_some());
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX] {
            for place in 0..3 {
                let (mut values, mut gradient) = (ones, Vector::zeros());
                (values[place], gradient[place]) = (wrong, wrong);
                assert!(reach(vec![[3, 4, 0], [0, 1, 2]], values, Vector::x()).is_none());
                assert!(reach(vec![[0, 1, 2]], ones, gradient).is_none());
            }
        }
        let far = |n| if n == 2 { Vector::repeat(f64::NAN) } else { Vector::x() * f64::from(n) };
        let points: Vec<Vector> = (0..4).map(far).collect();
        let field = Field { values: &ones[..4], gradients: &[Vector::zeros(); 4] };
        let mesh = TriangleMesh::new(points.clone(), vec![[0, 1, 2]]).unwrap();
        assert!(JointReach::new(&mesh, &field, 0..1).is_none());
        let mesh = TetrahedronMesh::new(points, vec![[2, 0, 1, 3]]).unwrap();
        assert!(JointReach::new(&mesh, &field, 0..1).is_none());
    }
}
