//! The pure cubic interpolant (PCI) on triangles.
//!
//! Values and gradients at the three vertices give nine of the ten Bernstein
//! coefficients, edge by edge, so neighbours join continuously. The tenth,
//! `b_111`, comes from one collocation of the PDE at the centroid
//! (thesis, section 1.6, eq. 1.10):
//!
//! `L p(c) = g(c, Û, Ûx, Ûy)`,
//!
//! one linear equation in one unknown. Without a PDE it is the one with which the
//! cubic continues into those of its neighbours (`completion`), so that cubics are
//! reproduced, or the one that reproduces quadratics.
//!
//! On a triangle in space the derivatives are those along its plane: `L` is
//! applied to the tangential Hessian, and `uxx + uyy + uzz` is the surface
//! Laplacian.

use std::borrow::Cow;

use rayon::prelude::*;

use super::TriangleCubics;
use super::completion::centre_correction;
use super::equation::{Collocation, Equation, Place, Predictor, apply, operator_weights};
use super::hermite::beside;
use super::limit::limited;
use super::per_cell::PerCell;
use crate::bernstein::{Barycentric, TriangleCubic};
use crate::field::Field;
use crate::interruption::checkpoint;
use crate::mesh::{Edges, Subset, TriangleMesh};
use crate::pde::LANES;

/// The pure cubic interpolant of a field on a mesh of triangles.
#[derive(Clone, Debug)]
pub struct Pci<'a> {
    mesh: &'a TriangleMesh<'a>,
    field: Field<'a>,
    centres: Cow<'a, Centres>,
}

/// What of a pure cubic interpolant is not read off the field.
#[derive(Clone, Debug)]
pub struct Centres {
    /// `b_111` of each triangle, where it is not that of quadratic precision.
    coefficients: PerCell<f64>,
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
    /// The interpolant of values and gradients alone, `b_111` from the neighbours.
    ///
    /// It reproduces cubics, but for triangles without a neighbour, which reproduce
    /// quadratics, and for cubics near `λ₀ λ₁ λ₂`, of which a triangle's own data see nothing:
    /// `b_111` is no farther from that of quadratic precision than the other nine coefficients
    /// from each other. Its error is of fourth order on meshes whose triangles keep their
    /// shape. It is the same for any number of threads, and up to rounding for any order
    /// of triangles and their corners. `b_111` depends on the values not quite linearly:
    /// neighbours that contradict each other count less.
    ///
    /// `field` has one value and one gradient for each point of `mesh`.
    pub fn new(mesh: &'a TriangleMesh<'a>, field: Field<'a>) -> Self {
        Self::without_pde(mesh, field, PerCell::All(completed(mesh, &field)))
    }

    /// The same on some of the triangles, to the last bit. The others have quadratic precision.
    ///
    /// It takes time and memory for them and their neighbours alone.
    pub fn on_some(mesh: &'a TriangleMesh<'a>, field: Field<'a>, triangles: &Subset) -> Self {
        let around = triangles.with_neighbours(mesh);
        if around.len() > mesh.triangles().len() / 2 {
            return Self::new(mesh, field);
        }
        let part = mesh.part(&around);
        let with_neighbours = around.simplices().zip(completed(&part, &field));
        let wanted = with_neighbours.filter(|(triangle, _)| triangles.contains(*triangle));
        let coefficients = wanted.map(|(_, centre)| centre).collect();
        Self::without_pde(mesh, field, PerCell::Some(triangles.clone(), coefficients))
    }

    /// The interpolant of values and gradients alone, each triangle by itself. It
    /// reproduces quadratics, and its error is of third order.
    ///
    /// `field` has one value and one gradient for each point of `mesh`. Nothing is stored: all
    /// coefficients are read off the field.
    pub fn with_quadratic_precision(mesh: &'a TriangleMesh<'a>, field: Field<'a>) -> Self {
        Self::without_pde(mesh, field, PerCell::None)
    }

    fn without_pde(
        mesh: &'a TriangleMesh<'a>,
        field: Field<'a>,
        coefficients: PerCell<f64>,
    ) -> Self {
        Self { mesh, field, centres: Cow::Owned(Centres { coefficients, singular: 0 }) }
    }

    /// The interpolant that also satisfies a PDE at the centroid of each triangle.
    ///
    /// It reproduces any cubic that solves the PDE, if `g` does not depend on the
    /// solution. Where the collocation is singular (see [`Pci::singular`]) the PDE is
    /// left out.
    pub fn with_pde(mesh: &'a TriangleMesh<'a>, field: Field<'a>, equation: &Equation) -> Self {
        let triangles: Vec<usize> = (0..mesh.triangles().len()).collect();
        let collocated: Vec<(f64, bool)> = triangles
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| collocate(mesh, &field, equation, chunk))
            .collect();
        let singular = collocated.iter().filter(|(_, singular)| *singular).count();
        let centres = collocated.into_iter().map(|(centre, _)| centre);
        let coefficients = PerCell::All(centres.collect());
        Self { mesh, field, centres: Cow::Owned(Centres { coefficients, singular }) }
    }

    /// The interpolant of which the centres are known: those of one of the same mesh and
    /// field.
    pub fn with_centres(mesh: &'a TriangleMesh, field: Field<'a>, centres: &'a Centres) -> Self {
        Self { mesh, field, centres: Cow::Borrowed(centres) }
    }

    /// The centres, to make the same interpolant of later.
    pub fn into_centres(self) -> Centres {
        self.centres.into_owned()
    }

    /// How many triangles could not use the PDE, because it does not determine
    /// `b_111` there or is not a finite number. They reproduce quadratics instead.
    pub fn singular(&self) -> usize {
        self.centres.singular
    }
}

