//! Splits the cells of a `.vtu` into triangles and tetrahedra, and writes these.
//!
//! ```text
//! cargo run --release --example split-cells -- INPUT.vtu OUTPUT.vtu
//! ```
//!
//! The output has the input's point arrays and one cell array, `OriginalCellIds`;
//! for Bézier cells, points and arrays are those on the curve. Where the grid has
//! quadratic cells, each array of one component gets its gradient by their shape
//! functions, `gradient of NAME`. What was left out is told.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result};
use vtu2contour::simplices::{SplitGrid, lagrange_grid, nodal_gradients};
use vtu2contour::vtk::{DataArray, Selection, UnstructuredGrid, VtuFile, write_vtu};

fn main() -> Result<()> {
    let mut arguments = std::env::args_os().skip(1);
    let mut argument = |name| arguments.next().with_context(|| format!("{name} is missing"));
    let (input, output) = (argument("INPUT.vtu")?, argument("OUTPUT.vtu")?);
    let grid = VtuFile::open(Path::new(&input))?.read(&Selection::All)?.data;
    let start = Instant::now();
    let grid = lagrange_grid(&grid);
    let split = SplitGrid::new(&grid)?;
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{} triangles, {} tetrahedra in {seconds:.3} s; left out: {}; folded: {}",
        split.triangles.simplices.len(),
        split.tetrahedra.simplices.len(),
        split.left_out,
        split.folded,
    );
    write_vtu(Path::new(&output), &simplices(&grid, &split), Default::default())?;
    Ok(())
}

/// The simplices as a grid.
fn simplices(grid: &UnstructuredGrid, split: &SplitGrid) -> UnstructuredGrid {
    let mut simplices = UnstructuredGrid::new(grid.points.clone());
    for corners in &split.triangles.simplices {
        simplices.push_cell(5, &corners.map(i64::from));
    }
    for corners in &split.tetrahedra.simplices {
        simplices.push_cell(10, &corners.map(i64::from));
    }
    simplices.point_data = grid.point_data.clone();
    add_gradients(grid, split, &mut simplices);
    let parents = split.triangles.parents.iter().chain(&split.tetrahedra.parents);
    let parents: Vec<i64> = parents.map(|&cell| i64::from(cell)).collect();
    simplices.cell_data.push(DataArray::new("OriginalCellIds", 1, parents));
    simplices
}

/// Adds the gradients of all arrays of one component, by the solids if there are any.
fn add_gradients(grid: &UnstructuredGrid, split: &SplitGrid, simplices: &mut UnstructuredGrid) {
    let dimension = if split.tetrahedra.simplices.is_empty() { 2 } else { 3 };
    for array in grid.point_data.iter().filter(|array| array.components == 1) {
        let Some(values) = array.to_f64() else { continue };
        let Some(gradients) = nodal_gradients(grid, &split.points, &values, dimension) else {
            continue;
        };
        let unknown = || [f64::NAN; 3].into();
        let gradients = gradients.into_iter().map(|gradient| gradient.unwrap_or_else(unknown));
        let values: Vec<f64> = gradients.flat_map(|g| [g.x, g.y, g.z]).collect();
        simplices.point_data.push(DataArray::new(format!("gradient of {}", array.name), 3, values));
    }
}
