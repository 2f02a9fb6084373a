//! A finite-element solution taken from a grid: cells, values, gradients, PDE.

use super::cells::{Cells, Part, is_ghost};
use super::chosen_array::ChosenArray;
use super::error::FilterError;
use super::gradients::Gradients;
use super::known_pde::KnownPde;
use super::options::{ContourOptions, InterpolantKind};
use crate::field::Field;
use crate::mesh::SimplexMesh;
use crate::simplices::LeftOut;
use crate::vtk::UnstructuredGrid;

/// What of a grid is contoured.
pub struct Solution<'a> {
    /// The grid.
    pub grid: &'a UnstructuredGrid,
    /// The array.
    pub chosen: ChosenArray<'a>,
    /// One value a point.
    pub values: Vec<f64>,
    /// The two-dimensional cells, which have contour lines.
    pub triangles: Option<Domain<3>>,
    /// The solids, which have iso-surfaces.
    pub tetrahedra: Option<Domain<4>>,
    /// Cells that cannot be split into simplices.
    pub left_out: LeftOut,
    /// The PDE, if it is known.
    pub pde: Option<KnownPde>,
}

/// The cells of one dimension, as simplices, and the gradients there.
#[derive(Clone, Debug)]
pub struct Domain<const CORNERS: usize> {
    /// The simplices, with all the grid's points.
    pub mesh: SimplexMesh<CORNERS>,
    /// The cell of the grid that each simplex came from.
    pub parents: Vec<u32>,
    /// One gradient a point; none for the linear interpolant.
    pub gradients: Gradients,
}

impl<'a> Solution<'a> {
    /// Takes from a grid what the options name. Bézier cells of order two have to be
    /// Lagrange cells by now, see [`lagrange_grid`](crate::simplices::lagrange_grid).
    ///
    /// # Errors
    /// If an array is missing or does not fit, the PDE cannot be read, or the grid
    /// has no cells that can be contoured.
    pub fn new(grid: &'a UnstructuredGrid, options: &ContourOptions) -> Result<Self, FilterError> {
        let chosen = ChosenArray::new(grid, options.array.as_deref(), options.component)?;
        let pde = KnownPde::new(grid, options)?;
        let Cells { triangles, tetrahedra, left_out, .. } = Cells::new(grid)?;
        if triangles.is_none() && tetrahedra.is_none() {
            let cells = grid.types.iter().copied().collect();
            return Err(FilterError::NoCells { cells, left_out });
        }
        let values = chosen.values();
        let triangles = Domain::new(grid, triangles, &chosen, &values, options)?;
        let tetrahedra = Domain::new(grid, tetrahedra, &chosen, &values, options)?;
        Ok(Self { grid, chosen, values, triangles, tetrahedra, left_out, pde })
    }

    /// The length of the diagonal of the box around all cells: of the larger one, where
    /// there are two kinds.
    pub fn diagonal(&self) -> f64 {
        let of_triangles = self.triangles.as_ref().map_or(0.0, |domain| domain.mesh.diagonal());
        let of_tetrahedra = self.tetrahedra.as_ref().map_or(0.0, |domain| domain.mesh.diagonal());
        of_triangles.max(of_tetrahedra)
    }

    /// Values and gradients on a domain.
    pub fn field<'b, const CORNERS: usize>(&'b self, domain: &'b Domain<CORNERS>) -> Field<'b> {
        Field { values: &self.values, gradients: &domain.gradients.vectors }
    }

    /// The values at the corners of the cells that are contoured.
    pub fn used_values<'b, const CORNERS: usize>(
        &'b self,
        domain: &'b Domain<CORNERS>,
    ) -> impl Iterator<Item = f64> + 'b {
        let cells = domain.mesh.simplices().iter().zip(&domain.parents);
        let used = cells.filter(|(_, parent)| !is_ghost(self.grid, **parent));
        used.flat_map(|(corners, _)| corners.map(|point| self.values[point as usize]))
    }

    /// What people should know about the PDE's parameters, a line each.
    pub fn pde_warnings(&self) -> &[String] {
        self.pde.as_ref().map_or(&[], |known| &known.warnings)
    }
}

impl<const CORNERS: usize> Domain<CORNERS> {
    /// How many simplices there are.
    pub fn count(&self) -> usize {
        self.mesh.simplices().len()
    }

    fn new(
        grid: &UnstructuredGrid,
        part: Option<Part<CORNERS>>,
        chosen: &ChosenArray,
        values: &[f64],
        options: &ContourOptions,
    ) -> Result<Option<Self>, FilterError> {
        let Some(Part { mesh, parents }) = part else { return Ok(None) };
        let gradients = match options.interpolant {
            InterpolantKind::Linear => Gradients::none(),
            _ => Gradients::new(grid, &mesh, chosen, values, &options.gradient)?,
        };
        Ok(Some(Self { mesh, parents, gradients }))
    }
}
