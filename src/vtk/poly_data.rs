//! Points, lines and polygons.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::data_array::DataArray;

/// Points, lines, polygons and triangle strips, as VTK's `vtkPolyData`.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyData {
    /// The points: 3 components, `Float32` or `Float64`.
    pub points: DataArray,
    /// Cells that are one or several points.
    pub verts: CellArray,
    /// Cells that are polylines.
    pub lines: CellArray,
    /// Cells that are polygons.
    pub polys: CellArray,
    /// Cells that are triangle strips.
    pub strips: CellArray,
    /// Arrays with one tuple a point.
    pub point_data: Attributes,
    /// Arrays with one tuple a cell: first the verts, then lines, polys and strips.
    pub cell_data: Attributes,
    /// Arrays of any length, such as `TimeValue`.
    pub field_data: Attributes,
}

impl PolyData {
    /// Points without cells and arrays. `points`: 3 components, `Float32` or `Float64`.
    pub fn new(points: DataArray) -> Self {
        Self {
            points,
            verts: CellArray::new(),
            lines: CellArray::new(),
            polys: CellArray::new(),
            strips: CellArray::new(),
            point_data: Attributes::new(),
            cell_data: Attributes::new(),
            field_data: Attributes::new(),
        }
    }

    /// The number of cells of all four kinds, which cell data have as many tuples as.
    pub fn cell_count(&self) -> usize {
        let kinds = [&self.verts, &self.lines, &self.polys, &self.strips];
        kinds.iter().map(|cells| cells.len()).sum()
    }
}
