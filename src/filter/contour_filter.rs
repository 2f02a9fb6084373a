//! The contour filter: a grid with data in, contours with data out.

use super::cells::Triangles;
use super::error::FilterError;
use super::gradients::GradientOrigin;
use super::interpolated::{InTetrahedra, InTriangles};
use super::line_output::LineOutput;
use super::merge_points::{coincidence_warning, merge_points};
use super::options::ContourOptions;
use super::output::Output;
use super::range_warning::range_warning;
use super::report::Report;
use super::solution::{Domain, Solution};
use super::surface_output::SurfaceOutput;
use crate::contour::lines::{ContourLines, contour_lines_with_walls};
use crate::contour::surface::{ContourSurface, contour_surface, points_per_side_within};
use crate::simplices::lagrange_grid;
use crate::vtk::{PolyData, UnstructuredGrid};

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
    pub triangles: Option<Triangles>,
    /// What was done.
    pub report: Report,
}

/// Contours a grid: lines in its two-dimensional cells, surfaces in its solids. `progress`
/// is told each stage as it begins.
///
/// # Errors
/// See [`FilterError`]: an array that is not there or does not fit, a PDE that
/// cannot be read, levels that are no numbers, nothing to contour.
pub fn contour(
    grid: &UnstructuredGrid,
    options: &ContourOptions,
    progress: &mut dyn FnMut(Stage),
) -> Result<Contoured, FilterError> {
    progress(Stage::Field);
    let grid = lagrange_grid(grid);
    let grid = merge_points(&grid, options.merge_points)?;
    let solution = Solution::new(grid.as_ref(), options)?;
    let resolution = options.resolution(solution.diagonal())?;
    progress(Stage::Interpolant);
    let in_triangles = solution.in_triangles(options);
    let in_tetrahedra = solution.in_tetrahedra(options);
    let range = solution.range(in_triangles.as_ref(), in_tetrahedra.as_ref())?;
    let levels = options.levels.resolve(range)?;
    progress(Stage::Contour);
    let lines = in_triangles.as_ref().map(|interpolated| {
        let (cubics, ranges) = (interpolated.cubics.as_ref(), &interpolated.ranges);
        contour_lines_with_walls(cubics, ranges, &levels, options.method, resolution)
    });
    let mut fineness = None;
    let surface = match &in_tetrahedra {
        None => None,
        Some(interpolated) => {
            let (cubics, ranges) = (interpolated.cubics.as_ref(), &interpolated.ranges);
            let within = |limit| points_per_side_within(cubics, ranges, &levels, limit);
            let chosen = options.fineness(solution.diagonal(), within)?;
            fineness = Some(chosen);
            Some(contour_surface(cubics, ranges, &levels, chosen))
        }
    };
    progress(Stage::Data);
    let mut output = Output::new(solution.grid, &solution.chosen, options.output(solution.grid));
    if let (Some(domain), Some(interpolated), Some(lines)) =
        (&solution.triangles, &in_triangles, &lines)
    {
        let (parents, interpolant) = (&domain.parents, interpolated.cubics.as_ref());
        LineOutput { parents, interpolant, lines }.add_to(&mut output);
    }
    if let (Some(domain), Some(interpolated), Some(surface)) =
        (&solution.tetrahedra, &in_tetrahedra, &surface)
    {
        let (parents, interpolant) = (&domain.parents, interpolated.cubics.as_ref());
        SurfaceOutput { parents, interpolant, surface }.add_to(&mut output);
    }
    let poly_data = output.poly_data();
    let (lines, surface) = (lines.unwrap_or_default(), surface.unwrap_or_default());
    let report = Report {
        label: solution.chosen.label(),
        gradient: gradient_origin(&solution),
        triangles: solution.triangles.as_ref().map_or(0, Domain::count),
        tetrahedra: solution.tetrahedra.as_ref().map_or(0, Domain::count),
        left_out: solution.left_out.clone(),
        ghosts: in_triangles.as_ref().map_or(0, |found| found.ghosts)
            + in_tetrahedra.as_ref().map_or(0, |found| found.ghosts),
        singular: in_triangles.as_ref().map_or(0, |found| found.singular)
            + in_tetrahedra.as_ref().map_or(0, |found| found.singular),
        pde_fit: in_triangles.as_ref().and_then(|found| found.pde_fit),
        range,
        levels,
        counts: lines.counts,
        surface_counts: surface.counts,
        resolution,
        fineness,
        warnings: warnings(&solution, in_triangles.as_ref(), in_tetrahedra.as_ref()),
    };
    drop((in_triangles, in_tetrahedra));
    let triangles =
        solution.triangles.map(|Domain { mesh, parents, .. }| Triangles { mesh, parents });
    Ok(Contoured { poly_data, lines, surface, triangles, report: report.with_warnings() })
}

/// Where the gradient came from: in solids, if there are any.
fn gradient_origin(solution: &Solution) -> GradientOrigin {
    let in_triangles = solution.triangles.as_ref().map(|domain| &domain.gradients.origin);
    let in_tetrahedra = solution.tetrahedra.as_ref().map(|domain| &domain.gradients.origin);
    in_tetrahedra.or(in_triangles).cloned().unwrap_or(GradientOrigin::Unused)
}

/// What people should know about the data, a line each.
fn warnings(
    solution: &Solution,
    in_triangles: Option<&InTriangles>,
    in_tetrahedra: Option<&InTetrahedra>,
) -> Vec<String> {
    let mut warnings = solution.pde_warnings().to_vec();
    if let Some(domain) = &solution.triangles {
        warnings.extend(of_domain(solution, domain, in_triangles.map(|found| found.range)));
    }
    if let Some(domain) = &solution.tetrahedra {
        warnings.extend(of_domain(solution, domain, in_tetrahedra.map(|found| found.range)));
    }
    warnings.dedup();
    warnings
}

/// What people should know about the cells of one dimension; `range` is that of the
/// interpolant there.
fn of_domain<const CORNERS: usize>(
    solution: &Solution,
    domain: &Domain<CORNERS>,
    range: Option<[f64; 2]>,
) -> impl Iterator<Item = String> {
    let (label, gradients) = (solution.chosen.label(), &domain.gradients);
    let values = solution.used_values(domain);
    let too_far = range.and_then(|range| range_warning(&label, &gradients.origin, values, range));
    [coincidence_warning(&domain.mesh), gradients.warning.clone(), too_far].into_iter().flatten()
}
