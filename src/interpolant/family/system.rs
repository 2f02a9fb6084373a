//! The linear system of one cell, `W c = b` (thesis, eq. 1.11).
//!
//! Its rows are the values and gradients at the corners (eqs. 1.4 to 1.6) and the PDE at
//! the collocation points (eq. 1.10). What is solved for is the difference to the plane
//! with the mean value and gradient: so a constant or a slope, however large, changes
//! neither the rounding nor the size of the coefficients.
//!
//! Rows are eliminated as they come, so what is given of a cell is eliminated once, however
//! often its collocation points are chosen anew.

use super::cell::{Cell, dot};
use super::monomials::{FIRST, Monomials, Powers, both};
use super::space::Space;
use crate::interpolant::equation::operator_weights;

/// The PDE at one point: `L` and `g`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Condition<const CORNERS: usize> {
    /// The point, as weights of the corners.
    pub at: [f64; CORNERS],
    /// The coefficients of `uxx, uyy, uzz, uxy, uxz, uyz`.
    pub operator: [f64; 6],
    /// `g`.
    pub right_hand_side: f64,
}

/// The system of a cell, its first rows eliminated.
#[derive(Clone, Debug)]
pub(super) struct System<const N: usize> {
    /// Each without the pivots of the rows before it.
    rows: [Row<N>; N],
    count: usize,
    /// Of the plane: the coefficients of 1, s, t, v.
    plane: [f64; 4],
    /// The greatest right-hand side.
    data: f64,
}

/// An equation.
#[derive(Clone, Copy, Debug)]
struct Row<const N: usize> {
    factors: [f64; N],
    right: f64,
    /// The column of the greatest factor.
    pivot: usize,
}

/// A system whose least pivot is below this part of the greatest is singular as far as
/// rounding can tell.
const SINGULAR: f64 = 1e-10;

/// What solves a system, with the size of its coefficients relative to the data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solution<const N: usize> {
    pub coefficients: [f64; N],
    pub size: f64,
}

impl<const N: usize> System<N> {
    /// What is given of a cell; as many conditions are missing as the space has points.
    pub fn new<const CORNERS: usize>(
        space: &Space<CORNERS, N>,
        monomials: &Monomials<N>,
        cell: &Cell<CORNERS>,
    ) -> Self {
        let (constant, slopes) = cell.plane();
        let plane = [constant, slopes[0], slopes[1], slopes[2]];
        let none = Row { factors: [0.0; N], right: 0.0, pivot: 0 };
        let mut system = Self { rows: [none; N], count: 0, plane, data: 0.0 };
        for corner in 0..CORNERS {
            let at = cell.bounds.coordinates(&cell.corners[corner]);
            let powers = Powers::new(&at);
            let value = cell.values[corner] - constant - dot(&slopes, &at);
            system.push(monomials.derivatives(&powers, [0; 3]), value);
            let given = cell.bounds.slopes(&cell.gradients[corner]);
            for axis in 0..space.shape.dimension() {
                let row = monomials.derivatives(&powers, FIRST[axis]);
                system.push(row, given[axis] - slopes[axis]);
            }
        }
        system
    }

    /// Adds `L p = g`, scaled such that the factors of `L` in the box's coordinates sum
    /// to one. `L` of the plane is zero.
    pub fn collocate<const CORNERS: usize>(
        &mut self,
        monomials: &Monomials<N>,
        cell: &Cell<CORNERS>,
        condition: &Condition<CORNERS>,
    ) {
        let weights = operator_weights(&condition.operator, &cell.bounds.gradients);
        let scale = 1.0 / weights.as_flattened().iter().map(|weight| weight.abs()).sum::<f64>();
        let powers = Powers::new(&cell.bounds.coordinates(&cell.position(&condition.at)));
        let mut row = [0.0; N];
        for i in 0..3 {
            for j in 0..=i {
                let twice = if i == j { 1.0 } else { 2.0 };
                let weight = scale * twice * weights[i][j];
                if weight != 0.0 {
                    let second = monomials.derivatives(&powers, both(FIRST[i], FIRST[j]));
                    row.iter_mut().zip(second).for_each(|(row, term)| *row += weight * term);
                }
            }
        }
        self.push(row, scale * condition.right_hand_side);
    }

    /// Adds a row, eliminates the pivots of those before it, and pivots on what is greatest then.
    fn push(&mut self, mut factors: [f64; N], mut right: f64) {
        self.data = self.data.max(right.abs());
        for row in &self.rows[..self.count] {
            let share = factors[row.pivot] / row.factors[row.pivot];
            factors
                .iter_mut()
                .zip(&row.factors)
                .for_each(|(factor, other)| *factor -= share * other);
            factors[row.pivot] = 0.0;
            right -= share * row.right;
        }
        let mut pivot = 0;
        for column in 1..N {
            if factors[column].abs() > factors[pivot].abs() {
                pivot = column;
            }
        }
        self.rows[self.count] = Row { factors, right, pivot };
        self.count += 1;
    }

    /// The solution; none if the system is singular or not finite.
    pub fn solve(&self, monomials: &Monomials<N>) -> Option<Solution<N>> {
        let pivots = self.rows.iter().map(|row| row.factors[row.pivot].abs());
        let least = pivots.clone().fold(f64::INFINITY, f64::min);
        if self.count < N || least <= SINGULAR * pivots.fold(0.0, f64::max) {
            return None;
        }
        let mut coefficients = [0.0; N];
        for row in self.rows.iter().rev() {
            // this one is still zero
            let known: f64 = row.factors.iter().zip(&coefficients).map(|(a, b)| a * b).sum();
            coefficients[row.pivot] = (row.right - known) / row.factors[row.pivot];
        }
        let size = coefficients.iter().fold(0.0, |size: f64, number| size.max(number.abs()));
        let size = if self.data > 0.0 { size / self.data } else { 0.0 };
        for (powers, term) in [[0; 3]].iter().chain(&FIRST).zip(self.plane) {
            monomials.add(&mut coefficients, *powers, term);
        }
        let finite = coefficients.iter().all(|coefficient| coefficient.is_finite());
        finite.then_some(Solution { coefficients, size })
    }
}
