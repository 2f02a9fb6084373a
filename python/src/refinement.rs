//! Refined meshes: of grids with all their data, and of NumPy arrays.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vtu2contour::filter::{
    FilterError, MarkedBy, RefineMethod, RefineOptions, RefinedGrid, boundary_curves, refine,
    without_origins,
};
use vtu2contour::mesh::{SimplexMesh, Vector};
use vtu2contour::refine::delaunay::{DelaunayOptions, delaunay};
use vtu2contour::refine::{
    Marks, NewPoint, Refinement, Smoothing, TriangleMethod, refine_tetrahedra, smooth,
};

use super::arrays::{rows, slice, vectors};
use super::error::in_python;
use super::grid::GridParts;
use super::job;
use super::options::{SolutionOptions, chosen, selection};
use super::output;

/// How is refined: a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RefinementOptions<'py> {
    method: String,
    smooth: Option<String>,
    max_points: Option<usize>,
    /// Polylines, each of shape (n, 3).
    boundaries: Vec<PyReadonlyArray2<'py, f64>>,
}

/// The same as the library takes it.
struct Method {
    method: RefineMethod,
    smoothing: Option<(Smoothing, usize)>,
    max_points: Option<usize>,
    boundaries: Vec<Vec<Vector>>,
}

/// Sweeps of smoothing, at most: more move points by little.
const SWEEPS: usize = 10;

impl RefinementOptions<'_> {
    fn method(&self) -> PyResult<Method> {
        let methods = [
            ("bisect", RefineMethod::Divide(TriangleMethod::LongestEdge)),
            ("newest-vertex", RefineMethod::Divide(TriangleMethod::NewestVertex)),
            ("red-green", RefineMethod::Divide(TriangleMethod::RedGreen)),
            ("centroid", RefineMethod::Divide(TriangleMethod::Centroid)),
            ("delaunay", RefineMethod::Delaunay),
        ];
        let smoothings = [("laplacian", Smoothing::Laplacian), ("optimised", Smoothing::Optimised)];
        let smoothing = self.smooth.as_deref().map(|name| chosen("smooth", name, &smoothings));
        let boundaries = self.boundaries.iter().map(|points| vectors(points, "boundary"));
        Ok(Method {
            method: chosen("method", &self.method, &methods)?,
            smoothing: smoothing.transpose()?.map(|smoothing| (smoothing, SWEEPS)),
            max_points: self.max_points,
            boundaries: boundaries
                .map(|points| points.map(<[_]>::to_vec))
                .collect::<PyResult<_>>()?,
        })
    }
}

/// Which cells a cell array asks for: its name, and how they are selected by its numbers, with
/// which number; nothing for those with another number than zero.
type Asked = (String, Option<(String, f64)>);

/// A grid that was taken apart (see `vtu2contour/_vtk.py`) refined, and what was done.
/// `is_first`: whether arrays that an earlier refinement left are to go.
#[pyfunction]
pub fn refine_grid<'py>(
    py: Python<'py>,
    grid: GridParts,
    asked: Asked,
    regions: Option<String>,
    solution: SolutionOptions,
    options: RefinementOptions,
    is_first: bool,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
    let (name, how) = asked;
    let marked = match how.map(selection).transpose()? {
        Some(selection) => MarkedBy::Array(name, selection),
        None => MarkedBy::Marks(name),
    };
    let Method { method, smoothing, max_points, boundaries } = options.method()?;
    let solution = solution.options()?;
    let options =
        RefineOptions { method, marked, smoothing, max_points, regions, boundaries, solution };
    let grid = grid.grid()?;
    let refined = job::run(py, move || {
        refine(&if is_first { without_origins(grid) } else { grid }, &options)
    })?;
    let told: Vec<String> = refined.messages().iter().map(|text| in_python(text)).collect();
    let RefinedGrid { grid, marked, added, .. } = refined;
    let report = PyDict::new(py);
    report.set_item("marked", marked)?;
    report.set_item("added", added)?;
    report.set_item("warnings", told)?;
    Ok((output::grid(py, grid)?, report))
}

/// The curves that the lines of a grid make, as arrays of points.
#[pyfunction]
pub fn curves<'py>(py: Python<'py>, grid: GridParts) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
    let grid = grid.grid()?;
    let curves = job::run(py, move || boundary_curves(&grid))?;
    curves.into_iter().map(|curve| rows(py, curve)).collect()
}

