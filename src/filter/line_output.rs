//! Contour lines as VTK's polygonal data, by the conventions of its contour filter.

use std::collections::HashMap;
use std::ops::Range;

use super::chosen_array::ChosenArray;
use super::resample::{Stencil, interpolate, pick};
use crate::contour::lines::{ContourLines, LinePoint};
use crate::interpolant::TriangleCubics;
use crate::mesh::Vector;
use crate::vtk::{
    ArrayType, AttributeKind, CellArray, DataArray, PolyData, UnstructuredGrid, Values,
};

/// What the output holds beside lines and the grid's own data.
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
}

/// The name of the array that says which cell each line, and each point, comes from.
pub const ORIGINAL_CELLS: &str = "OriginalCellIds";

/// Contour lines, and what they came from.
pub struct LineOutput<'a> {
    /// The grid whose data are carried over.
    pub grid: &'a UnstructuredGrid,
    /// The cell of the grid of each triangle.
    pub parents: &'a [u32],
    /// What was contoured.
    pub chosen: &'a ChosenArray<'a>,
    /// The interpolant that was contoured.
    pub interpolant: &'a dyn TriangleCubics,
    /// Its contour lines.
    pub lines: &'a ContourLines,
    /// What to put out.
    pub options: OutputOptions,
}

impl LineOutput<'_> {
    /// The contour lines with all data of the grid.
    ///
    /// Point data are interpolated linearly, but for the contoured array itself,
    /// which is exactly the level. Cell data are those of the parent cells, field
    /// data are passed on.
    pub fn poly_data(&self) -> PolyData {
        let mut points = Points::default();
        let mut cells = CellArray::new();
        let mut parents = Vec::new();
        for line in &self.lines.lines {
            let places = self.distinct(line.points.clone());
            let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]);
            if self.options.segments {
                for [from, to] in pairs {
                    let ends = [from, to].map(|place| points.number(self.lines, place, line.level));
                    cells.push(&ends);
                    parents.push(self.parent(self.lines.segment_cells[from]));
                }
            } else if places.len() >= 2 {
                let number = |&place: &usize| points.number(self.lines, place, line.level);
                cells.push(&places.iter().map(number).collect::<Vec<i64>>());
                parents.push(self.parent(self.lines.segment_cells[places[0]]));
            }
        }
        let mut data = PolyData::new(self.coordinates(&points));
        data.lines = cells;
        data.cell_data = pick(&self.grid.cell_data, &parents);
        data.cell_data.push(cell_numbers(parents.into_iter()));
        data.field_data = self.grid.field_data.clone();
        self.add_point_data(&mut data, &points);
        data
    }

    fn parent(&self, triangle: u32) -> u32 {
        self.parents[triangle as usize]
    }

    /// The places of a line's points, without those that rounding to the output's
    /// precision makes equal to the one before.
    fn distinct(&self, places: Range<usize>) -> Vec<usize> {
        let position = |place: usize| {
            let point = self.lines.connectivity[place] as usize;
            self.rounded(&self.lines.points[point].position)
        };
        let first = places.start;
        places.filter(|&place| place == first || position(place) != position(place - 1)).collect()
    }

    fn rounded(&self, position: &Vector) -> Vector {
        if self.options.single { position.map(|x| f64::from(x as f32)) } else { *position }
    }

    fn coordinates(&self, points: &Points) -> DataArray {
        let positions = points.used.iter().map(|&point| self.lines.points[point as usize].position);
        let coordinates = positions.flat_map(|p| [p.x, p.y, p.z]);
        if self.options.single {
            DataArray::new("Points", 3, coordinates.map(|x| x as f32).collect::<Vec<f32>>())
        } else {
            DataArray::new("Points", 3, coordinates.collect::<Vec<f64>>())
        }
    }

    fn add_point_data(&self, data: &mut PolyData, points: &Points) {
        let of_lines = |&point: &u32| self.lines.points[point as usize];
        let line_points: Vec<LinePoint> = points.used.iter().map(of_lines).collect();
        let triangles = self.interpolant.mesh().triangles();
        let stencil = |point: &LinePoint| Stencil {
            points: triangles[point.cell as usize],
            weights: point.at,
        };
        let stencils: Vec<Stencil> = line_points.iter().map(stencil).collect();
        data.point_data = interpolate(&self.grid.point_data, &stencils);
        let levels = points.levels.iter().map(|&level| self.lines.levels[level]).collect();
        let scalars = exact_levels(self.chosen, levels);
        let name = scalars.name.clone();
        data.point_data.push(scalars);
        data.point_data.set_active(AttributeKind::Scalars, &name);
        data.point_data.push(cell_numbers(line_points.iter().map(|point| self.parent(point.cell))));
        self.add_gradients(data, &line_points);
    }

    fn add_gradients(&self, data: &mut PolyData, points: &[LinePoint]) {
        let gradient = |point: &LinePoint| {
            let cell = point.cell as usize;
            let slope = self.interpolant.cubic(cell).barycentric_gradient(&point.at);
            self.interpolant.mesh().frame(cell).gradient(&slope)
        };
        if self.options.gradients {
            let gradients = points.iter().map(gradient).flat_map(|g| [g.x, g.y, g.z]);
            data.point_data.push(DataArray::new("Gradients", 3, gradients.collect::<Vec<f64>>()));
        }
        if self.options.normals {
            let downhill = |g: Vector| -g.try_normalize(0.0).unwrap_or_default();
            let normals = points.iter().map(gradient).map(downhill).flat_map(|n| [n.x, n.y, n.z]);
            let normals: Vec<f32> = normals.map(|x| x as f32).collect();
            data.point_data.push(DataArray::new("Normals", 3, normals));
            data.point_data.set_active(AttributeKind::Normals, "Normals");
        }
    }
}

/// The contoured array on the output: exactly the level. Integers become `f64`,
/// for levels need not be whole.
fn exact_levels(chosen: &ChosenArray, levels: Vec<f64>) -> DataArray {
    let values = if chosen.array.array_type() == ArrayType::F32 {
        Values::F32(levels.into_iter().map(|level| level as f32).collect())
    } else {
        Values::F64(levels)
    };
    DataArray::new(chosen.label(), 1, values)
}

fn cell_numbers(cells: impl Iterator<Item = u32>) -> DataArray {
    DataArray::new(ORIGINAL_CELLS, 1, cells.map(i64::from).collect::<Vec<i64>>())
}

/// The points of the output, numbered in the order in which lines use them.
#[derive(Default)]
struct Points {
    /// For each point of the output, its number in the lines.
    used: Vec<u32>,
    /// For each, its level.
    levels: Vec<usize>,
    /// For points of the lines that are used, their number in the output.
    numbers: HashMap<u32, i64>,
}

impl Points {
    fn number(&mut self, lines: &ContourLines, place: usize, level: usize) -> i64 {
        let point = lines.connectivity[place];
        let (used, levels) = (&mut self.used, &mut self.levels);
        *self.numbers.entry(point).or_insert_with(|| {
            used.push(point);
            levels.push(level);
            used.len() as i64 - 1
        })
    }
}
