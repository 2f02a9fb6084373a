//! An interpolant of which only the cells are computed that hold some levels.
//!
//! The cubic of a cell is bounded by the cell's own data, before any neighbour is asked
//! ([`crate::interpolant::reach_in_tetrahedron`]). So few cells can hold a level, and only those and
//! their neighbours cost more than a glance. What is drawn is the same to the last bit.

use std::marker::PhantomData;

use super::error::FilterError;
use super::gradients::GradientOrigin;
use super::interpolation::{Interpolated, Interpolation, OnTetrahedra, OnTriangles, joined};
use super::options::{ContourOptions, InterpolantKind};
use super::range_warning::goes_far_beyond;
use super::solution::{Domain, Solution};
use crate::bernstein::{TetrahedronCubic, TriangleCubic};
use crate::contour::{BlockRanges, CellCubic, CellRanges, Levels, holds_any};
use crate::field::Field;
use crate::interpolant::{JointReach, Pci, Tricubic, reach_in_tetrahedron, reach_on_triangle};
use crate::mesh::{SimplexMesh, Subset, TetrahedronMesh, TriangleMesh};

impl Interpolation {
    /// The interpolant of a solution that the options name, for their levels only: elsewhere it
    /// is not to be looked at. `diagonal` is that of the solution's extent.
    ///
    /// # Errors
    /// If no cell has finite values, or a level is no number.
    pub(super) fn at_levels(
        solution: &Solution,
        options: &ContourOptions,
        diagonal: f64,
    ) -> Result<Self, FilterError> {
        Self::for_levels(solution, options, &options.levels, diagonal)
    }

    /// The same for no level: only its range is to be looked at.
    ///
    /// # Errors
    /// If no cell has finite values.
    pub(super) fn of_range(
        solution: &Solution,
        options: &ContourOptions,
        diagonal: f64,
    ) -> Result<Self, FilterError> {
        Self::for_levels(solution, options, &Levels::Equal { count: 0, range: None }, diagonal)
    }

    fn for_levels(
        solution: &Solution,
        options: &ContourOptions,
        levels: &Levels,
        diagonal: f64,
    ) -> Result<Self, FilterError> {
        if options.interpolant != InterpolantKind::Pci || solution.pde.is_some() {
            return Self::new(solution, options);
        }
        let flat = solution.triangles.as_ref();
        let flat = flat.and_then(|domain| Bounded::<OnTriangles, 3>::new(solution, domain));
        let solid = solution.tetrahedra.as_ref();
        let solid = solid.and_then(|domain| Bounded::<OnTetrahedra, 4>::new(solution, domain));
        let are_known = levels.known()?.is_some();
        let flat = flat.map(|bounded| (bounded.range(are_known), bounded));
        let solid = solid.map(|bounded| (bounded.range(are_known), bounded));
        let ranges =
            [flat.as_ref().map(|(range, _)| *range), solid.as_ref().map(|(range, _)| *range)];
        let levels = levels.resolve(joined(ranges).unwrap_or_default())?;
        let triangles = flat.map(|(range, bounded)| bounded.at(&levels, range));
        let tetrahedra = solid.map(|(range, bounded)| bounded.at(&levels, range));
        Self::of_domains(solution, triangles, tetrahedra, diagonal)
    }
}

/// The cells of one dimension with bounds of their cubics, of which none is known.
struct Bounded<'a, Coefficients, const CORNERS: usize> {
    mesh: &'a SimplexMesh<'a, CORNERS>,
    field: Field<'a>,
    gradients: &'a GradientOrigin,
    ranges: BlockRanges,
    at_vertices: [f64; 2],
    /// What holds the ranges of all its cells.
    of_all: [f64; 2],
    coefficients: PhantomData<Coefficients>,
}

