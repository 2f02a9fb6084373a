//! The coefficients of tetrahedra that values and gradients leave free, from those of the
//! neighbours.
//!
//! Sixteen of the twenty coefficients of a cubic are values and gradients at the vertices.
//! The other four, one amid each face, are first those with which the cubic, continued
//! beyond its faces, fits the gradients at the neighbours' far points best, by least
//! squares. That is [`super::completion`] in space: let `q` be the far point and `μ` its
//! barycentric coordinates in the tetrahedron `a b c d`, beyond the face `a b c`. The
//! blossom of the cubic at `(a, q, q)` is the coefficient next to `q` on the edge from `q`
//! to `a`, which is known. It is linear in the coefficients amid the faces at `a`, with
//! factors such as `2 μ_b μ_c` for the face `a b c`. So each neighbour gives three
//! equations, and its value, the blossom at `(q, q, q)`, a fourth. That one matters only
//! where the others leave something open. On the boundary the neighbours' neighbours
//! serve as well; without them the corner of a cube is not determined.
//!
//! Both tetrahedra of a face then have a coefficient for it, and the face takes their
//! mean, weighed by how well each is determined, and within the limits of
//! [`super::limit`]. So the interpolant is continuous. If the data are those of one cubic,
//! all are right. The error is of fourth order on meshes whose tetrahedra keep their shape.
//!
//! What a face takes depends on its tetrahedra and their neighbours alone.
//!
//! Source: ours.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::hermite::quadratic_precision_of;
use super::limit::limited;
use super::per_cell::PerCell;
use crate::bernstein::{Barycentric4, TetrahedronCubic};
use crate::field::Field;
use crate::mesh::{
    Faces, Side, Subset, TetrahedronFrame, TetrahedronMesh, Vector, ascending_corners,
};

/// What a tetrahedron says of each of its faces, by the opposite corner.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Estimate {
    /// What is to be added to the coefficients that reproduce quadratics.
    corrections: [f64; 4],
    /// How well each is determined: the inverse of its variance.
    weights: [f64; 4],
}

/// Half the power of the distance with which equations lose weight. The fourth would be
/// as good; this one bears badly wrong gradients better.
const ORDER: i32 = 3;

/// The weight of a value beside that of a gradient.
const VALUE: f64 = 0.01;

/// A part of the diagonal that is added, so that equations which determine less than four
/// numbers determine those of least size.
const ROUNDING: f64 = 1e-13;

/// Faces that are treated at a time: what their tetrahedra say need not be kept for the whole mesh
/// then. Most tetrahedra have all their faces in one block; the others are asked again.
const BLOCK: usize = 1 << 15;

/// For each face of the tetrahedra that are wanted, what is to be added to the coefficient that
/// reproduces quadratics; no more than the face's other coefficients differ by. `estimate` is what
/// a tetrahedron that has a wanted one, or is one, says.
pub(super) fn face_corrections(
    mesh: &TetrahedronMesh,
    field: &Field,
    faces: &Faces,
    is_wanted: impl Fn(usize) -> bool + Sync,
    estimate: impl Fn(usize) -> Estimate + Sync,
) -> PerCell<f64> {
    let has_wanted = |face| faces.sides(face).iter().any(|side| is_wanted(side.tetrahedron()));
    let wanted = Subset::new(faces.count(), has_wanted);
    let mut corrections = vec![0.0; wanted.len()];
    let mut numbers = wanted.simplices();
    let (mut block, mut listed) = (Vec::new(), Listed::new(mesh));
    for corrections in corrections.chunks_mut(BLOCK) {
        block.clear();
        block.extend(numbers.by_ref().take(corrections.len()).map(|face| face as u32));
        listed.list(block.iter().flat_map(|&face| faces.sides(face as usize)));
        let tetrahedra = listed.tetrahedra.par_iter();
        let estimates: Vec<Estimate> =
            tetrahedra.map(|&tetrahedron| estimate(tetrahedron as usize)).collect();
        let of_side = |side: &Side| &estimates[listed.places[side.tetrahedron()] as usize];
        corrections.par_iter_mut().zip(&block).for_each(|(correction, &face)| {
            let sides = faces.sides(face as usize);
            let mean = mean_of_sides(sides, of_side);
            *correction = limited(mean, &sides[0].face(mesh), mesh.points(), field);
        });
    }
    drop(numbers);
    let are_all = wanted.len() == faces.count();
    if are_all { PerCell::All(corrections) } else { PerCell::Some(wanted, corrections) }
}

