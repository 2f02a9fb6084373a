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
use super::rounding;
use crate::interpolant::{TetrahedronCubics, TriangleCubics};
use crate::interruption::checkpoint;
use crate::mesh::Subset;

/// Certain bounds of the interpolant on each cell, computed once for all levels.
///
/// They are kept in single precision, rounded outwards: still certain, and half as large,
/// which matters beside a mesh. The few cells that they leave are asked again.
#[derive(Clone, Debug)]
pub struct CellRanges {
    /// Least and greatest coefficient; an empty range for an unusable cell.
    ranges: Vec<[f32; 2]>,
    /// What holds the ranges of each [`BLOCK`] of cells: a level that it does not hold passes over
    /// them all. Neighbours mostly have numbers that are near each other, so most blocks are.
    blocks: Vec<[f32; 2]>,
    unusable: usize,
    excluded: usize,
}

/// Cells that one range holds besides.
const BLOCK: usize = 32;

/// The range of a cell that holds no value.
const EMPTY: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

impl CellRanges {
    /// The ranges of all triangles of `interpolant`.
    pub fn new(interpolant: &dyn TriangleCubics) -> Self {
        let cells = interpolant.mesh().triangles().len();
        Self::of_bounds(cells, |cell| of_triangle(interpolant, cell))
    }

    /// The ranges of all tetrahedra of `interpolant`.
    pub fn of_tetrahedra(interpolant: &dyn TetrahedronCubics) -> Self {
        let cells = interpolant.mesh().tetrahedra().len();
        Self::of_bounds(cells, |cell| of_tetrahedron(interpolant, cell))
    }

