//! Bounds of the interpolant on blocks of cells: what is known before the cubic of any cell is.

use std::ops::Range;

use rayon::prelude::*;

use super::ranges::{EMPTY, rounded_outwards};
use crate::bernstein::joined;
use crate::interpolant::JointReach;
use crate::interruption::checkpoint;
use crate::mesh::Subset;

/// What holds the bounds of the interpolant on each block of cells, by which most cells are passed
/// over where few levels are asked for.
///
/// Cells that follow each other mostly have values that are near each other. So a block that
/// may hold something is rare, and its cells are bounded once more where that is so, instead of
/// the bounds of each being kept.
#[derive(Clone, Debug)]
pub struct BlockRanges {
    cells: usize,
    blocks: Vec<Block>,
    summary: Summary,
}

/// Cells of a block.
const BLOCK: usize = 16;

/// Blocks of which the cells fill a word of a [`Subset`].
const BLOCKS_OF_WORD: usize = u64::BITS as usize / BLOCK;

#[derive(Clone, Copy, Debug)]
struct Block {
    /// What holds the ranges of its cells, rounded outwards.
    range: [f32; 2],
    /// One bit a cell: whether it is left out.
    left_out: u16,
}

/// What is known of some cells together.
#[derive(Clone, Copy, Debug)]
struct Summary {
    /// The least and the greatest value at the vertices of those that are not left out.
    at_vertices: [f64; 2],
    unusable: usize,
    excluded: usize,
}

impl Summary {
    fn none() -> Self {
        Self { at_vertices: [f64::INFINITY, f64::NEG_INFINITY], unusable: 0, excluded: 0 }
    }

    fn joined(self, other: Self) -> Self {
        Self {
            at_vertices: joined(self.at_vertices, other.at_vertices),
            unusable: self.unusable + other.unusable,
            excluded: self.excluded + other.excluded,
        }
    }
}

