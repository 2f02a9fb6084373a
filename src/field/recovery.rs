//! Gradients recovered from values: polynomial-preserving recovery.
//!
//! Around each point a polynomial is fitted by least squares to the values at
//! the point's neighbours, passing through the value at the point itself; its
//! slope there is the recovered gradient. If the values are those of a
//! polynomial of the fitted degree, the gradient is exact wherever the mesh
//! determines it: also on the boundary, where the patch simply grows inwards.
//!
//! The slope is a weighted sum of differences of values. The weights tell how wrong it can
//! be, whatever the values: the patch grows until that is little, and a lower degree is
//! taken where it promises a smaller error. So a patch that hardly determines a polynomial
//! (two rows of points on a boundary) cannot make gradients without measure.
//!
//! On tetrahedra the fit is in space; on triangles, over the tangent plane at the
//! point.
//!
//! Source: Z. Zhang, A. Naga, *A new finite element gradient recovery method:
//! superconvergence property*, SIAM J. Sci. Comput. 26 (2005) 1192-1213. Weights
//! and the choice of patch and degree are ours.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::patch::{MAX_RINGS, Patch};
use super::patch_frame::PatchFrame;
use super::polynomial_fit::{PolynomialFit, Samples};
use crate::mesh::{PointNeighbours, SimplexMesh, Vector, plane_axes};

/// The degree of the polynomials that are fitted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RecoveryDegree {
    /// Quadratics: gradients of second order.
    Two = 2,
    /// Cubics: gradients of third order, on larger patches. That is the order
    /// which a cubic interpolant needs.
    #[default]
    Three = 3,
}

/// Gradients at the points of triangles or tetrahedra, recovered from one value a
/// point.
///
/// Where no patch determines the polynomial well, its degree is lowered; a point
/// with no usable neighbour gets the gradient zero, a point whose own value is not
/// finite gets NaN.
pub fn recover_gradients<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    values: &[f64],
    degree: RecoveryDegree,
) -> Vec<Vector> {
    const { assert!(CORNERS == 3 || CORNERS == 4, "triangles or tetrahedra") };
    let neighbours = PointNeighbours::new(mesh);
    let normals = if CORNERS == 3 { point_normals(mesh) } else { Vec::new() };
    let recovery = Recovery { points: mesh.points(), neighbours, values, degree: degree as usize };
    (0..mesh.points().len() as u32)
        .into_par_iter()
        .map_init(Patch::default, |patch, point| {
            if !values[point as usize].is_finite() {
                return Vector::repeat(f64::NAN);
            }
            let axes: ArrayVec<Vector, 3> = match normals.get(point as usize) {
                Some(normal) => plane_axes(normal).into_iter().collect(),
                None => [Vector::x(), Vector::y(), Vector::z()].into(),
            };
            recovery.gradient(patch, point, &axes)
        })
        .collect()
}

/// An error bound below which no better patch is looked for, in the plane and in space.
/// Inside a mesh it is 0.01 to 0.05; on a boundary this much after a ring or two more.
const SMALL_ERROR: [f64; 2] = [0.1, 0.2];

/// A lower degree must promise an error smaller by this for each degree, in the plane and in
/// space: the bound is for a coarse mesh, and on finer ones the higher degree gains.
const WORTH_OF_A_DEGREE: [f64; 2] = [0.2, 0.25];

/// Rings that tell how the mesh is stretched around a point; one may be a sliver's.
const FRAME_RINGS: usize = 2;

/// What gradients are recovered from.
struct Recovery<'a> {
    points: &'a [Vector],
    neighbours: PointNeighbours,
    values: &'a [f64],
    degree: usize,
}

