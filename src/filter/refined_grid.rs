//! A grid refined, with all its data.

use std::borrow::Cow;

use rayon::prelude::*;

use super::cell_monitor::{CellMonitor, Monitor};
use super::cells::{Cells, Part};
use super::contour_filter::prepared;
use super::error::FilterError;
use super::gradients::GradientOrigin;
use super::interpolant::Interpolant;
use super::options::ContourOptions;
use super::output::ORIGINAL_CELLS;
use super::resample::{Stencil, interpolate, overwrite, pick};
use super::solution::{Domain, Solution};
use crate::interpolant::Pieces;
use crate::mesh::{PointLocator, SimplexMesh, Vector};
use crate::monitor::{SamplePoints, Selection};
use crate::refine::delaunay::{DelaunayError, DelaunayOptions, delaunay};
use crate::refine::{
    Marks, MovedPoint, NewPoint, RefineError, Refinement, Smoothing, TriangleMethod,
    refine_tetrahedra, smooth,
};
use crate::simplices::{CellCounts, LeftOut};
use crate::vtk::{Attributes, DataArray, UnstructuredGrid, Values};

/// The name of the array that says on which edge a point was put: the numbers of its ends,
/// which are points of the same grid; -1 for points that were there, and those put inside
/// cells. Points keep their numbers from step to step.
pub const PARENT_EDGE: &str = "ParentEdge";

/// How cells are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefineMethod {
    /// Triangles by one of the methods that keep to their cells. Tetrahedra are bisected
    /// whichever it is.
    Divide(TriangleMethod),
    /// The thesis' hybrid: points in a Delaunay triangulation of the plane.
    Delaunay,
}

impl Default for RefineMethod {
    fn default() -> Self {
        Self::Divide(TriangleMethod::default())
    }
}

/// Which cells are to be refined.
#[derive(Clone, Debug)]
pub enum MarkedBy {
    /// Those with another number than zero in this cell array, in their order.
    Marks(String),
    /// By the numbers of this cell array, one a cell.
    Array(String, Selection),
    /// By a monitor of the solution, one number a simplex. With a bound on the points
    /// something is selected as long as there is any error ([`Selection::select_some`]).
    Monitor(Monitor, SamplePoints, Selection),
}

/// How a grid is refined.
#[derive(Clone, Debug)]
pub struct RefineOptions {
    /// How cells are divided.
    pub method: RefineMethod,
    /// Which cells.
    pub marked: MarkedBy,
    /// How the points of triangles are moved after they were divided, and in how many sweeps
    /// at most; those of tetrahedra stay.
    pub smoothing: Option<(Smoothing, usize)>,
    /// The most points that the refined grid may have.
    pub max_points: Option<usize>,
    /// A cell array: edges between cells of different numbers are kept by the Delaunay hybrid
    /// and by smoothing. Division by itself keeps all sides of cells.
    pub regions: Option<String>,
    /// Curved boundaries, as polylines: see [`DelaunayOptions::curves`]. For
    /// [`RefineMethod::Delaunay`].
    pub boundaries: Vec<Vec<Vector>>,
    /// What is known of the solution.
    pub solution: ContourOptions,
}

/// A refined grid.
#[derive(Clone, Debug)]
pub struct RefinedGrid {
    /// Triangles or tetrahedra, with the data of the grid that was refined.
    pub grid: UnstructuredGrid,
    /// How many simplices were marked.
    pub marked: usize,
    /// How many points were added.
    pub added: usize,
    /// What the cubics at the new points are of; nothing if the grid has no point arrays.
    pub label: Option<String>,
    /// Cells of lower dimensions, which are not in the refined grid.
    pub dropped: CellCounts,
    /// Cells that could not be split into simplices.
    pub left_out: LeftOut,
    /// What people should know, a line each.
    pub warnings: Vec<String>,
}

impl RefinedGrid {
    /// What people should know, a line each: warnings, and what is not in the refined grid.
    pub fn messages(&self) -> Vec<String> {
        let Self { dropped, left_out, warnings, .. } = self;
        let mut texts = warnings.clone();
        if left_out.total() > 0 {
            texts.push(format!("left out: {left_out}"));
        }
        if dropped.total() > left_out.total() {
            texts.push(format!("not in the refined mesh, for their dimension is less: {dropped}"));
        }
        texts
    }
}

