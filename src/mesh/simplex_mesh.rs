//! Points and the simplices between them: triangles or tetrahedra.

use std::borrow::Cow;

use rayon::prelude::*;
use thiserror::Error;

use super::Vector;
use super::bounding_box::BoundingBox;
use super::frame::TriangleFrame;
use super::subset::Subset;
use super::tetrahedron_frame::TetrahedronFrame;

/// Points in space and simplices of `CORNERS` corners each: its own, or a view of arrays
/// that live elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct SimplexMesh<'a, const CORNERS: usize> {
    points: Cow<'a, [Vector]>,
    simplices: Cow<'a, [[u32; CORNERS]]>,
}

/// Points in space and the triangles between them.
pub type TriangleMesh<'a> = SimplexMesh<'a, 3>;

/// Points in space and the tetrahedra between them.
pub type TetrahedronMesh<'a> = SimplexMesh<'a, 4>;

/// The most simplices: the sides of four times as many are numbered, in 32 bits.
const MOST: usize = (1 << 30) - 1;

/// Why points and simplices do not make a mesh.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MeshError {
    /// A simplex names a point that does not exist.
    #[error("simplex {simplex} uses point {point}, but there are only {points} points")]
    PointOutOfRange {
        /// The simplex's number, from 0.
        simplex: usize,
        /// The point it names.
        point: u32,
        /// How many points there are.
        points: usize,
    },
    /// There are more simplices than their sides can have numbers.
    #[error("{simplices} simplices are more than the {MOST} that can be numbered")]
    TooMany {
        /// How many there are.
        simplices: usize,
    },
}

/// Simplices whose points one thread checks at a time.
const CHECKED_AT_ONCE: usize = 1 << 14;

impl<'a, const CORNERS: usize> SimplexMesh<'a, CORNERS> {
    /// A mesh of `points` and `simplices` (the indices of their corners).
    ///
    /// # Errors
    /// [`MeshError::PointOutOfRange`] if a simplex names a point that is not there, and
    /// [`MeshError::TooMany`] beyond a billion simplices.
    pub fn new(points: Vec<Vector>, simplices: Vec<[u32; CORNERS]>) -> Result<Self, MeshError> {
        Self { points: points.into(), simplices: simplices.into() }.checked()
    }

    /// The same of arrays that stay where they are: nothing is copied.
    ///
    /// # Errors
    /// As [`SimplexMesh::new`].
    pub fn view(points: &'a [Vector], simplices: &'a [[u32; CORNERS]]) -> Result<Self, MeshError> {
        Self { points: points.into(), simplices: simplices.into() }.checked()
    }

    fn checked(self) -> Result<Self, MeshError> {
        if self.simplices.len() > MOST {
            return Err(MeshError::TooMany { simplices: self.simplices.len() });
        }
        let points = self.points.len();
        let greatest = |corners: &[u32; CORNERS]| corners.iter().copied().fold(0, u32::max);
        let within = |corners: &[u32; CORNERS]| (greatest(corners) as usize) < points;
        // nearly always all are: found without a branch for each
        let chunks = self.simplices.par_chunks(CHECKED_AT_ONCE);
        if chunks
            .map(|chunk| chunk.iter().map(greatest).fold(0, u32::max))
            .all(|n| (n as usize) < points)
        {
            return Ok(self);
        }
        match self.simplices.par_iter().position_first(|corners| !within(corners)) {
            None => Ok(self),
            Some(simplex) => {
                let corners = self.simplices[simplex].into_iter();
                let point = corners.into_iter().find(|&point| point as usize >= points);
                let point = point.unwrap_or_default();
                Err(MeshError::PointOutOfRange { simplex, point, points })
            }
        }
    }