/// Some tetrahedra of a mesh, each with its place in the list.
struct Listed {
    tetrahedra: Vec<u32>,
    /// Of those in the list; the others have any number.
    places: Vec<u32>,
}

impl Listed {
    fn new(mesh: &TetrahedronMesh) -> Self {
        Self { tetrahedra: Vec::new(), places: vec![0; mesh.tetrahedra().len()] }
    }

    /// Lists those with these sides, instead of what was listed before.
    fn list<'a>(&mut self, sides: impl Iterator<Item = &'a Side>) {
        self.tetrahedra.clear();
        for tetrahedron in sides.map(|side| side.tetrahedron()) {
            let place = &mut self.places[tetrahedron];
            if self.tetrahedra.get(*place as usize) != Some(&(tetrahedron as u32)) {
                *place = self.tetrahedra.len() as u32;
                self.tetrahedra.push(tetrahedron as u32);
            }
        }
    }
}

/// The mean of what the tetrahedra at a face say; zero if none says anything.
fn mean_of_sides<'a>(sides: &[Side], estimate: impl Fn(&Side) -> &'a Estimate) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for side in sides {
        let estimate = estimate(side);
        let weight = estimate.weights[side.opposite()];
        sum += weight * estimate.corrections[side.opposite()];
        weights += weight;
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

/// The corrections that continue a tetrahedron's cubic into its neighbours'.
///
/// Sums are taken in the order of points' numbers, so that no bit depends on that of corners.
pub(super) fn estimate(
    mesh: &TetrahedronMesh,
    field: &Field,
    faces: &Faces,
    tetrahedron: usize,
) -> Estimate {
    let points = mesh.tetrahedra()[tetrahedron];
    let (order, _) = ascending_corners(&points);
    let points = order.map(|corner| points[corner]);
    let frame = TetrahedronFrame::new(points.map(|point| mesh.points()[point as usize]));
    if frame.is_degenerate() {
        return Estimate::default();
    }
    let start = quadratic_precision_of(&points, mesh.points(), field);
    let mut equations = NormalEquations::default();
    let beyond = order.map(|corner| faces.beyond(mesh, tetrahedron, corner));
    for (opposite, side) in beyond.iter().enumerate() {
        if let Some(side) = side {
            let far = FarPoint::new(mesh, field, side.point(mesh));
            far.add_to(&mut equations, &frame, &start, Some(opposite));
        }
    }
    if beyond.contains(&None) {
        for point in further_points(mesh, faces, &beyond) {
            FarPoint::new(mesh, field, point).add_to(&mut equations, &frame, &start, None);
        }
    }
    let sorted = equations.solve();
    let mut estimate = Estimate::default();
    for (place, corner) in order.into_iter().enumerate() {
        estimate.corrections[corner] = sorted.corrections[place];
        estimate.weights[corner] = sorted.weights[place];
    }
    estimate
}

/// Whether there is a face of a tetrahedron beyond which there is no other: then it asks its
/// neighbours' neighbours, too.
pub(super) fn asks_further(mesh: &TetrahedronMesh, faces: &Faces, tetrahedron: usize) -> bool {
    (0..4).any(|corner| faces.beyond(mesh, tetrahedron, corner).is_none())
}

/// The points beyond the other faces of the neighbours, ascending: on the boundary
/// neighbours are few.
fn further_points(
    mesh: &TetrahedronMesh,
    faces: &Faces,
    beyond: &[Option<Side>; 4],
) -> ArrayVec<u32, 12> {
    let mut points = ArrayVec::new();
    for neighbour in beyond.iter().flatten() {
        for opposite in (0..4).filter(|&n| n != neighbour.opposite()) {
            let side = faces.beyond(mesh, neighbour.tetrahedron(), opposite);
            points.extend(side.map(|side| side.point(mesh)));
        }
    }
    points.sort_unstable();
    points
}

/// A point beyond a face, with its data.
struct FarPoint {
    position: Vector,
    value: f64,
    gradient: Vector,
}

impl FarPoint {
    fn new(mesh: &TetrahedronMesh, field: &Field, point: u32) -> Self {
        let point = point as usize;
        let (value, gradient) = (field.values[point], field.gradients[point]);
        Self { position: mesh.points()[point], value, gradient }
    }

    /// Adds the equations by which the cubic `start` continues to this point: for all
    /// corners but the one opposite the face between, if only one is.
    fn add_to(
        &self,
        equations: &mut NormalEquations,
        frame: &TetrahedronFrame,
        start: &TetrahedronCubic,
        opposite: Option<usize>,
    ) {
        let at = frame.barycentric(&self.position);
        if !self.is_finite() || at.iter().any(|weight| !weight.is_finite()) {
            return;
        }
        let continued = start.blossoms(&at);
        let third = self.gradient / 3.0;
        let distance = 1.0 + at.iter().map(|weight| weight.abs()).sum::<f64>();
        let weight = distance.powi(-2 * ORDER);
        for (end, corner) in frame.corners().iter().enumerate() {
            if Some(end) != opposite {
                let known = self.value + third.dot(&(corner - self.position));
                equations.add(weight, &factors(&at, end), known - continued[end]);
            }
        }
        let continued_value: f64 = at.iter().zip(continued).map(|(at, end)| at * end).sum();
        // the sum of the corners' factors, weighed likewise
        let of_value = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]
            .map(|[i, j, k]: [usize; 3]| 6.0 * at[i] * at[j] * at[k]);
        equations.add(VALUE * weight, &of_value, self.value - continued_value);
    }

    fn is_finite(&self) -> bool {
        self.value.is_finite() && self.gradient.iter().all(|slope| slope.is_finite())
    }
}