impl TriangleCubics for Pci<'_> {
    fn mesh(&self) -> &TriangleMesh<'_> {
        self.mesh
    }

    fn cubic(&self, triangle: usize) -> TriangleCubic {
        match self.centres.coefficients.get(triangle) {
            Some(&centre) => hermite(self.mesh, &self.field, triangle, centre),
            None => quadratic_precision(self.mesh, &self.field, triangle),
        }
    }

    fn vertices(&self, triangle: usize) -> [f64; 3] {
        self.mesh.simplices()[triangle].map(|point| self.field.values[point as usize])
    }
}

/// For each triangle `b_111` from the neighbours.
fn completed(mesh: &TriangleMesh, field: &Field) -> Vec<f64> {
    let edges = Edges::new(mesh);
    let centre = |triangle: usize| {
        let start = quadratic_precision(mesh, field, triangle);
        let correction = centre_correction(mesh, field, &edges, triangle, &start);
        let points = &mesh.triangles()[triangle];
        let correction = limited(correction, points, mesh.points(), field);
        start.coefficients[TriangleCubic::CENTRE] + correction
    };
    (0..mesh.triangles().len()).into_par_iter().map(centre).collect()
}

/// The cubic with the field's values and gradients at the vertices, and `centre`.
fn hermite(mesh: &TriangleMesh, field: &Field, triangle: usize, centre: f64) -> TriangleCubic {
    let points = mesh.triangles()[triangle].map(|point| point as usize);
    let values = points.map(|point| field.values[point]);
    let corners = mesh.corners(triangle);
    let toward = |i: usize, j: usize| {
        beside(values[i], &field.gradients[points[i]], &(corners[j] - corners[i]))
    };
    TriangleCubic::assemble(values, toward, centre)
}

/// The cubic of values and gradients that reproduces quadratics.
pub(super) fn quadratic_precision(
    mesh: &TriangleMesh,
    field: &Field,
    triangle: usize,
) -> TriangleCubic {
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
    checkpoint();
    let mut collocation = Collocation::new(equation);
    let starts: Vec<TriangleCubic> = triangles
        .iter()
        .map(|&triangle| {
            let start = quadratic_precision(mesh, field, triangle);
            push_centroid(&mut collocation, mesh, triangle, &start, equation.predictor);
            start
        })
        .collect();
    let (operators, right_hand_sides) = collocation.evaluate();
    let given = operators.iter().zip(&right_hand_sides);
    let centres = triangles.iter().zip(&starts).zip(given).map(|((&triangle, start), (l, &g))| {
        let frame = mesh.frame(triangle);
        let correction = correction(start, &operator_weights(l, frame.barycentric_gradients()), g);
        let centre = start.coefficients[TriangleCubic::CENTRE] + correction.unwrap_or(0.0);
        (centre, correction.is_none())
    });
    centres.collect()
}

/// Adds the centroid of a triangle to the places where the PDE is to hold.
fn push_centroid(
    collocation: &mut Collocation,
    mesh: &TriangleMesh,
    triangle: usize,
    start: &TriangleCubic,
    predictor: Predictor,
) {
    let frame = mesh.frame(triangle);
    let predicted = match predictor {
        Predictor::Linear => TriangleCubic::linear(start.vertices()),
        Predictor::Quadratic => *start,
    };
    collocation.push(&Place {
        points: &mesh.triangles()[triangle],
        at: &CENTROID,
        position: frame.position(&CENTROID),
        value: predicted.value(&CENTROID),
        gradient: frame.gradient(&predicted.barycentric_gradient(&CENTROID)),
    });
}

/// What to add to `b_111` for `L p = g`, unless that equation is singular.
fn correction(start: &TriangleCubic, weights: &[[f64; 3]; 3], g: f64) -> Option<f64> {
    let factor = centre_factor(weights);
    let size: f64 = weights.iter().flatten().map(|weight| weight.abs()).sum();
    let correction = (g - apply(weights, &start.barycentric_hessian(&CENTROID))) / factor;
    (factor.abs() > SINGULAR * size && correction.is_finite()).then_some(correction)
}

/// The factor of `b_111` in `L p(c)`. Its basis function is `6 λ₀ λ₁ λ₂`, whose
/// mixed second derivatives at the centroid are all 2.
fn centre_factor(weights: &[[f64; 3]; 3]) -> f64 {
    4.0 * (weights[0][1] + weights[1][2] + weights[2][0])
}
