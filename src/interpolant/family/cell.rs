//! A cell with its data, and polynomials that these determine without a PDE.

use super::enclosing_box::EnclosingBox;
use super::monomials::{FIRST, Monomials, both};
use super::shape::{Shape, WeightTerms};
use crate::interpolant::Predictor;
use crate::mesh::Vector;

/// A cell: its corners, and the values and gradients there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell<const CORNERS: usize> {
    pub corners: [Vector; CORNERS],
    pub values: [f64; CORNERS],
    pub gradients: [Vector; CORNERS],
    pub bounds: EnclosingBox,
    weights: [WeightTerms; CORNERS],
}

/// The monomials of [`WeightTerms`].
const TERMS: [[usize; 3]; 5] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]];

impl<const CORNERS: usize> Cell<CORNERS> {
    /// A cell with its data; none if it is not of its shape or has no size.
    pub fn new(
        shape: Shape,
        corners: [Vector; CORNERS],
        values: [f64; CORNERS],
        gradients: [Vector; CORNERS],
    ) -> Option<Self> {
        let bounds = EnclosingBox::new(shape, &corners)?;
        let weights = shape.weights(&corners.map(|corner| bounds.coordinates(&corner)));
        Some(Self { corners, values, gradients, bounds, weights })
    }

    /// The point at the given weights of the corners.
    pub fn position(&self, at: &[f64; CORNERS]) -> Vector {
        self.corners.iter().zip(at).map(|(corner, weight)| corner * *weight).sum()
    }

    /// `Û`, in the coordinates of the box. With corner weights `wᵢ` it is `Σ wᵢ uᵢ`, or
    /// `Σ wᵢ (uᵢ + ½ gᵢ·(p - Pᵢ))`, which is the same for linear functions, and for
    /// quadratic ones exact: there `uᵢ + ½ gᵢ·(p - Pᵢ)` is `u(p) - ½ ∇u(p)·(p - Pᵢ)`, and
    /// the mean of `p - Pᵢ` is zero.
    pub fn predicted<const N: usize>(
        &self,
        monomials: &Monomials<N>,
        predictor: Predictor,
    ) -> [f64; N] {
        let mut coefficients = [0.0; N];
        for corner in 0..CORNERS {
            let slopes = match predictor {
                Predictor::Linear => [0.0; 3],
                Predictor::Quadratic => {
                    self.bounds.slopes(&self.gradients[corner]).map(|slope| 0.5 * slope)
                }
            };
            let there = self.bounds.coordinates(&self.corners[corner]);
            let constant = self.values[corner] - dot(&slopes, &there);
            for (powers, weight) in TERMS.into_iter().zip(self.weights[corner]) {
                monomials.add(&mut coefficients, powers, weight * constant);
                for axis in 0..3 {
                    let term = weight * slopes[axis];
                    monomials.add(&mut coefficients, both(powers, FIRST[axis]), term);
                }
            }
        }
        coefficients
    }

    /// The plane with the mean value and the mean gradient: its value at the box's origin
    /// and its slopes along the box.
    pub fn plane(&self) -> (f64, [f64; 3]) {
        let share = 1.0 / CORNERS as f64;
        let slopes = self.bounds.slopes(&(self.gradients.iter().sum::<Vector>() * share));
        let centre = self.bounds.coordinates(&(self.corners.iter().sum::<Vector>() * share));
        let value = self.values.iter().sum::<f64>() * share;
        (value - dot(&slopes, &centre), slopes)
    }
}

pub(super) fn dot(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
