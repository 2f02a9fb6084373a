//! The pure cubic interpolant (PCI) on triangles.
//!
//! Values and gradients at the three vertices give nine of the ten Bernstein
//! coefficients, edge by edge, so neighbours join continuously. The tenth,
//! `b_111`, comes from one collocation of the PDE at the centroid
//! (thesis, section 1.6, eq. 1.10):
//!
//! `L p(c) = g(c, Û, Ûx, Ûy)`,
//!
//! one linear equation in one unknown. Without a PDE it is chosen such that
//! quadratics are reproduced.
//!
//! On a triangle in space the derivatives are those along its plane: `L` is
//! applied to the tangential Hessian, and `uxx + uyy + uzz` is the surface
//! Laplacian.

use rayon::prelude::*;

use super::TriangleCubics;
use crate::bernstein::{Barycentric, TriangleCubic};
use crate::field::Field;
use crate::mesh::{TriangleFrame, TriangleMesh};
use crate::pde::{Batch, LANES, Pde, Sample};

/// Where `g` takes `Û` and its gradient from (thesis, after eq. 1.10).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Predictor {
    /// The linear interpolant of the vertex values: the thesis' choice.
    Linear,
    /// The cubic that reproduces quadratics: one order better, and all that is
    /// left of the error in `g` on the thesis' fourth problem.
    #[default]
    Quadratic,
}

/// A PDE, with what its right-hand side is evaluated at.
#[derive(Clone, Copy, Debug)]
pub struct Equation<'a> {
    /// The PDE.
    pub pde: &'a Pde,
    /// For each array of [`Pde::used_arrays`], one value a point of the mesh.
    pub arrays: &'a [Vec<f64>],
    /// Where `g` takes the solution from.
    pub predictor: Predictor,
}

impl Equation<'_> {
    /// Adds the sample at the centroid of a triangle.
    fn push_sample(
        &self,
        batch: &mut Batch,
        mesh: &TriangleMesh,
        triangle: usize,
        start: &TriangleCubic,
    ) {
        let frame = mesh.frame(triangle);
        let predicted = match self.predictor {
            Predictor::Linear => TriangleCubic::linear(vertex_values(start)),
            Predictor::Quadratic => *start,
        };
        let points = mesh.triangles()[triangle].map(|point| point as usize);
        let at_centroid = |array: &Vec<f64>| points.iter().map(|&p| array[p]).sum::<f64>() / 3.0;
        let arrays: Vec<f64> = self.arrays.iter().map(at_centroid).collect();
        batch.push(&Sample {
            x: frame.position(&CENTROID).into(),
            u: predicted.value(&CENTROID),
            gradient: frame.gradient(&predicted.barycentric_gradient(&CENTROID)).into(),
            arrays: &arrays,
        });
    }
}

/// The pure cubic interpolant of a field on a mesh of triangles.
#[derive(Clone, Debug)]
pub struct Pci<'a> {
    mesh: &'a TriangleMesh,
    field: Field<'a>,
    /// `b_111` of each triangle: all that is not read off the field.
    centres: Vec<f64>,
    singular: usize,
}

/// The factor of `b_111` in `L p(c)` counts as zero below this fraction of the
/// operator's size: then the PDE hardly speaks of `b_111`, and an error in `g`
/// would be multiplied by more than a hundred.
const SINGULAR: f64 = 1e-2;

/// Triangles collocated at a time by one thread: whole batches of the PDE.
const CHUNK: usize = 4 * LANES;

const CENTROID: Barycentric = [1.0 / 3.0; 3];

impl<'a> Pci<'a> {
    /// The interpolant of values and gradients alone. It reproduces quadratics.
    ///
    /// `field` has one value and one gradient for each point of `mesh`.
    pub fn new(mesh: &'a TriangleMesh, field: Field<'a>) -> Self {
        let centres = (0..mesh.triangles().len())
            .into_par_iter()
            .map(|triangle| quadratic_precision(mesh, &field, triangle))
            .map(|cubic| cubic.coefficients[TriangleCubic::CENTRE])
            .collect();
        Self { mesh, field, centres, singular: 0 }
    }

    /// The interpolant that also satisfies a PDE at the centroid of each triangle.
    ///
    /// It reproduces any cubic that solves the PDE. Where the collocation is
    /// singular (see [`Pci::singular`]) the PDE is left out.
    pub fn with_pde(mesh: &'a TriangleMesh, field: Field<'a>, equation: &Equation) -> Self {
        let triangles: Vec<usize> = (0..mesh.triangles().len()).collect();
        let collocated: Vec<(f64, bool)> = triangles
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| collocate(mesh, &field, equation, chunk))
            .collect();
        let singular = collocated.iter().filter(|(_, singular)| *singular).count();
        let centres = collocated.into_iter().map(|(centre, _)| centre).collect();
        Self { mesh, field, centres, singular }
    }

    /// How many triangles could not use the PDE, because it does not determine
    /// `b_111` there or is not a finite number. They reproduce quadratics instead.
    pub fn singular(&self) -> usize {
        self.singular
    }
}

