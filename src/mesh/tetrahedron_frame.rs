//! The geometry of one tetrahedron: its barycentric gradients.

use nalgebra::Matrix3;

use super::Vector;
use crate::bernstein::Barycentric4;

/// A tetrahedron, with what turns barycentric derivatives into gradients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetrahedronFrame {
    corners: [Vector; 4],
    /// Gradients of the barycentric coordinates; zero for a flat tetrahedron.
    barycentric_gradients: [Vector; 4],
}

/// A tetrahedron is flat, as far as rounding can tell, if six times its volume is below
/// this fraction of its longest edge from corner 0, cubed.
const FLAT: f64 = 1e-14;

impl TetrahedronFrame {
    /// The frame of the tetrahedron with the given corners.
    pub fn new(corners: [Vector; 4]) -> Self {
        let [a, b, c] = [1, 2, 3].map(|corner| corners[corner] - corners[0]);
        let normals = [b.cross(&c), c.cross(&a), a.cross(&b)];
        let sixfold = a.dot(&normals[0]);
        let longest = a.norm_squared().max(b.norm_squared()).max(c.norm_squared()).sqrt();
        if sixfold.abs() <= FLAT * longest.powi(3) || !sixfold.is_finite() {
            return Self { corners, barycentric_gradients: [Vector::zeros(); 4] };
        }
        let [one, two, three] = normals.map(|normal| normal / sixfold);
        Self { corners, barycentric_gradients: [-(one + two + three), one, two, three] }
    }

    /// Whether the tetrahedron has no volume; its gradients are then all zero.
    pub fn is_degenerate(&self) -> bool {
        self.barycentric_gradients == [Vector::zeros(); 4]
    }

    /// The corners.
    pub fn corners(&self) -> &[Vector; 4] {
        &self.corners
    }

    /// Gradients of the four barycentric coordinates, per unit of length.
    pub fn barycentric_gradients(&self) -> &[Vector; 4] {
        &self.barycentric_gradients
    }

    /// The point at the given barycentric coordinates.
    pub fn position(&self, at: &Barycentric4) -> Vector {
        combine(&self.corners, at)
    }

    /// Barycentric coordinates of a point, inside or outside.
    pub fn barycentric(&self, point: &Vector) -> Barycentric4 {
        let offset = point - self.corners[0];
        let [_, b, c, d] = self.barycentric_direction(&offset);
        [1.0 - (b + c + d), b, c, d]
    }

    /// The change of barycentric coordinates along a vector.
    pub fn barycentric_direction(&self, vector: &Vector) -> Barycentric4 {
        self.barycentric_gradients.map(|gradient| gradient.dot(vector))
    }

    /// The gradient in space, from derivatives by barycentric coordinates.
    pub fn gradient(&self, barycentric: &[f64; 4]) -> Vector {
        combine(&self.barycentric_gradients, barycentric)
    }

    /// The second derivatives in space, from those by barycentric coordinates.
    pub fn hessian(&self, barycentric: &[[f64; 4]; 4]) -> Matrix3<f64> {
        let rows = barycentric.map(|row| self.gradient(&row));
        let pairs = self.barycentric_gradients.iter().zip(rows);
        pairs.map(|(gradient, row)| gradient * row.transpose()).sum()
    }
}

fn combine(vectors: &[Vector; 4], weights: &[f64; 4]) -> Vector {
    let [a, b, c, d] = vectors;
    a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(Vector::from)
    }

    #[test]
    fn the_unit_tetrahedron_by_hand() {
        let frame = TetrahedronFrame::new([Vector::zeros(), Vector::x(), Vector::y(), Vector::z()]);
        let expected = [Vector::repeat(-1.0), Vector::x(), Vector::y(), Vector::z()];
        assert_eq!(*frame.barycentric_gradients(), expected);
        assert_eq!(frame.position(&[0.0, 0.25, 0.5, 0.25]), Vector::new(0.25, 0.5, 0.25));
        assert_eq!(frame.gradient(&[1.0, 3.0, 1.0, 1.0]), Vector::x() * 2.0);
    }

    #[test]
    fn flat_tetrahedra_are_told() {
        let flat = [Vector::zeros(), Vector::x(), Vector::y(), Vector::x() + Vector::y()];
        assert!(TetrahedronFrame::new(flat).is_degenerate());
        assert!(TetrahedronFrame::new([Vector::x(); 4]).is_degenerate());
        assert!(TetrahedronFrame::new([Vector::repeat(f64::NAN); 4]).is_degenerate());
    }

    proptest! {
        #[test]
        fn barycentric_coordinates_return(
            corners in prop::array::uniform4(vectors()), weights in prop::array::uniform4(0.01..1.0f64),
        ) {
            let [a, b, c, d] = corners;
            prop_assume!((b - a).cross(&(c - a)).dot(&(d - a)).abs() > 1e-2);
            let frame = TetrahedronFrame::new(corners);
            let at = weights.map(|weight| weight / weights.iter().sum::<f64>());
            let back = frame.barycentric(&frame.position(&at));
            for n in 0..4 {
                prop_assert!((at[n] - back[n]).abs() < 1e-11);
            }
        }

        /// The gradient of a linear function is its slope.
        #[test]
        fn linear_functions(corners in prop::array::uniform4(vectors()), slope in vectors()) {
            let [a, b, c, d] = corners;
            prop_assume!((b - a).cross(&(c - a)).dot(&(d - a)).abs() > 1e-2);
            let frame = TetrahedronFrame::new(corners);
            let gradient = frame.gradient(&corners.map(|corner| slope.dot(&corner)));
            prop_assert!((gradient - slope).norm() < 1e-10);
        }
    }
}
