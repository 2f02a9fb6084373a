//! The interpolant of any space of the family.

use rayon::prelude::*;

use super::cell::Cell;
use super::monomials::{FIRST, Monomials, Powers, both};
use super::points::CollocationPoints;
use super::space::Space;
use super::system::{Condition, Solution, System};
use crate::field::Field;
use crate::interpolant::Predictor;
use crate::interpolant::equation::{Collocation, Equation, Place};
use crate::interpolant::pieces::{Pieces, Taylor};
use crate::mesh::SimplexMesh;
use crate::pde::LANES;

/// A polynomial of a [`Space`] on each cell: it has the field's values and gradients at
/// the corners and satisfies a PDE at the space's collocation points.
///
/// Where the equations do not determine it, or badly, it is `Û` instead
/// ([`DeiOptions::limit`]), which has the values at the corners, but not the gradients;
/// it reproduces quadratics.
#[derive(Clone, Debug)]
pub struct Dei<'a, const CORNERS: usize, const N: usize> {
    space: Space<CORNERS, N>,
    monomials: Monomials<N>,
    mesh: &'a SimplexMesh<'a, CORNERS>,
    field: Field<'a>,
    /// The coefficients on each cell.
    pieces: Vec<[f64; N]>,
    singular: usize,
}

/// How the polynomials are determined.
#[derive(Clone, Copy, Debug)]
pub struct DeiOptions {
    /// Where the PDE holds.
    pub points: CollocationPoints,
    /// A piece is not used if a coefficient is larger than so many times the data, all
    /// without the cell's mean value and slope and in the coordinates of its box: the
    /// equations hardly determine it then. By default 20: between 5 and 50 the errors on
    /// random meshes of problem 4 are least, for all spaces. Infinity is the thesis'.
    pub limit: f64,
}

impl Default for DeiOptions {
    fn default() -> Self {
        Self { points: CollocationPoints::default(), limit: 20.0 }
    }
}

/// Cells that one thread takes at a time: whole batches of the PDE.
const CHUNK: usize = LANES;

impl<'a, const CORNERS: usize, const N: usize> Dei<'a, CORNERS, N> {
    /// The interpolant. `field` has one value and one gradient for each point of `mesh`,
    /// whose cells are of the space's shape: the four corners of a rectangle are in turn.
    pub fn new(
        space: Space<CORNERS, N>,
        mesh: &'a SimplexMesh<'a, CORNERS>,
        field: Field<'a>,
        equation: &Equation,
        options: &DeiOptions,
    ) -> Self {
        let monomials = Monomials::new(space.monomials().0);
        let chosen = space.collocation_points();
        let cells: Vec<usize> = (0..mesh.simplices().len()).collect();
        let this = Self { space, monomials, mesh, field, pieces: Vec::new(), singular: 0 };
        let found: Vec<([f64; N], bool)> = cells
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| {
                Search { of: &this, equation, options, chosen: &chosen }.of_chunk(chunk)
            })
            .collect();
        let singular = found.iter().filter(|(_, singular)| *singular).count();
        let pieces = found.into_iter().map(|(piece, _)| piece).collect();
        Self { pieces, singular, ..this }
    }
}

impl<const CORNERS: usize, const N: usize> Dei<'_, CORNERS, N> {
    /// In how many cells the equations do not determine the polynomial, or badly; of
    /// them those count that are not of their shape. `Û` is there instead.
    pub fn singular(&self) -> usize {
        self.singular
    }

    /// The space.
    pub fn space(&self) -> &Space<CORNERS, N> {
        &self.space
    }

    /// A cell with its data.
    fn cell(&self, cell: usize) -> Option<Cell<CORNERS>> {
        let points = self.mesh.simplices()[cell].map(|point| point as usize);
        Cell::new(
            self.space.shape,
            points.map(|point| self.mesh.points()[point]),
            points.map(|point| self.field.values[point]),
            points.map(|point| self.field.gradients[point]),
        )
    }

    /// A polynomial of the space, with derivatives, at a place.
    fn taylor_of(&self, piece: &[f64; N], cell: &Cell<CORNERS>, at: &[f64; CORNERS]) -> Taylor {
        let powers = Powers::new(&cell.bounds.coordinates(&cell.position(at)));
        let derivative = |orders| self.monomials.derivative_of(piece, &powers, orders);
        let mut taylor = Taylor {
            value: derivative([0; 3]),
            gradient: cell.bounds.gradient(&FIRST.map(derivative)),
            ..Taylor::default()
        };
        let axes = cell.bounds.gradients;
        for (i, one) in axes.iter().enumerate() {
            for (j, other) in axes.iter().enumerate() {
                taylor.hessian += one * other.transpose() * derivative(both(FIRST[i], FIRST[j]));
            }
        }
        taylor
    }
}

