//! Which cells are to be divided.

use rayon::prelude::*;
use thiserror::Error;

use crate::mesh::SimplexMesh;

/// Which cells are to be divided, and how far that may go.
#[derive(Clone, Copy, Debug)]
pub struct Marks<'a> {
    /// The cells, those first that need it most. A cell that is named again counts once.
    pub cells: &'a [u32],
    /// The most points that the refined mesh may have. Where this is reached, the rest of the
    /// cells stay as they are.
    pub max_points: usize,
    /// [`Refinement::state`](super::Refinement::state) of the step that made the mesh, cell by
    /// cell; nothing to begin anew.
    pub state: &'a [u16],
}

/// Why a mesh cannot be refined.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum RefineError {
    /// A mark is no cell.
    #[error("cell {cell} is marked, but there are only {cells} cells")]
    NoSuchCell {
        /// The mark.
        cell: u32,
        /// How many cells there are.
        cells: usize,
    },
    /// The state is not that of this mesh.
    #[error(
        "the refinement's state is not that of this mesh: leave it out, and refinement begins anew"
    )]
    State,
    /// A cell has a point at no place.
    #[error("point {point} is not finite: remove the cells that have it")]
    NotFinite {
        /// The point.
        point: u32,
    },
    /// A cell has fewer corners than its kind.
    #[error("cell {cell} names point {point} twice: remove it, or clean the mesh first")]
    RepeatedCorner {
        /// The cell.
        cell: u32,
        /// Its point.
        point: u32,
    },
    /// Numbers of points have 32 bits.
    #[error("the refined mesh would have more than 4294967295 points or cells")]
    TooLarge,
}

impl<'a> Marks<'a> {
    /// All that is marked is divided, whatever the number of points.
    pub fn all(cells: &'a [u32]) -> Self {
        Self { cells, max_points: usize::MAX, state: &[] }
    }

    /// Refuses marks and states of other meshes, and cells that cannot be divided.
    pub(super) fn check<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
    ) -> Result<(), RefineError> {
        let cells = mesh.simplices().len();
        if let Some(&cell) = self.cells.iter().find(|&&cell| cell as usize >= cells) {
            return Err(RefineError::NoSuchCell { cell, cells });
        }
        let fits = self.state.is_empty() || self.state.len() == cells;
        fits.then_some(()).ok_or(RefineError::State)?;
        let wrong = mesh.simplices().par_iter().enumerate();
        let wrong = wrong.find_map_first(|(cell, corners)| wrong_with(mesh, cell as u32, corners));
        wrong.map_or(Ok(()), Err)
    }

    /// How many points may be added.
    pub(super) fn room(&self, points: usize) -> usize {
        self.max_points.saturating_sub(points).min(u32::MAX as usize - points)
    }
}

/// Why a cell cannot be divided. One without area or volume can, as long as it has all corners.
fn wrong_with<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    cell: u32,
    corners: &[u32; CORNERS],
) -> Option<RefineError> {
    let is_finite = |point: u32| mesh.points()[point as usize].iter().all(|x| x.is_finite());
    if let Some(&point) = corners.iter().find(|point| !is_finite(**point)) {
        return Some(RefineError::NotFinite { point });
    }
    let twice = (1..CORNERS).find(|&n| corners[..n].contains(&corners[n]))?;
    Some(RefineError::RepeatedCorner { cell, point: corners[twice] })
}
