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
use crate::contour::lines::{ContourLines, Counts, Resolution, contour_lines_with_walls};
use crate::contour::surface::{
    ContourSurface, SurfaceCounts, contour_surface, points_per_side_within,
};
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
    let report = report(&solution, in_triangles.as_ref(), in_tetrahedra.as_ref());
    let report = Report {
        range,
        levels,
        counts: lines.counts,
        surface_counts: surface.counts,
        resolution,
        fineness,
        ..report
    };
    drop((in_triangles, in_tetrahedra));
    let triangles =
        solution.triangles.map(|Domain { mesh, parents, .. }| Triangles { mesh, parents });
    Ok(Contoured { poly_data, lines, surface, triangles, report: report.with_warnings() })
}

/// What is known before contouring.
fn report(
    solution: &Solution,
    in_triangles: Option<&InTriangles>,
    in_tetrahedra: Option<&InTetrahedra>,
) -> Report {
    let mut warnings = solution.pde_warnings().to_vec();
    let (mut gradient, mut triangles, mut tetrahedra) = (GradientOrigin::Unused, 0, 0);
    if let Some(domain) = &solution.triangles {
        warnings.extend(coincidence_warning(&domain.mesh));
        warnings.extend(domain.gradients.warning.clone());
        gradient = domain.gradients.origin.clone();
        triangles = domain.mesh.triangles().len();
        warnings.extend(in_triangles.and_then(|i| too_far(solution, domain, i.range)));
    }
    if let Some(domain) = &solution.tetrahedra {
        warnings.extend(coincidence_warning(&domain.mesh));
        warnings.extend(domain.gradients.warning.clone());
        gradient = domain.gradients.origin.clone();
        tetrahedra = domain.mesh.tetrahedra().len();
        warnings.extend(in_tetrahedra.and_then(|i| too_far(solution, domain, i.range)));
    }
    warnings.dedup();
    let in_both = |of_triangles: fn(&InTriangles) -> usize,
                   of_solids: fn(&InTetrahedra) -> usize| {
        in_triangles.map_or(0, of_triangles) + in_tetrahedra.map_or(0, of_solids)
    };
    Report {
        label: solution.chosen.label(),
        gradient,
        triangles,
        tetrahedra,
        left_out: solution.left_out.clone(),
        ghosts: in_both(|i| i.ghosts, |i| i.ghosts),
        singular: in_both(|i| i.singular, |i| i.singular),
        pde_fit: in_triangles.and_then(|interpolated| interpolated.pde_fit),
        range: [0.0; 2],
        levels: Vec::new(),
        counts: Counts::default(),
        surface_counts: SurfaceCounts::default(),
        resolution: Resolution { spacing: f64::INFINITY, tolerance: f64::INFINITY },
        fineness: None,
        warnings,
    }
}

/// What people should know of an interpolant that goes far beyond the values.
fn too_far<const CORNERS: usize>(
    solution: &Solution,
    domain: &Domain<CORNERS>,
    range: [f64; 2],
) -> Option<String> {
    let values = solution.used_values(domain);
    range_warning(&solution.chosen.label(), &domain.gradients.origin, values, range)
}
