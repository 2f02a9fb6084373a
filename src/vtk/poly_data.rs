//! Points, lines and polygons.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::data_array::DataArray;
use super::unstructured_grid::UnstructuredGrid;

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

    /// The same points, cells and data as a grid of cells.
    pub fn into_grid(self) -> UnstructuredGrid {
        let cells = self.cell_count();
        let mut grid = UnstructuredGrid::new(self.points);
        grid.types.reserve(cells);
        for point in self.verts.iter() {
            grid.push_cell(if point.len() == 1 { 1 } else { 2 }, point);
        }
        for line in self.lines.iter() {
            grid.push_cell(if line.len() == 2 { 3 } else { 4 }, line);
        }
        for polygon in self.polys.iter() {
            let cell_type = match polygon.len() {
                3 => 5,
                4 => 9,
                _ => 7,
            };
            grid.push_cell(cell_type, polygon);
        }
        for strip in self.strips.iter() {
            grid.push_cell(6, strip);
        }
        grid.point_data = self.point_data;
        grid.cell_data = self.cell_data;
        grid.field_data = self.field_data;
        grid
    }

    /// The number of cells of all four kinds, which cell data have as many tuples as.
    pub fn cell_count(&self) -> usize {
        let kinds = [&self.verts, &self.lines, &self.polys, &self.strips];
        kinds.iter().map(|cells| cells.len()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_the_same_cells_in_the_same_order() {
        let mut data = PolyData::new(DataArray::new("Points", 3, vec![0.0_f64; 18]));
        data.verts.push(&[0]);
        data.lines.push(&[0, 1]);
        data.lines.push(&[0, 1, 2]);
        data.polys.push(&[0, 1, 2]);
        data.polys.push(&[0, 1, 2, 3, 4]);
        data.strips.push(&[0, 1, 2, 3]);
        let numbers: Vec<i64> = (0..6).collect();
        data.cell_data.push(DataArray::new("n", 1, numbers));
        let grid = data.clone().into_grid();
        assert_eq!(grid.types, [1, 3, 4, 5, 7, 6]);
        assert_eq!(grid.cells.get(4), Some(&[0_i64, 1, 2, 3, 4][..]));
        assert_eq!(grid.cell_data, data.cell_data);
    }
}
