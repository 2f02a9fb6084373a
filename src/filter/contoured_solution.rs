//! A solution that is contoured once.

use super::contours::Contours;
use super::error::FilterError;
use super::extent::Extent;
use super::interpolant::Interpolant;
use super::options::ContourOptions;
use super::output::{Output, OutputOptions};
use super::report::Report;
use super::solution::Solution;
use crate::mesh::TriangleMesh;

/// A solution with its contours at some levels, and the interpolant near them.
///
/// Whoever wants other levels of the same solution later keeps an [`Interpolant`] instead.
pub struct ContouredSolution<'a> {
    /// Known in the cells that hold a level, and no farther.
    interpolant: Interpolant<'a>,
    /// Its contours.
    pub contours: Contours,
}

impl<'a> ContouredSolution<'a> {
    /// The contours of a solution by the options. It takes much less time and memory than an
    /// [`Interpolant`] if few cells hold the levels.
    ///
    /// # Errors
    /// If no cell has finite values, a level is no number, or the options ask for what cannot be
    /// drawn.
    pub fn new(solution: Solution<'a>, options: &ContourOptions) -> Result<Self, FilterError> {
        Self::told(solution, options, || {})
    }

    /// The same; `is_known` is called when the interpolant is known and the contours are not.
    pub(super) fn told(
        solution: Solution<'a>,
        options: &ContourOptions,
        is_known: impl FnOnce(),
    ) -> Result<Self, FilterError> {
        // a wrong limit is better told before the work than after
        let diagonal = options.size.unwrap_or_else(|| Extent::of_solution(&solution).diagonal());
        options.resolution(diagonal)?;
        let interpolant = Interpolant::at_levels(solution, options, diagonal)?;
        is_known();
        let contours = interpolant.contours(options)?;
        Ok(Self { interpolant, contours })
    }

    /// The contours as a whole, ready to take data along.
    pub fn output(&self, options: OutputOptions) -> Output {
        self.interpolant.output(&self.contours, options)
    }

    /// What was done, and what people should know about it.
    pub fn report(&self) -> Report {
        self.interpolant.report(&self.contours)
    }

    /// The contours, and the two-dimensional cells, if there are any.
    pub(super) fn into_parts(self) -> (Contours, Option<TriangleMesh<'a>>) {
        (self.contours, self.interpolant.into_triangles())
    }
}
