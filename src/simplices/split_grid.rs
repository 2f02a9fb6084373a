//! The cells of a grid as triangles and tetrahedra.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use thiserror::Error;

use super::cell_type::CellCounts;
use super::left_out::LeftOut;
use super::orientation::{Lie, orient_one};
use super::splitter::{Splitter, is_tetrahedron};
use crate::interruption::checkpoint;
use crate::large_pages;
use crate::mesh::Vector;
use crate::vtk::{ArrayError, DataArray, UnstructuredGrid, Values};

/// Simplices of `CORNERS` corners, and the cells that they came from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pieces<const CORNERS: usize> {
    /// Points of the grid, of each simplex.
    pub simplices: Vec<[u32; CORNERS]>,
    /// The cell of the grid that each simplex is part of; never falling.
    pub parents: Vec<u32>,
}

impl<const CORNERS: usize> Pieces<CORNERS> {
    /// Makes room for so many simplices.
    fn reserve(&mut self, simplices: usize) {
        self.simplices.reserve(simplices);
        self.parents.reserve(simplices);
    }

    /// Notes that all simplices without a parent are part of `cell`.
    fn close(&mut self, cell: usize) {
        self.parents.resize(self.simplices.len(), cell as u32);
    }
}

/// All cells of a grid as simplices between the grid's own points.
///
/// Solids that share a face cut it alike, so that the tetrahedra fit together;
/// each has a positive volume.
#[derive(Clone, Debug, Default)]
pub struct SplitGrid {
    /// The grid's points, in its unit of length.
    pub points: Vec<Vector>,
    /// The triangles of the two-dimensional cells.
    pub triangles: Pieces<3>,
    /// The tetrahedra of the solids.
    pub tetrahedra: Pieces<4>,
    /// The cells that could not be split. Points and lines hold no simplices and are
    /// not counted.
    pub left_out: LeftOut,
    /// Solids whose tetrahedra lie over one another in part, because the solid is
    /// not convex or its faces are not plane. They are not left out.
    pub folded: CellCounts,
}

/// Why a grid cannot be split.
#[derive(Clone, Debug, Error)]
pub enum SplitError {
    /// Points need three coordinates (or two).
    #[error("the points do not have three coordinates each")]
    Points,
    /// Numbers of points and cells have 32 bits.
    #[error("the grid has more than 4294967295 points or cells")]
    TooLarge,
    /// A cell or a face names a point that is not there.
    #[error("the cells do not fit the points: {0}")]
    Cells(ArrayError),
}

impl SplitGrid {
    /// Splits all cells of a grid.
    ///
    /// # Errors
    /// If the grid has more points or cells than 32 bits can count, or contradicts
    /// itself. Cells that cannot be split are no error but counted.
    pub fn new(grid: &UnstructuredGrid) -> Result<Self, SplitError> {
        let points = vectors(&grid.points).ok_or(SplitError::Points)?;
        if u32::try_from(points.len()).is_err() || u32::try_from(grid.types.len()).is_err() {
            return Err(SplitError::TooLarge);
        }
        if let Some(tetrahedra) = tetrahedra_alone(grid, &points) {
            return Ok(Self { points, tetrahedra, ..Self::default() });
        }
        check(grid, points.len())?;
        let mut split = Self { points, ..Self::default() };
        // most grids are of simplices
        split.triangles.reserve(grid.types.iter().filter(|&&cell_type| cell_type == 5).count());
        split.tetrahedra.reserve(grid.types.iter().filter(|&&cell_type| cell_type == 10).count());
        let mut splitter = Splitter::new(grid, &split.points);
        for (cell, (points, &cell_type)) in grid.cells.iter().zip(&grid.types).enumerate() {
            checkpoint();
            let (triangles, tetrahedra) = (&mut split.triangles, &mut split.tetrahedra);
            let (flat, solid) = (&mut triangles.simplices, &mut tetrahedra.simplices);
            match splitter.cut(cell, points, flat, solid) {
                Ok(Lie::Apart) => {}
                Ok(Lie::Folded) => split.folded.add(cell_type),
                Err(reason) => split.left_out.add(cell_type, reason),
            }
            triangles.close(cell);
            tetrahedra.close(cell);
        }
        Ok(split)
    }
}