impl TriangleCubics for Pci<'_> {
    fn mesh(&self) -> &TriangleMesh {
        self.mesh
    }

    fn cubic(&self, triangle: usize) -> TriangleCubic {
        hermite(self.mesh, &self.field, triangle, self.centres[triangle])
    }
}

/// The cubic with the field's values and gradients at the vertices, and `centre`.
fn hermite(mesh: &TriangleMesh, field: &Field, triangle: usize, centre: f64) -> TriangleCubic {
    let points = mesh.triangles()[triangle].map(|point| point as usize);
    let values = points.map(|point| field.values[point]);
    let corners = mesh.corners(triangle);
    let toward = |i: usize, j: usize| {
        values[i] + field.gradients[points[i]].dot(&(corners[j] - corners[i])) / 3.0
    };
    TriangleCubic::assemble(values, toward, centre)
}

/// The cubic of values and gradients that reproduces quadratics.
fn quadratic_precision(mesh: &TriangleMesh, field: &Field, triangle: usize) -> TriangleCubic {
    hermite(mesh, field, triangle, 0.0).with_quadratic_centre()
}

/// The `b_111` of each triangle with which `L p = g` at its centroid (thesis,
/// eq. 1.10); where that equation is singular, the one that reproduces quadratics,
/// and true.
fn collocate(
    mesh: &TriangleMesh,
    field: &Field,
    equation: &Equation,
    triangles: &[usize],
) -> Vec<(f64, bool)> {
    let mut batch = equation.pde.batch();
    let starts: Vec<TriangleCubic> = triangles
        .iter()
        .map(|&triangle| {
            let start = quadratic_precision(mesh, field, triangle);
            equation.push_sample(&mut batch, mesh, triangle, &start);
            start
        })
        .collect();
    let (mut operators, mut right_hand_sides) = (Vec::new(), Vec::new());
    equation.pde.operators(&batch, &mut operators);
    equation.pde.right_hand_sides(&batch, &mut right_hand_sides);
    let given = operators.iter().zip(&right_hand_sides);
    let centres = triangles.iter().zip(&starts).zip(given).map(|((&triangle, start), (l, &g))| {
        let correction = correction(start, &operator_weights(l, &mesh.frame(triangle)), g);
        let centre = start.coefficients[TriangleCubic::CENTRE] + correction.unwrap_or(0.0);
        (centre, correction.is_none())
    });
    centres.collect()
}

/// What to add to `b_111` for `L p = g`, unless that equation is singular.
fn correction(start: &TriangleCubic, weights: &[[f64; 3]; 3], g: f64) -> Option<f64> {
    let factor = centre_factor(weights);
    let size: f64 = weights.iter().flatten().map(|weight| weight.abs()).sum();
    let correction = (g - apply(weights, start)) / factor;
    (factor.abs() > SINGULAR * size && correction.is_finite()).then_some(correction)
}

/// The operator in barycentric coordinates: `L p = Σ wᵢⱼ ∂²p/∂λᵢ∂λⱼ` with
/// `wᵢⱼ = ∇λᵢᵀ A ∇λⱼ`, where `A` holds the coefficients of
/// `uxx, uyy, uzz, uxy, uxz, uyz`.
fn operator_weights(operator: &[f64; 6], frame: &TriangleFrame) -> [[f64; 3]; 3] {
    let [xx, yy, zz, xy, xz, yz] = *operator;
    let (xy, xz, yz) = (0.5 * xy, 0.5 * xz, 0.5 * yz);
    let matrix = nalgebra::Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let gradients = frame.barycentric_gradients();
    let images = gradients.map(|gradient| matrix * gradient);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| gradients[i].dot(&images[j])))
}

/// `L p` at the centroid.
fn apply(weights: &[[f64; 3]; 3], cubic: &TriangleCubic) -> f64 {
    let hessian = cubic.barycentric_hessian(&CENTROID);
    let mut sum = 0.0;
    for i in 0..3 {
        for j in 0..3 {
            sum += weights[i][j] * hessian[i][j];
        }
    }
    sum
}

/// The factor of `b_111` in `L p(c)`. Its basis function is `6 λ₀ λ₁ λ₂`, whose
/// mixed second derivatives at the centroid are all 2.
fn centre_factor(weights: &[[f64; 3]; 3]) -> f64 {
    4.0 * (weights[0][1] + weights[1][2] + weights[2][0])
}

fn vertex_values(cubic: &TriangleCubic) -> [f64; 3] {
    let [a, _, _, _, _, _, b, _, _, c] = cubic.coefficients;
    [a, b, c]
}
