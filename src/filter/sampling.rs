//! The interpolant at other points: given ones, those of a finer mesh, a regular grid.

use std::borrow::Cow;

use rayon::prelude::*;

use super::contour_filter::prepared;
use super::error::FilterError;
use super::evaluation::{Locators, Place};
use super::family_member::{FamilyMember, HasFamily, MemberPieces};
use super::interpolant::Interpolant;
use super::options::ContourOptions;
use super::output::ORIGINAL_CELLS;
use super::rectangles::Rectangles;
use super::resample::{Stencil, interpolate, pick};
use super::solution::{Domain, Solution};
use crate::interpolant::{
    Equation, Pieces, TetrahedronCubics, TriangleCubics, bent_edges_of_tetrahedron,
    bent_edges_of_triangle,
};
use crate::mesh::{PieceEdge, RefinedMesh, RefinedPiece, SimplexMesh, Vector};
use crate::simplices::LeftOut;
use crate::vtk::{
    AttributeKind, Attributes, DataArray, ImageGrid, PolyData, UnstructuredGrid, Values,
};

/// Which interpolant is sampled.
#[derive(Clone, Debug, Default)]
pub struct SampleOptions {
    /// The solution, and which of the interpolants that can be contoured.
    pub solution: ContourOptions,
    /// Instead of that one a member of the family. It needs the PDE, and neighbours do not
    /// agree: at a point that they share it is that of one of them.
    pub family: Option<FamilyMember>,
}

/// Data at points.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// The interpolant by the array's name, its gradient as `Gradients`, the grid's other
    /// point data, interpolated linearly, and `vtkValidPointMask`: 0 where a point is
    /// outside, and everything not a number (integers: 0), else 1.
    pub data: Attributes,
    /// The array's name.
    pub label: String,
    /// How many points are outside.
    pub outside: usize,
    /// In how many triangles and tetrahedra the PDE could not be used.
    pub singular: usize,
    /// Cells that could not be split into simplices.
    pub left_out: LeftOut,
    /// What people should know, a line each.
    pub warnings: Vec<String>,
}

/// How a grid is refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subdivision {
    /// Each edge in so many parts.
    Parts(u32),
    /// Where the interpolant is further than this from linear, in the unit of the values.
    Tolerance(f64),
}

/// A refined grid.
#[derive(Clone, Debug)]
pub struct SubdividedGrid {
    /// Triangles and tetrahedra with data; those of the cells travel along.
    pub grid: UnstructuredGrid,
    /// Whether the tolerance is kept: not, if that would take too many cells.
    pub is_fine: bool,
    /// What was done besides, `data` aside: these are in the grid.
    pub sampled: Sampled,
}

/// The cells that a refined grid has at most.
const MOST_CELLS: usize = 50_000_000;

/// A value, a gradient, and the points around.
type Sample = (f64, Vector, Stencil);

/// A point outside: nothing is a number.
const OUTSIDE: Sample = (
    f64::NAN,
    Vector::new(f64::NAN, f64::NAN, f64::NAN),
    Stencil { points: [0; 4], weights: [f64::NAN; 4] },
);

/// The interpolant of a grid at points: in a solid, else on a two-dimensional cell.
///
/// # Errors
/// If the grid has no such interpolant, see [`FilterError`].
pub fn sample(
    grid: &UnstructuredGrid,
    options: &SampleOptions,
    points: &[Vector],
) -> Result<Sampled, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), &options.solution)?;
    Source::with(&grid, options, |source| Ok(source.sampled(points)))
}

/// The interpolant of a grid on regular points of the box around its cells.
///
/// # Errors
/// If the grid has no such interpolant, see [`FilterError`].
pub fn sample_image(
    grid: &UnstructuredGrid,
    options: &SampleOptions,
    counts: [usize; 3],
) -> Result<(ImageGrid, Sampled), FilterError> {
    let grid = prepared(Cow::Borrowed(grid), &options.solution)?;
    Source::with(&grid, options, |source| {
        let [low, high] = source.bounds();
        let spacing = [0, 1, 2].map(|axis| match counts[axis] {
            0 | 1 => 1.0,
            count => (high[axis] - low[axis]) / (count - 1) as f64,
        });
        // a single layer is in the middle
        let origin = [0, 1, 2].map(|axis| match counts[axis] {
            0 | 1 => 0.5 * (low[axis] + high[axis]),
            _ => low[axis],
        });
        let counts = counts.map(|count| count.max(1));
        let field_data = source.grid.field_data.clone();
        let mut image =
            ImageGrid { origin, spacing, counts, point_data: Attributes::new(), field_data };
        let points: Vec<Vector> = image.points().map(Vector::from).collect();
        let sampled = source.sampled(&points);
        image.point_data = sampled.data.clone();
        Ok((image, sampled))
    })
}

