//! Polyhedra of legacy files, whose lists of points hold their faces.

use super::cell_array::CellArray;
use super::error::ArrayError;
use super::polyhedra::Polyhedra;

/// VTK's type of a polyhedron.
const POLYHEDRON: u8 = 42;

/// Takes the faces of polyhedra out of their lists, in which the points remain, each once
/// and in rising order, as VTK leaves them. Without polyhedra, the cells stay as they are.
pub(super) fn split_polyhedra(
    cells: CellArray,
    types: &[u8],
) -> Result<(CellArray, Option<Polyhedra>), ArrayError> {
    if !types.contains(&POLYHEDRON) {
        return Ok((cells, None));
    }
    let mut points = CellArray::new();
    let mut polyhedra = Polyhedra::default();
    for (index, (list, kind)) in cells.iter().zip(types).enumerate() {
        if *kind != POLYHEDRON {
            points.push(list);
            polyhedra.cells.push(&[]);
            continue;
        }
        let first = polyhedra.faces.len();
        polyhedra.push_cell(list).ok_or(ArrayError::BadFaces { cell: index })?;
        points.push(&corners(&polyhedra.faces, first));
    }
    Ok((points, Some(polyhedra)))
}

/// The points of the faces from `first` on, each once.
fn corners(faces: &CellArray, first: usize) -> Vec<i64> {
    let faces = (first..faces.len()).filter_map(|face| faces.get(face));
    let mut points: Vec<i64> = faces.flatten().copied().collect();
    points.sort_unstable();
    points.dedup();
    points
}