/// Triangles or tetrahedra refined: all of a `Refinement` as a dictionary of arrays.
/// `regions` and `state` have one number a cell, or none.
#[pyfunction]
pub fn refine_arrays<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<f64>,
    cells: PyReadonlyArray2<u32>,
    marks: PyReadonlyArray1<u32>,
    regions: PyReadonlyArray1<u32>,
    state: PyReadonlyArray1<u16>,
    options: RefinementOptions,
) -> PyResult<Bound<'py, PyDict>> {
    let options = options.method()?;
    let points = vectors(&points, "points")?;
    let corners = cells.as_slice();
    let corners = corners.map_err(|_| PyValueError::new_err("cells must be contiguous"))?;
    let max_points = options.max_points.unwrap_or(usize::MAX);
    let marks =
        Marks { cells: slice(&marks, "marks")?, max_points, state: slice(&state, "state")? };
    let regions = slice(&regions, "regions")?;
    if let [_, 4] = cells.as_array().shape()[..] {
        let refined = job::run(py, || {
            let mesh = SimplexMesh::view(points, bytemuck::cast_slice(corners))?;
            if !options.boundaries.is_empty() {
                return Err(FilterError::UnusedBoundary);
            }
            Ok(refine_tetrahedra(&mesh, &marks)?)
        })?;
        return dictionary(py, refined);
    }
    let refined = job::run(py, || {
        let mesh = SimplexMesh::view(points, bytemuck::cast_slice(corners))?;
        let mut refined = match options.method {
            RefineMethod::Divide(_) if !options.boundaries.is_empty() => {
                return Err(FilterError::UnusedBoundary);
            }
            RefineMethod::Divide(method) => method.refine(&mesh, &marks)?,
            RefineMethod::Delaunay => {
                let curves = &options.boundaries;
                delaunay(&mesh, &marks, &DelaunayOptions { regions, curves, ..Default::default() })?
            }
        };
        if let Some((smoothing, sweeps)) = options.smoothing {
            smooth(&mesh, &mut refined, regions, smoothing, sweeps);
        }
        Ok(refined)
    })?;
    dictionary(py, refined)
}

/// A refinement as arrays. Where points come from: `sources` are points of the input, `weights`
/// theirs, for each point.
fn dictionary<const CORNERS: usize>(
    py: Python,
    refined: Refinement<CORNERS>,
) -> PyResult<Bound<PyDict>> {
    let edge = |place: &NewPoint<CORNERS>| match *place {
        NewPoint::Edge { ends: [a, b], at } => ([i64::from(a), i64::from(b)], at, -1),
        NewPoint::Inside { cell, .. } => ([-1; 2], f64::NAN, i64::from(cell)),
    };
    let inside = |place: &NewPoint<CORNERS>| match *place {
        NewPoint::Edge { .. } => [f64::NAN; CORNERS],
        NewPoint::Inside { at, .. } => at,
    };
    let places = &refined.new_points;
    let count = places.len();
    let (edges, cells): (Vec<_>, Vec<_>) =
        places.iter().map(edge).map(|(ends, at, cell)| ((ends, at), cell)).unzip();
    let (ends, at): (Vec<[i64; 2]>, Vec<f64>) = edges.into_iter().unzip();
    let table =
        |numbers: Vec<f64>, rows: usize| PyArray1::from_vec(py, numbers).reshape([rows, CORNERS]);
    let result = PyDict::new(py);
    result.set_item("new_edges", pairs(py, &ends)?)?;
    result.set_item("new_at", PyArray1::from_vec(py, at))?;
    result.set_item("new_cells", PyArray1::from_vec(py, cells))?;
    result.set_item("new_weights", table(places.iter().flat_map(inside).collect(), count)?)?;
    let moved = &refined.moved;
    let numbers = |number: fn(&vtu2contour::refine::MovedPoint<CORNERS>) -> u32| {
        PyArray1::from_iter(py, moved.iter().map(|moved| i64::from(number(moved))))
    };
    result.set_item("moved", numbers(|moved| moved.point))?;
    result.set_item("moved_cells", numbers(|moved| moved.cell))?;
    let weights = moved.iter().flat_map(|moved| moved.at).collect();
    result.set_item("moved_weights", table(weights, moved.len())?)?;
    let corners = refined.cells.iter().flatten().map(|&point| i64::from(point));
    let corners = PyArray1::from_iter(py, corners).reshape([refined.cells.len(), CORNERS])?;
    result.set_item("cells", corners)?;
    let parents = refined.parents.iter().map(|&parent| i64::from(parent));
    result.set_item("parents", PyArray1::from_iter(py, parents))?;
    result.set_item("state", PyArray1::from_vec(py, refined.state))?;
    result.set_item("points", rows(py, refined.points)?)?;
    Ok(result)
}

fn pairs<'py>(py: Python<'py>, pairs: &[[i64; 2]]) -> PyResult<Bound<'py, PyArray2<i64>>> {
    PyArray1::from_slice(py, bytemuck::cast_slice::<[i64; 2], i64>(pairs)).reshape([pairs.len(), 2])
}