/// The cells of a grid of nothing but tetrahedra, of which none has collapsed or names a point that
/// is not there: what [`Splitter`] makes of them, all at once, for most large grids are such ones.
fn tetrahedra_alone(grid: &UnstructuredGrid, positions: &[Vector]) -> Option<Pieces<4>> {
    let count = grid.types.len();
    if count == 0
        || count != grid.cells.len()
        || grid.cells.size_of_all() != Some(4)
        || grid.polyhedra.is_some()
        || !grid.types.par_iter().all(|&cell_type| cell_type == 10)
    {
        return None;
    }
    let (cells, _) = grid.cells.connectivity().as_chunks::<4>();
    let has_other = AtomicBool::new(false);
    let cells = cells.par_iter().map(|points| {
        checkpoint();
        // one that is negative is a large one without its sign
        let are_there = points.iter().all(|&point| (point as u64) < positions.len() as u64);
        if !are_there || !is_tetrahedron(points) {
            has_other.store(true, Ordering::Relaxed);
            return [0; 4];
        }
        let mut corners = points.map(|point| point as u32);
        orient_one(&mut corners, positions);
        corners
    });
    let mut simplices = large_pages::with_room(count);
    simplices.par_extend(cells);
    let are_all = !has_other.into_inner();
    are_all.then(|| Pieces { simplices, parents: large_pages::collected(0..count as u32) })
}

/// Refuses grids whose numbers are not those of points.
fn check(grid: &UnstructuredGrid, points: usize) -> Result<(), SplitError> {
    grid.cells.check_indices(points).map_err(SplitError::Cells)?;
    let faces = grid.polyhedra.as_ref().map(|polyhedra| &polyhedra.faces);
    faces.map_or(Ok(()), |faces| faces.check_indices(points)).map_err(SplitError::Cells)
}

/// The tuples of an array of three components (or two, with z = 0).
pub fn vectors(array: &DataArray) -> Option<Vec<Vector>> {
    let vectors = |values: &[f64]| match array.components {
        3 => {
            let (tuples, _) = values.as_chunks::<3>();
            Some(large_pages::collected(tuples.iter().copied().map(Vector::from)))
        }
        2 => {
            let (tuples, _) = values.as_chunks::<2>();
            Some(large_pages::collected(tuples.iter().map(|&[x, y]| Vector::new(x, y, 0.0))))
        }
        _ => None,
    };
    match &array.values {
        Values::F64(values) => vectors(values),
        _ => vectors(&array.to_f64()?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::{CellArray, Polyhedra};

    /// Tetrahedra between the first points of a cube, and perhaps another cell.
    fn grid(cells: &[[i64; 4]], other: Option<(u8, &[i64])>) -> UnstructuredGrid {
        let corner = |n: u8| [n & 1, n >> 1 & 1, n >> 2].map(f64::from);
        let points: Vec<f64> = (0..8).flat_map(corner).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
        cells.iter().for_each(|cell| grid.push_cell(10, cell));
        if let Some((cell_type, points)) = other {
            grid.push_cell(cell_type, points);
        }
        grid
    }

    #[test]
    fn tetrahedra_alone_are_as_among_others() {
        let cells = [[0, 1, 2, 4], [1, 0, 2, 4], [1, 2, 4, 7], [0, 1, 2, 3]];
        let vertex: &[i64] = &[0];
        let alone = SplitGrid::new(&grid(&cells, None)).unwrap();
        let general = SplitGrid::new(&grid(&cells, Some((1, vertex)))).unwrap();
        assert_eq!(alone.tetrahedra, general.tetrahedra);
        assert_eq!(alone.tetrahedra.simplices[..2], [[0, 1, 2, 4], [1, 0, 4, 2]]);
        assert!(tetrahedra_alone(&grid(&cells, Some((1, vertex))), &alone.points).is_none());
    }

    #[test]
    fn tetrahedra_alone_without_their_points_are_refused() {
        // the second is one of the points that are there, to 32 bits
        for wrong in [8, 1 << 32, -1, i64::MIN, i64::MAX] {
            let mut grid = grid(&[[0, 1, 2, 4]], None);
            grid.push_cell(10, &[1, 2, wrong, 7]);
            let refused = SplitGrid::new(&grid).unwrap_err().to_string();
            assert!(refused.contains(&wrong.to_string()), "{refused}");
        }
    }

    #[test]
    fn faces_without_their_points_are_refused_beside_tetrahedra_alone() {
        let mut grid = grid(&[[0, 1, 2, 4]], None);
        let mut faces = CellArray::new();
        faces.push(&[0, 1, 99]);
        let cells = CellArray::from_parts(vec![0, 0], Vec::new()).unwrap();
        grid.polyhedra = Some(Polyhedra { faces, cells });
        assert!(SplitGrid::new(&grid).unwrap_err().to_string().contains("99"));
    }

    #[test]
    fn a_collapsed_tetrahedron_among_others_is_left_out() {
        let split =
            SplitGrid::new(&grid(&[[0, 1, 2, 4], [1, 1, 2, 4], [7, 4, 2, 1]], None)).unwrap();
        assert_eq!(split.tetrahedra.parents, [0, 2]);
        assert_eq!(split.left_out.total(), 1);
    }
}