impl BlockRanges {
    /// The ranges of so many cells: each within its `bounds`, which are nothing for
    /// unusable cells; `vertices` are the values at a cell's vertices, finite if it has bounds.
    /// Usable cells for which `is_excluded` says so are left out as well. `joint` bounds several cells
    /// in less time; nothing if not all may be usable.
    pub fn new<const CORNERS: usize>(
        cells: usize,
        joint: impl Fn(Range<usize>) -> Option<JointReach> + Sync,
        bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync,
        vertices: impl Fn(usize) -> [f64; CORNERS] + Sync,
        is_excluded: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let mut blocks = vec![Block { range: EMPTY, left_out: 0 }; cells.div_ceil(BLOCK)];
        let summaries = blocks.par_iter_mut().enumerate().map(|(number, block)| {
            checkpoint();
            let mut summary = Summary::none();
            let mut range = summary.at_vertices;
            let first = number * BLOCK;
            let of_block = first..cells.min(first + BLOCK);
            let are_all_in = !of_block.clone().any(&is_excluded);
            if let Some(all) = are_all_in.then(|| joint(of_block.clone())).flatten() {
                block.range = rounded_outwards(all.range);
                summary.at_vertices = all.at_vertices;
                return summary;
            }
            for cell in of_block {
                match bounds(cell) {
                    Some(_) if is_excluded(cell) => summary.excluded += 1,
                    Some(bounds) => {
                        range = joined(range, bounds);
                        for value in vertices(cell) {
                            summary.at_vertices = joined(summary.at_vertices, [value, value]);
                        }
                        continue;
                    }
                    None => summary.unusable += 1,
                }
                block.left_out |= 1 << (cell - first);
            }
            if range[0] <= range[1] {
                block.range = rounded_outwards(range);
            }
            summary
        });
        let summary = summaries.reduce(Summary::none, Summary::joined);
        Self { cells, blocks, summary }
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// The least and the greatest value at the vertices of the cells that are not left out, if there
    /// are any.
    pub fn at_vertices(&self) -> Option<[f64; 2]> {
        let [low, high] = self.summary.at_vertices;
        (low <= high).then_some([low, high])
    }

    /// What holds the ranges of all cells that are not left out, if there are any, by the `bounds` of
    /// those in blocks that may go beyond the values at vertices: close, however wide the ranges of
    /// blocks are.
    pub fn of_all(&self, bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync) -> Option<[f64; 2]> {
        let at_vertices = self.at_vertices()?;
        let beyond = |number: &usize| {
            let [low, high] = self.blocks[*number].range.map(f64::from);
            low < at_vertices[0] || high > at_vertices[1]
        };
        let blocks = (0..self.blocks.len()).into_par_iter().filter(beyond);
        let ranges = blocks.map(|number| {
            let all = self.kept_of_block(number).filter_map(&bounds);
            all.fold(at_vertices, joined)
        });
        Some(ranges.reduce(|| at_vertices, joined))
    }

    /// How many cells have a value or a gradient that is not finite.
    pub fn unusable(&self) -> usize {
        self.summary.unusable
    }

    /// How many others are left out.
    pub fn excluded(&self) -> usize {
        self.summary.excluded
    }

    /// Whether any cell is left out.
    pub fn leaves_out_any(&self) -> bool {
        self.unusable() + self.excluded() > 0
    }

    /// Whether a cell is left out.
    pub fn leaves_out(&self, cell: usize) -> bool {
        self.blocks[cell / BLOCK].left_out >> (cell % BLOCK) & 1 == 1
    }

    /// The cells whose `bounds` are wanted. What is wanted of bounds must be so of wider ones; these
    /// must be within those that the ranges were made of.
    pub fn cells_with(
        &self,
        bounds: impl Fn(usize) -> Option<[f64; 2]> + Sync,
        is_wanted: impl Fn([f64; 2]) -> bool + Sync,
    ) -> Subset {
        Subset::of_words(self.cells, |word| {
            let first = word * BLOCKS_OF_WORD;
            let numbers = first..self.blocks.len().min(first + BLOCKS_OF_WORD);
            numbers.rev().fold(0, |bits, number| {
                bits << BLOCK | u64::from(self.wanted_of_block(number, &bounds, &is_wanted))
            })
        })
    }

    /// One bit a cell of a block: whether it is wanted.
    fn wanted_of_block(
        &self,
        number: usize,
        bounds: impl Fn(usize) -> Option<[f64; 2]>,
        is_wanted: impl Fn([f64; 2]) -> bool,
    ) -> u16 {
        let range = self.blocks[number].range;
        if range == EMPTY || !is_wanted(range.map(f64::from)) {
            return 0;
        }
        let wanted =
            self.kept_of_block(number).filter(|&cell| bounds(cell).is_some_and(&is_wanted));
        wanted.fold(0, |bits, cell| bits | 1 << (cell % BLOCK))
    }

    /// The cells of a block that are not left out.
    fn kept_of_block(&self, number: usize) -> impl Iterator<Item = usize> {
        let (first, left_out) = (number * BLOCK, self.blocks[number].left_out);
        let cells = first..self.cells.min(first + BLOCK);
        cells.filter(move |cell| left_out >> (cell - first) & 1 == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn numbers(subset: &Subset) -> Vec<usize> {
        subset.simplices().collect()
    }

    #[test]
    fn cells_with_extremes_by_hand() {
        let bounds = [[0.0, 1.0], [-0.5, 0.5], [0.0, 1.5], [0.1, 0.1]];
        let bounds = |cell: usize| Some(bounds[cell]);
        let vertices = [[0.0, 1.0], [0.0, 0.1], [0.2, 0.3], [0.1, 0.1]];
        let ranges = BlockRanges::new(4, |_| None, bounds, |cell| vertices[cell], |_| false);
        assert_eq!(ranges.at_vertices(), Some([0.0, 1.0]));
        assert_eq!(ranges.of_all(bounds), Some([-0.5, 1.5]));
        // however wide the bounds of blocks are
        let wide = |_| Some(JointReach { range: [-9.0, 9.0], at_vertices: [0.0, 1.0] });
        let ranges = BlockRanges::new(4, wide, bounds, |cell| vertices[cell], |_| false);
        assert_eq!(ranges.of_all(bounds), Some([-0.5, 1.5]));
        let beyond = ranges.cells_with(bounds, |[low, high]| low < 0.0 || high > 1.0);
        assert_eq!(numbers(&beyond), [1, 2]);
    }

    #[test]
    fn what_is_left_out_has_no_values() {
        let bounds = |cell: usize| (cell != 1).then_some([0.0, cell as f64]);
        let ranges =
            BlockRanges::new(4, |_| None, bounds, |cell| [cell as f64], |cell| cell % 3 == 0);
        assert_eq!((ranges.unusable(), ranges.excluded()), (1, 2));
        assert_eq!(ranges.at_vertices(), Some([2.0, 2.0]));
        assert_eq!([0, 1, 2, 3].map(|cell| ranges.leaves_out(cell)), [true, true, false, true]);
        assert_eq!(numbers(&ranges.cells_with(bounds, |_| true)), [2]);
        let none = BlockRanges::new(2, |_| None, |_| None, |_| [0.0], |_| false);
        assert_eq!((none.at_vertices(), none.of_all(|_| None)), (None, None));
    }

    /// So that there are blocks of which all are usable, and others.
    fn mostly() -> impl Strategy<Value = bool> {
        prop::bool::weighted(0.97)
    }

    proptest! {
        #[test]
        fn wanted_cells_are_found_in_any_block(
            all in prop::collection::vec((mostly(), -9.0..9.0_f64, 0.0..2.0_f64), 0..200),
            level in -9.0..9.0_f64,
            is_in in prop::collection::vec(mostly(), 200),
        ) {
            let exact = |cell: usize| {
                let (is_usable, low, width) = all[cell];
                is_usable.then_some([low, low + width])
            };
            let wider = |cells: Range<usize>| {
                let range = cells.map(exact).reduce(|one, other| Some(joined(one?, other?)))?;
                let range = range.map(|[low, high]| [low - 0.5, high + 0.25])?;
                Some(JointReach { range, at_vertices: [0.0; 2] })
            };
            let is_excluded = |cell: usize| !is_in[cell];
            let ranges = BlockRanges::new(all.len(), wider, exact, |_| [0.0], is_excluded);
            let holds = |[low, high]: [f64; 2]| low <= level && level <= high;
            let is_wanted = |cell: &usize| !is_excluded(*cell) && exact(*cell).is_some_and(holds);
            let wanted: Vec<usize> = (0..all.len()).filter(is_wanted).collect();
            prop_assert_eq!(numbers(&ranges.cells_with(exact, holds)), wanted);
        }
    }
}
