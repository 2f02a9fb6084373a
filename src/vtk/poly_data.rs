//! Points, lines and polygons.

use super::attributes::Attributes;
use super::cell_array::CellArray;
use super::data_array::DataArray;
use super::unstructured_grid::UnstructuredGrid;
use std::ops::Range;

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

    /// Appends the points, cells and data of another; its points are not merged. Arrays that are
    /// not alike in both are left out: their names are returned. Field data are those of the
    /// first that has any.
    pub fn append(&mut self, other: Self) -> Vec<String> {
        let cells = cells_by_kind(&self.counts(), &other.counts());
        let first_point = self.points.tuples();
        append_points(&mut self.points, other.points);
        for (own, more) in [
            (&mut self.verts, &other.verts),
            (&mut self.lines, &other.lines),
            (&mut self.polys, &other.polys),
            (&mut self.strips, &other.strips),
        ] {
            own.append_moved(more, first_point);
        }
        let mut left_out = self.point_data.append(other.point_data);
        left_out.extend(self.cell_data.append(other.cell_data));
        if !cells.is_sorted_by_key(|range| range.start) {
            for array in self.cell_data.iter_mut() {
                let values =
                    cells.iter().map(|c| c.start * array.components..c.end * array.components);
                array.values = array.values.gather(&values.collect::<Vec<_>>());
            }
        }
        if self.field_data.is_empty() {
            self.field_data = other.field_data;
        }
        left_out
    }

    /// The number of cells of each kind, in the order of cell data.
    fn counts(&self) -> [usize; 4] {
        [&self.verts, &self.lines, &self.polys, &self.strips].map(CellArray::len)
    }

    /// The number of cells of all four kinds, which cell data have as many tuples as.
    pub fn cell_count(&self) -> usize {
        self.counts().iter().sum()
    }
}

/// Where the cells of two stand one after the other, in the order of kinds: first all verts, then
/// all lines, and so on. Kinds that there are none of are left out.
fn cells_by_kind(first: &[usize; 4], second: &[usize; 4]) -> Vec<Range<usize>> {
    let (mut next, mut next_of_second) = (0, first.iter().sum());
    let mut ranges = Vec::with_capacity(8);
    for (count, more) in first.iter().zip(second) {
        ranges.extend([next..next + count, next_of_second..next_of_second + more]);
        next += count;
        next_of_second += more;
    }
    ranges.retain(|range| !range.is_empty());
    ranges
}

/// Appends points; in double precision if either is.
fn append_points(points: &mut DataArray, more: DataArray) {
    if points.array_type() == more.array_type() {
        points.values.append(more.values);
    } else {
        let both = [&*points, &more].map(|array| array.to_f64().unwrap_or_default());
        points.values = both.concat().into();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::Values;

    /// Points at 0, 1, ..., a polygon and so many lines, with numbers from `first`.
    fn lines_and_a_polygon(points: Values, lines: usize, first: i64) -> PolyData {
        let mut data = PolyData::new(DataArray::new("Points", 3, points));
        (0..lines).for_each(|_| data.lines.push(&[0, 1]));
        data.polys.push(&[2, 1, 0]);
        let numbers: Vec<i64> = (first..=first + lines as i64).flat_map(|n| [n, -n]).collect();
        data.cell_data.push(DataArray::new("n", 2, numbers));
        data
    }

    #[test]
    fn cells_of_a_kind_stand_together_when_others_are_appended() {
        let single = Values::F32((0..9_u8).map(f32::from).collect());
        let double = Values::F64((0..9_u8).map(f64::from).collect());
        let mut data = lines_and_a_polygon(single, 1, 10);
        data.point_data.push(DataArray::new("p", 1, vec![1_i8; 3]));
        let mut more = lines_and_a_polygon(double, 2, 20);
        more.field_data.push(DataArray::new("TimeValue", 1, vec![0.5]));
        assert_eq!(data.append(more), ["p"]);
        let numbers = [10, 20, 21, 11, 22].map(|n| [n, -n]).concat();
        assert_eq!(data.cell_data.get("n").unwrap().values, Values::I64(numbers));
        assert_eq!(data.lines.connectivity(), [0, 1, 3, 4, 3, 4]);
        assert_eq!(data.polys.connectivity(), [2, 1, 0, 5, 4, 3]);
        let points = (0..18_u8).map(|n| f64::from(n % 9)).collect();
        assert_eq!(data.points.values, Values::F64(points));
        assert_eq!(data.field_data.len(), 1);
        // those of one kind only
        let mut data = PolyData::new(DataArray::new("Points", 3, vec![0.0_f64; 6]));
        data.lines.push(&[0, 1]);
        data.cell_data.push(DataArray::new("n", 1, vec![7_u8]));
        assert!(data.append(data.clone()).is_empty());
        assert_eq!(data.cell_data.get("n").unwrap().values, Values::U8(vec![7, 7]));
    }

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
