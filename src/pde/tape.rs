//! Expressions as a flat list of instructions, run on 64 points at once.
//!
//! Every value has a row of its own: first the constants, then the inputs, then
//! one row for each instruction. Operands stand before results, so one split of
//! the rows gives all borrows, and nothing is allocated between instructions.
//! A single point is the same program with rows of one lane, hence the same
//! bits.

use super::graph::{Expression, Graph, Id};
use super::operation::{Binary, Unary};
use super::sample::{Batch, LANES};

/// Up to so many rows of one lane lie on the stack.
const SHORT: usize = 64;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Instruction {
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
}

/// A program with K results.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tape<const K: usize> {
    constants: Vec<f64>,
    inputs: Vec<usize>,
    code: Vec<Instruction>,
    /// Rows of the results.
    results: [usize; K],
}

impl<const K: usize> Tape<K> {
    /// The program for K expressions; its length is at most the number of
    /// nodes that they use.
    pub fn compile(graph: &Graph, results: [Id; K]) -> Tape<K> {
        let mut layout = Layout::new(graph, &results);
        let (constants, inputs) = (layout.constants(graph), layout.inputs(graph));
        let code = layout.code(graph);
        Tape { constants, inputs, code, results: results.map(|id| layout.row[id.index()]) }
    }

    /// The inputs that the program reads.
    pub fn inputs(&self) -> &[usize] {
        &self.inputs
    }

    /// The results at one point.
    pub fn evaluate(&self, input: impl Fn(usize) -> f64) -> [f64; K] {
        let mut short = [[0.0]; SHORT];
        let mut long = Vec::new();
        let count = self.row_count();
        let rows = if count <= SHORT {
            &mut short[..count]
        } else {
            long.resize(count, [0.0]);
            &mut long[..]
        };
        self.load_constants(rows);
        self.run(rows, 1, |number| [input(number)]);
        self.results.map(|row| rows[row][0])
    }

    /// The results at all points of a batch; `out` is overwritten, and `make`
    /// turns the results of one point into what the caller wants.
    pub fn evaluate_batch<T>(&self, batch: &Batch, out: &mut Vec<T>, make: impl Fn([f64; K]) -> T) {
        let mut rows = vec![[0.0; LANES]; self.row_count()];
        self.load_constants(&mut rows);
        out.clear();
        out.reserve(batch.len());
        for (inputs, lanes) in batch.blocks() {
            let missing = [f64::NAN; LANES];
            self.run(&mut rows, lanes, |number| inputs.get(number).copied().unwrap_or(missing));
            let results = |lane: usize| self.results.map(|row| rows[row][lane]);
            out.extend((0..lanes).map(|lane| make(results(lane))));
        }
    }

    fn row_count(&self) -> usize {
        self.constants.len() + self.inputs.len() + self.code.len()
    }

    fn load_constants<const N: usize>(&self, rows: &mut [[f64; N]]) {
        for (row, &constant) in rows.iter_mut().zip(&self.constants) {
            *row = [constant; N];
        }
    }

    fn run<const N: usize>(
        &self,
        rows: &mut [[f64; N]],
        lanes: usize,
        input: impl Fn(usize) -> [f64; N],
    ) {
        let inputs = &mut rows[self.constants.len()..];
        for (row, &number) in inputs.iter_mut().zip(&self.inputs) {
            *row = input(number);
        }
        let first = self.constants.len() + self.inputs.len();
        for (i, &instruction) in self.code.iter().enumerate() {
            let (operands, result) = rows.split_at_mut(first + i);
            let result = &mut result[0][..lanes];
            match instruction {
                Instruction::Unary(operation, a) => {
                    unary(operation, result, &operands[a][..lanes]);
                }
                Instruction::Binary(operation, a, b) => {
                    binary(operation, result, [a, b].map(|row| &operands[row][..lanes]));
                }
            }
        }
    }
}

/// One operation on all lanes. The cheap ones have loops of their own, which
/// the compiler vectorises; for the others the call outweighs the branch.
fn unary(operation: Unary, result: &mut [f64], a: &[f64]) {
    match operation {
        Unary::Negate => map(result, a, |a| -a),
        Unary::Sqrt => map(result, a, f64::sqrt),
        Unary::Abs => map(result, a, f64::abs),
        _ => map(result, a, |a| operation.apply(a)),
    }
}

fn binary(operation: Binary, result: &mut [f64], ab: [&[f64]; 2]) {
    match operation {
        Binary::Add => zip(result, ab, |a, b| a + b),
        Binary::Subtract => zip(result, ab, |a, b| a - b),
        Binary::Multiply => zip(result, ab, |a, b| a * b),
        Binary::Divide => zip(result, ab, |a, b| a / b),
        _ => zip(result, ab, |a, b| operation.apply(a, b)),
    }
}

