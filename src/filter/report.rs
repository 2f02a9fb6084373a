//! What a contouring did, and what people should know about it.

use super::gradients::GradientOrigin;
use super::pde_warning::pde_warning;
use crate::contour::lines::{Counts, Resolution};
use crate::contour::surface::{Fineness, SurfaceCounts};
use crate::interpolant::PdeFit;
use crate::simplices::{CellCounts, LeftOut};

/// What was done, and what people should know about it.
#[derive(Clone, Debug)]
pub struct Report {
    /// What was contoured, such as `u` or `|velocity|`.
    pub label: String,
    /// Where the gradient came from: in solids, if there are any.
    pub gradient: GradientOrigin,
    /// Where it came from on triangles and in tetrahedra, where there are any.
    pub gradients: [Option<GradientOrigin>; 2],
    /// How many triangles there were.
    pub triangles: usize,
    /// How many tetrahedra there were.
    pub tetrahedra: usize,
    /// Cells of two or three dimensions that could not be split into simplices.
    pub left_out: LeftOut,
    /// Solids whose tetrahedra lie over one another in part.
    pub folded: CellCounts,
    /// Triangles and tetrahedra of another process, which are not contoured.
    pub ghosts: usize,
    /// Triangles and tetrahedra in which the PDE could not be used.
    pub singular: usize,
    /// How well the PDE fits the values and gradients in the triangles; nothing without a
    /// PDE.
    pub pde_fit: Option<PdeFit>,
    /// The least and the greatest value at the points of the cells that are contoured; the cubics may
    /// go beyond.
    pub range: [f64; 2],
    /// The levels, ascending.
    pub levels: Vec<f64>,
    /// What the contouring of triangles counted.
    pub counts: Counts,
    /// What the contouring of tetrahedra counted.
    pub surface_counts: SurfaceCounts,
    /// How fine lines are.
    pub resolution: Resolution,
    /// How fine surfaces are; nothing without tetrahedra.
    pub fineness: Option<Fineness>,
    /// One line each. What can be said only of all grids that share their levels is told by
    /// [`level_warning`](super::level_warning()).
    pub warnings: Vec<String>,
}

impl Report {
    /// Adds what people should know, a line each.
    pub(super) fn with_warnings(mut self) -> Self {
        let Counts { unusable, unresolved, touching, coarse, .. } = self.counts;
        let solid = self.surface_counts;
        let simplices = self.triangles + self.tetrahedra;
        let counted = [
            (unusable, "left out: # triangles with values that are not finite numbers"),
            (solid.unusable, "left out: # tetrahedra with values that are not finite numbers"),
            (unresolved, "# tiny pieces could not be settled; straight lines join them"),
            (
                solid.unresolved,
                "# tiny pieces could not be settled; the surface is closed there, but may miss \
                 a detail",
            ),
            (touching, "in # triangles a level is touched, not crossed: no line is drawn there"),
            (coarse, "# arcs are not as fine as asked: they have too many points"),
            (solid.coarse, "# triangles are not as fine as asked: they would be too small"),
        ];
        if self.left_out.total() > 0 {
            self.warnings.push(format!("left out: {}", self.left_out));
        }
        if self.folded.total() > 0 {
            self.warnings.push(format!(
                "{} fold over themselves, so surfaces in them may be doubled: mend the mesh, or \
                 subdivide it",
                self.folded
            ));
        }
        for (count, text) in counted.into_iter().filter(|(count, _)| *count > 0) {
            self.warnings.push(text.replacen('#', &count.to_string(), 1));
        }
        if self.singular > 0 {
            let singular = self.singular;
            self.warnings.push(format!(
                "the PDE does not determine the cubic in {singular} of {simplices} cells"
            ));
        }
        self.warnings.extend(pde_warning(&self.label, self.pde_fit));
        self
    }
}
