//! Which cells are to be divided.

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
    /// Numbers of points have 32 bits.
    #[error("the refined mesh would have more than 4294967295 points or cells")]
    TooLarge,
}

impl<'a> Marks<'a> {
    /// All that is marked is divided, whatever the number of points.
    pub fn all(cells: &'a [u32]) -> Self {
        Self { cells, max_points: usize::MAX, state: &[] }
    }

    /// Refuses marks and states of other meshes.
    pub(super) fn check<const CORNERS: usize>(
        &self,
        mesh: &SimplexMesh<CORNERS>,
    ) -> Result<(), RefineError> {
        let cells = mesh.simplices().len();
        if let Some(&cell) = self.cells.iter().find(|&&cell| cell as usize >= cells) {
            return Err(RefineError::NoSuchCell { cell, cells });
        }
        let fits = self.state.is_empty() || self.state.len() == cells;
        fits.then_some(()).ok_or(RefineError::State)
    }

    /// How many points may be added.
    pub(super) fn room(&self, points: usize) -> usize {
        self.max_points.saturating_sub(points).min(u32::MAX as usize - points)
    }
}
