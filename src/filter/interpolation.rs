//! What is computed of a solution before any level is known.

use super::error::FilterError;
use super::extent::Extent;
use super::merge_points::coincidence_warning;
use super::options::{ContourOptions, InterpolantKind};
use super::range_warning::range_warning;
use super::solution::{Domain, Solution};
use crate::contour::CellRanges;
use crate::field::Field;
use crate::interpolant::{
    Centres, FaceCoefficients, Linear, Pci, PdeFit, TetrahedronCubics, TriangleCubics, Tricubic,
};
use crate::mesh::{TetrahedronMesh, TriangleMesh};

/// What is computed of a solution before any level is known: the coefficients that cannot be
/// read off its values and gradients, and the range of each cell.
///
/// It borrows nothing, so that it can be kept; a level costs only its contour then.
#[derive(Clone, Debug)]
pub struct Interpolation {
    /// On the two-dimensional cells, if there are any with finite values.
    pub triangles: Option<Interpolated<OnTriangles>>,
    /// In the solids, if there are any with finite values.
    pub tetrahedra: Option<Interpolated<OnTetrahedra>>,
    /// The least and the greatest value at vertices of cells that are contoured.
    pub at_vertices: [f64; 2],
    /// The least and the greatest value of the cubics. Of an interpolant for given levels it may be
    /// that of the vertices: then nothing hangs on it.
    pub range: [f64; 2],
    /// The length of the diagonal of the solution's [`Extent`].
    pub diagonal: f64,
    /// What people should know about the solution, a line each.
    pub warnings: Vec<String>,
}

/// Cubics on the cells of one dimension.
#[derive(Clone, Debug)]
pub struct Interpolated<Coefficients> {
    /// The kind of cubics, and what of them has to be stored.
    pub coefficients: Coefficients,
    /// Their range on each cell, without those of other processes.
    pub ranges: CellRanges,
    /// The least and the greatest value at their vertices.
    pub at_vertices: [f64; 2],
    /// The least and the greatest value that they attain, or at their vertices, as
    /// [`Interpolation::range`] says.
    pub range: [f64; 2],
    /// Cells in which the PDE could not be used.
    pub singular: usize,
    /// How well the PDE fits the data; nothing without a PDE.
    pub pde_fit: Option<PdeFit>,
    /// Cells of another process, which are not contoured.
    pub ghosts: usize,
}

/// An interpolant on triangles, without its mesh and field.
#[derive(Clone, Debug)]
pub enum OnTriangles {
    /// The linear one.
    Linear,
    /// The pure cubic.
    Pci(Centres),
}

/// An interpolant in tetrahedra, without its mesh and field.
#[derive(Clone, Debug)]
pub enum OnTetrahedra {
    /// The linear one.
    Linear,
    /// The tri-cubic.
    Tricubic(FaceCoefficients),
}

impl OnTriangles {
    /// The interpolant of the field that it was computed of.
    pub fn cubics<'a>(
        &'a self,
        mesh: &'a TriangleMesh<'a>,
        field: Field<'a>,
    ) -> Box<dyn TriangleCubics + 'a> {
        match self {
            Self::Linear => Box::new(Linear::new(mesh, field.values)),
            Self::Pci(centres) => Box::new(Pci::with_centres(mesh, field, centres)),
        }
    }
}

impl OnTetrahedra {
    /// The interpolant of the field that it was computed of.
    pub fn cubics<'a>(
        &'a self,
        mesh: &'a TetrahedronMesh<'a>,
        field: Field<'a>,
    ) -> Box<dyn TetrahedronCubics + 'a> {
        match self {
            Self::Linear => Box::new(Linear::new(mesh, field.values)),
            Self::Tricubic(faces) => Box::new(Tricubic::with_faces(mesh, field, faces)),
        }
    }
}

impl Interpolation {
    /// The interpolant of a solution that the options name.
    ///
    /// # Errors
    /// If no cell has finite values.
    pub fn new(solution: &Solution, options: &ContourOptions) -> Result<Self, FilterError> {
        let triangles =
            solution.triangles.as_ref().and_then(|d| in_triangles(solution, d, options));
        let tetrahedra =
            solution.tetrahedra.as_ref().and_then(|d| in_tetrahedra(solution, d, options));
        let diagonal = Extent::of_solution(solution).diagonal();
        Self::of_domains(solution, triangles, tetrahedra, diagonal)
    }

    /// What is computed of the cells of both dimensions, taken together.
    pub(super) fn of_domains(
        solution: &Solution,
        triangles: Option<Interpolated<OnTriangles>>,
        tetrahedra: Option<Interpolated<OnTetrahedra>>,
        diagonal: f64,
    ) -> Result<Self, FilterError> {
        let ranges = [triangles.as_ref().map(|i| i.range), tetrahedra.as_ref().map(|i| i.range)];
        let no_values = || match solution.has_only_ghosts() {
            true => FilterError::OnlyGhosts,
            false => FilterError::NoValues { name: solution.label.clone() },
        };
        let range = joined(ranges).ok_or_else(no_values)?;
        let values =
            [triangles.as_ref().map(|i| i.at_vertices), tetrahedra.as_ref().map(|i| i.at_vertices)];
        let at_vertices = joined(values).ok_or_else(no_values)?;
        let warnings = warnings(solution, triangles.as_ref(), tetrahedra.as_ref());
        Ok(Self { triangles, tetrahedra, at_vertices, range, diagonal, warnings })
    }