impl<'a, Coefficients, const CORNERS: usize> Bounded<'a, Coefficients, CORNERS>
where
    Coefficients: InSome<CORNERS>,
{
    /// The bounds by each cell's own data; nothing if no cell has finite values.
    fn new(solution: &'a Solution, domain: &'a Domain<CORNERS>) -> Option<Self> {
        let (mesh, field) = (&domain.mesh, solution.field(domain));
        let ranges = BlockRanges::new(
            domain.count(),
            |cells| JointReach::new(mesh, &field, cells),
            |cell| Coefficients::reach(mesh, &field, cell),
            |cell| mesh.simplices()[cell].map(|point| field.values[point as usize]),
            |cell| domain.is_ghost(cell),
        );
        let at_vertices = ranges.at_vertices()?;
        let of_all = ranges.of_all(|cell| Coefficients::reach(mesh, &field, cell))?;
        let (gradients, coefficients) = (&domain.gradients.origin, PhantomData);
        Some(Self { mesh, field, gradients, ranges, at_vertices, of_all, coefficients })
    }

    /// The least and the greatest value of the cubics. If the levels are known, of the vertices, unless
    /// there might be a warning: where a solution is zero on walls and positive elsewhere, many cells
    /// go below by their bounds, and to find out that no cubic does takes longer than one level.
    fn range(&self, levels_are_known: bool) -> [f64; 2] {
        if levels_are_known && !goes_far_beyond(self.gradients, self.at_vertices, self.of_all) {
            return self.at_vertices;
        }
        let [low, high] = self.at_vertices;
        let (coefficients, ranges) = self.in_some(|range| range[0] < low || range[1] > high);
        ranges.attained_beyond(self.at_vertices, coefficients.cubic(self.mesh, self.field))
    }

    /// The cubics in the cells that may hold one of the levels, which ascend. `range` is known already.
    fn at(&self, levels: &[f64], range: [f64; 2]) -> Interpolated<Coefficients> {
        let &Self { at_vertices, of_all, .. } = self;
        let (coefficients, ranges) = self.in_some(|range| holds_any(range, levels, of_all));
        let ghosts = self.ranges.excluded();
        Interpolated {
            coefficients,
            ranges,
            at_vertices,
            range,
            singular: 0,
            pde_fit: None,
            ghosts,
        }
    }

    /// The cubics in the cells whose bounds are wanted, and their ranges.
    fn in_some(&self, is_wanted: impl Fn([f64; 2]) -> bool + Sync) -> (Coefficients, CellRanges) {
        let &Self { mesh, field, ref ranges, .. } = self;
        let cells = ranges.cells_with(|cell| Coefficients::reach(mesh, &field, cell), is_wanted);
        let coefficients = Coefficients::in_some(mesh, field, &cells);
        let ranges = CellRanges::of_some(&cells, ranges, coefficients.cubic(mesh, field));
        (coefficients, ranges)
    }
}

/// An interpolant that can be computed in some cells.
trait InSome<const CORNERS: usize> {
    /// What it is on a cell.
    type Cubic: CellCubic;

    /// The bounds of a cubic by its cell's own data; nothing if these are not finite.
    fn reach(mesh: &SimplexMesh<CORNERS>, field: &Field, cell: usize) -> Option<[f64; 2]>;

    /// The interpolant in some cells.
    fn in_some(mesh: &SimplexMesh<CORNERS>, field: Field, cells: &Subset) -> Self;

    /// The cubic of a cell in which it is known.
    fn cubic<'a>(
        &'a self,
        mesh: &'a SimplexMesh<'a, CORNERS>,
        field: Field<'a>,
    ) -> impl Fn(usize) -> Self::Cubic + Sync;
}

impl InSome<3> for OnTriangles {
    type Cubic = TriangleCubic;

    fn reach(mesh: &TriangleMesh, field: &Field, cell: usize) -> Option<[f64; 2]> {
        reach_on_triangle(mesh, field, cell)
    }

    fn in_some(mesh: &TriangleMesh, field: Field, cells: &Subset) -> Self {
        Self::Pci(Pci::on_some(mesh, field, cells).into_centres())
    }

