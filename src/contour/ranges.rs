//! Stage one: the range of the interpolant on each cell (thesis, section 2.3.1).
//!
//! The thesis searches for the extremes of each cubic, which may miss some; the
//! least and the greatest Bernstein coefficient bound the cubic with certainty,
//! and cost less. They may be a little wide: then stage two looks at a cell in
//! vain. Where a *tight* range is wanted, to place levels, the thesis' recursive
//! search is used ([`recursive_extreme`]), on the few cells that could matter.

use rayon::prelude::*;

use super::extreme::{Extreme, recursive_extreme};
use super::extreme_in_tetrahedron::recursive_extreme_in_tetrahedron;
use crate::interpolant::{TetrahedronCubics, TriangleCubics};
use crate::interruption::checkpoint;

/// Certain bounds of the interpolant on each cell, computed once for all levels.
#[derive(Clone, Debug)]
pub struct CellRanges {
    /// Least and greatest coefficient; an empty range for an unusable cell.
    ranges: Vec<[f64; 2]>,
    unusable: usize,
    excluded: usize,
}

/// The range of a cell that holds no value.
const EMPTY: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl CellRanges {
    /// The ranges of all triangles of `interpolant`.
    pub fn new(interpolant: &dyn TriangleCubics) -> Self {
        let cells = interpolant.mesh().triangles().len();
        Self::of_bounds(cells, |cell| {
            let cubic = interpolant.cubic(cell);
            usable(&cubic.coefficients, cubic.bounds())
        })
    }

    /// The ranges of all tetrahedra of `interpolant`.
    pub fn of_tetrahedra(interpolant: &dyn TetrahedronCubics) -> Self {
        let cells = interpolant.mesh().tetrahedra().len();
        Self::of_bounds(cells, |cell| {
            let cubic = interpolant.cubic(cell);
            usable(&cubic.coefficients, cubic.bounds())
        })
    }

    fn of_bounds(cells: usize, bounds: impl Fn(usize) -> [f64; 2] + Sync + Send) -> Self {
        let bounds = |cell| {
            checkpoint();
            bounds(cell)
        };
        let ranges: Vec<[f64; 2]> = (0..cells).into_par_iter().map(bounds).collect();
        let unusable = ranges.iter().filter(|&&range| range == EMPTY).count();
        Self { ranges, unusable, excluded: 0 }
    }

    /// Leaves out the usable cells for which `excluded` says so; returns how many.
    pub fn exclude(&mut self, excluded: impl Fn(usize) -> bool) -> usize {
        let mut count = 0;
        for (cell, range) in self.ranges.iter_mut().enumerate() {
            if *range != EMPTY && excluded(cell) {
                *range = EMPTY;
                count += 1;
            }
        }
        self.excluded += count;
        count
    }

    /// Whether any cell is left out: unusable, or excluded.
    pub fn leaves_out_any(&self) -> bool {
        self.unusable + self.excluded > 0
    }

    /// Whether a cell is left out: unusable, or excluded.
    pub fn leaves_out(&self, cell: usize) -> bool {
        self.ranges[cell] == EMPTY
    }

    /// How many cells have a value or a gradient that is not finite. They hold
    /// no contour.
    pub fn unusable(&self) -> usize {
        self.unusable
    }

    /// The range of a cell; empty (infinity to minus infinity) if it is unusable.
    pub fn range(&self, cell: usize) -> [f64; 2] {
        self.ranges[cell]
    }

    /// The cells whose range holds `level`, give or take the `tolerance` of that
    /// range, ascending.
    pub fn cells_at(&self, level: f64, tolerance: impl Fn([f64; 2]) -> f64 + Sync) -> Vec<u32> {
        let holds = |range: [f64; 2]| {
            let [low, high] = range;
            // the exact comparison settles nearly all cells
            let outside = level < low || level > high;
            range != EMPTY && (!outside || (low - level).max(level - high) <= tolerance(range))
        };
        self.ranges
            .par_iter()
            .enumerate()
            .filter(|(_, range)| holds(**range))
            .map(|(cell, _)| cell as u32)
            .collect()
    }

    /// Least and greatest value that the interpolant attains, by the recursive
    /// search; nothing without usable cells.
    ///
    /// Levels strictly between them have a contour, which is not so for levels
    /// between the extreme coefficients.
    pub fn attained(&self, interpolant: &dyn TriangleCubics) -> Option<[f64; 2]> {
        let at_vertices =
            |cell: usize, which: Extreme| which.best(&interpolant.cubic(cell).vertices());
        let search =
            |cell: usize, which: Extreme| recursive_extreme(&interpolant.cubic(cell), which).value;
        self.attained_by(&at_vertices, &search)
    }

    /// The same as [`CellRanges::attained`], for tetrahedra.
    pub fn attained_in_tetrahedra(&self, interpolant: &dyn TetrahedronCubics) -> Option<[f64; 2]> {
        let at_vertices =
            |cell: usize, which: Extreme| which.best(&interpolant.cubic(cell).vertices());
        let search = |cell: usize, which: Extreme| {
            recursive_extreme_in_tetrahedron(&interpolant.cubic(cell), which).value
        };
        self.attained_by(&at_vertices, &search)
    }

    fn attained_by(&self, at_vertices: &Attained, search: &Attained) -> Option<[f64; 2]> {
        let low = self.attained_extreme(Extreme::Minimum, at_vertices, search)?;
        let high = self.attained_extreme(Extreme::Maximum, at_vertices, search)?;
        Some([low, high])
    }

    fn attained_extreme(
        &self,
        which: Extreme,
        at_vertices: &Attained,
        search: &Attained,
    ) -> Option<f64> {
        let usable = || (0..self.ranges.len()).into_par_iter().filter(|&c| self.ranges[c] != EMPTY);
        let start =
            usable().map(|cell| at_vertices(cell, which)).reduce_with(|a, b| which.better(a, b))?;
        let promising = usable().filter(|&cell| {
            let bound = which.of(self.ranges[cell]);
            which.better(bound, start) != start
        });
        let searched = promising.map(|cell| {
            checkpoint();
            search(cell, which)
        });
        Some(searched.reduce(|| start, |a, b| which.better(a, b)))
    }
}

/// An extreme value of a cell.
type Attained<'a> = dyn Fn(usize, Extreme) -> f64 + Sync + 'a;

/// The bounds of a cubic; empty if a coefficient is not finite.
fn usable(coefficients: &[f64], (low, high): (f64, f64)) -> [f64; 2] {
    if coefficients.iter().all(|c| c.is_finite()) { [low, high] } else { EMPTY }
}