/// A grid refined, with the interpolant at its points.
///
/// # Errors
/// If the grid has no such interpolant, see [`FilterError`], or would have too many cells, or
/// there is a tolerance for an interpolant that is not continuous.
pub fn subdivide(
    grid: &UnstructuredGrid,
    options: &SampleOptions,
    subdivision: Subdivision,
) -> Result<SubdividedGrid, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), &options.solution)?;
    Source::with(&grid, options, |source| source.subdivided(subdivision))
}

/// An interpolant, and what it was made of.
struct Source<'a> {
    grid: &'a UnstructuredGrid,
    interpolant: &'a Interpolant<'a>,
    triangles: Option<OnCells<'a, dyn TriangleCubics + 'a, 3>>,
    tetrahedra: Option<OnCells<'a, dyn TetrahedronCubics + 'a, 4>>,
    family: Option<FamilyMember>,
    singular: usize,
}

/// The interpolant on the cells of one dimension.
struct OnCells<'a, Cubics: ?Sized, const CORNERS: usize> {
    domain: &'a Domain<'a, CORNERS>,
    cubics: &'a Cubics,
    /// What is sampled instead of the cubics.
    member: Option<MemberPieces<'a, CORNERS>>,
}

impl<'a, Cubics: Pieces<CORNERS> + ?Sized, const CORNERS: usize> OnCells<'a, Cubics, CORNERS> {
    /// With the pieces that `make` makes of the chosen member of the family, if one is chosen.
    fn new(
        domain: &'a Domain<'a, CORNERS>,
        cubics: &'a Cubics,
        chosen: Option<&(FamilyMember, Equation)>,
        make: impl FnOnce(FamilyMember, &Equation) -> Result<MemberPieces<'a, CORNERS>, FilterError>,
    ) -> Result<Self, FilterError> {
        let member = chosen.map(|(member, equation)| make(*member, equation)).transpose()?;
        Ok(Self { domain, cubics, member })
    }

    fn sample(&self, cell: usize, at: [f64; CORNERS]) -> Sample {
        let taylor = match &self.member {
            Some(member) => member.pieces.taylor(cell, &at),
            None => self.cubics.taylor(cell, &at),
        };
        let corners = self.domain.mesh.simplices()[cell];
        let mut stencil = Stencil { points: [corners[0]; 4], weights: [0.0; 4] };
        stencil.points[..CORNERS].copy_from_slice(&corners);
        stencil.weights[..CORNERS].copy_from_slice(&at);
        (taylor.value, taylor.gradient, stencil)
    }

    fn singular(&self) -> usize {
        self.member.as_ref().map_or(0, |member| member.singular)
    }
}

