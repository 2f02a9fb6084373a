//! A finite-element solution: cells, values, gradients, PDE.

use std::borrow::Cow;
use std::sync::Arc;

use super::cells::{Cells, Part, ghosts};
use super::chosen_array::ChosenArray;
use super::error::FilterError;
use super::gradients::{GradientOrigin, Gradients};
use super::known_pde::KnownPde;
use super::options::{ContourOptions, InterpolantKind};
use crate::contour::CellRanges;
use crate::field::Field;
use crate::mesh::{SimplexMesh, TetrahedronMesh, TriangleMesh};
use crate::simplices::{CellCounts, LeftOut};
use crate::vtk::{ArrayType, UnstructuredGrid};

/// A solution that can be contoured: its own arrays, or views of arrays that live elsewhere.
pub struct Solution<'a> {
    /// What it is called, such as `u` or `|velocity|`.
    pub label: String,
    /// Whether its values were of single precision, as levels in the output are then.
    pub single: bool,
    /// One value a point.
    pub values: Cow<'a, [f64]>,
    /// The two-dimensional cells, which have contour lines.
    pub triangles: Option<Domain<'a, 3>>,
    /// The solids, which have iso-surfaces.
    pub tetrahedra: Option<Domain<'a, 4>>,
    /// Cells that cannot be split into simplices.
    pub left_out: LeftOut,
    /// Solids whose tetrahedra lie over one another in part.
    pub folded: CellCounts,
    /// The PDE, if it is known; shared with whoever keeps it for other solutions.
    pub pde: Option<Arc<KnownPde>>,
}

/// The cells of one dimension, as simplices, and the gradients there.
#[derive(Clone, Debug)]
pub struct Domain<'a, const CORNERS: usize> {
    /// The simplices, with all points of the solution.
    pub mesh: SimplexMesh<'a, CORNERS>,
    /// The cell that each simplex came from; nothing if the simplices are the cells.
    pub parents: Option<Vec<u32>>,
    /// Whether each simplex belongs to another process, which contours it; nothing if none
    /// does.
    pub ghosts: Option<Vec<bool>>,
    /// One gradient a point; none for the linear interpolant.
    pub gradients: Gradients<'a>,
}

/// What values without a name are called, as in a PDE.
pub const SOLUTION: &str = "u";

impl Solution<'static> {
    /// Takes from a grid what the options name. Bézier cells of order two have to be
    /// Lagrange cells by now, see [`lagrange_grid`](crate::simplices::lagrange_grid).
    ///
    /// # Errors
    /// If an array is missing or does not fit, the PDE cannot be read, or the grid
    /// has no cells that can be contoured.
    pub fn of_grid(grid: &UnstructuredGrid, options: &ContourOptions) -> Result<Self, FilterError> {
        let chosen = ChosenArray::new(grid, options.array.as_deref(), options.component)?;
        let pde = KnownPde::of_grid(grid, options)?.map(Arc::new);
        let Cells { triangles, tetrahedra, left_out, folded } = Cells::new(grid)?;
        if triangles.is_none() && tetrahedra.is_none() {
            let cells = grid.types.iter().copied().collect();
            return Err(FilterError::NoCells { cells, left_out });
        }
        let values = chosen.values();
        let triangles = Domain::of_grid(grid, triangles, &chosen, &values, options)?;
        let tetrahedra = Domain::of_grid(grid, tetrahedra, &chosen, &values, options)?;
        let (label, single) = (chosen.label(), chosen.array.array_type() == ArrayType::F32);
        let values = values.into();
        Ok(Self { label, single, values, triangles, tetrahedra, left_out, folded, pde })
    }
}

impl<'a> Solution<'a> {
    /// Values and gradients on triangles: of arrays, which are not copied.
    ///
    /// # Errors
    /// If there is not one value a point, or not one gradient (unless there are none, for
    /// the linear interpolant).
    pub fn of_triangles(
        mesh: TriangleMesh<'a>,
        values: &'a [f64],
        gradients: Gradients<'a>,
        pde: Option<Arc<KnownPde>>,
    ) -> Result<Self, FilterError> {
        let domain = Domain::of_arrays(mesh, values, gradients)?;
        Ok(Self { triangles: Some(domain), ..Self::of_values(values, pde) })
    }

    /// Values and gradients in tetrahedra: of arrays, which are not copied.
    ///
    /// # Errors
    /// As [`Solution::of_triangles`].
    pub fn of_tetrahedra(
        mesh: TetrahedronMesh<'a>,
        values: &'a [f64],
        gradients: Gradients<'a>,
        pde: Option<Arc<KnownPde>>,
    ) -> Result<Self, FilterError> {
        let domain = Domain::of_arrays(mesh, values, gradients)?;
        Ok(Self { tetrahedra: Some(domain), ..Self::of_values(values, pde) })
    }

