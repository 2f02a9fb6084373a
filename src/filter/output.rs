//! Contours as VTK's polygonal data, by the conventions of its contour filter.

use super::resample::{Stencil, interpolate, pick};
use super::solution::Solution;
use crate::mesh::Vector;
use crate::vtk::{AttributeKind, CellArray, DataArray, PolyData, UnstructuredGrid, Values};

/// What the output holds beside contours and the grid's own data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutputOptions {
    /// Two-point segments, as VTK's filter writes, each with the data of its own
    /// cell; else polylines, each with the data of the cell in which it begins.
    pub segments: bool,
    /// Points of single precision.
    pub single: bool,
    /// The interpolant's gradient at each point, as `Gradients`.
    pub gradients: bool,
    /// The unit vector against the gradient, as `Normals`.
    pub normals: bool,
    /// Whether data of a grid travel along.
    pub data: bool,
}

impl OutputOptions {
    /// Whether the gradient is needed.
    pub fn need_gradients(&self) -> bool {
        self.gradients || self.normals
    }

    /// A position in the precision of the output.
    pub fn rounded(&self, position: &Vector) -> Vector {
        if self.single { position.map(|x| f64::from(x as f32)) } else { *position }
    }
}

/// The name of the array that says which cell each contour cell, and each point, comes from.
pub const ORIGINAL_CELLS: &str = "OriginalCellIds";

/// A point of a contour, and what it came from.
#[derive(Clone, Copy, Debug)]
pub struct OutputPoint {
    /// Where it is.
    pub position: Vector,
    /// The points of the grid around it, if data travel along; then all points have them.
    pub stencil: Option<Stencil>,
    /// Its level.
    pub level: f64,
    /// The cell of the grid that holds it.
    pub parent: u32,
    /// The interpolant's gradient, if it is needed; then all points have one.
    pub gradient: Option<Vector>,
}

/// The points of contours, property by property, as arrays of the output have them.
#[derive(Clone, Debug, Default)]
pub struct OutputPoints {
    /// Where each is.
    pub positions: Vec<Vector>,
    /// The points of the grid around each, if data travel along; else none.
    pub stencils: Vec<Stencil>,
    /// The level of each.
    pub levels: Vec<f64>,
    /// The cell of the grid that holds each.
    pub parents: Vec<u32>,
    /// The interpolant's gradient at each, if it is needed; else none.
    pub gradients: Vec<Vector>,
}

impl OutputPoints {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Makes room for so many more; for points around them if data travel along.
    pub fn reserve(&mut self, count: usize, with_stencils: bool) {
        self.positions.reserve(count);
        self.stencils.reserve(if with_stencils { count } else { 0 });
        self.levels.reserve(count);
        self.parents.reserve(count);
    }

    /// Adds a point.
    pub fn push(&mut self, point: OutputPoint) {
        self.positions.push(point.position);
        self.stencils.extend(point.stencil);
        self.levels.push(point.level);
        self.parents.push(point.parent);
        self.gradients.extend(point.gradient);
    }
}

/// Contours in the making.
pub struct Output {
    /// What was contoured, as [`Solution::label`](super::Solution::label).
    pub label: String,
    /// Whether its values were of single precision.
    single_values: bool,
    /// What to put out.
    pub options: OutputOptions,
    /// The points.
    pub points: OutputPoints,
    /// Lines.
    pub lines: CellArray,
    /// Triangles.
    pub polys: CellArray,
    /// The cell of the grid of each line, and then of each triangle.
    pub parents: Vec<u32>,
}

impl Output {
    /// No contours yet.
    pub fn new(solution: &Solution, options: OutputOptions) -> Self {
        Self {
            label: solution.label.clone(),
            single_values: solution.single,
            options,
            points: OutputPoints::default(),
            lines: CellArray::new(),
            polys: CellArray::new(),
            parents: Vec::new(),
        }
    }

    /// The contours with all data of the grid that was contoured.
    ///
    /// Point data are interpolated linearly, but for the contoured array itself,
    /// which is exactly the level. Cell data are those of the parent cells, field
    /// data are passed on.
    pub fn poly_data(self, grid: &UnstructuredGrid) -> PolyData {
        let mut data = PolyData::new(self.coordinates());
        data.cell_data = pick(&grid.cell_data, &self.parents);
        data.cell_data.push(cell_numbers(self.parents.iter().copied()));
        data.field_data = grid.field_data.clone();
        self.add_point_data(grid, &mut data);
        (data.lines, data.polys) = (self.lines, self.polys);
        data
    }

    fn coordinates(&self) -> DataArray {
        let coordinates =
            self.points.positions.iter().flat_map(|position| <[f64; 3]>::from(*position));
        if self.options.single {
            DataArray::new("Points", 3, coordinates.map(|x| x as f32).collect::<Vec<f32>>())
        } else {
            DataArray::new("Points", 3, coordinates.collect::<Vec<f64>>())
        }
    }

    fn add_point_data(&self, grid: &UnstructuredGrid, data: &mut PolyData) {
        data.point_data = interpolate(&grid.point_data, &self.points.stencils);
        let scalars = self.exact_levels();
        let name = scalars.name.clone();
        data.point_data.push(scalars);
        data.point_data.set_active(AttributeKind::Scalars, &name);
        data.point_data.push(cell_numbers(self.points.parents.iter().copied()));
        self.add_gradients(data);
    }

    /// The contoured array on the output: exactly the level. Integers become `f64`,
    /// for levels need not be whole.
    fn exact_levels(&self) -> DataArray {
        let levels = &self.points.levels;
        let values = if self.single_values {
            Values::F32(levels.iter().map(|&level| level as f32).collect())
        } else {
            Values::F64(levels.clone())
        };
        DataArray::new(&self.label, 1, values)
    }

    fn add_gradients(&self, data: &mut PolyData) {
        let gradients = self.points.gradients.iter();
        if self.options.gradients {
            let components: Vec<f64> = gradients.clone().flat_map(|g| [g.x, g.y, g.z]).collect();
            data.point_data.push(DataArray::new("Gradients", 3, components));
        }
        if self.options.normals {
            let downhill = |g: &Vector| -g.try_normalize(0.0).unwrap_or_default();
            let normals = gradients.map(downhill).flat_map(|n| [n.x, n.y, n.z]);
            let normals: Vec<f32> = normals.map(|x| x as f32).collect();
            data.point_data.push(DataArray::new("Normals", 3, normals));
            data.point_data.set_active(AttributeKind::Normals, "Normals");
        }
    }
}

/// Gives the cells that contours of a piece come from the numbers that they have in the whole.
pub fn renumber_cells(contours: &mut PolyData, in_whole: impl Fn(i64) -> i64) {
    for data in [&mut contours.point_data, &mut contours.cell_data] {
        if let Some(DataArray { values: Values::I64(cells), .. }) = data.get(ORIGINAL_CELLS) {
            let cells: Vec<i64> = cells.iter().map(|&cell| in_whole(cell)).collect();
            data.push(DataArray::new(ORIGINAL_CELLS, 1, cells));
        }
    }
}

fn cell_numbers(cells: impl Iterator<Item = u32>) -> DataArray {
    DataArray::new(ORIGINAL_CELLS, 1, cells.map(i64::from).collect::<Vec<i64>>())
}