impl Recovery<'_> {
    /// The gradient at a point, in the space of the axes: two in a plane, three in space.
    fn gradient(&self, patch: &mut Patch, point: u32, axes: &[Vector]) -> Vector {
        patch.start(point);
        while patch.rings() < FRAME_RINGS && patch.grow(&self.neighbours) {}
        let frame = self.frame(patch, point, axes);
        let fit = |patch: &Patch, rings: usize, degree: usize| {
            let around = patch.within(rings);
            Samples { points: self.points, values: self.values, centre: point, around }
                .fit(&frame, degree)
        };
        let small = SMALL_ERROR[axes.len() - 2];
        let mut best = None;
        for rings in 1..=MAX_RINGS {
            if rings > patch.rings() && !patch.grow(&self.neighbours) {
                break;
            }
            best = better(best, fit(patch, rings, self.degree));
            if best.is_some_and(|best: PolynomialFit| best.error <= small) {
                return best.map(|best| best.slope).unwrap_or_default();
            }
        }
        for degree in (1..self.degree).rev() {
            let worth = WORTH_OF_A_DEGREE[axes.len() - 2] * (self.degree - degree) as f64;
            for rings in 1..=patch.rings() {
                let fit = fit(patch, rings, degree);
                best = better(best, fit.map(|fit| fit.at_disadvantage(worth)));
            }
        }
        best.map(|best| best.slope).unwrap_or_default()
    }

    fn frame(&self, patch: &Patch, point: u32, axes: &[Vector]) -> PatchFrame {
        let offsets = |rings| {
            let around = patch.within(rings).iter();
            around.map(|&other| self.points[other as usize] - self.points[point as usize])
        };
        PatchFrame::new(offsets(FRAME_RINGS), offsets(1), axes)
    }
}

/// The fit of the smaller error.
fn better(best: Option<PolynomialFit>, other: Option<PolynomialFit>) -> Option<PolynomialFit> {
    match (best, other) {
        (Some(best), Some(other)) if best.error <= other.error => Some(best),
        (best, other) => other.or(best),
    }
}

