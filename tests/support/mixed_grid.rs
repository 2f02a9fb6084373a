//! Grids of cells of two and three dimensions for tests.

use vtu2contour::mesh::{TetrahedronMesh, Vector};
use vtu2contour::vtk::{DataArray, UnstructuredGrid};

/// Tetrahedra and, below them, triangles, some of which are another process's; values `u` and
/// gradients `g` at their points.
pub fn mixed_grid(
    mesh: &TetrahedronMesh,
    solution: impl Fn(&Vector) -> (f64, Vector),
    is_ghost: impl Fn(&Vector) -> bool,
) -> UnstructuredGrid {
    let flat =
        |vectors: &[Vector]| vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>();
    let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, flat(mesh.points())));
    let is_below = |point: &&u32| mesh.points()[**point as usize].z == 0.0;
    let mut ghosts: Vec<u8> = Vec::new();
    for corners in mesh.tetrahedra() {
        let ghost = u8::from(is_ghost(&mesh.points()[corners[0] as usize]));
        grid.push_cell(10, &corners.map(i64::from));
        ghosts.push(ghost);
        let bottom: Vec<i64> = corners.iter().filter(is_below).map(|&p| i64::from(p)).collect();
        if bottom.len() == 3 {
            grid.push_cell(5, &bottom);
            ghosts.push(ghost);
        }
    }
    let (values, gradients): (Vec<f64>, Vec<Vector>) = mesh.points().iter().map(solution).unzip();
    grid.point_data.push(DataArray::new("u", 1, values));
    grid.point_data.push(DataArray::new("g", 3, flat(&gradients)));
    grid.cell_data.push(DataArray::new("vtkGhostType", 1, ghosts));
    grid
}
