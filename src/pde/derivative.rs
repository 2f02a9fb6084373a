//! First derivatives of an expression with respect to an input.
//!
//! One pass over the graph, operands first, so the derivative of a long
//! expression has a length proportional to it (shared parts stay shared).
//! Parts that do not depend on the input have no derivative (`None`), so no
//! zeros are multiplied. At the kinks of `abs`, `min`, `max` and the jumps of
//! `sign`, `floor`, `ceil`, `heaviside` the derivative is the mean of both
//! sides' derivatives.

use super::graph::{Expression, Graph, Id};
use super::operation::{Binary, Unary};
use std::f64::consts::{LN_2, LN_10, PI};

impl Graph {
    /// The derivative of an expression with respect to an input; `None` if it
    /// is zero everywhere.
    pub fn derivative(&mut self, of: Id, input: usize) -> Option<Id> {
        let mut slopes: Vec<Option<Id>> = Vec::new();
        for index in 0..=of.index() {
            let slope = match self.nodes()[index] {
                Expression::Constant(_) => None,
                Expression::Input(number) => (number == input).then(|| self.constant(1.0)),
                Expression::Unary(operation, a) => {
                    slopes[a.index()].and_then(|slope| self.unary_derivative(operation, a, slope))
                }
                Expression::Binary(operation, a, b) => {
                    let ab = [slopes[a.index()], slopes[b.index()]];
                    self.binary_derivative(operation, [a, b], ab)
                }
            };
            slopes.push(slope);
        }
        slopes[of.index()]
    }

    /// The chain rule for f(a), given a'.
    fn unary_derivative(&mut self, operation: Unary, a: Id, slope: Id) -> Option<Id> {
        if operation == Unary::Negate {
            return Some(self.negate(slope));
        }
        let value = self.unary(operation, a);
        let outer = self.slope(operation, a, value)?;
        Some(self.multiply(outer, slope))
    }

    /// f'(a), given f(a); `None` where f is piecewise constant.
    fn slope(&mut self, operation: Unary, a: Id, value: Id) -> Option<Id> {
        Some(match operation {
            Unary::Sin => self.unary(Unary::Cos, a),
            Unary::Cos => {
                let sin = self.unary(Unary::Sin, a);
                self.negate(sin)
            }
            Unary::Tan => self.one_plus_square(value),
            Unary::Sinh => self.unary(Unary::Cosh, a),
            Unary::Cosh => self.unary(Unary::Sinh, a),
            Unary::Tanh => self.one_minus_square(value),
            Unary::Exp => value,
            Unary::Abs => self.unary(Unary::Sign, a),
            Unary::Erf => self.bell(a),
            Unary::Negate | Unary::Sign | Unary::Floor | Unary::Ceil | Unary::Heaviside => {
                return None;
            }
            _ => self.reciprocal_slope(operation, a, value),
        })
    }

    /// f'(a) of the functions whose derivative is one over something.
    fn reciprocal_slope(&mut self, operation: Unary, a: Id, value: Id) -> Id {
        let below = match operation {
            Unary::Asin | Unary::Acos => {
                let square = self.one_minus_square(a);
                self.unary(Unary::Sqrt, square)
            }
            Unary::Atan => self.one_plus_square(a),
            Unary::Log10 => self.times(LN_10, a),
            Unary::Log2 => self.times(LN_2, a),
            Unary::Sqrt => self.times(2.0, value),
            Unary::Cbrt => {
                let square = self.multiply(value, value);
                self.times(3.0, square)
            }
            _ => a,
        };
        let above = self.constant(if operation == Unary::Acos { -1.0 } else { 1.0 });
        self.divide(above, below)
    }

