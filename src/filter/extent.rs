//! How large what is contoured is.

use std::borrow::Cow;

use super::cells::Cells;
use super::contour_filter::prepared;
use super::error::FilterError;
use super::options::ContourOptions;
use super::solution::Solution;
use crate::mesh::BoundingBox;
use crate::vtk::UnstructuredGrid;

/// The boxes around the cells of two dimensions and of three.
///
/// Default tolerances are parts of its diagonal: pieces of a whole need the extent of the whole,
/// as [`ContourOptions::size`], for where they meet they have to be equally fine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    triangles: Option<BoundingBox>,
    tetrahedra: Option<BoundingBox>,
}

impl Extent {
    /// The extent of a grid's cells.
    ///
    /// # Errors
    /// If a cell cannot be read, or the options' tolerance for merging is no length.
    pub fn of_grid(grid: &UnstructuredGrid, options: &ContourOptions) -> Result<Self, FilterError> {
        let grid = prepared(Cow::Borrowed(grid), options)?;
        let Cells { triangles, tetrahedra, .. } = Cells::new(&grid)?;
        Ok(Self {
            triangles: triangles.and_then(|part| part.mesh.bounding_box()),
            tetrahedra: tetrahedra.and_then(|part| part.mesh.bounding_box()),
        })
    }

    /// The extent of a solution's cells.
    pub(super) fn of_solution(solution: &Solution) -> Self {
        let Solution { triangles, tetrahedra, .. } = solution;
        Self {
            triangles: triangles.as_ref().and_then(|domain| domain.mesh.bounding_box()),
            tetrahedra: tetrahedra.as_ref().and_then(|domain| domain.mesh.bounding_box()),
        }
    }

    /// The extent of both together.
    pub fn joined(self, other: Self) -> Self {
        let both = |a: Option<BoundingBox>, b: Option<BoundingBox>| match (a, b) {
            (Some(a), Some(b)) => Some(a.joined(b)),
            _ => a.or(b),
        };
        Self {
            triangles: both(self.triangles, other.triangles),
            tetrahedra: both(self.tetrahedra, other.tetrahedra),
        }
    }

    /// The length of the longer of both boxes' diagonals; zero without cells.
    pub fn diagonal(&self) -> f64 {
        let boxes = [self.triangles, self.tetrahedra];
        boxes.iter().flatten().map(BoundingBox::diagonal).fold(0.0, f64::max)
    }
}