/// Sums of the normals of the triangles around each point, weighted by area.
/// Triangles are first turned to one side, so that mixed orientations do not
/// cancel.
fn point_normals<const CORNERS: usize>(mesh: &SimplexMesh<CORNERS>) -> Vec<Vector> {
    let mut normals = vec![Vector::zeros(); mesh.points().len()];
    for (triangle, points) in mesh.simplices().iter().enumerate() {
        let corners = mesh.corners(triangle);
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        for &point in points {
            let sum = &mut normals[point as usize];
            *sum += if sum.dot(&normal) < 0.0 { -normal } else { normal };
        }
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{TetrahedronMesh, TriangleMesh};
    use proptest::prelude::*;

    /// An n by n grid of the unit square, its points moved by up to a third of
    /// the spacing, each square cut into two triangles.
    fn shaken_grid(
        n: usize,
        moves: &[f64],
        lift: impl Fn(f64, f64) -> f64,
    ) -> TriangleMesh<'static> {
        let spacing = 1.0 / (n - 1) as f64;
        let point = |i: usize, j: usize| {
            let k = 2 * (i * n + j);
            let x = (i as f64 + moves[k % moves.len()] / 3.0) * spacing;
            let y = (j as f64 + moves[(k + 1) % moves.len()] / 3.0) * spacing;
            Vector::new(x, y, lift(x, y))
        };
        let points = (0..n * n).map(|k| point(k / n, k % n)).collect();
        let mut triangles = Vec::new();
        for i in 0..n - 1 {
            for j in 0..n - 1 {
                let a = (i * n + j) as u32;
                let b = a + n as u32;
                triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
        TriangleMesh::new(points, triangles).unwrap()
    }

    fn check_exact<const CORNERS: usize>(
        mesh: &SimplexMesh<CORNERS>,
        degree: RecoveryDegree,
        u: impl Fn(&Vector) -> f64,
        gradient: impl Fn(&Vector) -> Vector,
    ) {
        let values: Vec<f64> = mesh.points().iter().map(&u).collect();
        let found = recover_gradients(mesh, &values, degree);
        for (point, found) in mesh.points().iter().zip(&found) {
            let exact = gradient(point);
            assert!((found - exact).norm() < 1e-8, "at {point}: {found} is not {exact}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(50))]

        /// At the corners too, unless the mesh is so uneven there that a lower degree
        /// is the better choice: points are moved by up to a fifth of the spacing.
        #[test]
        fn quadratics_are_exact(moves in prop::collection::vec(-0.6..0.6f64, 53), c in prop::array::uniform5(-1.0..1.0f64)) {
            let mesh = shaken_grid(5, &moves, |_, _| 0.0);
            check_exact(
                &mesh,
                RecoveryDegree::Two,
                |p| c[0] * p.x + c[1] * p.y + c[2] * p.x * p.x + c[3] * p.x * p.y + c[4] * p.y * p.y,
                |p| Vector::new(c[0] + 2.0 * c[2] * p.x + c[3] * p.y, c[1] + c[3] * p.x + 2.0 * c[4] * p.y, 0.0),
            );
        }

        #[test]
        fn cubics_are_exact(moves in prop::collection::vec(-0.6..0.6f64, 53), a in -1.0..1.0f64, b in -1.0..1.0f64) {
            let mesh = shaken_grid(6, &moves, |_, _| 0.0);
            check_exact(
                &mesh,
                RecoveryDegree::Three,
                |p| a * p.x * p.x * p.x + b * p.x * p.y * p.y + p.y,
                |p| Vector::new(3.0 * a * p.x * p.x + b * p.y * p.y, 2.0 * b * p.x * p.y + 1.0, 0.0),
            );
        }

        /// On a tilted plane the gradient lies in the plane.
        #[test]
        fn tilted_planes(moves in prop::collection::vec(-1.0..1.0f64, 53), tilt in -2.0..2.0f64) {
            let mesh = shaken_grid(5, &moves, |x, _| tilt * x);
            let along = Vector::new(1.0, 0.0, tilt);
            check_exact(&mesh, RecoveryDegree::Two, |p| p.x, |_| along / along.norm_squared());
        }
    }

    #[test]
    fn one_tetrahedron_gives_its_linear_slope() {
        let points = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let mesh = TetrahedronMesh::new(points, vec![[0, 1, 2, 3]]).unwrap();
        let slope = Vector::new(3.0, -1.0, 0.5);
        check_exact(&mesh, RecoveryDegree::Three, |p| slope.dot(p), |_| slope);
    }

    #[test]
    fn one_triangle_gives_its_linear_slope() {
        let points = vec![Vector::zeros(), Vector::x(), Vector::y()];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        check_exact(
            &mesh,
            RecoveryDegree::Three,
            |p| 3.0 * p.x - p.y,
            |_| Vector::new(3.0, -1.0, 0.0),
        );
    }

    #[test]
    fn a_fan_of_many_triangles_has_bounded_patches() {
        let count = 20_000_u32;
        let angle = |n: u32| 2.0 * std::f64::consts::PI * f64::from(n) / f64::from(count);
        let mut points = vec![Vector::zeros()];
        points.extend((0..count).map(|n| Vector::new(angle(n).cos(), angle(n).sin(), 0.0)));
        let triangles = (0..count).map(|n| [0, 1 + n, 1 + (n + 1) % count]).collect();
        let mesh = TriangleMesh::new(points, triangles).unwrap();
        // all on a circle and its centre: quadratics are not determined, planes are
        let values: Vec<f64> = mesh.points().iter().map(|p| 2.0 * p.x - p.y).collect();
        let found = recover_gradients(&mesh, &values, RecoveryDegree::Three);
        assert!((found[0] - Vector::new(2.0, -1.0, 0.0)).norm() < 1e-9);
    }

    #[test]
    fn missing_values_stay_missing_and_do_not_spread() {
        let mesh = shaken_grid(6, &[0.0], |_, _| 0.0);
        let mut values: Vec<f64> = mesh.points().iter().map(|p| p.x).collect();
        values[14] = f64::NAN;
        let found = recover_gradients(&mesh, &values, RecoveryDegree::Two);
        assert!(found[14].x.is_nan());
        assert!((found[13] - Vector::x()).norm() < 1e-10);
    }
}