/// The factors of the coefficients amid the faces, by their opposite corners, in the
/// blossom at a corner and twice a place.
fn factors(at: &Barycentric4, corner: usize) -> [f64; 4] {
    let [a, b, c, d] = *at;
    match corner {
        0 => [0.0, 2.0 * c * d, 2.0 * b * d, 2.0 * b * c],
        1 => [2.0 * c * d, 0.0, 2.0 * a * d, 2.0 * a * c],
        2 => [2.0 * b * d, 2.0 * a * d, 0.0, 2.0 * a * b],
        _ => [2.0 * b * c, 2.0 * a * c, 2.0 * a * b, 0.0],
    }
}

/// Linear equations for four numbers, gathered for their least-squares solution.
#[derive(Clone, Copy, Debug, Default)]
struct NormalEquations {
    /// Rows; nothing above the diagonal.
    matrix: [[f64; 4]; 4],
    right: [f64; 4],
}

impl NormalEquations {
    /// Adds an equation.
    fn add(&mut self, weight: f64, factors: &[f64; 4], right: f64) {
        for (i, row) in self.matrix.iter_mut().enumerate() {
            let weighed = weight * factors[i];
            for (entry, factor) in row[..=i].iter_mut().zip(factors) {
                *entry += weighed * factor;
            }
            self.right[i] += weighed * right;
        }
    }

    /// The solution; a face that no equation knows stays where it is.
    fn solve(mut self) -> Estimate {
        let known = [0, 1, 2, 3].map(|n| self.matrix[n][n] > 0.0);
        for (n, &known) in known.iter().enumerate() {
            let entry = &mut self.matrix[n][n];
            *entry = if known { *entry * (1.0 + ROUNDING) } else { 1.0 };
        }
        let Some(inverse) = Inverse::new(&self.matrix) else { return Estimate::default() };
        let corrections = inverse.times(&self.right);
        let variances = inverse.diagonal();
        let weights = [0, 1, 2, 3].map(|n| if known[n] { 1.0 / variances[n] } else { 0.0 });
        let finite = corrections.iter().chain(&weights).all(|x| x.is_finite());
        if finite { Estimate { corrections, weights } } else { Estimate::default() }
    }
}