/// A grid without what an earlier refinement said of its own steps, so that numbers of cells and
/// points will be those of this grid.
pub fn without_origins(mut grid: UnstructuredGrid) -> UnstructuredGrid {
    grid.cell_data = grid.cell_data.without(&[ORIGINAL_CELLS]);
    grid.point_data = grid.point_data.without(&[PARENT_EDGE]);
    grid
}

/// Refines the solids of a grid, or if it has none its two-dimensional cells.
///
/// Of new points the solution's value is that of its cubic, and so is its gradient if that is
/// an array (the mean over the cells around the point); other point arrays are interpolated
/// linearly. Cells have the data of those that they are part of, and `OriginalCellIds`; points
/// have [`PARENT_EDGE`]. Both, where the grid has them already, go on: after several steps they
/// refer to the first grid and to the last.
///
/// # Errors
/// If an array is not there or does not fit, or the cells cannot be refined by the method.
pub fn refine(
    grid: &UnstructuredGrid,
    options: &RefineOptions,
) -> Result<RefinedGrid, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), &options.solution)?;
    let interpolant = known_solution(&grid, &options.solution)?;
    let Cells { triangles, tetrahedra, left_out, .. } = Cells::new(&grid)?;
    let is_delaunay = tetrahedra.is_none() && options.method == RefineMethod::Delaunay;
    if !options.boundaries.is_empty() && !is_delaunay {
        return Err(FilterError::UnusedBoundary);
    }
    let job = Job { grid: &grid, options, left_out };
    match (tetrahedra, triangles) {
        (Some(part), _) => {
            let refine = |_: &[u32], marks: &Marks| Ok(refine_tetrahedra(&part.mesh, marks)?);
            let state = Some(BISECTION_STATE);
            let known = interpolant.as_ref();
            let cubics = known.and_then(Interpolant::in_tetrahedra).map(|(cubics, _)| cubics);
            let domain = known.and_then(|known| known.solution.tetrahedra.as_ref());
            let marked = job.marked(&part, known.zip(domain), |monitor, of, domain| {
                monitor.of_tetrahedra(of, domain)
            })?;
            let cubics = cubics.as_deref().zip(domain);
            job.run(&part, &marked, state, refine, known, cubics)
        }
        (None, Some(part)) => {
            let refine = |regions: &[u32], marks: &Marks| {
                let mut refined = match options.method {
                    RefineMethod::Divide(method) => method.refine(&part.mesh, marks)?,
                    RefineMethod::Delaunay => {
                        let curves = &options.boundaries;
                        let kept = DelaunayOptions { regions, curves, ..Default::default() };
                        delaunay(&part.mesh, marks, &kept)?
                    }
                };
                if let Some((smoothing, sweeps)) = options.smoothing {
                    smooth(&part.mesh, &mut refined, regions, smoothing, sweeps);
                }
                Ok(refined)
            };
            let state = match options.method {
                RefineMethod::Divide(TriangleMethod::NewestVertex) => Some(NEWEST_VERTEX_STATE),
                RefineMethod::Divide(TriangleMethod::RedGreen) => Some(RED_GREEN_STATE),
                _ => None,
            };
            let known = interpolant.as_ref();
            let cubics = known.and_then(Interpolant::in_triangles).map(|(cubics, _)| cubics);
            let domain = known.and_then(|known| known.solution.triangles.as_ref());
            let marked = job.marked(&part, known.zip(domain), |monitor, of, domain| {
                monitor.of_triangles(of, domain)
            })?;
            let cubics = cubics.as_deref().zip(domain);
            job.run(&part, &marked, state, refine, known, cubics)
        }
        (None, None) => {
            let cells = grid.types.iter().copied().collect();
            Err(FilterError::NoCells { cells, left_out: job.left_out })
        }
    }
}

/// VTK's cell types.
const TRIANGLE: u8 = 5;
const TETRAHEDRON: u8 = 10;