    fn binary_derivative(
        &mut self,
        operation: Binary,
        [a, b]: [Id; 2],
        slopes: [Option<Id>; 2],
    ) -> Option<Id> {
        let wanted = slopes.map(|slope| slope.is_some());
        let partial = match operation {
            Binary::Add => return self.sum(slopes[0], slopes[1]),
            Binary::Subtract => return self.difference(slopes[0], slopes[1]),
            Binary::Multiply => [Some(b), Some(a)],
            Binary::Divide => self.divide_slopes(a, b, wanted),
            Binary::Power => self.power_slopes(a, b, wanted),
            Binary::Atan2 => self.atan2_slopes(a, b, wanted),
            Binary::Hypot => self.hypot_slopes(a, b),
            Binary::Minimum => return self.branches([[a, b], [b, a]], slopes),
            Binary::Maximum => return self.branches([[b, a], [a, b]], slopes),
            Binary::Less | Binary::Gate => return None,
        };
        let [left, right] = [0, 1].map(|k| self.product(partial[k], slopes[k]));
        self.sum(left, right)
    }

    /// a/b: 1/b and -(a/b)/b.
    fn divide_slopes(&mut self, a: Id, b: Id, wanted: [bool; 2]) -> [Option<Id>; 2] {
        let left = wanted[0].then(|| {
            let one = self.constant(1.0);
            self.divide(one, b)
        });
        let right = wanted[1].then(|| {
            let quotient = self.divide(a, b);
            let slope = self.divide(quotient, b);
            self.negate(slope)
        });
        [left, right]
    }

    /// a^b: b a^(b-1) and a^b log a; the second only if the exponent varies,
    /// because log a has no value for a negative base.
    fn power_slopes(&mut self, a: Id, b: Id, wanted: [bool; 2]) -> [Option<Id>; 2] {
        let left = wanted[0].then(|| {
            let one = self.constant(1.0);
            let exponent = self.minus(b, one);
            let power = self.binary(Binary::Power, a, exponent);
            self.multiply(b, power)
        });
        let right = wanted[1].then(|| {
            let power = self.binary(Binary::Power, a, b);
            let log = self.unary(Unary::Log, a);
            self.multiply(power, log)
        });
        [left, right]
    }

    /// atan2(a, b): b/(a²+b²) and -a/(a²+b²).
    fn atan2_slopes(&mut self, a: Id, b: Id, wanted: [bool; 2]) -> [Option<Id>; 2] {
        let [aa, bb] = [a, b].map(|v| self.multiply(v, v));
        let radius = self.plus(aa, bb);
        let left = wanted[0].then(|| self.divide(b, radius));
        let right = wanted[1].then(|| {
            let slope = self.divide(a, radius);
            self.negate(slope)
        });
        [left, right]
    }

    /// hypot(a, b): a and b over the hypotenuse.
    fn hypot_slopes(&mut self, a: Id, b: Id) -> [Option<Id>; 2] {
        let radius = self.binary(Binary::Hypot, a, b);
        [a, b].map(|v| Some(self.divide(v, radius)))
    }

    /// The derivative of min or max: the operand that was taken, gated, so that
    /// a NaN in the derivative of the other one does no harm.
    fn branches(&mut self, [a, b]: [[Id; 2]; 2], slopes: [Option<Id>; 2]) -> Option<Id> {
        let gates = [a, b].map(|[less, greater]| self.binary(Binary::Less, less, greater));
        let [left, right] = [0, 1].map(|k| {
            let slope = slopes[k]?;
            Some(self.binary(Binary::Gate, gates[k], slope))
        });
        self.sum(left, right)
    }

    fn product(&mut self, a: Option<Id>, b: Option<Id>) -> Option<Id> {
        Some(self.multiply(a?, b?))
    }

    fn one_plus_square(&mut self, a: Id) -> Id {
        let one = self.constant(1.0);
        let square = self.multiply(a, a);
        self.plus(one, square)
    }

    fn one_minus_square(&mut self, a: Id) -> Id {
        let one = self.constant(1.0);
        let square = self.multiply(a, a);
        self.minus(one, square)
    }

    fn times(&mut self, factor: f64, a: Id) -> Id {
        let factor = self.constant(factor);
        self.multiply(factor, a)
    }

    /// 2/√π exp(-a²), the derivative of erf.
    fn bell(&mut self, a: Id) -> Id {
        let square = self.multiply(a, a);
        let exponent = self.negate(square);
        let bell = self.unary(Unary::Exp, exponent);
        self.times(2.0 / PI.sqrt(), bell)
    }
}
