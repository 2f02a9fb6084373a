//! A grid of cells of any type.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::data_array::DataArray;
use super::polyhedra::Polyhedra;

/// A grid of cells of any type, as VTK's `vtkUnstructuredGrid`.
#[derive(Clone, Debug, PartialEq)]
pub struct UnstructuredGrid {
    /// The points: 3 components, `Float32` or `Float64`.
    pub points: DataArray,
    /// The points of each cell, in VTK's order; every index is that of a point.
    pub cells: CellArray,
    /// VTK's type of each cell, such as 10 for a tetrahedron.
    pub types: Vec<u8>,
    /// The faces of polyhedral cells (type 42), where there are any.
    pub polyhedra: Option<Polyhedra>,
    /// Arrays with one tuple a point.
    pub point_data: Attributes,
    /// Arrays with one tuple a cell.
    pub cell_data: Attributes,
    /// Arrays of any length, such as `TimeValue`.
    pub field_data: Attributes,
}

impl UnstructuredGrid {
    /// A grid without cells and arrays. `points`: 3 components, `Float32` or `Float64`.
    pub fn new(points: DataArray) -> Self {
        Self {
            points,
            cells: CellArray::new(),
            types: Vec::new(),
            polyhedra: None,
            point_data: Attributes::new(),
            cell_data: Attributes::new(),
            field_data: Attributes::new(),
        }
    }

    /// Appends a cell. `kind`: VTK's cell type; `points`: their indices in VTK's order.
    pub fn push_cell(&mut self, kind: u8, points: &[i64]) {
        self.cells.push(points);
        self.types.push(kind);
        if let Some(polyhedra) = &mut self.polyhedra {
            polyhedra.cells.push(&[]);
        }
    }
}