fn map(result: &mut [f64], a: &[f64], operation: impl Fn(f64) -> f64) {
    for (result, &a) in result.iter_mut().zip(a) {
        *result = operation(a);
    }
}

fn zip(result: &mut [f64], [a, b]: [&[f64]; 2], operation: impl Fn(f64, f64) -> f64) {
    for ((result, &a), &b) in result.iter_mut().zip(a).zip(b) {
        *result = operation(a, b);
    }
}

/// Which nodes are needed, and the rows of those placed so far.
struct Layout {
    needed: Vec<bool>,
    row: Vec<usize>,
    rows: usize,
}

impl Layout {
    fn new(graph: &Graph, results: &[Id]) -> Layout {
        let nodes = graph.nodes();
        let mut needed = vec![false; nodes.len()];
        for result in results {
            needed[result.index()] = true;
        }
        // Operations come after their operands: from the last to the first.
        for index in (0..nodes.len()).rev() {
            if needed[index] {
                operands(nodes[index]).for_each(|id| needed[id.index()] = true);
            }
        }
        Layout { row: vec![0; nodes.len()], needed, rows: 0 }
    }

    fn constants(&mut self, graph: &Graph) -> Vec<f64> {
        self.place(graph, |node, _| match node {
            Expression::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        })
    }

    fn inputs(&mut self, graph: &Graph) -> Vec<usize> {
        self.place(graph, |node, _| match node {
            Expression::Input(number) => Some(number),
            _ => None,
        })
    }

    fn code(&mut self, graph: &Graph) -> Vec<Instruction> {
        self.place(graph, |node, row| match node {
            Expression::Unary(operation, a) => Some(Instruction::Unary(operation, row[a.index()])),
            Expression::Binary(operation, a, b) => {
                let (a, b) = (row[a.index()], row[b.index()]);
                Some(Instruction::Binary(operation, a, b))
            }
            _ => None,
        })
    }

    /// Gives the next rows to the needed nodes of one kind.
    fn place<T>(
        &mut self,
        graph: &Graph,
        kind: impl Fn(Expression, &[usize]) -> Option<T>,
    ) -> Vec<T> {
        let mut placed = Vec::new();
        for (index, &node) in graph.nodes().iter().enumerate() {
            if !self.needed[index] {
                continue;
            }
            if let Some(item) = kind(node, &self.row) {
                self.row[index] = self.rows;
                self.rows += 1;
                placed.push(item);
            }
        }
        placed
    }
}

fn operands(node: Expression) -> impl Iterator<Item = Id> {
    let [a, b] = match node {
        Expression::Constant(_) | Expression::Input(_) => [None, None],
        Expression::Unary(_, a) => [Some(a), None],
        Expression::Binary(_, a, b) => [Some(a), Some(b)],
    };
    a.into_iter().chain(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pde::Sample;

    /// x·y + x, and sin 2x.
    fn example() -> Tape<2> {
        let mut graph = Graph::default();
        let [x, y] = [0, 1].map(|number| graph.input(number));
        let unused = graph.unary(Unary::Exp, y);
        let product = graph.multiply(x, y);
        let sum = graph.plus(product, x);
        let two = graph.constant(2.0);
        let double = graph.multiply(two, x);
        let sin = graph.unary(Unary::Sin, double);
        assert!(unused < sin);
        Tape::compile(&graph, [sum, sin])
    }

    #[test]
    fn what_is_not_used_is_not_computed() {
        let tape = example();
        assert_eq!(tape.code.len(), 4);
        assert_eq!(tape.constants, [2.0]);
        assert_eq!(tape.inputs(), [0, 1]);
    }

    #[test]
    fn one_point() {
        let results = example().evaluate(|number| [3.0, 5.0][number]);
        assert_eq!(results, [18.0, 6f64.sin()]);
    }

    #[test]
    fn a_batch_that_ends_inside_a_block() {
        let tape = example();
        let mut batch = Batch::new(0);
        for i in 0..LANES + 3 {
            let x = [i as f64, 1.0, 0.0];
            batch.push(&Sample { x, ..Sample::default() });
        }
        let mut out = vec![[9.0; 2]];
        tape.evaluate_batch(&batch, &mut out, |results| results);
        assert_eq!(out.len(), LANES + 3);
        for (i, results) in out.iter().enumerate() {
            assert_eq!(*results, [2.0 * i as f64, (2.0 * i as f64).sin()]);
        }
    }
}