impl<const CORNERS: usize, const N: usize> Pieces<CORNERS> for Dei<'_, CORNERS, N> {
    fn mesh(&self) -> &SimplexMesh<'_, CORNERS> {
        self.mesh
    }

    /// On a rectangle, `at` are the bilinear weights of the corners. A cell without size
    /// has the values of its corners, and no slope.
    fn taylor(&self, cell: usize, at: &[f64; CORNERS]) -> Taylor {
        if let Some(with_data) = self.cell(cell) {
            return self.taylor_of(&self.pieces[cell], &with_data, at);
        }
        let points = self.mesh.simplices()[cell];
        let values =
            points.iter().zip(at).map(|(&p, weight)| self.field.values[p as usize] * weight);
        Taylor { value: values.sum(), ..Taylor::default() }
    }
}

/// The search for the polynomials of some cells.
struct Search<'a, const CORNERS: usize, const N: usize> {
    of: &'a Dei<'a, CORNERS, N>,
    equation: &'a Equation<'a>,
    options: &'a DeiOptions,
    chosen: &'a [[f64; CORNERS]],
}

/// A cell whose polynomial is sought.
struct Sought<const CORNERS: usize, const N: usize> {
    cell: usize,
    with_data: Cell<CORNERS>,
    given: System<N>,
    predicted: [f64; N],
    best: Option<Solution<N>>,
}

impl<const CORNERS: usize, const N: usize> Search<'_, CORNERS, N> {
    /// The coefficients on each cell, and whether they are those of `Û`.
    fn of_chunk(&self, cells: &[usize]) -> Vec<([f64; N], bool)> {
        let mut sought: Vec<Option<Sought<CORNERS, N>>> =
            cells.iter().map(|&cell| self.sought(cell)).collect();
        let (turns, small) = self.options.points.search();
        for turn in 0..turns {
            let mut open: Vec<&mut Sought<CORNERS, N>> = sought
                .iter_mut()
                .flatten()
                .filter(|sought| sought.best.is_none_or(|best| best.size > small))
                .collect();
            self.improve(&mut open, turn);
        }
        sought.into_iter().map(|sought| self.settled(sought)).collect()
    }

    fn sought(&self, cell: usize) -> Option<Sought<CORNERS, N>> {
        let with_data = self.of.cell(cell)?;
        let predicted = with_data.predicted(&self.of.monomials, Predictor::Quadratic);
        let given = System::new(&self.of.space, &self.of.monomials, &with_data);
        Some(Sought { cell, with_data, given, predicted, best: None })
    }

    /// Solves the systems of some cells, and keeps what is better than before.
    fn improve(&self, open: &mut [&mut Sought<CORNERS, N>], turn: usize) {
        let mut collocation = Collocation::new(self.equation);
        let mut points = Vec::with_capacity(open.len() * self.chosen.len());
        for sought in open.iter() {
            for at in
                self.options.points.of_cell(self.of.space.shape, self.chosen, sought.cell, turn)
            {
                self.push(&mut collocation, sought, &at);
                points.push(at);
            }
        }
        let (operators, right_hand_sides) = collocation.evaluate();
        let given = points.iter().zip(operators).zip(right_hand_sides);
        let conditions: Vec<Condition<CORNERS>> = given
            .map(|((&at, operator), right_hand_side)| Condition { at, operator, right_hand_side })
            .collect();
        for (sought, conditions) in open.iter_mut().zip(conditions.chunks(self.chosen.len())) {
            let monomials = &self.of.monomials;
            let mut system = sought.given.clone();
            for condition in conditions {
                system.collocate(monomials, &sought.with_data, condition);
            }
            let found = system.solve(monomials);
            let before = sought.best.map_or(f64::INFINITY, |best| best.size);
            sought.best = found.filter(|found| found.size < before).or(sought.best);
        }
    }

    /// Adds a point to the places where the PDE is evaluated.
    fn push(
        &self,
        collocation: &mut Collocation,
        sought: &Sought<CORNERS, N>,
        at: &[f64; CORNERS],
    ) {
        let linear;
        let predicted = match self.equation.predictor {
            Predictor::Quadratic => &sought.predicted,
            Predictor::Linear => {
                linear = sought.with_data.predicted(&self.of.monomials, Predictor::Linear);
                &linear
            }
        };
        let (cell, monomials) = (&sought.with_data, &self.of.monomials);
        let position = cell.position(at);
        let powers = Powers::new(&cell.bounds.coordinates(&position));
        let derivative = |orders| monomials.derivative_of(predicted, &powers, orders);
        collocation.push(&Place {
            points: &self.of.mesh.simplices()[sought.cell],
            at,
            position,
            value: derivative([0; 3]),
            gradient: cell.bounds.gradient(&FIRST.map(derivative)),
        });
    }

    /// The best that was found, or `Û`.
    fn settled(&self, sought: Option<Sought<CORNERS, N>>) -> ([f64; N], bool) {
        let Some(sought) = sought else { return ([0.0; N], true) };
        match sought.best.filter(|best| best.size <= self.options.limit) {
            Some(best) => (best.coefficients, false),
            None => (sought.predicted, true),
        }
    }
}