/// The interpolant of a grid; nothing if that has no values.
fn known_solution(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
) -> Result<Option<Interpolant<'static>>, FilterError> {
    if grid.point_data.is_empty() && options.array.is_none() {
        return Ok(None);
    }
    Ok(Some(Interpolant::new(Solution::of_grid(grid, options)?, options)?))
}

/// What is refined, and how.
struct Job<'a> {
    grid: &'a UnstructuredGrid,
    options: &'a RefineOptions,
    left_out: LeftOut,
}

impl Job<'_> {
    fn run<const CORNERS: usize, C: Pieces<CORNERS> + ?Sized>(
        &self,
        part: &Part<CORNERS>,
        marked: &[u32],
        state: Option<&'static str>,
        refine: impl Fn(&[u32], &Marks) -> Result<Refinement<CORNERS>, FilterError>,
        known: Option<&Interpolant>,
        cubics: Option<(&C, &Domain<CORNERS>)>,
    ) -> Result<RefinedGrid, FilterError> {
        let regions = self.regions(part)?;
        let before = state.map(|name| self.state(part, name)).unwrap_or_default();
        let max_points = self.options.max_points.unwrap_or(usize::MAX);
        let marks = Marks { cells: marked, max_points, state: &before };
        let mut warnings =
            known.map_or_else(Vec::new, |known| known.interpolation.warnings.clone());
        let refined = match refine(&regions, &marks) {
            Err(FilterError::Refine(RefineError::State)) => {
                let name = state.unwrap_or_default();
                warnings.push(format!(
                    "array '{name}' is not that of this mesh: refinement begins anew"
                ));
                refine(&regions, &Marks { state: &[], ..marks })
            }
            other => other,
        };
        let refined = refined.map_err(|error| of_grid(error, &part.parents))?;
        let mut grid = self.carried(part, &refined);
        if let (Some(name), false) = (state, refined.state.is_empty()) {
            grid.cell_data.push(DataArray::new(name, 1, refined.state.clone()));
        }
        if let (Some(known), Some((cubics, domain))) = (known, cubics) {
            let samples = samples(&part.mesh, &refined, cubics);
            let origin = &domain.gradients.origin;
            put_samples(&mut grid.point_data, &self.options.solution, known, origin, &samples);
        }
        let mut is_kept = vec![false; self.grid.types.len()];
        part.parents.iter().for_each(|&cell| is_kept[cell as usize] = true);
        let dropped = self.grid.types.iter().zip(is_kept).filter(|(_, is_kept)| !is_kept);
        Ok(RefinedGrid {
            grid,
            marked: marked.len(),
            added: refined.new_points.len(),
            label: known.map(|known| known.solution.label.clone()),
            dropped: dropped.map(|(&kind, _)| kind).collect(),
            left_out: self.left_out.clone(),
            warnings,
        })
    }

    /// The marked simplices, those first that need it most. `of` gives the numbers of a monitor.
    fn marked<const CORNERS: usize>(
        &self,
        part: &Part<CORNERS>,
        known: Option<(&Interpolant, &Domain<CORNERS>)>,
        of: impl Fn(&CellMonitor, &Interpolant, &Domain<CORNERS>) -> Result<Vec<f64>, FilterError>,
    ) -> Result<Vec<u32>, FilterError> {
        let of_array = |name: &str| {
            let numbers = cell_numbers(self.grid, name);
            numbers.map(|numbers| part.parents.iter().map(|&cell| numbers[cell as usize]).collect())
        };
        match &self.options.marked {
            MarkedBy::Marks(name) => {
                let numbers: Vec<f64> = of_array(name)?;
                let all = 0..numbers.len() as u32;
                Ok(all.filter(|&simplex| numbers[simplex as usize] != 0.0).collect())
            }
            MarkedBy::Array(name, selection) => Ok(selection.select(&of_array(name)?)?),
            MarkedBy::Monitor(monitor, samples, selection) => {
                let Some((interpolant, domain)) = known else {
                    let cell_arrays = !self.grid.cell_data.is_empty();
                    return Err(FilterError::NoPointArrays { cell_arrays });
                };
                let pde = interpolant.solution.pde.as_deref();
                let monitor = CellMonitor::new(*monitor, *samples, pde, &self.options.solution);
                let numbers = of(&monitor, interpolant, domain)?;
                match self.options.max_points {
                    // a number of points is asked for: there is always something to refine
                    Some(_) => Ok(selection.select_some(&numbers)?),
                    None => Ok(selection.select(&numbers)?),
                }
            }
        }
    }

    /// A number for each simplex, the same for all of one region.
    fn regions<const CORNERS: usize>(&self, part: &Part<CORNERS>) -> Result<Vec<u32>, FilterError> {
        let Some(name) = &self.options.regions else { return Ok(Vec::new()) };
        let numbers = cell_numbers(self.grid, name)?;
        let mut kinds = numbers.clone();
        kinds.sort_by(f64::total_cmp);
        kinds.dedup();
        let region =
            |&cell: &u32| kinds.partition_point(|kind| *kind < numbers[cell as usize]) as u32;
        Ok(part.parents.iter().map(region).collect())
    }

    /// What the step before left, if each cell is a simplex.
    fn state<const CORNERS: usize>(&self, part: &Part<CORNERS>, name: &str) -> Vec<u16> {
        let each = part.parents.windows(2).all(|pair| pair[0] != pair[1]);
        let numbers = self.grid.cell_data.get(name).and_then(DataArray::to_f64).filter(|_| each);
        let numbers = numbers.filter(|numbers| numbers.len() == self.grid.types.len());
        let of_part = |numbers: Vec<f64>| {
            part.parents.iter().map(|&cell| numbers[cell as usize] as u16).collect()
        };
        numbers.map(of_part).unwrap_or_default()
    }

    /// The refined grid, all its point arrays interpolated linearly.
    fn carried<const CORNERS: usize>(
        &self,
        part: &Part<CORNERS>,
        refined: &Refinement<CORNERS>,
    ) -> UnstructuredGrid {
        let kind = if CORNERS == 3 { TRIANGLE } else { TETRAHEDRON };
        let coordinates: Vec<f64> =
            refined.points.iter().flat_map(|point| <[f64; 3]>::from(*point)).collect();
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, coordinates));
        for corners in &refined.cells {
            grid.push_cell(kind, &corners.map(i64::from));
        }
        grid.field_data = self.grid.field_data.clone();
        let parents: Vec<u32> =
            refined.parents.iter().map(|&parent| part.parents[parent as usize]).collect();
        grid.cell_data = pick(&self.grid.cell_data.without(&STATES), &parents);
        if grid.cell_data.get(ORIGINAL_CELLS).is_none() {
            let parents: Vec<i64> = parents.iter().map(|&parent| i64::from(parent)).collect();
            grid.cell_data.push(DataArray::new(ORIGINAL_CELLS, 1, parents));
        }
        let old = (0..part.mesh.points().len() as u32)
            .map(|point| Stencil { points: [point; 4], weights: [1.0, 0.0, 0.0, 0.0] });
        let new = refined.new_points.iter().map(|place| stencil(&part.mesh, place));
        let mut stencils: Vec<Stencil> = old.chain(new).collect();
        for &MovedPoint { point, cell, at } in &refined.moved {
            stencils[point as usize] = stencil(&part.mesh, &NewPoint::Inside { cell, at });
        }
        grid.point_data = interpolate(&self.grid.point_data, &stencils);
        grid.point_data.push(self.parent_edges(refined));
        grid
    }

    fn parent_edges<const CORNERS: usize>(&self, refined: &Refinement<CORNERS>) -> DataArray {
        let old = refined.points.len() - refined.new_points.len();
        let before = self.grid.point_data.get(PARENT_EDGE).filter(|array| array.components == 2);
        let mut edges = match before.map(|array| &array.values) {
            Some(Values::I64(edges)) if edges.len() == 2 * old => edges.clone(),
            _ => vec![-1; 2 * old],
        };
        edges.extend(refined.new_points.iter().flat_map(|place| match place {
            NewPoint::Edge { ends, .. } => ends.map(i64::from),
            NewPoint::Inside { .. } => [-1; 2],
        }));
        DataArray::new(PARENT_EDGE, 2, edges)
    }
}

