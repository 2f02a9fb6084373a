//! Where an equation is evaluated: one point, or many in blocks.

use super::names::INPUTS;

/// Points of a block: the evaluator makes each operation on so many at once.
pub const LANES: usize = 64;

/// Everything that a right-hand side may use at one point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sample<'a> {
    /// Coordinates, in mesh units; z is 0 in the plane.
    pub x: [f64; 3],
    /// The solution u.
    pub u: f64,
    /// ux, uy, uz.
    pub gradient: [f64; 3],
    /// Values of the point arrays of
    /// [`used_arrays`](super::Pde::used_arrays), in that order. A value that is
    /// missing is taken as NaN.
    pub arrays: &'a [f64],
}

impl Sample<'_> {
    /// The input of this number; NaN if there is none.
    pub(super) fn input(&self, number: usize) -> f64 {
        match number {
            0..=2 => self.x[number],
            3 => self.u,
            4..=6 => self.gradient[number - 4],
            _ => self.array(number - INPUTS.len()),
        }
    }

    fn array(&self, slot: usize) -> f64 {
        self.arrays.get(slot).copied().unwrap_or(f64::NAN)
    }
}

/// Any number of samples, in blocks of [`LANES`], each quantity in a row of its
/// own. Made by [`Pde::batch`](super::Pde::batch); to be reused, as
/// [`clear`](Batch::clear) keeps the memory.
#[derive(Debug, Clone)]
pub struct Batch {
    /// Rows of one block: the inputs with fixed names, then the arrays.
    inputs: usize,
    /// The rows of the first block, of the second, and so on.
    rows: Vec<[f64; LANES]>,
    len: usize,
}

impl Batch {
    pub(super) fn new(arrays: usize) -> Batch {
        Batch { inputs: INPUTS.len() + arrays, rows: Vec::new(), len: 0 }
    }

    /// Adds a sample.
    pub fn push(&mut self, sample: &Sample) {
        let lane = self.len % LANES;
        if lane == 0 {
            let rows = self.rows.len() + self.inputs;
            self.rows.resize(rows, [0.0; LANES]);
        }
        let block = self.rows.len() - self.inputs;
        for (number, row) in self.rows[block..].iter_mut().enumerate() {
            row[lane] = sample.input(number);
        }
        self.len += 1;
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Drops the samples, keeps the memory.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.len = 0;
    }

    /// The blocks: rows of inputs, and how many lanes hold samples.
    pub(super) fn blocks(&self) -> impl Iterator<Item = (&[[f64; LANES]], usize)> {
        self.rows
            .chunks_exact(self.inputs)
            .enumerate()
            .map(|(i, rows)| (rows, (self.len - i * LANES).min(LANES)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_in_the_order_of_their_names() {
        let sample =
            Sample { x: [0.0, 1.0, 2.0], u: 3.0, gradient: [4.0, 5.0, 6.0], arrays: &[7.0, 8.0] };
        for number in 0..9 {
            assert_eq!(sample.input(number), number as f64);
        }
        assert!(sample.input(9).is_nan());
    }

    #[test]
    fn blocks_hold_64_samples() {
        let mut batch = Batch::new(1);
        for i in 0..LANES + 2 {
            batch.push(&Sample { u: i as f64, ..Sample::default() });
        }
        let blocks: Vec<_> = batch.blocks().collect();
        assert_eq!(blocks.len(), 2);
        assert_eq!((blocks[0].1, blocks[1].1), (LANES, 2));
        assert_eq!(blocks[1].0[3][1], (LANES + 1) as f64);
        assert_eq!(blocks[1].0.len(), 8);
        assert!(blocks[0].0[7][0].is_nan());
        batch.clear();
        assert!(batch.is_empty() && batch.blocks().next().is_none());
    }
}
