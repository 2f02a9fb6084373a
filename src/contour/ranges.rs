//! Stage one: the range of the interpolant on each cell (thesis, section 2.3.1).
//!
//! The thesis searches for the extremes of each cubic, which may miss some; its
//! Bernstein coefficients bound the cubic with certainty, and cost less
//! ([`TetrahedronCubic::value_bounds`]). The bounds may be a little wide: then
//! stage two looks at a cell in vain. Where a *tight* range is wanted, to place
//! levels, the thesis' recursive search is used ([`recursive_extreme`]), on the
//! few cells that could matter.

use rayon::prelude::*;

use super::block_ranges::BlockRanges;
use super::extreme::{Extreme, recursive_extreme};
use super::extreme_in_tetrahedron::recursive_extreme_in_tetrahedron;
use super::rounding;
use crate::bernstein::{TetrahedronCubic, TriangleCubic, joined};
use crate::interpolant::{TetrahedronCubics, TriangleCubics};
use crate::interruption::checkpoint;
use crate::mesh::Subset;

/// Certain bounds of the interpolant on each cell, computed once for all levels.
///
/// They are kept in single precision, rounded outwards: still certain, and half as large,
/// which matters beside a mesh. The few cells that they leave are asked again.
#[derive(Clone, Debug)]
pub struct CellRanges {
    /// The cells that have a range, ascending; nothing if all of the mesh have.
    cells: Option<Vec<u32>>,
    /// Least and greatest value of each of them; an empty range for one that is left out.
    ranges: Vec<[f32; 2]>,
    /// What holds the ranges of each [`BLOCK`] of them: a level that it does not hold passes over
    /// them all. Neighbours mostly have numbers that are near each other, so most blocks are.
    blocks: Vec<[f32; 2]>,
    /// The cells of the mesh that are unusable or excluded.
    left_out: Subset,
    unusable: usize,
    excluded: usize,
}

/// Cells that one range holds besides.
const BLOCK: usize = 32;

/// The range of a cell that holds no value.
pub(super) const EMPTY: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

/// A cubic on a cell of two or three dimensions.
pub trait CellCubic {
    /// Its certain bounds; nothing if a coefficient is not finite.
    fn finite_bounds(&self) -> Option<[f64; 2]>;

    /// An extreme value that it attains, by the recursive search.
    fn attained(&self, which: Extreme) -> f64;
}

impl CellCubic for TriangleCubic {
    fn finite_bounds(&self) -> Option<[f64; 2]> {
        finite(&self.coefficients).then(|| self.value_bounds())
    }

    fn attained(&self, which: Extreme) -> f64 {
        recursive_extreme(self, which).value
    }
}

impl CellCubic for TetrahedronCubic {
    fn finite_bounds(&self) -> Option<[f64; 2]> {
        finite(&self.coefficients).then(|| self.value_bounds())
    }

    fn attained(&self, which: Extreme) -> f64 {
        recursive_extreme_in_tetrahedron(self, which).value
    }
}

impl CellRanges {
    /// The ranges of all triangles of `interpolant`.
    pub fn new(interpolant: &dyn TriangleCubics) -> Self {
        let cells = interpolant.mesh().triangles().len();
        Self::of_all(cells, |cell| interpolant.cubic(cell).finite_bounds())
    }

    /// The ranges of all tetrahedra of `interpolant`.
    pub fn of_tetrahedra(interpolant: &dyn TetrahedronCubics) -> Self {
        let cells = interpolant.mesh().tetrahedra().len();
        Self::of_all(cells, |cell| interpolant.cubic(cell).finite_bounds())
    }

    /// Ranges of so many cells, each within the bounds that are given; nothing for unusable cells.
    fn of_all(cells: usize, bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync + Send) -> Self {
        let range = |cell| {
            checkpoint();
            bounds(cell).map_or(EMPTY, rounded_outwards)
        };
        let ranges: Vec<[f32; 2]> = (0..cells).into_par_iter().map(range).collect();
        let left_out = Subset::new(cells, |cell| ranges[cell] == EMPTY);
        let (blocks, unusable) = (blocks(&ranges), left_out.len());
        Self { cells: None, ranges, blocks, left_out, unusable, excluded: 0 }
    }

    /// The ranges of some cells, whose cubics are known, of those that were bounded before: the
    /// others are not to be looked at.
    pub fn of_some<Cubic: CellCubic>(
        cells: &Subset,
        bounded: &BlockRanges,
        cubic: impl Fn(usize) -> Cubic + Sync,
    ) -> Self {
        let numbers: Vec<u32> = cells.simplices().map(|cell| cell as u32).collect();
        let range = |&cell: &u32| {
            checkpoint();
            cubic(cell as usize).finite_bounds().map_or(EMPTY, rounded_outwards)
        };
        let ranges: Vec<[f32; 2]> = numbers.par_iter().map(range).collect();
        // the neighbours may make a coefficient infinite
        let is_lost = |cell| cells.place(cell).is_some_and(|place| ranges[place] == EMPTY);
        let is_left_out = |cell| bounded.leaves_out(cell) || is_lost(cell);
        let left_out = if bounded.leaves_out_any() || ranges.contains(&EMPTY) {
            Subset::new(bounded.cells(), is_left_out)
        } else {
            Subset::none(bounded.cells())
        };
        let excluded = bounded.excluded();
        let (blocks, unusable) = (blocks(&ranges), left_out.len() - excluded);
        Self { cells: Some(numbers), ranges, blocks, left_out, unusable, excluded }
    }