    /// Values without cells.
    fn of_values(values: &'a [f64], pde: Option<Arc<KnownPde>>) -> Self {
        Self {
            label: SOLUTION.to_owned(),
            single: false,
            values: values.into(),
            triangles: None,
            tetrahedra: None,
            left_out: LeftOut::default(),
            folded: CellCounts::default(),
            pde,
        }
    }
}

impl Solution<'_> {
    /// Values and gradients on a domain.
    pub fn field<'b, const CORNERS: usize>(&'b self, domain: &'b Domain<CORNERS>) -> Field<'b> {
        Field { values: &self.values, gradients: &domain.gradients.vectors }
    }

    /// Whether all cells belong to other processes.
    pub fn has_only_ghosts(&self) -> bool {
        self.triangles.as_ref().is_none_or(Domain::has_only_ghosts)
            && self.tetrahedra.as_ref().is_none_or(Domain::has_only_ghosts)
    }

    /// Where the gradient came from: in solids, if there are any.
    pub fn gradient_origin(&self) -> GradientOrigin {
        let [in_triangles, in_tetrahedra] = self.gradient_origins();
        in_tetrahedra.or(in_triangles).unwrap_or(GradientOrigin::Unused)
    }

    /// Where it came from on triangles and in tetrahedra, where there are any.
    pub fn gradient_origins(&self) -> [Option<GradientOrigin>; 2] {
        let on_triangles = self.triangles.as_ref().map(|domain| &domain.gradients.origin);
        let in_tetrahedra = self.tetrahedra.as_ref().map(|domain| &domain.gradients.origin);
        [on_triangles, in_tetrahedra].map(Option::<&_>::cloned)
    }

    /// What people should know about the PDE's parameters, a line each.
    pub fn pde_warnings(&self) -> &[String] {
        self.pde.as_ref().map_or(&[], |known| &known.warnings)
    }
}

impl<const CORNERS: usize> Domain<'static, CORNERS> {
    fn of_grid(
        grid: &UnstructuredGrid,
        part: Option<Part<CORNERS>>,
        chosen: &ChosenArray,
        values: &[f64],
        options: &ContourOptions,
    ) -> Result<Option<Self>, FilterError> {
        let Some(Part { mesh, parents }) = part else { return Ok(None) };
        let ghosts = ghosts(grid, &parents);
        // nothing to keep where each simplex is the cell of its number
        let is_cell = |(simplex, &parent): (usize, &u32)| simplex == parent as usize;
        let parents = Some(parents).filter(|all| !all.iter().enumerate().all(is_cell));
        let gradients = match options.interpolant {
            InterpolantKind::Linear => Gradients::none(),
            _ => Gradients::new(grid, &mesh, chosen, values, &options.gradient)?,
        };
        Ok(Some(Self { mesh, parents, ghosts, gradients }))
    }
}

impl<'a, const CORNERS: usize> Domain<'a, CORNERS> {
    fn of_arrays(
        mesh: SimplexMesh<'a, CORNERS>,
        values: &[f64],
        gradients: Gradients<'a>,
    ) -> Result<Self, FilterError> {
        let points = mesh.points().len();
        let vectors = gradients.vectors.len();
        let given = [("values", values.len(), false), ("gradients", vectors, vectors == 0)];
        for (what, count, may_lack) in given {
            if count != points && !may_lack {
                return Err(FilterError::NotOneAPoint { what, count, points });
            }
        }
        Ok(Self { mesh, parents: None, ghosts: None, gradients })
    }
}

impl<const CORNERS: usize> Domain<'_, CORNERS> {
    /// How many simplices there are.
    pub fn count(&self) -> usize {
        self.mesh.simplices().len()
    }

    /// The cell that a simplex came from.
    pub fn parent(&self, simplex: u32) -> u32 {
        self.parents.as_ref().map_or(simplex, |parents| parents[simplex as usize])
    }

    /// Leaves out the cells of other processes; returns how many simplices that are.
    pub fn exclude_ghosts(&self, ranges: &mut CellRanges) -> usize {
        if self.ghosts.is_none() { 0 } else { ranges.exclude(|simplex| self.is_ghost(simplex)) }
    }

    /// Whether all simplices belong to other processes.
    pub fn has_only_ghosts(&self) -> bool {
        self.ghosts.as_ref().is_some_and(|ghosts| ghosts.iter().all(|&is_ghost| is_ghost))
    }

    /// Whether a simplex is one of another process.
    pub fn is_ghost(&self, simplex: usize) -> bool {
        self.ghosts.as_ref().is_some_and(|ghosts| ghosts[simplex])
    }
}