/// The arrays that keep the state of a method from step to step. Where another method divides
/// cells they go.
const BISECTION_STATE: &str = "BisectionState";
const NEWEST_VERTEX_STATE: &str = "NewestVertexState";
const RED_GREEN_STATE: &str = "RedGreenState";
const STATES: [&str; 3] = [BISECTION_STATE, NEWEST_VERTEX_STATE, RED_GREEN_STATE];

/// An error of simplices as one of the grid's cells.
fn of_grid(error: FilterError, parents: &[u32]) -> FilterError {
    match error {
        FilterError::Refine(RefineError::RepeatedCorner { cell, point }) => {
            RefineError::RepeatedCorner { cell: parents[cell as usize], point }.into()
        }
        FilterError::Delaunay(DelaunayError::NoArea { cell }) => {
            DelaunayError::NoArea { cell: parents[cell as usize] }.into()
        }
        FilterError::Delaunay(DelaunayError::Marks(error)) => {
            of_grid(FilterError::Refine(error), parents)
        }
        other => other,
    }
}

/// One number a cell.
fn cell_numbers(grid: &UnstructuredGrid, name: &str) -> Result<Vec<f64>, FilterError> {
    let available = || {
        let names: Vec<String> = grid.cell_data.iter().map(|a| format!("'{}'", a.name)).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    let array = grid.cell_data.get(name).ok_or_else(|| FilterError::NoSuchCellArray {
        name: name.to_owned(),
        available: available(),
    })?;
    let numbers = array.to_f64().filter(|_| array.components == 1);
    let numbers = numbers.filter(|numbers| numbers.len() == grid.types.len());
    numbers.ok_or_else(|| FilterError::NotOneACell { name: name.to_owned() })
}

/// A new point as a mean of points of the input.
fn stencil<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    place: &NewPoint<CORNERS>,
) -> Stencil {
    let mut stencil = Stencil { points: [0; 4], weights: [0.0; 4] };
    match place {
        NewPoint::Edge { ends: [a, b], at } => {
            stencil = Stencil { points: [*a, *b, *a, *a], weights: [1.0 - at, *at, 0.0, 0.0] };
        }
        NewPoint::Inside { cell, at } => {
            for (n, (&corner, &weight)) in
                mesh.simplices()[*cell as usize].iter().zip(at).enumerate()
            {
                (stencil.points[n], stencil.weights[n]) = (corner, weight);
            }
        }
    }
    stencil
}