    fn cubic<'a>(
        &'a self,
        mesh: &'a TriangleMesh<'a>,
        field: Field<'a>,
    ) -> impl Fn(usize) -> TriangleCubic + Sync {
        let cubics = self.cubics(mesh, field);
        move |cell| cubics.cubic(cell)
    }
}

impl InSome<4> for OnTetrahedra {
    type Cubic = TetrahedronCubic;

    fn reach(mesh: &TetrahedronMesh, field: &Field, cell: usize) -> Option<[f64; 2]> {
        reach_in_tetrahedron(mesh, field, cell)
    }

    fn in_some(mesh: &TetrahedronMesh, field: Field, cells: &Subset) -> Self {
        Self::Tricubic(Tricubic::in_some(mesh, field, cells).into_faces())
    }

    fn cubic<'a>(
        &'a self,
        mesh: &'a TetrahedronMesh<'a>,
        field: Field<'a>,
    ) -> impl Fn(usize) -> TetrahedronCubic + Sync {
        let cubics = self.cubics(mesh, field);
        move |cell| cubics.cubic(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::super::extent::Extent;
    use super::super::gradients::GradientSource;
    use super::*;
    use crate::vtk::{DataArray, UnstructuredGrid};

    /// A bump on the unit square, zero on its sides, with its gradient.
    fn bump() -> UnstructuredGrid {
        // odd, so that no point is on top
        let n = 11_i64;
        let at = |k: i64| (k as f64 / n as f64, (1.0 - k as f64 / n as f64));
        let numbers = || (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
        let points = numbers().flat_map(|(i, j)| [at(i).0, at(j).0, 0.0]);
        let mut grid =
            UnstructuredGrid::new(DataArray::new("Points", 3, points.collect::<Vec<_>>()));
        for (i, j) in numbers().filter(|&(i, j)| i < n && j < n) {
            let first = j * (n + 1) + i;
            grid.push_cell(5, &[first, first + 1, first + n + 2]);
            grid.push_cell(5, &[first, first + n + 2, first + n + 1]);
        }
        let values = numbers().map(|(i, j)| at(i).0 * at(i).1 * at(j).0 * at(j).1);
        let slopes = numbers().flat_map(|(i, j)| {
            let ((x, left), (y, below)) = (at(i), at(j));
            [(left - x) * y * below, x * left * (below - y), 0.0]
        });
        grid.point_data.push(DataArray::new("u", 1, values.collect::<Vec<_>>()));
        grid.point_data.push(DataArray::new("slopes", 3, slopes.collect::<Vec<_>>()));
        grid
    }

    /// How many cells are known, and the ranges of values and cubics.
    fn known(gradient: GradientSource, levels: Levels) -> (usize, [f64; 2], [f64; 2]) {
        let array = Some("u".to_owned());
        let options = ContourOptions { levels, array, gradient, ..ContourOptions::default() };
        let grid = bump();
        let solution = Solution::of_grid(&grid, &options).unwrap();
        let diagonal = Extent::of_solution(&solution).diagonal();
        let found = Interpolation::at_levels(&solution, &options, diagonal).unwrap();
        let cells = found.triangles.unwrap().ranges.cells_near(0.0, |_| f64::INFINITY);
        (cells.len(), found.at_vertices, found.range)
    }

    #[test]
    fn cells_at_walls_are_asked_for_only_where_the_range_is_wanted() {
        let given = || GradientSource::Array("slopes".to_owned());
        let top = || Levels::Explicit(vec![0.06]);
        for gradient in [given(), GradientSource::Recovered] {
            let (cells, values, range) = known(gradient, top());
            assert!((4..60).contains(&cells), "{cells}");
            assert_eq!((values[0], range), (0.0, values));
        }
        let (_, values, range) = known(given(), Levels::Equal { count: 9, range: None });
        assert!(values[1] < 0.0616 && range[1] > 0.062, "{values:?} {range:?}");
    }
}
