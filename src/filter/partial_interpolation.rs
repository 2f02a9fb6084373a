//! An interpolant of which only the cells are computed that hold some levels.
//!
//! The cubic of a cell is bounded by the cell's own data, before any neighbour is asked
//! ([`crate::interpolant::reach_in_tetrahedron`]). So few cells can hold a level, and only those and
//! their neighbours cost more than a glance. What comes of it is the same to the last bit.

use std::marker::PhantomData;

use super::error::FilterError;
use super::interpolation::{Interpolated, Interpolation, OnTetrahedra, OnTriangles, joined};
use super::options::{ContourOptions, InterpolantKind};
use super::solution::{Domain, Solution};
use crate::contour::{CellRanges, Levels};
use crate::field::Field;
use crate::interpolant::{Pci, Tricubic, reach_in_tetrahedron, reach_on_triangle};
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
        Self::for_levels(solution, options, &Levels::Explicit(Vec::new()), diagonal)
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
        let ranges = [flat.as_ref().map(|b| b.range), solid.as_ref().map(|b| b.range)];
        let levels = joined(ranges).map_or(Ok(Vec::new()), |range| levels.resolve(range))?;
        let triangles = flat.map(|bounded| bounded.at(&levels));
        let tetrahedra = solid.map(|bounded| bounded.at(&levels));
        Self::of_domains(solution, triangles, tetrahedra, diagonal)
    }
}

/// The cells of one dimension with bounds of their cubics, of which few are known.
struct Bounded<'a, Coefficients, const CORNERS: usize> {
    mesh: &'a SimplexMesh<'a, CORNERS>,
    field: Field<'a>,
    ranges: CellRanges,
    /// The least and the greatest value that the cubics attain.
    range: [f64; 2],
    ghosts: usize,
    coefficients: PhantomData<Coefficients>,
}

impl<'a, Coefficients, const CORNERS: usize> Bounded<'a, Coefficients, CORNERS>
where
    Coefficients: InSome<CORNERS>,
{
    /// The bounds by each cell's own data, and the range of all cubics; nothing if no cell has
    /// finite values.
    fn new(solution: &'a Solution, domain: &'a Domain<CORNERS>) -> Option<Self> {
        let (mesh, field) = (&domain.mesh, solution.field(domain));
        let reach = |cell| Coefficients::reach(mesh, &field, cell);
        let mut ranges = CellRanges::of_bounds(domain.count(), reach);
        let ghosts = domain.exclude_ghosts(&mut ranges);
        let values = |cell: usize| mesh.simplices()[cell].map(|p| field.values[p as usize]);
        let at_vertices = ranges.at_vertices(values)?;
        let extreme = ranges.cells_beyond(at_vertices, reach);
        let coefficients = Coefficients::in_some(mesh, field, &extreme);
        coefficients.narrow(mesh, field, &mut ranges, &extreme);
        let range = coefficients.attained_beyond(at_vertices, mesh, field, &ranges);
        Some(Self { mesh, field, ranges, range, ghosts, coefficients: PhantomData })
    }

    /// The cubics in the cells that hold one of the levels, which ascend.
    fn at(self, levels: &[f64]) -> Interpolated<Coefficients> {
        let Self { mesh, field, mut ranges, range, ghosts, .. } = self;
        let holding = ranges.cells_near_any(levels);
        let coefficients = Coefficients::in_some(mesh, field, &holding);
        coefficients.narrow(mesh, field, &mut ranges, &holding);
        Interpolated { coefficients, ranges, range, singular: 0, pde_fit: None, ghosts }
    }
}

/// An interpolant that can be computed in some cells.
trait InSome<const CORNERS: usize> {
    /// The bounds of a cubic by its cell's own data.
    fn reach(mesh: &SimplexMesh<CORNERS>, field: &Field, cell: usize) -> Option<[f64; 2]>;

    /// The interpolant in some cells.
    fn in_some(mesh: &SimplexMesh<CORNERS>, field: Field, cells: &Subset) -> Self;

    /// Narrows the bounds of cells in which it is known.
    fn narrow(
        &self,
        mesh: &SimplexMesh<CORNERS>,
        field: Field,
        ranges: &mut CellRanges,
        cells: &Subset,
    );

    /// Its least and greatest value, given those at the vertices.
    fn attained_beyond(
        &self,
        at_vertices: [f64; 2],
        mesh: &SimplexMesh<CORNERS>,
        field: Field,
        ranges: &CellRanges,
    ) -> [f64; 2];
}

impl InSome<3> for OnTriangles {
    fn reach(mesh: &TriangleMesh, field: &Field, cell: usize) -> Option<[f64; 2]> {
        reach_on_triangle(mesh, field, cell)
    }

    fn in_some(mesh: &TriangleMesh, field: Field, cells: &Subset) -> Self {
        Self::Pci(Pci::on_some(mesh, field, cells).into_centres())
    }

    fn narrow(&self, mesh: &TriangleMesh, field: Field, ranges: &mut CellRanges, cells: &Subset) {
        ranges.narrow(cells, self.cubics(mesh, field).as_ref());
    }

    fn attained_beyond(
        &self,
        at_vertices: [f64; 2],
        mesh: &TriangleMesh,
        field: Field,
        ranges: &CellRanges,
    ) -> [f64; 2] {
        ranges.attained_beyond(at_vertices, self.cubics(mesh, field).as_ref())
    }
}

impl InSome<4> for OnTetrahedra {
    fn reach(mesh: &TetrahedronMesh, field: &Field, cell: usize) -> Option<[f64; 2]> {
        reach_in_tetrahedron(mesh, field, cell)
    }

    fn in_some(mesh: &TetrahedronMesh, field: Field, cells: &Subset) -> Self {
        Self::Tricubic(Tricubic::in_some(mesh, field, cells).into_faces())
    }

    fn narrow(
        &self,
        mesh: &TetrahedronMesh,
        field: Field,
        ranges: &mut CellRanges,
        cells: &Subset,
    ) {
        ranges.narrow_tetrahedra(cells, self.cubics(mesh, field).as_ref());
    }

    fn attained_beyond(
        &self,
        at_vertices: [f64; 2],
        mesh: &TetrahedronMesh,
        field: Field,
        ranges: &CellRanges,
    ) -> [f64; 2] {
        ranges.attained_beyond_in_tetrahedra(at_vertices, self.cubics(mesh, field).as_ref())
    }
}