/// The inverse of a symmetric positive matrix, `Nᵀ D N`.
struct Inverse {
    /// What is below the diagonal of `N`, row by row: `N` is one on the diagonal, zero above.
    lower: [f64; 6],
    /// The diagonal of `D`.
    diagonal: [f64; 4],
}

impl Inverse {
    /// The inverse of a matrix, of which nothing above the diagonal is looked at; nothing if it
    /// is not positive.
    ///
    /// `L D⁻¹ Lᵀ` is the matrix, with `N` the inverse of `L`: written out, for there are many.
    fn new(matrix: &[[f64; 4]; 4]) -> Option<Self> {
        let [[a, ..], [b, c, ..], [d, e, f, _], [g, h, i, j]] = *matrix;
        let first = 1.0 / a;
        let (l10, l20, l30) = (b * first, d * first, g * first);
        let (e, h) = (e - l20 * b, h - l30 * b);
        let second_pivot = c - l10 * b;
        let second = 1.0 / second_pivot;
        let (l21, l31) = (e * second, h * second);
        let i = i - l30 * d - l31 * e;
        let third_pivot = f - l20 * d - l21 * e;
        let third = 1.0 / third_pivot;
        let l32 = i * third;
        let fourth_pivot = j - l30 * g - l31 * h - l32 * i;
        let pivots = [a, second_pivot, third_pivot, fourth_pivot];
        if !pivots.iter().all(|&pivot| pivot > 0.0) {
            return None;
        }
        let n20 = l21 * l10 - l20;
        let n30 = l31 * l10 - l32 * n20 - l30;
        let n31 = l32 * l21 - l31;
        let lower = [-l10, n20, -l21, n30, n31, -l32];
        Some(Self { lower, diagonal: [first, second, third, 1.0 / fourth_pivot] })
    }

    /// The product with a vector.
    fn times(&self, [a, b, c, d]: &[f64; 4]) -> [f64; 4] {
        let ([n10, n20, n21, n30, n31, n32], [first, second, third, fourth]) =
            (self.lower, self.diagonal);
        let x = first * a;
        let y = second * (n10 * a + b);
        let z = third * (n20 * a + n21 * b + c);
        let w = fourth * (n30 * a + n31 * b + n32 * c + d);
        [x + n10 * y + n20 * z + n30 * w, y + n21 * z + n31 * w, z + n32 * w, w]
    }

    /// Its diagonal.
    fn diagonal(&self) -> [f64; 4] {
        let ([n10, n20, n21, n30, n31, n32], [first, second, third, fourth]) =
            (self.lower, self.diagonal);
        [
            first + n10 * n10 * second + n20 * n20 * third + n30 * n30 * fourth,
            second + n21 * n21 * third + n31 * n31 * fourth,
            third + n32 * n32 * fourth,
            fourth,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix4, Vector4};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn inverses_are_those_of_a_general_matrix(
            rows in prop::array::uniform16(-1.0..1.0_f64),
            vector in prop::array::uniform4(-1.0..1.0_f64),
        ) {
            let rows = Matrix4::from_column_slice(&rows);
            let matrix = rows * rows.transpose() + Matrix4::identity() * 0.1;
            let expected = matrix.try_inverse().unwrap();
            // nothing above the diagonal is looked at
            let lower = matrix.map_with_location(|row, column, entry| {
                if column > row { f64::NAN } else { entry }
            });
            let inverse = Inverse::new(&lower.transpose().into()).unwrap();
            let product = Vector4::from(inverse.times(&vector));
            let size = expected.norm();
            prop_assert!((product - expected * Vector4::from(vector)).norm() < 1e-10 * size);
            let diagonal = Vector4::from(inverse.diagonal());
            prop_assert!((diagonal - expected.diagonal()).norm() < 1e-10 * size);
        }
    }

    #[test]
    fn what_is_not_positive_has_no_inverse() {
        for wrong in [0.0, -1.0, f64::NAN] {
            for place in 0..4 {
                let mut matrix = Matrix4::identity();
                assert!(Inverse::new(&matrix.into()).is_some());
                matrix[(place, place)] = wrong;
                assert!(Inverse::new(&matrix.into()).is_none());
            }
        }
    }
}
