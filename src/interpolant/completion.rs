//! The coefficient of a triangle that values and gradients leave free, from those of the
//! neighbours.
//!
//! Nine of the ten coefficients of a cubic are values and gradients at the vertices. The
//! tenth, `b_111`, is here the one with which the cubic, continued beyond an edge, has the
//! neighbour's gradient at its far point. If the data are those of one cubic, all
//! neighbours say the same and are right; else the mean counts, those most that lie in
//! reach. The error of such a cubic is of fourth order on meshes whose triangles keep
//! their shape, one order more than that of quadratic precision.
//!
//! Let `q` be the far point and `μ` its barycentric coordinates in the triangle `a b c`,
//! beyond the edge `a b`. The blossom of the cubic at `(a, q, q)` is the coefficient next
//! to `q` on the edge from `q` to `a`, which is known from value and gradient at `q`. It
//! is linear in `b_111`, with the factor `2 μ_b μ_c`. So each edge gives two equations.
//!
//! Where the mesh is so coarse that the equations contradict each other, they say little,
//! and the mean is taken for as much of the way from quadratic precision as they agree.
//! For one cubic they agree to rounding, and the way is gone as a whole.
//!
//! All is said in barycentric coordinates, so a stretched mesh gives the same; triangles
//! on a curved surface are unfolded about their common edge.
//!
//! Source: ours.

use crate::bernstein::{Barycentric, TriangleCubic};
use crate::field::Field;
use crate::mesh::{Edges, TriangleMesh, Vector};

/// One linear equation, `factor · x = right`, for what is to be added to `b_111`.
#[derive(Clone, Copy, Debug, Default)]
struct Equation {
    factor: f64,
    right: f64,
    weight: f64,
}

/// Half the power of the distance with which equations lose weight: their errors are
/// those of a cubic continued so far, thus of fourth order.
const ORDER: i32 = 4;

/// How much the doubt counts that equations raise by contradiction. With half of it, one
/// of 360 random meshes more has a greater error than by quadratic precision; with twice
/// as much, good meshes lose.
const DOUBT: f64 = 2.0;

/// What to add to the `b_111` of `start`, the cubic of a triangle that reproduces
/// quadratics, so that cubics are reproduced; zero where there are no neighbours.
pub(super) fn centre_correction(
    mesh: &TriangleMesh,
    field: &Field,
    edges: &Edges,
    triangle: usize,
    start: &TriangleCubic,
) -> f64 {
    let mut equations = [Equation::default(); 6];
    for corner in 0..3 {
        if let Some(point) = edges.point_beyond(triangle, corner) {
            let pair = continuation(mesh, field, triangle, corner, point, start);
            equations[2 * corner..][..2].copy_from_slice(&pair);
        }
    }
    weighed_mean(&equations)
}

/// The two equations of the point beyond the edge opposite a corner; of weight zero if
/// they are not finite.
fn continuation(
    mesh: &TriangleMesh,
    field: &Field,
    triangle: usize,
    corner: usize,
    point: u32,
    start: &TriangleCubic,
) -> [Equation; 2] {
    let corners = mesh.corners(triangle);
    let far = mesh.points()[point as usize];
    let (value, gradient) = (field.values[point as usize], field.gradients[point as usize]);
    let at = unfolded(&corners, corner, &far);
    let continued = start.barycentric_gradient(&at).map(|derivative| derivative / 3.0);
    let distance = 1.0 + at.iter().map(|weight| weight.abs()).sum::<f64>();
    let ends = [(corner + 1) % 3, (corner + 2) % 3];
    [ends, [ends[1], ends[0]]].map(|[end, other]| {
        let known = value + gradient.dot(&(corners[end] - far)) / 3.0;
        let factor = 2.0 * at[other] * at[corner];
        let (right, weight) = (known - continued[end], distance.powi(-2 * ORDER));
        let finite = right.is_finite() && (weight * factor * factor).is_finite();
        if finite { Equation { factor, right, weight } } else { Equation::default() }
    })
}

/// Barycentric coordinates of a point beyond the edge opposite a corner, turned about that
/// edge into the triangle's plane.
fn unfolded(corners: &[Vector; 3], corner: usize, far: &Vector) -> Barycentric {
    let [start, end] = [(corner + 1) % 3, (corner + 2) % 3];
    let edge = corners[end] - corners[start];
    let along = edge / edge.norm_squared();
    let place = |point: &Vector| {
        let offset = point - corners[start];
        let part = offset.dot(&along);
        (part, (offset - edge * part).norm())
    };
    let ((near_part, near_height), (far_part, far_height)) = (place(&corners[corner]), place(far));
    let mut at = [0.0; 3];
    at[corner] = -far_height / near_height;
    at[end] = far_part - at[corner] * near_part;
    at[start] = 1.0 - at[corner] - at[end];
    at
}

/// The least-squares solution, less what the equations contradict each other.
fn weighed_mean(equations: &[Equation; 6]) -> f64 {
    let sum = |term: &dyn Fn(&Equation) -> f64| equations.iter().map(term).sum::<f64>();
    let information = |e: &Equation| e.weight * e.factor * e.factor;
    let all = sum(&information);
    let mean = sum(&|e| e.weight * e.factor * e.right) / all;
    // relative to the mean, so that no square of a value leaves the range of numbers
    let contradiction = sum(&|e| e.weight * (e.right / mean - e.factor).powi(2)) / all;
    // as if there were so many equations, all of the same weight
    let count = all * all / sum(&|e| information(e).powi(2));
    let variance = contradiction / (count - 1.0).max(ROUNDING);
    let corrected = mean / (1.0 + DOUBT * variance);
    if corrected.is_finite() { corrected } else { 0.0 }
}

/// One equation alone is not contradicted by rounding.
const ROUNDING: f64 = 1e-9;
