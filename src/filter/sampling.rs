//! The interpolant at other points: given ones, those of a finer mesh, a regular grid.

use std::borrow::Cow;

use rayon::prelude::*;

use super::contour_filter::prepared;
use super::error::FilterError;
use super::interpolant::Interpolant;
use super::options::ContourOptions;
use super::output::ORIGINAL_CELLS;
use super::resample::{Stencil, interpolate, pick};
use super::solution::{Domain, Solution};
use crate::interpolant::{
    Pieces, TetrahedronCubics, TriangleCubics, bent_edges_of_tetrahedron, bent_edges_of_triangle,
};
use crate::mesh::{PieceEdge, PointLocator, RefinedMesh, RefinedPiece, Vector};
use crate::simplices::LeftOut;
use crate::vtk::{
    AttributeKind, Attributes, DataArray, ImageGrid, PolyData, UnstructuredGrid, Values,
};

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

/// Where a point is.
enum Place {
    Triangle(usize, [f64; 3]),
    Tetrahedron(usize, [f64; 4]),
}

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
/// If the grid has no interpolant, see [`FilterError`].
pub fn sample(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
    points: &[Vector],
) -> Result<Sampled, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), options)?;
    Source::with(&grid, options, |source| Ok(source.sampled(points)))
}

/// The interpolant of a grid on regular points of the box around its cells.
///
/// # Errors
/// If the grid has no interpolant, see [`FilterError`].
pub fn sample_image(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
    counts: [usize; 3],
) -> Result<(ImageGrid, Sampled), FilterError> {
    let grid = prepared(Cow::Borrowed(grid), options)?;
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
/// If the grid has no interpolant, see [`FilterError`], or would have too many cells.
pub fn subdivide(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
    subdivision: Subdivision,
) -> Result<SubdividedGrid, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), options)?;
    Source::with(&grid, options, |source| source.subdivided(subdivision))
}

/// An interpolant, and what it was made of.
struct Source<'a> {
    grid: &'a UnstructuredGrid,
    interpolant: &'a Interpolant<'a>,
    triangles: Option<(&'a dyn TriangleCubics, &'a Domain<'a, 3>)>,
    tetrahedra: Option<(&'a dyn TetrahedronCubics, &'a Domain<'a, 4>)>,
}

impl Source<'_> {
    /// What `job` makes of the interpolant of a grid.
    fn with<T>(
        grid: &UnstructuredGrid,
        options: &ContourOptions,
        job: impl FnOnce(&Source) -> Result<T, FilterError>,
    ) -> Result<T, FilterError> {
        let interpolant = Interpolant::new(Solution::of_grid(grid, options)?, options)?;
        let (flat, solid) = (interpolant.in_triangles(), interpolant.in_tetrahedra());
        let triangles = flat.as_ref().map(|(cubics, _)| cubics.as_ref());
        let tetrahedra = solid.as_ref().map(|(cubics, _)| cubics.as_ref());
        job(&Source {
            grid,
            interpolant: &interpolant,
            triangles: triangles.zip(interpolant.solution.triangles.as_ref()),
            tetrahedra: tetrahedra.zip(interpolant.solution.tetrahedra.as_ref()),
        })
    }

    /// The box around all cells.
    fn bounds(&self) -> [Vector; 2] {
        let flat = self.interpolant.solution.triangles.iter().flat_map(|domain| {
            let corners = domain.mesh.simplices().iter().flatten();
            corners.map(|&point| domain.mesh.points()[point as usize])
        });
        let solid = self.interpolant.solution.tetrahedra.iter().flat_map(|domain| {
            let corners = domain.mesh.simplices().iter().flatten();
            corners.map(|&point| domain.mesh.points()[point as usize])
        });
        let finite = flat.chain(solid).filter(|point| point.iter().all(|x| x.is_finite()));
        let ends = finite.fold(None, |ends: Option<[Vector; 2]>, point| {
            Some(ends.map_or([point; 2], |[low, high]| [low.inf(&point), high.sup(&point)]))
        });
        ends.unwrap_or([Vector::zeros(); 2])
    }

    fn sampled(&self, points: &[Vector]) -> Sampled {
        let in_solids = self.tetrahedra.map(|(_, domain)| PointLocator::new(&domain.mesh));
        let on_surfaces = self.triangles.map(|(_, domain)| PointLocator::new(&domain.mesh));
        let solid = |point: &Vector| -> Option<Place> {
            let ((_, domain), locator) = (self.tetrahedra?, in_solids.as_ref()?);
            let found = locator.locate(&domain.mesh, point, locator.forgiving_distance())?;
            Some(Place::Tetrahedron(found.simplex, found.at))
        };
        let flat = |point: &Vector| -> Option<Place> {
            let ((_, domain), locator) = (self.triangles?, on_surfaces.as_ref()?);
            let found = locator.locate(&domain.mesh, point, locator.forgiving_distance())?;
            Some(Place::Triangle(found.simplex, found.at))
        };
        let samples = points.par_iter().map(|point| {
            let place = solid(point).or_else(|| flat(point));
            place.map_or(OUTSIDE, |place| self.at(&place))
        });
        let samples: Vec<Sample> = samples.collect();
        self.with_data(&samples, true)
    }

    fn at(&self, place: &Place) -> Sample {
        match (place, self.triangles, self.tetrahedra) {
            (Place::Triangle(cell, at), Some((cubics, domain)), _) => {
                let taylor = cubics.taylor(*cell, at);
                let [a, b, c] = domain.mesh.simplices()[*cell];
                let [i, j, k] = *at;
                (
                    taylor.value,
                    taylor.gradient,
                    Stencil { points: [a, b, c, c], weights: [i, j, k, 0.0] },
                )
            }
            (Place::Tetrahedron(cell, at), _, Some((cubics, domain))) => {
                let taylor = cubics.taylor(*cell, at);
                let stencil = Stencil { points: domain.mesh.simplices()[*cell], weights: *at };
                (taylor.value, taylor.gradient, stencil)
            }
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
            singular: self.interpolant.interpolation.singular(),
            left_out: solution.left_out.clone(),
            warnings: self.interpolant.interpolation.warnings.clone(),
        }
    }

    fn subdivided(&self, subdivision: Subdivision) -> Result<SubdividedGrid, FilterError> {
        let mut made = Made::default();
        if let Some((cubics, domain)) = self.triangles {
            let marked = |piece: &RefinedPiece<3>, points: &[Vector], tolerance: f64| {
                bent_edges_of_triangle(
                    &cubics.cubic(piece.parent as usize),
                    piece,
                    points,
                    tolerance,
                )
            };
            let place = |simplex, at| self.at(&Place::Triangle(simplex, at));
            made.add(domain, subdivision, TRIANGLE, marked, place)?;
        }
        if let Some((cubics, domain)) = self.tetrahedra {
            let marked = |piece: &RefinedPiece<4>, points: &[Vector], tolerance: f64| {
                let cubic = cubics.cubic(piece.parent as usize);
                bent_edges_of_tetrahedron(&cubic, piece, points, tolerance)
            };
            let place = |simplex, at| self.at(&Place::Tetrahedron(simplex, at));
            made.add(domain, subdivision, TETRAHEDRON, marked, place)?;
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
