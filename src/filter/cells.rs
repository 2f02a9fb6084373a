//! The cells of a grid as meshes of triangles and tetrahedra.

use super::error::FilterError;
use crate::mesh::{SimplexMesh, Vector};
use crate::simplices::{CellCounts, LeftOut, Pieces, SplitGrid};
use crate::vtk::{UnstructuredGrid, Values};

/// The cells of one dimension as simplices of `CORNERS` corners.
#[derive(Clone, Debug)]
pub struct Part<const CORNERS: usize> {
    /// The simplices, with all the grid's points.
    pub mesh: SimplexMesh<'static, CORNERS>,
    /// The cell of the grid that each simplex came from.
    pub parents: Vec<u32>,
}

/// The two-dimensional cells of a grid.
pub type Triangles = Part<3>;

/// The solids of a grid.
pub type Tetrahedra = Part<4>;

/// The cells of a grid.
#[derive(Clone, Debug)]
pub struct Cells {
    /// The two-dimensional ones, if there are any.
    pub triangles: Option<Triangles>,
    /// The solids, if there are any.
    pub tetrahedra: Option<Tetrahedra>,
    /// Those that could not be split.
    pub left_out: LeftOut,
    /// Solids whose tetrahedra lie over one another in part.
    pub folded: CellCounts,
}

/// VTK's name of the cell array that marks ghosts.
pub const GHOSTS: &str = "vtkGhostType";

/// Cells with this bit in [`GHOSTS`] belong to another process.
const DUPLICATE: u8 = 1;

impl Cells {
    /// The cells of a grid.
    ///
    /// # Errors
    /// If the grid has more points or cells than 32 bits can count, or contradicts
    /// itself.
    pub fn new(grid: &UnstructuredGrid) -> Result<Self, FilterError> {
        let SplitGrid { points, triangles, tetrahedra, left_out, folded } = SplitGrid::new(grid)?;
        // both need them, but grids with both are few
        let triangles = Part::new(|| points.clone(), triangles)?;
        let tetrahedra = Part::new(|| points, tetrahedra)?;
        Ok(Self { triangles, tetrahedra, left_out, folded })
    }
}

impl<const CORNERS: usize> Part<CORNERS> {
    /// The simplices as a mesh; none without simplices.
    fn new(
        points: impl FnOnce() -> Vec<Vector>,
        pieces: Pieces<CORNERS>,
    ) -> Result<Option<Self>, FilterError> {
        if pieces.simplices.is_empty() {
            return Ok(None);
        }
        let mesh = SimplexMesh::new(points(), pieces.simplices)?;
        Ok(Some(Self { mesh, parents: pieces.parents }))
    }

    /// The types of the cells that the simplices came from.
    pub fn cells(&self, grid: &UnstructuredGrid) -> CellCounts {
        let cells = self.parents.chunk_by(|one, next| one == next);
        cells.map(|simplices| grid.types[simplices[0] as usize]).collect()
    }
}

/// Whether each of the given cells is one of another process, which contours it; nothing
/// if the grid marks none.
pub fn ghosts(grid: &UnstructuredGrid, cells: &[u32]) -> Option<Vec<bool>> {
    let Values::U8(flags) = &grid.cell_data.get(GHOSTS)?.values else { return None };
    let is_ghost = |cell: u32| flags.get(cell as usize).is_some_and(|flag| flag & DUPLICATE != 0);
    flags
        .iter()
        .any(|flag| flag & DUPLICATE != 0)
        .then(|| cells.iter().map(|&c| is_ghost(c)).collect())
}