    /// How many triangles and tetrahedra are those of another process.
    pub fn ghosts(&self) -> usize {
        self.triangles.as_ref().map_or(0, |found| found.ghosts)
            + self.tetrahedra.as_ref().map_or(0, |found| found.ghosts)
    }

    /// How many triangles and tetrahedra have values or gradients that are not finite.
    pub fn unusable(&self) -> usize {
        self.triangles.as_ref().map_or(0, |found| found.ranges.unusable())
            + self.tetrahedra.as_ref().map_or(0, |found| found.ranges.unusable())
    }

    /// In how many triangles and tetrahedra the PDE could not be used.
    pub fn singular(&self) -> usize {
        self.triangles.as_ref().map_or(0, |found| found.singular)
            + self.tetrahedra.as_ref().map_or(0, |found| found.singular)
    }
}

/// The range of what has one range or another, if anything has one.
pub(super) fn joined(ranges: [Option<[f64; 2]>; 2]) -> Option<[f64; 2]> {
    ranges.into_iter().flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

fn in_triangles(
    solution: &Solution,
    domain: &Domain<3>,
    options: &ContourOptions,
) -> Option<Interpolated<OnTriangles>> {
    let (mesh, field) = (&domain.mesh, solution.field(domain));
    let (mut singular, mut pde_fit) = (0, None);
    let coefficients = match (options.interpolant, &solution.pde) {
        (InterpolantKind::Linear, _) => OnTriangles::Linear,
        (InterpolantKind::QuadraticPrecision, _) => {
            OnTriangles::Pci(Pci::with_quadratic_precision(mesh, field).into_centres())
        }
        (InterpolantKind::Pci, None) => OnTriangles::Pci(Pci::new(mesh, field).into_centres()),
        (InterpolantKind::Pci, Some(known)) => {
            let pci = Pci::with_pde(mesh, field, &known.equation(options.predictor));
            singular = pci.singular();
            pde_fit = Some(PdeFit::new(&pci, &known.pde));
            OnTriangles::Pci(pci.into_centres())
        }
    };
    let cubics = coefficients.cubics(mesh, field);
    let mut ranges = CellRanges::new(cubics.as_ref());
    let ghosts = domain.exclude_ghosts(&mut ranges);
    let at_vertices = ranges.at_vertices(|cell| cubics.vertices(cell))?;
    let range = ranges.attained_beyond(at_vertices, |cell| cubics.cubic(cell));
    drop(cubics);
    Some(Interpolated { coefficients, ranges, at_vertices, range, singular, pde_fit, ghosts })
}

fn in_tetrahedra(
    solution: &Solution,
    domain: &Domain<4>,
    options: &ContourOptions,
) -> Option<Interpolated<OnTetrahedra>> {
    let (mesh, field) = (&domain.mesh, solution.field(domain));
    let mut singular = 0;
    let coefficients = match (options.interpolant, &solution.pde) {
        (InterpolantKind::Linear, _) => OnTetrahedra::Linear,
        (InterpolantKind::QuadraticPrecision, _) => {
            OnTetrahedra::Tricubic(Tricubic::with_quadratic_precision(mesh, field).into_faces())
        }
        (InterpolantKind::Pci, None) => {
            OnTetrahedra::Tricubic(Tricubic::new(mesh, field).into_faces())
        }
        (InterpolantKind::Pci, Some(known)) => {
            let equation = known.equation(options.predictor);
            let tricubic = Tricubic::with_pde(mesh, field, &equation);
            singular = tricubic.singular();
            OnTetrahedra::Tricubic(tricubic.into_faces())
        }
    };
    let cubics = coefficients.cubics(mesh, field);
    let mut ranges = CellRanges::of_tetrahedra(cubics.as_ref());
    let ghosts = domain.exclude_ghosts(&mut ranges);
    let at_vertices = ranges.at_vertices(|cell| cubics.vertices(cell))?;
    let range = ranges.attained_beyond(at_vertices, |cell| cubics.cubic(cell));
    drop(cubics);
    Some(Interpolated { coefficients, ranges, at_vertices, range, singular, pde_fit: None, ghosts })
}

/// What people should know about the solution, a line each, and about what was computed of it.
fn warnings(
    solution: &Solution,
    flat: Option<&Interpolated<OnTriangles>>,
    solid: Option<&Interpolated<OnTetrahedra>>,
) -> Vec<String> {
    let mut warnings = solution.pde_warnings().to_vec();
    if let Some(domain) = &solution.triangles {
        warnings.extend(of_domain(solution, domain, flat));
    }
    if let Some(domain) = &solution.tetrahedra {
        warnings.extend(of_domain(solution, domain, solid));
    }
    warnings.dedup();
    warnings
}

/// What people should know about the cells of one dimension.
fn of_domain<Coefficients, const CORNERS: usize>(
    solution: &Solution,
    domain: &Domain<CORNERS>,
    found: Option<&Interpolated<Coefficients>>,
) -> impl Iterator<Item = String> {
    let gradients = &domain.gradients;
    let too_far = found.and_then(|found| {
        range_warning(&solution.label, &gradients.origin, found.at_vertices, found.range)
    });
    [coincidence_warning(&domain.mesh), gradients.warning.clone(), too_far].into_iter().flatten()
}
