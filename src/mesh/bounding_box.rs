//! The box around points.

use super::Vector;

/// The box around points, with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// The least coordinates.
    pub low: Vector,
    /// The greatest coordinates.
    pub high: Vector,
}

impl BoundingBox {
    /// The box around a single point.
    pub fn of_point(point: Vector) -> Self {
        Self { low: point, high: point }
    }

    /// The box around both.
    pub fn joined(self, other: Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The length of its diagonal, in the mesh's unit.
    pub fn diagonal(&self) -> f64 {
        (self.high - self.low).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_by_hand() {
        let [a, b] = [Vector::new(1.0, 2.0, 3.0), Vector::new(-2.0, 6.0, 3.0)];
        let joined = BoundingBox::of_point(a).joined(BoundingBox::of_point(b));
        let expected =
            BoundingBox { low: Vector::new(-2.0, 2.0, 3.0), high: Vector::new(1.0, 6.0, 3.0) };
        assert_eq!(joined, expected);
        assert_eq!(joined.diagonal(), 5.0);
        assert_eq!(BoundingBox::of_point(a).diagonal(), 0.0);
    }
}
