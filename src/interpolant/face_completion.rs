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
use wide::f64x4;

use super::hermite::quadratic_precision_of;
use super::limit::limited;
use super::per_cell::PerCell;
use crate::bernstein::TetrahedronCubic;
use crate::field::Field;
use crate::mesh::{Faces, Side, Subset, TetrahedronFrame, TetrahedronMesh, ascending_corners};

/// What a tetrahedron says of each of its faces, by the opposite corner.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Estimate {
    /// What is to be added to the coefficients that reproduce quadratics.
    corrections: [f64; 4],
    /// How well each is determined: the inverse of its variance.
    weights: [f64; 4],
}

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
    let points = beyond.map(|side| side.map(|side| side.point(mesh)));
    let far = FarPoints::new(mesh, field, &frame, points.iter().copied());
    far.add_to(&mut equations, &frame, &start, &EACH_BEYOND_ONE);
    if beyond.contains(&None) {
        for points in further_points(mesh, faces, &beyond).chunks(4) {
            let far = FarPoints::new(mesh, field, &frame, points.iter().copied().map(Some));
            far.add_to(&mut equations, &frame, &start, &[[1.0; 4]; 4]);
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

/// Four points beyond faces of a tetrahedron, with their data: computers do four things in little
/// more time than one.
#[derive(Clone, Copy, Debug, Default)]
struct FarPoints {
    /// Their barycentric coordinates, each of the four points; zero where there is no point, so that
    /// no equation has a factor then.
    at: [[f64; 4]; 4],
    position: [[f64; 4]; 3],
    value: [f64; 4],
    gradient: [[f64; 4]; 3],
}

/// For each corner, the points to whose equation at it we listen: all but that beyond its opposite
/// face, if each is beyond one.
const EACH_BEYOND_ONE: [[f64; 4]; 4] =
    [[0.0, 1.0, 1.0, 1.0], [1.0, 0.0, 1.0, 1.0], [1.0, 1.0, 0.0, 1.0], [1.0, 1.0, 1.0, 0.0]];

impl FarPoints {
    /// Up to four; those without finite data are left out.
    fn new(
        mesh: &TetrahedronMesh,
        field: &Field,
        frame: &TetrahedronFrame,
        points: impl Iterator<Item = Option<u32>>,
    ) -> Self {
        let mut far = Self::default();
        for (n, point) in points.enumerate() {
            let Some(point) = point else { continue };
            let position = &mesh.points()[point as usize];
            let (value, gradient) =
                (field.values[point as usize], &field.gradients[point as usize]);
            let at = frame.barycentric(position);
            let numbers = at.iter().chain(gradient).chain([&value]);
            if !numbers.fold(0.0, |sum, number| sum + 0.0 * number).is_finite() {
                continue;
            }
            far.value[n] = value;
            (0..4).for_each(|corner| far.at[corner][n] = at[corner]);
            for axis in 0..3 {
                far.position[axis][n] = position[axis];
                far.gradient[axis][n] = gradient[axis];
            }
        }
        far
    }

    /// Adds the equations by which the cubic `start` continues to these points: at each corner those
    /// of the points that have a one there.
    fn add_to(
        &self,
        equations: &mut NormalEquations,
        frame: &TetrahedronFrame,
        start: &TetrahedronCubic,
        of_corners: &[[f64; 4]; 4],
    ) {
        let at = self.at.map(f64x4::from);
        let value = f64x4::from(self.value);
        let position = self.position.map(f64x4::from);
        let third = self.gradient.map(|slopes| f64x4::from(slopes) * (1.0 / 3.0));
        let continued = start.blossoms(&at);
        let distance = at.iter().fold(f64x4::ONE, |sum, weight| sum + weight.abs());
        // With the fourth power it would be as good; with the sixth it bears badly wrong gradients
        // better.
        let cube = distance * distance * distance;
        let weight = f64x4::ONE / (cube * cube);
        let [a, b, c, d] = at;
        let [ab, ac, ad, bc, bd, cd] = [a * b, a * c, a * d, b * c, b * d, c * d].map(|p| p + p);
        // the factors of the coefficients amid the other faces, by their opposite corners, in the
        // blossom at a corner and twice a place
        let factors = [[cd, bd, bc], [cd, ad, ac], [bd, ad, ab], [bc, ac, ab]];
        for (end, corner) in frame.corners().iter().enumerate() {
            let along = |axis: usize| third[axis] * (f64x4::from(corner[axis]) - position[axis]);
            let known = value + (along(0) + along(1) + along(2));
            let listening = weight * f64x4::from(of_corners[end]);
            let others = TetrahedronCubic::FACE_VERTICES[end];
            equations.add(listening, others, factors[end], known - continued[end]);
        }
        let continued_value =
            (a * continued[0] + b * continued[1]) + (c * continued[2] + d * continued[3]);
        // the sum of the corners' factors, weighed likewise
        let of_value = [bc * d, ac * d, ab * d, ab * c].map(|product| product * 3.0);
        equations.add(weight * VALUE, [0, 1, 2, 3], of_value, value - continued_value);
    }
}

/// Linear equations for four numbers, gathered for their least-squares solution: four sums of each
/// kind, which add up to those of all.
#[derive(Clone, Copy, Debug, Default)]
struct NormalEquations {
    /// Rows; nothing above the diagonal.
    matrix: [[f64x4; 4]; 4],
    right: [f64x4; 4],
}

impl NormalEquations {
    /// Adds four equations for some of the numbers, ascending.
    #[inline]
    fn add<const COUNT: usize>(
        &mut self,
        weight: f64x4,
        numbers: [usize; COUNT],
        factors: [f64x4; COUNT],
        right: f64x4,
    ) {
        for (i, &row) in numbers.iter().enumerate() {
            let weighed = weight * factors[i];
            for (j, &column) in numbers[..=i].iter().enumerate() {
                self.matrix[row][column] += weighed * factors[j];
            }
            self.right[row] += weighed * right;
        }
    }

    /// The solution; a face that no equation knows stays where it is.
    fn solve(self) -> Estimate {
        let sum = |parts: f64x4| {
            let [a, b, c, d] = parts.to_array();
            (a + b) + (c + d)
        };
        let (mut matrix, right) = (self.matrix.map(|row| row.map(sum)), self.right.map(sum));
        let known = [0, 1, 2, 3].map(|n| matrix[n][n] > 0.0);
        for (n, &known) in known.iter().enumerate() {
            let entry = &mut matrix[n][n];
            *entry = if known { *entry * (1.0 + ROUNDING) } else { 1.0 };
        }
        let Some(inverse) = Inverse::new(&matrix) else { return Estimate::default() };
        let corrections = inverse.times(&right);
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
