//! A solution with its interpolant: made once, contoured at any levels.

use std::borrow::Cow;

use super::contours::Contours;
use super::error::FilterError;
use super::interpolation::Interpolation;
use super::line_output::LineOutput;
use super::options::ContourOptions;
use super::output::{Output, OutputOptions};
use super::report::Report;
use super::solution::{Domain, Solution};
use super::surface_output::SurfaceOutput;
use crate::contour::CellRanges;
use crate::interpolant::{TetrahedronCubics, TriangleCubics};
use crate::mesh::TriangleMesh;

/// A solution with its interpolant: made once, contoured at any levels.
pub struct Interpolant<'a> {
    /// Cells, values, gradients.
    pub solution: Solution<'a>,
    /// What was computed of them.
    pub interpolation: Cow<'a, Interpolation>,
}

/// Cubics with their ranges, which are computed once for all levels.
type Ranged<'a, Cubics> = (Box<Cubics>, &'a CellRanges);

impl<'a> Interpolant<'a> {
    /// The interpolant of a solution that the options name.
    ///
    /// # Errors
    /// If no cell has finite values.
    pub fn new(solution: Solution<'a>, options: &ContourOptions) -> Result<Self, FilterError> {
        let interpolation = Cow::Owned(Interpolation::new(&solution, options)?);
        Ok(Self { solution, interpolation })
    }

    /// The same for contours at the options' levels only: nothing else may be asked of it. It
    /// takes much less time and memory if few cells hold the levels. `diagonal` is that of the
    /// solution's [`Extent`](super::Extent).
    ///
    /// # Errors
    /// If no cell has finite values, or a level is no number.
    pub(super) fn at_levels(
        solution: Solution<'a>,
        options: &ContourOptions,
        diagonal: f64,
    ) -> Result<Self, FilterError> {
        let interpolation = Interpolation::at_levels(&solution, options, diagonal)?;
        let interpolation = Cow::Owned(interpolation);
        Ok(Self { solution, interpolation })
    }

    /// The cubics on the two-dimensional cells, if there are any with finite values.
    pub fn in_triangles(&self) -> Option<Ranged<'_, dyn TriangleCubics + '_>> {
        let domain = self.solution.triangles.as_ref()?;
        let found = self.interpolation.triangles.as_ref()?;
        let cubics = found.coefficients.cubics(&domain.mesh, self.solution.field(domain));
        Some((cubics, &found.ranges))
    }

    /// The cubics in the solids, if there are any with finite values.
    pub fn in_tetrahedra(&self) -> Option<Ranged<'_, dyn TetrahedronCubics + '_>> {
        let domain = self.solution.tetrahedra.as_ref()?;
        let found = self.interpolation.tetrahedra.as_ref()?;
        let cubics = found.coefficients.cubics(&domain.mesh, self.solution.field(domain));
        Some((cubics, &found.ranges))
    }

    /// Its contours at the levels of the options, drawn as they say.
    ///
    /// # Errors
    /// If a level is no finite number, or the options ask for what cannot be drawn.
    pub fn contours(&self, options: &ContourOptions) -> Result<Contours, FilterError> {
        Contours::new(self, options)
    }

    /// Its contours as a whole, ready to take data along.
    pub fn output(&self, contours: &Contours, options: OutputOptions) -> Output {
        let mut output = Output::new(&self.solution, options);
        if let (Some(domain), Some((cubics, _)), Some(lines)) =
            (&self.solution.triangles, self.in_triangles(), &contours.lines)
        {
            LineOutput { domain, interpolant: cubics.as_ref(), lines }.add_to(&mut output);
        }
        if let (Some(domain), Some((cubics, _)), Some(surface)) =
            (&self.solution.tetrahedra, self.in_tetrahedra(), &contours.surface)
        {
            SurfaceOutput { domain, interpolant: cubics.as_ref(), surface }.add_to(&mut output);
        }
        output
    }

    /// What was done, and what people should know about it.
    pub fn report(&self, contours: &Contours) -> Report {
        let Self { solution, interpolation } = self;
        Report {
            label: solution.label.clone(),
            gradient: solution.gradient_origin(),
            gradients: solution.gradient_origins(),
            triangles: solution.triangles.as_ref().map_or(0, Domain::count),
            tetrahedra: solution.tetrahedra.as_ref().map_or(0, Domain::count),
            left_out: solution.left_out.clone(),
            folded: solution.folded.clone(),
            ghosts: interpolation.ghosts(),
            singular: interpolation.singular(),
            pde_fit: interpolation.triangles.as_ref().and_then(|found| found.pde_fit),
            range: interpolation.at_vertices,
            levels: contours.levels.clone(),
            counts: contours.lines.as_ref().map_or_else(Default::default, |lines| lines.counts),
            surface_counts: contours.surface.as_ref().map_or_else(Default::default, |s| s.counts),
            resolution: contours.resolution,
            fineness: contours.fineness,
            warnings: interpolation.warnings.clone(),
        }
        .with_warnings()
    }

    /// The two-dimensional cells, if there are any.
    pub fn into_triangles(self) -> Option<TriangleMesh<'a>> {
        self.solution.triangles.map(|domain| domain.mesh)
    }
}
