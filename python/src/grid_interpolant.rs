//! The interpolant of a grid, with the data that travel along.

use std::borrow::Cow;

use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vtu2contour::filter::{
    ContourOptions, Interpolant, Locators, Monitored, Solution, contour_owned, prepared,
};
use vtu2contour::vtk::UnstructuredGrid;

use super::arrays::{rows, vectors};
use super::grid::GridParts;
use super::job;
use super::monitor::{self, MonitorChoice};
use super::options::{self, DrawingOptions, SolutionOptions};
use super::output::{self, Done};

/// The interpolant of a grid, made once and contoured at any levels.
#[pyclass(frozen)]
pub struct GridInterpolant {
    /// The grid as it is contoured, for its data.
    grid: UnstructuredGrid,
    interpolant: Interpolant<'static>,
    /// What it was made by.
    options: ContourOptions,
    locators: std::sync::OnceLock<Locators>,
}

#[pymethods]
impl GridInterpolant {
    /// Of a grid that was taken apart, see `vtu2contour/_vtk.py`.
    #[new]
    fn new(py: Python, grid: GridParts, options: SolutionOptions) -> PyResult<Self> {
        let (grid, options) = (grid.grid()?, options.options()?);
        let (grid, interpolant, options) = job::run(py, move || {
            let grid = prepared(Cow::Owned(grid), &options)?.into_owned();
            let solution = Solution::of_grid(&grid, &options)?;
            let interpolant = Interpolant::new(solution, &options)?;
            Ok((grid, interpolant, options))
        })?;
        Ok(Self { grid, interpolant, options, locators: std::sync::OnceLock::new() })
    }

    /// Its contours, and what was done.
    fn contour<'py>(
        &self,
        py: Python<'py>,
        options: DrawingOptions,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
        let options: ContourOptions = options.options()?;
        let (data, done) = job::run(py, || {
            let contours = self.interpolant.contours(&options)?;
            let output = self.interpolant.output(&contours, options.output(&self.grid));
            let done = Done::new(&self.interpolant, &contours);
            Ok((output.poly_data(&self.grid), done))
        })?;
        Ok((output::poly_data(py, data)?, output::report(py, &done)?))
    }

    /// A monitor of its cells, and what people should know.
    fn monitor<'py>(&self, py: Python<'py>, choice: MonitorChoice) -> PyResult<Bound<'py, PyDict>> {
        let options = choice.options()?;
        let monitored = job::run(py, || {
            let pde = self.interpolant.solution.pde.as_deref();
            let cells = self.grid.types.len();
            Monitored::new(&self.interpolant, cells, &options, &self.options, pde)
        })?;
        monitor::dictionary(py, monitored, &self.interpolant.interpolation.warnings)
    }

    /// Values at points, and gradients.
    #[allow(clippy::type_complexity)]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>)> {
        let points = vectors(&points, "points")?;
        let (values, gradients): (Vec<f64>, Vec<_>) = job::run(py, || {
            let locators = job::kept(&self.locators, || Locators::new(&self.interpolant.solution));
            Ok(locators.evaluate(&self.interpolant, points).into_iter().unzip())
        })?;
        Ok((PyArray1::from_vec(py, values), rows(py, gradients)?))
    }

    /// What people should know of it, a line each.
    fn warnings(&self) -> Vec<String> {
        output::warnings(&self.interpolant.interpolation)
    }

    /// What is known of it.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        output::information(py, &self.interpolant)
    }
}

/// The contours of a grid, and what was done: for once, so that little is computed where no
/// level is.
#[pyfunction]
pub fn contour_grid<'py>(
    py: Python<'py>,
    grid: GridParts,
    solution: SolutionOptions,
    drawing: DrawingOptions,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
    let (grid, options) = (grid.grid()?, options::joined(solution, drawing)?);
    let (data, done) = job::run(py, move || {
        let contoured = contour_owned(grid, &options, &mut |_| {})?;
        let (lines, surface) = (&contoured.lines, &contoured.surface);
        let done = Done::of_report(contoured.report, Some(lines), Some(surface));
        Ok((contoured.poly_data, done))
    })?;
    Ok((output::poly_data(py, data)?, output::report(py, &done)?))
}
