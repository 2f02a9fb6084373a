//! A PDE as interpolants use it: evaluated at points of cells, many at a time.

use nalgebra::Matrix3;

use crate::mesh::Vector;
use crate::pde::{Batch, Pde, Sample};

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

/// Where the PDE is to hold, and what `g` takes there.
pub(crate) struct Place<'a, const CORNERS: usize> {
    /// The points of the cell.
    pub points: &'a [u32; CORNERS],
    /// The place in the cell.
    pub at: &'a [f64; CORNERS],
    /// The same in space.
    pub position: Vector,
    /// `Û` there.
    pub value: f64,
    /// Its gradient.
    pub gradient: Vector,
}

/// Collocation points of several cells, collected to be evaluated together.
pub(crate) struct Collocation<'a> {
    equation: &'a Equation<'a>,
    batch: Batch,
    /// Values of the arrays at one place.
    arrays: Vec<f64>,
}

impl<'a> Collocation<'a> {
    pub fn new(equation: &'a Equation<'a>) -> Self {
        Self { equation, batch: equation.pde.batch(), arrays: Vec::new() }
    }

    /// Adds a place.
    pub fn push<const CORNERS: usize>(&mut self, place: &Place<CORNERS>) {
        self.arrays.clear();
        self.arrays.extend(self.equation.arrays.iter().map(|array| {
            let corners = place.points.iter().zip(place.at);
            corners.map(|(&point, weight)| array[point as usize] * weight).sum::<f64>()
        }));
        self.batch.push(&Sample {
            x: place.position.into(),
            u: place.value,
            gradient: place.gradient.into(),
            arrays: &self.arrays,
        });
    }

    /// At each place, the coefficients of `uxx, uyy, uzz, uxy, uxz, uyz`, and `g`.
    pub fn evaluate(&self) -> (Vec<[f64; 6]>, Vec<f64>) {
        let (mut operators, mut right_hand_sides) = (Vec::new(), Vec::new());
        self.equation.pde.operators(&self.batch, &mut operators);
        self.equation.pde.right_hand_sides(&self.batch, &mut right_hand_sides);
        (operators, right_hand_sides)
    }
}

/// The operator in barycentric coordinates: `L p = Σ wᵢⱼ ∂²p/∂λᵢ∂λⱼ` with
/// `wᵢⱼ = ∇λᵢᵀ A ∇λⱼ`, where `A` holds the coefficients of
/// `uxx, uyy, uzz, uxy, uxz, uyz`.
pub(super) fn operator_weights<const CORNERS: usize>(
    operator: &[f64; 6],
    barycentric_gradients: &[Vector; CORNERS],
) -> [[f64; CORNERS]; CORNERS] {
    let [xx, yy, zz, xy, xz, yz] = *operator;
    let (xy, xz, yz) = (0.5 * xy, 0.5 * xz, 0.5 * yz);
    let matrix = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    barycentric_gradients.map(|gradient| {
        let image = matrix * gradient;
        barycentric_gradients.map(|other| image.dot(&other))
    })
}

/// `L p` of a cubic with the given second derivatives by barycentric coordinates.
pub(super) fn apply<const CORNERS: usize>(
    weights: &[[f64; CORNERS]; CORNERS],
    hessian: &[[f64; CORNERS]; CORNERS],
) -> f64 {
    let pairs = weights.as_flattened().iter().zip(hessian.as_flattened());
    pairs.map(|(weight, derivative)| weight * derivative).sum()
}
