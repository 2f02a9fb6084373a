//! Points, lines and polygons.

use super::array_type::ArrayType;
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

    /// The points, cells and data of several, one after the other; points are not merged. Arrays
    /// that are not alike in all are left out, and their names are returned. Field data are
    /// those of the first.
    pub fn joined(mut parts: Vec<Self>) -> (Self, Vec<String>) {
        match parts.len() {
            0 => return (Self::new(DataArray::new("Points", 3, Vec::<f64>::new())), Vec::new()),
            1 => return (parts.remove(0), Vec::new()),
            _ => {}
        }
        let order = by_kind(parts.iter().map(Self::counts));
        let sizes: Vec<usize> = parts.iter().map(|part| part.points.tuples()).collect();
        let mut take = |of: fn(&mut Self) -> &mut CellArray| {
            joined_cells(
                &parts.iter_mut().map(|p| std::mem::take(of(p))).collect::<Vec<_>>(),
                &sizes,
            )
        };
        let verts = take(|part| &mut part.verts);
        let lines = take(|part| &mut part.lines);
        let polys = take(|part| &mut part.polys);
        let strips = take(|part| &mut part.strips);
        let field_data = std::mem::take(&mut parts[0].field_data);
        let (mut points, mut point_data, mut cell_data) = (Vec::new(), Vec::new(), Vec::new());
        for part in parts {
            points.push(part.points);
            point_data.push(part.point_data);
            cell_data.push(part.cell_data);
        }
        let points = joined_points(points);
        let (point_data, mut left_out) = Attributes::joined(point_data);
        let (mut cell_data, more_left_out) = Attributes::joined(cell_data);
        left_out.extend(more_left_out);
        cell_data.reorder(&order);
        (Self { points, verts, lines, polys, strips, point_data, cell_data, field_data }, left_out)
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

/// The places of cells that stand part after part, in the order of kinds: first all verts, then
/// all lines, and so on. `counts` are how many of each kind the parts have.
pub(super) fn by_kind(counts: impl Iterator<Item = [usize; 4]>) -> Vec<Range<usize>> {
    let mut ranges: [Vec<Range<usize>>; 4] = Default::default();
    let mut next = 0;
    for counts in counts {
        for (ranges, count) in ranges.iter_mut().zip(counts) {
            if count > 0 {
                ranges.push(next..next + count);
            }
            next += count;
        }
    }
    ranges.concat()
}

/// Cells of several data sets, of which the numbers of points are given.
fn joined_cells(parts: &[CellArray], points: &[usize]) -> CellArray {
    let mut all = CellArray::new();
    all.reserve(parts.iter().map(|part| part.connectivity().len()).sum());
    let mut first = 0;
    for (part, points) in parts.iter().zip(points) {
        all.append_moved(part, first);
        first += points;
    }
    all
}

/// Points of several data sets; in double precision if any are.
fn joined_points(parts: Vec<DataArray>) -> DataArray {
    let is_double = parts.iter().any(|part| part.array_type() == ArrayType::F64);
    let mut parts = parts.into_iter().map(|part| match part.to_f64() {
        Some(values) if is_double => DataArray { values: values.into(), ..part },
        _ => part,
    });
    let first = parts.next().unwrap_or_else(|| DataArray::new("Points", 3, Vec::<f64>::new()));
    parts.fold(first, |mut all, part| {
        all.values.append(part.values);
        all
    })
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
    fn cells_of_a_kind_stand_together_when_parts_are_joined() {
        let single = Values::F32((0..9_u8).map(f32::from).collect());
        let double = Values::F64((0..9_u8).map(f64::from).collect());
        let mut first = lines_and_a_polygon(single.clone(), 1, 10);
        first.point_data.push(DataArray::new("p", 1, vec![1_i8; 3]));
        first.field_data.push(DataArray::new("TimeValue", 1, vec![0.5]));
        let second = lines_and_a_polygon(double, 2, 20);
        let third = lines_and_a_polygon(single, 1, 30);
        let field_data = first.field_data.clone();
        let (data, left_out) = PolyData::joined(vec![first, second, third]);
        assert_eq!(left_out, ["p"]);
        let numbers = [10, 20, 21, 30, 11, 22, 31].map(|n| [n, -n]).concat();
        assert_eq!(data.cell_data.get("n").unwrap().values, Values::I64(numbers));
        assert_eq!(data.lines.connectivity(), [0, 1, 3, 4, 3, 4, 6, 7]);
        assert_eq!(data.polys.connectivity(), [2, 1, 0, 5, 4, 3, 8, 7, 6]);
        let points = (0..27_u8).map(|n| f64::from(n % 9)).collect();
        assert_eq!(data.points.values, Values::F64(points));
        assert_eq!(data.field_data, field_data);
    }

    #[test]
    fn nothing_and_one_part_are_joined() {
        let points = Values::F32((0..9_u8).map(f32::from).collect());
        let data = lines_and_a_polygon(points, 2, 0);
        assert_eq!(PolyData::joined(vec![data.clone()]), (data, Vec::new()));
        let (nothing, left_out) = PolyData::joined(Vec::new());
        assert_eq!((nothing.points.tuples(), nothing.cell_count(), left_out.len()), (0, 0, 0));
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
