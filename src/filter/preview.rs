//! What contouring a grid would do, without doing it.

use std::borrow::Cow;

use super::contour_filter::prepared;
use super::error::FilterError;
use super::extent::Extent;
use super::gradients::{GradientOrigin, Gradients};
use super::interpolation::Interpolation;
use super::options::ContourOptions;
use super::solution::{Domain, Solution};
use crate::simplices::{CellCounts, LeftOut};
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
    /// How many tetrahedra there are.
    pub tetrahedra: usize,
    /// Cells of two or three dimensions that could not be split into simplices.
    pub left_out: LeftOut,
    /// Solids whose tetrahedra lie over one another in part.
    pub folded: CellCounts,
    /// Triangles and tetrahedra with values that are not finite.
    pub unusable: usize,
    /// Cells of another process, which are not contoured.
    pub ghosts: usize,
    /// The least and the greatest value of the interpolant.
    pub range: [f64; 2],
    /// How large its cells are together.
    pub extent: Extent,
}

/// Finds out what [`contour`](super::contour()) would do with a grid. All that it does is
/// done, but for the contours: several grids that are to have the same levels need to know
/// their common range first.
///
/// # Errors
/// As [`contour`](super::contour()), but for levels.
pub fn preview(grid: &UnstructuredGrid, options: &ContourOptions) -> Result<Preview, FilterError> {
    let grid = prepared(Cow::Borrowed(grid), options)?;
    let solution = Solution::of_grid(&grid, options)?;
    let extent = Extent::of_solution(&solution);
    let interpolation = Interpolation::of_range(&solution, options, extent.diagonal())?;
    let (ghosts, unusable) = (interpolation.ghosts(), interpolation.unusable());
    let Solution { label, triangles, tetrahedra, left_out, folded, .. } = solution;
    let triangle_count = triangles.as_ref().map_or(0, Domain::count);
    let tetrahedron_count = tetrahedra.as_ref().map_or(0, Domain::count);
    let of_solids = tetrahedra.map(|domain| domain.gradients);
    let gradients = of_solids.or(triangles.map(|domain| domain.gradients));
    let Gradients { origin, warning, .. } = gradients.unwrap_or(Gradients::none());
    Ok(Preview {
        label,
        gradient: origin,
        warning,
        triangles: triangle_count,
        tetrahedra: tetrahedron_count,
        left_out,
        folded,
        unusable,
        ghosts,
        range: interpolation.range,
        extent,
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
