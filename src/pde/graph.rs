//! The expression graph: what has to be computed, each thing once.
//!
//! Equal expressions get the same node, and operations on constants are done
//! when they are added. Only rewritings that keep every bit of the result are
//! made, so a folded expression computes what was written: x·1 is x, but 0·x is
//! not 0 (x may be infinite) and sums are not reordered.

use super::operation::{Binary, Unary};
use std::collections::HashMap;

/// Index of a node; operands have smaller ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Id(usize);

impl Id {
    pub fn index(self) -> usize {
        self.0
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Expression {
    /// The bits of a number, so that nodes can be compared and hashed.
    Constant(u64),
    /// Number of an input, see [`INPUTS`](super::names::INPUTS).
    Input(usize),
    Unary(Unary, Id),
    Binary(Binary, Id, Id),
}

/// Expressions that share their parts.
#[derive(Debug, Default)]
pub(super) struct Graph {
    nodes: Vec<Expression>,
    known: HashMap<Expression, Id>,
}

impl Graph {
    /// The nodes; operands come before the operations on them.
    pub fn nodes(&self) -> &[Expression] {
        &self.nodes
    }

    /// The value of a node that is a number.
    pub fn value(&self, id: Id) -> Option<f64> {
        match self.nodes[id.0] {
            Expression::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    pub fn constant(&mut self, value: f64) -> Id {
        self.add(Expression::Constant(value.to_bits()))
    }

    pub fn input(&mut self, number: usize) -> Id {
        self.add(Expression::Input(number))
    }

    pub fn unary(&mut self, operation: Unary, a: Id) -> Id {
        if let Some(value) = self.value(a) {
            return self.constant(operation.apply(value));
        }
        match (operation, self.nodes[a.0]) {
            (Unary::Negate, Expression::Unary(Unary::Negate, inner)) => inner,
            _ => self.add(Expression::Unary(operation, a)),
        }
    }

    pub fn binary(&mut self, operation: Binary, a: Id, b: Id) -> Id {
        match (self.value(a), self.value(b)) {
            (Some(left), Some(right)) => self.constant(operation.apply(left, right)),
            (Some(left), None) => self.with_left_constant(operation, left, a, b),
            (None, Some(right)) => self.with_right_constant(operation, a, b, right),
            (None, None) => self.add(Expression::Binary(operation, a, b)),
        }
    }

    fn with_left_constant(&mut self, operation: Binary, value: f64, a: Id, b: Id) -> Id {
        match (operation, value) {
            (Binary::Multiply, 1.0) => b,
            (Binary::Multiply, -1.0) => self.unary(Unary::Negate, b),
            _ => self.add(Expression::Binary(operation, a, b)),
        }
    }

    fn with_right_constant(&mut self, operation: Binary, a: Id, b: Id, value: f64) -> Id {
        match (operation, value) {
            (Binary::Multiply | Binary::Divide, 1.0) => a,
            (Binary::Multiply | Binary::Divide, -1.0) => self.unary(Unary::Negate, a),
            (Binary::Power, _) => self.power(a, b, value),
            _ => self.add(Expression::Binary(operation, a, b)),
        }
    }

    /// Small whole powers as products: many times faster than pow. The same
    /// products, in the same order, as in [`Binary::apply`].
    fn power(&mut self, a: Id, b: Id, exponent: f64) -> Id {
        match exponent {
            -1.0 => {
                let one = self.constant(1.0);
                self.divide(one, a)
            }
            // By IEEE 754 even for NaN; and so u^0 has the derivative 0 at u = 0.
            0.0 => self.constant(1.0),
            1.0 => a,
            2.0 => self.multiply(a, a),
            3.0 => {
                let square = self.multiply(a, a);
                self.multiply(square, a)
            }
            4.0 => {
                let square = self.multiply(a, a);
                self.multiply(square, square)
            }
            _ => self.add(Expression::Binary(Binary::Power, a, b)),
        }
    }

    pub fn plus(&mut self, a: Id, b: Id) -> Id {
        self.binary(Binary::Add, a, b)
    }

    pub fn minus(&mut self, a: Id, b: Id) -> Id {
        self.binary(Binary::Subtract, a, b)
    }

    pub fn multiply(&mut self, a: Id, b: Id) -> Id {
        self.binary(Binary::Multiply, a, b)
    }

    pub fn divide(&mut self, a: Id, b: Id) -> Id {
        self.binary(Binary::Divide, a, b)
    }

    pub fn negate(&mut self, a: Id) -> Id {
        self.unary(Unary::Negate, a)
    }

    /// A sum in which `None` stands for a term that is not there.
    pub fn sum(&mut self, a: Option<Id>, b: Option<Id>) -> Option<Id> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.plus(a, b)),
            _ => a.or(b),
        }
    }

    /// A difference in which `None` stands for a term that is not there.
    pub fn difference(&mut self, a: Option<Id>, b: Option<Id>) -> Option<Id> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.minus(a, b)),
            (None, Some(b)) => Some(self.negate(b)),
            (a, None) => a,
        }
    }

    fn add(&mut self, expression: Expression) -> Id {
        let next = Id(self.nodes.len());
        let id = *self.known.entry(expression).or_insert(next);
        if id == next {
            self.nodes.push(expression);
        }
        id
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_expressions_are_one_node() {
        let mut graph = Graph::default();
        let x = graph.input(0);
        let sin = graph.unary(Unary::Sin, x);
        let again = graph.unary(Unary::Sin, x);
        assert_eq!(sin, again);
        assert_eq!(graph.nodes().len(), 2);
    }

    #[test]
    fn only_exact_rewritings() {
        let mut graph = Graph::default();
        let x = graph.input(0);
        let [zero, one] = [0.0, 1.0].map(|v| graph.constant(v));
        assert_eq!(graph.multiply(x, one), x);
        assert_eq!(graph.divide(x, one), x);
        let product = graph.multiply(zero, x);
        assert_eq!(graph.value(product), None, "0·x is NaN for infinite x");
    }

    #[test]
    fn constants_are_folded() {
        let mut graph = Graph::default();
        let [two, three] = [2.0, 3.0].map(|v| graph.constant(v));
        let eight = graph.binary(Binary::Power, two, three);
        assert_eq!(graph.value(eight), Some(8.0));
    }

    #[test]
    fn small_powers_are_products() {
        let mut graph = Graph::default();
        let x = graph.input(0);
        let two = graph.constant(2.0);
        let square = graph.binary(Binary::Power, x, two);
        assert_eq!(square, graph.multiply(x, x));
    }
}