    /// Leaves out the usable cells for which `excluded` says so; returns how many.
    pub fn exclude(&mut self, excluded: impl Fn(usize) -> bool + Sync) -> usize {
        let before = self.left_out.len();
        let left_out = &self.left_out;
        let is_left_out = |cell: usize| left_out.contains(cell) || excluded(cell);
        self.left_out = Subset::new(left_out.simplex_count(), is_left_out);
        for (place, range) in self.ranges.iter_mut().enumerate() {
            let cell = self.cells.as_ref().map_or(place, |cells| cells[place] as usize);
            if self.left_out.contains(cell) {
                *range = EMPTY;
            }
        }
        let count = self.left_out.len() - before;
        self.excluded += count;
        count
    }

    /// Whether any cell is left out: unusable, or excluded.
    pub fn leaves_out_any(&self) -> bool {
        !self.left_out.is_empty()
    }

    /// Whether a cell is left out: unusable, or excluded.
    pub fn leaves_out(&self, cell: usize) -> bool {
        self.left_out.contains(cell)
    }

    /// How many cells have a value or a gradient that is not finite. They hold
    /// no contour.
    pub fn unusable(&self) -> usize {
        self.unusable
    }

    /// The cells whose range holds `level`, give or take the `tolerance` of that
    /// range, ascending; `bounds` are those of a cell's cubic. The tolerance must not be less for
    /// a wider range.
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
        let places = near.flat_map_iter(|(number, (_, ranges))| {
            let numbered = (number * BLOCK..).zip(ranges).filter(|(_, range)| holds(range));
            numbered.map(|(place, _)| place)
        });
        places.map(|place| self.cell(place)).collect()
    }

    /// The cell whose range stands at a place.
    fn cell(&self, place: usize) -> u32 {
        self.cells.as_ref().map_or(place as u32, |cells| cells[place])
    }

    /// Least and greatest value that the interpolant attains, by the recursive
    /// search; nothing without usable cells.
    ///
    /// Levels strictly between them have a contour, which is not so for levels
    /// between the bounds.
    pub fn attained(&self, interpolant: &dyn TriangleCubics) -> Option<[f64; 2]> {
        let at_vertices = self.at_vertices(|cell| interpolant.vertices(cell))?;
        Some(self.attained_beyond(at_vertices, |cell| interpolant.cubic(cell)))
    }

    /// The same for tetrahedra.
    pub fn attained_in_tetrahedra(&self, interpolant: &dyn TetrahedronCubics) -> Option<[f64; 2]> {
        let at_vertices = self.at_vertices(|cell| interpolant.vertices(cell))?;
        Some(self.attained_beyond(at_vertices, |cell| interpolant.cubic(cell)))
    }

    /// The same where it is known what is attained at the vertices.
    pub fn attained_beyond<Cubic: CellCubic>(
        &self,
        [low, high]: [f64; 2],
        cubic: impl Fn(usize) -> Cubic + Sync,
    ) -> [f64; 2] {
        let low = self.attained_extreme(Extreme::Minimum, low, &cubic);
        let high = self.attained_extreme(Extreme::Maximum, high, &cubic);
        [low, high]
    }

    /// The extreme value, which at vertices is `start`.
    fn attained_extreme<Cubic: CellCubic>(
        &self,
        which: Extreme,
        start: f64,
        cubic: impl Fn(usize) -> Cubic + Sync,
    ) -> f64 {
        let promises = |range: [f64; 2]| which.better(which.of(range), start) != start;
        let searched = self.usable().filter_map(|place| {
            if !promises(self.ranges[place].map(f64::from)) {
                return None;
            }
            let cubic = cubic(self.cell(place) as usize);
            // a plateau promises only by the rounding to single precision
            cubic.finite_bounds().filter(|&range| promises(range))?;
            checkpoint();
            Some(cubic.attained(which))
        });
        searched.reduce(|| start, |a, b| which.better(a, b))
    }

    /// The least and the greatest value at the vertices of usable cells; `vertices` are those of a
    /// cell. Nothing without usable cells.
    pub fn at_vertices<const CORNERS: usize>(
        &self,
        vertices: impl Fn(usize) -> [f64; CORNERS] + Sync,
    ) -> Option<[f64; 2]> {
        let nothing = || [f64::INFINITY, f64::NEG_INFINITY];
        let include = |range, place| {
            let values = vertices(self.cell(place) as usize).into_iter();
            values.fold(range, |range, value| joined(range, [value, value]))
        };
        let [low, high] = self.usable().fold(nothing, include).reduce(nothing, joined);
        (low <= high).then_some([low, high])
    }

    /// The places of the cells that are not left out.
    fn usable(&self) -> impl ParallelIterator<Item = usize> {
        (0..self.ranges.len()).into_par_iter().filter(|&place| self.ranges[place] != EMPTY)
    }
}

