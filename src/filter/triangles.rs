//! The triangles of a grid.

use super::cell_type::{CellCounts, dimension};
use super::error::FilterError;
use crate::mesh::{TriangleMesh, Vector};
use crate::vtk::{DataArray, UnstructuredGrid};

/// The two-dimensional cells of a grid as triangles.
#[derive(Clone, Debug)]
pub struct Triangles {
    /// The triangles, with all the grid's points.
    pub mesh: TriangleMesh,
    /// The cell of the grid that each triangle came from.
    pub parents: Vec<u32>,
    /// Cells of two or three dimensions that were left out, because they cannot
    /// be contoured (yet). Points and lines hold no contour and are not counted.
    pub skipped: CellCounts,
}

/// VTK's name of the cell array that marks ghosts.
pub const GHOSTS: &str = "vtkGhostType";

/// Cells with this bit in [`GHOSTS`] belong to another process.
const DUPLICATE: u8 = 1;

impl Triangles {
    /// The triangles of a grid. Quads and pixels are cut by the diagonal at their
    /// point of lowest number, strips into their triangles.
    ///
    /// # Errors
    /// If the grid has no such cell, or more points than 32 bits can count.
    pub fn of(grid: &UnstructuredGrid) -> Result<Self, FilterError> {
        let points = vectors(&grid.points).ok_or(FilterError::Points)?;
        if u32::try_from(points.len()).is_err() || u32::try_from(grid.types.len()).is_err() {
            return Err(FilterError::TooLarge);
        }
        let mut triangles = Vec::new();
        let mut parents = Vec::new();
        let mut skipped = CellCounts::default();
        for (cell, (points, &cell_type)) in grid.cells.iter().zip(&grid.types).enumerate() {
            let start = triangles.len();
            let known = add_triangles(cell_type, points, &mut triangles);
            if !known && dimension(cell_type).is_none_or(|dimension| dimension >= 2) {
                skipped.add(cell_type);
            }
            parents.extend(std::iter::repeat_n(cell as u32, triangles.len() - start));
        }
        if triangles.is_empty() {
            let cells = grid.types.iter().copied().collect();
            return Err(FilterError::NoTriangles { cells });
        }
        let mesh = TriangleMesh::new(points, triangles)?;
        Ok(Self { mesh, parents, skipped })
    }
}

/// The points of an array of three components (or two, with z = 0).
pub fn vectors(array: &DataArray) -> Option<Vec<Vector>> {
    let values = array.to_f64()?;
    match array.components {
        3 => Some(values.chunks_exact(3).map(Vector::from_column_slice).collect()),
        2 => Some(values.chunks_exact(2).map(|p| Vector::new(p[0], p[1], 0.0)).collect()),
        _ => None,
    }
}

/// Adds the triangles of a cell; false if its type is none that can be cut into
/// triangles here.
fn add_triangles(cell_type: u8, points: &[i64], triangles: &mut Vec<[u32; 3]>) -> bool {
    // the reader has checked that every index is that of a point
    let corner = |place: usize| points[place] as u32;
    match (cell_type, points.len()) {
        (5, 3) => triangles.push([corner(0), corner(1), corner(2)]),
        (9, 4) => triangles.extend(cut_quad([corner(0), corner(1), corner(2), corner(3)])),
        (8, 4) => triangles.extend(cut_quad([corner(0), corner(1), corner(3), corner(2)])),
        (6, 3..) => triangles.extend((0..points.len() - 2).map(|n| {
            // every second triangle of a strip is turned around
            let (a, b) = if n % 2 == 0 { (n, n + 1) } else { (n + 1, n) };
            [corner(a), corner(b), corner(n + 2)]
        })),
        _ => return false,
    }
    true
}

fn cut_quad(mut corners: [u32; 4]) -> [[u32; 3]; 2] {
    let lowest = (0..4).min_by_key(|&place| corners[place]).unwrap_or(0);
    corners.rotate_left(lowest);
    let [a, b, c, d] = corners;
    [[a, b, c], [a, c, d]]
}

/// Whether the grid marks a cell as one of another process, which contours it.
pub fn is_ghost(grid: &UnstructuredGrid, cell: u32) -> bool {
    let ghost = grid.cell_data.get(GHOSTS).map(|array| &array.values);
    match ghost {
        Some(crate::vtk::Values::U8(flags)) => {
            flags.get(cell as usize).is_some_and(|flag| flag & DUPLICATE != 0)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(cells: &[(u8, &[i64])]) -> UnstructuredGrid {
        let coordinates: Vec<f64> = (0..24).map(f64::from).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
        for (cell_type, points) in cells {
            grid.push_cell(*cell_type, points);
        }
        grid
    }

    #[test]
    fn quads_pixels_and_strips_are_cut() {
        let cells: [(u8, &[i64]); 4] =
            [(9, &[3, 2, 0, 1]), (8, &[0, 1, 2, 3]), (6, &[4, 5, 6, 7]), (5, &[1, 2, 3])];
        let triangles = Triangles::of(&grid(&cells)).unwrap();
        let expected =
            [[0, 1, 3], [0, 3, 2], [0, 1, 3], [0, 3, 2], [4, 5, 6], [6, 5, 7], [1, 2, 3]];
        assert_eq!(triangles.mesh.triangles(), expected);
        assert_eq!(triangles.parents, [0, 0, 1, 1, 2, 2, 3]);
        assert_eq!(triangles.skipped.total(), 0);
    }

    #[test]
    fn what_cannot_be_cut_is_counted() {
        let cells: [(u8, &[i64]); 4] =
            [(5, &[0, 1, 2]), (3, &[0, 1]), (10, &[0, 1, 2, 3]), (1, &[0])];
        let triangles = Triangles::of(&grid(&cells)).unwrap();
        assert_eq!(triangles.skipped.to_string(), "1 tetrahedra");
        let none: [(u8, &[i64]); 1] = [(10, &[0, 1, 2, 3])];
        assert!(matches!(Triangles::of(&grid(&none)), Err(FilterError::NoTriangles { .. })));
    }
}