/// Positions closer than this part of their size are the same.
const SAME: f64 = 1e-12;

/// A point, a value and a gradient; not finite where there are none.
type Sample = (u32, f64, Vector);

/// The cubics at points that are new or elsewhere: the mean over the cells of the input around
/// each.
fn samples<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    refined: &Refinement<CORNERS>,
    cubics: &(impl Pieces<CORNERS> + ?Sized),
) -> Vec<Sample> {
    let first = refined.points.len() - refined.new_points.len();
    let (parents, starts) = parents_around(refined, first);
    let nearest = std::sync::LazyLock::new(|| PointLocator::new(mesh));
    let sample = |(point, place): (usize, &NewPoint<CORNERS>)| -> Sample {
        let around = &parents[starts[point]..starts[point + 1]];
        let within = |cell: u32| Some((cell as usize, weights(mesh, cell, place)?));
        let each = around.chunk_by(|one, next| one == next);
        let mut places: Vec<_> = each.filter_map(|same| within(same[0])).collect();
        if let (NewPoint::Inside { cell, at }, true) = (place, places.is_empty()) {
            places.push((*cell as usize, *at));
        } else if places.is_empty() {
            let position = &refined.points[first + point];
            let found = nearest.locate(mesh, position, f64::INFINITY);
            places.extend(found.map(|found| (found.simplex, found.at)));
        }
        let mut sum = (0.0, Vector::zeros());
        for (cell, at) in &places {
            let position = &refined.points[first + point];
            let off = (mesh.position(*cell, at) - position).norm();
            let taylor = if off <= SAME * position.norm() {
                cubics.taylor(*cell, at)
            } else {
                // on a curved boundary the point is not where its edge has it
                cubics.taylor(*cell, &mesh.weights_at(*cell, position))
            };
            sum = (sum.0 + taylor.value, sum.1 + taylor.gradient);
        }
        let count = places.len() as f64;
        ((first + point) as u32, sum.0 / count, sum.1 / count)
    };
    let moved = refined.moved.par_iter().map(|&MovedPoint { point, cell, at }| -> Sample {
        let taylor = cubics.taylor(cell as usize, &at);
        (point, taylor.value, taylor.gradient)
    });
    moved.chain(refined.new_points.par_iter().enumerate().map(sample)).collect()
}