    /// Ranges of so many cells, each within the bounds that are given; nothing for unusable cells.
    pub fn of_bounds(
        cells: usize,
        bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync + Send,
    ) -> Self {
        let range = |cell| {
            checkpoint();
            bounds(cell).map_or(EMPTY, rounded_outwards)
        };
        let ranges: Vec<[f32; 2]> = (0..cells).into_par_iter().map(range).collect();
        let unusable = ranges.iter().filter(|&&range| range == EMPTY).count();
        let joined = |a: [f32; 2], b: &[f32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let blocks = ranges.par_chunks(BLOCK).map(|block| block.iter().fold(EMPTY, joined));
        let blocks = blocks.collect();
        Self { ranges, blocks, unusable, excluded: 0 }
    }

    /// Takes for some triangles the range of their cubics, instead of bounds that were known
    /// before.
    pub fn narrow(&mut self, triangles: &Subset, interpolant: &dyn TriangleCubics) {
        self.narrow_to(triangles, |cell| of_triangle(interpolant, cell));
    }

    /// The same for tetrahedra.
    pub fn narrow_tetrahedra(&mut self, tetrahedra: &Subset, interpolant: &dyn TetrahedronCubics) {
        self.narrow_to(tetrahedra, |cell| of_tetrahedron(interpolant, cell));
    }

    fn narrow_to(&mut self, cells: &Subset, bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync) {
        let numbered = self.ranges.par_iter_mut().enumerate();
        let usable = numbered.filter(|(cell, range)| **range != EMPTY && cells.contains(*cell));
        let lost = usable.map(|(cell, range)| {
            *range = bounds(cell).map_or(EMPTY, rounded_outwards);
            usize::from(*range == EMPTY)
        });
        self.unusable += lost.sum::<usize>();
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
        let holds =
            |range: &[f32; 2]| *range != EMPTY && holds(range.map(f64::from), level, &tolerance);
        let blocks = self.blocks.par_iter().zip(self.ranges.par_chunks(BLOCK)).enumerate();
        let near = blocks.filter(|(_, (block, _))| holds(block));
        let cells = near.flat_map_iter(|(number, (_, ranges))| {
            let numbered = (number * BLOCK..).zip(ranges).filter(|(_, range)| holds(range));
            numbered.map(|(cell, _)| cell as u32)
        });
        cells.collect()
    }

    /// The cells whose range holds one of the levels (ascending), to rounding.
    pub fn cells_near_any(&self, levels: &[f64]) -> Subset {
        Subset::new(self.ranges.len(), |cell| {
            let range = self.ranges[cell];
            range != EMPTY && holds_any(range.map(f64::from), levels)
        })
    }

    /// The least and the greatest value at the vertices of usable cells; `vertices` are those of a
    /// cell. Nothing without usable cells.
    pub fn at_vertices<const CORNERS: usize>(
        &self,
        vertices: impl Fn(usize) -> [f64; CORNERS] + Sync,
    ) -> Option<[f64; 2]> {
        let nothing = || [f64::INFINITY, f64::NEG_INFINITY];
        let joined = |a: [f64; 2], b: [f64; 2]| {
            [if b[0] < a[0] { b[0] } else { a[0] }, if b[1] > a[1] { b[1] } else { a[1] }]
        };
        let include = |range, cell| {
            vertices(cell).into_iter().fold(range, |range, value| joined(range, [value, value]))
        };
        let [low, high] = self.usable().fold(nothing, include).reduce(nothing, joined);
        (low <= high).then_some([low, high])
    }

    /// The cells that may attain values outside an interval; `bounds` are what a cell's range was
    /// rounded of.
    pub fn cells_beyond(
        &self,
        [low, high]: [f64; 2],
        bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync,
    ) -> Subset {
        let is_beyond = |[least, greatest]: [f64; 2]| least < low || greatest > high;
        Subset::new(self.ranges.len(), |cell| {
            // a plateau is beyond only by the rounding to single precision
            let range = self.ranges[cell];
            range != EMPTY && is_beyond(range.map(f64::from)) && bounds(cell).is_some_and(is_beyond)
        })
    }

    /// Least and greatest value that the interpolant attains, by the recursive
    /// search; nothing without usable cells.
    ///
    /// Levels strictly between them have a contour, which is not so for levels
    /// between the extreme coefficients.
    pub fn attained(&self, interpolant: &dyn TriangleCubics) -> Option<[f64; 2]> {
        let at_vertices = self.at_vertices(|cell| interpolant.vertices(cell))?;
        Some(self.attained_beyond(at_vertices, interpolant))
    }

    /// The same where it is known what is attained at the vertices.
    pub fn attained_beyond(
        &self,
        at_vertices: [f64; 2],
        interpolant: &dyn TriangleCubics,
    ) -> [f64; 2] {
        let search =
            |cell: usize, which: Extreme| recursive_extreme(&interpolant.cubic(cell), which).value;
        let bounds =
            |cell: usize, which: Extreme| which.of(interpolant.cubic(cell).bounds().into());
        self.attained_by(at_vertices, &bounds, &search)
    }

    /// The same as [`CellRanges::attained`], for tetrahedra.
    pub fn attained_in_tetrahedra(&self, interpolant: &dyn TetrahedronCubics) -> Option<[f64; 2]> {
        let at_vertices = self.at_vertices(|cell| interpolant.vertices(cell))?;
        Some(self.attained_beyond_in_tetrahedra(at_vertices, interpolant))
    }

    /// The same as [`CellRanges::attained_beyond`], for tetrahedra.
    pub fn attained_beyond_in_tetrahedra(
        &self,
        at_vertices: [f64; 2],
        interpolant: &dyn TetrahedronCubics,
    ) -> [f64; 2] {
        let search = |cell: usize, which: Extreme| {
            recursive_extreme_in_tetrahedron(&interpolant.cubic(cell), which).value
        };
        let bounds =
            |cell: usize, which: Extreme| which.of(interpolant.cubic(cell).bounds().into());
        self.attained_by(at_vertices, &bounds, &search)
    }

    fn attained_by(&self, [low, high]: [f64; 2], bounds: &OfCell, search: &OfCell) -> [f64; 2] {
        let low = self.attained_extreme(Extreme::Minimum, low, bounds, search);
        let high = self.attained_extreme(Extreme::Maximum, high, bounds, search);
        [low, high]
    }

    /// The extreme value, which at vertices is `start`.
    fn attained_extreme(
        &self,
        which: Extreme,
        start: f64,
        bounds: &OfCell,
        search: &OfCell,
    ) -> f64 {
        let promises = |bound: f64| which.better(bound, start) != start;
        let promising = self.usable().filter(|&cell| {
            let wide = which.of(self.ranges[cell].map(f64::from));
            promises(wide) && promises(bounds(cell, which))
        });
        let searched = promising.map(|cell| {
            checkpoint();
            search(cell, which)
        });
        searched.reduce(|| start, |a, b| which.better(a, b))
    }

    /// The cells that are not left out.
    fn usable(&self) -> impl ParallelIterator<Item = usize> {
        (0..self.ranges.len()).into_par_iter().filter(|&cell| self.ranges[cell] != EMPTY)
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

/// Whether a range holds any of the levels, which ascend, to rounding.
fn holds_any(range: [f64; 2], levels: &[f64]) -> bool {
    // farther ones are farther outside by more than their own rounding grows
    let next = levels.partition_point(|&level| level < range[0]);
    let nearest = &levels[next.saturating_sub(1)..levels.len().min(next + 1)];
    nearest.iter().any(|&level| holds(range, level, |range| rounding::of_range(range, level)))
}

fn of_triangle(interpolant: &dyn TriangleCubics, cell: usize) -> Option<[f64; 2]> {
    let cubic = interpolant.cubic(cell);
    finite_bounds(&cubic.coefficients, cubic.bounds())
}

fn of_tetrahedron(interpolant: &dyn TetrahedronCubics, cell: usize) -> Option<[f64; 2]> {
    let cubic = interpolant.cubic(cell);
    finite_bounds(&cubic.coefficients, cubic.bounds())
}

/// The bounds of a cubic; nothing if a coefficient is not finite.
fn finite_bounds(coefficients: &[f64], (low, high): (f64, f64)) -> Option<[f64; 2]> {
    // without a branch for each coefficient
    let has_nan = coefficients.iter().fold(false, |found, c| found | c.is_nan());
    (!has_nan && low.is_finite() && high.is_finite()).then_some([low, high])
}

/// A range in single precision that holds the given one.
fn rounded_outwards([low, high]: [f64; 2]) -> [f32; 2] {
    [rounded_down(low), -rounded_down(-high)]
}

/// The greatest number of single precision that is not above a finite one.
fn rounded_down(value: f64) -> f32 {
    let nearest = value as f32;
    let is_above = f64::from(nearest) > value;
    if nearest == 0.0 {
        return if is_above { nearest.next_down() } else { nearest };
    }
    // the next number by its bits, for nobody foresees whether it is needed
    let bits = nearest.to_bits() as i32;
    let toward_zero = 1 + 2 * (bits >> 31);
    f32::from_bits((bits - i32::from(is_above) * toward_zero) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bounds_beyond_single_precision_hold_all_the_same() {
        let whole = [f32::NEG_INFINITY, f32::INFINITY];
        assert_eq!(rounded_outwards([-1e300, 1e300]), whole);
        assert_eq!(rounded_outwards([1e300, 1e300]), [f32::MAX, f32::INFINITY]);
        assert_eq!(finite_bounds(&[f64::NAN], (0.0, 1.0)), None);
        assert_eq!(finite_bounds(&[0.0, f64::INFINITY], (0.0, f64::INFINITY)), None);
    }

    #[test]
    fn cells_of_all_blocks_are_found() {
        // a slope over three blocks and a part of one, with cells that are left out
        let bounds = |cell: usize| (cell % 7 != 6).then_some([cell as f64, cell as f64 + 2.0]);
        let mut ranges = CellRanges::of_bounds(100, bounds);
        ranges.exclude(|cell| cell % 10 == 3);
        for level in [-1.0, 0.5, 31.5, 32.0, 64.25, 101.0, 200.0] {
            let holds = |cell: &u32| {
                let low = f64::from(*cell);
                cell % 7 != 6 && cell % 10 != 3 && (low..=low + 2.0).contains(&level)
            };
            let expected: Vec<u32> = (0..100).filter(holds).collect();
            assert_eq!(ranges.cells_near(level, |_| 0.0), expected, "{level}");
        }
    }

    #[test]
    fn narrowing_by_hand() {
        let bounds = [Some([0.0, 1.0]), Some([0.0, 2.0]), None, Some([0.0, 9.0])];
        let mut ranges = CellRanges::of_bounds(4, |cell| bounds[cell]);
        assert_eq!(ranges.exclude(|cell| cell == 3), 1);
        // the cubic of one cell is not finite after all
        let narrower = [Some([0.0, 0.5]), None, None, Some([1.0, 2.0])];
        ranges.narrow_to(&Subset::new(4, |cell| cell > 0), |cell| narrower[cell]);
        assert_eq!(ranges.ranges, [[0.0, 1.0], EMPTY, EMPTY, EMPTY]);
        assert_eq!((ranges.unusable(), ranges.leaves_out_any()), (2, true));
    }

    #[test]
    fn cells_with_extremes_by_hand() {
        let bounds = [[0.0, 1.0], [-0.5, 0.5], [0.0, 1.5], [0.1, 0.1]];
        let ranges = CellRanges::of_bounds(4, |cell| Some(bounds[cell]));
        let vertices = [[0.0, 1.0], [0.0, 0.1], [0.2, 0.3], [0.1, 0.1]];
        let at_vertices = ranges.at_vertices(|cell| vertices[cell]).unwrap();
        assert_eq!(at_vertices, [0.0, 1.0]);
        let beyond = ranges.cells_beyond(at_vertices, |cell| Some(bounds[cell]));
        assert_eq!(beyond.simplices().collect::<Vec<_>>(), [1, 2]);
        // 0.1 is no number of single precision
        let plateau = CellRanges::of_bounds(2, |_| Some([0.1, 0.1]));
        assert!(plateau.cells_beyond([0.1, 0.1], |_| Some([0.1, 0.1])).is_empty());
        // what is left out has no values
        let none = CellRanges::of_bounds(2, |_| None);
        assert_eq!(none.at_vertices(|_| [0.0]), None);
    }

    #[test]
    fn levels_in_ranges_by_hand() {
        let levels = [-1.0, 0.0, 2.0, 5.0];
        for (range, expected) in [
            ([0.5, 1.5], false),
            ([0.5, 2.0], true),
            ([-3.0, 7.0], true),
            ([2.000_001, 3.0], true),
            ([2.1, 3.0], false),
            ([5.1, 6.0], false),
            ([-3.0, -1.1], false),
            ([-3.0, -1.000_001], true),
        ] {
            assert_eq!(holds_any(range, &levels), expected, "{range:?}");
        }
        assert!(!holds_any([0.0, 1.0], &[]));
    }

    proptest! {
        #[test]
        fn any_of_the_levels_is_one_of_them(
            mut levels in prop::collection::vec(-9.0..9.0_f64, 0..5),
            low in -10.0..10.0_f64,
            width in 0.0..3.0_f64,
        ) {
            levels.sort_by(f64::total_cmp);
            let range = [low, low + width];
            let holds_one = |&level: &f64| holds(range, level, |r| rounding::of_range(r, level));
            prop_assert_eq!(holds_any(range, &levels), levels.iter().any(holds_one));
        }

        #[test]
        fn rounding_outwards_is_certain_and_tight(low in any::<f64>(), width in 0.0..1e10_f64) {
            prop_assume!(low.is_finite() && (low + width).is_finite());
            let [l, h] = rounded_outwards([low, low + width]).map(f64::from);
            prop_assert!(l <= low && low + width <= h);
            let largest = low.abs().max((low + width).abs());
            prop_assert!(largest > 1e38 || low - l <= 1e-6 * largest.max(1e-38));
        }
    }
}