/// What holds each block of ranges.
fn blocks(ranges: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let joined = |a: [f32; 2], b: &[f32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    ranges.par_chunks(BLOCK).map(|block| block.iter().fold(EMPTY, joined)).collect()
}

/// Whether a range holds a level, give or take its tolerance.
pub fn holds([low, high]: [f64; 2], level: f64, tolerance: impl Fn([f64; 2]) -> f64) -> bool {
    // the exact comparison settles nearly all cells
    let outside = level < low || level > high;
    !outside || (low - level).max(level - high) <= tolerance([low, high])
}

/// Whether a range holds any of the levels, which ascend, to rounding: that of the range of `all`
/// cells, so that one is among them which is near a level as a part of a wall.
pub fn holds_any(range: [f64; 2], levels: &[f64], all: [f64; 2]) -> bool {
    // farther ones are farther outside by more than their own rounding grows
    let next = levels.partition_point(|&level| level < range[0]);
    let nearest = &levels[next.saturating_sub(1)..levels.len().min(next + 1)];
    nearest.iter().any(|&level| holds(range, level, |_| rounding::of_range(all, level)))
}

/// Whether all coefficients are finite.
fn finite(coefficients: &[f64]) -> bool {
    // without a branch for each
    coefficients.iter().fold(true, |all, c| all & c.is_finite())
}

/// A range in single precision that holds the given one.
pub(super) fn rounded_outwards([low, high]: [f64; 2]) -> [f32; 2] {
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
        for wrong in [f64::NAN, f64::INFINITY] {
            assert_eq!(TriangleCubic::linear([0.0, wrong, 1.0]).finite_bounds(), None);
        }
    }

    #[test]
    fn cells_of_all_blocks_are_found() {
        // a slope over three blocks and a part of one, with cells that are left out
        let bounds = |cell: usize| (cell % 7 != 6).then_some([cell as f64, cell as f64 + 2.0]);
        let mut ranges = CellRanges::of_all(100, bounds);
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
    fn ranges_of_some_by_hand() {
        let bounds = |cell: usize| (cell != 2).then_some([0.0, 9.0]);
        let bounded = BlockRanges::new(40, |_| None, bounds, |_| [0.0], |cell| cell == 3);
        // the cubic of one cell is not finite after all
        let cubic = |cell: usize| {
            let high = if cell == 30 { f64::NAN } else { cell as f64 };
            TriangleCubic::linear([0.0, 0.0, high])
        };
        let some = Subset::new(40, |cell| cell % 10 == 0 && cell > 0);
        let ranges = CellRanges::of_some(&some, &bounded, cubic);
        assert_eq!(ranges.ranges, [[0.0, 10.0], [0.0, 20.0], EMPTY]);
        assert_eq!((ranges.unusable(), ranges.leaves_out_any()), (2, true));
        let left_out: Vec<usize> = (0..40).filter(|&cell| ranges.leaves_out(cell)).collect();
        assert_eq!(left_out, [2, 3, 30]);
        assert_eq!(ranges.cells_near(5.0, |_| 0.0), [10, 20]);
        assert_eq!(ranges.cells_near(15.0, |_| 0.0), [20]);
        assert_eq!(ranges.attained_beyond([0.0, 12.0], cubic), [0.0, 20.0]);
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
            assert_eq!(holds_any(range, &levels, [-3.0, 7.0]), expected, "{range:?}");
        }
        assert!(!holds_any([0.0, 1.0], &[], [0.0, 1.0]));
        // a cell of little spread at a wall
        assert!(!holds_any([1e-6, 2e-6], &[0.0], [0.0, 0.5]));
        assert!(holds_any([1e-6, 2e-6], &[0.0], [0.0, 1.0]));
    }

    proptest! {
        #[test]
        fn any_of_the_levels_is_one_of_them(
            mut levels in prop::collection::vec(-9.0..9.0_f64, 0..5),
            low in -10.0..10.0_f64,
            width in 0.0..3.0_f64,
            wider in 0.0..1e6_f64,
        ) {
            levels.sort_by(f64::total_cmp);
            let (range, all) = ([low, low + width], [low - wider, low + width]);
            let holds_one = |&level: &f64| holds(range, level, |_| rounding::of_range(all, level));
            prop_assert_eq!(holds_any(range, &levels, all), levels.iter().any(holds_one));
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