/// The parents of the cells around each new point, ascending, some more than once; and where those
/// of each point begin.
fn parents_around<const CORNERS: usize>(
    refined: &Refinement<CORNERS>,
    first: usize,
) -> (Vec<u32>, Vec<usize>) {
    let all = || {
        refined.cells.iter().zip(&refined.parents).flat_map(|(corners, &parent)| {
            let new = corners.iter().filter_map(|&corner| (corner as usize).checked_sub(first));
            new.map(move |point| (point, parent))
        })
    };
    let mut starts = vec![0; refined.new_points.len() + 2];
    all().for_each(|(point, _)| starts[point + 2] += 1);
    for point in 2..starts.len() {
        starts[point] += starts[point - 1];
    }
    let mut parents = vec![0; starts[starts.len() - 1]];
    for (point, parent) in all() {
        parents[starts[point + 1]] = parent;
        starts[point + 1] += 1;
    }
    for bounds in starts.windows(2) {
        parents[bounds[0]..bounds[1]].sort_unstable();
    }
    (parents, starts)
}

/// Where a place is in a cell, by the weights of its corners; nothing if these do not have it.
fn weights<const CORNERS: usize>(
    mesh: &SimplexMesh<CORNERS>,
    cell: u32,
    place: &NewPoint<CORNERS>,
) -> Option<[f64; CORNERS]> {
    let Stencil { points, weights } = stencil(mesh, place);
    let corners = &mesh.simplices()[cell as usize];
    let mut at = [0.0; CORNERS];
    for (point, weight) in points.iter().zip(weights).filter(|(_, weight)| *weight != 0.0) {
        at[corners.iter().position(|corner| corner == point)?] += weight;
    }
    Some(at)
}

/// Puts the cubics' values, and their gradients if these are an array, at the points. Where they
/// are not finite the linear ones stay.
fn put_samples(
    data: &mut Attributes,
    options: &ContourOptions,
    known: &Interpolant,
    origin: &GradientOrigin,
    samples: &[Sample],
) {
    let is_known =
        |sample: &&Sample| sample.1.is_finite() && sample.2.iter().all(|x| x.is_finite());
    let numbers = |number: &dyn Fn(&Sample) -> f64| -> Vec<(u32, f64)> {
        samples.iter().filter(is_known).map(|sample| (sample.0, number(sample))).collect()
    };
    // lengths of vectors have no place to be put
    let component = match options.component {
        None => Some(0),
        Some(super::Component::Number(component)) => Some(component),
        Some(super::Component::Magnitude) => None,
    };
    let label = &known.solution.label;
    let name = options.array.as_deref().unwrap_or(label);
    let mut put = |name: &str, component: usize, numbers: &[(u32, f64)]| {
        if let Some(array) = data.get(name).filter(|array| component < array.components) {
            let array = overwrite(array, component, numbers);
            data.push(array);
        }
    };
    let Some(component) = component else { return };
    put(name, component, &numbers(&|sample| sample.1));
    let GradientOrigin::Array(gradient) = origin else { return };
    let parts: Vec<&str> = gradient.split(',').map(str::trim).collect();
    for axis in 0..3 {
        let along = numbers(&|sample| sample.2[axis]);
        match parts[..] {
            [_] => put(gradient, 3 * component + axis, &along),
            _ => parts.get(axis).into_iter().for_each(|part| put(part, 0, &along)),
        }
    }
}
