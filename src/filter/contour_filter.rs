//! The contour filter: a grid with data in, contour lines with data out.

use super::cells::Triangles;
use super::error::FilterError;
use super::gradients::GradientOrigin;
use super::line_output::LineOutput;
use super::merge_points::{coincidence_warning, merge_points};
use super::options::ContourOptions;
use super::pde_warning::pde_warning;
use super::range_warning::range_warning;
use super::solution::{Interpolated, Solution};
use crate::contour::CellRanges;
use crate::contour::lines::{ContourLines, Counts, Resolution, contour_lines_with_walls};
use crate::interpolant::PdeFit;
use crate::simplices::{CellCounts, LeftOut, lagrange_grid};
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

/// What was done, and what people should know about it.
#[derive(Clone, Debug)]
pub struct Report {
    /// What was contoured, such as `u` or `|velocity|`.
    pub label: String,
    /// Where the gradient came from.
    pub gradient: GradientOrigin,
    /// How many triangles there were.
    pub triangles: usize,
    /// Cells of two or three dimensions that could not be split into simplices.
    pub left_out: LeftOut,
    /// Solids, which are not contoured yet.
    pub solids: CellCounts,
    /// Cells of another process, which are not contoured.
    pub ghosts: usize,
    /// Triangles in which the PDE could not be used.
    pub singular: usize,
    /// How well the PDE fits the values and gradients; nothing without a PDE.
    pub pde_fit: Option<PdeFit>,
    /// The least and the greatest value of the interpolant.
    pub range: [f64; 2],
    /// What the contouring counted.
    pub counts: Counts,
    /// How fine the lines are.
    pub resolution: Resolution,
    /// One line each. What can be said only of all grids that share their levels is told by
    /// [`level_warning`](super::level_warning()).
    pub warnings: Vec<String>,
}

/// Contour lines with everything that can be made of them.
pub struct Contoured {
    /// The lines as VTK's polygonal data.
    pub poly_data: PolyData,
    /// The lines.
    pub lines: ContourLines,
    /// The triangles.
    pub triangles: Triangles,
    /// What was done.
    pub report: Report,
}

/// Contours a grid. `progress` is told each stage as it begins.
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
    let grid = grid.as_ref();
    let solution = Solution::new(grid, options)?;
    let resolution = options.resolution(solution.triangles.mesh.diagonal())?;
    progress(Stage::Interpolant);
    let Interpolated { cubics, singular, pde_fit } = solution.interpolant(options.predictor);
    let mut ranges = CellRanges::new(cubics.as_ref());
    let ghosts = ranges.exclude(|triangle| solution.is_ghost(triangle));
    let range = solution.range(&ranges, cubics.as_ref())?;
    let levels = options.levels.resolve(range)?;
    progress(Stage::Contour);
    let lines =
        contour_lines_with_walls(cubics.as_ref(), &ranges, &levels, options.method, resolution);
    progress(Stage::Data);
    let poly_data = LineOutput {
        grid,
        parents: &solution.triangles.parents,
        chosen: &solution.chosen,
        interpolant: cubics.as_ref(),
        lines: &lines,
        options: options.output(grid),
    }
    .poly_data();
    drop(cubics);
    let solids = solution.solids();
    let mut warnings = solution.pde_warnings().to_vec();
    warnings.extend(coincidence_warning(&solution.triangles.mesh));
    let origin = &solution.gradients.origin;
    warnings.extend(range_warning(&solution.chosen.label(), origin, solution.used_values(), range));
    warnings.extend(solution.gradients.warning);
    let report = Report {
        label: solution.chosen.label(),
        gradient: solution.gradients.origin,
        triangles: solution.triangles.mesh.triangles().len(),
        left_out: solution.left_out,
        solids,
        ghosts,
        singular,
        pde_fit,
        range,
        counts: lines.counts,
        resolution,
        warnings,
    };
    let report = report.with_warnings();
    Ok(Contoured { poly_data, lines, triangles: solution.triangles, report })
}

impl Report {
    /// Adds what people should know, a line each.
    fn with_warnings(mut self) -> Self {
        let mut warn = |condition: bool, text: String| {
            if condition {
                self.warnings.push(text);
            }
        };
        let Counts { unusable, unresolved, .. } = self.counts;
        warn(self.left_out.total() > 0, format!("left out: {}", self.left_out));
        warn(
            self.solids.total() > 0,
            format!("left out: {} (only two-dimensional cells are contoured)", self.solids),
        );
        warn(
            unusable > 0,
            format!("left out: {unusable} triangles with values that are not finite numbers"),
        );
        warn(
            unresolved > 0,
            format!("{unresolved} tiny pieces could not be settled; straight lines join them"),
        );
        let touching = self.counts.touching;
        warn(
            touching > 0,
            format!(
                "in {touching} triangles a level is touched, not crossed: no line is drawn there"
            ),
        );
        let coarse = self.counts.coarse;
        warn(
            coarse > 0,
            format!("{coarse} arcs are not as fine as asked: they have too many points"),
        );
        let (singular, triangles) = (self.singular, self.triangles);
        warn(
            singular > 0,
            format!("the PDE does not determine the cubic in {singular} of {triangles} triangles"),
        );
        self.warnings.extend(pde_warning(&self.label, self.pde_fit));
        self
    }
}
