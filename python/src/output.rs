//! What was found, as dictionaries.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vtu2contour::contour::lines::ContourLines;
use vtu2contour::contour::surface::ContourSurface;
use vtu2contour::filter::{
    Contours, GradientOrigin, Interpolant, Interpolation, Output, OutputPoints, Report,
    level_warning,
};
use vtu2contour::mesh::Vector;
use vtu2contour::vtk::{Attributes, CellArray, PolyData, UnstructuredGrid};

use super::arrays::{rows, to_python};
use super::error::in_python;

/// Polygonal data as a dictionary of arrays.
pub fn poly_data(py: Python, data: PolyData) -> PyResult<Bound<PyDict>> {
    let output = PyDict::new(py);
    output.set_item("points", to_python(py, data.points)?)?;
    output.set_item("lines", cells(py, &data.lines))?;
    output.set_item("polys", cells(py, &data.polys))?;
    put_data(&output, &data.point_data, &data.cell_data, &data.field_data)?;
    Ok(output)
}

/// A grid as a dictionary of arrays.
pub fn grid(py: Python, grid: UnstructuredGrid) -> PyResult<Bound<PyDict>> {
    let output = PyDict::new(py);
    output.set_item("points", to_python(py, grid.points)?)?;
    output.set_item("cells", cells(py, &grid.cells))?;
    output.set_item("types", PyArray1::from_vec(py, grid.types))?;
    put_data(&output, &grid.point_data, &grid.cell_data, &grid.field_data)?;
    Ok(output)
}

/// Adds the data of points, cells and the field, with their roles.
fn put_data(
    output: &Bound<PyDict>,
    points: &Attributes,
    cells: &Attributes,
    field: &Attributes,
) -> PyResult<()> {
    let py = output.py();
    output.set_item("point_roles", roles(points))?;
    output.set_item("cell_roles", roles(cells))?;
    output.set_item("point_data", arrays(py, points)?)?;
    output.set_item("cell_data", arrays(py, cells)?)?;
    output.set_item("field_data", arrays(py, field)?)
}

type Cells<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>);

fn cells<'py>(py: Python<'py>, cells: &CellArray) -> Cells<'py> {
    let offsets = PyArray1::from_iter(py, cells.offsets());
    (offsets, PyArray1::from_slice(py, cells.connectivity()))
}

fn roles(data: &Attributes) -> Vec<(&'static str, String)> {
    data.active_names().iter().map(|(kind, name)| (kind.name(), name.clone())).collect()
}

type Arrays<'py> = Vec<(String, Bound<'py, PyAny>, Vec<String>)>;

fn arrays<'py>(py: Python<'py>, data: &Attributes) -> PyResult<Arrays<'py>> {
    let named = |array: &vtu2contour::vtk::DataArray| {
        let (name, names) = (array.name.clone(), array.component_names.clone());
        Ok((name, to_python(py, array.clone())?, names))
    };
    data.iter().map(named).collect()
}

/// Contours without data of a grid, as a dictionary of arrays.
pub fn bare_contours(py: Python, output: Output) -> PyResult<Bound<PyDict>> {
    let Output { options, points, lines, polys, parents, .. } = output;
    let OutputPoints { positions, levels, gradients, .. } = points;
    let result = PyDict::new(py);
    let (offsets, connectivity) = cells(py, &lines);
    result.set_item("line_offsets", offsets)?;
    result.set_item("line_points", connectivity)?;
    drop(lines);
    let count = polys.len();
    let triangles = PyArray1::from_vec(py, polys.into_connectivity());
    result.set_item("triangles", triangles.reshape([count, 3])?)?;
    let parents = parents.into_iter().map(i64::from);
    result.set_item("cells", PyArray1::from_iter(py, parents))?;
    if options.need_gradients() {
        if options.normals {
            let downhill = |g: &Vector| -g.try_normalize(0.0).unwrap_or_default();
            result.set_item("normals", rows(py, gradients.iter().map(downhill).collect())?)?;
        }
        if options.gradients {
            result.set_item("gradients", rows(py, gradients)?)?;
        }
    }
    result.set_item("values", PyArray1::from_vec(py, levels))?;
    result.set_item("points", rows(py, positions)?)?;
    Ok(result)
}

/// What is known of an interpolant before it is contoured, as a dictionary.
pub fn information<'py>(
    py: Python<'py>,
    interpolant: &Interpolant,
) -> PyResult<Bound<'py, PyDict>> {
    let (solution, interpolation) = (&interpolant.solution, &interpolant.interpolation);
    let info = PyDict::new(py);
    info.set_item("scalars", &solution.label)?;
    info.set_item("gradient", origin(&solution.gradient_origin()))?;
    info.set_item("range", (interpolation.range[0], interpolation.range[1]))?;
    info.set_item("points", solution.values.len())?;
    info.set_item("triangles", solution.triangles.as_ref().map_or(0, |domain| domain.count()))?;
    info.set_item("tetrahedra", solution.tetrahedra.as_ref().map_or(0, |domain| domain.count()))?;
    info.set_item("ghosts", interpolation.ghosts())?;
    info.set_item("unusable", interpolation.unusable())?;
    info.set_item("left_out", solution.left_out.total())?;
    info.set_item("diagonal", interpolation.diagonal)?;
    info.set_item("singular", interpolation.singular())?;
    Ok(info)
}

fn origin(gradient: &GradientOrigin) -> String {
    match gradient {
        GradientOrigin::Array(name) => name.clone(),
        other => other.to_string(),
    }
}

/// What people should know of an interpolant.
pub fn warnings(interpolation: &Interpolation) -> Vec<String> {
    interpolation.warnings.iter().map(|text| in_python(text)).collect()
}

/// What contouring did.
pub struct Done {
    report: Report,
    /// What people should know that they were not told when the interpolant was made.
    warnings: Vec<String>,
}

impl Done {
    /// What contouring an interpolant did.
    pub fn new(interpolant: &Interpolant, contours: &Contours) -> Self {
        let (lines, surface) = (contours.lines.as_ref(), contours.surface.as_ref());
        let mut done = Self::of_report(interpolant.report(contours), lines, surface);
        done.warnings.retain(|warning| !interpolant.interpolation.warnings.contains(warning));
        done
    }

    /// What contouring a grid did.
    pub fn of_report(
        report: Report,
        lines: Option<&ContourLines>,
        surface: Option<&ContourSurface>,
    ) -> Self {
        let has_line =
            |place| lines.is_some_and(|all| all.lines.iter().any(|line| line.level == place));
        let has_triangle = |place: usize| {
            let triangles = surface.and_then(|all| all.level_triangles.get(place));
            triangles.is_some_and(|triangles| !triangles.is_empty())
        };
        let is_drawn = |place| has_line(place) || has_triangle(place);
        let mut warnings = report.warnings.clone();
        warnings.extend(level_warning(&report.label, report.range, &report.levels, is_drawn));
        Self { report, warnings }
    }
}

/// What contouring counted and what people should know, as a dictionary.
pub fn report<'py>(py: Python<'py>, done: &Done) -> PyResult<Bound<'py, PyDict>> {
    let report = &done.report;
    let (flat, solid) = (&report.counts, &report.surface_counts);
    let output = PyDict::new(py);
    output.set_item("levels", report.levels.clone())?;
    output.set_item("active", flat.active + solid.active)?;
    output.set_item("divided", flat.divided + solid.divided)?;
    output.set_item("unresolved", flat.unresolved + solid.unresolved)?;
    let warnings: Vec<String> = done.warnings.iter().map(|text| in_python(text)).collect();
    output.set_item("warnings", warnings)?;
    Ok(output)
}
