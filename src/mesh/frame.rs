//! The geometry of one triangle: its plane and its barycentric gradients.

use nalgebra::Matrix3;

use super::Vector;
use crate::bernstein::Barycentric;

/// A triangle in space, with what turns barycentric derivatives into gradients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleFrame {
    corners: [Vector; 3],
    /// Gradients of the barycentric coordinates, in the triangle's plane.
    barycentric_gradients: [Vector; 3],
    /// Unit normal; zero for a triangle without area.
    normal: Vector,
}

/// A triangle has no area, as far as rounding can tell, if twice its area is
/// below this fraction of its longest side squared.
const FLAT: f64 = 1e-13;

impl TriangleFrame {
    /// The frame of the triangle with the given corners.
    pub fn new(corners: [Vector; 3]) -> Self {
        let sides = opposite_sides(&corners);
        let doubled = sides[1].cross(&sides[2]);
        let longest = sides.iter().map(Vector::norm_squared).fold(0.0, f64::max);
        let area = doubled.norm();
        if area <= FLAT * longest || !area.is_finite() {
            let zero = Vector::zeros();
            return Self { corners, barycentric_gradients: [zero; 3], normal: zero };
        }
        let normal = doubled / area;
        let barycentric_gradients = sides.map(|side| normal.cross(&side) / area);
        Self { corners, barycentric_gradients, normal }
    }

    /// Whether the triangle has no area; its gradients are then all zero.
    pub fn is_degenerate(&self) -> bool {
        self.normal == Vector::zeros()
    }

    /// The corners.
    pub fn corners(&self) -> &[Vector; 3] {
        &self.corners
    }

    /// The unit normal, by the right hand; zero for a triangle without area.
    pub fn normal(&self) -> &Vector {
        &self.normal
    }

    /// Gradients of the three barycentric coordinates, in the triangle's plane.
    pub fn barycentric_gradients(&self) -> &[Vector; 3] {
        &self.barycentric_gradients
    }

    /// The point at the given barycentric coordinates.
    pub fn position(&self, at: &Barycentric) -> Vector {
        self.corners[0] * at[0] + self.corners[1] * at[1] + self.corners[2] * at[2]
    }

    /// Barycentric coordinates of a point, of its projection if it lies outside
    /// the triangle's plane.
    pub fn barycentric(&self, point: &Vector) -> Barycentric {
        let [_, g1, g2] = &self.barycentric_gradients;
        let offset = point - self.corners[0];
        let (b, c) = (g1.dot(&offset), g2.dot(&offset));
        [1.0 - b - c, b, c]
    }

    /// The change of barycentric coordinates along a vector.
    pub fn barycentric_direction(&self, vector: &Vector) -> Barycentric {
        self.barycentric_gradients.map(|gradient| gradient.dot(vector))
    }

    /// The gradient in space, from derivatives by barycentric coordinates.
    pub fn gradient(&self, barycentric: &[f64; 3]) -> Vector {
        let [g0, g1, g2] = &self.barycentric_gradients;
        g0 * barycentric[0] + g1 * barycentric[1] + g2 * barycentric[2]
    }

    /// The second derivatives in space along the triangle's plane, from those by barycentric
    /// coordinates.
    pub fn hessian(&self, barycentric: &[[f64; 3]; 3]) -> Matrix3<f64> {
        let rows = barycentric.map(|row| self.gradient(&row));
        let pairs = self.barycentric_gradients.iter().zip(rows);
        pairs.map(|(gradient, row)| gradient * row.transpose()).sum()
    }
}

/// Two perpendicular unit vectors in the plane with the given normal: the x and y
/// axes for a normal along z, or for none.
pub fn plane_axes(normal: &Vector) -> [Vector; 2] {
    let normal = normal.try_normalize(0.0).unwrap_or_else(Vector::z);
    let axis = if normal.x.abs() <= 0.9 { Vector::x() } else { Vector::y() };
    let first = (axis - normal * axis.dot(&normal)).normalize();
    [first, normal.cross(&first)]
}

/// The sides opposite the corners, counter-clockwise.
fn opposite_sides(corners: &[Vector; 3]) -> [Vector; 3] {
    let [a, b, c] = corners;
    [c - b, a - c, b - a]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(Vector::from)
    }

    #[test]
    fn the_unit_triangle_by_hand() {
        let frame = TriangleFrame::new([Vector::zeros(), Vector::x(), Vector::y()]);
        assert_eq!(*frame.normal(), Vector::z());
        assert_eq!(
            *frame.barycentric_gradients(),
            [Vector::new(-1.0, -1.0, 0.0), Vector::x(), Vector::y()]
        );
    }

    #[test]
    fn triangles_without_area_are_told() {
        let line = [Vector::zeros(), Vector::x(), Vector::x() * 2.0];
        assert!(TriangleFrame::new(line).is_degenerate());
        assert!(TriangleFrame::new([Vector::x(); 3]).is_degenerate());
    }

    proptest! {
        #[test]
        fn barycentric_coordinates_return(corners in prop::array::uniform3(vectors()), s in 0.0..1.0f64, t in 0.0..1.0f64) {
            let frame = TriangleFrame::new(corners);
            let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm();
            prop_assume!(area > 1e-2);
            let at = [1.0 - s - t, s, t];
            let back = frame.barycentric(&frame.position(&at));
            for n in 0..3 {
                prop_assert!((at[n] - back[n]).abs() < 1e-11);
            }
        }
    }
}
