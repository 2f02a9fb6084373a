//! A finite-element solution taken from a grid: triangles, values, gradients, PDE.

use super::cells::{Cells, Tetrahedra, Triangles, is_ghost};
use super::chosen_array::ChosenArray;
use super::error::FilterError;
use super::gradients::Gradients;
use super::known_pde::KnownPde;
use super::options::{ContourOptions, InterpolantKind};
use crate::contour::CellRanges;
use crate::field::Field;
use crate::interpolant::{Equation, Linear, Pci, PdeFit, Predictor, TriangleCubics};
use crate::simplices::{CellCounts, LeftOut};
use crate::vtk::UnstructuredGrid;

/// What of a grid is contoured.
pub struct Solution<'a> {
    /// The grid.
    pub grid: &'a UnstructuredGrid,
    /// The array.
    pub chosen: ChosenArray<'a>,
    /// The two-dimensional cells.
    pub triangles: Triangles,
    /// The solids, which are not contoured yet.
    pub tetrahedra: Option<Tetrahedra>,
    /// Cells that cannot be split into simplices.
    pub left_out: LeftOut,
    /// One value a point.
    pub values: Vec<f64>,
    /// One gradient a point; none for the linear interpolant.
    pub gradients: Gradients,
    interpolant: InterpolantKind,
    equation: Option<KnownPde>,
}

/// An interpolant, and what it could not do.
pub struct Interpolated<'a> {
    /// The interpolant.
    pub cubics: Box<dyn TriangleCubics + 'a>,
    /// Triangles in which the PDE could not be used.
    pub singular: usize,
    /// How well the PDE fits the data; nothing without a PDE.
    pub pde_fit: Option<PdeFit>,
}

impl<'a> Solution<'a> {
    /// Takes from a grid what the options name. Bézier cells of order two have to be
    /// Lagrange cells by now, see [`lagrange_grid`](crate::simplices::lagrange_grid).
    ///
    /// # Errors
    /// If an array is missing or does not fit, the PDE cannot be read, or the grid
    /// has no triangles.
    pub fn new(grid: &'a UnstructuredGrid, options: &ContourOptions) -> Result<Self, FilterError> {
        let chosen = ChosenArray::new(grid, options.array.as_deref(), options.component)?;
        let equation = KnownPde::new(grid, options)?;
        let Cells { triangles, tetrahedra, left_out, .. } = Cells::new(grid)?;
        let cells = || grid.types.iter().copied().collect();
        let Some(triangles) = triangles else {
            return Err(FilterError::NoTriangles { cells: cells(), left_out });
        };
        let values = chosen.values();
        let gradients = match options.interpolant {
            InterpolantKind::Linear => Gradients::none(),
            InterpolantKind::Pci => {
                Gradients::new(grid, &triangles.mesh, &chosen, &values, &options.gradient)?
            }
        };
        let interpolant = options.interpolant;
        Ok(Self {
            grid,
            chosen,
            triangles,
            tetrahedra,
            left_out,
            values,
            gradients,
            interpolant,
            equation,
        })
    }

    /// The solids by type, which are not contoured yet.
    pub fn solids(&self) -> CellCounts {
        self.tetrahedra.as_ref().map(|part| part.cells(self.grid)).unwrap_or_default()
    }

    /// The interpolant of the solution.
    pub fn interpolant(&self, predictor: Predictor) -> Interpolated<'_> {
        let mesh = &self.triangles.mesh;
        let field = Field { values: &self.values, gradients: &self.gradients.vectors };
        if self.interpolant == InterpolantKind::Linear {
            let cubics = Box::new(Linear::new(mesh, &self.values));
            return Interpolated { cubics, singular: 0, pde_fit: None };
        }
        let Some(KnownPde { pde, arrays, .. }) = &self.equation else {
            let cubics = Box::new(Pci::new(mesh, field));
            return Interpolated { cubics, singular: 0, pde_fit: None };
        };
        let pci = Pci::with_pde(mesh, field, &Equation { pde, arrays, predictor });
        let singular = pci.singular();
        let pde_fit = Some(PdeFit::new(&pci, pde));
        Interpolated { cubics: Box::new(pci), singular, pde_fit }
    }

    /// The least and the greatest value of the interpolant.
    ///
    /// # Errors
    /// If no triangle has finite values.
    pub fn range(
        &self,
        ranges: &CellRanges,
        cubics: &dyn TriangleCubics,
    ) -> Result<[f64; 2], FilterError> {
        let no_values = || FilterError::NoValues { name: self.chosen.label() };
        ranges.attained(cubics).ok_or_else(no_values)
    }

    /// What people should know about the PDE's parameters, a line each.
    pub fn pde_warnings(&self) -> &[String] {
        self.equation.as_ref().map_or(&[], |known| &known.warnings)
    }

    /// The values at the corners of the triangles that are contoured.
    pub fn used_values(&self) -> impl Iterator<Item = f64> {
        let triangles = self.triangles.mesh.triangles().iter().enumerate();
        let used = triangles.filter(|&(triangle, _)| !self.is_ghost(triangle));
        used.flat_map(|(_, corners)| corners.map(|point| self.values[point as usize]))
    }

    /// Whether a triangle belongs to another process.
    pub fn is_ghost(&self, triangle: usize) -> bool {
        is_ghost(self.grid, self.triangles.parents[triangle])
    }
}