impl Source<'_> {
    /// What `job` makes of the interpolant of a grid.
    fn with<T>(
        grid: &UnstructuredGrid,
        options: &SampleOptions,
        job: impl FnOnce(&Source) -> Result<T, FilterError>,
    ) -> Result<T, FilterError> {
        let SampleOptions { solution: options, family } = options;
        let interpolant = Interpolant::new(Solution::of_grid(grid, options)?, options)?;
        let solution = &interpolant.solution;
        let equation = solution.pde.as_ref().map(|known| known.equation(options.predictor));
        let chosen = family.map(|family| -> Result<_, FilterError> {
            let what = format!("the interpolant '{}'", family.name());
            Ok((family, equation.ok_or(FilterError::NeedsPde { what })?))
        });
        let chosen = chosen.transpose()?;
        let rectangles = match (&solution.triangles, family) {
            (Some(domain), Some(FamilyMember::Dei)) => Rectangles::new(grid, domain)?,
            _ => None,
        };
        let cubics = interpolant.in_triangles();
        let triangles = cubics.as_ref().zip(solution.triangles.as_ref());
        let triangles = triangles.map(|((cubics, _), domain)| {
            let field = solution.field(domain);
            OnCells::new(domain, cubics.as_ref(), chosen.as_ref(), |member, equation| {
                match &rectangles {
                    Some(rectangles) => rectangles.dei(&domain.mesh, field, equation),
                    None => domain.mesh.member(member, field, equation),
                }
            })
        });
        let cubics = interpolant.in_tetrahedra();
        let tetrahedra = cubics.as_ref().zip(solution.tetrahedra.as_ref());
        let tetrahedra = tetrahedra.map(|((cubics, _), domain)| {
            let field = solution.field(domain);
            OnCells::new(domain, cubics.as_ref(), chosen.as_ref(), |member, equation| {
                domain.mesh.member(member, field, equation)
            })
        });
        let (triangles, tetrahedra) = (triangles.transpose()?, tetrahedra.transpose()?);
        let singular = match family {
            None => interpolant.interpolation.singular(),
            Some(_) => {
                triangles.as_ref().map_or(0, OnCells::singular)
                    + tetrahedra.as_ref().map_or(0, OnCells::singular)
            }
        };
        let (interpolant, family) = (&interpolant, *family);
        job(&Source { grid, interpolant, triangles, tetrahedra, family, singular })
    }

    /// The box around all cells.
    fn bounds(&self) -> [Vector; 2] {
        let solution = &self.interpolant.solution;
        let flat = solution.triangles.iter().flat_map(|domain| corners(&domain.mesh));
        let solid = solution.tetrahedra.iter().flat_map(|domain| corners(&domain.mesh));
        let finite = flat.chain(solid).filter(|point| point.iter().all(|x| x.is_finite()));
        let ends = finite.fold(None, |ends: Option<[Vector; 2]>, point| {
            Some(ends.map_or([point; 2], |[low, high]| [low.inf(&point), high.sup(&point)]))
        });
        ends.unwrap_or([Vector::zeros(); 2])
    }

    fn sampled(&self, points: &[Vector]) -> Sampled {
        let solution = &self.interpolant.solution;
        let locators = Locators::new(solution);
        let samples = points
            .par_iter()
            .map(|point| locators.place(solution, point).map_or(OUTSIDE, |place| self.at(&place)));
        let samples: Vec<Sample> = samples.collect();
        self.with_data(&samples, true)
    }

    fn at(&self, place: &Place) -> Sample {
        match (place, &self.triangles, &self.tetrahedra) {
            (Place::Triangle(cell, at), Some(pieces), _) => pieces.sample(*cell, *at),
            (Place::Tetrahedron(cell, at), _, Some(pieces)) => pieces.sample(*cell, *at),
            _ => OUTSIDE,
        }
    }

    /// The samples as arrays, and the grid's point data beside them.
    fn with_data(&self, samples: &[Sample], with_mask: bool) -> Sampled {
        let stencils: Vec<Stencil> = samples.iter().map(|sample| sample.2).collect();
        let mut data = interpolate(&self.grid.point_data, &stencils);
        let solution = &self.interpolant.solution;
        let label = solution.label.clone();
        let values: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
        let gradients: Vec<f64> =
            samples.iter().flat_map(|sample| <[f64; 3]>::from(sample.1)).collect();
        data.push(DataArray::new(&label, 1, values));
        data.set_active(AttributeKind::Scalars, &label);
        data.push(DataArray::new("Gradients", 3, gradients));
        let is_inside = |stencil: &Stencil| !stencil.weights[0].is_nan();
        if with_mask {
            let mask = stencils.iter().map(|stencil| i8::from(is_inside(stencil)));
            data.push(DataArray::new("vtkValidPointMask", 1, Values::I8(mask.collect())));
        }
        Sampled {
            data,
            label,
            outside: stencils.iter().filter(|stencil| !is_inside(stencil)).count(),
            singular: self.singular,
            left_out: solution.left_out.clone(),
            warnings: self.interpolant.interpolation.warnings.clone(),
        }
    }

    fn subdivided(&self, subdivision: Subdivision) -> Result<SubdividedGrid, FilterError> {
        if let (Subdivision::Tolerance(_), Some(family)) = (subdivision, self.family) {
            return Err(FilterError::NotContinuous { name: family.name() });
        }
        let mut made = Made::default();
        if let Some(pieces) = &self.triangles {
            let marked = |piece: &RefinedPiece<3>, points: &[Vector], tolerance: f64| {
                let cubic = pieces.cubics.cubic(piece.parent as usize);
                bent_edges_of_triangle(&cubic, piece, points, tolerance)
            };
            let sample = |simplex, at| pieces.sample(simplex, at);
            made.add(pieces.domain, subdivision, TRIANGLE, marked, sample)?;
        }
        if let Some(pieces) = &self.tetrahedra {
            let marked = |piece: &RefinedPiece<4>, points: &[Vector], tolerance: f64| {
                let cubic = pieces.cubics.cubic(piece.parent as usize);
                bent_edges_of_tetrahedron(&cubic, piece, points, tolerance)
            };
            let sample = |simplex, at| pieces.sample(simplex, at);
            made.add(pieces.domain, subdivision, TETRAHEDRON, marked, sample)?;
        }
        let from = self.grid;
        let sampled = self.with_data(&made.samples, false);
        let coordinates: Vec<f64> =
            made.points.iter().flat_map(|point| <[f64; 3]>::from(*point)).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
        for (kind, corners) in &made.cells {
            grid.push_cell(*kind, corners);
        }
        grid.point_data = sampled.data.clone();
        grid.cell_data = pick(&from.cell_data, &made.parents);
        let parents: Vec<i64> = made.parents.iter().map(|&parent| i64::from(parent)).collect();
        grid.cell_data.push(DataArray::new(ORIGINAL_CELLS, 1, parents));
        grid.field_data = from.field_data.clone();
        Ok(SubdividedGrid { grid, is_fine: !made.is_coarse, sampled })
    }
}

