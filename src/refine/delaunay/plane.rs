//! A flat mesh in coordinates of its plane.

use rayon::prelude::*;
use spade::{Point2, mitigate_underflow};

use super::DelaunayError;
use crate::mesh::{TriangleMesh, Vector, plane_axes};

/// The plane of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    origin: Vector,
    axes: [Vector; 2],
}

/// Points this far off count as in the plane, as a part of the mesh's size: points in single
/// precision are.
const FLAT: f64 = 1e-6;

impl Plane {
    /// The plane of a mesh; that of x and y where it is parallel to it.
    ///
    /// # Errors
    /// If a point of a cell is off the plane, or a cell has no area. All must be finite.
    pub fn new(mesh: &TriangleMesh) -> Result<Self, DelaunayError> {
        let points = mesh.points();
        let used = || mesh.triangles().iter().flatten().copied();
        let cells = || (0..mesh.triangles().len()).into_par_iter();
        let flat = |&cell: &usize| mesh.frame(cell).is_degenerate();
        if let Some(cell) = cells().find_first(flat) {
            return Err(DelaunayError::NoArea { cell: cell as u32 });
        }
        let Some(&[first, ..]) = mesh.triangles().first() else {
            return Ok(Self { origin: Vector::zeros(), axes: [Vector::x(), Vector::y()] });
        };
        // the largest triangle tells the plane best
        let sizes = cells().map(|cell| (mesh.measure(cell), cell));
        let largest = sizes.max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let largest = largest.map_or(0, |(_, cell)| cell);
        let mut normal = *mesh.frame(largest).normal();
        if normal[normal.iamax()] < 0.0 {
            normal = -normal;
        }
        let offset = normal.dot(&points[first as usize]);
        let allowed = FLAT * mesh.diagonal();
        let is_off = |point: &u32| (normal.dot(&points[*point as usize]) - offset).abs() > allowed;
        match used().find(is_off) {
            Some(point) => Err(DelaunayError::NotInPlane { point }),
            None => Ok(Self { origin: normal * offset, axes: plane_axes(&normal) }),
        }
    }

    /// A point's coordinates in the plane.
    pub fn project(&self, point: &Vector) -> Point2<f64> {
        // numbers that spade refuses, far below rounding, are zero
        mitigate_underflow(Point2::new(self.axes[0].dot(point), self.axes[1].dot(point)))
    }

    /// The point with the given coordinates.
    pub fn lift(&self, at: Point2<f64>) -> Vector {
        self.origin + self.axes[0] * at.x + self.axes[1] * at.y
    }
}
