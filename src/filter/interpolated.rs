//! The interpolant of a solution on the cells of one dimension, ready to be contoured.

use super::cells::is_ghost;
use super::error::FilterError;
use super::options::{ContourOptions, InterpolantKind};
use super::solution::{Domain, Solution};
use crate::contour::CellRanges;
use crate::interpolant::{Linear, Pci, PdeFit, TetrahedronCubics, TriangleCubics, Tricubic};

/// An interpolant with its ranges, and what it could not do.
pub struct Interpolated<C: ?Sized> {
    /// The interpolant.
    pub cubics: Box<C>,
    /// Its range on each cell, without those of other processes.
    pub ranges: CellRanges,
    /// The least and the greatest value that it attains.
    pub range: [f64; 2],
    /// Cells in which the PDE could not be used.
    pub singular: usize,
    /// How well the PDE fits the data; nothing without a PDE.
    pub pde_fit: Option<PdeFit>,
    /// Cells of another process, which are not contoured.
    pub ghosts: usize,
}

/// An interpolant on triangles.
pub type InTriangles<'a> = Interpolated<dyn TriangleCubics + 'a>;

/// An interpolant on tetrahedra.
pub type InTetrahedra<'a> = Interpolated<dyn TetrahedronCubics + 'a>;

impl Solution<'_> {
    /// The interpolant on the two-dimensional cells, if there are any with finite values.
    pub fn in_triangles(&self, options: &ContourOptions) -> Option<InTriangles<'_>> {
        let domain = self.triangles.as_ref()?;
        let (mesh, field) = (&domain.mesh, self.field(domain));
        let (mut singular, mut pde_fit) = (0, None);
        let cubics: Box<dyn TriangleCubics> = match (options.interpolant, &self.pde) {
            (InterpolantKind::Linear, _) => Box::new(Linear::new(mesh, &self.values)),
            (InterpolantKind::QuadraticPrecision, _) => {
                Box::new(Pci::with_quadratic_precision(mesh, field))
            }
            (InterpolantKind::Pci, None) => Box::new(Pci::new(mesh, field)),
            (InterpolantKind::Pci, Some(known)) => {
                let pci = Pci::with_pde(mesh, field, &known.equation(options.predictor));
                singular = pci.singular();
                pde_fit = Some(PdeFit::new(&pci, &known.pde));
                Box::new(pci)
            }
        };
        let mut ranges = CellRanges::new(cubics.as_ref());
        let ghosts = self.exclude_ghosts(domain, &mut ranges);
        let range = ranges.attained(cubics.as_ref())?;
        Some(Interpolated { cubics, ranges, range, singular, pde_fit, ghosts })
    }

    /// The interpolant on the solids, if there are any with finite values.
    pub fn in_tetrahedra(&self, options: &ContourOptions) -> Option<InTetrahedra<'_>> {
        let domain = self.tetrahedra.as_ref()?;
        let (mesh, field) = (&domain.mesh, self.field(domain));
        let mut singular = 0;
        let cubics: Box<dyn TetrahedronCubics> = match (options.interpolant, &self.pde) {
            (InterpolantKind::Linear, _) => Box::new(Linear::new(mesh, &self.values)),
            (InterpolantKind::QuadraticPrecision, _) => {
                Box::new(Tricubic::with_quadratic_precision(mesh, field))
            }
            (InterpolantKind::Pci, None) => Box::new(Tricubic::new(mesh, field)),
            (InterpolantKind::Pci, Some(known)) => {
                let equation = known.equation(options.predictor);
                let tricubic = Tricubic::with_pde(mesh, field, &equation);
                singular = tricubic.singular();
                Box::new(tricubic)
            }
        };
        let mut ranges = CellRanges::of_tetrahedra(cubics.as_ref());
        let ghosts = self.exclude_ghosts(domain, &mut ranges);
        let range = ranges.attained_in_tetrahedra(cubics.as_ref())?;
        Some(Interpolated { cubics, ranges, range, singular, pde_fit: None, ghosts })
    }

    /// Leaves out the cells of other processes; returns how many simplices that are.
    fn exclude_ghosts<const CORNERS: usize>(
        &self,
        domain: &Domain<CORNERS>,
        ranges: &mut CellRanges,
    ) -> usize {
        ranges.exclude(|simplex| is_ghost(self.grid, domain.parents[simplex]))
    }

    /// The range of both interpolants.
    ///
    /// # Errors
    /// If no cell has finite values.
    pub fn range(
        &self,
        in_triangles: Option<&InTriangles>,
        in_tetrahedra: Option<&InTetrahedra>,
    ) -> Result<[f64; 2], FilterError> {
        let ranges = [in_triangles.map(|i| i.range), in_tetrahedra.map(|i| i.range)];
        let joined = ranges.into_iter().flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        joined.ok_or_else(|| FilterError::NoValues { name: self.chosen.label() })
    }
}
