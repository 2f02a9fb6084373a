//! Coordinates in which the mesh around a point is even.

use arrayvec::ArrayVec;

use crate::mesh::Vector;

/// Affine coordinates around a point in which its patch is as wide in all directions,
/// and its neighbours are at the distance one on average.
///
/// Flat cells, as in boundary layers, become ordinary ones; so what is good for a patch
/// does not depend on how the mesh is stretched, scaled or turned.
pub(super) struct PatchFrame {
    /// A coordinate is the dot product of one of these with an offset.
    rows: ArrayVec<Vector, 3>,
}

/// A patch thinner than this fraction of its width, squared, is flat as far as rounding
/// can tell.
const FLAT: f64 = 1e-12;

impl PatchFrame {
    /// The frame for the offsets from a point to those of its patch, and to those of the
    /// first ring alone; in the space of the axes. It has fewer coordinates if the offsets
    /// do not span that space.
    pub fn new(
        patch: impl Iterator<Item = Vector>,
        ring: impl Iterator<Item = Vector> + Clone,
        axes: &[Vector],
    ) -> Self {
        let moments =
            patch.map(|offset| offset * offset.transpose()).sum::<nalgebra::Matrix3<f64>>();
        let mut rows = ArrayVec::<Vector, 3>::new();
        // Gram and Schmidt, by the patch's second moments
        for axis in axes {
            let mut row = *axis;
            for other in &rows {
                row -= other * other.dot(&(moments * row));
            }
            let width = row.dot(&(moments * row));
            if width > FLAT * moments.trace() {
                rows.push(row / width.sqrt());
            }
        }
        let mut frame = Self { rows };
        let count = ring.clone().count() as f64;
        let spacing = ring.map(|offset| frame.norm(&offset)).sum::<f64>() / count;
        frame.rows.iter_mut().for_each(|row| *row /= spacing);
        frame
    }

    /// The rows of the matrix that turns offsets into coordinates.
    pub fn rows(&self) -> &[Vector] {
        &self.rows
    }

    fn norm(&self, offset: &Vector) -> f64 {
        self.rows.iter().map(|row| row.dot(offset).powi(2)).sum::<f64>().sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The eight neighbours on a grid.
    fn ring() -> impl Iterator<Item = Vector> + Clone {
        let places = (0..9).map(|k| Vector::new(f64::from(k % 3 - 1), f64::from(k / 3 - 1), 0.0));
        places.filter(|offset| *offset != Vector::zeros())
    }

    #[test]
    fn stretched_patches_look_alike() {
        let axes = [Vector::x(), Vector::y()];
        let even = PatchFrame::new(ring(), ring(), &axes);
        let stretch = |v: Vector| Vector::new(v.x, 1e-4 * v.y, 0.0);
        let thin = PatchFrame::new(ring().map(stretch), ring().map(stretch), &axes);
        for offset in ring() {
            let difference = even.norm(&offset) - thin.norm(&stretch(offset));
            assert!(difference.abs() < 1e-12);
        }
        let mean = ring().map(|offset| even.norm(&offset)).sum::<f64>() / 8.0;
        assert!((mean - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_direction_without_points_has_no_coordinate() {
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        assert_eq!(PatchFrame::new(ring(), ring(), &axes).rows().len(), 2);
        let none = PatchFrame::new([].into_iter(), [].into_iter(), &axes);
        assert!(none.rows().is_empty());
    }
}
