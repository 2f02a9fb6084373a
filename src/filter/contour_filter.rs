//! The contour filter: a grid with data in, contours with data out.

use std::borrow::Cow;

use super::contoured_solution::ContouredSolution;
use super::contours::Contours;
use super::error::FilterError;
use super::merge_points::merge_points;
use super::options::ContourOptions;
use super::report::Report;
use super::solution::Solution;
use crate::contour::lines::ContourLines;
use crate::contour::surface::ContourSurface;
use crate::mesh::TriangleMesh;
use crate::simplices::lagrange_grid;
use crate::vtk::{DataArray, PolyData, UnstructuredGrid};

/// What a filter is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Taking triangles, values and gradients from the grid.
    Field,
    /// Computing the interpolant and its range on each cell.
    Interpolant,
    /// Tracing the contours.
    Contour,
    /// Carrying the data over.
    Data,
}

/// Contours with everything that can be made of them.
pub struct Contoured {
    /// Lines and surfaces as VTK's polygonal data.
    pub poly_data: PolyData,
    /// The lines, in the two-dimensional cells.
    pub lines: ContourLines,
    /// The surfaces, in the solids.
    pub surface: ContourSurface,
    /// The two-dimensional cells, if there are any.
    pub triangles: Option<TriangleMesh<'static>>,
    /// What was done.
    pub report: Report,
}

/// Contours a grid: lines in its two-dimensional cells, surfaces in its solids. `progress`
/// is told each stage as it begins.
///
/// Whoever wants other levels of the same grid later does what is done here one by one, and
/// keeps the [`Interpolant`](super::Interpolant) and the grid.
///
/// # Errors
/// See [`FilterError`]: an array that is not there or does not fit, a PDE that
/// cannot be read, levels that are no numbers, nothing to contour.
pub fn contour(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
    progress: &mut dyn FnMut(Stage),
) -> Result<Contoured, FilterError> {
    contour_any(Cow::Borrowed(grid), options, progress)
}

/// The same for a grid that nobody needs any more: in less memory, as its cells are let go before
/// the work.
///
/// # Errors
/// As [`contour`].
pub fn contour_owned(
    grid: UnstructuredGrid,
    options: &ContourOptions,
    progress: &mut dyn FnMut(Stage),
) -> Result<Contoured, FilterError> {
    contour_any(Cow::Owned(grid), options, progress)
}

fn contour_any(
    grid: Cow<UnstructuredGrid>,
    options: &ContourOptions,
    progress: &mut dyn FnMut(Stage),
) -> Result<Contoured, FilterError> {
    progress(Stage::Field);
    let mut grid = prepared(grid, options)?;
    let solution = Solution::of_grid(&grid, options)?;
    let output_options = options.output(&grid);
    if let Cow::Owned(grid) = &mut grid {
        keep_data_only(grid);
    }
    progress(Stage::Interpolant);
    let contoured = ContouredSolution::told(solution, options, || progress(Stage::Contour))?;
    progress(Stage::Data);
    let poly_data = contoured.output(output_options).poly_data(&grid);
    let report = contoured.report();
    let (Contours { lines, surface, .. }, triangles) = contoured.into_parts();
    let (lines, surface) = (lines.unwrap_or_default(), surface.unwrap_or_default());
    Ok(Contoured { poly_data, lines, surface, triangles, report })
}

/// Lets go what contours no longer need of a grid of which the solution was taken.
fn keep_data_only(grid: &mut UnstructuredGrid) {
    let points = DataArray::new("Points", 3, Vec::<f64>::new());
    let data = UnstructuredGrid {
        point_data: std::mem::take(&mut grid.point_data),
        cell_data: std::mem::take(&mut grid.cell_data),
        field_data: std::mem::take(&mut grid.field_data),
        ..UnstructuredGrid::new(points)
    };
    *grid = data;
}

/// A grid as solutions are taken from it: Bézier cells are Lagrange cells, points are merged
/// if the options say so. Data travel along from this grid.
///
/// # Errors
/// If the options' tolerance is negative or no number.
pub fn prepared<'a>(
    grid: Cow<'a, UnstructuredGrid>,
    options: &ContourOptions,
) -> Result<Cow<'a, UnstructuredGrid>, FilterError> {
    let grid = changed(lagrange_grid(&grid)).unwrap_or(grid);
    let merged = changed(merge_points(&grid, options.merge_points)?);
    Ok(merged.unwrap_or(grid))
}

/// What is no longer the grid that was given.
fn changed(grid: Cow<UnstructuredGrid>) -> Option<Cow<'static, UnstructuredGrid>> {
    match grid {
        Cow::Owned(grid) => Some(Cow::Owned(grid)),
        Cow::Borrowed(_) => None,
    }
}