/// The corners of all cells, as often as cells have them.
fn corners<'a, const CORNERS: usize>(
    mesh: &'a SimplexMesh<CORNERS>,
) -> impl Iterator<Item = Vector> + 'a {
    mesh.simplices().iter().flatten().map(|&point| mesh.points()[point as usize])
}

/// VTK's cell types.
const TRIANGLE: u8 = 5;
const TETRAHEDRON: u8 = 10;

/// A refined grid in the making.
#[derive(Default)]
struct Made {
    points: Vec<Vector>,
    samples: Vec<Sample>,
    cells: Vec<(u8, Vec<i64>)>,
    parents: Vec<u32>,
    is_coarse: bool,
}

impl Made {
    /// Adds the refined cells of one dimension.
    fn add<const CORNERS: usize>(
        &mut self,
        domain: &Domain<CORNERS>,
        subdivision: Subdivision,
        kind: u8,
        marked: impl Fn(&RefinedPiece<CORNERS>, &[Vector], f64) -> Vec<PieceEdge> + Sync,
        at: impl Fn(usize, [f64; CORNERS]) -> Sample + Sync,
    ) -> Result<(), FilterError> {
        let mesh = &domain.mesh;
        let parts = match subdivision {
            Subdivision::Parts(parts) => parts,
            Subdivision::Tolerance(_) => 1,
        };
        let each = (parts as usize).saturating_pow(CORNERS as u32 - 1);
        let cells = each.saturating_mul(mesh.simplices().len());
        if cells > MOST_CELLS {
            return Err(FilterError::TooManyCells { cells, most: MOST_CELLS });
        }
        let mut refined = RefinedMesh::uniform(mesh, parts);
        if let Subdivision::Tolerance(tolerance) = subdivision {
            let marked =
                |piece: &RefinedPiece<CORNERS>, points: &[Vector]| marked(piece, points, tolerance);
            self.is_coarse |= !refined.divide(mesh, MOST_CELLS, marked);
        }
        let first = self.points.len() as i64;
        for piece in &refined.pieces {
            let corners = piece.corners.iter().map(|&corner| first + i64::from(corner));
            self.cells.push((kind, corners.collect()));
            self.parents.push(domain.parent(piece.parent));
        }
        let samples = refined.places.par_iter().map(|place| at(place.simplex as usize, place.at));
        self.samples.extend(samples.collect::<Vec<Sample>>());
        self.points.extend(refined.points);
        Ok(())
    }
}

impl Sampled {
    /// Points with their data, each a vertex.
    pub fn poly_data(self, points: &[Vector]) -> PolyData {
        let coordinates: Vec<f64> = points.iter().flat_map(|p| <[f64; 3]>::from(*p)).collect();
        let mut data = PolyData::new(DataArray::new("Points", 3, coordinates));
        for point in 0..points.len() as i64 {
            data.verts.push(&[point]);
        }
        data.point_data = self.data;
        data
    }
}
