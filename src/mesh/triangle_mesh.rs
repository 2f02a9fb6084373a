//! Points and triangles.

use thiserror::Error;

use super::Vector;
use super::frame::TriangleFrame;
use crate::bernstein::Barycentric;

/// Points in space and the triangles between them.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    points: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
}

/// Why points and triangles do not make a mesh.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MeshError {
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} uses point {point}, but there are only {points} points")]
    PointOutOfRange {
        /// The triangle's number, from 0.
        triangle: usize,
        /// The point it names.
        point: u32,
        /// How many points there are.
        points: usize,
    },
}

impl TriangleMesh {
    /// A mesh of `points` and `triangles` (indices of three points each).
    ///
    /// # Errors
    /// [`MeshError::PointOutOfRange`] if a triangle names a point that is not there.
    pub fn new(points: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&point) = corners.iter().find(|&&point| point as usize >= points.len()) {
                return Err(MeshError::PointOutOfRange { triangle, point, points: points.len() });
            }
        }
        Ok(Self { points, triangles })
    }

    /// The points.
    pub fn points(&self) -> &[Vector] {
        &self.points
    }

    /// The triangles, as indices of their points.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.triangles[triangle].map(|point| self.points[point as usize])
    }

    /// The frame of a triangle: its plane and its barycentric gradients.
    pub fn frame(&self, triangle: usize) -> TriangleFrame {
        TriangleFrame::new(self.corners(triangle))
    }

    /// The point of a triangle at the given barycentric coordinates.
    pub fn position(&self, triangle: usize, at: &Barycentric) -> Vector {
        let [a, b, c] = self.corners(triangle);
        a * at[0] + b * at[1] + c * at[2]
    }

    /// The length of the diagonal of the triangles' bounding box; zero without
    /// triangles. Points that no triangle uses, and those that are not finite, do not
    /// count.
    pub fn diagonal(&self) -> f64 {
        let corners = self.triangles.iter().flatten().map(|&point| self.points[point as usize]);
        let mut finite = corners.filter(|point| point.iter().all(|x| x.is_finite()));
        let Some(first) = finite.next() else { return 0.0 };
        let (low, high) =
            finite.fold((first, first), |(low, high), point| (low.inf(&point), high.sup(&point)));
        (high - low).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_without_its_point_is_refused() {
        let points = vec![Vector::zeros(); 3];
        let error = TriangleMesh::new(points, vec![[0, 1, 2], [1, 2, 3]]).unwrap_err();
        assert_eq!(error, MeshError::PointOutOfRange { triangle: 1, point: 3, points: 3 });
    }

    #[test]
    fn position_and_diagonal() {
        let mut points =
            vec![Vector::zeros(), Vector::new(3.0, 0.0, 0.0), Vector::new(0.0, 4.0, 0.0)];
        // no triangle uses this one
        points.push(Vector::repeat(1e9));
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.diagonal(), 5.0);
        assert_eq!(mesh.position(0, &[0.0, 0.5, 0.5]), Vector::new(1.5, 2.0, 0.0));
    }
}
