//! Cubic Bézier curves in space.

use crate::mesh::Vector;

/// A cubic Bézier curve by its four control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier {
    /// Start, two handles, end.
    pub control: [Vector; 4],
}

impl Bezier {
    /// The straight line between two points.
    pub fn line(start: Vector, end: Vector) -> Self {
        Self { control: [start, (start * 2.0 + end) / 3.0, (start + end * 2.0) / 3.0, end] }
    }

    /// The curve that leaves `start` and reaches `end` by the given handles.
    pub fn with_handles(start: Vector, out: Vector, back: Vector, end: Vector) -> Self {
        Self { control: [start, start + out, end - back, end] }
    }

    /// The point at `t` in `[0, 1]`.
    pub fn point(&self, t: f64) -> Vector {
        let [a, b, c, d] = self.control;
        let s = 1.0 - t;
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
    }

    /// The derivative at `t`.
    pub fn derivative(&self, t: f64) -> Vector {
        let [a, b, c, d] = self.control;
        let s = 1.0 - t;
        ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0
    }

    /// The same curve in the other direction.
    pub fn reversed(&self) -> Self {
        let [a, b, c, d] = self.control;
        Self { control: [d, c, b, a] }
    }

    /// Whether the handles lie on the straight line between the ends, each no
    /// further than `tolerance` from a third of it.
    pub fn is_straight(&self, tolerance: f64) -> bool {
        let line = Self::line(self.control[0], self.control[3]);
        (1..3).all(|n| (self.control[n] - line.control[n]).norm() <= tolerance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_slopes() {
        let curve = Bezier::with_handles(
            Vector::zeros(),
            Vector::x() / 3.0,
            Vector::y() / 3.0,
            Vector::new(1.0, 1.0, 0.0),
        );
        assert_eq!(curve.point(0.0), Vector::zeros());
        assert_eq!(curve.point(1.0), Vector::new(1.0, 1.0, 0.0));
        assert!((curve.derivative(0.0) - Vector::x()).norm() < 1e-15);
        assert!((curve.derivative(1.0) - Vector::y()).norm() < 1e-15);
        assert!((curve.point(0.3) - curve.reversed().point(0.7)).norm() < 1e-15);
        assert!(!curve.is_straight(0.1));
        assert!(Bezier::line(Vector::zeros(), Vector::x()).is_straight(1e-15));
    }
}
