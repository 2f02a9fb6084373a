//! What contouring a grid would do, without doing it.

use super::error::FilterError;
use super::gradients::GradientOrigin;
use super::merge_points::merge_points;
use super::options::ContourOptions;
use super::solution::{Interpolated, Solution};
use crate::contour::CellRanges;
use crate::simplices::{CellCounts, LeftOut, lagrange_grid};
use crate::vtk::UnstructuredGrid;

/// What of a grid would be contoured, and between which values.
#[derive(Clone, Debug)]
pub struct Preview {
    /// What would be contoured, such as `u` or `|velocity|`.
    pub label: String,
    /// Where the gradient would come from.
    pub gradient: GradientOrigin,
    /// What people should know about the choice of the gradient.
    pub warning: Option<String>,
    /// How many triangles there are.
    pub triangles: usize,
    /// Cells of two or three dimensions that could not be split into simplices.
    pub left_out: LeftOut,
    /// Solids, which are not contoured yet.
    pub solids: CellCounts,
    /// Triangles with values that are not finite.
    pub unusable: usize,
    /// Cells of another process, which are not contoured.
    pub ghosts: usize,
    /// The least and the greatest value of the interpolant.
    pub range: [f64; 2],
}

/// Finds out what [`contour`](super::contour()) would do with a grid. All that it does is
/// done, but for the contours: several grids that are to have the same levels need to know
/// their common range first.
///
/// # Errors
/// As [`contour`](super::contour()), but for levels.
pub fn preview(grid: &UnstructuredGrid, options: &ContourOptions) -> Result<Preview, FilterError> {
    let grid = lagrange_grid(grid);
    let grid = merge_points(&grid, options.merge_points)?;
    let grid = grid.as_ref();
    let solution = Solution::new(grid, options)?;
    let Interpolated { cubics, .. } = solution.interpolant(options.predictor);
    let mut ranges = CellRanges::new(cubics.as_ref());
    let ghosts = ranges.exclude(|triangle| solution.is_ghost(triangle));
    let range = solution.range(&ranges, cubics.as_ref())?;
    drop(cubics);
    let solids = solution.solids();
    Ok(Preview {
        label: solution.chosen.label(),
        gradient: solution.gradients.origin,
        warning: solution.gradients.warning,
        triangles: solution.triangles.mesh.triangles().len(),
        left_out: solution.left_out,
        solids,
        unusable: ranges.unusable(),
        ghosts,
        range,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::contour;
    use crate::vtk::DataArray;

    /// Two triangles, of which one may be a ghost.
    fn grid(ghost: u8) -> UnstructuredGrid {
        let points = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, points));
        grid.push_cell(5, &[0, 1, 2]);
        grid.push_cell(5, &[1, 3, 2]);
        grid.push_cell(3, &[0, 1]);
        grid.point_data.push(DataArray::new("u", 1, vec![0.0, 1.0, 1.0, 9.0]));
        grid.cell_data.push(DataArray::new("vtkGhostType", 1, vec![0, ghost, 0]));
        grid
    }

    #[test]
    fn it_foretells_what_contouring_reports() {
        for (ghost, high) in [(0, 9.0), (1, 1.0)] {
            let options = ContourOptions {
                interpolant: crate::filter::InterpolantKind::Linear,
                ..ContourOptions::default()
            };
            let grid = grid(ghost);
            let preview = preview(&grid, &options).unwrap();
            let report = contour(&grid, &options, &mut |_| {}).unwrap().report;
            assert_eq!((preview.range, preview.triangles), ([0.0, high], 2));
            assert_eq!((preview.range, preview.ghosts), (report.range, report.ghosts));
            assert_eq!((preview.label, preview.gradient), (report.label, report.gradient));
        }
    }
}
