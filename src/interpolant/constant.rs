//! Triangles on which the data are constant.

use crate::field::Field;
use crate::mesh::Vector;

/// A part of the greatest value that is rounding, of slopes along oblique walls too.
const ROUNDING: f64 = 1e-13;

/// Finds triangles, faces of tetrahedra too, on which a field is constant.
///
/// Such a triangle stays as it is, whatever its neighbours do: it is part of a plateau, or of
/// a wall on which the solution is fixed, and contours at that level depend on it. The data
/// of a cubic that is not constant are never like that, but for multiples of `λ₀ λ₁ λ₂`.
pub(super) struct ConstantTriangles<'a> {
    points: &'a [Vector],
    field: Field<'a>,
    /// What values of this size cannot tell from zero.
    rounding: f64,
}

impl<'a> ConstantTriangles<'a> {
    /// Those between points, of a field with one value and one gradient each.
    pub fn new(points: &'a [Vector], field: Field<'a>) -> Self {
        let sizes = field.values.iter().map(|value| value.abs());
        let greatest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
        Self { points, field, rounding: ROUNDING * greatest }
    }

    /// Whether values and slopes at three points are those of a constant.
    pub fn contain(&self, triangle: &[u32; 3]) -> bool {
        let triangle = triangle.map(|point| point as usize);
        let [a, b, c] = triangle.map(|point| self.field.values[point]);
        let is_small = |x: f64| x.abs() <= self.rounding;
        is_small(b - a)
            && is_small(c - a)
            && triangle.iter().all(|&from| {
                let slope = |to: usize| {
                    self.field.gradients[from].dot(&(self.points[to] - self.points[from]))
                };
                triangle.iter().all(|&to| is_small(slope(to)))
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_and_plateaus_are_constant_and_hills_are_not() {
        let points = [Vector::zeros(), Vector::new(0.3, 0.4, 0.0), Vector::z()];
        let across = Vector::new(4.0, -3.0, 0.0) / 7.0;
        let is_constant = |values: [f64; 3], gradients: [Vector; 3]| {
            let field = Field { values: &values, gradients: &gradients };
            ConstantTriangles::new(&points, field).contain(&[0, 1, 2])
        };
        assert!(is_constant([0.0; 3], [Vector::zeros(); 3]));
        assert!(is_constant([2.0; 3], [across, across * 5.0, -across]));
        assert!(is_constant([2.0, 2.0, 2.0 + 1e-15], [across; 3]));
        assert!(!is_constant([2.0; 3], [across, across, Vector::z()]));
        assert!(!is_constant([2.0, 2.0, 2.1], [across; 3]));
        assert!(!is_constant([f64::NAN; 3], [across; 3]));
    }
}
