//! What a PDE says of the four face coefficients of a tetrahedron.
//!
//! Each face coefficient stands before `6 λⱼ λₖ λₗ`, which has no value or gradient at
//! the vertices. The PDE at four points inside, `L p = g(c, Û, Ûx, Ûy, Ûz)`, gives four
//! linear equations (thesis, section 1.8; it leaves the points open).

use super::equation::{Collocation, Equation, Place, Predictor, apply, operator_weights};
use crate::bernstein::{Barycentric4, TetrahedronCubic};
use crate::mesh::TetrahedronMesh;

/// Four linear equations for what is to be added to the face coefficients of a
/// tetrahedron: `matrix · x = right`, columns by the vertex
/// opposite to the face. Scaled such that the matrix has norm 1 (Frobenius), and `right`
/// the unit of the solution.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FaceEquations {
    pub matrix: [[f64; 4]; 4],
    pub right: [f64; 4],
}

/// The points of collocation, one nearer to each vertex.
const PLACES: [Barycentric4; 4] =
    [[0.7, 0.1, 0.1, 0.1], [0.1, 0.7, 0.1, 0.1], [0.1, 0.1, 0.7, 0.1], [0.1, 0.1, 0.1, 0.7]];

/// The equations of some tetrahedra, for what is to be added to the face coefficients of the
/// cubics that `start` gives; none where the PDE says nothing of the face
/// coefficients or is not finite.
pub(super) fn face_equations(
    mesh: &TetrahedronMesh,
    equation: &Equation,
    tetrahedra: &[usize],
    start: impl Fn(usize) -> TetrahedronCubic,
) -> Vec<Option<FaceEquations>> {
    let mut collocation = Collocation::new(equation);
    let starts: Vec<TetrahedronCubic> = tetrahedra
        .iter()
        .map(|&tetrahedron| {
            let start = start(tetrahedron);
            push_places(&mut collocation, mesh, tetrahedron, &start, equation.predictor);
            start
        })
        .collect();
    let (operators, right_hand_sides) = collocation.evaluate();
    let (operators, right_hand_sides) =
        (operators.as_chunks::<4>().0, right_hand_sides.as_chunks::<4>().0);
    let given = operators.iter().zip(right_hand_sides);
    let equations = tetrahedra.iter().zip(&starts).zip(given);
    equations
        .map(|((&tetrahedron, start), (operators, right_hand_sides))| {
            let gradients = *mesh.frame(tetrahedron).barycentric_gradients();
            let weights = operators.map(|operator| operator_weights(&operator, &gradients));
            collocate(start, &weights, right_hand_sides)
        })
        .collect()
}

/// Adds the four points of a tetrahedron to the places where the PDE is to hold.
fn push_places(
    collocation: &mut Collocation,
    mesh: &TetrahedronMesh,
    tetrahedron: usize,
    start: &TetrahedronCubic,
    predictor: Predictor,
) {
    let frame = mesh.frame(tetrahedron);
    let predicted = match predictor {
        Predictor::Linear => TetrahedronCubic::linear(start.vertices()),
        Predictor::Quadratic => *start,
    };
    for at in &PLACES {
        collocation.push(&Place {
            points: &mesh.tetrahedra()[tetrahedron],
            at,
            position: frame.position(at),
            value: predicted.value(at),
            gradient: frame.gradient(&predicted.barycentric_gradient(at)),
        });
    }
}

/// `L (start + Σ xᵢ 6 λⱼ λₖ λₗ) = g` at the four places, scaled.
fn collocate(
    start: &TetrahedronCubic,
    weights: &[[[f64; 4]; 4]; 4],
    right_hand_sides: &[f64; 4],
) -> Option<FaceEquations> {
    let places = [0, 1, 2, 3];
    let matrix = places.map(|place| face_factors(&weights[place], &PLACES[place]));
    let right = places.map(|place| {
        let hessian = start.barycentric_hessian(&PLACES[place]);
        right_hand_sides[place] - apply(&weights[place], &hessian)
    });
    let norm = matrix.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
    let matrix = matrix.map(|row| row.map(|factor| factor / norm));
    let right = right.map(|side| side / norm);
    let finite = matrix.as_flattened().iter().chain(&right).all(|x| x.is_finite());
    finite.then_some(FaceEquations { matrix, right })
}

/// The factors of the face coefficients in `L p`: `L` of `6 λⱼ λₖ λₗ` is
/// `12 (λⱼ wₖₗ + λₖ wⱼₗ + λₗ wⱼₖ)`.
fn face_factors(weights: &[[f64; 4]; 4], at: &Barycentric4) -> [f64; 4] {
    TetrahedronCubic::FACE_VERTICES.map(|[j, k, l]| {
        12.0 * (at[j] * weights[k][l] + at[k] * weights[j][l] + at[l] * weights[j][k])
    })
}