    /// Some of the simplices, with all points: these are not copied.
    pub fn part(&self, subset: &Subset) -> SimplexMesh<'_, CORNERS> {
        let simplices: Vec<_> = subset.simplices().map(|simplex| self.simplices[simplex]).collect();
        SimplexMesh { points: Cow::Borrowed(&self.points), simplices: simplices.into() }
    }

    /// The points.
    pub fn points(&self) -> &[Vector] {
        &self.points
    }

    /// The simplices, as indices of their points.
    pub fn simplices(&self) -> &[[u32; CORNERS]] {
        &self.simplices
    }

    /// The corners of a simplex.
    pub fn corners(&self, simplex: usize) -> [Vector; CORNERS] {
        self.simplices[simplex].map(|point| self.points[point as usize])
    }

    /// The point of a simplex at the given barycentric coordinates.
    pub fn position(&self, simplex: usize, at: &[f64; CORNERS]) -> Vector {
        let corners = self.corners(simplex);
        let mut position = corners[0] * at[0];
        for (corner, weight) in corners.iter().zip(at).skip(1) {
            position += corner * *weight;
        }
        position
    }

    /// The barycentric coordinates of a point in a simplex, or beyond it; of its projection onto
    /// a triangle's plane.
    pub fn weights_at(&self, simplex: usize, point: &Vector) -> [f64; CORNERS] {
        let mut at = [0.0; CORNERS];
        match self.corners(simplex)[..] {
            [a, b, c] => {
                at.copy_from_slice(&TriangleFrame::new([a, b, c]).barycentric(point)[..]);
            }
            [a, b, c, d] => {
                at.copy_from_slice(&TetrahedronFrame::new([a, b, c, d]).barycentric(point)[..]);
            }
            _ => {}
        }
        at
    }

    /// The area of a triangle, the volume of a tetrahedron; zero without one, as far as
    /// rounding can tell.
    pub fn measure(&self, simplex: usize) -> f64 {
        match self.corners(simplex)[..] {
            [a, b, c] if !TriangleFrame::new([a, b, c]).is_degenerate() => {
                0.5 * (b - a).cross(&(c - a)).norm()
            }
            [a, b, c, d] if !TetrahedronFrame::new([a, b, c, d]).is_degenerate() => {
                (b - a).cross(&(c - a)).dot(&(d - a)).abs() / 6.0
            }
            _ => 0.0,
        }
    }

    /// The box around the simplices; nothing without any. Points that no simplex uses, and
    /// those that are not finite, do not count.
    pub fn bounding_box(&self) -> Option<BoundingBox> {
        let mut is_used = vec![false; self.points.len()];
        for corner in self.simplices.iter().flatten() {
            is_used[*corner as usize] = true;
        }
        let used = self.points.par_iter().zip(is_used).filter(|(_, is_used)| *is_used);
        let finite = used.map(|(point, _)| *point).filter(|p| p.iter().all(|x| x.is_finite()));
        finite.map(BoundingBox::of_point).reduce_with(BoundingBox::joined)
    }

    /// The length of that box's diagonal; zero without simplices.
    pub fn diagonal(&self) -> f64 {
        self.bounding_box().map_or(0.0, |around| around.diagonal())
    }
}

impl TriangleMesh<'_> {
    /// The triangles, as indices of their points.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.simplices
    }

    /// The frame of a triangle: its plane and its barycentric gradients.
    pub fn frame(&self, triangle: usize) -> TriangleFrame {
        TriangleFrame::new(self.corners(triangle))
    }
}

impl TetrahedronMesh<'_> {
    /// The tetrahedra, as indices of their points.
    pub fn tetrahedra(&self) -> &[[u32; 4]] {
        &self.simplices
    }

    /// The frame of a tetrahedron: its barycentric gradients.
    pub fn frame(&self, tetrahedron: usize) -> TetrahedronFrame {
        TetrahedronFrame::new(self.corners(tetrahedron))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simplex_without_its_point_is_refused() {
        let points = vec![Vector::zeros(); 3];
        let error = TriangleMesh::new(points, vec![[0, 1, 2], [1, 2, 3]]).unwrap_err();
        assert_eq!(error, MeshError::PointOutOfRange { simplex: 1, point: 3, points: 3 });
    }

    #[test]
    fn position_and_diagonal() {
        let mut points =
            vec![Vector::zeros(), Vector::new(3.0, 0.0, 0.0), Vector::new(0.0, 4.0, 0.0)];
        // no triangle uses this one
        points.push(Vector::repeat(1e9));
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.diagonal(), 5.0);
        assert_eq!(mesh.measure(0), 6.0);
        assert_eq!(mesh.position(0, &[0.0, 0.5, 0.5]), Vector::new(1.5, 2.0, 0.0));
        assert_eq!(mesh.weights_at(0, &Vector::new(3.0, 4.0, 7.0)), [-1.0, 1.0, 1.0]);
    }

    #[test]
    fn position_in_a_tetrahedron() {
        let points = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let mesh = TetrahedronMesh::new(points, vec![[0, 1, 2, 3]]).unwrap();
        assert_eq!(mesh.position(0, &[0.0, 0.25, 0.25, 0.5]), Vector::new(0.25, 0.25, 0.5));
        assert_eq!(mesh.weights_at(0, &Vector::new(1.0, 1.0, 1.0)), [-2.0, 1.0, 1.0, 1.0]);
        assert_eq!(mesh.measure(0), 1.0 / 6.0);
    }
}
