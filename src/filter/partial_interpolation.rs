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
        let at = |levels: &[f64]| {
            let triangles = flat.as_ref().map(|bounded| bounded.at(levels));
            (triangles, solid.as_ref().map(|bounded| bounded.at(levels)))
        };
        let (triangles, tetrahedra) = match levels.known()? {
            Some(levels) => at(&levels),
            None => {
                let (flat, solid) = at(&[]);
                let range =
                    joined([flat.as_ref().map(|i| i.range), solid.as_ref().map(|i| i.range)]);
                let levels = range.map_or(Ok(Vec::new()), |range| levels.resolve(range))?;
                if levels.is_empty() {
                    (flat, solid)
                } else {
                    // not both at a time
                    drop((flat, solid));
                    at(&levels)
                }
            }
        };
        Self::of_domains(solution, triangles, tetrahedra, diagonal)
    }
}

/// The cells of one dimension with bounds of their cubics, of which none is known.
struct Bounded<'a, Coefficients, const CORNERS: usize> {
    mesh: &'a SimplexMesh<'a, CORNERS>,
    field: Field<'a>,
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
        Some(Self { mesh, field, ranges, at_vertices, of_all, coefficients: PhantomData })
    }

    /// The cubics in the cells that may hold one of the levels, which ascend, or a value that is
    /// beyond those at the vertices.
    fn at(&self, levels: &[f64]) -> Interpolated<Coefficients> {
        let &Self { mesh, field, ref ranges, at_vertices, of_all, .. } = self;
        let [low, high] = at_vertices;
        let reach = |cell| Coefficients::reach(mesh, &field, cell);
        let is_wanted =
            |range: [f64; 2]| range[0] < low || range[1] > high || holds_any(range, levels, of_all);
        let cells = ranges.cells_with(reach, is_wanted);
        let coefficients = Coefficients::in_some(mesh, field, &cells);
        let ghosts = ranges.excluded();
        let cubic = coefficients.cubic(mesh, field);
        let ranges = CellRanges::of_some(&cells, ranges, &cubic);
        let range = ranges.attained_beyond(at_vertices, &cubic);
        drop(cubic);
        Interpolated { coefficients, ranges, range, singular: 0, pde_fit: None, ghosts }
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
