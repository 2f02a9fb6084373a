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
///
/// They are kept in single precision, rounded outwards: still certain, and half as large,
/// which matters beside a mesh. The few cells that they leave are asked again.
#[derive(Clone, Debug)]
pub struct CellRanges {
    /// Least and greatest coefficient; an empty range for an unusable cell.
    ranges: Vec<[f32; 2]>,
    unusable: usize,
    excluded: usize,
}

/// The range of a cell that holds no value.
const EMPTY: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

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

    fn of_bounds(cells: usize, bounds: impl Fn(usize) -> [f32; 2] + Sync + Send) -> Self {
        let bounds = |cell| {
            checkpoint();
            bounds(cell)
        };
        let ranges: Vec<[f32; 2]> = (0..cells).into_par_iter().map(bounds).collect();
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

    /// The cells whose range holds `level`, give or take the `tolerance` of that
    /// range, ascending; `bounds` are the least and the greatest coefficient of a cell. The
    /// tolerance must not be less for a wider range.
    pub fn cells_at(
        &self,
        level: f64,
        tolerance: impl Fn([f64; 2]) -> f64 + Sync,
        bounds: impl Fn(usize) -> [f64; 2] + Sync,
    ) -> Vec<u32> {
        let holds = |cell: &u32| holds(bounds(*cell as usize), level, &tolerance);
        self.cells_near(level, &tolerance).into_par_iter().filter(holds).collect()
    }

    /// The same but for a few cells more, of which only ranges in single precision hold the
    /// level: quicker for those who look at each cell anyway.
    pub fn cells_near(&self, level: f64, tolerance: impl Fn([f64; 2]) -> f64 + Sync) -> Vec<u32> {
        let may_hold =
            |range: [f32; 2]| range != EMPTY && holds(range.map(f64::from), level, &tolerance);
        let numbered = self.ranges.par_iter().enumerate();
        numbered.filter(|(_, range)| may_hold(**range)).map(|(cell, _)| cell as u32).collect()
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
        let bounds =
            |cell: usize, which: Extreme| which.of(interpolant.cubic(cell).bounds().into());
        self.attained_by(&at_vertices, &bounds, &search)
    }

    /// The same as [`CellRanges::attained`], for tetrahedra.
    pub fn attained_in_tetrahedra(&self, interpolant: &dyn TetrahedronCubics) -> Option<[f64; 2]> {
        let at_vertices =
            |cell: usize, which: Extreme| which.best(&interpolant.cubic(cell).vertices());
        let search = |cell: usize, which: Extreme| {
            recursive_extreme_in_tetrahedron(&interpolant.cubic(cell), which).value
        };
        let bounds =
            |cell: usize, which: Extreme| which.of(interpolant.cubic(cell).bounds().into());
        self.attained_by(&at_vertices, &bounds, &search)
    }

    fn attained_by(
        &self,
        at_vertices: &OfCell,
        bounds: &OfCell,
        search: &OfCell,
    ) -> Option<[f64; 2]> {
        let low = self.attained_extreme(Extreme::Minimum, at_vertices, bounds, search)?;
        let high = self.attained_extreme(Extreme::Maximum, at_vertices, bounds, search)?;
        Some([low, high])
    }

    fn attained_extreme(
        &self,
        which: Extreme,
        at_vertices: &OfCell,
        bounds: &OfCell,
        search: &OfCell,
    ) -> Option<f64> {
        let usable = || (0..self.ranges.len()).into_par_iter().filter(|&c| self.ranges[c] != EMPTY);
        let start =
            usable().map(|cell| at_vertices(cell, which)).reduce_with(|a, b| which.better(a, b))?;
        let promises = |bound: f64| which.better(bound, start) != start;
        let promising = usable().filter(|&cell| {
            let wide = which.of(self.ranges[cell].map(f64::from));
            promises(wide) && promises(bounds(cell, which))
        });
        let searched = promising.map(|cell| {
            checkpoint();
            search(cell, which)
        });
        Some(searched.reduce(|| start, |a, b| which.better(a, b)))
    }
}

/// Whether a range holds a level, give or take its tolerance.
pub fn holds([low, high]: [f64; 2], level: f64, tolerance: impl Fn([f64; 2]) -> f64) -> bool {
    // the exact comparison settles nearly all cells
    let outside = level < low || level > high;
    !outside || (low - level).max(level - high) <= tolerance([low, high])
}

/// An extreme value of a cell, or a bound of it.
type OfCell<'a> = dyn Fn(usize, Extreme) -> f64 + Sync + 'a;

/// The bounds of a cubic; empty if a coefficient is not finite.
fn usable(coefficients: &[f64], (low, high): (f64, f64)) -> [f32; 2] {
    // without a branch for each coefficient
    let has_nan = coefficients.iter().fold(false, |found, c| found | c.is_nan());
    let is_usable = !has_nan && low.is_finite() && high.is_finite();
    if is_usable { [rounded_down(low), -rounded_down(-high)] } else { EMPTY }
}

/// The greatest number of single precision that is not above a finite one.
fn rounded_down(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) > value { nearest.next_down() } else { nearest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bounds_beyond_single_precision_hold_all_the_same() {
        let [low, high] = usable(&[1e300, -1e300], (-1e300, 1e300));
        assert_eq!([low, high], [f32::NEG_INFINITY, f32::INFINITY]);
        assert_eq!(usable(&[1e300], (1e300, 1e300)), [f32::MAX, f32::INFINITY]);
        assert_eq!(usable(&[f64::NAN], (0.0, 1.0)), EMPTY);
    }

    proptest! {
        #[test]
        fn rounding_outwards_is_certain_and_tight(low in any::<f64>(), width in 0.0..1e10_f64) {
            prop_assume!(low.is_finite() && (low + width).is_finite());
            let [l, h] = usable(&[low, low + width], (low, low + width)).map(f64::from);
            prop_assert!(l <= low && low + width <= h);
            let largest = low.abs().max((low + width).abs());
            prop_assert!(largest > 1e38 || low - l <= 1e-6 * largest.max(1e-38));
        }
    }
}
